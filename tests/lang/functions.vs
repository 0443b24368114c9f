; Functions with their expression, derivatives, intervals: closed forms, nesting, tables after PM4VR's figures.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (close? a b) (<= (abs (- a b)) (* 1e-9 (max 1 (abs b)))))
; the figures
(define (f x) (+ (* x x) (* 3 (sin x))))
(displayln (/ (round (* 1e6 (f 1.3))) 1e6))             ; expect: 4.580675
(displayln (/ (round (* 1e6 (derivative f 1.3))) 1e6))  ; expect: 3.402496
(displayln (hessian (lambda (x y) (+ (square (- 1 x)) (* 100 (square (- y (square x)))))) 1 1)) ; expect: ((802 -400) (-400 200))
(displayln (derivative (lambda (x) (* x (derivative (lambda (y) (+ x y)) 1))) 1))               ; expect: 1
; perturbations that meet in the inner function, kept in a variable that outlives it
(displayln (derivative (lambda (x) (derivative (lambda (y) (* x x y y)) x)) 3))                  ; expect: 54
(define kept #f)
(displayln (derivative (lambda (x) (derivative (lambda (y) (set! kept y) (* x y)) 2) ) 5))       ; expect: 1
(displayln (derivative (lambda (x) (* x kept)) 5)) ; expect: #<dual 2>
(displayln (derivative (lambda (x) (call/cc (lambda (k) (k (* x x))))) 4))                        ; expect: 8
; each rule against the quotient of small differences, and derivatives of derivatives
(define (slope f x) (/ (- (f (+ x 1e-5)) (f (- x 1e-5))) 2e-5))
(define rules
  (list sin cos tan asin acos atan sinh cosh tanh exp log sqrt cube-root abs sec csc cot acot asinh log10 log2 gauss sawtooth
    (lambda (x) (expt x 3)) (lambda (x) (expt x -2)) (lambda (x) (expt 2 x)) (lambda (x) (expt x x)) (lambda (x) (expt x 0.3)) (lambda (x) (log x 3)) (lambda (x) (log 3 x))
    (lambda (x) (atan x 2)) (lambda (x) (atan 2 x)) (lambda (x) (atan (* x x) (- x 2))) (lambda (x) (hypot x 2)) (lambda (x) (/ 1 x)) (lambda (x) (/ x (+ 1 (* x x))))
    (lambda (x) (max x 0.1)) (lambda (x) (min x 0.1)) (lambda (x) (- x)) (lambda (x) (1+ (* 2 x))) (lambda (x) (* (sgn x) x)) (lambda (x) (inexact (* 2 x)))
    (lambda (x) (if (< x 1) (* x x) 0)) (lambda (x) (cx (pol x 1))) (lambda (x) (distance (sph 1 x 2) (cyl 1 x x))) (lambda (x) (dot (vxyz x 1 2) (vpol 1 x)))
    (lambda (x) (vlength (cross (vxyz x 1 2) (vxyz 0 x x)))) (lambda (x) (cz (+xyz (xyz 1 2 x) x x x))) (lambda (x) (cy (unitize (vxyz x 1 2))))
    (lambda (x) (cx (intermediate-point (xyz x 1 1) (xyz 2 x 1) x))) (lambda (x) (cx (+ (xyz 1 2 3) (* x (vxyz x 1 1)))))
    (lambda (x) (cy (mid (xyz x x x) (+pol origin x x)))) (lambda (x) (degrees->radians x)) (lambda (x) (cx (- (/ (vxyz x 1 1) x))))))
(displayln (filter (lambda (i) (not (< (abs (- (derivative (list-ref rules i) 0.37) (slope (list-ref rules i) 0.37))) 1e-6))) (iota (length rules)))) ; expect: ()
(displayln (filter (lambda (i) (let ((d (derivative (list-ref rules i)))) (not (< (abs (- (derivative d 0.37) (slope d 0.37))) 1e-5)))) (iota (length rules)))) ; expect: ()
(displayln (derivative (derivative (derivative (lambda (x) (* x x x x)))) 2)) ; expect: 48
(displayln (gradient (lambda (p) (dot (p-p p origin) (vxyz 1 2 3))) (xyz 5 5 5))) ; expect: (vxyz 1 2 3)
(displayln (jacobian (lambda (u v) (xyz u v (* u v))) 2 3))                   ; expect: ((1.0 0.0) (0.0 1.0) (3.0 2.0))
(displayln (number? (derivative (lambda (x) (if (number? x) x 0)) 1)))        ; expect: #t
(define (deep n) (if (= n 0) (lambda (x) (* x x)) (lambda (x) (derivative (lambda (y) ((deep (- n 1)) (+ x y))) 0))))
(fails ((deep 30) 1)) ; expect: +: derivatives lie more than 24 deep in one another
; where it ends
(fails (derivative (lambda (r) (make-sphere origin r)) 1))   ; expect: make-sphere: r is a number that is being differentiated, and objects accept plain numbers only
(fails (derivative (lambda (r) (make-line (xyz 0 0 0) (xyz r 0 0))) 1)) ; expect: make-line: points must be a point or a list of points, got #<dual (xyz 1 0 0)>
(fails (derivative (lambda (x) 'red) 1))                     ; expect: derivative: f must give a number, a point, a gvector or a list of them, got red
(fails (gradient 5 1))                                       ; expect: gradient: f must be a procedure, got 5
(fails (derivative sin 'x))                                  ; expect: derivative: x must be a number, got x
(fails (derivative (lambda (x) (sqrt (- x 2))) 1))           ; expect: sqrt: x must be a number that is not negative, got -1
; tables: figure 12's last row, figure 8's samples
(define-function (g t) #:t (0.1 1 10) (xyz t (sec t) (csc t)))
(tabulate g '(0.9 1 2))                  ; expect: g(0.9) = <0.9, 1.608726, 1.276606>
                                         ; expect: g(1) = <1, 1.850816, 1.188395>
(displayln (vector-length (function-samples g))) ; expect: 10
(define k 2)
(define-function (h x y z) (xyz (* k x) (* k y) (* k z)))
(define-function (w x y z) (xyz (expt x k) (expt y k) (expt z k)))
(displayln (vector-length (function-samples h '(1 2 2) '(3 4 2) '(5 6 2)))) ; expect: 8
(displayln (vector-ref (function-samples w '(1 2 2) '(3 4 2) '(5 6 2)) 7))  ; expect: (xyz 4 16 36)
(tabulate (lambda (x) (/ x 3)) '(-1 1 3)) ; expect: f(-1) = -0.333333
                                          ; expect: f(0) = 0
                                          ; expect: f(1) = 0.333333
; a kept expression gives what the procedure gives
(define-function (all x y)
  (let* ((a (+ x (* 2 y) 1)) (b (- a 1/3)))
    (cond
      ((and (> a 1) (not (< y 0.2)) (<= x y 2)) (+ (sin a) (cos b) (tan (/ a 9)) (exp (- b)) (expt (+ 1 (square x)) y) (abs (- x y)) (sqrt a) (cube-root (- b))))
      ((or (zero? x) (= y 0)) (atan a (+ b 5)))
      (else (+ (max x y 0.3) (min x y) (sinh x) (cosh y) (tanh x) (asin (/ x 9)) (acos (/ y 9)) (atan x) (log (+ 3 x)) (log (+ 3 x) 2) (floor b) (ceiling b) (hypot x y) (sgn x) (asinh x) (expt a 3) (expt 2 x)
             (vlength (cross (vxyz x y 1) (- (vxyz 1 2 3) (* 2 (vxyz y x 1))))) (cy (+ (xyz x y 0) (unitize (vxyz 1 y 2)))) (distance (xyz x y 1) (xyz 1 1 1)))))))
(define spots (append-map (lambda (x) (map (lambda (y) (list x y)) '(-1 0 0.5 1 2))) '(-1 0 0.5 1 2)))
(displayln (every (lambda (p v) (close? (apply all p) v)) spots
  (append-map (lambda (x) (append-map (lambda (y) (vector->list (function-samples all (list x (+ x 1) 1) (list y (+ y 1) 1)))) '(-1 0 0.5 1 2))) '(-1 0 0.5 1 2)))) ; expect: #t
(displayln (every (lambda (p) (let ((b (function-bounds all (interval (- (car p) 0.1) (+ (car p) 0.1)) (cadr p)))) (<= (interval-low b) (apply all p) (interval-high b)))) spots)) ; expect: #t
; and so it does in batches, whole ones and the rest
(define grid-x (division -1 2 16))
(define grid-y (division -0.9 2.1 18))
(displayln (every close? (append-map (lambda (x) (map (lambda (y) (all x y)) grid-y)) grid-x) (vector->list (function-samples all '(-1 2 17) '(-0.9 2.1 19))))) ; expect: #t
(define-function (same x) x)
(displayln (equal? (function-samples same '(0 299 300)) (list->vector (map inexact (iota 300))))) ; expect: #t
(define-function (small x-1 y) (- (if (< x-1 y) (/ 1 (- x-1 (* 2 y))) (- y)) (atan x-1 -2)))
(displayln (function-text small 'javascript)) ; expect: ((x_1 < y ? 1 : 0) !== 0 ? 1 / (x_1 - y * 2) : -y) - Math.atan2(x_1, (-2))
(displayln (function-text h 'povray))         ; expect: (x * 2 y * 2 z * 2)
(fails (all 1))                             ; expect: all needs 2 arguments (x y), got 1
(define-function (loop x) (loop x))
(fails (function-samples loop '(0 1 2)))    ; expect: function-samples: in the expression of loop: loop calls itself; an expression has an end
(define-function (odd-one x) (not-there x))
(fails (function-bounds odd-one 1))         ; expect: not-there is not defined
(define-function (bad x) (+ 1 (xyz x 0 0)))
(fails (function-samples bad '(0 1 2)))     ; expect: function-samples: in the expression of bad: a point stands where a number belongs
(fails (function-samples f '(0 1 2) '(1 2 3))) ; expect: f needs 1 argument (x), got 2
(fails (function-expression car))           ; expect: function-expression: f must be a function that keeps its expression, made by define-function, got #<procedure car>
; intervals hold what they should
(displayln (let ((i (interval 0.1 0.3))) (let ((b (sin (* 10 i)))) (and (<= (interval-low b) (sin 3)) (>= (interval-high b) 1)))))  ; expect: #t
(displayln (/ 1 (interval -1 1)))                                       ; expect: (interval -inf.0 +inf.0)
(fails (sqrt (interval -2 -1)))                                         ; expect: sqrt: the operation has no value anywhere in the interval (interval -2 -1)
(fails (+ (interval 0 1) "a"))                                          ; expect: +: expected a number, got "a"
