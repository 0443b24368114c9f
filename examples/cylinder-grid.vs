; A grid of cylinders: many objects out of one.
;
; What it teaches: objects are values. One cylinder is made once; a row is that cylinder moved again and again; the grid is that row moved
; again and again. Nothing is copied, so a million cylinders cost little more than one, and the passes of the program (-O, -O0, --stats)
; show how few commands the result needs. It is the stress test of the VisualScheme thesis.
;
;   vs cylinder-grid.vs -D count=100 -o grid.png

(define-parameter count 51 #:min 1 #:max 1000 #:label "cylinders along a side")

; Unites n placements of an object, each one step further than the one before.
(define (repeat object n step)
  (unite (map (lambda (i) (do-move object (* i step)))
              (iota n))))

(define cylinder (make-cylinder (xyz 0 0 0) 2.2 0.32))
(define row (repeat cylinder count (vxyz 1 0 0)))
(define grid (repeat row count (vxyz 0 1 0)))

(draw (with-material plaster grid))

; Somebody to show the size: a cylinder is a little higher than a person.
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
(define in-slate (list (xyz -2.3 9.2 0) (xyz 11.3 -1.8 0)))
(define people (append in-slate (list (xyz -1.6 3.4 0) (xyz 4.5 -1.6 0) (xyz 10.5 -1.4 0))))
(draw (color "#3b3f4a" (map legs people)) (color "#c99d7c" (map head people)) (color "#2a2320" (map hair people))
      (color "#5a6470" (map coat in-slate)) (color "#7d4a3e" (coat (xyz -1.6 3.4 0))) (color "#b3a484" (coat (xyz 4.5 -1.6 0))) (color "#476b7c" (coat (xyz 10.5 -1.4 0))))

(ground 0 #:material 'paving)
(sun #:azimuth 285 #:altitude 30)
(camera (xyz -8 -7.5 4.2) (xyz 8 6.5 0.4) #:lens 26 #:upright #t)
