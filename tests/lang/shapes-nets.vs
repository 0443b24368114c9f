; Form finding against closed forms, kinds of members, and what is refused.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (root f low high)
  (let loop ((a low) (b high) (i 0))
    (let ((m (/ (+ a b) 2.)))
      (cond ((= i 80) m) ((> (* (f a) (f m)) 0) (loop m b (+ i 1))) (else (loop a m (+ i 1)))))))
; a chain of length 3 over a span of 2 is y = a cosh (x / a), within a thousandth of its sag
(define n 60)
(define chain (map (lambda (i) (xyz (/ (* 2 i) n) 0 0)) (iota (+ n 1))))
(define links (map (lambda (i) (list i (+ i 1))) (iota n 1)))
(define a (root (lambda (a) (- (* 2 a (sinh (/ 1 a))) 3)) 0.2 2))
(define sag (* a (- (cosh (/ 1 a)) 1)))
(define hung (form-report chain links #:fixed (list 1 (+ n 1)) #:weight (vxyz 0 0 -1) #:lengths (/ 3 n)))
(define (of name) (cdr (assq name hung)))
(define off (apply max (map (lambda (p) (abs (- (cz p) (* a (- (cosh (/ (- (cx p) 1) a)) (cosh (/ 1 a))))))) (of 'points))))
(displayln (< (/ off sag) 1e-3))                                          ; expect: #t
(displayln (< (abs (- (apply min (of 'forces)) a)) 1e-3))                 ; expect: #t
(displayln (< (abs (- (of 'longest) 1/20)) 1e-6))                         ; expect: #t
(displayln (< (of 'unbalanced) 1e-6))                                     ; expect: #t
; equal loads along the span on force densities: a parabola, to rounding
(define bowed (form-find chain links #:fixed (list 1 (+ n 1)) #:load (vxyz 0 0 -0.01) #:tolerance 1e-10))
(define (parabola x) (let ((i (* x n 1/2))) (* -0.005 i (- n i))))
(displayln (< (apply max (map (lambda (p) (abs (- (cz p) (parabola (cx p))))) bowed)) 1e-6)) ; expect: #t
; one weight on two springs: its depth by the triangle of forces
(define v (second (form-find (list (xyz -1 0 0) origin (xyz 1 0 0)) '((1 2) (2 3)) #:fixed '(1 3) #:load (list (vxyz 0 0 0) (vxyz 0 0 -2) (vxyz 0 0 0)) #:lengths 1 #:stiffness 10)))
(define depth (root (lambda (d) (let ((l (sqrt (+ 1 (* d d))))) (- (* 2 10 (- l 1) (/ d l)) 2))) 0.01 3))
(displayln (< (abs (+ (cz v) depth)) 1e-5))                               ; expect: #t
; slack cables carry nothing
(define loose (form-report (list origin (xyz 1 0 0) (xyz 1 0 -1)) '((1 2) (2 3) (1 3)) #:fixed '(1 2) #:load (list (vxyz 0 0 0) (vxyz 0 0 0) (vxyz 0 0 -1)) #:lengths '(5 1 5)))
(displayln (map (lambda (f) (near? f 0 1e-6)) (cdr (assq 'forces loose)))) ; expect: (#t #f #t)
; upside down it is the same
(define up (form-find chain links #:fixed (list 1 (+ n 1)) #:weight (vxyz 0 0 1) #:lengths (/ 3 n)))
(displayln (every (lambda (p q) (near? (+ (cz p) (cz q)) 0 1e-4)) up (of 'points))) ; expect: #t
; nets over a surface
(displayln (net-members 1 1)) ; expect: ((1 3) (2 4) (1 2) (3 4))
(displayln (net-faces 2 1))   ; expect: ((1 3 4 2) (3 5 6 4))
(displayln (net-border 2 2))  ; expect: (1 2 3 4 6 7 8 9)
(displayln (length (net-points (lambda (u v) (xyz u v 0)) 4 3))) ; expect: 20
; what is wrong
(fails (form-find chain links #:weight (vxyz 0 0 -1)))  ; expect: form-find: point 1 is loaded, and no members lead from that point to a fixed point
(define (starts text) (substring text 0 60))
(displayln (starts (condition/report-string (guard (c (#t c)) (form-find chain links #:fixed '(1 61) #:load (vxyz 0 0 -1) #:lengths 1/60))))) ; expect: form-find: the cables are too short between the fixed points
(fails (form-find chain '((1 1))))                      ; expect: form-find: a member must join two points, got (1 1)
(fails (form-find chain '((1 62))))                     ; expect: form-find: members must be numbers of points from 1 to 61, got 62
(fails (form-find chain '(1 2)))                        ; expect: form-find: members must be a list of lists of two numbers of points, got (1 2)
(fails (form-find chain links #:fixed '(0)))            ; expect: form-find: fixed must be numbers of points from 1 to 61, got 0
(fails (form-find chain links #:lengths '(1 2)))        ; expect: form-find: lengths must be 60 numbers, one for each member, got 2
(fails (form-find chain links #:lengths -1))            ; expect: form-find: lengths must be a positive number or a list of them, got -1
(fails (form-find chain links #:lengths 1 #:slack 2))   ; expect: form-find: members have #:lengths, #:slack or #:densities, and only one of these
(fails (form-find chain links #:load 3))                ; expect: form-find: load must be a gvector or a list of them, got 3
(fails (form-find chain links #:tolerance 0))           ; expect: form-find: tolerance must be a positive number, got 0
(fails (form-find '() links))                           ; expect: form-find: points must hold 1 points or more, got 0
; plane faces: a net over a saddle whose corners stay
(define (saddle u v) (xyz (* 6 u) (* 4 v) (* 3 u v)))
(define faces (net-faces 6 4))
(define (bent points)
  (let ((at (list->vector points)))
    (apply max (map (lambda (f) (let* ((c (map (lambda (i) (vector-ref at (- i 1))) f)) (n (cross (p->q (first c) (third c)) (p->q (second c) (fourth c))))) (/ (abs (dot n (p->q (first c) (second c)))) (vlength n)))) faces))))
(define flat (planarise (net-points saddle 6 4) faces #:fixed '(1 5 31 35)))
(displayln (list (< (bent flat) 1e-5) (> (bent (net-points saddle 6 4)) 0.01))) ; expect: (#t #t)
(displayln (list-ref flat 34))                                            ; expect: (xyz 6 4 3)
(fails (planarise (net-points saddle 1 1) '((1 2 4 3)) #:fixed '(1 2 3 4))) ; expect: planarise: the faces cannot be made plane: after 60000 rounds a corner still lies 0.6837634587578276 from its face's plane
(fails (planarise chain '((1 2))))    ; expect: planarise: faces must be a list of lists of three numbers of points or more, got ((1 2))
; circles: none overlap, none leave the region, the first is the largest there is
(define yard (make-region (make-rectangle (xy 0 0) (xy 10 6)) (make-circle (xyz 5 3 0) 1)))
(define circles (pack-circles yard 40 #:gap 0.1))
(define (centre c) (first (object-arguments c)))
(define (radius c) (second (object-arguments c)))
(displayln (length circles)) ; expect: 40
(displayln (let loop ((l circles)) (or (null? l) (and (every (lambda (c) (>= (- (distance (centre c) (centre (car l))) (radius c) (radius (car l))) 0.0999)) (cdr l)) (loop (cdr l)))))) ; expect: #t
(displayln (every (lambda (c) (let ((p (centre c)) (r (+ (radius c) 0.0999))) (and (<= r (cx p) (- 10 r)) (<= r (cy p) (- 6 r)) (>= (distance p (xyz 5 3 0)) (+ 1 r -1e-3))))) circles)) ; expect: #t
(displayln (near? (radius (first (pack-circles (make-rectangle (xy 0 0) (xy 2 2)) 5))) 1 1e-3)) ; expect: #t
(displayln (pack-circles (make-rectangle (xy 0 0) (xy 2 2)) 5 #:least 3)) ; expect: ()
(fails (pack-circles origin 3))       ; expect: pack-circles: region must be a region or a closed curve, got (xyz 0 0 0)
; networks: a square's is 1 + the root of 3 long, a triangle's the root of 3
(define (whole network) (apply + (map (lambda (e) (distance (first e) (second e))) network)))
(define square-corners (list origin (xyz 1 0 0) (xyz 1 1 0) (xyz 0 1 0)))
(displayln (near? (whole (shortest-network square-corners)) (+ 1 (sqrt 3)) 1e-6)) ; expect: #t
(displayln (near? (whole (shortest-network (list origin (xyz 1 0 0) (xyz 1/2 (sqrt 3/4) 0)))) (sqrt 3) 1e-6)) ; expect: #t
(displayln (whole (shortest-network square-corners #:joints #f))) ; expect: 3.0
(displayln (shortest-path square-corners '((1 2) (2 3) (3 4)) 1 4)) ; expect: (1 2 3 4)
(fails (shortest-path square-corners '((1 2) (3 4)) 1 4)) ; expect: shortest-path: no members lead from point 1 to point 4
