; Nets of points and members: form finding, and the lists of which nets consist. After prefabs.scm. Names that begin
; with % are hidden from programs. Compiled into the binary when it is built.
;
; A member is a list of the numbers of its two points, which count from 1 as in make-polyface-mesh.

(define (%need-point-number who name i n)
  (if (not (and (exact-integer? i) (<= 1 i n))) (error who "~a must be numbers of points from 1 to ~a, got ~s" name n i)))

(define (%need-members who members n)
  (if (not (and (list? members) (every (lambda (m) (and (list? m) (= (length m) 2))) members)))
      (error who "members must be a list of lists of two numbers of points, got ~s" members))
  (for-each (lambda (m)
              (%need-point-number who 'members (first m) n)
              (%need-point-number who 'members (second m) n)
              (if (= (first m) (second m)) (error who "a member must join two points, got ~s" m)))
            members))

; Returns a number for each of n things: given as one for all, as a list, or not at all.
(define (%each-number who name x n least)
  (let ((good? (lambda (v) (and (real? v) (finite? v) (least v)))))
    (cond
      ((good? x) (make-list n x))
      ((and (list? x) (every good? x))
       (if (not (= (length x) n)) (error who "~a must be ~a numbers, one for each member, got ~a" name n (length x)))
       x)
      (else (error who "~a must be a positive number or a list of them, got ~s" name x)))))

(define (%distances points members)
  (let ((at (list->vector points)))
    (map (lambda (m) (distance (vector-ref at (- (first m) 1)) (vector-ref at (- (second m) 1)))) members)))

; The parts of %form-find's result: points, forces, residual, steps.
(define (%formed who points members fixed load weight lengths slack densities stiffness tolerance)
  (%need-points who 'points points 1)
  (let* ((n (length points)) (k (begin (%need-members who members n) (length members))))
    (if (not (list? fixed)) (error who "fixed must be a list of numbers of points, got ~s" fixed))
    (for-each (lambda (i) (%need-point-number who 'fixed i n)) fixed)
    (if (not (gvector? weight)) (error who "weight must be a gvector, got ~s" weight))
    (if (and stiffness (not (and (real? stiffness) (finite? stiffness) (positive? stiffness))))
        (error who "stiffness must be a positive number, got ~s" stiffness))
    (%need-positive who 'tolerance tolerance)
    (if (> (length (filter (lambda (x) x) (list lengths slack densities))) 1)
        (error who "members have #:lengths, #:slack or #:densities, and only one of these"))
    (let* ((loads (cond ((gvector? load) (make-list n load))
                        ((and (list? load) (every gvector? load))
                         (if (not (= (length load) n)) (error who "load must be ~a gvectors, one for each point, got ~a" n (length load)))
                         load)
                        (else (error who "load must be a gvector or a list of them, got ~s" load))))
           (own (cond (lengths (%each-number who 'lengths lengths k positive?))
                      (slack (map (lambda (d s) (if (> d 0) (* d s) (error who "a member joins two points at one place, which #:slack cannot make longer")))
                               (%distances points members) (%each-number who 'slack slack k positive?)))
                      (else (make-list k 0))))
           (pull (if (or lengths slack) (make-list k 0) (%each-number who 'densities (or densities 1) k positive?))))
      (%form-find points (append-map (lambda (m l q) (list (- (first m) 1) (- (second m) 1) l q)) members own pull)
        (map (lambda (i) (- i 1)) fixed) (append-map (lambda (v) (list (cx v) (cy v) (cz v))) loads)
        weight (or stiffness 0) tolerance))))

(define (form-find points members #:fixed [fixed any? '()] #:load [load any? (vxyz 0 0 0)] #:weight [weight any? (vxyz 0 0 0)]
                   #:lengths [lengths any? #f] #:slack [slack any? #f] #:densities [densities any? #f] #:stiffness [stiffness any? #f]
                   #:tolerance [tolerance any? 1e-6])
  (first (%formed 'form-find points members fixed load weight lengths slack densities stiffness tolerance)))

; Returns an association list: the points, the force in each member, the longest member, the share of forces that is not
; balanced, and the number of steps.
(define (form-report points members #:fixed [fixed any? '()] #:load [load any? (vxyz 0 0 0)] #:weight [weight any? (vxyz 0 0 0)]
                     #:lengths [lengths any? #f] #:slack [slack any? #f] #:densities [densities any? #f] #:stiffness [stiffness any? #f]
                     #:tolerance [tolerance any? 1e-6])
  (let ((found (%formed 'form-report points members fixed load weight lengths slack densities stiffness tolerance)))
    (list (cons 'points (first found)) (cons 'forces (second found))
          (cons 'longest (apply max 0 (%distances (first found) members)))
          (cons 'unbalanced (third found)) (cons 'steps (fourth found)))))

; ---- nets over a surface ----

; Returns the points of a grid over the surface f, nu + 1 rows of nv + 1, row after row; net-members and net-faces use
; this order.
(define (net-points f nu nv)
  (%need-procedure 'net-points 'f f)
  (%need-grid 'net-points nu nv)
  (append-map (lambda (u)
                (map (lambda (v)
                       (let ((p (f u v)))
                         (if (%finite-point? p) p (error 'net-points "f must give points of finite coordinates; at (u, v) = (~a, ~a) it gave ~s" u v p))))
                     (division 0 1 nv)))
              (division 0 1 nu)))

(define (%net-number i j nv) (+ (* i (+ nv 1)) j 1))

(define (net-members nu nv)
  (%need-grid 'net-members nu nv)
  (append
    (append-map (lambda (i) (map (lambda (j) (list (%net-number i j nv) (%net-number (+ i 1) j nv))) (iota (+ nv 1)))) (iota nu))
    (append-map (lambda (i) (map (lambda (j) (list (%net-number i j nv) (%net-number i (+ j 1) nv))) (iota nv))) (iota (+ nu 1)))))

(define (net-faces nu nv)
  (%need-grid 'net-faces nu nv)
  (append-map (lambda (i)
                (map (lambda (j) (list (%net-number i j nv) (%net-number (+ i 1) j nv) (%net-number (+ i 1) (+ j 1) nv) (%net-number i (+ j 1) nv)))
                     (iota nv)))
              (iota nu)))

; Returns the numbers of the points on the border.
(define (net-border nu nv)
  (%need-grid 'net-border nu nv)
  (append-map (lambda (i) (if (or (= i 0) (= i nu)) (map (lambda (j) (%net-number i j nv)) (iota (+ nv 1))) (list (%net-number i 0 nv) (%net-number i nv nv))))
              (iota (+ nu 1))))

; ---- plane faces ----

(define (planarise points faces #:fixed [fixed any? '()] #:tolerance [tolerance any? #f])
  (%need-points 'planarise 'points points 3)
  (let ((n (length points)))
    (if (not (and (list? faces) (every (lambda (f) (and (list? f) (>= (length f) 3))) faces)))
        (error 'planarise "faces must be a list of lists of three numbers of points or more, got ~s" faces))
    (for-each (lambda (f) (for-each (lambda (i) (%need-point-number 'planarise 'faces i n)) f)) faces)
    (if (not (list? fixed)) (error 'planarise "fixed must be a list of numbers of points, got ~s" fixed))
    (for-each (lambda (i) (%need-point-number 'planarise 'fixed i n)) fixed)
    (if tolerance (%need-positive 'planarise 'tolerance tolerance))
    (let ((size (apply max 1e-300 (map (lambda (p) (distance p (car points))) points))))
      (first (%planarise points (append-map (lambda (f) (cons (length f) (map (lambda (i) (- i 1)) f))) faces)
               (map (lambda (i) (- i 1)) fixed) (or tolerance (* 1e-7 size)))))))

; ---- circles ----

; Returns circles in the region, each the largest that fits beside the earlier ones.
(define (pack-circles region n #:least [least any? #f] #:gap [gap any? 0])
  (if (not (and (object? region) (or (region? region) (curve? region)))) (error 'pack-circles "region must be a region or a closed curve, got ~s" region))
  (%need-count 'pack-circles 'n n 20000)
  (if least (%need-positive 'pack-circles 'least least))
  (if (not (and (real? gap) (finite? gap) (>= gap 0))) (error 'pack-circles "gap must be a number of 0 or more, got ~s" gap))
  (let* ((b (bounding-box region)) (least (or least (if b (* 1e-3 (distance (first b) (second b))) 1))))
    (map (lambda (c) (make-circle (car c) (cdr c))) (%pack-circles region n least gap))))

; ---- shortest ways ----

; Returns the numbers of the points on the shortest way along the members.
(define (shortest-path points members from to)
  (%need-points 'shortest-path 'points points 1)
  (let ((n (length points)))
    (%need-members 'shortest-path members n)
    (%need-point-number 'shortest-path 'from from n)
    (%need-point-number 'shortest-path 'to to n)
    (let ((way (%shortest-path (append-map (lambda (m d) (list (- (first m) 1) (- (second m) 1) d)) members (%distances points members)) n (- from 1) (- to 1))))
      (if (null? way) (error 'shortest-path "no members lead from point ~a to point ~a" from to))
      (map (lambda (i) (+ i 1)) way))))

; Returns the shortest tree that connects the points, as pairs of points (Prim).
(define (%spanning-tree points)
  (let* ((all (list->vector points)) (n (vector-length all)) (near (make-vector n 0)) (far (make-vector n +inf.0)) (in (make-vector n #f)))
    (vector-set! in 0 #t)
    (do ((i 1 (+ i 1))) ((= i n)) (vector-set! far i (distance (vector-ref all 0) (vector-ref all i))))
    (let loop ((left (- n 1)) (edges '()))
      (if (= left 0)
          (reverse edges)
          (let ((next (let find ((i 0) (best #f)) (cond ((= i n) best) ((and (not (vector-ref in i)) (or (not best) (< (vector-ref far i) (vector-ref far best)))) (find (+ i 1) i)) (else (find (+ i 1) best))))))
            (vector-set! in next #t)
            (do ((i 0 (+ i 1))) ((= i n))
              (let ((d (distance (vector-ref all next) (vector-ref all i))))
                (if (and (not (vector-ref in i)) (< d (vector-ref far i))) (begin (vector-set! far i d) (vector-set! near i next)))))
            (loop (- left 1) (cons (list (vector-ref near next) next) edges)))))))

; A tree of points: the given ones, and joints. Nodes are in a vector that grows, neighbours are lists of numbers.
(define (shortest-network points #:joints [joints any? #t])
  (%need-points 'shortest-network 'points points 1)
  (let* ((points (delete-duplicates points)) (n (length points)))
    (if (> n 2000) (error 'shortest-network "points must be at most 2000, got ~a" n))
    (let ((at (make-hash)) (near (make-hash)) (count n))
      (define (p i) (hash-ref at i))
      (define (neighbours i) (hash-ref near i))
      (define (join! i j) (hash-set! near i (cons j (neighbours i))) (hash-set! near j (cons i (neighbours j))))
      (define (part! i j)
        (hash-set! near i (remove (lambda (k) (= k j)) (neighbours i)))
        (hash-set! near j (remove (lambda (k) (= k i)) (neighbours j))))
      (define (angle i j k) (angle-between (p->q (p i) (p j)) (p->q (p i) (p k))))
      ; returns the narrowest corner of less than 120 degrees at i, as a list of its angle and two neighbours
      (define (corner i)
        (let loop ((l (neighbours i)) (best #f))
          (if (null? l)
              best
              (loop (cdr l)
                (fold (lambda (k best) (let ((a (angle i (car l) k))) (if (and (< a (- (* 2/3 pi) 1e-6)) (or (not best) (< a (car best)))) (list a (car l) k) best)))
                      best (cdr l))))))
      ; returns the point with the shortest sum of three ways (Weiszfeld), from their mean on
      (define (meeting l)
        (let loop ((q (%mean-point l)) (turn 0))
          (let* ((weights (map (lambda (r) (/ 1 (max 1e-12 (distance q r)))) l)) (sum (apply + weights))
                 (next (p+v origin (v/r (fold (lambda (r w v) (v+v v (v*r (p->q origin r) w))) (vxyz 0 0 0) l weights) sum))))
            (if (or (= turn 60) (< (distance q next) 1e-12)) next (loop next (+ turn 1))))))
      (define (split! i j k)
        (let ((new count))
          (set! count (+ count 1))
          (hash-set! at new (meeting (map p (list i j k))))
          (hash-set! near new '())
          (part! i j)
          (part! i k)
          (for-each (lambda (m) (join! new m)) (list i j k))))
      (define (settle! times)
        (do ((turn 0 (+ turn 1))) ((= turn times))
          (do ((i n (+ i 1))) ((= i count)) (hash-set! at i (meeting (map p (neighbours i)))))))
      (for-each (lambda (q i) (hash-set! at i q) (hash-set! near i '())) points (iota n))
      (for-each (lambda (e) (join! (first e) (second e))) (%spanning-tree points))
      (if joints
          (let loop ((i 0))
            (if (< i n)
                (let ((c (corner i))) (if c (begin (split! i (second c) (third c)) (loop i)) (loop (+ i 1)))))))
      (settle! (if joints 40 0))
      (append-map (lambda (i) (filter-map (lambda (j) (and (< i j) (> (distance (p i) (p j)) 1e-9) (list (p i) (p j)))) (neighbours i))) (iota count)))))

; ---- straight skeletons ----

; Returns the faces of the edges of closed outlines that move inwards: lists of the edge's number and of points.
(define (straight-skeleton outline speeds)
  (let ((loops (if (and (pair? outline) (point? (car outline))) (list outline) outline)))
    (if (not (and (pair? loops) (list? loops) (every (lambda (l) (and (list? l) (every point? l) (> (length l) 2))) loops)))
        (error 'straight-skeleton "outline must be a list of three points or more, or a list of such lists, got ~s" outline))
    (let* ((n (apply + (map length loops))) (good? (lambda (v) (and (real? v) (finite? v) (>= v 0))))
           (each (if (list? speeds) speeds (make-list n speeds))))
      (if (not (every good? each))
          (error 'straight-skeleton "speeds must be a number of 0 or more, or a list of them, got ~s" speeds))
      (if (not (= (length each) n))
          (error 'straight-skeleton "speeds must be ~a numbers, one for each edge, got ~a" n (length each)))
      (map (lambda (face) (if (eqv? (car face) 0) (cons #f (cdr face)) face))
           (%straight-skeleton (append-map values loops) each (map length loops))))))
