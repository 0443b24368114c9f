# writes models as other programs do: .glb with strips, fans, small numbers and matrices; .3mf in parts; broken ones
import json, struct, zipfile
def glb(name, data, binary=b'', magic=b'glTF', version=2, cut=0):
    text = data if isinstance(data, bytes) else json.dumps(data).encode()
    text += b' ' * (-len(text) % 4); binary += b'\0' * (-len(binary) % 4)
    body = struct.pack('<I4s', len(text), b'JSON') + text + struct.pack('<I4s', len(binary), b'BIN\0') + binary
    whole = struct.pack('<4sII', magic, version, 12 + len(body)) + body
    open(name, 'wb').write(whole[:len(whole) - cut])
corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
cube = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5]
floats = b''.join(struct.pack('<3f', *p) for p in corners)                # 0: 96 bytes
bytes3 = b''.join(struct.pack('<4B', *[255 * c for c in p], 0) for p in corners)  # 96: 32 bytes, stride 4
small = bytes(cube)                                                        # 128: 36 bytes
strip = struct.pack('<4H', 0, 1, 2, 3)                                     # 164: 8 bytes
fan = struct.pack('<4I', 0, 1, 3, 2)                                       # 172: 16 bytes
views = [(0, 96, 0), (96, 32, 4), (128, 36, 0), (164, 8, 0), (172, 16, 0)]
accessors = [(0, 5126, 8, 'VEC3', 0), (1, 5121, 8, 'VEC3', 0), (2, 5121, 36, 'SCALAR', 0), (3, 5123, 4, 'SCALAR', 0),
             (4, 5125, 4, 'SCALAR', 0), (2, 5121, 12, 'SCALAR', 0), (2, 5121, 24, 'SCALAR', 12)]
def model():
    return {
        'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0, 1, 2, 3, 4, 5]}],
        'buffers': [{'byteLength': 188}],
        'bufferViews': [dict({'buffer': 0, 'byteOffset': o, 'byteLength': n}, **({'byteStride': s} if s else {})) for o, n, s in views],
        'accessors': [dict({'bufferView': v, 'componentType': t, 'count': c, 'type': k, 'byteOffset': o}, **({'normalized': True} if t == 5121 and k == 'VEC3' else {}))
                      for v, t, c, k, o in accessors],
        'materials': [{'name': 'tin', 'pbrMetallicRoughness': {'baseColorFactor': [.5, .5, .5, 1], 'roughnessFactor': .25}},
                      {'pbrMetallicRoughness': {'baseColorFactor': [1, 0, 0, .6]}, 'alphaMode': 'BLEND'}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 2, 'material': 0}]},
                   {'primitives': [{'attributes': {'POSITION': 1}, 'indices': 2}]},
                   {'primitives': [{'attributes': {'POSITION': 0}, 'indices': 3, 'mode': 5}]},
                   {'primitives': [{'attributes': {'POSITION': 0}, 'indices': 4, 'mode': 6, 'material': 1}]},
                   {'primitives': [{'attributes': {'POSITION': 0}, 'indices': 5, 'material': 1}, {'attributes': {'POSITION': 0}, 'indices': 6, 'material': 0}]},
                   {'primitives': [{'attributes': {'POSITION': 0}, 'indices': 4, 'mode': 2}, {'attributes': {'POSITION': 0}, 'indices': 3, 'mode': 1}, {'attributes': {'POSITION': 0}, 'mode': 0}]}],
        'nodes': [{'name': 'cube', 'mesh': 0, 'matrix': [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1]},
                  {'name': 'group', 'scale': [1, 1, -1], 'children': [6, 7]},
                  {'mesh': 2}, {'mesh': 3, 'translation': [0, 5, 0]}, {'name': 'two-tone', 'mesh': 4, 'rotation': [0, 0, .5, .75 ** .5]}, {'name': 'lines', 'mesh': 5},
                  {'mesh': 1}, {'name': 'own', 'mesh': 1, 'translation': [3, 0, 0]}]}
binary = floats + bytes3 + small + strip + fan
glb('foreign.glb', model(), binary)
def broken(n, change, **how):
    m = model(); change(m); glb('b%d.glb' % n, m, how.pop('binary', binary), **how)
broken(1, lambda m: m['nodes'][0].update(children=[1]))
broken(2, lambda m: m['nodes'][6].update(mesh=99))
broken(3, lambda m: m['accessors'][0].update(count=9))
broken(5, lambda m: m['accessors'][0].update(count=3))
broken(6, lambda m: m.update(extensionsRequired=['KHR_draco_mesh_compression']))
broken(7, lambda m: m['bufferViews'][0].update(buffer=1))
broken(8, lambda m: m['nodes'][0].update(matrix=[1]))
broken(9, lambda m: m['accessors'][0].update(sparse={}))
broken(10, lambda m: m, cut=9)
broken(11, lambda m: m, magic=b'glTg')
broken(12, lambda m: m, version=1)
glb('b13.glb', b'{"asset": [', binary)
open('b4.glb', 'wb').write(b'glTF' + struct.pack('<III', 2, 5, 200000000) + b'JSON{}  ')  # shorter than its head, it says
broken(14, lambda m: m, binary=struct.pack('<f', float('nan')) + binary[4:])
def mf(name, parts, cut=0):
    with zipfile.ZipFile('whole.zip', 'w', zipfile.ZIP_DEFLATED) as z:
        for part, text in parts.items(): z.writestr(part, text)
    whole = open('whole.zip', 'rb').read()
    open(name, 'wb').write(whole[:len(whole) - cut])
rels = '<Relationships><Relationship Target="/3D/a.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
mesh = '<mesh><vertices>%s</vertices><triangles>%%s</triangles></mesh>' % ''.join('<vertex x="%d" y="%d" z="%d"/>' % p for p in corners)
plain = mesh % ''.join('<triangle v1="%d" v2="%d" v3="%d"/>' % tuple(cube[i:i + 3]) for i in range(0, 36, 3))
dyed = mesh % ''.join('<triangle v1="%d" v2="%d" v3="%d" pid="5" p1="%d"/>' % (*cube[i:i + 3], i < 9) for i in range(0, 36, 3))
first = ('<model unit="inch" xmlns:m="m" xmlns:p="p"><resources><basematerials id="1"><base name="PLA" displaycolor="#336699"/><base name="clear" displaycolor="#33669980"/></basematerials>'
         '<m:colorgroup id="5"><m:color color="#FF0000"/><m:color color="#00FF00FF"/></m:colorgroup>'
         '<object id="2" name="part" pid="1" pindex="1">' + plain + '</object><object id="3">' + dyed + '</object>'
         '<object id="4" name="all"><components><component objectid="2" transform="1 0 0 0 1 0 0 0 1 5 0 0"/><component objectid="3" transform="0 1 0 -1 0 0 0 0 1 0 0 0"/>'
         '<component p:path="/3D/b.model" objectid="7"/></components></object></resources>'
         '<build><item objectid="4"/><item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 9"/></build></model>')
second = '<model unit="inch"><resources><object id="7" name="other">' + plain + '</object></resources><build/></model>'
mf('foreign.3mf', {'_rels/.rels': rels, '3D/a.model': first, '3D/b.model': second})
mf('c1.3mf', {'_rels/.rels': rels, '3D/a.model': first})
mf('c2.3mf', {'_rels/.rels': rels})
mf('c3.3mf', {'_rels/.rels': rels, '3D/a.model': first.replace('component objectid="2"', 'component objectid="4"'), '3D/b.model': second})
mf('c4.3mf', {'3D/3dmodel.model': second.replace('v1="0"', 'v1="88"').replace('<build/>', '<build><item objectid="7"/></build>')})
mf('c5.3mf', {'3D/3dmodel.model': second.replace('x="0"', 'x="0,5"')})
mf('c6.3mf', {'3D/3dmodel.model': second.replace('unit="inch"', 'unit="mile"')})
mf('c7.3mf', {'3D/3dmodel.model': second[:300]})
mf('c8.3mf', {'3D/3dmodel.model': second}, cut=40)
