; Solids from flat shapes, and flat shapes from solids. The walls have OpenSCAD's facets.

; ---- outlines within each other ----

; Returns a list of (depth . ring): depth is the number of rings around the ring, and all rings are counter-clockwise.
(define (deep-rings o)
  (let* ((rings (filter has-area? (region-rings o))) (filled (map ring-region rings)))
    (map (lambda (r f)
           (let ((p (mid (car r) (cadr r))))
             (cons (length (filter (lambda (g) (and (not (eq? f g)) (contains? g p))) filled)) (if (< (twice-area r) 0.0) (reverse r) r))))
         rings filled)))
; Returns a list of at most one solid: (make ring) returns the solid within a ring, or #f.
(define (solid-of-rings o make)
  (let* ((rings (deep-rings o)) (deepest (fold (lambda (r most) (max most (car r))) 0 rings)))
    (let loop ((d 0) (all '()))
      (if (> d deepest) all
          (let ((now (filter values (map (lambda (r) (make (cdr r))) (filter (lambda (r) (= (car r) d)) rings)))))
            (loop (+ d 1)
              (cond ((null? now) all) ((even? d) (list (one (append now all)))) ((null? all) all) (else (list (subtract (car all) now))))))))))

; Returns the closed mesh of layers of points, as many in each. Points of a layer that are equal become one. caps:
; whether the first and the last layer are faces. (cut-forward a b c d) is true if the quadrilateral of a and b
; in a layer and c and d in the next is cut from a to c.
(define (layered layers closed caps cut-forward)
  (let* ((numbers (make-hash)) (points '()) (count 0) (n (length (car layers))))
    (define (number! layer p)
      (let ((key (list layer (cx p) (cy p) (cz p))))
        (or (hash-ref numbers key #f)
            (begin (set! count (+ count 1)) (set! points (cons p points)) (hash-set! numbers key count) count))))
    (define (row layer j) (list->vector (map (lambda (p) (number! j p)) layer)))
    (let* ((rows (map row layers (iota (length layers)))) (rows (if closed (append rows (list (car rows))) rows)) (all (list->vector (reverse points))) (faces '()))
      (define (point i) (vector-ref all (- i 1)))
      (define (face! . l) (let ((l (distinct l))) (if (>= (length l) 3) (set! faces (cons l faces)))))
      (let each-row ((r rows) (j 0))
        (if (pair? (cdr r))
            (let ((low (car r)) (high (cadr r)))
              (let each ((i 0))
                (if (< i n)
                    (let* ((k (if (= (+ i 1) n) 0 (+ i 1))) (a (vector-ref low i)) (b (vector-ref low k)) (c (vector-ref high k)) (d (vector-ref high i)))
                      (case (cut-forward (point a) (point b) (point c) (point d))
                        ((flat) (face! a b c d))
                        ((#t) (face! a b c) (face! a c d))
                        (else (face! a b d) (face! b c d)))
                      (each (+ i 1)))))
              (each-row (cdr r) (+ j 1)))))
      (if caps
          (let ((first (distinct (reverse (vector->list (car rows))))) (last (distinct (vector->list (car (reverse rows))))))
            (if (>= (length first) 3) (set! faces (cons first faces)))
            (if (>= (length last) 3) (set! faces (cons last faces)))))
      (make-polyface-mesh (reverse points) (reverse faces)))))
; Returns the numbers without those that equal the number before them, around the ring.
(define (distinct l)
  (let* ((l (fold (lambda (x all) (if (and (pair? all) (eqv? x (car all))) all (cons x all))) '() l)) (l (if (and (pair? l) (pair? (cdr l)) (eqv? (car l) (car (reverse l)))) (cdr l) l)))
    (reverse l)))

; ---- linear_extrude ----

(define (special-number name default) (let ((v (special name))) (if (number? v) v default)))
; Returns the number of slices of a twisted or tapered wall; r is the greatest radius, in the plane, of its points.
(define (slices-of r h twist low high)
  (let* ((turn (abs twist)) (fn (special-number '$fn 0.0)) (fa (max 0.01 (special-number '$fa 12.0))) (fs (max 0.01 (special-number '$fs 2.0))) (least (max 1 (ceiling (/ turn 120.0))))
         (wanted (if (> fn 0.0) (ceiling (* fn (/ turn 360.0))) (min (ceiling (/ turn fa)) (ceiling (/ (spiral-length (* r low) (* r high) (* turn degree) h) fs))))))
    (exact (max least wanted))))
; The length of a line that climbs by h and turns by an angle, while its radius changes evenly from a to b.
(define (spiral-length a b turn h)
  (let ((n 64) (rise (+ (* h h) (* (- b a) (- b a)))))
    (/ (fold (lambda (i sum) (let ((r (+ a (* (- b a) (/ (+ i 0.5) n))))) (+ sum (sqrt (+ rise (* r r turn turn)))))) 0.0 (iota n)) n)))
(define (greatest f l) (fold (lambda (x most) (max most (f x))) 0.0 l))
(define (slice-count points h twist sx sy)
  (let ((fn (special-number '$fn 0.0)) (fs (max 0.01 (special-number '$fs 2.0))))
    (cond ((not (= twist 0.0)) (slices-of (greatest (lambda (p) (sqrt (+ (* (cx p) (cx p)) (* (cy p) (cy p))))) points) h twist 1.0 (if (= sx sy) sx (max sx sy))))
          ((= sx sy) 1)
          ((> fn 0.0) (exact (ceiling fn)))
          (else
           (let ((d (greatest (lambda (p) (sqrt (+ (* (cx p) (cx p) (- sx 1.0) (- sx 1.0)) (* (cy p) (cy p) (- sy 1.0) (- sy 1.0))))) points)))
             (max 1 (exact (ceiling (/ (sqrt (+ (* d d) (* h h))) fs)))))))))

; The point p of the slice that is the part t of the height.
(define (slice-point p t h twist sx sy)
  (let* ((a (- (* twist t))) (c (cosine a)) (s (sine a)) (kx (+ 1.0 (* t (- sx 1.0)))) (ky (+ 1.0 (* t (- sy 1.0)))))
    (xyz (* kx (- (* c (cx p)) (* s (cy p)))) (* ky (+ (* s (cx p)) (* c (cy p)))) (* h t))))
(define (slice ring t h twist sx sy) (map (lambda (p) (slice-point p t h twist sx sy)) ring))
; A wall is cut along the shorter diagonal, seen from above.
(define (shorter? a c b d back)
  (let* ((flat (lambda (p q) (let ((x (- (cx p) (cx q))) (y (- (cy p) (cy q)))) (sqrt (+ (* x x) (* y y)))))) (ac (flat a c)) (bd (flat b d)))
    (if (< (abs (- ac bd)) (* 1e-6 (max ac bd))) back (< ac bd))))
(define (twisted ring slices h twist sx sy)
  (let ((layers (map (lambda (j) (slice ring (/ j 1.0 slices) h twist sx sy)) (iota (+ slices 1)))) (back (>= twist 0.0)))
    (layered layers #f #t (lambda (a b c d) (if (and (= twist 0.0) (= sx sy)) 'flat (shorter? a c b d back))))))

(define (scad:m:linear_extrude k file layer height origin scale center twist slices convexity)
  (let* ((h (cond ((number? height) height) ((number? file) file) (else 100.0))) (twist (number-or twist 0.0))
         (two (and (vector? scale) (>= (vector-length scale) 2) (numbers? scale))) (sx (max 0.0 (if two (vector-ref scale 0) (number-or scale 1.0)))) (sy (max 0.0 (if two (vector-ref scale 1) (number-or scale 1.0))))
         (flat (if (string? file) (imported-region file layer) (flat-children k "linear_extrude"))))
    (cond ((or (null? flat) (not (finite? h)) (not (finite? twist))) '())
          ((<= h 0.0) (warning "linear_extrude: the height ~a is not positive" (text-of h)) '())
          (else
           (let* ((o (one flat))
                  (solids (if (and (= twist 0.0) (= sx 1.0) (= sy 1.0)) (made (do-extrude o h))
                              (let ((n (if (number? slices) (max 1 (exact (truncate slices))) (slice-count (region-points o) h twist sx sy)))) (solid-of-rings o (lambda (ring) (twisted ring n h twist sx sy)))))))
             (if (and (given center) (scad:true? center)) (map (lambda (s) (do-move s (vxyz 0.0 0.0 (/ h -2.0)))) solids) solids))))))

; ---- rotate_extrude ----

(define (turned-point p a) (if (= (cx p) 0.0) (xyz 0.0 0.0 (cy p)) (xyz (* (cx p) (cosine a)) (* (cx p) (sine a)) (cy p))))
; Returns the solid of a ring; n facets from the angle `start`, in degrees, over the angle `turn`.
(define (revolved ring n start turn)
  (let* ((whole (= (abs turn) 360.0)) (step (/ turn n)) (angles (map (lambda (j) (+ start (* j step))) (iota (if whole n (+ n 1)))))
         (angles (if (> turn 0.0) (reverse angles) angles)) (left (every (lambda (p) (<= (cx p) 0.0)) ring)))
    (on-axis (map (lambda (a) (map (lambda (p) (turned-point p a)) (if left (reverse ring) ring))) angles) whole)))
; Points on the axis are the same in all layers: their layers' numbers differ only elsewhere.
(define (on-axis layers whole)
  (let* ((n (length (car layers))) (numbers (make-hash)) (points '()) (count 0) (faces '()))
    (define (number! j p)
      (let ((key (if (and (= (cx p) 0.0) (= (cy p) 0.0)) (cz p) (list j (cx p) (cy p) (cz p)))))
        (or (hash-ref numbers key #f) (begin (set! count (+ count 1)) (set! points (cons p points)) (hash-set! numbers key count) count))))
    (define (face! l) (let ((l (distinct l))) (if (>= (length l) 3) (set! faces (cons l faces)))))
    (let* ((rows (map (lambda (layer j) (list->vector (map (lambda (p) (number! j p)) layer))) layers (iota (length layers)))) (around (if whole (append rows (list (car rows))) rows)))
      (let each ((r around))
        (if (pair? (cdr r))
            (begin
              (for-each (lambda (i) (let ((k (if (= (+ i 1) n) 0 (+ i 1)))) (face! (list (vector-ref (car r) i) (vector-ref (car r) k) (vector-ref (cadr r) k) (vector-ref (cadr r) i))))) (iota n))
              (each (cdr r)))))
      (if (not whole) (begin (face! (reverse (vector->list (car rows)))) (face! (vector->list (car (reverse rows))))))
      (make-polyface-mesh (reverse points) (reverse faces)))))

(define (scad:m:rotate_extrude k file layer origin scale angle convexity)
  (let* ((a (cond ((number? angle) angle) ((number? file) file) (else 360.0))) (turn (if (and (finite? a) (< 0.0 (abs a) 360.0)) a 360.0))
         (flat (if (string? file) (imported-region file layer) (flat-children k "rotate_extrude"))))
    (if (or (null? flat) (= a 0.0)) '()
        (let* ((o (one flat)) (points (region-points o)) (xs (map cx points)) (low (apply min 0.0 xs)) (high (apply max 0.0 xs)))
          (cond ((and (< low -1e-9) (> high 1e-9))
                 (warning "rotate_extrude: the shape is on both sides of the axis: X goes from ~a to ~a" (text-of low) (text-of high)) '())
                (else
                 (let ((n (max 1 (exact (truncate (/ (* (facets (- high low)) (abs turn)) 360.0))))))
                   (solid-of-rings o (lambda (ring) (revolved ring (if (= turn 360.0) (max n 3) n) (if (= turn 360.0) 180.0 0.0) turn))))))))))

; ---- flat shapes from solids ----

(define (scad:m:projection k cut)
  (let ((l (solid-children k "projection")) (plane (make-plane origin (vxyz 0.0 0.0 1.0))))
    (cond ((null? l) '())
          ((and (given cut) (scad:true? cut)) (let ((box (bounding-box (one l)))) (if (and box (<= (cz (car box)) 0.0 (cz (cadr box)))) (made (do-section (one l) plane)) '())))
          (else (made (do-project (one l) plane))))))

; ---- sums, sizes ----

(define (scad:m:minkowski k convexity)
  (let ((l (filter pair? (each-child k))))
    (if (null? l) '()
        (let* ((parts (map (lambda (x) (one (alike x))) l)) (flat? (region? (car parts))) (parts (keep parts (lambda (o) (eq? flat? (region? o))) "minkowski" "objects of another dimension")))
          (list (fold (lambda (b a) (if flat? (flat-sum a b) (minkowski a b))) (car parts) (cdr parts)))))))

(define (scad:m:resize k newsize auto convexity)
  (let* ((l (alike (all-children k))) (new (or (and (vector? newsize) (numbers? newsize) (vector->list newsize)) '())) (wanted (lambda (i) (if (< i (length new)) (list-ref new i) 0.0)))
         (own (lambda (i) (cond ((vector? auto) (let ((v (scad:index auto (exact->inexact i)))) (and (not (eq? v undef)) (scad:true? v)))) (else (and (given auto) (scad:true? auto)))))))
    (if (null? l) '()
        (let* ((o (one l)) (box (bounding-box o)))
          (if (not box) l
              (let* ((sizes (map (lambda (c) (- (c (cadr box)) (c (car box)))) (list cx cy cz)))
                     (ratio (lambda (i) (let ((s (list-ref sizes i))) (if (and (> (wanted i) 0.0) (> s 0.0)) (/ (wanted i) s) #f))))
                     (ratios (map ratio '(0 1 2))) (most (fold (lambda (r m) (if r (max r m) m)) 0.0 ratios)) (common (if (> most 0.0) most 1.0)))
                (list (placed o (apply scaling (map (lambda (r i) (or r (if (own i) common 1.0))) ratios '(0 1 2)))))))))))
