; A lily: six petals that bend outwards, six stamens, a stem with leaves, all grown by turtles whose cross-sections make hexahedra. After
; figure 25 of Krecklau, Pavic and Kobbelt (2010); the rules are our own.
;
; What it teaches: a shape as a path with a changing cross-section. A petal is twelve pieces of one block; width and bend are functions of
; where along the petal a piece lies.
;
;   vs lily.vs -o lily.png

(define (tube c) (color c (make-cylinder (xyz 0 0 0) (xyz 0 1 0) 0.5 #:segments 10)))
(define white-tissue (color "#f6efe2" (make-box (xyz 0 0 0) (xyz 1 1 1))))
(define pink-tissue (color "#e59ab0" (make-box (xyz 0 0 0) (xyz 1 1 1))))
(define green (tube "#5d8a3a"))
(define leaf-green (color "#4f8038" (make-box (xyz 0 0 0) (xyz 1 1 1))))
(define filament (tube "#cfe0a8"))
(define anther (color "#a8501f" (make-sphere origin 1 #:segments 12)))

; A blade of n pieces: its width and the pitch of each piece are procedures of where it lies, from 0 to 1.
(define-rule (blade [self turtle-scope?] [length positive?] [width procedure?] [bend procedure?] [tissue object?] [n integer? 12])
  (define-rule (piece [self turtle-scope?] [i integer?])
    [#:when (< i n)
     (=> (turtle-back) (turtle-pitch (bend (/ i n))) (turtle-forward (/ length n))
         (turtle-width (width (/ (+ i 1) n))) (turtle-front tissue) (piece (+ i 1)))]
    [(=>)])
  [(=> (turtle-width (width 0)) (turtle-height 0.05) (piece 0))])

(define-rule (flower [self turtle-scope?])
  (define-rule (six [self turtle-scope?] [rule procedure?] [i integer? 0])
    [#:when (< i 6) (=> (rule i) (turtle-roll pi/3) (six rule (+ i 1)))]
    [(=>)])
  ; the petals of the inner ring are wider and lie higher
  (define-rule (petal [self turtle-scope?] [i integer?])
    (define inner? (odd? i))
    [(=> (turtle-pitch -0.24)
         (blade 4.4 (lambda (t) (+ 0.16 (* (if inner? 1.5 1.15) (sin (* pi (expt t 0.8)))))) (lambda (t) (- 0.01 (* 0.36 t t)))
           (if inner? white-tissue pink-tissue)))])
  (define-rule (stamen [self turtle-scope?] [i integer?])
    [(=> (turtle-pitch -0.12) (turtle-width 0.07) (turtle-height 0.07) (thread 0))])
  (define-rule (thread [self turtle-scope?] [i integer?])
    [#:when (< i 6) (=> (turtle-back) (turtle-pitch -0.05) (turtle-forward 0.5) (turtle-front filament) (thread (+ i 1)))]
    [(=> (turtle-pitch 1.2) (turtle-width 0.16) (turtle-height 0.14) (turtle-forward -0.25) (turtle-back) (turtle-forward 0.5) (turtle-front anther))])
  [(=> (six petal) (turtle-roll pi/6) (six stamen))])

(define-rule (lily [self turtle-scope?] [pieces integer?] [lean number?])
  (define-rule (stem [self turtle-scope?] [i integer?])
    [#:when (< i pieces)
     (=> (turtle-width 0.22) (turtle-height 0.22) (turtle-back) (turtle-pitch (* lean (/ i pieces))) (turtle-forward 0.7)
         (turtle-front green) (leaves i) (stem (+ i 1)))]
    [(=> (flower))])
  (define-rule (leaves [self turtle-scope?] [i integer?])
    [#:when (and (> i 1) (< i (- pieces 2)))
     (=> (turtle-roll (* 2.4 i)) (turtle-pitch -0.7)
         (blade 2.6 (lambda (t) (+ 0.06 (* 0.42 (sin (* pi t))))) (lambda (t) (* -0.1 t)) leaf-green 8))]
    [(=>)])
  [(=> (stem 0))])

(define (from x y azimuth) (make-turtle-scope (xyz x y 0) uz (vpol 1 azimuth) 0.3 0.3))
(draw (lily (from 0 0 1.75) 12 -0.22) (lily (from 1.6 0.6 2.5) 10 -0.2) (lily (from -1.4 0.8 0.4) 8 -0.18))
(ground 0 #:material (make-material #:name "soil" #:color "#6d5f4b" #:roughness 1))
(sun #:azimuth 150 #:altitude 38)
(camera (xyz -2.5 -19 4.8) (xyz 0.2 0 6.6) #:lens 38)
