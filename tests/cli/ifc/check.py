# Reads an .ifc file: syntax, references, numbers of attributes, ids; prints elements by storey, and the volume of all bodies.
import math, re, sys
text = open(sys.argv[1], encoding='ascii').read()
head, _, data = text.partition('DATA;\n')
assert head.startswith("ISO-10303-21;\nHEADER;\n") and "FILE_SCHEMA(('IFC4'))" in head and data.endswith('ENDSEC;\nEND-ISO-10303-21;\n')
token = re.compile(r"'(?:[^']|'')*'|#\d+|\.[A-Z_0-9]+\.|[-+]?\d+\.?\d*(?:E[-+]?\d+)?|[A-Z0-9_]+|[$*(),=;]|\n")
at, tokens, data = 0, [], data[:-len('ENDSEC;\nEND-ISO-10303-21;\n')]
while at < len(data):
    found = token.match(data, at)
    assert found, 'strange text at %r' % data[at:at + 40]
    if found.group() != '\n': tokens.append(found.group())
    at = found.end()
k = 0
def take(wanted=None):
    global k
    t = tokens[k]; k += 1
    assert wanted is None or t == wanted, (wanted, t, tokens[k - 8:k + 4])
    return t
def value():
    t = take()
    if t == '(':
        items = []
        while tokens[k] != ')':
            items.append(value())
            if tokens[k] == ',': take(',')
        take(')')
        return items
    if tokens[k] == '(': return value()  # IFCLENGTHMEASURE(...)
    return t
things = {}
while k < len(tokens):
    number = take(); assert number[0] == '#' and number not in things, number
    take('='); kind = take(); things[number] = (kind, value()); take(';')
# the numbers of attributes in IFC 4 (ISO 16739)
counts = dict(IFCSIUNIT=4, IFCUNITASSIGNMENT=1, IFCCARTESIANPOINT=1, IFCDIRECTION=1, IFCAXIS2PLACEMENT3D=3, IFCLOCALPLACEMENT=2,
    IFCGEOMETRICREPRESENTATIONCONTEXT=6, IFCGEOMETRICREPRESENTATIONSUBCONTEXT=10, IFCCARTESIANTRANSFORMATIONOPERATOR3D=5,
    IFCPROJECT=9, IFCSITE=14, IFCBUILDING=12, IFCBUILDINGSTOREY=10, IFCRELAGGREGATES=6, IFCRELCONTAINEDINSPATIALSTRUCTURE=6,
    IFCRELASSOCIATESMATERIAL=6, IFCMATERIAL=3, IFCCARTESIANPOINTLIST2D=1, IFCCARTESIANPOINTLIST3D=1, IFCTRIANGULATEDFACESET=5,
    IFCINDEXEDPOLYCURVE=3, IFCARBITRARYCLOSEDPROFILEDEF=3, IFCARBITRARYPROFILEDEFWITHVOIDS=4, IFCCIRCLEPROFILEDEF=4,
    IFCEXTRUDEDAREASOLID=4, IFCSHAPEREPRESENTATION=4, IFCREPRESENTATIONMAP=2, IFCMAPPEDITEM=2, IFCPRODUCTDEFINITIONSHAPE=3,
    IFCCOLOURRGB=4, IFCSURFACESTYLESHADING=2, IFCSURFACESTYLE=3, IFCSTYLEDITEM=3, IFCDIMENSIONALEXPONENTS=7,
    IFCMEASUREWITHUNIT=2, IFCCONVERSIONBASEDUNIT=4, IFCDOOR=13, IFCWINDOW=13)
elements = 'CURTAINWALL FOOTING RAILING STAIR RAMP COLUMN BEAM MEMBER ROOF COVERING SLAB WALL PLATE FURNITURE BUILDINGELEMENTPROXY'.split()
counts.update({'IFC' + e: 9 for e in elements})
def refs(v): return [v] if isinstance(v, str) and v[0] == '#' else [r for x in v for r in refs(x)] if isinstance(v, list) else []
ids = set()
for number, (kind, v) in things.items():
    assert len(v) == counts[kind], (number, kind, len(v))
    for r in refs(v): assert r in things, (number, r)
    if kind.startswith('IFCREL') or len(v) >= 9 and kind not in ('IFCGEOMETRICREPRESENTATIONSUBCONTEXT',):
        assert re.fullmatch("'[0-3][0-9A-Za-z_$]{21}'", v[0]) and v[0] not in ids, v[0]
        ids.add(v[0])
styled = [v[0] for kind, v in things.values() if kind == 'IFCSTYLEDITEM']
assert len(styled) == len(set(styled)), 'an item has two styles'
def points(n): return [[float(x) for x in p] for p in things[n][1][0]]
def area(curve):
    p = points(things[curve][1][0])
    return abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(p, p[1:]))) / 2
def volume(n):
    kind, v = things[n]
    if kind == 'IFCMAPPEDITEM': return sum(map(volume, things[things[v[0]][1][1]][1][3]))
    if kind == 'IFCEXTRUDEDAREASOLID':
        sort, p = things[v[0]]
        flat = math.pi * float(p[3]) ** 2 if sort == 'IFCCIRCLEPROFILEDEF' else area(p[2]) - sum(map(area, p[3] if len(p) > 3 else []))
        return flat * float(v[3]) * abs(float(things[v[2]][1][0][2]))
    at, total = points(v[0]), 0
    for t in v[3]:
        a, b, c = (at[int(i) - 1] for i in t)
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total
def place(n):  # the height of a placement
    v = things[n][1]
    return float(things[things[v[1]][1][0]][1][0][2]) + (place(v[0]) if v[0] != '$' else 0)
total, seen = 0, 0
for kind, v in things.values():
    if kind != 'IFCRELCONTAINEDINSPATIALSTRUCTURE': continue
    listed = {}
    for e in v[4]:
        sort, a = things[e]
        shape = things[things[a[6]][1][2][0]][1]
        total += sum(map(volume, shape[3])); seen += 1
        listed.setdefault((sort, a[2], shape[2]), []).append(round(place(a[5]), 3))
    print(things[v[5]][1][2], sorted(listed.items()))
assert seen == sum(kind == 'IFC' + e or kind in ('IFCDOOR', 'IFCWINDOW') for kind, _ in things.values() for e in elements[:1]) + sum(kind in ['IFC' + e for e in elements[1:]] for kind, _ in things.values())
print('materials', sorted((things[v[5]][1][0], len(v[4])) for kind, v in things.values() if kind == 'IFCRELASSOCIATESMATERIAL'), 'volume %.6g' % total)
