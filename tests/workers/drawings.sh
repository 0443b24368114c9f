# Tests drawings as other programs read them: ezdxf reads the .dxf, poppler the .pdf, librsvg the .svg;
# lengths and areas against closed forms.
. tests/report.sh

wanted drawings || exit 0
cd "$work" || exit 1

cat > house.vs <<'EOF'
(define walls (with-material brick (subtract (make-box origin (xyz 10 8 3)) (make-box (xyz 0.4 0.4 0.3) (xyz 9.6 7.6 4)))))
(define post (with-material steel (make-box (xyz 4 4 0.3) (xyz 4.5 4.5 3))))
(draw walls post (make-line (xyz 1 1 0.3) (xyz 1 3 0.3)))
(ground 0)
(view "hall" 'section #:cut (make-plane (xyz 0 4.25 0) uy))
(view "cube" 'isometric)
(view "street" #:from (xyz -6 -14 1.6) #:to (xyz 5 4 2) #:lens 28 #:upright #t)
(dimension (xyz 0 4.25 0) (xyz 10 4.25 0))
(level 0.3 "f & <g>")
(grid-axis "A" (xyz 0 -1 0) (xyz 0 9 0))
(label (xyz 5 2 0.3) "Salão {\\} ^")
EOF
echo '(draw (make-box origin (xyz 2 2 2)))' > cube.vs
for name in plan hall street sheet; do
  for format in svg pdf dxf; do "$vs" -q house.vs -o "$name.$format" || echo "$name.$format"; done
done > said 2>&1
# layers of the program: of regions, curves, solids and surfaces; with pens, and without; names of other languages, names
# that DXF forbids, and one of the drawing's own; hidden edges keep their dashes
cat > layers.vs <<'EOF'
(units 'mm)
(draw (layer "schneiden" #:color "red" #:line 0.1 (make-region (make-rectangle origin (xy 100 60)))))
(draw (layer "gravur" (make-circle (xy 50 30) 20) #:color "blue"))
(draw (layer "box" (make-box (xyz 120 0 0) (xyz 160 40 10))) (layer "box" (make-line (xy 120 50) (xy 160 50))))
(draw (layer "a<b>/c" (make-3dface (xy 170 0) (xy 180 0) (xy 180 10) (xy 170 10)) #:line 0.7))
(draw (make-line (xy 0 70) (xy 100 70)))
(draw (layer "cut" (make-line (xy 0 80) (xy 90 80)) #:color "#00ff00"))
(draw (layer "below" (make-box (xyz 121 1 -9) (xyz 159 39 -5)) #:color (list 1 0 1)))
(view "layers" 'top #:sheet 'none #:hidden #t)
EOF
"$vs" -q layers.vs -o layers.svg -o layers.pdf -o layers.dxf >> said 2>&1
echo "(draw (layer (string-append \"łódź 𝔸 \" (make-string 200 #\\ä)) (make-circle origin 2)))" > names.vs
"$vs" -q names.vs -o names.pdf >> said 2>&1
"$vs" -q cube.vs -o isometric.dxf -o isometric.svg >> said 2>&1
for i in 1 2; do "$vs" -q house.vs -o sheet.pdf && cp sheet.pdf "again$i.pdf"; done
cmp again1.pdf again2.pdf >> said 2>&1
result drawings/made said

if /usr/bin/python3 -c 'import ezdxf' 2> /dev/null; then
  /usr/bin/python3 - > said 2>&1 <<'EOF'
import ezdxf, math
from collections import defaultdict
def read(name):
    d = ezdxf.readfile(name); audit = d.audit()
    if audit.errors or audit.fixes: print(name, audit.errors, audit.fixes)
    return d.modelspace()
def segments(m, layer):
    for e in m.query(f'*[layer=="{layer}"]'):
        if e.dxftype() == 'LINE': yield (e.dxf.start.x, e.dxf.start.y, e.dxf.end.x, e.dxf.end.y)
        if e.dxftype() == 'LWPOLYLINE':
            p = [(x, y) for x, y in e.get_points('xy')]
            for a, b in zip(p, p[1:] + p[:1] if e.closed else p[1:]): yield (*a, *b)
def total(m, layer): return sum(math.hypot(c - a, d - b) for a, b, c, d in segments(m, layer))
def area(m):
    sums = defaultdict(float)
    for h in m.query('HATCH'):
        for path in h.paths.paths:
            v = [(x, y) for x, y, *_ in path.vertices]
            sums[h.dxf.color] += sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(v, v[1:] + v[:1])) / 2
    return sums
def want(what, got, expected, slack=1e-4):
    if abs(got - expected) > slack: print(f'{what}: {got}, not {expected}')
m = read('isometric.dxf')
lines = [s for layer in ('outline', 'edge') for s in segments(m, layer)]
want('edges of a cube in isometric', len(lines), 9)
want('their length', sum(math.hypot(c - a, d - b) for a, b, c, d in lines), 18 * math.sqrt(2 / 3))
m = read('plan.dxf')
cut = area(m)
want('materials in the plan', len(cut), 2)
want('area cut in the plan', sum(cut.values()), 10 * 8 - 9.2 * 7.2 + 0.25)
want('a curve seen from above', total(m, 'curve'), 2)
# the plan's points equal the model's
want('the wall begins at x', min(x for e in m.query('LWPOLYLINE[layer=="cut"]') for x, y in e.get_points('xy')), 0)
texts = [t.dxf.text for t in m.query('TEXT')]
if '10.00' not in texts: print('no dimension', texts)
if not any('\\U+00E3' in t or 'ã' in t for t in texts): print('no label', texts)
m = read('layers.dxf')
rows = {l.dxf.name: l for l in m.doc.layers}
for name, colour, weight, length in (('schneiden', 1, 9, 320), ('gravur', 5, 18, 40 * math.pi), ('box', 7, 18, 200),
                                     ('a_b__c', 7, 70, 40), ('cut', 3, 50, 90), ('curve', 5, 18, 100), ('below', 6, 18, 152)):
    if name not in rows: print('no layer', name, sorted(rows)); continue
    want(f'colour of {name}', rows[name].color, colour)
    want(f'weight of {name}', rows[name].dxf.lineweight, weight)
    want(f'length in {name}', total(m, name), length, 0.01 * length)
if {e.dxf.linetype for e in m.query('*[layer=="below"]')} != {'hidden'}: print('hidden edges without dashes')
if len(rows) != len({n.lower() for n in rows}): print('two rows of one layer', sorted(rows))
m = read('hall.dxf')
want('area cut in the section', sum(area(m).values()), 10 * 3 - 9.2 * 2.7 + 0.5 * 2.7)
for name in ('street.dxf', 'sheet.dxf'): read(name)
m = read('street.dxf')
steep = [s for layer in ('outline', 'edge') for s in segments(m, layer) if abs(s[2] - s[0]) < 1e-6 * abs(s[3] - s[1])]
if len(steep) < 3: print('verticals are not kept upright', len(steep))
EOF
  result drawings/dxf said
else
  echo "skip drawings/dxf: no python3-ezdxf"
fi

/usr/bin/python3 - > said 2>&1 <<'EOF'
import re, xml.etree.ElementTree as tree
svg, ink = '{http://www.w3.org/2000/svg}', '{http://www.inkscape.org/namespaces/inkscape}'
root = tree.parse('layers.svg').getroot()
found = {}
for g in root.findall(svg + 'g'):
    if g.get(ink + 'groupmode') != 'layer': print('a group that is no layer')
    pens = [(x.get('stroke'), x.get('stroke-width')) for x in ([g] if g.get('stroke') else g.findall(svg + 'g'))]
    found[g.get(ink + 'label')] = pens
wanted = {'curve': [('#000000', '0.18')], 'schneiden': [('#ff0000', '0.1')], 'gravur': [('#0000ff', '0.18')],
          'box': [('#000000', '0.18'), ('#000000', '0.3')], 'a<b>/c': [('#000000', '0.7')], 'cut': [('#00ff00', '0.18')],
          'below': [('#ff00ff', '0.13')]}
if found != wanted: print(found)
ids = [g.get('id') for g in root.iter() if g.get('id')]
if len(ids) != len(set(ids)): print('ids that are not unique', ids)
EOF
result drawings/svg-layers said
if command -v pdftoppm > /dev/null; then
  pdftoppm -r 100 layers.pdf page > said 2>&1
  /usr/bin/python3 - >> said 2>&1 <<'EOF'
import glob
data = open(glob.glob('page*.ppm')[0], 'rb').read().split(b'\n', 3)[3]
seen = {tuple(c > 128 for c in data[i:i + 3]) for i in range(0, len(data) - 2, 3) if max(data[i:i + 3]) - min(data[i:i + 3]) > 100}
for name, c in (('red', (True, False, False)), ('blue', (False, False, True)), ('green', (False, True, False)), ('magenta', (True, False, True))):
    if c not in seen: print('no line is', name, seen)
EOF
  result drawings/pdf-pens said
else
  echo "skip drawings/pdf-pens: no pdftoppm"
fi

if /usr/bin/python3 -c 'import PyPDF2' 2> /dev/null; then
  /usr/bin/python3 - > said 2>&1 <<'EOF'
import re, PyPDF2
def layers(name):
    file = PyPDF2.PdfReader(name)
    if file.pdf_header < '%PDF-1.5': print(name, 'is of a version without layers:', file.pdf_header)
    listed = file.trailer['/Root']['/OCProperties']
    if list(listed['/OCGs']) != list(listed['/D']['/Order']): print(name, 'lists other layers than it has')
    page = file.pages[0]
    content = page.get_contents().get_data().decode('latin-1')
    names = {k: v.get_object()['/Name'] for k, v in page['/Resources']['/Properties'].items()}
    opened = re.findall(r'/OC (/L\d+) BDC\n(.*?)EMC\n', content, re.S)
    if content.count(' BDC\n') != len(opened) or content.count('EMC\n') != len(opened): print(name, 'has a layer that does not end')
    outside = re.sub(r'/OC (/L\d+) BDC\n(.*?)EMC\n', '', content, flags=re.S)
    if re.search(r'^(S|f\*?|BT)$', outside, re.M): print(name, 'has marks in no layer')
    for k, marks in opened:
        if not re.search(r'^(S|f\*|ET)$', marks, re.M): print(name, names[k], 'is empty')
    return [names[k] for k, marks in opened]
found = layers('layers.pdf')
for name in ('schneiden', 'gravur', 'box', 'a<b>/c', 'cut', 'below', 'curve'):
    if found.count(name) != 1: print('layer', name, 'occurs', found.count(name), 'times in', found)
names = layers('names.pdf')
if 'łódź 𝔸 ' + 'ä' * 113 not in names: print(names)
layers('sheet.pdf')
EOF
  result drawings/pdf-layers said
else
  echo "skip drawings/pdf-layers: no python3-pypdf2"
fi

if command -v pdftotext > /dev/null; then
  { pdftotext sheet.pdf - 2>&1 | tr '\n' ' ' > words
    grep -o 'Syntax .*' words # what poppler warns of
    for word in hall cube street 10.00 '+0.30 f & <g>' 'Salão {\} ^' 1:100; do grep -q -F -e "$word" words || echo "the text '$word' is not in sheet.pdf"; done
    pdfinfo sheet.pdf 2> /dev/null | grep -q 'Pages: *1$' || echo 'sheet.pdf has not one page'
    pdfinfo sheet.pdf 2> /dev/null | grep -i date
    ! command -v qpdf > /dev/null || qpdf --check sheet.pdf > checked 2>&1 || cat checked
  } > said
  result drawings/pdf said
else
  echo "skip drawings/pdf: no pdftotext (package poppler-utils)"
fi

if command -v rsvg-convert > /dev/null; then
  export XDG_CACHE_HOME="$work" # fontconfig complains where it can keep no cache, as for a user without a home
  { for name in plan hall street sheet isometric; do
      xmllint --noout "$name.svg"
      rsvg-convert -w 400 "$name.svg" -o "$name.png"
    done
    grep -c '<text' sheet.svg | awk '$1 < 10 { print "only " $1 " texts in sheet.svg" }'
    grep -q 'f &amp; &lt;g&gt;' hall.svg || echo 'hall.svg does not escape its texts'
  } > said 2>&1
  result drawings/svg said
else
  echo "skip drawings/svg: no rsvg-convert (package librsvg2-bin)"
fi

# A house's sheet: no text overlaps another, room names and axes are at useful places, and everything fits A3.
cat > sheet-of-a-house.vs <<'EOF'
(define brick-walls
  (with-material brick
    (subtract (make-box origin (xyz 10 8 3)) (make-box (xyz 0.4 0.4 0.3) (xyz 9.6 7.6 4)))))
(define inner (with-material plaster (make-box (xyz 5.5 0.4 0.3) (xyz 5.65 7.6 3))))
(define openings (list (make-box (xyz 6 -1 0.3) (xyz 7 1 2.4)) (make-box (xyz 1.5 -1 1.2) (xyz 3.5 1 2.4)) (make-box (xyz 2 7 1.2) (xyz 4 9 2.4)) (make-box (xyz 5 3 0.3) (xyz 6 4 2.4)) (make-box (xyz 9 2 1.2) (xyz 11 4 2.4))))
(draw (subtract (unite brick-walls inner) openings))
(draw (with-material concrete (make-box (xyz -0.5 -0.5 3) (xyz 10.5 8.5 3.25))))
(draw (with-material 'oak (make-box (xyz 7.5 5 0.3) (xyz 9 6 1.05))))
(ground 0)
(view "ground floor" 'plan #:cut 1.5)
(view "section A" 'section #:cut (make-plane (xyz 2.5 4 0) ux))
(view "front" 'front)
(view "left" 'left)
(dimension origin (xyz 10 0 0))
(dimension origin (xyz 0 8 0))
(dimension (xyz 1.5 0 1.2) (xyz 3.5 0 1.2) #:offset 0.6)
(dimension (xyz 6 0 1.2) (xyz 7 0 1.2) #:offset 0.6)
(dimension (xyz 0 0 0) (xyz 0 0 3.25))
(level 0.3 "floor") (level 3.25 "roof")
(grid-axis "A" (xyz 0.2 -1 0) (xyz 0.2 9 0)) (grid-axis "B" (xyz 5.57 -1 0) (xyz 5.57 9 0)) (grid-axis "C" (xyz 9.8 -1 0) (xyz 9.8 9 0))
(grid-axis "1" (xyz -1 0.2 0) (xyz 11 0.2 0)) (grid-axis "2" (xyz -1 7.8 0) (xyz 11 7.8 0))
(label (xyz 3 4 0.3) "living room") (label (xyz 7.5 4 0.3) "kitchen")
EOF
{ "$vs" -q sheet-of-a-house.vs -o sheet.svg --all-views
  grep '<text' sheet.svg | sed 's/.* x="\([-0-9.]*\)" y="\([-0-9.]*\)" font-size="\([0-9.]*\)"\([^>]*\)>\(.*\)<.text>/\1|\2|\3|\4|\5/' > texts
  awk -F'|' '{
      wide = 0.6 * $3 * length($5); x = $4 ~ /middle/ ? $1 - wide / 2 : $1; y = $2 - 0.75 * $3; w = wide; h = 0.75 * $3
      if ($4 ~ /rotate/) { x = $1 - h; y = $2 - wide / 2; w = h; h = wide }
      for (i = 1; i < NR; i++) if (x < X[i] + W[i] && X[i] < x + w && y < Y[i] + H[i] && Y[i] < y + h) print "\"" $5 "\" lies on \"" T[i] "\""
      X[NR] = x; Y[NR] = y; W[NR] = w; H[NR] = h; T[NR] = $5; n[$5]++ }
    END { split("kitchen 1 living_room 1 A 2 B 2 C 2 1 4 2 3 10.00 1 8.00 1 3.25 2 +3.25__roof 3 A3 1", want, " ")
      for (i = 1; want[i]; i += 2) { t = want[i]; gsub("_", " ", t); if (n[t] != want[i + 1]) print "\"" t "\" stands " n[t] + 0 " times, not " want[i + 1] } }' texts
} > said 2>&1
result drawings/house said
