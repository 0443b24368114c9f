; make-surface with a tolerance: lines are added where the surface bends.

(define tried 0)
(define (counted f) (lambda (u v) (set! tried (+ tried 1)) (f u v)))
(define-syntax calls-for
  (syntax-rules () ((_ f argument ...) (begin (set! tried 0) (object? (make-surface (counted f) argument ...)) tried))))

; a plane stays as it began: 8 steps both ways, each looked at twice, and every cell's middle
(define (plane u v) (xyz u v 0))
(displayln (calls-for plane #:tolerance 0.001)) ; expect: 433
(displayln (calls-for plane #:nu 1 #:nv 1 #:tolerance 0.001)) ; expect: 13

; a corrugated sheet takes lines across the waves and none along them: 16 waves are seen, though the first steps end
; where each of them crosses the plane
(define (sheet u v) (xyz u v (* 0.1 (sin (* 16 pi u)))))
(define (reach f tolerance) ; how many different u and v were asked for
  (let ((us (make-hash)) (vs (make-hash)))
    (object? (make-surface (lambda (u v) (hash-set! us u #t) (hash-set! vs v #t) (f u v)) #:tolerance tolerance))
    (list (hash-count us) (hash-count vs))))
(displayln (> (car (reach sheet 0.001)) 128)) ; expect: #t
(displayln (< (cadr (reach sheet 0.001)) 26)) ; expect: #t

; the triangles stay within the tolerance of the surface, wherever it is looked at; borders that meet are joined
(define (far-off solid f u1 v1 n)
  (let loop ((i 0) (most 0))
    (if (= i n)
        most
        (let ((u (* u1 (/ (modulo (* i 7919) n) n))) (v (* v1 (/ i n))))
          (loop (+ i 1) (max most (abs (signed-distance solid (f u v)))))))))
(define (ball u v) (sph 2 u v))
(define (ring u v) (+xy (cyl (+ 3 (cos v)) u (sin v)) 0 0))
(define (egg u v) (let ((p (sph 1 u v))) (xyz (cx p) (* 2 (cy p)) (* 5 (cz p)))))
(define (keeps f u1 v1 tolerance)
  (let ((solid (make-surface f 0 u1 0 v1 #:tolerance tolerance)))
    (and (solid? solid) (< (far-off solid f u1 v1 2003) (* 1.1 tolerance)))))
(displayln (keeps ball 2pi pi 0.01)) ; expect: #t
(displayln (keeps ball 2pi pi 0.002)) ; expect: #t
(displayln (keeps ring 2pi 2pi 0.01)) ; expect: #t
(displayln (keeps egg 2pi pi 0.01)) ; expect: #t
; the wider the tolerance, the fewer points
(displayln (> (calls-for ball 0 2pi 0 pi #:tolerance 0.001) (* 3 (calls-for ball 0 2pi 0 pi #:tolerance 0.01)))) ; expect: #t

; a saddle's lines are straight both ways, and its cells are warped
(define saddle (make-surface (lambda (u v) (xyz u v (* u v))) #:tolerance 0.001))
(define here (xyz 0.47 0.53 (* 0.47 0.53)))
(displayln (< (distance here (closest-point saddle here)) 0.001)) ; expect: #t

; a jump is parted down to a millionth of the range, and ends
(define cliff (make-surface (lambda (u v) (xyz u v (if (< u 0.3) 0 1))) #:tolerance 1e-3))
(displayln (near? (bounding-box cliff) (list origin (xyz 1 1 1)))) ; expect: #t

; a continuation taken in f, and an error there, go through
(displayln (call/cc (lambda (k) (make-surface (lambda (u v) (if (> u 0.5) (k 'left) (xyz u v 0))) #:tolerance 1)))) ; expect: left
