; A vase turned about its axis, hollow and open at the top.
(define-parameter height 0.6 #:min 0.05 #:max 5 #:label "height, m")
(define-parameter width 0.32 #:min 0.02 #:max 4 #:label "width at the belly, m")
(define-parameter neck 0.35 #:min 0.1 #:max 0.9 #:label "neck, as a share of the width")
(define-parameter wall 0.06 #:min 0.02 #:max 0.2 #:label "wall, as a share of half the width")
(define-parameter colour "#b5522f" #:label "colour")

(define half (/ width 2))
(define (at share z) (xz (* half share) (* height z)))
; The outline from the foot to the lip, as shares of half the width and of the height.
(define outline
  (list '(0.48 . 0) '(0.56 . 0.06) (cons 0.9 0.28) '(1 . 0.45) (cons 0.82 0.66) (cons (+ neck 0.06) 0.82) (cons neck 0.9) (cons (+ neck 0.16) 1)))
(define (points less)
  (map (lambda (o) (at (- (car o) less) (max (cdr o) (if (> less 0) 0.035 0)))) outline))
(define outer (points 0))
(define inner (points wall))
(define profile
  (make-region (make-spline outer) (make-line (last outer) (last inner)) (make-spline inner)
    (make-line (first inner) (at 0 0.035) origin (first outer))))
(draw (color colour (do-revolve profile 'z)))
