"""Owns the proof that the Python package and visualscheme.h agree: each function of the header is called or left out
for a written reason, and each structure is as large as the compiler's. `python_covers.py sizes` writes the C program that
prints the sizes; `python_covers.py DECLARED SIZES` compares with the header's functions and with what it printed."""
import ctypes
import sys

from visualscheme import _library as library


def told(what, faults):
    print(("not ok" if faults else "ok") + " embed:python " + what)
    for fault in faults:
        print("    " + fault)
    return bool(faults)


if sys.argv[1] == "sizes":
    print("#include <stdio.h>\n#include <visualscheme.h>\nint main(void) {")
    for name in sorted(library.STRUCTURES):
        print('  printf("%s %%zu\\n", sizeof(%s));' % (name, name))
    print("}")
    raise SystemExit
with open(sys.argv[1]) as lines:
    declared = set(lines.read().split())
with open(sys.argv[2]) as lines:
    sizes = {name: int(size) for name, size in (line.split() for line in lines)}
bound, left = set(library._FUNCTIONS), [name for names in library.LEFT_OUT.values() for name in names.split()]
bad = told("has all functions, or a reason",
           [name + ": not in _FUNCTIONS or LEFT_OUT" for name in sorted(declared - bound - set(left))])
bad |= told("has no others", [name + ": not in visualscheme.h" for name in sorted((bound | set(left)) - declared)])
bad |= told("has each once", [name + ": listed twice" for name in left if name in bound or left.count(name) > 1])
bad |= told("structures", ["%s: %d bytes, the compiler has %d" % (name, ctypes.sizeof(kind), sizes[name])
                           for name, kind in library.STRUCTURES.items() if ctypes.sizeof(kind) != sizes[name]])
raise SystemExit(bad)
