; Operations on whole solids: parts, pieces, holes, threads, relief. After flattening.scm. Names that begin with % are
; hidden from programs. Compiled into the binary when it is built.

; Returns the object, or the union of a list, which must be a solid or empty, with users' kinds drawn.
(define (%solid-given who name x)
  (let ((o (if (and (pair? x) (list? x) (every object? x)) (unite x) x)))
    (if (not (and (object? o) (or (solid? o) (empty-object? o)))) (error who "~a must be a solid, got ~s" name x))
    (%drawn o)))

; Returns the length of the diagonal of the box around o.
(define (%size-of o) (let ((b (bounding-box o))) (distance (first b) (second b))))

; Needs a length that is not too large for coordinates.
(define (%need-length who name x)
  (%need-number who name x)
  (if (>= (abs x) 1e60) (error who "~a is too large: lengths must stay below 1e60, got ~a" name x)))
(define (%need-positive-length who name x)
  (%need-positive who name x)
  (%need-length who name x))

; Needs a length that changes a solid of this size: coordinates have 16 digits.
(define (%need-visible who name x o)
  (let ((least (* 1e-9 (%size-of o))))
    (if (< (abs x) least) (error who "~a ~a is too small for o: the least is ~a" name x (%number-text least)))))

; Needs a length beside which the solid is still seen, too.
(define (%need-similar who name x o)
  (%need-visible who name x o)
  (let ((most (* 1e9 (%size-of o))))
    (if (> (abs x) most) (error who "~a ~a is too large for o: the most is ~a" name x (%number-text most)))))

; Returns a positive number with five digits, rounded down.
(define (%number-text x)
  (if (< 1e-300 x 1e300)
      (let ((unit (expt 10. (- (floor (/ (log x) (log 10))) 4)))) ; divided where 10^n is exact
        (if (< unit 1)
            (let ((n (round (/ 1 unit)))) (/ (floor (+ (* x n) 1e-2)) n))
            (* (floor (+ (/ x unit) 1e-2)) unit)))
      x))

; ---- parts that do not touch ----

; Returns the union of a list of solids, or its one solid.
(define (%all-of-them l) (if (null? (cdr l)) (car l) (unite l)))

; Returns a box around o, larger by a thousandth of its diagonal.
(define (%box-around o)
  (let* ((b (bounding-box o)) (d (* 1e-3 (distance (first b) (second b)))))
    (list (+xyz (first b) (- d) (- d) (- d)) (+xyz (second b) d d d))))

(define (%boxes-apart? a b)
  (define (apart? get) (or (< (get (second a)) (get (first b))) (< (get (second b)) (get (first a)))))
  (or (apart? cx) (apart? cy) (apart? cz)))

(define (%all-apart? boxes)
  (or (null? boxes)
      (and (every (lambda (b) (%boxes-apart? (car boxes) b)) (cdr boxes)) (%all-apart? (cdr boxes)))))

; Returns the parts of a solid that is no union: itself, or its intersections with boxes, or meshes if the boxes of the
; parts meet.
(define (%carved-parts o)
  (let ((parts (%solid-parts (list o))))
    (cond
      ((null? parts) '())
      ((null? (cdr parts)) (list o))
      (else
        (let ((boxes (map (lambda (p) (%box-around (cdr p))) parts)))
          (if (%all-apart? boxes)
              (map (lambda (b) (intersect o (make-box (first b) (second b)))) boxes)
              (map cdr parts)))))))

; Returns the parts of a union: of pieces that are in one part each, those that touch become one.
(define (%united-parts pieces)
  (if (or (null? pieces) (null? (cdr pieces)))
      pieces
      (let ((all (list->vector pieces)))
        (map (lambda (numbers) (%all-of-them (map (lambda (i) (vector-ref all i)) numbers)))
             (sort (map car (%solid-parts pieces)) (lambda (a b) (< (car a) (car b))))))))

(define (%parts-of o)
  (let ((within (lambda (f) (map f (%parts-of (car (object-children o)))))))
    (case (object-kind o)
      ((empty-object) '())
      ((transform) (within (lambda (p) (do-transform p (car (object-arguments o))))))
      ((with-material) (within (lambda (p) (with-material (car (object-arguments o)) p))))
      ((layer) (within (lambda (p) (layer (car (object-arguments o)) p))))
      ((unite) (%united-parts (append-map %parts-of (object-children o))))
      (else (%carved-parts o)))))

(define (decompose o) (%parts-of (%solid-given 'decompose 'o o)))

; ---- pieces on both sides of a tool ----

(define (%plane-tool? x) (or (plane? x) (gvector? x) (memq x '(xy yz xz))))

(define (split o tool)
  (let ((o (%solid-given 'split 'o o)))
    (define (both inner outer)
      (let ((a (decompose inner)) (b (decompose outer)))
        (cond ((null? a) (if (null? b) '() (decompose o))) ((null? b) (decompose o)) (else (append a b)))))
    (define (by-solid s) (both (intersect o s) (subtract o s)))
    (cond
      ((empty-object? o) '())
      ((%plane-tool? tool) (by-solid (make-half-space tool)))
      ((not (object? tool)) (error 'split "tool must be a plane, a surface or a solid, got ~s" tool))
      ((empty-object? tool) (decompose o))
      ((solid? tool) (by-solid tool))
      ((or (surface? tool) (region? tool)) (by-solid (%split tool o)))
      (else (error 'split "tool must be a plane, a surface or a solid, got ~s" tool)))))

; ---- holes ----

; Returns a list of two positive numbers, or reports it.
(define (%need-sizes who name form l)
  (if (not (and (list? l) (= (length l) 2) (every (lambda (x) (and (real? x) (finite? x) (positive? x))) l)))
      (error who "~a must be ~a of positive numbers, got ~s" name form l)))

; The solid to subtract: a cylinder of diameter d from p along v.
(define (make-hole p v d depth #:counterbore [counterbore any? #f] #:countersink [countersink any? #f] #:segments [segments any? #f])
  (%need-point 'make-hole 'p p)
  (if (not (and (gvector? v) (> (vlength v) 0))) (error 'make-hole "v must be a gvector longer than 0, got ~s" v))
  (%need-positive-length 'make-hole 'd d)
  (%need-positive-length 'make-hole 'depth depth)
  (%need-segments 'make-hole segments)
  (let ((u (unitize v)))
    (define (at s) (p+v p (v*r u s)))
    (define (wider what diameter)
      (if (<= diameter d) (error 'make-hole "~a's diameter must exceed d, ~a, got ~a" what d diameter)))
    (define (deep what s)
      (if (> s depth) (error 'make-hole "~a is ~a deep, and the hole ~a" what s depth)))
    (define (bored l)
      (%need-sizes 'make-hole 'counterbore "(list diameter depth)" l)
      (wider "counterbore" (first l))
      (deep "counterbore" (second l))
      (list (make-cylinder p (at (second l)) (/ (first l) 2) #:segments segments)))
    (define (sunk l)
      (%need-sizes 'make-hole 'countersink "(list diameter angle)" l)
      (wider "countersink" (first l))
      (if (>= (second l) pi) (error 'make-hole "countersink's angle must be less than pi, got ~a" (second l)))
      (let ((height (/ (- (first l) d) 2 (tan (/ (second l) 2)))))
        (deep "countersink" height)
        (list (make-cut-cone p (/ (first l) 2) (at height) (/ d 2) #:segments segments))))
    (%all-of-them
      (append (list (make-cylinder p (at depth) (/ d 2) #:segments segments))
              (if counterbore (bored counterbore) '())
              (if countersink (sunk countersink) '())))))

; ---- threads ----

; Returns the number of facets of a turn of radius r, as the program asks, or 64.
(define (%turn-facets r)
  (or (current-segments)
      (let ((t (current-tolerance))) (and t (> t 0) (max 32 (exact (ceiling (/ pi (acos (max 0.5 (- 1 (/ t r))))))))))
      64))

; The basic profile of ISO 68-1: flanks at 60 degrees, flat over an eighth of the pitch at the crest and a quarter at the
; root. The surface is a strip of four facets a pitch; turn follows turn.
(define (thread d pitch length #:standard [standard any? 'metric] #:segments [segments any? #f])
  (%need-positive-length 'thread 'd d)
  (%need-positive-length 'thread 'pitch pitch)
  (%need-positive-length 'thread 'length length)
  (%need-segments 'thread segments)
  (if (not (eq? standard 'metric)) (error 'thread "standard must be 'metric, got ~s" standard))
  (let* ((high (* (/ 5 8) (/ (sqrt 3) 2) pitch)) (r (/ d 2)) (root (- r high)) (n (or segments (%turn-facets r)))
         (turns (+ 2 (ceiling (/ length pitch)))))
    (if (<= root 0) (error 'thread "d must exceed ~a, the threads' depth on both sides, got ~a" (* 2 high) d))
    (if (> (* n turns) 200000) (error 'thread "the thread has ~a turns of ~a facets, and 200000 facets are the most; give fewer #:segments" (if (finite? turns) (exact turns) "too many") n))
    ; the four points of a pitch at row i, from the beginning of the root's flat upwards
    (let* ((rows (exact (* n turns))) (step (/ pitch n)) (low (* -2 pitch))
           (radii (list root root r r)) (heights (map (lambda (k) (* k pitch)) '(0 1/4 9/16 11/16)))
           (row (lambda (i)
                  (let ((phi (* 2 pi (/ (modulo i n) n))) (z (+ low (* i step))))
                    (map (lambda (q h) (cyl q phi (+ z h))) radii heights))))
           (last-row (+ rows n)))
      (define (number i k) (+ (* 4 i) k 1)) ; of point k of row i, from 1
      (define bottom (number (+ last-row 1) 0))
      (define top (+ bottom 1))
      ; facets between two rows: three of the profile, and the next turn's flank below row i + n
      (define (facets i)
        (append
          (map (lambda (k) (list (number i k) (number (+ i 1) k) (number (+ i 1) (+ k 1)) (number i (+ k 1)))) '(0 1 2))
          (if (<= (+ i n 1) last-row)
              (list (list (number i 3) (number (+ i 1) 3) (number (+ i n 1) 0) (number (+ i n) 0)))
              '())))
      (define (fan apex up points) ; triangles from an end of the axis
        (map (lambda (a b) (if up (list apex a b) (list apex b a))) (drop-right points 1) (cdr points)))
      (let* ((points (append (append-map row (iota (+ last-row 1))) (list (xyz 0 0 low) (xyz 0 0 (+ low (* last-row step) pitch)))))
             (start (append (map (lambda (i) (number i 0)) (iota (+ n 1))) (map (lambda (k) (number 0 k)) '(3 2 1 0))))
             (from (- last-row n))
             (end (append (map (lambda (i) (number (+ from i) 3)) (iota (+ n 1))) (map (lambda (k) (number last-row k)) '(2 1 0)) (list (number from 3))))
             (screw (make-polyface-mesh points (append (append-map facets (iota last-row)) (fan bottom #f start) (fan top #t end)))))
        (do-slice (do-slice screw (make-plane origin uz)) (make-plane (xyz 0 0 length) (v*r uz -1)))))))

; ---- relief ----

; Returns a unit normal of the region's plane that points away from o.
(define (%away-from o region)
  (let* ((n (%region-normal region)) (p (centroid region)) (b (bounding-box o)) (step (* 1e-6 (distance (first b) (second b))))
         (above (contains? o (p+v p (v*r n step)))) (below (contains? o (p+v p (v*r n (- step))))))
    (cond
      ((and below (not above)) n)
      ((and above (not below)) (v*r n -1))
      ((>= (dot n (p->q (centroid o) p)) 0) n)
      (else (v*r n -1)))))

; The surface under the region moves by the depth along the region's normal, away from o.
(define (emboss o region depth)
  (let ((o (%solid-given 'emboss 'o o)))
    (if (not (and (object? region) (region? region))) (error 'emboss "region must be a region, got ~s" region))
    (%need-length 'emboss 'depth depth)
    (cond
      ((or (= depth 0) (empty-object? o)) o)
      (else
       (%need-similar 'emboss 'depth depth o)
       (let* ((n (%away-from o region)) (long (+ (* 2 (abs depth)) (* 2 (%size-of (list o region)))))
              (below (do-extrude region (v*r n (- long)))) ; from the region through o
              (moved (do-move o (v*r n depth))))
         (if (> depth 0)
             (let ((above (do-extrude (do-move region (v*r n depth)) (v*r n (- long)))))
               (unite o (intersect moved above)))
             (subtract o (subtract below moved))))))))

; ---- text along curves and on surfaces ----

; Returns a list of letters, each a list of its region about its own middle and the distance of the middle from the start.
(define (%letters string size)
  (let loop ((i 0) (out '()))
    (if (= i (string-length string))
        (reverse out)
        (let* ((c (substring string i (+ i 1))) (from (text-width size (substring string 0 i))) (w (text-width size c)))
          (loop (+ i 1) (if (string=? c " ") out (cons (list (make-text (xy (/ w -2) 0) size c) (+ from (/ w 2))) out)))))))

; Each letter stands on the curve, turned with it: in the curve's plane, on the left of its direction.
(define (%text-on-curve c string size)
  (let* ((letters (%letters string size)) (long (curve-length c)) (needs (text-width size string)))
    (if (> needs long) (error 'text-on "the text is ~a long, and the curve ~a" (%number-text needs) (%number-text long)))
    (let* ((from (/ (- long needs) 2)) (z (%curve-up c)))
      (unite
        (map (lambda (l)
               (let* ((s (+ from (second l))) (p (curve-point c s)) (x (curve-tangent c s)) (y (unitize (cross z x))) (n (cross x y)))
                 (do-transform (first l)
                   (make-matrix (cx x) (cx y) (cx n) (cx p) (cy x) (cy y) (cy n) (cy p) (cz x) (cz y) (cz n) (cz p) 0 0 0 1))))
             letters)))))

; Returns the normal of the curve's plane, +Z if the curve is straight.
(define (%curve-up c)
  (let* ((p (curve-division c 12)) (n (fold (lambda (a b sum) (v+v sum (cross (p->q (first p) a) (p->q (first p) b)))) (vxyz 0 0 0) (drop-right p 1) (cdr p)))
         (size (distance (first (bounding-box c)) (second (bounding-box c)))))
    (cond
      ((< (vlength n) (* 1e-6 size size)) (if (%parallel? uz (curve-tangent c 0)) (vxyz 0 -1 0) uz))
      ((< (cz n) (* -1e-6 (vlength n))) (v*r (unitize n) -1))
      (else (unitize n)))))

; Letters bent onto a surface of rows of points: along its rows' direction, in the middle.
(define (%text-on-surface o string size)
  (if (not (memq (object-kind o) '(surface mesh)))
      (error 'text-on "the surface must be a make-surface or make-mesh, whose rows give the direction; got a ~a" (object-kind o)))
  (let* ((a (object-arguments o)) (points (list->vector (first a))) (columns (second a)) (rows (quotient (vector-length points) columns)))
    (define (clip x n) (max 0 (min (- n 1.) x)))
    (define (at u v) ; of row and column, between the points linearly
      (let* ((u (clip u rows)) (v (clip v columns)) (i (min (- rows 2) (exact (floor u)))) (k (min (- columns 2) (exact (floor v)))) (f (- u i)) (g (- v k))
             (p (lambda (i k) (vector-ref points (+ (* i columns) k)))))
        (intermediate-point (intermediate-point (p i k) (p (+ i 1) k) f) (intermediate-point (p i (+ k 1)) (p (+ i 1) (+ k 1)) f) g)))
    (define (lengths n place) ; the distances along a line of n points
      (let loop ((i 1) (sum 0) (out '(0)))
        (if (= i n) (list->vector (reverse out)) (let ((s (+ sum (distance (place (- i 1)) (place i))))) (loop (+ i 1) s (cons s out))))))
    (define (index table s) ; the place in a table of rising lengths
      (let loop ((i 1))
        (if (or (= i (- (vector-length table) 1)) (>= (vector-ref table i) s))
            (let ((a (vector-ref table (- i 1))) (b (vector-ref table i))) (+ (- i 1) (if (> b a) (/ (- s a) (- b a)) 0)))
            (loop (+ i 1)))))
    (let* ((half (/ (- columns 1) 2)) (along (lengths rows (lambda (i) (at i half)))) (across (lengths columns (lambda (k) (at (/ (- rows 1) 2) k))))
           (long (vector-ref along (- rows 1))) (high (vector-ref across (- columns 1))) (needs (text-width size string)))
      (if (or (> needs long) (> size high))
          (error 'text-on "the text is ~a long and ~a high, and the surface ~a and ~a" (%number-text needs) size (%number-text long) (%number-text high)))
      (do-deform (make-text (xy (/ (- long needs) 2) (/ (- high size) 2)) size string)
        (lambda (p) (at (index along (cx p)) (index across (cy p))))))))

(define (text-on o string size)
  (if (not (string? string)) (error 'text-on "string must be a string, got ~s" string))
  (%need-positive-length 'text-on 'size size)
  (cond
    ((and (object? o) (curve? o)) (%text-on-curve o string size))
    ((and (object? o) (surface? o)) (%text-on-surface o string size))
    (else (error 'text-on "o must be a curve or a surface, got ~s" o))))
