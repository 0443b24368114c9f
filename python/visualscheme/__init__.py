"""Models in VisualScheme run from Python: programs, values, the scene, and meshes as NumPy arrays.

    import visualscheme
    with visualscheme.Scheme() as s:
        s.run("(draw (make-sphere (xyz 0 0 0) 1))")
        for mesh in s.meshes():
            print(mesh.points.shape, mesh.triangles.shape)
"""
import ctypes
from collections import namedtuple
from ctypes import byref, c_double

import numpy

from . import _library as c

__all__ = ["Scheme", "SchemeError", "Value", "Symbol", "Mesh", "Part", "Hit"]

Part = namedtuple("Part", "material color painted roughness metallic ior layer file line column")
Hit = namedtuple("Hit", "distance point node file line column")
# change: "removed", "changed" or "added". points (n, 3), triangles (m, 3), normals (k, 3), normal_corners (m, 3); parts, and
# in part_of the number of each triangle's, or None; places (p, 3, 4), from the mesh's coordinates to the drawing's. All
# arrays are Python's own.
Mesh = namedtuple("Mesh", "change id points triangles normals normal_corners parts part_of places")

_NONE, _BOOLEAN, _NUMBER, _TEXT, _SYMBOL, _LIST, _POINT, _VECTOR, _MATRIX = range(9)
_CHANGES = ("removed", "changed", "added")


class SchemeError(Exception):
    """A program or a call was at fault: message; file, line, column (None, 0, 0: nowhere); outcome, the exit code."""

    def __init__(self, message, file=None, line=0, column=0, outcome=1):
        place = "%s:%d:%d: " % (file, line, column) if file else ""
        super().__init__(place + message)
        self.message, self.file, self.line, self.column, self.outcome = message, file, line, column, outcome


class Symbol(str):
    """A symbol of the language, where a str is a text."""


class Value:
    """A value that has no like in Python: an object, a node, a procedure; held as long as this is."""

    def __init__(self, scheme, handle):
        self._scheme, self.handle = scheme, handle

    def __del__(self):
        if self._scheme._s:
            self._scheme._c.vs_handle_release(self._scheme._s, self.handle)

    def __call__(self, *arguments):
        return self._scheme._apply(self.handle, arguments)

    def __eq__(self, other):
        return isinstance(other, Value) and self._scheme is other._scheme and self._scheme._c.vs_handle_same(
            self._scheme._s, self.handle, other.handle)

    __hash__ = None


def _text(bytes_or_none):
    return bytes_or_none.decode() if bytes_or_none is not None else None


def _array(pointer, rows, width, kind):
    if not rows:
        return numpy.empty((0, width), kind)
    return numpy.ctypeslib.as_array(pointer, (rows * width,)).reshape(rows, width).astype(kind, copy=True)


class Scheme:
    """An interpreter. Used by one thread at a time; `with` ends it."""

    def __init__(self, output=None, limit_time=0.0, limit_memory=0, limit_steps=0, untrusted=False):
        self._s, self._c = None, c.load()
        self._errors, self._kept, self.warnings = [], [], []
        self._output = output
        options = self._c.vs_options_default()
        self._host = (c.OutputFn(self._print), c.DiagnoseFn(self._diagnose))
        options.host.output, options.host.diagnose = self._host
        options.limit_time, options.limit_memory, options.limit_steps = limit_time, limit_memory, limit_steps
        options.untrusted = untrusted
        self._s = self._c.vs_new(byref(options))
        if not self._s:
            raise MemoryError("no interpreter")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        if self._s:
            self._c.vs_free(self._s)
            self._s = None

    __del__ = close

    # ---- what the library calls ----

    def _print(self, _, text, count):
        if self._output:
            self._output(ctypes.string_at(text, count).decode("utf-8", "replace"))
        return True

    def _diagnose(self, _, pointer):
        d = pointer.contents
        error = SchemeError(_text(d.message), _text(d.at.file), d.at.line, d.at.column, d.outcome)
        (self._errors if d.severity == 0 else self.warnings).append(error)

    def _check(self, fine, outcome=2):
        """The first error that was told since the last call, where the call was not fine."""
        errors, self._errors = self._errors, []
        if not fine:
            raise errors[0] if errors else SchemeError("the call failed", outcome=outcome)

    # ---- values ----

    def _give(self, value):
        """A new handle to the value."""
        f, s = self._c, self._s
        if isinstance(value, Value):
            handle = f.vs_handle_retain(s, value.handle)
        elif isinstance(value, (bool, numpy.bool_)):
            handle = f.vs_handle_boolean(s, bool(value))
        elif isinstance(value, (int, numpy.integer)):
            handle = f.vs_handle_integer(s, int(value))
        elif isinstance(value, (float, numpy.floating)):
            handle = f.vs_handle_number(s, float(value))
        elif isinstance(value, Symbol):
            handle = f.vs_handle_symbol(s, value.encode())
        elif isinstance(value, str):
            handle = f.vs_handle_text(s, value.encode())
        elif isinstance(value, numpy.ndarray) and value.shape == (3,):
            handle = f.vs_handle_point(s, *(float(x) for x in value))
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
        """The value of a handle, which is released or goes over to a Value."""
        f, s = self._c, self._s
        kind = f.vs_handle_kind_of(s, handle)
        if kind > _MATRIX:
            return Value(self, handle)
        numbers = (c_double * 16)()
        count = f.vs_handle_get_numbers(s, handle, numbers, 16)
        if kind == _BOOLEAN:
            value = f.vs_handle_get_boolean(s, handle)
        elif kind == _NUMBER:
            value = numbers[0]
        elif kind in (_TEXT, _SYMBOL):
            value = (str if kind == _TEXT else Symbol)(_text(f.vs_handle_get_text(s, handle)))
        elif kind == _LIST:
            value = [self._take(f.vs_handle_item(s, handle, i)) for i in range(f.vs_handle_count(s, handle))]
        else:
            value = numpy.array(numbers[:count])
            if kind == _MATRIX:
                value = value.reshape(4, 4)
        f.vs_handle_release(s, handle)
        return value

    def _borrowed(self, handle):
        return self._take(self._c.vs_handle_retain(self._s, handle))

    def _apply(self, procedure, arguments):
        handles = [self._give(a) for a in arguments]
        result = c.Handle(0)
        outcome = self._c.vs_apply(self._s, procedure, (c.Handle * len(handles))(*handles), len(handles), byref(result))
        for handle in handles:
            self._c.vs_handle_release(self._s, handle)
        self._check(outcome == 0, outcome)
        return self._take(result.value)

    # ---- programs ----

    def run(self, text, name="python"):
        """Every form of the text."""
        data = text.encode()
        outcome = self._c.vs_eval_text(self._s, name.encode(), 1, data, len(data), 0)
        self._check(outcome == 0, outcome)

    def run_file(self, path):
        outcome = self._c.vs_eval_file(self._s, str(path).encode(), 0)
        self._check(outcome == 0, outcome)

    def __getitem__(self, name):
        """What the name means in the program: a value, or a Value to call."""
        handle = self._c.vs_lookup(self._s, name.encode())
        self._check(handle)
        return self._take(handle)

    def __setitem__(self, name, value):
        """Defines the name; a Python function becomes a procedure."""
        handle = self._procedure(name, value) if callable(value) and not isinstance(value, Value) else self._give(value)
        fine = self._c.vs_define(self._s, name.encode(), handle)
        self._c.vs_handle_release(self._s, handle)
        self._check(fine)

    def call(self, name, *arguments):
        handle = self._c.vs_lookup(self._s, name.encode())
        self._check(handle)
        try:
            return self._apply(handle, arguments)
        finally:
            self._c.vs_handle_release(self._s, handle)

    def _callback(self, function):
        def called(_, scheme, arguments, count, result):
            try:
                value = function(*[self._borrowed(arguments[i]) for i in range(count)])
                if value is not None:
                    result[0] = self._give(value)
                return True
            except Exception as error:  # Python's error becomes the program's
                self._c.vs_host_fail(self._s, str(error).encode())
                return False
        kept = c.HostFn(called)
        self._kept.append(kept)  # the library calls it as long as the interpreter lives
        return kept

    def _procedure(self, name, function):
        handle = self._c.vs_host_procedure(self._s, name.encode(), self._callback(function), None)
        self._check(handle)
        return handle

    def parameter(self, name, value):
        """Sets a parameter of the next run, as -D does."""
        self._check(self._c.vs_parameter_set(self._s, name.encode(), str(value).encode()))

    def clear(self):
        self._c.vs_drawing_clear(self._s)

    def write(self, path, format=None):
        outcome = self._c.vs_write_drawing(self._s, str(path).encode(), format.encode() if format else None, None)
        self._check(outcome == 0, outcome)

    # ---- meshes ----

    def meshes(self):
        """What differs from what was handed over before: Mesh after Mesh."""
        outcome = self._c.vs_meshes_begin(self._s, None)
        errors, self._errors = self._errors, []
        info, found = c.MeshInfo(), []
        while self._c.vs_mesh_next(self._s, byref(info)):
            found.append(self._mesh(info))
        if outcome and not found:
            raise errors[0] if errors else SchemeError("the meshes could not be made", outcome=outcome)
        return found

    def forget_meshes(self):
        self._c.vs_meshes_forget(self._s)

    @staticmethod
    def _mesh(m):
        parts = [Part(_text(p.material), tuple(p.color), p.painted, p.roughness, p.metallic, p.ior, _text(p.layer),
                      _text(p.file), p.line, p.column) for p in m.parts[:m.part_count]] if m.part_count else []
        part_of = _array(m.part_of, m.triangle_count, 1, numpy.uint32)[:, 0] if m.part_of else None
        return Mesh(_CHANGES[m.change], m.id, _array(m.points, m.point_count, 3, numpy.float64),
                    _array(m.corners, m.triangle_count, 3, numpy.uint32),
                    _array(m.normals, m.normal_count, 3, numpy.float64),
                    _array(m.normal_corners, m.triangle_count, 3, numpy.uint32), parts, part_of,
                    _array(m.places, m.place_count, 12, numpy.float64).reshape(-1, 3, 4))

    # ---- the scene ----

    @property
    def root(self):
        return self._take(self._c.vs_node_root(self._s))

    def node(self, name=None, parent=None, drawing=None, translate=None, rotate=None, scale=None):
        """A new node; degrees about X, Y and Z."""
        handle = self._c.vs_node_create(self._s, None, name.encode() if name else None, parent.handle if parent else 0)
        self._check(handle)
        node = self._take(handle)
        if drawing is not None:
            self.draw(node, drawing)
        self.place(node, translate, rotate, scale)
        return node

    def find(self, name):
        handle = self._c.vs_node_find(self._s, name.encode())
        return self._take(handle) if handle else None

    def draw(self, node, drawing):
        self.call("node-setdrawing", node, drawing)

    def place(self, node, translate=None, rotate=None, scale=None):
        three = [(c_double * 3)(*v) if v is not None else None for v in (translate, rotate, scale)]
        outcome = self._c.vs_node_place(self._s, node.handle, *three)
        self._check(outcome == 0, outcome)

    def matrix(self, node, world=True):
        out = (c_double * 16)()
        self._check(self._c.vs_node_matrix(self._s, node.handle, world, out))
        return numpy.array(out).reshape(4, 4)

    def get(self, node, name):
        value = c.Handle(0)
        outcome = self._c.vs_property_get(self._s, node.handle, name.encode(), byref(value))
        self._check(outcome == 0, outcome)
        return self._take(value.value)

    def put(self, node, name, value):
        handle = self._give(value)
        outcome = self._c.vs_property_put(self._s, node.handle, name.encode(), handle)
        self._c.vs_handle_release(self._s, handle)
        self._check(outcome == 0, outcome)

    def subscribe(self, node, name, function):
        """The function is called with each new value. Gives the subscription's number."""
        handle = self._c.vs_property_of(self._s, node.handle, name.encode())
        self._check(handle)
        number = self._c.vs_property_subscribe(self._s, handle, self._callback(function), None)
        self._c.vs_handle_release(self._s, handle)
        self._check(number)
        return number

    def post(self, node, name, value):
        """Leaves a change for the next update; also where the interpreter is at work."""
        raise_after = self._c.vs_property_of(self._s, node.handle, name.encode())
        self._check(raise_after)
        handle = self._give(value)
        fine = self._c.vs_post(self._s, raise_after, handle)
        for held in (handle, raise_after):
            self._c.vs_handle_release(self._s, held)
        self._check(fine)

    def update(self):
        outcome = self._c.vs_update(self._s)
        self._check(outcome == 0, outcome)

    def frame(self, seconds):
        outcome = self._c.vs_scene_frame(self._s, seconds)
        self._check(outcome == 0, outcome)

    def pick(self, start, direction):
        """What the ray meets, nearest first."""
        hits = []

        def take(_, scheme, pointer):
            h = pointer.contents
            hits.append(Hit(h.distance, numpy.array(h.point), self._borrowed(h.node), _text(h.file), h.line, h.column))
            return True
        outcome = self._c.vs_pick(self._s, (c_double * 3)(*start), (c_double * 3)(*direction), c.HitFn(take), None)
        self._check(outcome == 0, outcome)
        return hits
