; Flat shapes: regions in the plane z = 0, whose circles are polygons with OpenSCAD's number of corners.

(define (flat-point x y) (xyz x y 0.0))
(define (point-numbers? v) (and (vector? v) (<= 2 (vector-length v) 3) (numbers? v) (every finite? (vector->list v))))

; ---- rings: lists of points of a closed line ----

(define (near-point? p q) (< (distance p q) 1e-9))
; Returns the ring without points that repeat the point before them.
(define (without-repeats ring)
  (let* ((l (fold (lambda (p all) (if (and (pair? all) (near-point? p (car all))) all (cons p all))) '() ring))
         (l (if (and (pair? l) (pair? (cdr l)) (near-point? (car l) (car (reverse l)))) (cdr l) l)))
    (reverse l)))
(define (twice-area ring)
  (let loop ((l ring) (sum 0.0))
    (if (null? l) sum
        (let ((p (car l)) (q (if (null? (cdr l)) (car ring) (cadr l))))
          (loop (cdr l) (+ sum (- (* (cx p) (cy q)) (* (cx q) (cy p)))))))))
(define (has-area? ring) (and (>= (length ring) 3) (> (abs (twice-area ring)) 1e-9)))

; ---- lines that cross themselves ----

; Returns the parameters (s . t) at which the edges a-b and c-d cross, or #f. Parallel edges do not cross.
(define (crossing a b c d)
  (let* ((ux (- (cx b) (cx a))) (uy (- (cy b) (cy a))) (vx (- (cx d) (cx c))) (vy (- (cy d) (cy c))) (wx (- (cx c) (cx a))) (wy (- (cy c) (cy a)))
         (k (- (* ux vy) (* uy vx))))
    (and (> (abs k) 1e-12)
         (let ((s (/ (- (* wx vy) (* wy vx)) k)) (t (/ (- (* wx uy) (* wy ux)) k)))
           (and (<= 0.0 s 1.0) (<= 0.0 t 1.0) (cons s t))))))
; Returns (i j point) for the first two edges that cross and are no neighbours, or #f.
(define (first-crossing v)
  (let* ((n (vector-length v)) (at (lambda (i) (vector-ref v (modulo i n)))))
    (let next ((i 0) (j 2))
      (cond ((>= i (- n 2)) #f)
            ((or (>= j n) (and (= i 0) (= j (- n 1)))) (next (+ i 1) (+ i 3)))
            ((crossing (at i) (at (+ i 1)) (at j) (at (+ j 1)))
             => (lambda (c) (list i j (intermediate-point (at i) (at (+ i 1)) (car c)))))
            (else (next i (+ j 1)))))))
; Returns rings that do not cross themselves, with the same edges.
(define (simple-rings ring)
  (let work ((waiting (list ring)) (made '()))
    (if (null? waiting) made
        (let* ((ring (without-repeats (car waiting))) (v (list->vector ring)) (found (and (has-edges? v) (first-crossing v))))
          (if found
              (let* ((i (car found)) (j (cadr found)) (p (caddr found)) (l (vector->list v)))
                (work (cons* (cons p (list-tail (take l (+ j 1)) (+ i 1))) (cons p (append (list-tail l (+ j 1)) (take l (+ i 1)))) (cdr waiting)) made))
              (work (cdr waiting) (if (has-area? ring) (cons ring made) made)))))))
(define (has-edges? v) (> (vector-length v) 3))
(define (ring-region ring) (make-region (make-polygon ring)))
(define (either a b) (subtract (unite a b) (intersect a b)))
; Returns a list of at most one region: the points that an odd number of rings surround.
(define (odd-region rings)
  (let ((simple (append-map simple-rings rings)))
    (if (null? simple) '() (list (fold (lambda (r all) (either all (ring-region r))) (ring-region (car simple)) (cdr simple))))))
(define (region-of rings)
  (let ((whole (filter has-area? (map without-repeats rings))))
    (cond ((null? whole) (odd-region rings))
          (else (guard (e (#t (odd-region whole))) (list (apply make-region (map make-polygon whole))))))))

; ---- primitives ----

(define (scad:m:square k size center)
  (let* ((s (if (given size) size 1.0)) (l (cond ((number? s) (list s s)) ((and (vector? s) (>= (vector-length s) 2) (numbers? s)) (list (vector-ref s 0) (vector-ref s 1))) (else #f))))
    (cond ((not l) (warning "square: the size is no number and no vector of two") '())
          ((not (every (lambda (x) (and (finite? x) (> x 0.0))) l)) '())
          (else
           (let* ((middle (and (given center) (scad:true? center))) (x (if middle (/ (car l) -2.0) 0.0)) (y (if middle (/ (cadr l) -2.0) 0.0)))
             (list (make-region (make-rectangle (flat-point x y) (flat-point (+ x (car l)) (+ y (cadr l)))))))))))

(define (scad:m:circle k r d)
  (let ((r (radius r d 1.0)))
    (if (and (finite? r) (> r 0.0)) (list (ring-region (ring (facets r) r 0.0))) '())))

(define (scad:m:polygon k points paths convexity)
  (if (not (and (vector? points) (every point-numbers? (vector->list points))))
      (begin (warning "polygon: points is a list of vectors of two numbers") '())
      (let* ((all (vector-each (lambda (p) (flat-point (vector-ref p 0) (vector-ref p 1))) points)) (n (vector-length all)))
        (define (path p)
          (append-map (lambda (i) (let ((i (index-of i n))) (if i (list (vector-ref all i)) (begin (warning "polygon: a path names a point that does not exist") '())))) (vector->list p)))
        (cond ((not (vector? paths)) (region-of (list (vector->list all))))
              ((= (vector-length paths) 0) '())
              ((every vector? (vector->list paths)) (region-of (map path (vector->list paths))))
              (else (region-of (list (path paths))))))))

; ---- letters ----

; The width of an em of the font, for letters whose capitals have the height 1.
(define (em font) (let ((w (text-width 1.0 "\x2003;" #:font font))) (if (> w 0.5) w 1.3717)))
(define default-font "DejaVu Sans")
; OpenSCAD's names are "family:style=Bold".
(define (font-name font)
  (let* ((parts (let split ((l (string->list font)) (part '()) (all '()))
                  (cond ((null? l) (reverse (cons (list->string (reverse part)) all)))
                        ((char=? (car l) #\:) (split (cdr l) '() (cons (list->string (reverse part)) all)))
                        (else (split (cdr l) (cons (car l) part) all)))))
         (style (find (lambda (p) (and (> (string-length p) 6) (string=? (substring p 0 6) "style="))) (cdr parts)))
         (style (and style (substring style 6 (string-length style)))))
    (if (or (not style) (string=? style "Regular")) (car parts) (string-append (car parts) " " style))))
(define (known-font font)
  (let ((name (if (string? font) (font-name font) "")))
    (cond ((string=? name "") default-font)
          ((guard (e (#t #f)) (text-width 1.0 "x" #:font name) #t) name)
          (else (warning "text: there is no font ~a; the font ~a takes its place" name default-font) default-font))))
(define (one-of value names default) (let ((s (and (string? value) (string->symbol value)))) (if (memq s names) s default)))
; OpenSCAD 2021.01 divides advances and the heights that align letters by 1024, but outlines by 1000.
(define step-ratio (/ 1000.0 1024.0))
(define (scad:m:text k text size font halign valign spacing direction language script)
  (let* ((s (if (string? text) text (if (given text) (text-of text) ""))) (size (number-or size 10.0)) (font (known-font font)) (apart (* step-ratio (max 1e-3 (number-or spacing 1.0)))))
    (if (or (string=? s "") (not (> size 0.0)) (not (finite? size))) '()
        (let* ((capital (/ (* size (/ 100.0 72.0)) (em font))) (o (make-text origin capital s #:font font #:spacing apart)) (box (bounding-box o)))
          (if (not box) '()
              (let ((width (text-width capital s #:font font #:spacing apart)) (low (* step-ratio (cy (car box)))) (high (* step-ratio (cy (cadr box)))))
                (list (do-move o (vxyz (case (one-of halign '(left center right) 'left) ((center) (/ width -2.0)) ((right) (- width)) (else 0.0))
                                   (case (one-of valign '(top center bottom) 'baseline) ((top) (- high)) ((center) (/ (+ low high) -2.0)) ((bottom) (- low)) (else 0.0))
                                   0.0)))))))))

; ---- offsets ----

(define (scad:m:offset k r delta chamfer)
  (let* ((round? (number? r)) (d (cond (round? r) ((number? delta) delta) (else 1.0))) (o (flat-children k "offset")))
    (cond ((null? o) '())
          ((or (not (finite? d)) (= d 0.0)) (list (one o)))
          (else (made (do-offset (one o) d #:corners (cond (round? 'facets) ((and (given chamfer) (scad:true? chamfer)) 'square) (else 'mitre))
                        #:segments (if round? (max 3 (facets (abs d))) 32)))))))

; ---- solids and regions do not mix ----

(define (keep l test who what)
  (let ((kept (filter test l)))
    (if (< (length kept) (length l)) (warning "~a: ~a are ignored here" who what))
    kept))
(define (flat-children k who) (keep (all-children k) region? who "solids"))
(define (solid-children k who) (keep (all-children k) (lambda (o) (not (region? o))) who "flat shapes"))
; Returns the objects that are as flat as the first one, which is last in the list.
(define (alike l)
  (if (or (null? l) (null? (cdr l))) l
      (let ((flat? (region? (car (reverse l)))))
        (if (every (lambda (o) (eq? flat? (region? o))) l) l
            (keep l (lambda (o) (eq? flat? (region? o))) "union" (if flat? "solids beside flat shapes" "flat shapes beside solids"))))))

; ---- sums of flat shapes ----

; Returns the list of the points of a region's outline.
(define (region-rings o) (map curve-points (outline o)))
(define (curve-points c)
  (let* ((line (if (eq? (object-kind c) 'line) c (lowered c))) (a (object-arguments line)))
    (if (and (pair? a) (pair? (car a))) (without-repeats (car a)) '())))
(define (region-points o) (append-map (lambda (l) l) (region-rings o)))
(define (convex? o) (let ((h (hull (list o)))) (< (- (area h) (area o)) (* 1e-9 (area h)))))
(define (flat-sum a b)
  (if (and (convex? a) (convex? b))
      (let ((q (region-points b))) (hull (append-map (lambda (p) (map (lambda (v) (flat-point (+ (cx p) (cx v)) (+ (cy p) (cy v)))) q)) (region-points a))))
      (let ((thick (lambda (o) (do-extrude (apply make-region (map make-polygon (region-rings o))) 1.0))))
        (do-move (do-section (minkowski (thick a) (thick b)) (make-plane (xyz 0.0 0.0 1.0) (vxyz 0.0 0.0 1.0))) (vxyz 0.0 0.0 -1.0)))))
