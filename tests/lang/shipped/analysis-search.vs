; (visualscheme analysis): optimise finds known least values by each method; equal runs give equal results; each message
(import (visualscheme) (visualscheme analysis))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(define (close? xs ys tolerance) (every (lambda (x y) (near? x y tolerance)) xs ys))
(define (valley x y) (+ (square (- 1 x)) (* 100 (square (- y (square x))))))
(define disc (lambda (x y) (- (+ (* x x) (* y y)) 1)))

; Rosenbrock's valley: its least value is at (1, 1); within the unit disc at (0.786415, 0.617698)
(say (close? (optimise valley '(-1.2 1)) '(1 1) 1e-6)
     (close? (optimise valley '(-1.2 1) #:method 'gradient) '(1 1) 1e-6)
     (close? (optimise valley '(-1.2 1) #:method 'simplex) '(1 1) 1e-6)
     (close? (optimise valley '(-1.2 1) #:method 'crs #:from -5 #:to 5) '(1 1) 1e-4)
     (close? (optimise valley '(-1.2 1) #:method 'isres #:from '(-5 -5) #:to '(5 5)) '(1 1) 1e-2)
     (close? (optimise valley '(0 0) #:subject-to disc) '(0.786415 0.617698) 1e-5)
     (close? (optimise valley '(0 0) #:subject-to (list disc) #:method 'simplex) '(0.786415 0.617698) 1e-4)
     (close? (optimise valley '(0 0) #:subject-to disc #:method 'isres #:from -2 #:to 2) '(0.786415 0.617698) 1e-2))
; expect: (#t #t #t #t #t #t #t #t)
; bounds hold; one number; a procedure that has no derivatives; many valleys
(say (optimise (lambda (x) (square (- x 3))) 0 #:to 2)
     (near? (optimise (lambda (x) (square (- x 3))) 0) 3 1e-6)
     (near? (optimise (lambda (x) (if (< x 1) 5 (abs (- x 2)))) 4 #:method 'simplex) 2 1e-6)
     (let ((waves (lambda (x y) (+ 20 (square x) (square y) (* -10 (+ (cos (* 2 pi x)) (cos (* 2 pi y))))))))
       (close? (optimise waves '(3.2 -4.1) #:method 'crs #:from -5.12 #:to 5.12) '(0 0) 1e-4)))
; expect: (2.0 #t #t #t)
; equal runs, equal results; a search within a search
(say (map (lambda (m) (equal? (optimise valley '(0 0) #:method m #:from -2 #:to 2) (optimise valley '(0 0) #:method m #:from -2 #:to 2))) '(gradient simplex crs isres))
     (near? (optimise (lambda (x) (square (- x (optimise (lambda (y) (square (- y 2))) 0)))) 0 #:method 'simplex) 2 1e-5))
; expect: ((#t #t #t #t) #t)
; a column of the least weight that a load allows, by its diameter
(define (weight d) (section-area (tube-section d (/ d 20))))
(define (spare d)
  (- (utilisation (frame-solve (frame (list origin (xyz 0 0 4)) '((1 2)) #:supports '((1 pinned rz) (2 x y)) #:sections (tube-section d (/ d 20)) #:loads (list (list 2 (vxyz 0 0 -2e5))))) 1) 1))
(define d (optimise weight 0.3 #:from 0.05 #:to 1 #:method 'simplex #:subject-to spare))
(say (near? (spare d) 0 1e-4)) ; expect: (#t)
; an error in f ends the search; a continuation leaves it
(fails (optimise (lambda (x) (if (> x 0.5) (error "too far") (square (- x 1)))) 0)) ; expect: too far
(say (call/cc (lambda (k) (optimise (lambda (x) (k 'left)) 0 #:method 'simplex)))) ; expect: (left)
(for-each (lambda (i) (call/cc (lambda (k) (optimise (lambda (x) (k x)) 0 #:method 'simplex)))) (iota 200))

(fails (optimise valley '()))                     ; expect: optimise: starts must be one number or more, got ()
(fails (optimise valley '(0 a)))                  ; expect: optimise: starts must be numbers, got (0 a)
(fails (optimise 3 '(0)))                         ; expect: optimise: f must be a procedure, got 3
(fails (optimise valley '(0 0) #:method 'newton)) ; expect: optimise: method must be one of (gradient simplex crs isres), got newton
(fails (optimise valley '(0 0) #:method 'crs))    ; expect: optimise: 'crs needs bounds: give #:from and #:to
(fails (optimise valley '(0 0) #:method 'crs #:from -1 #:to 1 #:subject-to disc)) ; expect: optimise: 'crs takes no #:subject-to; 'isres does
(fails (optimise valley '(0 0) #:from 1))         ; expect: optimise: the start 0.0 is below 1.0
(fails (optimise valley '(0 0) #:from '(1 2 3)))  ; expect: optimise: from must be a number, or a list of 2 numbers, got (1 2 3)
(fails (optimise (lambda (x) 'no) '(0)))          ; expect: optimise: f must give a number, got no at (0.0)
(fails (optimise valley '(0 0) #:steps 0))        ; expect: optimise: steps must be an exact integer of 1 or more, got 0
(fails (optimise valley '(0 0) #:tolerance 0))    ; expect: optimise: tolerance must be positive, got 0
(optimise valley '(-1.2 1) #:method 'simplex #:steps 20) ; expect warning: optimise: 20 evaluations did not suffice; #:steps allows more
; expect no other warnings
