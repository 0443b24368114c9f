; Frames: nodes, and straight members between them. A frame is checked when it is made; frame-solve makes vectors of numbers
; of it, which the core computes.

; nodes, members: their numbers; parts: procedure that returns all that follows, so that a printed frame is short
(define-record-type framework (make-framework nodes members parts) frame? (nodes node-count) (members member-count) (parts frame-parts))
; nodes: list of points; bars: list of bars; held: vector of 6 numbers a node, 1 where a support holds it; cases: list of a
; name and loads
(define (make-frame nodes bars plates held cases)
  (let ((all (list nodes bars (list->vector bars) held cases (list->vector (cons #f nodes)) plates))) (make-framework (length nodes) (length bars) (lambda () all))))
(define (nodes-of f) (first ((frame-parts f))))
(define (bars-in f) (second ((frame-parts f))))
(define (bars-at f) (third ((frame-parts f))))
(define (held-of f) (fourth ((frame-parts f))))
(define (cases-of f) (fifth ((frame-parts f))))
(define (nodes-at f) (sixth ((frame-parts f)))) ; a vector, whose indices are the numbers of nodes
(define (plates-in f) (seventh ((frame-parts f)))) ; lists of three numbers of nodes, thickness and material
; from, to: numbers of nodes from 1; joints: list of two hinges, the roll, and the gvectors from the nodes to the two ends;
; length: that between the ends
(define-record-type bar (make-bar from to joints section material length) bar?
  (from bar-from) (to bar-to) (joints bar-joints) (section bar-section) (material bar-material) (length bar-length))
(define (bar-hinged-from b) (first (bar-joints b)))
(define (bar-hinged-to b) (second (bar-joints b)))
(define (bar-roll b) (third (bar-joints b)))
(define (bar-offset-from b) (fourth (bar-joints b)))
(define (bar-offset-to b) (fifth (bar-joints b)))
; Returns the list of the two ends of a bar. at: the vector of nodes.
(define (bar-ends b at) (list (p+v (vector-ref at (bar-from b)) (bar-offset-from b)) (p+v (vector-ref at (bar-to b)) (bar-offset-to b))))

(define ways '(x y z rx ry rz))
(define gravity 9.81) ; m/s2

(define (need-node who what n count)
  (if (not (and (exact-integer? n) (<= 1 n count))) (error who "~a: a node must be a number from 1 to ~a, got ~s" what count n)))

; ---- members ----

(define no-offset (vxyz 0 0 0))
(define (need-offset number v)
  (if (not (and (gvector? v) (every finite? (list (cx v) (cy v) (cz v))))) (error 'frame "member ~a: an offset must be a gvector from the node to the end, got ~s" number v)))

; Returns the joints of a bar from the options that follow the nodes of a member. pinned: whether its ends are hinged anyway.
(define (member-options number options pinned)
  (let loop ((l options) (from pinned) (to pinned) (roll 0) (start no-offset) (end no-offset))
    (define (hinge from to) (loop (cdr l) from to roll start end))
    (define (offset start end) (need-offset number (cadr l)) (loop (cddr l) from to roll start end))
    (let ((option (and (pair? l) (car l))) (next (and (pair? l) (pair? (cdr l)) (cadr l))))
      (cond
        ((null? l) (list from to roll start end))
        ((eq? option 'hinged) (hinge #t #t))
        ((eq? option 'hinged-start) (hinge #t to))
        ((eq? option 'hinged-end) (hinge from #t))
        ((and next (eq? option 'roll)) (need-number 'frame 'roll next) (loop (cddr l) from to next start end))
        ((and next (eq? option 'offset)) (offset next next))
        ((and next (eq? option 'offset-start)) (offset next end))
        ((and next (eq? option 'offset-end)) (offset start next))
        (else (error 'frame "member ~a has the option ~s; options are 'hinged, 'hinged-start, 'hinged-end, 'roll before an angle, and 'offset, 'offset-start, 'offset-end before a gvector" number option))))))

; Returns one value for each member: each of a list, or always the same.
(define (one-each what value n convert)
  (if (list? value)
      (begin
        (if (not (= (length value) n)) (error 'frame "~a must be one, or a list of ~a, one for each member, got ~a" what n (length value)))
        (map convert value))
      (make-list n (convert value))))

(define (section-for s)
  (cond ((section? s) s) ((positive-number? s) (any-section s))
    (else (error 'frame "sections must be sections, such as (tube-section 0.1 0.005), or areas in m2, got ~s" s))))

(define (bars-of nodes members sections materials joints)
  (let* ((n (length members)) (at (list->vector (cons #f nodes))) (count (length nodes)) (pinned (eq? joints 'pinned)))
    (map (lambda (m number section material)
           (if (not (and (list? m) (>= (length m) 2))) (error 'frame "member ~a must be a list of two nodes, got ~s" number m))
           (need-node 'frame (format "member ~a" number) (car m) count)
           (need-node 'frame (format "member ~a" number) (cadr m) count)
           (let* ((bar (make-bar (car m) (cadr m) (member-options number (cddr m) pinned) section material #f)) (ends (bar-ends bar at)) (long (apply distance ends)))
             (if (<= long 0) (error 'frame "member ~a has no length: its ends, of nodes ~a and ~a, are both at ~s" number (car m) (cadr m) (first ends)))
             (make-bar (car m) (cadr m) (bar-joints bar) section material long)))
         members (iota n 1) (one-each 'sections sections n section-for) (one-each 'materials materials n (lambda (m) (material-of 'frame m))))))

; ---- supports ----

; Returns the vector of held ways. A support is a node, or a list of nodes and what holds there.
(define (held-ways supports count plane)
  (let ((held (make-vector (* 6 count) 0)))
    (define (hold! n i) (vector-set! held (+ (* 6 (- n 1)) i) 1))
    (define (ways-named s)
      (append-map (lambda (w)
                    (cond ((eq? w 'fixed) (iota 6)) ((eq? w 'pinned) (iota 3)) ((list-index (lambda (v) (eq? v w)) ways) => list)
                      (else (error 'frame "supports: ~s holds nothing; write 'fixed, 'pinned, or some of ~a, in ~s" w ways s))))
        (cdr s)))
    (if (not (list? supports)) (error 'frame "supports must be a list of nodes, or of lists such as (list 1 'pinned), got ~s" supports))
    (for-each
      (lambda (s)
        (if (not (or (not (pair? s)) (and (list? s) (or (not (pair? (car s))) (list? (car s))))))
            (error 'frame "supports must be a list of nodes, or of lists such as (list 1 'pinned), got ~s" s))
        (let* ((nodes (if (pair? s) (if (pair? (car s)) (car s) (list (car s))) (list s)))
               (which (if (and (pair? s) (pair? (cdr s))) (ways-named s) (iota 6))))
          (for-each (lambda (n) (need-node 'frame 'supports n count) (for-each (lambda (i) (hold! n i)) which)) nodes)))
      supports)
    (if (null? supports) (error 'frame "no support holds the frame: give #:supports, such as '((1 fixed) (5 pinned))"))
    (if plane
        (let ((out (case plane ((xz) '(1 3 5)) ((xy) '(2 3 4)) ((yz) '(0 4 5)) (else (error 'frame "plane must be 'xy, 'xz or 'yz, got ~s" plane)))))
          (for-each (lambda (n) (for-each (lambda (i) (hold! n i)) out)) (iota count 1))))
    held))

; ---- loads ----

(define (case? l) (and (pair? l) (string? (car l))))

(define (check-load l count members)
  (define (vector-at? i) (and (> (length l) i) (gvector? (list-ref l i))))
  (define (bad) (error 'frame "loads: ~s is no load; loads are (list node force), (list node force moment), (list 'member number force-per-metre), (list 'members force-per-metre), (list 'faces faces force-per-m2), (list 'plan faces force-per-m2) and 'weight" l))
  (cond
    ((eq? l 'weight))
    ((not (and (list? l) (pair? l))) (bad))
    ((eq? (car l) 'weight) (if (not (and (= (length l) 2) (vector-at? 1))) (bad)))
    ((memq (car l) '(faces plan))
     (if (not (and (= (length l) 3) (pair? (cadr l)) (list? (cadr l)) (every (lambda (f) (and (list? f) (>= (length f) 3))) (cadr l))
                   (or (vector-at? 2) (and (eq? (car l) 'faces) (real? (third l)) (finite? (third l))))))
         (bad))
     (for-each (lambda (f) (for-each (lambda (n) (need-node 'frame "loads: a face" n count)) f)) (cadr l)))
    ((eq? (car l) 'members) (if (not (and (= (length l) 2) (vector-at? 1))) (bad)))
    ((eq? (car l) 'member)
     (if (not (and (= (length l) 3) (vector-at? 2))) (bad))
     (if (not (and (exact-integer? (cadr l)) (<= 1 (cadr l) members))) (error 'frame "loads: a member must be a number from 1 to ~a, got ~s" members (cadr l))))
    (else
     (if (not (and (<= 2 (length l) 3) (vector-at? 1) (or (= (length l) 2) (vector-at? 2)) (or (not (pair? (car l))) (list? (car l))))) (bad))
     (for-each (lambda (n) (need-node 'frame 'loads n count)) (if (pair? (car l)) (car l) (list (car l)))))))

; Returns the list of cases, each a list of its name and loads.
(define (cases-in loads count members)
  (if (not (list? loads)) (error 'frame "loads must be a list of loads, or of cases that begin with a name, got ~s" loads))
  (let ((cases (if (and (pair? loads) (every case? loads)) loads (list (cons "loads" loads)))))
    (for-each (lambda (c) (if (not (list? c)) (error 'frame "loads: a case must be a list of a name and loads, got ~s" c))) cases)
    (for-each (lambda (c) (for-each (lambda (l)
                                      (if (case? l) (error 'frame "loads: the case ~s is beside loads without a case; give each a case" (car l)))
                                      (check-load l count members))
                            (cdr c)))
      cases)
    (let ((names (map car cases)))
      (if (not (= (length names) (length (delete-duplicates names)))) (error 'frame "loads: two cases have one name in ~s" names)))
    cases))

; ---- frames ----

(define (frame nodes members #:supports [supports any? '()] #:loads [loads any? '()] #:sections [sections any? #f] #:materials [materials any? 's235]
               #:joints [joints any? 'rigid] #:plane [plane any? #f]
               #:shells [shells any? '()] #:thickness [thickness any? #f] #:shell-materials [shell-materials any? 'c25/30])
  (if (not (and (pair? nodes) (list? nodes) (every point? nodes))) (error 'frame "nodes must be a list of points, got ~s" nodes))
  (if (not (and (list? members) (or (pair? members) (pair? shells)))) (error 'frame "members must be a list of lists of two nodes, got ~s" members))
  (if (not (memq joints '(rigid pinned))) (error 'frame "joints must be 'rigid or 'pinned, got ~s" joints))
  (if (and (pair? members) (not sections)) (error 'frame "sections must be given: one such as (tube-section 0.1 0.005), or a list with one for each member"))
  (let* ((count (length nodes)) (bars (if (null? members) '() (bars-of nodes members sections materials joints))) (longest (apply max 0 (map bar-length bars)))
         (plates (plates-of nodes shells thickness shell-materials)))
    (for-each (lambda (m) (check-material-units 'frame m)) (delete-duplicates (append (map fifth plates) (map bar-material bars)) eq?))
    (for-each (lambda (s) (check-section-units 'frame s)) (delete-duplicates (map bar-section bars) eq?))
    (if (> longest 2000) (warn (format "frame: a member is ~a m long: metres are expected, 1 mm is 0.001 m" longest)))
    (make-frame nodes bars plates (held-ways supports count plane) (cases-in loads count (length bars)))))

; ---- shells ----

; Returns the triangles of a face: a face of four corners is cut along its shorter diagonal.
(define (triangles-of face at)
  (if (null? (cdddr face)) (list face)
      (let* ((p (lambda (k) (vector-ref at (list-ref face k)))) (n (lambda (k) (list-ref face k))))
        (if (<= (distance (p 0) (p 2)) (* (+ 1 1e-9) (distance (p 1) (p 3)))) (list (list (n 0) (n 1) (n 2)) (list (n 0) (n 2) (n 3))) (list (list (n 0) (n 1) (n 3)) (list (n 1) (n 2) (n 3)))))))

(define (plates-of nodes faces thickness materials)
  (if (not (list? faces)) (error 'frame "shells must be a list of faces, got ~s" faces))
  (if (null? faces) '()
      (let ((at (list->vector (cons #f nodes))) (count (length nodes)) (n (length faces)))
        (if (not thickness) (error 'frame "thickness must be given for shells: a number in m, or a list with one for each face"))
        (append-map
          (lambda (f number t m)
            (if (not (and (list? f) (<= 3 (length f) 4))) (error 'frame "shell ~a must be a list of three or four nodes, got ~s" number f))
            (for-each (lambda (k) (need-node 'frame (format "shell ~a" number) k count)) f)
            (let ((poisson (- (/ (modulus-of m) 2 (shear-of m)) 1)))
              (if (not (<= -0.99 poisson 0.499)) (error 'frame "shell ~a is of ~a, whose shear modulus is not that of a material equal in all directions" number (material-kind m)))
              (map (lambda (t3)
                     (let ((p (map (lambda (k) (vector-ref at k)) t3)))
                       (if (<= (vlength (cross (p->q (first p) (second p)) (p->q (first p) (third p)))) (* 1e-12 (square (distance (first p) (second p)))))
                           (error 'frame "shell ~a has no area: its nodes are ~s" number f))
                       (append t3 (list t m))))
                (triangles-of f at))))
          faces (iota n 1)
          (one-each 'thickness thickness n (lambda (t) (need-positive 'frame 'thickness t) (if (> t 5) (warn (format "frame: a shell is ~a m thick: metres are expected, 1 mm is 0.001 m" t))) t))
          (one-each 'shell-materials materials n (lambda (m) (material-of 'frame m)))))))

(define (plate-numbers plates)
  (list->vector (append-map (lambda (p) (let ((m (fifth p))) (list (- (first p) 1) (- (second p) 1) (- (third p) 1) (fourth p) (modulus-of m) (- (/ (modulus-of m) 2 (shear-of m)) 1)))) plates)))

; Writes the numbers of the members into a vector, as the core needs them.
(define (member-numbers bars)
  (let ((v (make-vector (* 17 (length bars)) 0)))
    (for-each
      (lambda (b k)
        (let ((s (bar-section b)) (m (bar-material b)) (at (* 17 k)))
          (define (put! i x) (vector-set! v (+ at i) x))
          (put! 0 (- (bar-from b) 1)) (put! 1 (- (bar-to b) 1))
          (put! 2 (section-area s)) (put! 3 (section-iy s)) (put! 4 (section-iz s)) (put! 5 (section-it s))
          (put! 6 (modulus-of m)) (put! 7 (shear-of m)) (put! 8 (bar-roll b))
          (if (bar-hinged-from b) (put! 9 1))
          (if (bar-hinged-to b) (put! 10 1))
          (add-at! v (+ at 11) (bar-offset-from b) 1)
          (add-at! v (+ at 14) (bar-offset-to b) 1)))
      bars (iota (length bars)))
    v))

(define (add-at! v i g factor)
  (for-each (lambda (d x) (vector-set! v (+ i d) (+ (vector-ref v (+ i d)) (* factor x)))) '(0 1 2) (list (cx g) (cy g) (cz g))))

; Gives each corner of a face its part of a load: a third of each triangle's load, and of the middle's part an equal share.
; Force and moment are those of the load. load: a force for each m2 of the face or, if it is a `plan`, for each m2 of the face
; as the force sees it; or a pressure on the side from which the corners run counter-clockwise.
(define (add-face! face load plan at take!)
  (let* ((points (map (lambda (n) (vector-ref at n)) face)) (n (length face))
         (middle (p+v origin (v/r (fold (lambda (p sum) (v+v sum (p->q origin p))) (vxyz 0 0 0) points) n)))
         (parts (map (lambda (p q)
                       (let* ((a (v*r (cross (p->q middle p) (p->q middle q)) 1/2)))
                         (cond
                           ((real? load) (v*r a (- load)))
                           (plan (v*r load (let ((size (vlength load))) (if (> size 0) (abs (dot a (v/r load size))) 0))))
                           (else (v*r load (vlength a))))))
                  points (append (cdr points) (list (car points)))))
         (whole (v/r (fold v+v (vxyz 0 0 0) parts) (* 3 n))))
    (for-each (lambda (number here before) (take! number (v+v whole (v/r (v+v here before) 3)))) face parts (cons (last parts) (drop-right parts 1)))))

; Adds the loads of a case to those of nodes and of members, of which the case's begin at the numbers n0 and m0.
(define (add-case! case bars plates at nodes lines n0 m0)
  (define (every-member g factor)
    (for-each (lambda (b k) (add-at! lines (+ m0 (* 3 k)) g (factor b))) bars (iota (length bars))))
  (define (plates-weight g)
    (for-each
      (lambda (p)
        (let* ((corners (map (lambda (n) (vector-ref at n)) (list (first p) (second p) (third p))))
               (area (/ (vlength (cross (p->q (first corners) (second corners)) (p->q (first corners) (third corners)))) 2)))
          (for-each (lambda (n) (add-at! nodes (+ n0 (* 6 (- n 1))) g (/ (* area (fourth p) (density-of (fifth p))) 3))) (list (first p) (second p) (third p)))))
      plates))
  (define (weight b) (* (section-area (bar-section b)) (density-of (bar-material b))))
  (for-each
    (lambda (l)
      (cond
        ((eq? l 'weight) (every-member (vxyz 0 0 (- gravity)) weight) (plates-weight (vxyz 0 0 (- gravity))))
        ((eq? (car l) 'weight) (every-member (cadr l) weight) (plates-weight (cadr l)))
        ((memq (car l) '(faces plan))
         (for-each (lambda (f) (add-face! f (third l) (eq? (car l) 'plan) at (lambda (n g) (add-at! nodes (+ n0 (* 6 (- n 1))) g 1)))) (cadr l)))
        ((eq? (car l) 'members) (every-member (cadr l) (lambda (b) 1)))
        ((eq? (car l) 'member) (add-at! lines (+ m0 (* 3 (- (cadr l) 1))) (third l) 1))
        (else
         (for-each (lambda (n)
                     (add-at! nodes (+ n0 (* 6 (- n 1))) (second l) 1)
                     (if (pair? (cddr l)) (add-at! nodes (+ n0 (* 6 (- n 1)) 3) (third l) 1)))
           (if (pair? (car l)) (car l) (list (car l)))))))
    (cdr case)))

(define (need-frame who f) (if (not (frame? f)) (error who "f must be a frame, got ~s" f)))

(define (frame-solve f)
  (need-frame 'frame-solve f)
  (let* ((bars (bars-in f)) (cases (cases-of f)) (n (length (nodes-of f))) (m (length bars)) (c (length cases))
         (nodes (make-vector (* 6 n c) 0)) (lines (make-vector (* 3 m c) 0)))
    (for-each (lambda (case k) (add-case! case bars (plates-in f) (nodes-at f) nodes lines (* 6 n k) (* 3 m k))) cases (iota c))
    (let ((found (core:frame-solve (nodes-of f) (member-numbers bars) (held-of f) nodes lines c (plate-numbers (plates-in f)))))
      (if (pair? (fourth found))
          (warn (format "frame-solve: node ~a is free to move where nothing loads it, and was held there~a" (first (fourth found))
                  (if (pair? (cdr (fourth found))) (format "; ~a more nodes, too; #:plane holds a flat frame" (- (length (fourth found)) 1)) ""))))
      (make-result f (map car cases) (first found) (second found) (third found) (fifth found)))))
