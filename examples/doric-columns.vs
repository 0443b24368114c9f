; Six Doric columns, one procedure.
;
; What it teaches: a procedure is a family of shapes. A column is three solids one above the other; everything that can differ between two
; columns is an argument, and each call below is one member of the family. Points are moved with +z and +xyz instead of being
; computed coordinate by coordinate.

; The shaft grows narrower upwards, from the radius at its foot to the radius of the neck.
(define (shaft foot height foot-r neck-r)
  (make-cut-cone foot foot-r (+z foot height) neck-r))

; The capital widens again until it carries the slab above it.
(define (capital neck height neck-r slab-side)
  (make-cut-cone neck neck-r (+z neck height) (/ slab-side 2)))

; The abacus is a square slab centred over the column.
(define (abacus bottom height side)
  (let ([half (/ side 2)])
    (make-box (+xyz bottom (- half) (- half) 0)
              (+xyz bottom half half height))))

(define (doric-column foot
                      shaft-height foot-radius
                      capital-height neck-radius
                      abacus-height abacus-side)
  (let* ([neck (+z foot shaft-height)]
         [top (+z neck capital-height)])
    (unite (shaft foot shaft-height foot-radius neck-radius)
           (capital neck capital-height neck-radius abacus-side)
           (abacus top abacus-height abacus-side))))

(define columns
  (unite (doric-column (xy 0 0) 9 0.5 0.4 0.3 0.3 1.0)
         (doric-column (xy 3 0) 7 0.5 0.4 0.6 0.6 1.6)
         (doric-column (xy 6 0) 9 0.7 0.5 0.3 0.2 1.2)
         (doric-column (xy 9 0) 8 0.4 0.3 0.2 0.3 1.0)
         (doric-column (xy 12 0) 5 0.5 0.4 0.3 0.1 1.0)
         (doric-column (xy 15 0) 6 0.8 0.3 0.2 0.4 1.4)))

; Three steps to stand on.
(define (step n)
  (make-box (xyz (- -1.5 (* n 0.5)) (- -1.5 (* n 0.5)) (* n -0.35))
            (xyz (+ 16.5 (* n 0.5)) (+ 1.5 (* n 0.5)) (* (+ n -1) -0.35))))

; Another family: visitors, who show how high the columns are. What they wear is made apart, for each colour its own.
(define (at p aside ahead high) (+xyz p aside ahead high))
(define (legs p)
  (list (make-cut-cone (at p -0.08 0.1 0) 0.05 (at p -0.075 0 0.82) 0.085) (make-cut-cone (at p 0.08 -0.1 0) 0.05 (at p 0.075 0 0.82) 0.085)))
(define (coat p)
  (list (make-cut-cone (at p 0 0 0.72) 0.17 (at p 0 0 1.04) 0.145) (make-cut-cone (at p 0 0 1.04) 0.145 (at p 0 0 1.36) 0.19) (make-cut-cone (at p 0 0 1.36) 0.19 (at p 0 0 1.48) 0.07)
        (make-cut-cone (at p -0.24 0.05 0.84) 0.035 (at p -0.18 0 1.38) 0.06) (make-cut-cone (at p 0.24 -0.05 0.84) 0.035 (at p 0.18 0 1.38) 0.06)))
(define (head p)
  (list (make-cut-cone (at p 0 0 1.42) 0.06 (at p 0 0 1.56) 0.055) (make-sphere (at p 0 0.01 1.63) 0.092)))
(define (hair p)
  (make-sphere (at p 0 0.025 1.66) 0.093))

(draw (with-material plaster columns))
(define people (list (xyz 1.5 -1 0) (xyz 10.4 -0.6 0) (xyz 11.2 -0.9 0) (xyz 5.4 -6 -1.05)))
(draw (color "#3b3f4a" (map legs people)) (color "#c99d7c" (map head people)) (color "#2a2320" (map hair people))
      (color "#5a6470" (coat (xyz 1.5 -1 0))) (color "#7d4a3e" (coat (xyz 10.4 -0.6 0))) (color "#b3a484" (coat (xyz 11.2 -0.9 0))) (color "#476b7c" (coat (xyz 5.4 -6 -1.05))))
(draw (with-material stone (unite (map step '(1 2 3)))))

(ground -1.05 #:material grass)
(sun #:azimuth 238 #:altitude 32)
(camera (xyz 2.4 -20.5 2.4) (xyz 7.3 0 4.0) #:lens 29)
