; (visualscheme building): mansards, dormers, rafters and tiles, by closed forms
(import (visualscheme) (visualscheme building))
(define (deg d) (degrees->radians d))
(define plan (list (xyz 0 0 3) (xyz 12 0 3) (xyz 12 7 3) (xyz 0 7 3)))
(define (flat-area f) (apply + (map (lambda (a b) (/ (- (* (cx a) (cy b)) (* (cx b) (cy a))) 2)) (cdr f) (append (cddr f) (list (cadr f))))))
(define (covered faces) (apply + (map flat-area faces)))

; a mansard: a frustum below the break, a hipped roof above
(define (frustum a b inset h) (+ (* a b h) (* -1 (+ a b) inset h) (* 4/3 inset inset h)))
(define inset (/ 2 (tan (deg 70))))
(define (hipped a b k) (* k (- (* 1/4 a b b) (* 1/12 b b b))))
(define broken (roof plan #:pitch (deg 70) #:mansard (list 2 (deg 25))))
(displayln (near? (volume broken) (+ (frustum 12 7 inset 2) (hipped (- 12 (* 2 inset)) (- 7 (* 2 inset)) (tan (deg 25)))) 1e-6)) ; expect: #t
(define broken-faces (roof-faces plan #:pitch (deg 70) #:mansard (list 2 (deg 25))))
(displayln (list (length broken-faces) (sort (delete-duplicates (map car broken-faces)) <) (near? (covered broken-faces) 84))) ; expect: (8 (1 2 3 4) #t)
(displayln (near? (cz (last (bounding-box (roof plan #:pitch (deg 70) #:gables '(2 4) #:mansard (list 2 (deg 25)))))) (+ 5 (* (- 3.5 inset) (tan (deg 25)))))) ; expect: #t
(displayln (= (length (roof-faces plan #:mansard '(9 0.5))) (length (roof-faces plan)))) ; expect: #t
; outlines with holes, any pitches: faces cover the outline, and lie in planes of their pitch
(random-seed! 5)
(define (star c radius n) (map (lambda (i) (+pol c (* radius (+ 0.5 (random 0.5))) (* 2pi (/ (+ i (random 0.5)) n)))) (iota n)))
(define (judge)
  (let* ((n (+ 5 (random 12))) (outer (star origin 10 n)) (hole (reverse (star origin 1.5 5))) (loops (list outer hole))
         (made (roof-faces loops #:pitch (deg 60) #:mansard (list 1.2 (deg 20)))) (whole (+ (covered (list (cons 1 outer))) (covered (list (cons 1 hole))))))
    (list (near? (covered made) whole 1e-6)
          (every (lambda (f) (let ((low (apply min (map cz (cdr f)))))
                               (near? (/ (area (make-region (make-polygon (cdr f)))) (flat-area f)) (/ 1 (cos (deg (if (< low 1.19) 60 20)))) 1e-5))) made)
          (near? (volume (roof loops #:pitch (deg 60) #:mansard (list 1.2 (deg 20)))) (apply + (map (lambda (f) (volume-below f)) made)) 1e-5))))
(define (volume-below f)
  (let ((o (cadr f)))
    (apply + (map (lambda (a b) (* 1/6 (- (* (- (cx a) (cx o)) (- (cy b) (cy o))) (* (- (cx b) (cx o)) (- (cy a) (cy o)))) (+ (cz o) (cz a) (cz b)))) (cddr f) (append (cdddr f) (list o))))))
(displayln (delete-duplicates (append-map (lambda (i) (judge)) (iota 8)))) ; expect: (#t)

; dormers: a gable and a shed, on each edge and in both directions of the outline
(define plain (roof plan #:pitch (deg 45)))
(define (added outline edge d) (- (volume (roof outline #:pitch (deg 45) #:dormers d)) (volume plain)))
(define gable-part (/ (- (expt (+ 1.2 (tan (deg 40))) 3) (expt 1.2 3)) (* 3 (tan (deg 40)))))
(displayln (map (lambda (e at) (near? (added plan e (list (dormer e at 2 #:height 1.2 #:overhang 0 #:setback 0.3))) gable-part 1e-6)) '(1 2 3 4) '(4 3.5 4 3.5))) ; expect: (#t #t #t #t)
(displayln (map (lambda (e at) (near? (added (reverse plan) e (dormer e at 2 #:height 1.2 #:overhang 0 #:setback 0.3)) gable-part 1e-6)) '(1 2 3 4) '(4 3.5 4 3.5))) ; expect: (#t #t #t #t)
(displayln (near? (added plan 1 (dormer 1 5 3 #:height 1 #:kind 'shed #:pitch (deg 10) #:overhang 0)) (* 3 (/ 1 (* 2 (- 1 (tan (deg 10)))))) 1e-6)) ; expect: #t
(define open-roof (roof plan #:pitch (deg 45) #:overhang 0.3 #:thickness 0.2 #:dormers (list (dormer 1 3 2) (dormer 3 8 2.5 #:kind 'shed))))
(displayln (list (solid? open-roof) (contains? open-roof (xyz 3 2 3.5)) (< (volume open-roof) (+ 5 (volume (roof plan #:pitch (deg 45) #:overhang 0.3 #:thickness 0.2)))))) ; expect: (#t #f #t)

; rafters lie below the faces, tiles cover them
(define faces (roof-faces plan #:pitch (deg 45) #:overhang 0.4))
(define tiles (roof-tiles faces #:size '(0.4 0.3) #:thickness 0.05))
(displayln (near? (/ (apply + (map volume tiles)) 0.05) (* (sqrt 2) 12.8 7.8) 1e-6)) ; expect: #t
(displayln (near? (volume (unite tiles)) (apply + (map volume tiles)) 0.05)) ; expect: #t
(define rafters (roof-rafters faces #:spacing 0.8 #:size '(0.08 0.16)))
(displayln (list (every solid? rafters) (object-material (first rafters)) (near? (volume (intersect (unite rafters) (unite tiles))) 0 1e-6))) ; expect: (#t wood #t)
(displayln (map length (list (roof-rafters (roof-faces plan #:gables '(2 4)) #:spacing 1) (roof-tiles (roof-faces plan #:gables '(2 4)) #:size '(1 1))))) ; expect: (26 124)

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (roof plan #:mansard 2))                            ; expect: roof: mansard must be a list of the height of the break and the pitch above it, in radians between 0 and pi/2, got 2
(fails (roof plan #:mansard (list 2 60)))                  ; expect: roof: mansard must be a list of the height of the break and the pitch above it, in radians between 0 and pi/2, got (2 60)
(fails (roof plan #:dormers 3))                            ; expect: roof: dormers must be a list of dormers, as dormer returns them, got 3
(fails (roof plan #:dormers (dormer 5 3 2)))               ; expect: dormer: edge must be a number from 1 to 4, got 5
(fails (roof plan #:dormers (dormer 1 0.5 2)))             ; expect: dormer: the dormer goes from -0.5 to 1.5 along an edge of 12.0
(fails (roof plan #:dormers (dormer 1 3 2 #:height 4)))    ; expect: dormer: the dormer rises to 8.1892, the roof only to 5.4507: make it lower or narrower, or its setback less
(fails (roof plan #:gables '(1) #:dormers (dormer 1 3 2))) ; expect: dormer: edge 1 is a gable: a dormer needs a plane of the roof
(fails (dormer 1 3 -2))                                    ; expect: dormer: width must be a positive number, got -2
(fails (dormer 1 3 2 #:kind 'round))                       ; expect: dormer: kind must be 'gable or 'shed, got round
(fails (dormer 1 3 2 #:pitch 40))                          ; expect: dormer: pitch must be radians between 0 and pi/2, got 40
(fails (roof-rafters 3))                                   ; expect: roof-rafters: faces must be the faces of a roof, as roof-faces returns them, got 3
(fails (roof-tiles faces #:size 0))                        ; expect: roof-tiles: size must be a positive number or a list of two, got 0
(fails (roof-tiles faces #:size 1e-4))                     ; expect: roof-tiles: a face needs more than 200000 tiles of 0.0001 by 0.0001
