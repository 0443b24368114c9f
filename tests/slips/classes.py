"""Owns the classes of slips that the tables of the language give: a slip for each row of bind/procedures.def,
tests/slips/names.def and backends/backends.def. A new row joins by itself.

Each class returns lines of a program, and what the answer to each must contain. They are typed at the prompt, which
goes on after an error; vs check reads them as one program."""

import os
import re

# An argument for each contract of bind/call/contracts.def; a contract without one leaves its rows out.
SAMPLES = {
    "REAL": "2.5", "RADIUS": "1.5", "POSITIVE": "2.5", "ANGLE": "0.5", "DEGREES": "30", "UNIT": "0.5", "SOME": "3",
    "NATURAL": "3", "SIDES": "6", "SEGMENTS": "12", "BOOLEAN": "#t", "TEXT": '"north"', "POINT": "(xyz 1 2 3)",
    "VECTOR": "(vxyz 1 2 3)", "DIRECTION": "(vxyz 0 0 1)", "AXIS": "(make-axis (xyz 0 0 0) (vxyz 0 0 1))",
    "PLANE": "(make-plane (xyz 0 0 0) (vxyz 0 0 1))", "MATRIX": "(translation-matrix (vxyz 1 0 0))", "FACTOR": "2.5",
    "OBJECT": "(make-box (xyz 0 0 0) 1 1 1)", "OBJECTS": "(make-box (xyz 0 0 0) 1 1 1)",
    "CURVE": "(make-circle (xyz 3 0 0) 1)", "CURVES": "(make-circle (xyz 3 0 0) 1)",
    "PROFILE": "(make-circle (xyz 3 0 0) 1)", "FLAT": "(make-circle (xyz 3 0 0) 1)",
    "SOLID": "(make-box (xyz 0 0 0) 1 1 1)", "MATERIAL": "'steel", "COLOR": '"red"',
    "POINTS": "(list (xyz 0 0 0) (xyz 1 0 0) (xyz 0 1 0))",
}


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read()


def procedures(root):
    """The rows with one form whose arguments are all required: (name, [(parameter, contract) ...])."""
    for row in re.findall(r'^PROC\((.*?)\n?(?=^PROC|^PROCS|^/\*|\Z)', read(root, "bind/procedures.def"), re.M | re.S):
        names = re.match(r'\w+,\s*"([^"]+)"', row)
        forms = re.findall(r'FORM\(((?:[^()]|\([^()]*\))*)\)', row)
        if not names or len(forms) != 1 or "OPT(" in forms[0] or "REST(" in forms[0]:
            continue
        name = names.group(1).split()[0]
        if not name.startswith("%"):
            yield name, re.findall(r'ARG\("([^"]+)",\s*(\w+)\)', forms[0])


def swapped(root):
    """Two neighbouring arguments of different kinds, the wrong way round."""
    for name, parameters in procedures(root):
        values = [SAMPLES.get(contract) for _, contract in parameters]
        if None in values or not 2 <= len(values) <= 5:
            continue
        for i in range(len(values) - 1):
            if values[i] == values[i + 1]:
                continue
            other = values[:i] + [values[i + 1], values[i]] + values[i + 2:]
            order = re.escape("the order is (" + " ".join([name] + [p for p, _ in parameters]) + ")")
            yield f"({name} {' '.join(other)})", order


def short(root):
    """The last argument is missing."""
    for name, parameters in procedures(root):
        values = [SAMPLES.get(contract) for _, contract in parameters]
        if None not in values and len(values) > 1 and name != "xyz" and name != "vxyz":
            yield f"({name} {' '.join(values[:-1])})", r"[ (]" + re.escape(" ".join(p for p, _ in parameters) + ")")


def stems(root):
    """Names of constructors as other languages write them."""
    names = sorted({name for name, _ in procedures(root) if re.fullmatch(r"make-[a-z]+(-[a-z]+)*", name)})
    for name in names:
        stem = name[5:]
        if stem.startswith("e-"):
            continue  # makeECone: the e of e-cone is no word
        camel = "".join(part.capitalize() for part in stem.split("-"))
        for wrong in (f"make{camel}", f"Make{camel}", f"make_{stem.replace('-', '_')}", f"create-{stem}", name[:-1], name + "e"):
            yield f"({wrong} 1 2 3)", re.escape(name) + "|is the name here"


def foreign(root):
    """Names of other languages: an answer with the name here, or a name that is there."""
    for language, names in re.findall(r'^NAMES\("([^"]*)", "([^"]*)"\)', read(root, "tests/slips/names.def"), re.M):
        for name in names.split():
            yield f"(list {name})", r"; |is syntax and has no value|a comma|belongs|^$"


# A value of each kind, to put in the place of another.
OTHERS = ["7.5", '"abc"', "'abc", "(xyz 1 2 3)", "(vxyz 1 2 3)", "(make-box (xyz 0 0 0) 1 1 1)", "(list 1 2 3)", "#f",
          "(make-circle (xyz 0 0 0) 1)"]


def kinds(root):
    """A value of another kind for one argument: the answer says what to write, or has it in the name of the kind."""
    for name, parameters in procedures(root):
        values = [SAMPLES.get(contract) for _, contract in parameters]
        if None in values:
            continue
        for i in range(len(values)):
            for other in OTHERS:
                call = " ".join([name] + values[:i] + [other] + values[i + 1:])
                yield f"({call})", r"; |\?\), got|one of|'x, 'y, 'z|'xy, 'yz, 'xz|colour must be|^((?!must be).)*$|last row must|must be (at most|from|another|three)|name that ends|each written|that does not|off the line"


CLASSES = {"a value of another kind": (kinds, True), "swapped arguments": (swapped, True), "a missing argument": (short, True),
           "names of constructors": (stems, True), "names of other languages": (foreign, False)}
