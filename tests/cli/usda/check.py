# Reads a .usda file: braces, names, paths, lists; prints prims by type, layers, and the volume of what is placed.
import math, re, sys
text = open(sys.argv[1], encoding='utf-8').read()
token = re.compile(r'"(?:\\.|[^"\\\n])*"|<[^>\n]*>|[-+]?[0-9.]+(?:e[-+]?[0-9]+)?|[A-Za-z_][A-Za-z0-9_:.]*|\[\]|[()\[\]{}=,]|\n')
assert text.startswith('#usda 1.0\n'), 'no usda'
at, tokens = len('#usda 1.0'), []
while at < len(text):
    if text[at] == ' ': at += 1; continue
    found = token.match(text, at)
    assert found, 'strange text at %r' % text[at:at + 40]
    tokens.append(found.group()); at = found.end()
k = 0
def peek():
    global k
    while tokens[k] == '\n': k += 1
    return tokens[k]
def take(wanted=None):
    global k
    t = peek(); k += 1
    assert wanted is None or t == wanted, (wanted, t, k)
    return t
def value():
    t = take()
    if t in '([':
        close, items = ')' if t == '(' else ']', []
        while peek() != close:
            items.append(value())
            if peek() == ',': take(',')
        take(close)
        return items
    return [] if t == '[]' else float(t) if re.match(r'[-+]?[0-9.]', t) else t
def notes():  # each on a line of its own
    made = {}
    if peek() != '(': return made
    take('(')
    while peek() != ')':
        word = take()
        if word == 'prepend': word = take()
        take('='); made[word] = value()
        assert tokens[k] == '\n' or peek() == ')', 'two notes on a line'
    take(')')
    return made
prims = {}
def prim(path, sort):
    kind = take() if not peek().startswith('"') else ''
    name = take()[1:-1]
    assert re.fullmatch('[A-Za-z_][A-Za-z0-9_]*', name), name
    own = path + '/' + name
    assert own not in prims, 'twice: ' + own
    p = prims[own] = {'sort': sort, 'type': kind, 'notes': notes(), 'fields': {}, 'children': []}
    take('{')
    while peek() != '}':
        t = take()
        if t in ('def', 'class'): p['children'].append(prim(own, t)); continue
        words = [t]
        while tokens[k] not in ('=', '\n'): words.append(take())
        if tokens[k] != '\n':
            take('='); p['fields'][words[-1]] = value()
            if peek() == '(': notes()
    take('}')
    return own
head = notes()
while k < len(tokens) and any(t != '\n' for t in tokens[k:]): prim('', take())
for own, p in prims.items():
    for name in ('material:binding', 'outputs:surface.connect'):
        if name in p['fields']: assert p['fields'][name][1:-1].split('.')[0] in prims, (own, name)
    if 'inherits' in p['notes']: assert prims[p['notes']['inherits'][1:-1]]['sort'] == 'class', own
def times(a, b): return [[sum(a[i][n] * b[n][j] for n in range(4)) for j in range(4)] for i in range(4)]
one = [[float(i == j) for j in range(4)] for i in range(4)]
def det(m): return (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]))
count, volume, layers = {}, 0, set()
def walk(own, m):
    global volume
    p = prims[own]; f = p['fields']
    if 'xformOp:transform' in f:
        assert f['xformOpOrder'] == ['"xformOp:transform"']
        m = times(f['xformOp:transform'], m)
    kind = p['type']
    if kind not in ('Scope', 'Material', 'Shader', 'GeomSubset', 'Xform'): count[kind] = count.get(kind, 0) + 1
    if kind == 'Xform' and 'displayName' in p['notes'] and own != '/Model': layers.add(p['notes']['displayName'])
    size = abs(det(m))
    if kind == 'Cube': volume += size * f['size'] ** 3
    if kind == 'Sphere': volume += size * 4 / 3 * math.pi * f['radius'] ** 3
    if kind == 'Cylinder': volume += size * math.pi * f['radius'] ** 2 * f['height']
    if kind == 'Cone': volume += size / 3 * math.pi * f['radius'] ** 2 * f['height']
    if kind == 'Mesh':
        points, index = f['points'], [int(i) for i in f['faceVertexIndices']]
        assert set(f['faceVertexCounts']) == {3} and len(index) == 3 * len(f['faceVertexCounts']) and max(index) < len(points)
        if 'normals' in f: assert len(f['normals']) == len(index)
        used = [i for c in p['children'] for i in prims[c]['fields']['indices']]
        assert len(set(used)) == len(used) and all(3 * i < len(index) for i in used)
        own_volume = 0
        for i in range(0, len(index), 3):
            a, b, c = (points[j] for j in index[i:i + 3])
            own_volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        volume += size * own_volume
    if 'inherits' in p['notes']: walk(p['notes']['inherits'][1:-1], m)
    for c in p['children']:
        if prims[c]['sort'] == 'def': walk(c, m)
walk('/Model', one)
print(head['metersPerUnit'], head['upAxis'], sorted(count.items()), sorted(layers), 'volume %.5g' % volume)
