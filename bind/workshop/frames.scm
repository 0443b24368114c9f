; Frames and bonds: bars and nodes of nets, geodesic domes, space frames, courses of bricks. After cutting_sheets.scm.
; Names that begin with % are hidden from programs. Compiled into the binary when it is built.
;
; A net is a list of two lists: points, and members, each the numbers of its two points, from 1.

(define (%need-net who net)
  (if (not (and (list? net) (= (length net) 2) (list? (first net)) (every %finite-point? (first net)) (list? (second net))))
      (error who "net must be (list points members), such as (panel-net panels), got ~s" net))
  (%need-members who (second net) (length (first net))))

; Returns the net of the edges of panels, lists of corners; equal corners are one point, shared edges one member.
(define (panel-net panels)
  (if (not (and (list? panels) (every (lambda (c) (and (list? c) (>= (length c) 2) (every %finite-point? c))) panels)))
      (error 'panel-net "panels must be a list of lists of points, such as (panel-corners f grid), got ~s" panels))
  (let* ((all (append-map values panels)) (size (if (null? all) 1 (apply max 1e-300 (map (lambda (p) (distance (car all) p)) all))))
         (blur (* 1e-7 size)) (cells (make-hash)) (points '()) (count 0) (edges (make-hash)) (members '()))
    (define (cell p) (map (lambda (x) (exact (floor (/ x (* 4 blur))))) (list (cx p) (cy p) (cz p))))
    (define (number p)
      (let* ((c (cell p))
             (near (map (lambda (x i) ; a corner near the side of its cell may have its equal in the next cell
                          (let ((rest (- (/ x (* 4 blur)) i))) (cond ((< rest 0.3) (list i (- i 1))) ((> rest 0.7) (list i (+ i 1))) (else (list i)))))
                        (list (cx p) (cy p) (cz p)) c))
             (found (any (lambda (x) (any (lambda (y) (any (lambda (z)
                                                             (find (lambda (q) (<= (distance (cdr q) p) blur)) (hash-ref cells (list x y z) '())))
                                                           (third near)))
                                          (second near)))
                         (first near))))
        (if found
            (car found)
            (begin
              (set! count (+ count 1))
              (set! points (cons p points))
              (hash-set! cells c (cons (cons count p) (hash-ref cells c '())))
              count))))
    (for-each
      (lambda (panel)
        (let ((numbers (map number panel)))
          (for-each
            (lambda (a b)
              (let ((key (list (min a b) (max a b))))
                (if (not (or (= a b) (hash-ref edges key #f)))
                    (begin (hash-set! edges key #t) (set! members (cons key members))))))
            numbers (append (cdr numbers) (list (car numbers))))))
      panels)
    (list (reverse points) (reverse members))))

; ---- bars and nodes ----

; Returns the bars' ends that meet at each point: a vector of lists of unit vectors away from the point.
(define (%directions points members)
  (let ((table (make-vector (+ 1 (length points)) '())) (at (list->vector (cons #f points))))
    (for-each
      (lambda (m)
        (let ((d (unitize (p->q (vector-ref at (first m)) (vector-ref at (second m))))))
          (vector-set! table (first m) (cons d (vector-ref table (first m))))
          (vector-set! table (second m) (cons (v*r d -1) (vector-ref table (second m))))))
      members)
    table))

; Returns how far a bar of radius r must reach beyond its node, so that mitres with these others are full.
(define (%mitre-reach d others r)
  (fold (lambda (e reach)
          (let ((c (dot d e))) ; c is the cosine of the angle between the bars
            (if (or (> c 0.9999) (< c -0.9999)) reach (max reach (* r (sqrt (/ (+ 1 c) (- 1 c))))))))
        0 others))

; Returns two unit vectors across d, the same for each equal d.
(define (%across d)
  (let ((u (unitize (cross d (if (< (abs (cz d)) 0.9) uz ux)))))
    (list u (cross d u))))

; Returns the directions of the bars whose mitres shape the end of the bar along d. All mitre planes contain the node. A
; plane that halves the angle to e cuts the bar at a height that is linear in the two coordinates across the bar: a slope.
; A mitre cuts something that the others leave if and only if its slope is a corner of the convex hull of all slopes.
(define (%mitring d others)
  (let ((across (%across d)) (apart (remove (lambda (e) (< (distance (p+v origin d) (p+v origin e)) 1e-6)) others)))
    (define (slope e)
      (let ((n (v-v d e))) (map (lambda (a) (/ (dot a n) (- (dot d n)))) across)))
    (map cdr (%hull-corners (map (lambda (e) (cons (slope e) e)) apart)))))

; Returns the entries ((x y) . value) whose points are corners of the convex hull of the points.
(define (%hull-corners entries)
  (define (before? a b) (or (< (caar a) (caar b)) (and (= (caar a) (caar b)) (< (cadar a) (cadar b)))))
  (define (corner? a b c) ; true if the way from a by b to c turns left at b
    (let ((u (map - (car c) (car a))) (v (map - (car b) (car a))))
      (> (- (* (car v) (cadr u)) (* (cadr v) (car u))) (* 1e-9 (apply max 1e-12 (map abs u))))))
  (define (chain sorted)
    (fold (lambda (e made)
            (let loop ((made made))
              (if (and (pair? made) (pair? (cdr made)) (not (corner? (cadr made) (car made) e))) (loop (cdr made)) (cons e made))))
          '() sorted))
  (if (< (length entries) 3)
      entries
      (let ((sorted (list-sort before? entries)))
        (append (cdr (chain sorted)) (cdr (chain (reverse sorted)))))))

; Returns the solids to subtract from the bar along d at the node p: a tetrahedron for each mitre. Its base lies in the
; plane that halves the angle. Both bars of a mitre have the same base, to the last digit, so that their faces meet
; without slivers, which half-spaces of two bars would leave.
(define (%mitres p d others size)
  (map (lambda (e)
         (let* ((n (unitize (v-v d e))) (side (if (> (+ (cx n) (* 1.1 (cy n)) (* 1.2 (cz n))) 0) n (v*r n -1))) (across (%across side)))
           (define (corner angle)
             (p+v p (v+v (v*r (car across) (* size (cos angle))) (v*r (cadr across) (* size (sin angle))))))
           (make-polyface-mesh (append (map corner (enumerate 0 2pi 3)) (list (p-v p (v*r n size)))) '((1 2 3) (1 4 2) (2 4 3) (3 4 1)))))
       (%mitring d others)))

; Returns the size of a node's mitres, the same for all of its bars: a vector of numbers, by the nodes' numbers.
(define (%mitre-sizes around r)
  (define (reach at) (apply max 0 (map (lambda (d) (%mitre-reach d (remove (lambda (e) (equal? e d)) at) r)) at)))
  (vector-map (lambda (at) (* 8 (+ r (reach at)))) around))

; Returns the solids of a net: a ball at each node that has bars, then a bar for each member.
(define (frame-members net r #:nodes [nodes any? 'balls] #:node-radius [node-radius any? #f])
  (%need-net 'frame-members net)
  (%need-positive 'frame-members 'r r)
  (if (not (memq nodes '(balls mitred none))) (error 'frame-members "nodes must be 'balls, 'mitred or 'none, got ~s" nodes))
  (let* ((ball (or node-radius (* 1.6 r))) (points (first net)) (members (second net)) (at (list->vector (cons #f points))))
    (%need-positive 'frame-members 'node-radius ball)
    (if (and (eq? nodes 'balls) (< ball r)) (error 'frame-members "node-radius must be at least the bars' radius ~a, got ~a" r ball))
    (let* ((long (lambda (m) (distance (vector-ref at (first m)) (vector-ref at (second m)))))
           (inset (if (eq? nodes 'balls) (sqrt (- (square ball) (square r))) 0))
           (short (find (lambda (m) (<= (long m) (max 1e-12 (* 2 inset)))) members)))
      (if short (error 'frame-members "the member ~s is ~a long, and its nodes take ~a" short (long short) (* 2 inset)))
      (let* ((around (%directions points members)) (sizes (if (eq? nodes 'mitred) (%mitre-sizes around r) #f)))
        (define (bar m)
          (let* ((p (vector-ref at (first m))) (q (vector-ref at (second m))) (d (unitize (p->q p q))) (back (v*r d -1)))
            (if (eq? nodes 'mitred)
                (let* ((at-p (remove (lambda (e) (equal? e d)) (vector-ref around (first m))))
                       (at-q (remove (lambda (e) (equal? e back)) (vector-ref around (second m))))
                       (whole (make-cylinder (p-v p (v*r d (%mitre-reach d at-p r))) (p+v q (v*r d (%mitre-reach back at-q r))) r)))
                  (apply subtract whole (append (%mitres p d at-p (vector-ref sizes (first m))) (%mitres q back at-q (vector-ref sizes (second m))))))
                (make-cylinder (p+v p (v*r d inset)) (p-v q (v*r d inset)) r))))
        (append
          (if (eq? nodes 'balls)
              (filter-map (lambda (p i) (and (pair? (vector-ref around i)) (make-sphere p ball))) points (iota (length points) 1))
              '())
          (map bar members))))))

; ---- geodesic domes ----

(define %icosahedron-faces
  '((1 2 3) (1 3 4) (1 4 5) (1 5 6) (1 6 2) (2 7 3) (3 7 8) (3 8 4) (4 8 9) (4 9 5) (5 9 10) (5 10 6) (6 10 11) (6 11 2) (2 11 7)
    (12 8 7) (12 9 8) (12 10 9) (12 11 10) (12 7 11)))

; Returns the corners of the icosahedron about the origin, with a corner above.
(define (%icosahedron-corners)
  (let ((z (/ 1 (sqrt 5))) (q (/ 2 (sqrt 5))))
    (append (list (xyz 0 0 1))
            (map (lambda (i) (xyz (* q (cos (* i 2 (/ pi 5)))) (* q (sin (* i 2 (/ pi 5)))) z)) (iota 5))
            (map (lambda (i) (xyz (* q (cos (* (+ i 1/2) 2 (/ pi 5)))) (* q (sin (* (+ i 1/2) 2 (/ pi 5)))) (- z))) (iota 5))
            (list (xyz 0 0 -1)))))

; Returns the triangles of the sphere of radius 1: n to each edge of an icosahedron.
(define (%geodesic-triangles n)
  (let ((corners (list->vector (cons #f (%icosahedron-corners)))))
    (append-map
      (lambda (face)
        (let* ((a (vector-ref corners (first face))) (u (p->q a (vector-ref corners (second face)))) (w (p->q a (vector-ref corners (third face)))))
          (define (at i j) (p+v origin (unitize (p->q origin (p+v a (v+v (v*r u (/ i n)) (v*r w (/ j n))))))))
          (append-map
            (lambda (i)
              (append-map
                (lambda (j)
                  (cons (list (at i j) (at (+ i 1) j) (at i (+ j 1)))
                        (if (< (+ i j 1) n) (list (list (at (+ i 1) j) (at (+ i 1) (+ j 1)) (at i (+ j 1)))) '())))
                (iota (- n i))))
            (iota n))))
      %icosahedron-faces)))

; Returns the point in which the planes meet that touch the sphere at three of its points.
(define (%touching-point t)
  (let* ((v (map (lambda (p) (p->q origin p)) t)) (n (cross (v-v (second v) (first v)) (v-v (third v) (first v)))))
    (p+v origin (v*r n (/ 1 (dot n (first v)))))))

; Returns the flat hexagons and twelve pentagons about the points of the triangles, in turn about each.
(define (%geodesic-cells triangles)
  (let* ((net (panel-net triangles)) (around (make-vector (+ 1 (length (first net))) '())) (numbers (make-hash)))
    (define (key p) (map (lambda (x) (exact (round (* 1e6 x)))) (list (cx p) (cy p) (cz p))))
    (for-each (lambda (p i) (hash-set! numbers (key p) i)) (first net) (iota (length (first net)) 1))
    (for-each
      (lambda (t)
        (let ((q (%touching-point t)))
          (for-each (lambda (p) (let ((i (hash-ref numbers (key p)))) (vector-set! around i (cons q (vector-ref around i))))) t)))
      triangles)
    (map
      (lambda (p i)
        (let* ((up (p->q origin p)) (l (vector-ref around i)) (x (unitize (let ((d (p->q p (car l)))) (v-v d (v*r up (dot up d)))))) (y (cross up x)))
          (sort l < #:key (lambda (q) (let ((d (p->q p q))) (atan (dot d y) (dot d x)))))))
      (first net) (iota (length (first net)) 1))))

; Returns the panels of a geodesic dome: lists of corners, counter-clockwise as seen from outside.
(define (geodesic-panels n r #:center [center any? origin] #:above [above any? -1] #:cells [cells any? 'triangles])
  (%need-count 'geodesic-panels 'n n 100)
  (%need-positive 'geodesic-panels 'r r)
  (%need-point 'geodesic-panels 'center center)
  (if (not (and (real? above) (<= -1 above 1))) (error 'geodesic-panels "above must be a number from -1 to 1, as a part of the radius, got ~s" above))
  (if (not (memq cells '(triangles hexagons))) (error 'geodesic-panels "cells must be 'triangles or 'hexagons, got ~s" cells))
  (let* ((triangles (%geodesic-triangles n)) (panels (if (eq? cells 'triangles) triangles (%geodesic-cells triangles))))
    (map (lambda (panel) (map (lambda (p) (p+v center (v*r (p->q origin p) r))) panel))
         (filter (lambda (panel) (>= (cz (%mean-point panel)) (- above 1e-9))) panels))))

; ---- space frames ----

; Returns the net of two layers of a surface, a procedure of u and v: the corners of nu by nv cells, and a point below
; each cell.
(define (space-frame f nu nv depth)
  (%need-procedure 'space-frame 'f f)
  (%need-count 'space-frame 'nu nu 500)
  (%need-count 'space-frame 'nv nv 500)
  (%need-number 'space-frame 'depth depth)
  (let* ((upper (net-points f nu nv)) (at (list->vector upper)) (wide (+ nv 1)) (first-lower (+ 1 (length upper))))
    (define (up i j) (+ 1 (* i wide) j))
    (define (low i j) (+ first-lower (* i nv) j))
    (define (below i j)
      (let* ((c (map (lambda (n) (vector-ref at (- n 1))) (list (up i j) (up (+ i 1) j) (up (+ i 1) (+ j 1)) (up i (+ j 1))))) (n (%newell c)))
        (if (= (vlength n) 0) (error 'space-frame "the cell ~a, ~a of f has no area" i j))
        (p-v (%mean-point c) (v*r (unitize n) depth))))
    (define (cells g) (append-map (lambda (i) (append-map (lambda (j) (g i j)) (iota nv))) (iota nu)))
    (list
      (append upper (cells (lambda (i j) (list (below i j)))))
      (append
        (append-map (lambda (i) (append-map (lambda (j) (append (if (< i nu) (list (list (up i j) (up (+ i 1) j))) '()) (if (< j nv) (list (list (up i j) (up i (+ j 1)))) '()))) (iota (+ nv 1)))) (iota (+ nu 1)))
        (cells (lambda (i j) (append (if (< (+ i 1) nu) (list (list (low i j) (low (+ i 1) j))) '()) (if (< (+ j 1) nv) (list (list (low i j) (low i (+ j 1)))) '()))))
        (cells (lambda (i j) (map (lambda (n) (list n (low i j))) (list (up i j) (up (+ i 1) j) (up (+ i 1) (+ j 1)) (up i (+ j 1))))))))))

; ---- bricks ----

; Returns a brick on the chord between two lengths of the curve, as a pair: the chord's direction and the solids, one
; for each of the sides (back front), distances from the curve. #f: the chord is upright.
(define (%brick curve from to z height sides)
  (let* ((p (curve-point curve from)) (q (curve-point curve to)) (d (vxyz (- (cx q) (cx p)) (- (cy q) (cy p)) 0)) (n (vlength d)))
    (and (> n 1e-9)
         (let ((c (/ (cx d) n)) (s (/ (cy d) n)) (m (mid p q)))
           (cons (v/r d n)
                 (map (lambda (side)
                        (do-transform (make-box (xyz (/ n -2) (first side) 0) (xyz (/ n 2) (second side) height))
                          (make-matrix c (- s) 0 (cx m) s c 0 (cy m) 0 0 1 (+ (cz m) z) 0 0 0 1)))
                      sides))))))

; Returns true if neighbours, which are `deep`, overlap on the inner side of a bend between them.
(define (%bricks-meet? bricks deep joint)
  (any (lambda (a b) (> (* deep (abs (tan (/ (acos (max -1 (min 1 (dot (car a) (car b))))) 2)))) (* joint (+ 1 1e-9))))
       bricks (cdr bricks)))

; Returns the bricks of one course on a curve, which begin `skip` before its start. A cell of the pattern is a list: the
; length of a brick, and its sides. A closed course is stretched or shortened to whole patterns.
(define (%course curve z height pattern joint skip)
  (let* ((l (curve-length curve)) (closed (%closed-curve? curve)) (whole (apply + (map (lambda (p) (+ joint (first p))) pattern)))
         (k (if closed (/ l (* whole (max 1 (round (/ l whole))))) 1)) (start (* k (- skip))) (end (- (if closed (+ l start) l) 1e-9)))
    (let loop ((at start) (cells pattern) (made '()))
      (if (>= at end)
          (let ((bricks (reverse made)) (deep (* 2 (apply max (map abs (append-map values (append-map cdr pattern)))))))
            (if (and (pair? bricks) (%bricks-meet? bricks deep joint))
                (%warn "brick-wall: the curve bends so much that bricks overlap; a wider #:joint or shorter bricks fit"))
            (append-map cdr bricks))
          (let* ((cell (car cells)) (to (+ at (* k (+ joint (first cell))) (- joint)))
                 (brick (cond
                          (closed (%brick curve (%around at l) (%around to l) z height (cdr cell)))
                          ((> (- (min to l) (max at 0)) (* 0.2 (first cell))) (%brick curve (max at 0) (min to l) z height (cdr cell)))
                          (else #f))))
            (loop (+ to joint) (if (null? (cdr cells)) pattern (cdr cells)) (if brick (cons brick made) made)))))))

(define (%around s l) (cond ((< s 0) (+ s l)) ((> s l) (- s l)) (else s)))

; Returns the bricks of a wall on a curve, or on a list of curves, one for each course.
(define (brick-wall curve #:height [height any? #f] #:brick [size any? '(0.24 0.115 0.071)] #:joint [joint any? 0.012] #:bond [bond any? 'running])
  (if (not (and (list? size) (= (length size) 3) (every (lambda (x) (and (real? x) (finite? x) (> x 0))) size)))
      (error 'brick-wall "brick must be (list length width height), got ~s" size))
  (if (not (and (real? joint) (finite? joint) (>= joint 0))) (error 'brick-wall "joint must be a number of 0 or more, got ~s" joint))
  (if (not (memq bond '(running third stack flemish))) (error 'brick-wall "bond must be 'running, 'third, 'stack or 'flemish, got ~s" bond))
  (if (not (or (and (object? curve) (curve? curve)) (and (pair? curve) (list? curve) (every (lambda (c) (and (object? c) (curve? c))) curve))))
      (error 'brick-wall "curve must be a curve, or a list of curves, one for each course, got ~s" curve))
  (if (and (object? curve) (not height)) (error 'brick-wall "height must be given for a wall on one curve"))
  (if height (%need-positive 'brick-wall 'height height))
  (let* ((long (first size)) (wide (second size)) (high (third size)) (w (/ wide 2)) (deep (/ (+ joint (* 2 wide)) 2))
         (courses (if (object? curve) (exact (max 1 (round (/ height (+ high joint))))) (length curve)))
         (pattern (if (eq? bond 'flemish)
                      (list (list long (list (- deep) (- wide deep)) (list (- deep wide) deep)) (list wide (list (- deep) deep)))
                      (list (list long (list (- w) w)))))
         (lap (case bond ((running) (/ (+ long joint) 2)) ((third) (/ (+ long joint) 3)) ((stack) 0) (else (/ (+ long wide (* 2 joint)) 2)))))
    (if (> courses 10000) (error 'brick-wall "there are more than 10000 courses"))
    (append-map
      (lambda (i)
        (%course (if (object? curve) curve (list-ref curve i)) (if (object? curve) (* i (+ high joint)) 0) high pattern joint (if (odd? i) lap 0)))
      (iota courses))))
