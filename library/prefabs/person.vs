; A standing person who looks along -Y, simple enough to give a picture its scale.
(define-parameter height 1.72 #:min 0.5 #:max 2.3 #:label "height, m")
(define-parameter stride 0.12 #:min 0 #:max 0.4 #:label "stride, as a share of the height")
(define-parameter turn 0.0 #:min -180 #:max 180 #:label "turned by, degrees")
(define-parameter coat "#5a6470" #:label "colour of the coat")
(define-parameter trousers "#3b3f4a" #:label "colour of the trousers")
(define-parameter skin "#c99d7c" #:label "colour of the skin")

; Lengths below are shares of the height.
(define (limb p q r1 r2) (unite (make-sphere p r1) (make-cut-cone p r1 q r2) (make-sphere q r2)))
(define half (/ stride 2))
(define (leg side ahead)
  (let ((hip (xyz (* side 0.046) 0 0.52)) (knee (xyz (* side 0.05) (- (* 0.55 ahead) 0.012) 0.28)) (ankle (xyz (* side 0.052) (+ (* 1 ahead) 0.01) 0.045)))
    (list (limb hip knee 0.05 0.037) (limb knee ankle 0.037 0.024))))
(define (shoe side ahead)
  (hull (make-sphere (xyz (* side 0.052) (+ ahead 0.022) 0.021) 0.021) (make-sphere (xyz (* side 0.056) (- ahead 0.075) 0.016) 0.016)))
(define (arm side ahead)
  (let ((shoulder (xyz (* side 0.098) 0.002 0.792)) (elbow (xyz (* side 0.124) (+ 0.012 (* 0.4 ahead)) 0.625)) (wrist (xyz (* side 0.128) (- (* 0.9 ahead) 0.02) 0.48)))
    (list (limb shoulder elbow 0.032 0.026) (limb elbow wrist 0.026 0.019) wrist)))
(define left (arm -1 half))
(define right (arm 1 (- half)))
(define (hand a) (do-move (do-scale (make-sphere origin 1) origin '(0.014 0.02 0.033)) (p->q origin (+z (third a) -0.03))))
(define (oval z rx ry) (make-ellipse (xyz 0 0 z) rx ry))
(define trunk
  (unite (do-loft (list (oval 0.43 0.112 0.085) (oval 0.52 0.104 0.075) (oval 0.62 0.083 0.06) (oval 0.72 0.098 0.066) (oval 0.785 0.112 0.058) (oval 0.818 0.085 0.045) (oval 0.845 0.035 0.033)))))
(define head
  (unite (do-move (do-scale (make-sphere origin 1) origin '(0.042 0.052 0.064)) (vxyz 0 -0.008 0.936))
         (make-cylinder (xyz 0 0.004 0.83) (xyz 0 -0.002 0.9) 0.028)))
(define hair
  (subtract (do-move (do-scale (make-sphere origin 1) origin '(0.046 0.057 0.067)) (vxyz 0 -0.003 0.939))
            (do-rotate (make-box (xyz -0.2 -0.2 0.7) (xyz 0.2 -0.028 0.962)) (xyz 0 -0.028 0.962) ux -0.35)
            (make-box (xyz -0.2 -0.2 0.7) (xyz 0.2 0.2 0.91))))
(define figure
  (unite (color coat trunk (first left) (second left) (first right) (second right))
         (color trousers (leg -1 (- half)) (leg 1 half))
         (color "#2a2320" (shoe -1 (- half)) (shoe 1 half) hair)
         (color skin head (hand left) (hand right))))
(draw (do-rotate (do-scale figure origin height) 'z (degrees->radians turn)))
