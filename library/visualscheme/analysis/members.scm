; Members from drawn objects: cylinders, boxes, pipes, extruded profiles and curves become nodes, members and sections.

; ---- places under transformations ----

; A frame of places: the image of the origin, and those of the three axes.
(define no-turn (list origin (vxyz 1 0 0) (vxyz 0 1 0) (vxyz 0 0 1)))
(define (turned-by m)
  (let* ((l (car (object-arguments (lowered (do-transform (make-line origin (xyz 1 0 0) (xyz 0 1 0) (xyz 0 0 1)) m))))) (o (car l)))
    (cons o (map (lambda (p) (p->q o p)) (cdr l)))))
(define (turned-vector t v) (v+v (v*r (second t) (cx v)) (v*r (third t) (cy v)) (v*r (fourth t) (cz v))))
(define (turned-point t p) (p+v (first t) (turned-vector t (p->q origin p))))
(define (turned-turn t u) (cons (turned-point t (first u)) (map (lambda (v) (turned-vector t v)) (cdr u))))
; Returns the factor by which the frame scales, if it scales all directions alike.
(define (turn-factor t kind)
  (let ((sizes (map vlength (cdr t))))
    (if (not (every (lambda (x) (near? x (car sizes) (* 1e-9 (car sizes)))) sizes))
        (error 'members-of "a ~a is stretched in one direction: its section is no ~a" kind kind))
    (car sizes)))

; ---- pieces: lists of two ends, a section and a roll; balls: lists of a centre and a radius ----

; Returns the roll that brings a member's own z axis to lie along v.
(define (roll-to p q v)
  (let* ((axes (member-axes p q 0)) (d (unitize v))) (atan (- 0 (dot d (second axes))) (dot d (third axes)))))

(define (box-piece t p q)
  (let* ((d (p->q p q)) (sides (map (lambda (v k) (turned-vector t (v*r v k))) (list (vxyz 1 0 0) (vxyz 0 1 0) (vxyz 0 0 1)) (list (cx d) (cy d) (cz d))))
         (middle (turned-point t (mid p q))) (sorted (sort sides (lambda (a b) (> (vlength a) (vlength b))))) (along (first sorted)))
    (for-each (lambda (a b) (if (> (abs (dot a b)) (* 1e-9 (vlength a) (vlength b))) (error 'members-of "a box is sheared: it is no member")))
      sides (append (cdr sides) (list (car sides))))
    (let* ((from (p+v middle (v*r along -1/2))) (to (p+v middle (v*r along 1/2))) (axes (member-axes from to 0)) (rise (lambda (v) (dot v (third axes))))
           (steep (lambda (v) (abs (rise (unitize v))))) (b (second sorted)) (c (third sorted)) (tall (if (> (steep b) (steep c)) b c)) (wide (if (eq? tall b) c b)))
      (list from to (rectangle-section (vlength wide) (vlength tall)) (roll-to from to (if (< (rise tall) 0) (v*r tall -1) tall))))))

(define (curve-pieces t curve section n)
  (let* ((straight (eq? (object-kind curve) 'line)) (points (map (lambda (p) (turned-point t p)) (if straight (car (object-arguments curve)) (curve-division curve n))))
         (all (if (and straight (second (object-arguments curve))) (append points (list (car points))) points)))
    (filter-map (lambda (p q) (and (> (distance p q) 0) (list p q section 0))) all (cdr all))))

; Returns the section of a profile, its centre, and the direction of its height: of a circle, ring, rectangle, or region of one of these.
(define (profile-section o)
  (let ((kind (object-kind o)) (parts (object-arguments o)))
    (cond
      ((eq? kind 'circle) (list (round-section (* 2 (second parts))) (first parts) #f))
      ((and (eq? kind 'region) (= (length (object-children o)) 1)) (profile-section (car (object-children o))))
      ((and (eq? kind 'region) (every (lambda (c) (eq? (object-kind c) 'circle)) (object-children o)) (= (length (object-children o)) 2))
       (let* ((circles (map object-arguments (object-children o))) (big (apply max (map second circles))) (small (apply min (map second circles))))
         (and (near? (first (first circles)) (first (second circles)) (* 1e-9 big)) (list (tube-section (* 2 big) (- big small)) (first (first circles)) #f))))
      ((and (memq kind '(line polygon)) (= (length (remove-last-copy (car parts))) 4))
       (let* ((c (remove-last-copy (car parts))) (a (p->q (first c) (second c))) (b (p->q (second c) (third c))))
         (and (near? (p->q (first c) (fourth c)) b 1e-9) (< (abs (dot a b)) (* 1e-9 (vlength a) (vlength b)))
              (let ((tall (if (> (vlength a) (vlength b)) a b)))
                (list (rectangle-section (min (vlength a) (vlength b)) (vlength tall)) (mid (first c) (third c)) tall)))))
      (else #f))))
(define (remove-last-copy points) (if (near? (first points) (last points) 1e-12) (drop-right points 1) points))

(define (scaled-section s k)
  (let ((by (lambda (x n) (and x (* x (expt k n))))))
    (if (= k 1) s
        (make-section (section-kind s) (by (section-area s) 2) (by (section-iy s) 4) (by (section-iz s) 4) (by (section-it s) 4) (by (section-wy s) 3)
          (by (section-wz s) 3) (by (section-width s) 1) (by (section-height s) 1) (by (section-wall s) 1)))))

; Returns the tube that remains when coaxial cylinders are subtracted from a cylinder, as a piece; #f if they are not coaxial.
(define (tube-piece t o)
  (let ((parts (object-children o)))
    (and (every (lambda (c) (eq? (object-kind c) 'cylinder)) parts) (= (length parts) 2)
         (let* ((a (object-arguments (first parts))) (b (object-arguments (second parts))) (d (unitize (p->q (first a) (second a))))
                (off (lambda (p) (vlength (cross d (p->q (first a) p))))) (along (lambda (p) (dot d (p->q (first a) p)))) (long (distance (first a) (second a))))
           (and (< (off (first b)) (* 1e-9 long)) (< (off (second b)) (* 1e-9 long)) (< (third b) (third a))
                (<= (min (along (first b)) (along (second b))) (* 1e-9 long)) (>= (max (along (first b)) (along (second b))) (* (- 1 1e-9) long))
                (list (turned-point t (first a)) (turned-point t (second a))
                  (scaled-section (tube-section (* 2 (third a)) (- (third a) (third b))) (turn-factor t 'tube)) 0))))))

(define (extruded-piece t o)
  (let* ((how (object-arguments o)) (profile (profile-section (car (object-children o)))))
    (and profile (gvector? (first how)) (every (lambda (x) (and (real? x) (= x 0))) (list (second how) (third how)))
         (let* ((k (turn-factor t 'profile)) (p (turned-point t (second profile))) (q (p+v p (turned-vector t (first how)))))
           (list p q (scaled-section (first profile) k) (if (third profile) (roll-to p q (turned-vector t (third profile))) 0))))))

; Calls take! with each piece of an object and ball! with each sphere.
(define (each-piece o section n take! ball!)
  (let walk ((o o) (t no-turn))
    (if (list? o) (for-each (lambda (p) (walk p t)) o)
        (let ((kind (object-kind o)) (args (object-arguments o)) (parts (object-children o)))
          (define (curve c s)
            (if (not s) (error 'members-of "a curve has no section: give #:section"))
            (for-each take! (curve-pieces t c s n)))
          (case kind
            ((unite layer with-material highlight) (for-each (lambda (p) (walk p t)) parts))
            ((transform) (walk (car parts) (turned-turn t (turned-by (car args)))))
            ((sphere) (ball! (list (turned-point t (first args)) (* (second args) (turn-factor t 'sphere)))))
            ((cylinder) (take! (list (turned-point t (first args)) (turned-point t (second args)) (or section (round-section (* 2 (third args) (turn-factor t 'cylinder)))) 0)))
            ((box) (take! (let ((b (box-piece t (first args) (second args)))) (if section (list (first b) (second b) section (fourth b)) b))))
            ((thicken) (curve (car parts) (or section (round-section (* (first args) (turn-factor t 'pipe))))))
            (else
             (let ((piece (case kind ((subtract) (tube-piece t o)) ((extrude) (extruded-piece t o)) (else #f))))
               (cond
                 (piece (take! (if section (list (first piece) (second piece) section (fourth piece)) piece)))
                 ((curve? o) (curve o section))
                 ((empty-object? o))
                 (else (error 'members-of "a ~a is no member: members are cylinders, boxes, tubes, pipes, straight extrusions of circles, rings and rectangles, and curves" kind))))))))))

; ---- welding ----

; Returns a procedure that numbers points: one number for all points within the tolerance of the first of them.
(define (welder tolerance)
  (let ((cells (make-hash)) (count 0) (points '()) (size (* 4 tolerance)))
    (define (key x) (exact (floor (/ x size))))
    (define (keys x) (delete-duplicates (list (key (- x tolerance)) (key (+ x tolerance)))))
    (define (near-in p k) (find (lambda (e) (<= (distance (car e) p) tolerance)) (hash-ref cells k '())))
    (lambda (p)
      (if (not p) (reverse points)
          (let* ((places (append-map (lambda (i) (append-map (lambda (j) (map (lambda (k) (list i j k)) (keys (cz p)))) (keys (cy p)))) (keys (cx p))))
                 (found (let loop ((l places)) (if (null? l) #f (or (near-in p (car l)) (loop (cdr l)))))))
            (if found (cdr found)
                (let ((here (map key (list (cx p) (cy p) (cz p)))))
                  (set! count (+ count 1))
                  (set! points (cons p points))
                  (hash-set! cells here (cons (cons p count) (hash-ref cells here '())))
                  count)))))))

; A list of points or balls as a vector that is sorted by x, to find those between two values of x.
(define (sorted-by-x items place) (list->vector (sort items (lambda (a b) (< (cx (place a)) (cx (place b)))))))
(define (first-from v x place)
  (let loop ((low 0) (high (vector-length v)))
    (if (= low high) low
        (let ((k (quotient (+ low high) 2))) (if (< (cx (place (vector-ref v k))) x) (loop (+ k 1) high) (loop low k))))))
(define (between v x0 x1 place)
  (let loop ((k (first-from v x0 place)) (l '()))
    (if (or (= k (vector-length v)) (> (cx (place (vector-ref v k))) x1)) (reverse l) (loop (+ k 1) (cons (vector-ref v k) l)))))

; Returns the parts of a member from p to q at nodes that lie on it: lists of two numbers of nodes.
(define (split-at-nodes from to p q points sorted tolerance)
  (let* ((long (distance p q)) (d (unitize (p->q p q))) (box (lambda (f g) (list (- (min (f p) (f q)) tolerance) (+ (max (f p) (f q)) tolerance))))
         (y (box cy cy)) (z (box cz cz))
         (on (filter-map
               (lambda (n)
                 (let ((r (vector-ref points n)))
                   (and (<= (first y) (cy r) (second y)) (<= (first z) (cz r) (second z)) (not (= n from)) (not (= n to))
                        (let ((v (p->q p r))) (and (< tolerance (dot v d) (- long tolerance)) (<= (vlength (cross d v)) tolerance) (cons (dot v d) n))))))
               (between sorted (- (min (cx p) (cx q)) tolerance) (+ (max (cx p) (cx q)) tolerance) (lambda (n) (vector-ref points n)))))
         (all (append (list from) (map cdr (sort on (lambda (a b) (< (car a) (car b))))) (list to))))
    (map list all (cdr all))))

; ---- offsets ----

; An end of a piece in work: its place, and the number of its node.
(define-record-type piece-end (make-piece-end place node) piece-end? (place end-place) (node end-node set-end-node!))
; A piece in work: both ends, section and roll.
(define-record-type joined-piece (make-joined-piece from to section roll) joined-piece? (from joined-from) (to joined-to) (section joined-section) (roll joined-roll))

(define (nearest-on p q r) ; of the line from p to q to the point r
  (let* ((d (p->q p q)) (t (max 0 (min 1 (/ (dot (p->q p r) d) (dot d d)))))) (p+v p (v*r d t))))

; Returns a procedure of a point that returns the pieces whose axes may be nearer than `reach`: they lie in its cell. Cells are
; as large as two members; a piece is in those around its points at every quarter of a cell and less.
(define (pieces-near pieces reach)
  (let* ((cells (make-hash)) (ends (lambda (j) (list (end-place (joined-from j)) (end-place (joined-to j)))))
         (size (max (* 4 reach) (/ (* 2 (apply + (map (lambda (j) (apply distance (ends j))) pieces))) (max 1 (length pieces))))) (wide (+ (/ size 4) reach))
         (key (lambda (x) (exact (floor (/ x size))))) (keys (lambda (x) (iota (+ 1 (- (key (+ x wide)) (key (- x wide)))) (key (- x wide))))))
    (define (cells-of p) (append-map (lambda (i) (append-map (lambda (j) (map (lambda (k) (list i j k)) (keys (cz p)))) (keys (cy p)))) (keys (cx p))))
    (for-each
      (lambda (j)
        (let* ((e (ends j)) (n (exact (ceiling (/ (* 2 (apply distance e)) size)))))
          (for-each (lambda (c) (hash-set! cells c (cons j (hash-ref cells c '()))))
            (delete-duplicates (append-map (lambda (k) (cells-of (intermediate-point (first e) (second e) (/ k (max 1 n))))) (iota (+ 1 n)))))))
      pieces)
    (lambda (p) (hash-ref cells (map key (list (cx p) (cy p) (cz p))) '()))))

; Joins each end that is alone at its node to the nearest other member whose solid its own touches: the end gets the number
; of a node on that member's axis.
(define (join-by-arms! pieces weld tolerance)
  (let* ((uses (make-hash)) (use! (lambda (n) (hash-set! uses n (+ 1 (hash-ref uses n 0))))) (radius (lambda (j) (shown-radius (joined-section j))))
         (around (pieces-near pieces (+ tolerance (* 2 (apply max 0 (map radius pieces)))))))
    ; Returns the place on the nearest member that j touches at r; #f if there is none, or if r is on an axis.
    (define (touched j r)
      (let ((best (fold (lambda (o best)
                          (let* ((at (nearest-on (end-place (joined-from o)) (end-place (joined-to o)) r)) (d (distance at r)))
                            (if (and (not (eq? o j)) (or (not best) (< d (car best))) (<= d (+ (radius j) (radius o) tolerance))) (cons d at) best)))
                    #f (around r))))
        (and best (> (car best) tolerance) (cdr best))))
    (for-each (lambda (j) (use! (end-node (joined-from j))) (use! (end-node (joined-to j)))) pieces)
    (for-each
      (lambda (j)
        (for-each
          (lambda (end other)
            (let ((at (and (= 1 (hash-ref uses (end-node end) 0)) (touched j (end-place end)))))
              (if at (let ((n (weld at))) (if (not (= n (end-node other))) (begin (set-end-node! end n) (use! n)))))))
          (list (joined-from j) (joined-to j)) (list (joined-to j) (joined-from j))))
      pieces)))

; Returns the options of a part of a piece: its roll, and the arms of the piece's ends that are its own.
(define (part-options j part points tolerance)
  (let ((arm (lambda (end n name) (let ((v (p->q (vector-ref points n) (end-place end)))) (if (and (= n (end-node end)) (> (vlength v) tolerance)) (list name v) '())))))
    (append (if (= (joined-roll j) 0) '() (list 'roll (joined-roll j))) (arm (joined-from j) (first part) 'offset-start) (arm (joined-to j) (second part) 'offset-end))))

; Returns a list of the nodes, members and sections of drawn objects.
(define (members-of objects #:section [section any? #f] #:tolerance [tolerance any? 1e-3] #:segments [n any? 16] #:offsets [offsets any? #f])
  (need-positive 'members-of 'tolerance tolerance)
  (if (not (and (exact-integer? n) (<= 1 n 10000))) (error 'members-of "segments must be an exact integer from 1 to 10000, got ~s" n))
  (if (not (boolean? offsets)) (error 'members-of "offsets must be #t or #f, got ~s" offsets))
  (let ((pieces '()) (balls '()) (weld (welder tolerance)) (s (and section (section-for section))))
    (each-piece objects s n (lambda (p) (set! pieces (cons p pieces))) (lambda (b) (set! balls (cons b balls))))
    (let* ((widest (apply max 0 (map second balls))) (around (sorted-by-x balls car))
           (snapped (lambda (p)
                      (let ((b (find (lambda (b) (<= (distance (car b) p) (+ (* 1.000001 (second b)) tolerance))) (between around (- (cx p) (* 1.01 widest) tolerance) (+ (cx p) (* 1.01 widest) tolerance) car))))
                        (if b (car b) p))))
           (end-at (lambda (p) (let ((at (snapped p))) (make-piece-end at (weld at)))))
           (joined (filter (lambda (j) (not (= (end-node (joined-from j)) (end-node (joined-to j)))))
                     (map (lambda (p) (make-joined-piece (end-at (first p)) (end-at (second p)) (third p) (fourth p))) (reverse pieces)))))
      (if offsets (join-by-arms! joined weld tolerance))
      (if (null? joined) (error 'members-of "the objects have no members"))
      (split-pieces joined (list->vector (cons #f (weld #f))) tolerance offsets))))

; Returns nodes, members and sections. With arms, some nodes are left without members, and have no number.
(define (split-pieces joined points tolerance arms)
  (let* ((used (make-hash)) (count 0)
         (use! (lambda (k) (if (not (hash-ref used k #f)) (begin (set! count (+ count 1)) (hash-set! used k count)))))
         (begun (for-each (lambda (j) (use! (end-node (joined-from j))) (use! (end-node (joined-to j)))) joined)) ; in the order of the objects
         (sorted (sorted-by-x (filter (lambda (k) (hash-ref used k #f)) (iota (- (vector-length points) 1) 1)) (lambda (k) (vector-ref points k))))
         (split (append-map (lambda (j)
                              (let* ((from (joined-from j)) (to (joined-to j)) (place (lambda (end) (if arms (end-place end) (vector-ref points (end-node end))))))
                                (map (lambda (part) (list part (if arms (part-options j part points tolerance) (if (= (joined-roll j) 0) '() (list 'roll (joined-roll j)))) (joined-section j)))
                                  (split-at-nodes (end-node from) (end-node to) (place from) (place to) points sorted tolerance))))
                  joined)))
    (list (map (lambda (k) (vector-ref points k)) (sort (hash-keys used) (lambda (a b) (< (hash-ref used a) (hash-ref used b)))))
      (map (lambda (m) (append (map (lambda (k) (hash-ref used k)) (first m)) (second m))) split)
      (map third split))))

; ---- nodes by place ----

(define (need-points who nodes) (if (not (and (list? nodes) (every point? nodes))) (error who "nodes must be a list of points, got ~s" nodes)))

(define (nodes-where nodes chosen)
  (need-points 'nodes-where nodes)
  (if (not (procedure? chosen)) (error 'nodes-where "the second argument must be a procedure of a point, got ~s" chosen))
  (filter-map (lambda (p n) (and (chosen p) n)) nodes (iota (length nodes) 1)))

(define (nearest-node nodes p)
  (need-points 'nearest-node nodes)
  (if (not (point? p)) (error 'nearest-node "p must be a point, got ~s" p))
  (if (null? nodes) (error 'nearest-node "there are no nodes"))
  (car (fold (lambda (q n best) (let ((d (distance p q))) (if (or (not best) (< d (cdr best))) (cons n d) best))) #f nodes (iota (length nodes) 1))))

; Returns the faces of a drawn surface or solid as lists of the numbers of nodes at their corners.
(define (faces-on nodes o #:tolerance [tolerance any? 1e-3])
  (need-points 'faces-on nodes)
  (need-positive 'faces-on 'tolerance tolerance)
  (if (not (object? o)) (error 'faces-on "o must be a surface or solid, got ~s" o))
  (let* ((mesh (lowered o)) (weld (welder tolerance)) (count (length nodes)))
    (if (not (eq? (object-kind mesh) 'polyface-mesh)) (error 'faces-on "o must be a surface or solid, got a ~a" (object-kind mesh)))
    (let* ((known (map weld nodes)) (at (list->vector (cons #f (first (object-arguments mesh)))))
           (original (let ((h (make-hash))) (for-each (lambda (w n) (if (not (hash-ref h w #f)) (hash-set! h w n))) known (iota count 1)) h)))
      (map (lambda (face)
             (map (lambda (k)
                    (let ((p (vector-ref at k)))
                      (or (hash-ref original (weld p) #f) (error 'faces-on "no node is at the corner ~s" p))))
               face))
        (second (object-arguments mesh))))))
