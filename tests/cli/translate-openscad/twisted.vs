; A tower of slabs that turn as they rise.
(define-parameter floors 6 #:min 3 #:max 120 #:label "number of floors")
(define storey 36)
(define turn (degrees->radians 60)) ; from foot to top

(define (soft-square radius)
  (define (power v) (* (if (< v 0) -1 1) (sqrt (abs v))))
  (make-region
   (make-polygon (map (lambda (a) (xy (* radius (power (cos a))) (* radius (power (sin a)))))
                      (enumerate 0 2*pi 24)))))

(define (slab i)
  (do-move (do-rotate (do-extrude (soft-square 100) 30) 'z (* turn (/ i floors)))
           (vxyz 0 0 (* i storey))))

(draw (unite (map slab (iota (+ floors 1)))
             (make-cylinder (xyz 0 0 0) (* floors storey) 20)))
