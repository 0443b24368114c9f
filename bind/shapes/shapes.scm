; Shapes made from curves and surfaces: pipes, Coons patches, Bezier and NURBS curves and surfaces, wires. After
; functions.scm. Names that begin with % are hidden from programs. Compiled into the binary when it is built.

(define (%need-curve who name c)
  (if (not (and (object? c) (curve? c))) (error who "~a must be a curve, got ~s" name c)))

(define (%need-count who name n most)
  (if (not (and (exact-integer? n) (<= 1 n most))) (error who "~a must be an exact integer from 1 to ~a, got ~s" name most n)))

(define (%need-segments who n)
  (if (not (or (not n) (and (exact-integer? n) (<= 3 n 100000))))
      (error who "segments must be an exact integer from 3 to 100000 or #f, got ~s" n)))

(define (%finite-point? p) (and (point? p) (finite? (cx p)) (finite? (cy p)) (finite? (cz p))))
(define (%need-point who name p)
  (if (not (%finite-point? p)) (error who "~a must be a point of finite coordinates, got ~s" name p)))
(define (%need-number who name x)
  (if (not (and (real? x) (finite? x))) (error who "~a must be a number and finite, got ~s" name x)))

; Returns the value of f at this number, which must be a point.
(define (%point-of who name f t)
  (let ((p (f t)))
    (if (%finite-point? p) p (error who "~a must give points of finite coordinates; at ~a it gave ~s" name t p))))

; ---- pipes ----

; r is a number, or a procedure of the place on the curve, from 0 at its start to 1 at its end.
(define (make-pipe c r #:segments [segments any? #f])
  (%need-curve 'make-pipe 'c c)
  (%need-segments 'make-pipe segments)
  (cond
    ((procedure? r)
     (let* ((places (%pipe-places c segments)) (closed (< (last places) 1)) (most (- (length places) 1)))
       (%make-pipe c segments
         (map (lambda (t i)
                (let ((radius (r t)))
                  (if (not (and (real? radius) (finite? radius) (>= radius 0)))
                      (error 'make-pipe "r must give numbers of 0 or more; at ~a it gave ~s" t radius))
                  (if (and (= radius 0) (or closed (< 0 i most)))
                      (error 'make-pipe "r may be 0 at an open curve's ends alone; it is 0 at ~a" t))
                  radius))
              places (iota (length places))))))
    ((not (and (real? r) (finite? r) (>= r 0))) (error 'make-pipe "r must be a number of 0 or more, or a procedure, got ~s" r))
    (segments (do-thicken c (* 2 r) #:segments segments))
    (else (do-thicken c (* 2 r)))))

; ---- Coons patches ----

; Returns a side as n + 1 points: of a curve at equal lengths, of a procedure at equal steps from 0 to 1.
(define (%side who name c n)
  (if (procedure? c)
      (map (lambda (t) (%point-of who name c t)) (division 0 1 n))
      (begin
        (%need-curve who name c)
        (curve-division c n))))

; c0 and c1 run along u, at v = 0 and 1; d0 and d1 along v. A curve in the other direction is reversed.
(define (make-coons c0 c1 d0 d1 #:nu [nu any? #f] #:nv [nv any? #f])
  (let* ((nu (or nu (current-segments) 64)) (nv (or nv (current-segments) 64)))
    (%need-count 'make-coons 'nu nu 10000)
    (%need-count 'make-coons 'nv nv 10000)
    (let* ((given (list (%side 'make-coons 'c0 c0 nu) (%side 'make-coons 'c1 c1 nu) (%side 'make-coons 'd0 d0 nv) (%side 'make-coons 'd1 d1 nv)))
           (turned (map reverse given))
           (size (apply max 1e-300 (map (lambda (p) (distance p (car (first given)))) (append-map (lambda (l) (list (car l) (last l))) given)))))
      (define (near? p q) (<= (distance p q) (* 1e-6 size)))
      (define (fits? s)
        (let ((a (first s)) (b (second s)) (c (third s)) (d (fourth s)))
          (and (near? (car a) (car c)) (near? (last a) (car d)) (near? (car b) (last c)) (near? (last b) (last d)))))
      ; returns the sides, reversed if their bit is set
      (define (sides bits) (map (lambda (l r i) (if (odd? (quotient bits (expt 2 i))) r l)) given turned (iota 4)))
      (define (miss one here p other there q)
        (if (not (near? p q))
            (error 'make-coons "~a and ~a do not meet: ~a ~a at ~s, ~a ~a at ~s" one other one here p other there q)))
      (let ((found (find (lambda (bits) (fits? (sides bits))) (iota 16))))
        (if (not found)
            (let ((a (first given)) (b (second given)) (c (third given)) (d (fourth given)))
              (miss 'c0 "starts" (car a) 'd0 "starts" (car c))
              (miss 'c0 "ends" (last a) 'd1 "starts" (car d))
              (miss 'c1 "starts" (car b) 'd0 "ends" (last c))
              (miss 'c1 "ends" (last b) 'd1 "ends" (last d))))
        (let* ((s (sides found)) (a (first s)) (b (second s)) (c (third s)) (d (fourth s))
               (p00 (car a)) (p10 (last a)) (p01 (car b)) (p11 (last b)))
          (define (blend u v pa pb pc pd)
            (let ((mix (lambda (f)
                         (- (+ (* (- 1 v) (f pa)) (* v (f pb)) (* (- 1 u) (f pc)) (* u (f pd)))
                            (+ (* (- 1 u) (- 1 v) (f p00)) (* u (- 1 v) (f p10)) (* (- 1 u) v (f p01)) (* u v (f p11)))))))
              (xyz (mix cx) (mix cy) (mix cz))))
          (%make-surface
            (map (lambda (u pa pb) (map (lambda (v pc pd) (blend u v pa pb pc pd)) (division 0 1 nv) c d))
                 (division 0 1 nu) a b)
            #f #f #f #f))))))

; ---- rational B-splines ----

(define (%need-points who name l least)
  (if (not (and (list? l) (every %finite-point? l))) (error who "~a must be a list of points of finite coordinates, got ~s" name l))
  (if (< (length l) least) (error who "~a must hold ~a points or more, got ~a" name least (length l))))

(define (%need-weights who l n)
  (if l
      (begin
        (if (not (and (list? l) (every (lambda (w) (and (real? w) (finite? w) (positive? w))) l)))
            (error who "weights must be a list of positive numbers, got ~s" l))
        (if (not (= (length l) n)) (error who "weights must be ~a numbers, one for each point, got ~a" n (length l))))))

(define (%need-degree who name p n)
  (if (not (and (exact-integer? p) (<= 1 p 15))) (error who "~a must be an exact integer from 1 to 15, got ~s" name p))
  (if (>= p n) (error who "~a must be less than the number of points, ~a, got ~a" name n p)))

; Returns the given knots, or those of a curve from its first point to its last, evenly spaced from 0 to 1.
(define (%knots who name knots n p)
  (if knots
      (begin
        (if (not (and (list? knots) (every (lambda (t) (and (real? t) (finite? t))) knots)))
            (error who "~a must be a list of numbers, got ~s" name knots))
        (if (not (= (length knots) (+ n p 1)))
            (error who "~a must be ~a numbers, points and degree and one (~a + ~a + 1), got ~a" name (+ n p 1) n p (length knots)))
        knots)
      (append (make-list p 0) (division 0 1 (- n p)) (make-list p 1))))

(define (%spline-of who points pu pv weights ku kv names)
  (let ((made (%nurbs points pu pv (or weights #f) ku kv)))
    (if (pair? made)
        (let ((name (if (= (second made) 0) (car names) (cadr names))) (knots (if (= (second made) 0) ku kv)) (at (third made)))
          (case (first made)
            ((1) (error who "~a must not fall: number ~a is ~a after ~a" name (+ at 1) (list-ref knots at) (list-ref knots (- at 1))))
            ((2) (error who "~a holds ~a more often than the degree: the curve would come apart there" name (list-ref knots at)))
            (else (error who "~a must rise somewhere between the first and the last point's" name))))
        made)))

(define (%curve-spline who points degree weights knots closed)
  (%need-points who 'points points 2)
  (%need-degree who 'degree degree (length points))
  (%need-weights who weights (length points))
  (if (and closed knots) (error who "a closed curve has even knots: give #:closed or #:knots, not both"))
  (if closed
      (let* ((all (append points (take points degree))) (n (length all)))
        (%spline-of who all degree 0 (and weights (append weights (take weights degree)))
          (map (lambda (i) (- i degree)) (iota (+ n degree 1))) '() '(knots)))
      (%spline-of who points degree 0 weights (%knots who 'knots knots (length points) degree) '() '(knots))))

(define (%points-of arguments)
  (if (and (pair? arguments) (null? (cdr arguments)) (not (point? (car arguments)))) (car arguments) arguments))

(define (make-bezier-curve . points)
  (let ((points (%points-of points)))
    (%need-points 'make-bezier-curve 'points points 2)
    (if (> (length points) 16) (error 'make-bezier-curve "points must be at most 16, got ~a; make-spline goes through more" (length points)))
    (%make-nurbs-curve (%curve-spline 'make-bezier-curve points (- (length points) 1) #f #f #f))))

(define (make-nurbs-curve points #:degree [degree any? 3] #:weights [weights any? #f] #:knots [knots any? #f] #:closed [closed any? #f])
  (%make-nurbs-curve (%curve-spline 'make-nurbs-curve points degree weights knots closed)))

; Returns the curve as a procedure of t.
(define (nurbs-curve-function points #:degree [degree any? 3] #:weights [weights any? #f] #:knots [knots any? #f] #:closed [closed any? #f])
  (let ((s (%curve-spline 'nurbs-curve-function points degree weights knots closed)))
    (lambda (t) (%nurbs-point s t 0))))

(define (%surface-spline who rows pu pv weights ku kv)
  (if (not (and (list? rows) (pair? rows) (every list? rows))) (error who "rows must be a list of lists of points, got ~s" rows))
  (let ((nu (length rows)) (nv (length (car rows))))
    (for-each (lambda (r i)
                (%need-points who 'rows r 2)
                (if (not (= (length r) nv))
                    (error who "rows must be lists of equally many points: the first has ~a, number ~a has ~a" nv (+ i 1) (length r))))
              rows (iota nu))
    (if (< nu 2) (error who "rows must be two lists of points or more, got ~a" nu))
    (let ((pu (or pu (min 3 (- nu 1)))) (pv (or pv (min 3 (- nv 1)))))
      (%need-degree who 'degree-u pu nu)
      (%need-degree who 'degree-v pv nv)
      (if (and weights (not (and (list? weights) (= (length weights) nu) (every (lambda (w) (and (list? w) (= (length w) nv))) weights))))
          (error who "weights must be ~a lists of ~a numbers, one for each point, got ~s" nu nv weights))
      (let ((flat (and weights (apply append weights))))
        (%need-weights who flat (* nu nv))
        (%spline-of who (apply append rows) pu pv flat (%knots who 'knots-u ku nu pu) (%knots who 'knots-v kv nv pv) '(knots-u knots-v))))))

(define (%sampled-surface who s nu nv)
  (define (count name n) (if n (begin (%need-count who name n 10000) n) (or (current-segments) 0)))
  (%make-nurbs-surface s (count 'nu nu) (count 'nv nv)))

(define (make-bezier-patch rows #:nu [nu any? #f] #:nv [nv any? #f])
  (if (and (list? rows) (pair? rows) (list? (car rows)))
      (if (> (max (length rows) (length (car rows))) 16) (error 'make-bezier-patch "rows must be at most 16 lists of at most 16 points")))
  (%sampled-surface 'make-bezier-patch
    (if (and (list? rows) (pair? rows) (list? (car rows)))
        (%surface-spline 'make-bezier-patch rows (- (length rows) 1) (- (length (car rows)) 1) #f #f #f)
        (%surface-spline 'make-bezier-patch rows #f #f #f #f #f))
    nu nv))

(define (make-nurbs-surface rows #:degree-u [degree-u any? #f] #:degree-v [degree-v any? #f] #:weights [weights any? #f] #:knots-u [knots-u any? #f]
                            #:knots-v [knots-v any? #f] #:nu [nu any? #f] #:nv [nv any? #f])
  (%sampled-surface 'make-nurbs-surface (%surface-spline 'make-nurbs-surface rows degree-u degree-v weights knots-u knots-v) nu nv))

; Returns the surface as a procedure of u and v.
(define (nurbs-surface-function rows #:degree-u [degree-u any? #f] #:degree-v [degree-v any? #f] #:weights [weights any? #f] #:knots-u [knots-u any? #f]
                                #:knots-v [knots-v any? #f])
  (let ((s (%surface-spline 'nurbs-surface-function rows degree-u degree-v weights knots-u knots-v)))
    (lambda (u v) (%nurbs-point s u v))))

; ---- wires ----

; Returns the lines of a surface, nu + 1 along v and nv + 1 along u, as curves; with a radius, as bars.
(define (make-wire f #:nu [nu any? 16] #:nv [nv any? 16] #:radius [radius any? #f] . ranges)
  (define (range x) (if (and (real? x) (finite? x)) x (error 'make-wire "a range goes from a number to a number, got ~s" x)))
  (if (not (procedure? f)) (error 'make-wire "f must be a procedure of u and v, got ~s" f))
  (if (not (memv (length ranges) '(0 4))) (error 'make-wire "takes (make-wire f [u0 u1 v0 v1])"))
  (if (not (or (not radius) (and (real? radius) (finite? radius) (positive? radius)))) (error 'make-wire "radius must be positive, got ~s" radius))
  (%need-count 'make-wire 'nu nu 1000)
  (%need-count 'make-wire 'nv nv 1000)
  (let* ((ends (map range (if (null? ranges) '(0 1 0 1) ranges)))
         (fine (lambda (n) (* n (max 1 (ceiling (/ 64 n))))))
         (us (division (first ends) (second ends) (fine nu))) (vs (division (third ends) (fourth ends) (fine nv))))
    (define (at u v)
      (let ((p (f u v)))
        (if (%finite-point? p) p (error 'make-wire "f must give points of finite coordinates; at (u, v) = (~a, ~a) it gave ~s" u v p))))
    (define (every-nth l step) (let loop ((l l) (i 0)) (if (null? l) '() (if (= 0 (remainder i step)) (cons (car l) (loop (cdr l) (+ i 1))) (loop (cdr l) (+ i 1))))))
    ; a line of points; none at a pole of the surface
    (define (line points)
      (if (every (lambda (p) (near? p (car points))) points)
          '()
          (let ((curve (make-spline points))) (list (if radius (do-thicken curve (* 2 radius)) curve)))))
    ; if the surface closes, its last line equals the first
    (define (once lines)
      (if (and (> (length lines) 2) (every near? (first lines) (last lines))) (reverse (cdr (reverse lines))) lines))
    (let* ((along-v (once (map (lambda (u) (map (lambda (v) (at u v)) vs)) (every-nth us (quotient (- (length us) 1) nu)))))
           (along-u (once (map (lambda (v) (map (lambda (u) (at u v)) us)) (every-nth vs (quotient (- (length vs) 1) nv))))))
      (unite (append-map line along-v) (append-map line along-u)))))
