# changes files at random places: cuts, doubles, swaps, other bytes; the parts of a .3mf, packed again
import io, random, sys, zipfile
count = int(sys.argv[1])
pieces = [b'9', b'-', b'1e300', b'-1', b'0', b'x', b'"', b'<', b'>', b'&', b'\n', b'\0', b'\xff', b'99999999', b'/>', b'[', b'{', b',', b':', b'null']
def changed(r, s):
    n = len(s); a = r.randrange(n + 1); b = a + 1 + r.randrange(40); kind = r.randrange(12)
    if kind == 0: return s[:a] + s[b:]
    if kind == 1: return s[:b] + s[a:]
    if kind == 2: return s[:a]
    if kind == 3:
        c = r.randrange(n + 1)
        return s[:a] + s[c:c + 200] + s[b:]
    if kind > 6:  # another digit
        while a < n and not s[a:a + 1].isdigit(): a += 1
        return s[:a] + b'%d' % r.randrange(10) + s[a + 1:]
    if kind == 4: return s[:a] + bytes([r.randrange(256)]) + s[a + 1:]
    return s[:a] + r.choice(pieces) + s[a + r.randrange(3):]
def several(r, s):
    for _ in range(r.choice((1, 1, 1, 2, 5))): s = changed(r, s)
    return s
def packed(r, s):
    if r.randrange(4) == 0: return several(r, s)
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(s)) as old, zipfile.ZipFile(out, 'w', zipfile.ZIP_DEFLATED) as new:
        for name in old.namelist():
            text = old.read(name)
            new.writestr(name, several(r, text) if name.endswith('.model') else text)
    return out.getvalue()
def head(r, s):  # the JSON of a .glb, with its lengths set again
    n = int.from_bytes(s[12:16], 'little'); text = several(r, s[20:20 + n]); text += b' ' * (-len(text) % 4)
    body = len(text).to_bytes(4, 'little') + b'JSON' + text + s[20 + n:]
    return s[:8] + (12 + len(body)).to_bytes(4, 'little') + body
for ending in 'glb', '3mf', 'x3d':
    r = random.Random(ending)
    for i in range(count):
        s = open(('made.' if i % 2 else 'foreign.') + ending, 'rb').read()
        open('%d.%s' % (i, ending), 'wb').write(packed(r, s) if ending == '3mf' else head(r, s) if ending == 'glb' and r.randrange(4) else several(r, s))
