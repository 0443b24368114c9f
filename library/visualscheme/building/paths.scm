; Paths of walls in plan: lists of points of one height. A positive offset is on the left of the path.

(define nearly 1e-6)                            ; points that are nearer than this are one point, in model units
(define (meet? p q) (< (distance p q) nearly))
(define (flat p) (xy (cx p) (cy p)))
(define (aside p v d) (+xy p (* d (- (cy v))) (* d (cx v))))            ; d to the left of p, for the direction v
(define (cross-2d a b) (- (* (cx a) (cy b)) (* (cy a) (cx b))))
(define (turned-back v) (v*r v -1))
(define (pairs-of points) (map cons points (cdr points)))

; Returns the points of a curve: the corners of lines, and samples of what is curved, 96 in a turn of a circle.
(define (curve-samples c)
  (case (object-kind c)
    ((line) (let ((points (car (object-arguments c)))) (if (cadr (object-arguments c)) (append points (list (car points))) points)))
    ((join-curves) (let ((parts (map curve-samples (object-children c)))) (fold chained (car parts) (cdr parts))))
    (else
      (let* ((l (curve-length c)) (ways (map (lambda (i) (curve-tangent c (* l (/ i 64)))) (iota 65)))
             (turn (apply + (map angle-between ways (cdr ways))))
             (n (max 2 (exact (ceiling (- (/ (* (or (current-segments) 96) turn) 2pi) 1e-6))))))
        (curve-division c n)))))

; Returns the points of two curves that meet, the second turned if need be.
(define (chained next before)
  (let ((end (last before)))
    (cond ((meet? end (car next)) (append before (cdr next)))
          ((meet? end (last next)) (append before (cdr (reverse next))))
          ((meet? (car before) (car next)) (append (reverse before) (cdr next)))
          (else (append (reverse before) (cdr (reverse next)))))))

; Returns the points without those that meet the next one.
(define (without-meeting points) (fold-right (lambda (p more) (if (and (pair? more) (meet? p (car more))) more (cons p more))) '() points))

; Returns the points of a path in plan, each once, and whether the path is closed.
(define (path-points who path)
  (define (fault) (error who "path must be a curve, or a list of two points or more, got ~s" path))
  (let* ((given (cond ((curve? path) (curve-samples path)) ((and (list? path) (every point? path)) path) (else (fault))))
         (z (if (pair? given) (cz (car given)) 0))
         (points (without-meeting (map flat given))))
    (if (or (null? points) (null? (cdr points))) (fault))
    (if (not (every (lambda (p) (near? (cz p) z)) given)) (error who "the points of path must have one height, got ~s" path))
    (let ((closed (and (> (length points) 3) (meet? (car points) (last points)))))
      (check-simple who points closed)
      (values points closed z))))

(define (check-simple who points closed)
  (let loop ((segments (pairs-of points)) (first? #t))
    (if (pair? segments)
        (begin
          (for-each
            (lambda (s i)
              (let ((x (segments-cross (caar segments) (cdar segments) (car s) (cdr s) 0)))
                (if (and x (> i 0) (not (and closed first? (eq? (cdr s) (last points)))))
                    (error who "the path crosses itself at ~s" (third x)))))
            (cdr segments) (iota (length (cdr segments))))
          (loop (cdr segments) #f)))))

; Returns where the segments a b and c d cross, as the list of the shares of both and the point, or #f. They may be longer
; by slack.
(define (segments-cross a b c d slack)
  (let* ((u (p->q a b)) (v (p->q c d)) (w (p->q a c)) (k (cross-2d u v)))
    (and (> (abs k) (* 1e-9 (vlength u) (vlength v)))
         (let ((s (/ (cross-2d w v) k)) (t (/ (cross-2d w u) k)) (e (/ slack (vlength u))) (f (/ slack (vlength v))))
           (and (<= (- e) s (+ 1 e)) (<= (- f) t (+ 1 f)) (list s t (p+v a (v*r u s))))))))

(define (points-length points) (apply + (map distance points (cdr points))))

; Returns the point at the distance s along points, and the direction there.
(define (place-along points s)
  (let* ((a (car points)) (b (cadr points)) (l (distance a b)))
    (if (or (<= s l) (null? (cddr points))) (let ((v (way a b))) (values (p+v a (v*r v s)) v))
        (place-along (cdr points) (- s l)))))

; Returns the distance along points of the point nearest to p, and how far p is from it.
(define (distance-along points p)
  (let loop ((points points) (s 0) (best 0) (gap +inf.0))
    (if (null? (cdr points)) (values best gap)
        (let* ((a (car points)) (b (cadr points)) (l (distance a b)) (t (max 0 (min l (dot (way a b) (p->q a p)))))
               (d (distance p (p+v a (v*r (way a b) t)))))
          (if (< d gap) (loop (cdr points) (+ s l) (+ s t) d) (loop (cdr points) (+ s l) best gap))))))

; Returns the part of points between two distances.
(define (part-of points from to)
  (let ((inner (let loop ((points points) (s 0))
                 (cond ((null? points) '())
                       ((< (+ from nearly) s (- to nearly)) (cons (car points) (loop-on loop points s)))
                       (else (loop-on loop points s)))))
        (end (lambda (s) (call-with-values (lambda () (place-along points s)) (lambda (p v) p)))))
    (append (list (end from)) inner (list (end to)))))
(define (loop-on loop points s) (loop (cdr points) (if (pair? (cdr points)) (+ s (distance (car points) (cadr points))) s)))

; Returns the points moved to the left by d, corners mitred. Fails if a bend is tighter than d.
(define (points-aside who points closed d)
  (let* ((ways (map way points (cdr points)))
         (before (cons (if closed (last ways) (car ways)) ways))
         (after (append ways (list (if closed (car ways) (last ways)))))
         (moved (map (lambda (p a b)
                       (let* ((k (+ 1 (dot a b))) (n (v+v (left a) (left b))))
                         (if (< k 0.03) (error who "the path turns too sharply at ~s" p))
                         (p+v p (v*r n (/ d k)))))
                  points before after)))
    (for-each (lambda (p q v a)
                (if (<= (dot v (p->q p q)) 0) (error who "the wall is thicker than the bend or the step of its path at ~s" a)))
      moved (cdr moved) ways points)
    moved))
