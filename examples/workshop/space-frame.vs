; A roof of two layers of bars over a curved surface, on four columns.

(define-parameter bays 8 #:min 2 #:max 20 #:label "cells in each direction")
(define-parameter depth 1.2 #:min 0.5 #:max 3 #:label "distance of the layers, m")

(define (roof u v)
  (xyz (* 24 u) (* 24 v) (+ 6 (* 2 (sin (* pi u)) (sin (* pi v))))))
(define net (space-frame roof bays bays depth))
(define frame (frame-members net 0.06 #:node-radius 0.14))
(printf "~a nodes, ~a bars~%" (length (first net)) (length (second net)))

; a column below a node of the lower layer
(define (column i j)
  (define top (list-ref (first net) (+ (square (+ bays 1)) (* i bays) j)))
  (make-cylinder (xyz (cx top) (cy top) 0) top 0.2))
(define near (quotient bays 4))
(define far (- bays 1 near))

(draw (with-material steel frame)
      (with-material concrete (for*/list ([i (list near far)] [j (list near far)]) (column i j))))
(ground 0)
(camera (xyz 38 -22 12) (xyz 12 12 4) #:lens 35)
