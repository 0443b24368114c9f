; A brick wall on a curve, in Flemish bond, and the number of its bricks; and one whose courses follow a leaning surface.

(define-parameter height 1.5 #:min 0.5 #:max 3 #:label "height, m")
(define-parameter bond 'flemish #:choices '(running third stack flemish) #:label "bond")

(define path (make-spline (xy 0 0) (xy 1.5 0.4) (xy 3 0) (xy 4.5 -0.4) (xy 6 0)))
(define wall (brick-wall path #:height height #:bond bond))

; each course lies on a level line of the surface
(define surface
  (make-surface (lambda (u v) (xyz (* 6 u) (- -3 (* 0.5 v (sin (* 2 pi u)))) (* height v))) #:nu 60 #:nv 4))
(define courses (map first (contours surface #:from 0.001 #:step 0.083 #:to (- height 0.083))))
(define leaning (brick-wall courses #:bond 'running))

(define (bricks l) (length l))
(printf "~a bricks, ~a bricks~%" (bricks wall) (bricks leaning))
(draw (color "#b0583e" wall) (color "#c08a5a" leaning))
(ground 0)
(camera (xyz 4 -11 3.2) (xyz 3 -1.5 0.6) #:lens 35)
