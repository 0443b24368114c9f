; A window to stand in an opening: the opening's lower left corner is the origin, the wall runs along X, and Y goes inwards.
(define-parameter width 1.2 #:min 0.3 #:max 6 #:label "width of the opening, m")
(define-parameter height 1.4 #:min 0.3 #:max 4 #:label "height of the opening, m")
(define-parameter wall 0.2 #:min 0.05 #:max 1 #:label "thickness of the wall, m")
(define-parameter casements 2 #:min 1 #:max 8 #:label "casements side by side")
(define-parameter bars 1 #:min 0 #:max 6 #:label "glazing bars across each casement")
(define-parameter opening 0.0 #:min 0 #:max 110 #:label "outer casements opened by, degrees")
(define-parameter sill 0.06 #:min 0 #:max 0.5 #:label "how far the sill stands out, m")
(define-parameter colour "#e8e4da" #:label "colour of the frame")

(define bar 0.055)
(define deep 0.07)
(define front (* 0.35 (max 0 (- wall deep))))
(define (ring x0 x1 z0 z1 w y0 y1)
  (subtract (make-box (xyz x0 y0 z0) (xyz x1 y1 z1)) (make-box (xyz (+ x0 w) (- y0 1) (+ z0 w)) (xyz (- x1 w) (+ y1 1) (- z1 w)))))
(define frame (ring 0 width 0 height (* 0.8 bar) front (+ front deep)))
(define each (/ (- width (* 1.6 bar) (if (> casements 2) (* 0.04 (- casements 1)) 0)) casements))
; A casement about its own lower left corner, and its pane.
(define (casement)
  (let* ((w (- each 0.006)) (h (- height (* 1.6 bar) 0.006)) (s 0.045) (free (- h (* 2 s))))
    (unite
      (color colour (ring 0 w 0 h s 0 0.05)
        (map (lambda (i) (let ((z (+ s (* free (/ (+ i 1) (+ bars 1)))))) (make-box (xyz s 0.012 (- z 0.011)) (xyz (- w s) 0.038 (+ z 0.011))))) (iota bars)))
      (with-material 'glass (make-box (xyz (- s 0.005) 0.022 (- s 0.005)) (xyz (- w s -0.005) 0.028 (- h s -0.005)))))))
; Between three casements or more stand posts.
(define post (if (> casements 2) 0.04 0))
(define posts
  (map (lambda (i)
         (let ((x (+ (* 0.8 bar) (* (+ i 1) each) (* i post))))
           (make-box (xyz x front bar) (xyz (+ x post) (+ front deep) (- height bar)))))
       (if (> post 0) (iota (- casements 1)) '())))
(define (at i)
  (let* ((x (+ (* 0.8 bar) 0.003 (* i (+ each post)))) (placed (do-move (casement) (vxyz x (+ front deep -0.04) (+ (* 0.8 bar) 0.003)))) (y (+ front deep 0.01)))
    (cond
      ((= i 0) (do-rotate placed (xyz x y 0) uz (degrees->radians opening)))
      ((= i (- casements 1)) (do-rotate placed (xyz (+ x each -0.006) y 0) uz (- (degrees->radians opening))))
      (else placed))))
(define ledge
  (if (> sill 0)
      (hull (make-box (xyz -0.04 (- sill) -0.04) (xyz (+ width 0.04) front -0.03)) (make-box (xyz -0.04 front -0.04) (xyz (+ width 0.04) (+ front 0.01) 0)))
      (empty-object)))
(draw (color colour frame ledge posts) (map at (iota casements)))
