# Tests the files for a laser or a plotter as other programs read them: outlines, slices, a net and packed sheets, by
# layer. ezdxf measures lengths and colours, Inkscape the extent of each layer. openpyxl reads the cells of workbooks.
. tests/report.sh

wanted cutting || exit 0
cd "$work" || exit 1

cat > cutting.vs <<'EOF'
(units 'mm)
(define-parameter file "outline")
(define (square x0 y0 size) (make-region (make-rectangle (xy x0 y0) (xy (+ x0 size) (+ y0 size)))))
(define plate (subtract (make-region (make-rectangle origin (xy 100 60))) (square 10 10 20)))
(case (string->symbol file)
  ((outline) (draw (layer "cut" (outline plate) #:color "red" #:line 0.1)
                   (layer "engrave" (make-line (xy 50 10) (xy 90 10)) #:color "blue" #:line 0.2)))
  ((slices) (for ([s (slices (make-pyramid (xyz 50 50 0) 50 4 (xyz 50 50 40)) 20 #:numbers #f)] [x '(0 120)]) (draw (do-move s (vxyz x 0 0)))))
  ((net) (draw (unfold (make-box origin (xyz 20 20 20)) #:numbers #f)))
  ((sheet) (draw (first (pack-parts (layer "cut" plate) #:sheet '(220 140) #:count 4 #:gap 5 #:turn 'none #:effort 0.01)))))
(view "cutting" 'top #:sheet 'none)
EOF
for file in outline slices net sheet; do "$vs" -q cutting.vs -D file=$file --view cutting -o $file.dxf -o $file.svg || echo "$file"; done > said 2>&1
result cutting/made said

# per file and layer: colour, length, width
cat > wanted.py <<'EOF'
from math import sqrt
low, high = 50 * sqrt(2) * .75, 50 * sqrt(2) * .25 # sides of the two slices, halfway up 20 of 40
wanted = {'outline': {'cut': (1, 400, 100), 'engrave': (5, 40, 40)},
          'slices': {'cut': (7, 4 * (low + high), 120 + (low + high) / sqrt(2)), 'engrave': (7, 4 * high, high * sqrt(2))},
          'net': {'cut': (7, 280, None), 'mountain': (7, 100, None)},
          'sheet': {'cut': (7, 1600, 205)}}
EOF
if /usr/bin/python3 -c 'import ezdxf' 2> /dev/null; then
  /usr/bin/python3 - > said 2>&1 <<'EOF'
import ezdxf, math
from wanted import wanted
for name, layers in wanted.items():
    d = ezdxf.readfile(name + '.dxf'); audit = d.audit()
    if audit.errors or audit.fixes: print(name, audit.errors, audit.fixes)
    found = {e.dxf.layer for e in d.modelspace()}
    if found != set(layers): print(name, 'has entities in', sorted(found), 'not in', sorted(layers))
    for layer, (colour, length, width) in layers.items():
        total, xs = 0, []
        for e in d.modelspace().query(f'*[layer=="{layer}"]'):
            if e.dxftype() == 'LINE': p = [tuple(e.dxf.start)[:2], tuple(e.dxf.end)[:2]]
            elif e.dxftype() == 'LWPOLYLINE': p = list(e.get_points('xy')); p += p[:1] if e.closed else []
            else: print(name, layer, 'has a', e.dxftype()); continue
            total += sum(math.dist(a, b) for a, b in zip(p, p[1:])); xs += [x for x, y in p]
        if d.layers.get(layer).color != colour: print(name, layer, 'has the colour', d.layers.get(layer).color)
        if abs(total - length) > 1e-3: print(name, layer, 'is', total, 'long, not', length)
        if width and abs(max(xs) - min(xs) - width) > 1e-3: print(name, layer, 'is', max(xs) - min(xs), 'wide, not', width)
EOF
  result cutting/dxf said
else
  echo "skip cutting/dxf: no python3-ezdxf"
fi

if command -v inkscape > /dev/null; then
  for file in outline slices net sheet; do
    HOME=$work limited 60 inkscape --query-all $file.svg > $file.boxes 2> /dev/null || echo "inkscape $file"
    HOME=$work limited 60 inkscape --export-id=layer-1 --export-id-only --export-type=png --export-filename=$file.png $file.svg > /dev/null 2>&1
    [ -s $file.png ] || echo "inkscape exports no layer of $file"
  done > said 2>&1
  /usr/bin/python3 - >> said 2>&1 <<'EOF'
import xml.etree.ElementTree as tree
from wanted import wanted
svg, ink = '{http://www.w3.org/2000/svg}', '{http://www.inkscape.org/namespaces/inkscape}'
for name, layers in wanted.items():
    boxes = {l.split(',')[0]: [float(x) / 96 * 25.4 for x in l.split(',')[1:]] for l in open(name + '.boxes') if l.count(',') == 4}
    groups = {g.get(ink + 'label'): g.get('id') for g in tree.parse(name + '.svg').getroot().findall(svg + 'g') if g.get(ink + 'groupmode') == 'layer'}
    if set(groups) != set(layers): print(name, 'has the layers', sorted(groups), 'not', sorted(layers))
    for layer, (colour, length, width) in layers.items():
        box = boxes.get(groups.get(layer))
        if not box: print(name, layer, 'is no layer in Inkscape', sorted(boxes)[:9])
        elif width and abs(box[2] - width) > 0.5: print(name, layer, 'is', box[2], 'mm wide in Inkscape, not', width)
EOF
  result cutting/inkscape said
else
  echo "skip cutting/inkscape: no inkscape"
fi

# Each kind of cell in a workbook, and the same bytes at another hour and place.
cat > book.vs <<'EOF'
(define walls (layer "walls" (make-box origin (xyz 5 0.5 3)) (make-box origin (xyz 4 0.5 3))))
(random-seed 7)
(define (cell i)
  (case (modulo i 8)
    ((0) (random-range -1e9 1e9)) ((1) (- (random 2000000) 1000000)) ((2) (/ (random 1000) 7)) ((3) (list-ref '(#t #f "") (random 3)))
    ((4) (list-ref '("=1+1" "a,\"b\"" " two\nlines " "<&> äβ漢😀" "007" "1e5") (random 6))) ((5) (string->symbol "layer name"))
    ((6) (* (random-range -1. 1.) (expt 10. (- (random 600) 300)))) (else (list-ref (list +inf.0 -inf.0 +nan.0) (random 3)))))
(define rows (for/list ([r 40]) (for/list ([i (+ 1 (random 30))]) (cell (+ i r)))))
(write-xlsx "book.xlsx" #:digits 3 (cons "Größen" (schedule walls 'layer 'count 'volume)) rows)
(define (spelt x) ; kind and text of a cell
  (cond ((or (not x) (equal? x "")) "-") ((eq? x #t) "b True") ((and (real? x) (finite? x)) (format "n ~a" (number->string (inexact x))))
        (else (format "s ~a" (string-replace (format "~a" x) "\n" "|")))))
(call-with-output-file "wanted.txt"
  (lambda (p) (for ([row rows]) (for ([x row]) (display (spelt x) p) (newline p)) (display "end" p) (newline p))))
EOF
if /usr/bin/python3 -c 'import openpyxl' 2> /dev/null; then
  : > said
  "$vs" -q book.vs > said 2>&1 && mv book.xlsx first.xlsx
  TZ=Asia/Tokyo TMPDIR=$work "$vs" -q book.vs >> said 2>&1
  cmp first.xlsx book.xlsx >> said 2>&1
  /usr/bin/python3 - >> said 2>&1 <<'EOF'
import openpyxl, zipfile
assert all(i.date_time == (1980, 1, 1, 0, 0, 0) for i in zipfile.ZipFile('book.xlsx').infolist()), 'a part has a date'
book = openpyxl.load_workbook('book.xlsx')
assert book.sheetnames == ['Größen', 'Sheet2'], book.sheetnames
table, other = book
assert [[c.value for c in r] for r in table] == [['layer', 'count', 'volume'], ['walls', 2, 13.5]], list(table.values)
assert table['A1'].font.b and not table['A2'].font.b, 'the head is bold, and no other row'
assert (table['B2'].number_format, table['C2'].number_format) == ('General', '0.000'), 'integers show no decimals'
assert table.freeze_panes == 'A2', table.freeze_panes
rows = open('wanted.txt', encoding='utf-8').read().split('end\n')[:-1]
count = 0
for r, row in enumerate(rows, 1):
    cells = row.splitlines()
    for c, wanted in enumerate(cells + ['-'], 1):
        cell = other.cell(r, c); x = cell.value; count += 1
        found = '-' if x is None else f'b {x}' if cell.data_type == 'b' else f'n {x!r}' if cell.data_type == 'n' else 's ' + x.replace('\n', '|')
        near = wanted[:2] == found[:2] == 'n ' and abs(float(wanted[2:]) - x) <= 1e-15 * abs(x)
        if not near and wanted != found: print(f'row {r}, cell {c} is {found}, not {wanted}')
if count < 400: print('only', count, 'cells')
EOF
  ls -d visualscheme-workbook-* >> said 2> /dev/null
  result cutting/workbook said
else
  echo "skip cutting/workbook: no python3-openpyxl"
fi

# A workbook that cannot be written: one message, and an exit code.
echo '(write-xlsx "there/book.xlsx" (list (list 1)))' > nowhere.vs
echo '(write-xlsx "book.xlsx" (list (list 1)))' > untemporary.vs
cat > wanted <<'EOF'
nowhere.vs:1:1: write-xlsx: cannot open there/book.xlsx: no such file
exit 1
untemporary.vs:1:1: write-xlsx: no temporary file can be made in /nowhere
exit 1
EOF
{
  "$vs" -q nowhere.vs > told 2>&1; echo "exit $?" >> told
  TMPDIR=/nowhere "$vs" -q untemporary.vs >> told 2>&1; echo "exit $?" >> told
  grep -v '^ ' told | diff - wanted || true
} > said 2>&1
result cutting/unwritable-workbook said
