# Tests what an office sees on a sheet: marks stay inside the frame, titles lie on nothing, dimensions are where they
# belong, the earth hides what is below it, and objects that touch keep the line between them.
. tests/report.sh

wanted sheets || exit 0
cd "$work" || exit 1

cat > read.py <<'EOF'
import re, xml.etree.ElementTree as tree
svg = '{http://www.w3.org/2000/svg}'
def marks(name):
    """Yields (kind, view, data): the points of each path, or the text and its rectangle."""
    for layer in tree.parse(name).getroot().iter(svg + 'g'):
        kind = layer.get('id')
        for group in [layer] + layer.findall(svg + 'g'):
            title = group.find(svg + 'title')
            view = None if title is None else title.text
            if group is not layer and view is None or group is layer and kind is None: continue
            for x in group.findall(svg + 'path'):
                for part in re.findall(r'M[^M]*', x.get('d')):
                    numbers = [float(n) for n in re.findall(r'-?[\d.]+', part)]
                    yield kind, view, list(zip(numbers[::2], numbers[1::2]))
            for x in group.findall(svg + 'text'):
                size, left, y = (float(x.get(k)) for k in ('font-size', 'x', 'y'))
                wide, high = 0.6 * size * len(x.text), 0.73 * size
                left -= {'start': 0, 'middle': wide / 2, 'end': wide}[x.get('text-anchor')]
                box = [(left, y - high), (left + wide, y)]
                if 'rotate(-90' in x.get('transform', ''):
                    box = [(left + wide / 2 - high, y - wide / 2), (left + wide / 2, y + wide / 2)]
                yield 'text', view, (x.text, box)
EOF

# Every kind of note, far beyond the model on every side; each alone and all at once; with and without paper.
cat > notes.vs <<'EOF'
(define-parameter kind 0)
(define-parameter bare #f)
(define (put i . notes) (if (or (= kind 0) (= kind i)) (for-each (lambda (f) (f)) notes)))
(draw (make-box origin (xyz 10 8 3)))
(ground 0)
(define-syntax show
  (syntax-rules () ((_ a ...) (if bare (view a ... #:scale 200 #:sheet 'none) (view a ... #:scale 200)))))
(show "plan" 'plan)
(show "section" 'section #:cut (make-plane (xyz 0 4 0) uy))
(show "front" 'front)
(show "iso" 'isometric)
(put 1 (lambda () (level 24 "a ridge far above, with a long name")) (lambda () (level -14 "rock")))
(put 2 (lambda () (grid-axis "A" (xyz 4.5 -12 0) (xyz 4.5 9 0))) (lambda () (grid-axis "1" (xyz -15 4 0) (xyz 12 4 0)))
       (lambda () (grid-axis "B" (xyz 10 22 0) (xyz 10 0 0))) (lambda () (grid-axis "2" (xyz 30 0 0) (xyz 0 0 0))))
(put 3 (lambda () (dimension origin (xyz 10 0 0) #:offset -14)) (lambda () (dimension origin (xyz 0 8 0) #:offset 11))
       (lambda () (dimension (xyz 0 0 0) (xyz 0 0 3) #:offset -18)) (lambda () (dimension (xyz 10 0 0) (xyz 60 0 0))))
(put 4 (lambda () (label (xyz 24 4 1) "a tree of the neighbour")) (lambda () (label (xyz -24 -14 1) "street")))
EOF
for bare in t f; do for kind in 0 1 2 3 4; do
  "$vs" -q notes.vs -D kind=$kind -D "bare=#$bare" --all-views -o notes-$kind-$bare.svg || echo "notes $kind $bare"
done; done > said 2>&1
/usr/bin/python3 - >> said 2>&1 <<'EOF'
from read import marks
for kind in range(5):
    for bare in 'tf':
        name = f'notes-{kind}-{bare}.svg'
        every = list(marks(name))
        if bare == 't':
            size = open(name).read().split('viewBox="')[1].split('"')[0].split()
            frame = [(0, 0), (float(size[2]), float(size[3]))]
        else: frame = next(p for k, v, p in every if k == 'frame')
        low, high = [[f(p[i] for p in frame) for i in (0, 1)] for f in (min, max)]
        titles = []
        for k, v, p in every:
            points, what = (p[1], p[0]) if k == 'text' else (p, k)
            if k == 'text' and v and '   1:' in what: titles.append(p)
            if any(not low[i] - .01 <= q[i] <= high[i] + .01 for q in points for i in (0, 1)):
                print(name, what, 'leaves the frame')
        if len(titles) != (4 if bare == 'f' else 0): print(name, 'titles', titles)
        for title in titles:
            what, ((x0, y0), (x1, y1)) = title
            for k, v, p in every:
                if k in ('frame', 'sheet') or p == title: continue
                points = p[1] if k == 'text' else p
                for a, b in zip(points, points[1:]):
                    if min(a[0], b[0]) < x1 and max(a[0], b[0]) > x0 and min(a[1], b[1]) < y1 and max(a[1], b[1]) > y0:
                        print(name, f'the title "{what}" lies on', k, p[0] if k == 'text' else '', v)
EOF
result sheets/frame said

# Dimensions in every direction, before, in and beyond the cuts; each has its own text. The views that show each; the side
# of its offset.
cat > dimensions.vs <<'EOF'
(draw (make-box origin (xyz 10 8 6)))
(view "plan" 'plan #:cut 3)
(view "section" 'section #:cut (make-plane (xyz 0 4 0) uy))
(view "across" 'section #:cut (make-plane (xyz 5 0 0) ux))
(view "front" 'front)
(view "iso" 'isometric)
(for ([at (list 0 4 8)] [name '("before" "in" "after")])
  (dimension (xyz 0 at 1) (xyz 10 at 1) #:text (string-append "width " name))
  (dimension (xyz 0 at 1) (xyz 0 at 5) #:text (string-append "height " name)))
(dimension (xyz 0 0 5) (xyz 10 0 5) #:text "above the plan's cut")
(dimension (xyz 0 0 1) (xyz 0 8 1) #:text "depth")
(dimension (xyz 5 0 1) (xyz 5 8 1) #:text "depth in the cut")
(dimension (xyz 0 4 0) (xyz 10 4 6) #:text "slope")
(dimension (xyz 0 0 1) (xyz 10 0 1) #:text "named" #:view "front")
(dimension (xyz 0 1 1) (xyz 10 1 1) #:text "left" #:offset 1)
(dimension (xyz 0 1 1) (xyz 10 1 1) #:text "right" #:offset -1)
(dimension (xyz 10 1 1) (xyz 0 1 1) #:text "left of the way back" #:offset 1)
EOF
"$vs" -q dimensions.vs --all-views -o dimensions.svg > said 2>&1
/usr/bin/python3 - >> said 2>&1 <<'EOF'
from collections import defaultdict
from read import marks
found, y = defaultdict(set), {}
for k, v, p in marks('dimensions.svg'):
    if k == 'text' and v and '   1:' not in p[0]: found[p[0]].add(v); y[p[0]] = p[1][1][1]
uprights = {'section', 'front'}
want = {'width before': {'plan'}, 'width in': {'plan', 'section'}, 'width after': {'plan'},
        'height before': {'front'}, 'height in': uprights, 'height after': uprights, 'depth': {'plan'},
        'depth in the cut': {'plan', 'across'}, 'slope': uprights, 'named': {'front'}, 'left': {'plan'}, 'right': {'plan'},
        'left of the way back': {'plan'}}
for name in sorted(set(want) | set(found)):
    if found[name] != want.get(name, set()): print(name, 'is in', sorted(found[name]), 'and not in', sorted(want.get(name, [])))
if not y['left'] < y['right'] or abs(y['left of the way back'] - y['right']) > .1: print('sides of offsets', y)
EOF
result sheets/dimensions said

# The earth: a house with a cellar, a court that walls enclose, and a footing; in every kind of view. The parts below the
# ground of each view's lines; the area of the earth that the sections cut.
cat > earth.vs <<'EOF'
(define-parameter z 0)
(define (at x y h) (xyz x y (+ z h)))
(define-parameter dashed #f)
(define house (subtract (make-box (at 0 0 -3) (at 10 8 3.3)) (make-box (at 0.4 0.4 0.3) (at 9.6 7.6 3)) (make-box (at 0.4 0.4 -2.6) (at 9.6 7.6 0))))
(define court (subtract (make-box (at 10 2 -3) (at 13 6 0.2)) (make-box (at 10 2.3 -2.6) (at 12.7 5.7 1))))
(draw house court (make-box (at 3 6 -2.6) (at 4 7 -1.6)) (make-box (at -0.5 -0.5 -3.5) (at 10.5 8.5 -3)))
(ground z)
(view "plan" 'plan #:hidden dashed)
(view "cellar" 'plan #:cut (- z 1.3) #:hidden dashed)
(view "section" 'section #:cut (make-plane (at 0 4 0) uy) #:hidden dashed)
(view "south" 'front #:hidden dashed)
(view "west" 'left #:hidden dashed)
(view "iso" 'isometric #:hidden dashed)
(view "below" 'bottom #:hidden dashed)
EOF
for z in 0 7; do for view in plan cellar section south west iso below; do
  "$vs" -q earth.vs -D z=$z --view $view -o earth-$view-$z.dxf || echo "$view"
  "$vs" -q earth.vs -D z=$z -D 'dashed=#t' --view $view -o dashed-$view-$z.dxf || echo "$view"
done; done > said 2>&1
if /usr/bin/python3 -c 'import ezdxf' 2> /dev/null; then
  /usr/bin/python3 - >> said 2>&1 <<'EOF'
import ezdxf
def lines(name):
    d = ezdxf.readfile(name)
    if d.audit().errors: print(name, 'audit')
    for e in d.modelspace():
        if e.dxf.layer not in ('cut', 'outline', 'edge', 'parting', 'hidden', 'ground'): continue
        if e.dxftype() == 'LINE': p = [tuple(e.dxf.start)[:2], tuple(e.dxf.end)[:2]]
        elif e.dxftype() == 'LWPOLYLINE': p = list(e.get_points('xy')) + (list(e.get_points('xy'))[:1] if e.closed else [])
        else: continue
        for a, b in zip(p, p[1:]): yield (e.dxf.layer, *a, *b)
for z in (0, 7):
    for view in ('south', 'west'):
        for name in ('earth', 'dashed'):
            low = [s for s in lines(f'{name}-{view}-{z}.dxf') if min(s[2], s[4]) < z - 1e-6]
            if name == 'earth' and low: print(view, z, 'lines below the ground', low[:3])
            if name == 'dashed' and (not low or any(s[0] != 'hidden' for s in low)): print(view, z, 'below the ground is not dashed', low[:3])
    inside = [s for s in lines(f'earth-section-{z}.dxf') if s[0] not in ('cut', 'ground', 'parting') and max(s[2], s[4]) < z - .01]
    for layer, *s in inside: # the box in the cellar and the walls behind the cut are visible; the footing's rear is not
        if not all(.39 <= x <= 12.71 and -2.61 <= y - z for x, y in (s[:2], s[2:])): print('section', z, 'a line in the earth', layer, s)
    if len(inside) < 3: print('section', z, 'the cellar lost its lines', inside)
    ground = [s for s in lines(f'earth-section-{z}.dxf') if s[0] == 'ground']
    if any(max(s[1], s[3]) > 1e-6 and min(s[1], s[3]) < 13 - 1e-6 for s in ground) or len(ground) != 2: print('ground line', ground)
    for view, limit in (('plan', 0), ('iso', None)):
        seen = list(lines(f'earth-{view}-{z}.dxf'))
        if view == 'plan' and any(min(s[1], s[3]) < -1e-6 or max(s[2], s[4]) > 8 + 1e-6 for s in seen): print('plan', z, 'the footing is visible')
        if view == 'plan' and not any(abs(s[1] - 12.7) < 1e-6 and abs(s[3] - 12.7) < 1e-6 for s in seen): print('plan', z, 'the court is hidden')
    if not any(s[1] < -.4 for s in lines(f'earth-below-{z}.dxf')): print('below', z, 'the footing is hidden')
    for view in ('section', 'cellar'):
        hatch = sum(1 for e in ezdxf.readfile(f'earth-{view}-{z}.dxf').modelspace() if e.dxf.layer == 'earth')
        if hatch < 20: print(view, z, 'hatch lines of the earth', hatch)
    for e in ezdxf.readfile(f'earth-section-{z}.dxf').modelspace().query('*[layer=="earth"]'):
        x, y = (e.dxf.start.x + e.dxf.end.x) / 2, (e.dxf.start.y + e.dxf.end.y) / 2 - z
        if y > 1e-6 or (0 < x < 13 and -3 < y): print('section', z, 'earth in the house', x, y)
EOF
  result sheets/earth said
else
  echo "skip sheets/earth: no python3-ezdxf"
fi

# Two plates that touch, in each way that they can be drawn, in each view and cut: a line lies between them, unless they
# are united. Both have faces in the same planes.
cat > plates.vs <<'EOF'
(define-parameter way 0)
(define (plate x shape) (let ((p (xyz x 0 0)) (q (xyz (+ x 2) 2 1)))
  (case shape ((box) (make-box p q))
              ((prism) (do-extrude (make-region (make-rectangle p (xyz (+ x 2) 2 0))) 1))
              ((region) (make-region (make-rectangle p (xyz (+ x 2) 2 0)))))))
(define shape (list-ref '(box prism region) (modulo way 3)))
(define a (plate 0 shape)) (define b (plate 2 shape))
(case (quotient way 3)
  ((0) (draw a b)) ((1) (draw a) (draw b)) ((2) (draw (list a b))) ((3) (draw (layer "a" a) (layer "b" b)))
  ((4) (draw (unite (layer "a" a) (layer "b" b)))) ((5) (draw (unite (with-material wood a) (with-material brick b))))
  ((6) (draw (unite a b))))
(define all (list "top" "bottom" "front" "back" "cut"))
(if (not (eq? shape 'region)) (begin
  (view "front" 'front) (view "back" 'back) (view "cut" 'plan #:cut 0.5)
  (view "section" 'section #:cut (make-plane (xyz 0 1 0) uy))))
(view "top" 'top) (view "bottom" 'bottom)
EOF
for way in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
  "$vs" -q plates.vs -D way=$way --all-views -o plates-$way.svg || echo "way $way"
done > said 2>&1
/usr/bin/python3 - >> said 2>&1 <<'EOF'
from collections import defaultdict
import re
from read import svg, tree
for way in range(21):
    points = defaultdict(list)
    root = tree.parse(f'plates-{way}.svg').getroot()
    for g in root.iter(svg + 'g'):
        title = g.find(svg + 'title')
        for x in g.findall(svg + 'path') if title is not None else []:
            if x.get('fill'): continue
            for part in re.findall(r'M[^M]*', x.get('d')):
                n = [float(v) for v in re.findall(r'-?[\d.]+', part)]
                p = list(zip(n[::2], n[1::2]))
                points[title.text] += list(zip(p, p[1:] + (p[:1] if 'Z' in part else [])))
    if len(points) != (2 if way % 3 == 2 else 6): print('way', way, 'views', sorted(points))
    for view, lines in points.items():
        xs = [p[0] for l in lines for p in l]
        middle = (min(xs) + max(xs)) / 2
        between = any(abs(a[0] - middle) < .01 and abs(b[0] - middle) < .01 and abs(a[1] - b[1]) > 1 for a, b in lines)
        if between != (way < 18): print('way', way, view, 'has a line' if between else 'has no line', 'between the plates')
EOF
result sheets/plates said
