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

(ground 0 #:material stone)
(sun #:azimuth 285 #:altitude 22)
(camera (xyz (* count -0.06) (* count -0.16) (* count 0.25)) (xyz (* count 0.42) (* count 0.4) 0) #:lens 32)
