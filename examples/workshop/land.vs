; Land from surveyed points, with a road as breaklines: its contours with their heights, a level place for a house, and
; the earth to move. As a plan: vs examples/workshop/land.vs -o land-site.svg

(define-parameter step 1 #:min 1/2 #:max 5 #:label "height between contours")
(define-parameter level 7 #:min 0 #:max 20 #:label "height of the house")

(random-seed! 4)
(define (height x y) (+ 8 (* 5 (sin (/ x 19))) (* 3 (cos (/ (+ y (/ x 3)) 13)))))
(define (ground-at x y) (xyz x y (height x y)))

; the survey: the corners, points along the border, and others where the surveyor stood
(define border
  (append (append-map (lambda (x) (list (ground-at x 0) (ground-at x 80))) (range 0 121 10))
          (append-map (lambda (y) (list (ground-at 0 y) (ground-at 120 y))) (range 10 71 10))))
(define stations (for/list ([i 150]) (ground-at (random-range 1. 119) (random-range 1. 79))))

; the road's edges: level across, so that the triangles may not cut its corners
(define (edge side)
  (for/list ([x (division 0.5 119.5 40)])
    (let ((y (+ 20 (* 6 (sin (/ x 25))))))
      (xyz x (+ y side) (+ 0.2 (height x y))))))
(define land (terrain (append border stations) #:breaklines (list (edge -2.5) (edge 2.5))))

; the level place, and the earth to move
(define corners (list (xy 62 45) (xy 86 45) (xy 86 63) (xy 62 63)))
(define place (terrain (map (lambda (p) (+z p level)) corners)))
(define-values (cut fill) (cut-and-fill land place))
(printf "cut ~a, fill ~a cubic metres~%" (round cut) (round fill))

; contours: each fifth on a layer of its own, with its height
(for ([curves (label-contours (contours land #:step step) 1.6)])
  (define (main? c) (zero? (modulo (round (/ (cz (first (bounding-box c))) step)) 5)))
  (for ([c curves])
    (draw (if (main? c) (layer "main contours" c #:line 0.35) (layer "contours" c #:line 0.13)))))

(draw (layer "road" (make-line (edge -2.5)) (make-line (edge 2.5))))
(draw (layer "house" (do-edges place) #:line 0.5))
(view "site" 'top)
