; Parts and pieces of solids, Minkowski sums, holes, threads, relief: closed forms and random solids.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (about? a b) (near? a b (* 1e-9 (abs b))))
(define (sum l) (apply + l))
(define unit (make-box origin (xyz 1 1 1)))
(define (cube c) (do-move unit (apply vxyz c)))

; ---- random sets of unit cubes: parts by a flood over faces, edges and corners; sums by counting ----
(random-seed! 58)
(define (cells n size) (delete-duplicates (map (lambda (i) (list (random size) (random size) (random size))) (iota n))))
(define (near-cells? a b) (every (lambda (x y) (<= (abs (- x y)) 1)) a b))
(define (flood open found)
  (if (null? open)
      found
      (let-values (((near far) (partition (lambda (c) (near-cells? c (car open))) (cdr found))))
        (flood (cdr open) found))))
(define (part-of start cells) ; the cells connected with start
  (let loop ((open (list start)) (in (list start)) (rest (remove (lambda (c) (equal? c start)) cells)))
    (if (null? open)
        in
        (let-values (((near far) (partition (lambda (c) (near-cells? c (car open))) rest)))
          (loop (append near (cdr open)) (append near in) far)))))
(define (parts-of cells)
  (if (null? cells)
      '()
      (let ((in (part-of (car cells) cells)))
        (cons (length in) (parts-of (remove (lambda (c) (member c in)) cells))))))
(define (solid-of cells) (unite (map cube cells)))
(define (sorted l) (sort l <))
(define (good-parts? i)
  (let* ((c (cells 14 6)) (found (map volume (decompose (solid-of c)))))
    (equal? (sorted (map (lambda (v) (round v)) found)) (sorted (map exact->inexact (parts-of c))))))
(displayln (every good-parts? (iota 25))) ; expect: #t

(define (sum-cells a b) ; the cells that the sum of two sets of cells covers
  (delete-duplicates
    (append-map (lambda (p) (append-map (lambda (q) (map (lambda (d) (map + p q d)) '((0 0 0) (1 0 0) (0 1 0) (1 1 0) (0 0 1) (1 0 1) (0 1 1) (1 1 1)))) b)) a)))
(define (good-sum? i)
  (let ((a (cells 4 3)) (b (cells (+ 1 (modulo i 3)) 2)))
    (about? (volume (minkowski (solid-of a) (solid-of b))) (length (sum-cells a b)))))
(displayln (every good-sum? (iota 12))) ; expect: #t

; ---- parts keep their kinds ----
(displayln (decompose (unite unit (cube '(1 0 0)) (cube '(3 0 0)))))
; expect: ((unite (make-box (xyz 0 0 0) (xyz 1 1 1)) (do-move (make-box (xyz 0 0 0) (xyz 1 1 1)) (vxyz 1 0 0))) (do-move (make-box (xyz 0 0 0) (xyz 1 1 1)) (vxyz 3 0 0)))
(define nut (subtract (make-sphere origin 3) (make-sphere origin 2)))
(displayln (length (decompose nut)))                                                             ; expect: 1
(displayln (map object-kind (decompose (unite nut (make-sphere origin 1)))))                     ; expect: (subtract sphere)
(displayln (length (decompose (subtract (make-sphere origin 3) (subtract (make-sphere origin 2) (make-sphere origin 1)))))) ; expect: 2
(displayln (map object-layer (decompose (layer "a" (unite unit (cube '(5 0 0)))))))              ; expect: (a a)
(displayln (decompose (empty-object)))                                                           ; expect: ()
(fails (decompose 5))                                  ; expect: decompose: o must be a solid, got 5

; ---- pieces: their volumes make the whole ----
(define (random-hull) (hull (map (lambda (i) (xyz (random 4.0) (random 3.0) (random 2.0))) (iota 9))))
(define (random-tool i)
  (case (modulo i 3)
    ((0) (make-plane (xyz 2 1.5 1) (vxyz (- (random 2.0) 1) (- (random 2.0) 1) 0.7)))
    ((1) (random-hull))
    (else (let ((a (random 6.0))) (make-surface (lambda (u v) (xyz (- (* 8 u) 2) (- (* 8 v) 2) (+ 1 (* 0.3 (sin (+ a (* 8 u))))))) #:nu 12 #:nv 4)))))
(displayln (every (lambda (i) (let ((o (random-hull))) (near? (sum (map volume (split o (random-tool i)))) (volume o) 1e-7))) (iota 24)))  ; expect: #t
(displayln (map volume (split (make-box origin (xyz 4 1 1)) (make-plane (xyz 1 0 0) ux))))       ; expect: (3.0 1.0)
(displayln (map volume (split (make-box origin (xyz 4 1 1)) (make-box (xyz 1 -1 -1) (xyz 2 2 2))))) ; expect: (1.0 1.0 2.0)
(displayln (split unit (make-plane (xyz 5 0 0) ux)))                                             ; expect: ((make-box (xyz 0 0 0) (xyz 1 1 1)))
(displayln (map volume (split unit 'xy)))                                                        ; expect: (1.0)
(fails (split unit (make-region (make-circle (xyz 0.5 0.5 0.5) 0.2))))
; expect: split: the tool must cross o: its border lies in o at (xyz 0.7 0.5 0.5)
(fails (split unit (make-circle origin 1)))            ; expect: split: tool must be a plane, a surface or a solid, got (make-circle (xyz 0 0 0) 1)
(fails (split (make-box (xyz -3 -3 -3) (xyz 3 3 3)) (make-surface (lambda (u v) (xyz (* 4 (cos u)) (* 4 (sin u)) v)) 0 4 -4 4)))
; expect: split: the tool folds back: no direction crosses all of it from one side; give a flatter surface, or a solid

; ---- sums ----
(define (rounded a b c r) (+ (* a b c) (* 2 r (+ (* a b) (* b c) (* c a))) (* pi r r (+ a b c)) (* 4/3 pi r r r)))
(displayln (near? (volume (minkowski (make-box origin (xyz 3 2 1)) (make-sphere origin 0.5))) (rounded 3 2 1 0.5) 2e-3))        ; expect: #t
(displayln (object-kind (minkowski unit (make-sphere origin 1))))                                ; expect: hull
(displayln (every (lambda (i) (let ((h (random-hull))) (near? (volume (minkowski h h)) (* 8 (volume h)) 1e-6))) (iota 12)))        ; expect: #t
(displayln (every (lambda (i) (let ((h (random-hull))) (near? (volume (minkowski h (do-scale h 1/2))) (* 27/8 (volume h)) 1e-6))) (iota 12))) ; expect: #t
(define L (do-extrude (make-polygon (xy 0 0) (xy 3 0) (xy 3 1) (xy 1 1) (xy 1 2) (xy 0 2)) 1))
(displayln (map (lambda (a b) (volume (minkowski a b))) (list L unit L) (list unit L L)))        ; expect: (20.0 20.0 36.0)
(displayln (volume (minkowski (subtract (make-box origin (xyz 5 5 5)) (make-box (xyz 2 2 2) (xyz 3 3 3))) (make-box origin (xyz 0.5 0.5 0.5))))) ; expect: 166.25
(displayln (volume (minkowski (subtract (make-box origin (xyz 5 5 1)) (make-box (xyz 1 1 -1) (xyz 4 4 2))) unit))) ; expect: 64.0
(fails (minkowski (make-torus origin 4 1 #:segments 64) (make-sphere origin 1/2 #:segments 64)))
; expect: minkowski: the sum would be made of 32538624 points; make the solids coarser with #:segments or current-segments
(fails (minkowski unit 5))                             ; expect: minkowski: b must be a solid, got 5
(fails (minkowski unit (make-circle origin 1)))        ; expect: minkowski: b must be a solid, got (make-circle (xyz 0 0 0) 1)

; ---- holes ----
(define down (vxyz 0 0 -2))
(displayln (about? (volume (make-hole (xyz 1 2 3) down 2 5)) (* 5 pi)))                          ; expect: #t
(displayln (make-hole origin down 2 5))                                                          ; expect: (make-cylinder (xyz 0 0 0) (xyz 0 0 -5) 1)
(displayln (near? (volume (make-hole origin down 1 3 #:counterbore '(2 1))) (* pi (+ 1 1/2)) 2e-3))                            ; expect: #t
(displayln (near? (volume (make-hole origin ux 1 3 #:countersink (list 2 pi/2))) (* pi (+ (/ (+ 1 1/2 1/4) 6) (* 2.5 1/4))) 2e-3)) ; expect: #t
(fails (make-hole origin down 2 5 #:counterbore '(1 1)))     ; expect: make-hole: counterbore's diameter must exceed d, 2, got 1
(fails (make-hole origin down 2 5 #:counterbore '(3 6)))     ; expect: make-hole: counterbore is 6 deep, and the hole 5
(fails (make-hole origin down 2 5 #:countersink 3))          ; expect: make-hole: countersink must be (list diameter angle) of positive numbers, got 3
(fails (make-hole origin down 0 5))                          ; expect: make-hole: d must be a positive number, got 0

; ---- threads: the section of the basic profile, turned ----
(define (thread-volume d pitch length)
  (let* ((r (/ d 2)) (s (- r (* 5/8 (sqrt 3) 1/2 pitch))))
    (* length pi (+ (* 1/4 s s) (* 1/8 r r) (* 5/8 1/3 (+ (* s s) (* s r) (* r r)))))))
(define (facets n) (/ (sin (/ (* 2 pi) n)) (/ (* 2 pi) n)))
(define (good-thread? d pitch length n)
  (near? (volume (thread d pitch length #:segments n)) (* (facets n) (thread-volume d pitch length)) (* 1e-3 d d length)))
(displayln (map good-thread? '(10 3 8 6) '(1.5 0.5 1.25 1) '(20 1 3.1 0.5) '(64 32 48 24)))      ; expect: (#t #t #t #t)
(displayln (bounding-box (thread 10 1.5 20)))                                                    ; expect: ((xyz -5 -5 0) (xyz 5 5 20))
(fails (thread 1 2 5))                     ; expect: thread: d must exceed 2.1650635094610964, the threads' depth on both sides, got 1
(fails (thread 10 1.5 20 #:standard 'inch)) ; expect: thread: standard must be 'metric, got inch

; ---- relief ----
(define plate (make-box origin (xyz 4 4 1)))
(define disc (make-region (make-polygon (xyz 1 1 1) (xyz 3 1 1) (xyz 3 3 1) (xyz 1 3 1))))
(displayln (map (lambda (d) (volume (emboss plate disc d))) '(1/2 -1/2 0 1 -1)))                 ; expect: (18.0 14.0 16.0 20.0 12.0)
(displayln (volume (emboss plate (do-move disc (vxyz 0 0 -1)) 1)))                               ; expect: 20.0
(displayln (volume (emboss plate (do-move disc (vxyz 0 0 3)) 1)))                                ; expect: 20.0
(displayln (near? (volume (emboss (make-sphere (xyz 2 2 -3) 4) disc 0.25)) (+ (* 4/3 pi 64) 1) 0.4)) ; expect: #t
(fails (emboss plate (make-circle origin 1) 1)) ; expect: emboss: region must be a region, got (make-circle (xyz 0 0 0) 1)
