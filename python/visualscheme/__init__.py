"""Models in VisualScheme run from Python: programs, values, the scene, and meshes as NumPy arrays.

    import visualscheme
    with visualscheme.Scheme() as s:
        s.run("(draw (make-sphere (xyz 0 0 0) 1))")
        for mesh in s.meshes():
            print(mesh.points.shape, mesh.triangles.shape)
"""
import codecs
import contextlib
import ctypes
import os
import signal
import sys
import threading
from collections import namedtuple
from ctypes import byref, c_double, sizeof
from fractions import Fraction

import numpy

from . import _library as c

__all__ = ["Scheme", "SchemeError", "Value", "Vector", "Symbol", "Mesh", "Part", "Hit", "Gizmo", "Parameter"]

Part = namedtuple("Part", "material material_id color painted roughness metallic ior layer file line column")
Hit = namedtuple("Hit", "distance point node path file line column")
# kind: "trigger", "slider", "arrow" or "tripod". value, low and high: a number, of a tripod arrays of three; handles
# and axes (n, 3), in the world's coordinates.
Gizmo = namedtuple("Gizmo", "node kind at size value low high step handles axes")
# value, default and choices are written data, as a program has them; min, max and step are None without a range.
Parameter = namedtuple("Parameter", "name label group type value default min max step choices unit")
# change: "removed", "changed" or "added". points (n, 3), triangles (m, 3), normals (k, 3), normal_corners (m, 3);
# parts, and in part_of the number of each triangle's, or None; places (p, 3, 4), from the mesh's coordinates to the
# drawing's. All arrays are Python's own.
Mesh = namedtuple("Mesh", "change id points triangles normals normal_corners parts part_of places")

_NONE, _BOOLEAN, _NUMBER, _TEXT, _SYMBOL, _LIST, _POINT, _VECTOR, _MATRIX = range(9)
_CHANGES = ("removed", "changed", "added")
_GIZMOS = ("trigger", "slider", "arrow", "tripod")
_INPUTS = ("press", "drag", "release", "move", "key")
_BUTTONS = ("left", "middle", "right", "none")
_TYPES = ("boolean", "integer", "real", "string", "datum")
_QUALITIES = ("draft", "good", "final")


def _placed(message, file, line, column):
    return "%s:%d:%d: %s" % (file, line, column, message) if file else message


class SchemeError(Exception):
    """An error of a program or a call. message; file, line, column (None, 0, 0: no place); outcome, the exit code;
    notes, texts: the call chain, innermost first, and hints."""

    def __init__(self, message, file=None, line=0, column=0, outcome=1, notes=()):
        text = _placed(message, file, line, column)
        super().__init__("".join([text] + ["\n  " + note for note in notes]))
        self.message, self.file, self.line, self.column, self.outcome = message, file, line, column, outcome
        self.notes = list(notes)


class Symbol(str):
    """A symbol of the language; a str is a text."""


class Vector(numpy.ndarray):
    """A gvector of the language: three numbers. Any other array of three is a point. The results of NumPy's operations
    on it are plain arrays."""

    def __new__(cls, numbers):
        return numpy.array(numbers, float).reshape(3).view(cls)

    def __array_ufunc__(self, function, method, *inputs, **others):
        plain = [x.view(numpy.ndarray) if isinstance(x, Vector) else x for x in inputs]
        return getattr(function, method)(*plain, **others)


class Value:
    """A value without a counterpart in Python: an object, a node, a procedure, a pair such as (1 . 2). It lives as long
    as this Value."""

    def __init__(self, scheme, handle):
        self._scheme, self.handle, self._age = scheme, handle, scheme._age

    def __del__(self):
        if self._scheme._pointer and self._age == self._scheme._age:
            self._scheme._c.vs_handle_release(self._scheme._pointer, self.handle)

    def __call__(self, *arguments):
        return self._scheme._apply(self.handle, arguments)

    def __eq__(self, other):
        return isinstance(other, Value) and self._scheme is other._scheme and self._scheme._c.vs_handle_same(
            self._scheme._s, self.handle, other.handle)

    __hash__ = None

    def __repr__(self):
        text = ""
        if self._scheme._pointer and not self._scheme._running:
            try:
                text = " %s" % self._scheme.call("format", "~s", self)
            except SchemeError:
                pass  # it is of a program of before
        return "<visualscheme.Value%s>" % (text if len(text) < 200 else text[:200] + " ...")


def _text(bytes_or_none):
    """Decodes the name of a file, which may not be UTF-8, as os.fsdecode does."""
    return bytes_or_none.decode("utf-8", "surrogateescape") if bytes_or_none is not None else None


def _name(text):
    """Returns the bytes of a name or an option; an error if they contain a zero, which would end them in C."""
    if not isinstance(text, str):
        raise TypeError("a name is a str, not %r" % (text,))
    data = text.encode()
    if b"\0" in data:
        raise ValueError("%r has a character of code 0, which no name has" % (text,))
    return data


def _path(path):
    data = os.fsencode(path)
    if b"\0" in data:
        raise ValueError("%r has a character of code 0, which no name of a file has" % (path,))
    return data


def _real(number):
    """Returns the number as a double; an error if a double cannot hold it."""
    if isinstance(number, numpy.integer):  # which compares as a double
        number = int(number)
    real = float(number)
    if real != number and number == number:
        raise OverflowError("%r is no number of double precision" % (number,))
    return real


def _whole(digits):
    """Returns the integer; int() itself accepts at most some thousand digits."""
    if digits[0] == "-":
        return -_whole(digits[1:])
    half = len(digits) // 2
    return int(digits) if half < 2000 else _whole(digits[:-half]) * 10 ** half + _whole(digits[-half:])


def _written(value):
    """Returns the value of a parameter as a program writes it."""
    if isinstance(value, (bool, numpy.bool_)):
        return ("#f", "#t")[bool(value)]
    if isinstance(value, (float, numpy.floating)):
        real = _real(value)
        return repr(real) if real - real == 0 else "+nan.0" if real != real else "+inf.0" if real > 0 else "-inf.0"
    if isinstance(value, (int, numpy.integer)):
        return "#x%x" % value if abs(int(value)) >> 4000 else str(int(value))
    if isinstance(value, Fraction):
        return "#x%x/%x" % (value.numerator, value.denominator)
    if isinstance(value, str):
        return str(value)
    raise TypeError("%r is no value of a parameter" % (value,))


def _array(pointer, rows, width, kind):
    if not rows:
        return numpy.empty((0, width), kind)
    return numpy.ctypeslib.as_array(pointer, (rows * width,)).reshape(rows, width).astype(kind, copy=True)


class Scheme:
    """An interpreter. A single thread at a time may use it; `with` ends it. It calls output with the texts that the
    program prints; None: it writes them to sys.stdout. library_path: folders for load and import, separated by ':'."""

    _pointer, _age = None, 0
    _running, _called = 0, 0  # calls of the library, and of Python's functions by it, that have not ended

    def __init__(self, output=None, limit_time=0.0, limit_memory=0, limit_steps=0, untrusted=False,
                 library_path=None):
        self._c = c.load()
        self._errors, self._kept, self.warnings = [], {}, []
        self._output, self._decoder = output, codecs.getincrementaldecoder("utf-8")("replace")
        options = c.Options()
        self._c.vs_options_init(byref(options), sizeof(options))
        # The poll gives Python the opportunity to run its handlers of signals, Ctrl-C's among them.
        self._host = (c.OutputFn(self._print), c.DiagnoseFn(self._diagnose), c.PollFn(lambda _: False))
        options.host.output, options.host.diagnose, options.host.poll = self._host
        options.limit_time, options.limit_memory, options.limit_steps = limit_time, limit_memory, limit_steps
        options.untrusted = untrusted
        self._library_path = os.fsencode(library_path) if library_path else None  # lives as long as the interpreter
        options.library_path = self._library_path
        self._pointer = self._c.vs_new(byref(options))
        if not self._pointer:
            raise MemoryError("no interpreter")

    @property
    def _s(self):
        if not self._pointer:
            raise SchemeError("the interpreter was closed", outcome=2)
        return self._pointer

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends the interpreter, with all its values."""
        if self._running:
            raise SchemeError("the interpreter is running: a callback may not call close()", outcome=2)
        if self._pointer:
            self._c.vs_free(self._pointer)
            self._pointer = None

    __del__ = close

    @contextlib.contextmanager
    def _runs(self):
        """While the interpreter runs, Ctrl-C interrupts it; afterwards this raises KeyboardInterrupt."""
        pressed = []
        mine = (threading.current_thread() is threading.main_thread() and
                signal.getsignal(signal.SIGINT) is signal.default_int_handler)

        def press(*_):
            pressed.append(True)
            self._c.vs_interrupt(self._s)
            if self._called:  # ends Python's function, too
                raise KeyboardInterrupt
        self._errors = []
        if mine:
            signal.signal(signal.SIGINT, press)
        self._running += 1
        try:
            yield
        finally:
            self._running -= 1
            if mine:
                signal.signal(signal.SIGINT, signal.default_int_handler)
            if pressed:
                self._c.vs_interrupt_clear(self._s)
                self._errors = []
                raise KeyboardInterrupt

    # ---- what the library calls ----

    def _print(self, _, text, count):
        (self._output or sys.stdout.write)(self._decoder.decode(ctypes.string_at(text, count)))
        return True

    def _diagnose(self, _, pointer):
        d = pointer.contents
        notes = [_placed(_text(n.message), _text(n.at.file), n.at.line, n.at.column) for n in d.notes[:d.note_count]]
        error = SchemeError(_text(d.message), _text(d.at.file), d.at.line, d.at.column, d.outcome, notes)
        (self._errors if d.severity == 0 else self.warnings).append(error)

    def _check(self, fine, outcome=2):
        """Returns the first error that was reported since the last call, if the call failed."""
        errors, self._errors = self._errors, []
        if not fine:
            raise errors[0] if errors else SchemeError("the call failed", outcome=outcome)

    # ---- values ----

    def _give(self, value):
        """Returns a new handle to the value."""
        f, s = self._c, self._s
        if isinstance(value, Value):
            handle = f.vs_handle_retain(s, value.handle)
        elif isinstance(value, (bool, numpy.bool_)):
            handle = f.vs_handle_boolean(s, bool(value))
        elif isinstance(value, (int, numpy.integer)):
            whole = int(value)
            small = -2 ** 63 <= whole < 2 ** 63
            handle = f.vs_handle_integer(s, whole) if small else f.vs_handle_number_text(s, b"#x%x" % whole)
        elif isinstance(value, Fraction):
            handle = f.vs_handle_number_text(s, b"#x%x/%x" % (value.numerator, value.denominator))
        elif isinstance(value, (float, numpy.floating)):
            handle = f.vs_handle_number(s, _real(value))
        elif isinstance(value, Symbol):
            handle = f.vs_handle_symbol(s, _name(value))
        elif isinstance(value, str):
            text = value.encode()
            handle = f.vs_handle_text_bytes(s, text, len(text))
        elif isinstance(value, Vector):
            handle = f.vs_handle_vector(s, *(_real(x) for x in value))
        elif isinstance(value, numpy.ndarray) and value.shape == (4, 4):
            with self._named("make-matrix") as make:
                handle = self._apply_to(make, [_real(x) for x in value.flat])
        elif isinstance(value, numpy.ndarray) and value.shape == (3,):
            handle = f.vs_handle_point(s, *(_real(x) for x in value))
        elif isinstance(value, (list, tuple)):
            items = []
            try:
                items.extend(self._give(item) for item in value)
                handle = f.vs_handle_list(s, (c.Handle * len(items))(*items), len(items))
            finally:
                for item in items:
                    f.vs_handle_release(s, item)
        else:
            raise TypeError("%r has no like in VisualScheme" % (value,))
        self._check(handle)
        return handle

    def _take(self, handle):
        """Returns the value of a handle, and releases the handle or gives it to a Value."""
        f, s = self._c, self._s
        kind = f.vs_handle_kind_of(s, handle)
        if kind > _MATRIX:
            return Value(self, handle)
        numbers = (c_double * 16)()
        count = f.vs_handle_get_numbers(s, handle, numbers, 16)
        if kind == _BOOLEAN:
            value = f.vs_handle_get_boolean(s, handle)
        elif kind == _NUMBER:
            value = self._exact(handle) if f.vs_handle_is_exact(s, handle) else numbers[0]
        elif kind in (_TEXT, _SYMBOL):
            value = (str if kind == _TEXT else Symbol)(self._bytes_of(handle).decode())
        elif kind == _LIST:
            value = [self._take(f.vs_handle_item(s, handle, i)) for i in range(f.vs_handle_count(s, handle))]
        else:
            value = numpy.array(numbers[:count])
            if kind == _MATRIX:
                value = value.reshape(4, 4)
            elif kind == _VECTOR:
                value = Vector(value)
        f.vs_handle_release(s, handle)
        return value

    def _bytes_of(self, handle):
        length = ctypes.c_size_t()
        text = self._c.vs_handle_get_text_bytes(self._s, handle, byref(length))
        self._check(text)
        return ctypes.string_at(text, length.value)

    def _exact(self, handle):
        """Returns an exact number as an int or a Fraction."""
        above, _, below = self._bytes_of(handle).decode().partition("/")
        return Fraction(_whole(above), _whole(below)) if below else _whole(above)

    def _borrowed(self, handle):
        return self._take(self._c.vs_handle_retain(self._s, handle))

    @contextlib.contextmanager
    def _named(self, name):
        """Returns a handle to the value of the name in the program."""
        handle = self._c.vs_lookup(self._s, _name(name))
        self._check(handle)
        try:
            yield handle
        finally:
            self._c.vs_handle_release(self._s, handle)

    def _apply(self, procedure, arguments):
        result = self._apply_to(procedure, arguments)
        return self._take(result) if result else None

    def _apply_to(self, procedure, arguments):
        """Returns a handle to the procedure's result."""
        handles, result = [], c.Handle(0)
        try:
            handles.extend(self._give(a) for a in arguments)
            with self._runs():
                outcome = self._c.vs_apply(self._s, procedure, (c.Handle * len(handles))(*handles), len(handles),
                                           byref(result))
        finally:
            for handle in handles:
                self._c.vs_handle_release(self._s, handle)
        self._check(outcome == 0, outcome)
        return result.value

    def _do(self, function, *arguments):
        """Makes a call that runs a program and returns an outcome."""
        with self._runs():
            outcome = function(self._s, *arguments)
        self._check(outcome == 0, outcome)

    def _got(self, function, *arguments):
        """Makes a call that returns a handle, and returns its value."""
        handle = function(self._s, *arguments)
        self._check(handle)
        return self._take(handle)

    # ---- programs ----

    def run(self, text, name="python"):
        """Evaluates every form of the text."""
        data = text.encode()
        self._do(self._c.vs_eval_text, _name(name), 1, data, len(data), 0)

    def value(self, text, name="python"):
        """Evaluates every form of the text, and returns the last form's value."""
        data, handle = text.encode(), c.Handle()
        self._do(self._c.vs_eval_value, _name(name), 1, data, len(data), 0, byref(handle))
        return self._take(handle.value)

    def run_file(self, path):
        self._do(self._c.vs_eval_file, _path(path), 0)

    def restart(self):
        """Restarts the interpreter, which keeps only the values of parameters. Values from before become void."""
        self._do(self._c.vs_restart)
        self._age += 1

    def __getitem__(self, name):
        """Returns the value of the name in the program: a value, or a Value to call."""
        return self._got(self._c.vs_lookup, _name(name))

    def __setitem__(self, name, value):
        """Defines the name; a Python function becomes a procedure."""
        handle = self._procedure(name, value) if callable(value) and not isinstance(value, Value) else self._give(value)
        fine = self._c.vs_define(self._s, _name(name), handle)
        self._c.vs_handle_release(self._s, handle)
        self._check(fine)

    def call(self, name, *arguments):
        with self._named(name) as handle:
            return self._apply(handle, arguments)

    def _callback(self, function):
        def called(_, scheme, arguments, count, result):
            self._called += 1
            try:
                value = function(*[self._borrowed(arguments[i]) for i in range(count)])
                if value is not None:
                    result[0] = self._give(value)
                return True
            except (Exception, KeyboardInterrupt) as error:  # Python's error becomes the program's
                self._errors = []
                said = (str(error) or type(error).__name__).encode("utf-8", "backslashreplace")
                self._c.vs_host_fail(self._s, said.replace(b"\0", b"\\0"))
                return False
            finally:
                self._called -= 1
        return self._keep(c.HostFn(called))

    def _keep(self, callback, key=None):
        """Keeps the function, which the library may call as long as the interpreter lives."""
        self._kept[key or len(self._kept)] = callback
        return callback

    def _procedure(self, name, function):
        handle = self._c.vs_host_procedure(self._s, _name(name), self._callback(function), None)
        self._check(handle)
        return handle

    def parameter(self, name, value):
        """Sets a parameter of the next run, as -D does; None: restores its default."""
        if value is None:
            self._c.vs_parameter_unset(self._s, _name(name))
        else:
            self._check(self._c.vs_parameter_set(self._s, _name(name), _name(_written(value))))

    def parameters(self):
        """Returns the parameters of (define-parameter ...), each as a Parameter."""
        found, p = [], c.ParameterInfo()
        for i in range(self._c.vs_parameter_count(self._s)):
            self._c.vs_parameter_get(self._s, i, byref(p))
            reach = (p.min, p.max, p.step) if p.has_range else (None, None, None)
            choices = [_text(x) for x in p.choices[:p.choice_count]] if p.choices else None
            found.append(Parameter(_text(p.name), _text(p.label), _text(p.group), _TYPES[p.type], _text(p.value),
                                   _text(p.default_value), *reach, choices, _text(p.unit)))
        return found

    def unused_parameters(self):
        """Returns the names that parameter() set and that no program has defined."""
        found = []
        while True:
            name = self._c.vs_parameter_unused(self._s, len(found))
            if name is None:
                return found
            found.append(_text(name))

    def clear(self):
        self._c.vs_drawing_clear(self._s)

    def summary(self):
        """Returns a dict: counts of objects, solids, surfaces, regions, curves; bounds, two arrays or None; units."""
        out = c.Summary()
        self._do(self._c.vs_drawing_summary, byref(out))
        counts = {name: getattr(out, name) for name in ("objects", "solids", "surfaces", "regions", "curves")}
        bounds = (numpy.array(out.min), numpy.array(out.max)) if out.has_bounds else None
        return dict(counts, bounds=bounds, units=_text(out.units))

    def statistics(self):
        """Returns a dict from a key to (value, unit), since the interpreter was made."""
        count = self._c.vs_statistics(self._s, None, 0)
        out = (c.Statistic * count)()
        self._c.vs_statistics(self._s, out, count)
        return {_text(x.key): (x.value, _text(x.unit)) for x in out}

    def _options(self, width=0, height=0, quality=None, view=None, camera=None, sun=None, tolerance=0.0, segments=0,
                 layers=False, strict=False):
        o = c.OutputOptions()
        self._c.vs_output_options_init(byref(o), sizeof(o))
        o.width, o.height, o.tolerance, o.segments = width, height, tolerance, segments
        o.layers, o.strict = layers, strict
        if quality is not None:
            o.quality = _QUALITIES.index(quality)
        if view is not None:
            o.view = _name(view)
        if camera is not None:  # eye, target, lens
            o.has_camera, o.camera = True, (c_double * 7)(*camera)
        if sun is not None:  # azimuth, altitude
            o.has_sun, o.sun = True, (c_double * 2)(*sun)
        return o

    def write(self, path, format=None, **options):
        """Writes a file in the format, by default that of the path's suffix. Options: width, height,
        quality ("draft", "good", "final"), view,
        camera (eye, target and lens, seven numbers), sun (azimuth, altitude), tolerance, segments, layers, strict."""
        self._do(self._c.vs_write_drawing, _path(path), _name(format) if format else None,
                 byref(self._options(**options)))

    def bytes(self, format, **options):
        """Returns the same as bytes, without a file:
        IPython.display.Image(s.bytes("png")) shows a picture in a notebook."""
        pieces = []

        def take(_, data, count):
            pieces.append(ctypes.string_at(data, count))
            return True
        self._do(self._c.vs_write_drawing_to, _name(format), byref(self._options(**options)), c.WriteFn(take), None)
        return b"".join(pieces)

    # ---- meshes ----

    def meshes(self, **options):
        """Returns the changes since the last call, each as a Mesh. tolerance and segments set the fineness."""
        with self._runs():
            outcome = self._c.vs_meshes_begin(self._s, byref(self._options(**options)))
        errors, self._errors = self._errors, []
        info, found = c.MeshInfo(), []
        while self._c.vs_mesh_next(self._s, byref(info)):
            found.append(self._mesh(info))
        if outcome and not found:
            raise errors[0] if errors else SchemeError("the meshes could not be made", outcome=outcome)
        return found

    def forget_meshes(self):
        """The next meshes() hands over all meshes. Removes the materials' function, too."""
        self._c.vs_meshes_forget(self._s)

    def materials(self, function):
        """Calls the function once for each material's name; it returns the number that Python uses for it,
        material_id."""
        def ask(_, name):
            try:
                return int(function(_text(name)))
            except Exception as error:  # it has no way to the program: the mesh is plain
                self.warnings.append(SchemeError("materials: %s" % error))
                return 0
        self._c.vs_material_handler(self._s, self._keep(c.MaterialFn(ask), "materials"), None)

    @staticmethod
    def _mesh(m):
        parts = [Part(_text(p.material), p.material_id, tuple(p.color), p.painted, p.roughness, p.metallic, p.ior,
                      _text(p.layer), _text(p.file), p.line, p.column)
                 for p in m.parts[:m.part_count]] if m.part_count else []
        part_of = _array(m.part_of, m.triangle_count, 1, numpy.uint32)[:, 0] if m.part_of else None
        return Mesh(_CHANGES[m.change], m.id, _array(m.points, m.point_count, 3, numpy.float64),
                    _array(m.corners, m.triangle_count, 3, numpy.uint32),
                    _array(m.normals, m.normal_count, 3, numpy.float64),
                    _array(m.normal_corners, m.triangle_count, 3, numpy.uint32), parts, part_of,
                    _array(m.places, m.place_count, 12, numpy.float64).reshape(-1, 3, 4))

    # ---- the scene ----

    @property
    def controller(self):
        """Its properties are the scene's events: subscribe(s.controller, "Node.create", function)."""
        return self._got(self._c.vs_scene_controller)

    @property
    def root(self):
        return self._got(self._c.vs_node_root)

    @property
    def focus(self):
        """The node into which the program draws."""
        return self._got(self._c.vs_node_focus)

    @contextlib.contextmanager
    def within(self, node):
        """`with s.within(node):` draws into the node."""
        self._do(self._c.vs_node_begin, node.handle)
        try:
            yield node
        finally:
            self._do(self._c.vs_node_end)

    def run_in(self, node, text):
        """Evaluates every form of the text in the node's program; returns the value of the last one."""
        value = c.Handle(0)
        self._do(self._c.vs_node_eval, node.handle, _name(text), byref(value))
        return self._take(value.value) if value.value else None

    def node(self, name=None, parent=None, drawing=None, translate=None, rotate=None, scale=None, type=None):
        """Returns a new node; degrees about X, Y and Z."""
        node = self._got(self._c.vs_node_create, _name(type) if type else None, _name(name) if name else None,
                         parent.handle if parent is not None else 0)
        if drawing is not None:
            self.draw(node, drawing)
        self.place(node, translate, rotate, scale)
        return node

    def _perhaps(self, function, *arguments):
        """Makes a call that may return no handle; returns its value, or None if there is no handle and no error."""
        self._errors = []
        handle = function(self._s, *arguments)
        self._check(handle or not self._errors)
        return self._take(handle) if handle else None

    def find(self, name):
        return self._perhaps(self._c.vs_node_find, _name(name))

    def parent(self, node):
        return self._perhaps(self._c.vs_node_parent, node.handle)

    def children(self, node):
        return self._got(self._c.vs_node_children, node.handle)

    def name(self, node):
        self._errors = []
        name = _text(self._c.vs_node_name(self._s, node.handle))
        self._check(not self._errors)
        return name

    def add(self, parent, child):
        self._do(self._c.vs_node_add_child, parent.handle, child.handle)

    def remove(self, parent, child):
        self._do(self._c.vs_node_remove_child, parent.handle, child.handle)

    def object(self, node):
        """Returns all that the node shows, as one object."""
        return self._got(self._c.vs_node_object, node.handle)

    def draw(self, node, drawing):
        """Makes an object, or a list of objects, the drawing of the node."""
        handle = self._give(drawing)
        try:
            self._do(self._c.vs_node_set_drawing, node.handle, handle)
        finally:
            self._c.vs_handle_release(self._s, handle)

    def place(self, node, translate=None, rotate=None, scale=None):
        three = [(c_double * 3)(*v) if v is not None else None for v in (translate, rotate, scale)]
        self._do(self._c.vs_node_place, node.handle, *three)

    def matrix(self, node, world=True):
        out = (c_double * 16)()
        self._check(self._c.vs_node_matrix(self._s, node.handle, world, out))
        return numpy.array(out).reshape(4, 4)

    def get(self, node, name):
        value = c.Handle(0)
        self._do(self._c.vs_property_get, node.handle, _name(name), byref(value))
        return self._take(value.value)

    def put(self, node, name, value):
        handle = self._give(value)
        try:
            self._do(self._c.vs_property_put, node.handle, _name(name), handle)
        finally:
            self._c.vs_handle_release(self._s, handle)

    @contextlib.contextmanager
    def _property(self, node, name):
        handle = self._c.vs_property_of(self._s, node.handle, _name(name))
        self._check(handle)
        try:
            yield handle
        finally:
            self._c.vs_handle_release(self._s, handle)

    def subscribe(self, node, name, function):
        """Calls the function with each new value. Returns the subscription's number."""
        with self._property(node, name) as handle:
            number = self._c.vs_property_subscribe(self._s, handle, self._callback(function), None)
        self._check(number)
        return number

    def unsubscribe(self, node, name, number):
        with self._property(node, name) as handle:
            self._do(self._c.vs_property_unsubscribe, handle, number)

    def post(self, node, name, value):
        """Posts a change for the next update, also while the interpreter runs."""
        with self._property(node, name) as handle:
            given = self._give(value)
            fine = self._c.vs_post(self._s, handle, given)
            self._c.vs_handle_release(self._s, given)
        self._check(fine)

    def update(self):
        self._do(self._c.vs_update)

    def frame(self, seconds):
        self._do(self._c.vs_scene_frame, seconds)

    def action(self, name, node):
        """Runs the action in the tree from the node down."""
        self._do(self._c.vs_action_apply, _name(name), node.handle)

    def gizmos(self):
        """Returns all gizmos below the root. Their values are their nodes' properties "value": put, get, subscribe."""
        found = []

        def take(_, scheme, pointer):
            g = pointer.contents
            several = g.value_count == 3
            value, low, high = (numpy.array(x) if several else x[0] for x in (g.value, g.low, g.high))
            handles, axes = (numpy.array(x)[:g.handle_count] for x in (g.handles, g.axes))
            found.append(Gizmo(self._borrowed(g.node), _GIZMOS[g.kind], numpy.array(g.at), g.size, value, low, high,
                               g.step, handles, axes))
            return True
        self._do(self._c.vs_gizmos, c.GizmoFn(take), None)
        return found

    def input(self, kind, button="none", start=None, direction=None, key=None):
        """An event: "press", "drag", "release" or "move" of a button, with the ray under the mouse; or "key".
        Returns the node that received it, or None."""
        if kind not in _INPUTS or button not in _BUTTONS:
            raise SchemeError("an event is one of %s with a button of %s, got %r and %r" % (
                ", ".join(_INPUTS), ", ".join(_BUTTONS), kind, button), outcome=2)
        ray = [(c_double * 3)(*v) if v is not None else None for v in (start, direction)]
        node = c.Handle(0)
        self._do(self._c.vs_input, _INPUTS.index(kind), _BUTTONS.index(button), *ray, _name(key) if key else None,
                 byref(node))
        return self._take(node.value) if node.value else None

    def pick(self, start, direction):
        """Returns the hits of the ray, nearest first."""
        hits = []

        def take(_, scheme, pointer):
            h = pointer.contents
            hits.append(Hit(h.distance, numpy.array(h.point), self._borrowed(h.node), self._borrowed(h.path),
                            _text(h.file), h.line, h.column))
            return True
        self._do(self._c.vs_pick, (c_double * 3)(*start), (c_double * 3)(*direction), c.HitFn(take), None)
        return hits
