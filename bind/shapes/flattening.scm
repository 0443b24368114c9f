; Flat pieces: surfaces unrolled and solids unfolded. After engraving.scm. Names that begin with % are hidden from
; programs. Compiled into the binary when it is built.

; ---- cylinders and cones, by formula ----

; Returns the region between the radii r < q about the origin, from +X through `angle`.
(define (%sector r q angle)
  (cond
    ((< angle (- (* 2 pi) 1e-9))
     (make-region (append (list (make-arc origin q 0 angle) (make-line (pol q angle) (pol r angle)))
                          (if (> r 0) (list (make-arc origin r angle 0)) '())
                          (list (make-line (pol r 0) (pol q 0))))))
    ((> r 0) (make-donut origin r q))
    (else (make-region (make-circle origin q)))))

; Returns the wall of a cone of radii a and b at its ends, unrolled: `along` is the length from end to end on the wall.
(define (%cone-wall a b along angle)
  (if (<= (abs (- a b)) (* 1e-9 (+ a b along)))
      (make-region (make-rectangle origin (xy (* a angle) along)))
      (let ((k (/ along (abs (- a b))))) (%sector (* k (min a b)) (* k (max a b)) (/ angle k)))))

; Returns the factor of a similarity, or #f for a matrix that changes lengths unevenly.
(define (%similar-factor m)
  (let* ((size (lambda (p q) (curve-length (do-transform (make-line p q) m))))
         (k (size origin (xyz 1 0 0))))
    (and (every (lambda (p q l) (<= (abs (- (size p q) (* k l))) (* 1e-9 k)))
                (list origin origin (xyz 1 0 0) (xyz 1 0 0) (xyz 0 1 0)) (list (xyz 0 1 0) (xyz 0 0 1) (xyz 0 1 0) (xyz 0 0 1) (xyz 0 0 1))
                (list 1 1 (sqrt 2) (sqrt 2) (sqrt 2)))
         k)))

; Returns the distance of p from the axis through q along the unit vector d.
(define (%axis-distance p q d) (vlength (cross d (p->q q p))))

; Returns the region of an extruded curve that is perpendicular to the way, or #f.
(define (%unroll-extrusion o)
  (let* ((a (object-arguments o)) (d (first a)) (c (car (object-children o))) (points (curve-division c 64)) (p (car points)))
    (and (= 0 (second a)) (= 0 (third a)) (eqv? 1.0 (exact->inexact (fourth a)))
         (let ((size (+ (vlength d) (curve-length c))) (up (unitize d)))
           (every (lambda (q) (<= (abs (dot up (p->q p q))) (* 1e-9 size))) points))
         (make-region (make-rectangle origin (xy (curve-length c) (vlength d)))))))

; Returns the region of a revolved straight line, or #f.
(define (%unroll-revolved o)
  (let* ((a (object-arguments o)) (c (car (object-children o))) (ends (curve-division c 1)) (p (first ends)) (q (last ends)) (d (unitize (second a))))
    (and (<= (abs (- (curve-length c) (distance p q))) (* 1e-12 (distance p q)))
         (%cone-wall (%axis-distance p (first a) d) (%axis-distance q (first a) d) (distance p q) (abs (- (fourth a) (third a)))))))

(define (%slant a b c1 c2) (sqrt (+ (square (- a b)) (square (distance c1 c2)))))

; Returns the region of a kind that has a formula, or #f.
(define (%unroll-exact o)
  (let ((a (object-arguments o)))
    (case (object-kind o)
      ((transform)
       (let ((k (%similar-factor (first a))) (r (%unroll-exact (car (object-children o)))))
         (and k r (if (= k 1) r (do-scale r k)))))
      ((with-material) (let ((r (%unroll-exact (car (object-children o))))) (and r (with-material (first a) r))))
      ((layer) (let ((r (%unroll-exact (car (object-children o))))) (and r (layer (first a) r))))
      ((extrude) (and (surface? o) (%unroll-extrusion o)))
      ((revolve) (and (surface? o) (%unroll-revolved o)))
      ((cylinder) (%unroll-cylinder o))
      ((cone) (%cone-wall (third a) 0 (%slant (third a) 0 (first a) (second a)) (* 2 pi)))
      ((cut-cone) (%cone-wall (second a) (fourth a) (%slant (second a) (fourth a) (first a) (third a)) (* 2 pi)))
      (else #f))))

(define (%unroll-cylinder o)
  (let ((a (object-arguments o)))
    (if (point? (second a))
        (%cone-wall (third a) (third a) (distance (first a) (second a)) (* 2 pi))
        (%cone-wall (third a) (third a) (abs (second a)) (* 2 pi)))))

; ---- grids whose rows are straight ----

(define (%straight? points)
  (let* ((p (car points)) (q (last points)) (l (distance p q)))
    (and (> l 0) (every (lambda (r) (<= (vlength (cross (p->q p r) (p->q p q))) (* 1e-9 l l))) points))))

; Returns the strip between the ends of the rows, if all rows are straight, or all columns; else #f.
(define (%ruled-strip o)
  (if (eq? (object-kind o) 'ruled-loft) (%loft-strip o) (%grid-strip o)))

; Returns the strip between the sections of a ruled loft of two curves, if its area agrees with the loft's.
(define (%loft-strip o)
  (let ((sections (object-children o)) (n 128))
    (and (= (length sections) 2) (every curve? sections)
         (let* ((rulings (map list (curve-division (first sections) n) (curve-division (second sections) n)))
                (fine (make-mesh (map (lambda (r) (line-sequence (first r) (second r) 33)) rulings))))
           (and (<= (abs (- (area fine) (area o))) (* 1e-3 (area o))) (make-mesh rulings))))))

(define (%grid-strip o)
  (and (memq (object-kind o) '(surface mesh))
       (let* ((a (object-arguments o)) (n (second a)))
         (define (rows l) (if (null? l) '() (cons (take l n) (rows (drop l n)))))
         (define (strip lines closed)
           (and (every %straight? lines)
                (make-mesh (map (lambda (l) (list (car l) (last l))) (if closed (append lines (list (car lines))) lines)))))
         (let ((lines (rows (first a))))
           (or (strip lines (third a)) (strip (apply map list lines) (fourth a)))))))

(define (%percent x) (number->string (/ (round (* 10000. x)) 100)))

; Warns of the twist of a ruled surface, and returns its region.
(define (%unrolled found)
  (if (> (fifth found) 1e-4)
      (%warn (format "unroll: the ruled surface is not developable: laid flat, it is up to ~a % wider halfway along its rulings" (%percent (fifth found)))))
  (first found))

; Returns the region moved and turned into the plane XY, with its looks. A level region is only moved.
(define (%region-flat o)
  (let* ((corners (map car (%curve-corners (first (outline o))))) (n (%loop-normal corners)))
    (if (> (abs (cz n)) (- 1 1e-12))
        (do-move o (vxyz 0 0 (- (cz (first corners)))))
        (let* ((p (first corners)) (x (unitize (cross uz n))) (y (cross n x)))
          (define (row v) (list (cx v) (cy v) (cz v) (- (dot v (p->q origin p)))))
          (do-transform o (apply make-matrix (append (row x) (row y) (row n) '(0 0 0 1))))))))

; Returns the unit normal of the flat loop through points.
(define (%loop-normal points)
  (let* ((p (first points)) (sides (map (lambda (q) (p->q p q)) (cdr points))))
    (unitize (fold v+v (vxyz 0 0 0) (map cross sides (append (cdr sides) (list (car sides))))))))

(define (unroll surface)
  (if (not (and (object? surface) (or (surface? surface) (solid? surface) (region? surface)))) (error 'unroll "surface must be a surface, got ~s" surface))
  (cond
    ((region? surface) (%region-flat surface))
    ((%unroll-exact surface))
    ((solid? surface) (error 'unroll "surface must be a surface, a cylinder or a cone; unfold lays other solids flat"))
    (else
      (let ((found (%unroll surface)))
        (cond
          ((first found) (if (memq (object-kind surface) '(surface mesh ruled-loft)) (%unrolled found) (first found)))
          ((%ruled-strip surface) => (lambda (strip) (%unrolled (%unroll strip))))
          (else
            (error 'unroll "surface is doubly curved and cannot be laid flat: its curvature is ~a degrees in all, and its parts would miss each other by up to ~a"
              (/ (round (* 10 (radians->degrees (third found)))) 10) (/ (round (* 1000 (fourth found))) 1000.))))))))

; ---- nets of solids ----

(define (%fold-lines name points)
  (let loop ((l points) (lines '()))
    (if (null? l)
        (if (null? lines) '() (list (layer name (reverse lines))))
        (loop (cddr l) (cons (make-line (first l) (second l)) lines)))))

; Returns the numbers of a part's cut edges, inside its border.
(define (%edge-numbers l width)
  (let loop ((l l) (made '()))
    (if (null? l)
        (if (null? made) '() (list (layer "numbers" made)))
        (let* ((p (second l)) (q (third l)) (long (distance p q)) (text (number->string (first l)))
               (size (min width (* 0.4 (/ (* 8 long) (max 8 (%stroke-width text)))))) (d (unitize (p->q p q)))
               (at (p+v (mid p q) (v*r (vxyz (- (cy d)) (cx d) 0) (* 0.4 size)))))
          (loop (cdddr l) (cons (engrave text size #:at at #:angle (pol-phi d) #:align 'centre) made))))))

(define %unfold-list unfold) ; SRFI 1's, which takes four arguments or more

(define (unfold solid #:tabs [tabs any? 0] #:numbers [numbers any? #t] . rest)
  (if (pair? rest) (apply %unfold-list solid rest) (%unfold-solid solid tabs numbers)))

(define (%unfold-solid solid tabs numbers)
  (if (not (and (object? solid) (solid? solid))) (error 'unfold "solid must be a solid, got ~s" solid))
  (if (not (and (real? tabs) (finite? tabs) (>= tabs 0))) (error 'unfold "tabs must be a number of 0 or more, got ~s" tabs))
  (let* ((found (%unfold (%drawn solid) tabs)) (box (bounding-box solid))
         (size (if (> tabs 0) (* 0.5 tabs) (* 0.02 (distance (first box) (second box))))))
    (if (> (second found) 0)
        (%warn (format "unfold: ~a cut edges have no room for a glue tab; give narrower #:tabs" (second found))))
    (reverse
      (map (lambda (part)
             (unite (cons (layer "cut" (first part))
                          (append (%fold-lines "mountain" (second part)) (%fold-lines "valley" (third part))
                                  (if numbers (%edge-numbers (fourth part) size) '())))))
           (cddr found)))))
