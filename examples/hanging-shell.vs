; A canopy whose form was found, not drawn: a cloth hung from its four corners, frozen and turned over, as Heinz Isler made his
; shells. What hangs is all in tension, so what stands is all in compression.
;
; What it teaches: (form-find points members #:fixed ... #:load ... #:slack ...) moves the points of a net until every force is
; balanced; a load that points upwards turns the cloth over at once.
(define-parameter span 16.0 #:min 6 #:max 30 #:label "distance of the feet, m")
(define-parameter slack 1.07 #:min 1.01 #:max 1.3 #:label "cloth longer than the distance of the feet by")
(define-parameter edge 1.1 #:min 0.8 #:max 1.3 #:label "edges longer than the cloth by")
(define-parameter n 20 #:min 8 #:max 40 #:step 2 #:label "threads of the cloth each way")
(define-parameter thickness 0.16 #:min 0.05 #:max 0.5 #:label "thickness of the shell, m")

; The cloth, flat at first: threads in both directions, and a border that may be looser.
(define (cloth u v) (xyz (* span (- u 1/2)) (* span (- v 1/2)) 0))
(define points (net-points cloth n n))
(define threads (net-members n n))
(define border (net-border n n))
(define (on-border? m) (and (memv (first m) border) (memv (second m) border)))
; Each corner holds a few points, so that the shell stands on feet and not on tips.
(define feet
  (filter (lambda (i) (let ((p (list-ref points (- i 1)))) (> (+ (abs (cx p)) (abs (cy p))) (- span (* 1.01 (/ span n)))))) (iota (length points) 1)))

(define found
  (form-find points threads #:fixed feet #:load (vxyz 0 0 1) #:slack (map (lambda (m) (if (on-border? m) (* slack edge) slack)) threads) #:tolerance 1e-4))

; The points are made a smooth shell of even thickness.
(define mesh (make-polyface-mesh found (net-faces n n)))
(define shell (make-crust (make-subdivision mesh 2) thickness))

(define rise (apply max (map cz found)))
(draw (with-material 'concrete shell)
      (with-material 'stone (make-box (xyz (* -0.62 span) (* -0.62 span) -0.35) (xyz (* 0.62 span) (* 0.62 span) -0.02)))
      (do-move (prefab "person" #:stride 0.2 #:turn 60) (vxyz -1.5 -6.6 0))
      (do-move (prefab "person" #:height 1.6 #:coat "#8c4a3a") (vxyz 2.4 -3 0))
      (do-move (prefab "person" #:height 1.78 #:coat "#c9b68f" #:turn -160) (vxyz 3 -3.5 0)))
(ground -0.35 #:material 'grass)
(sun #:azimuth 215 #:altitude 48)
(camera (xyz (* 0.62 span) (* -1.5 span) 2.6) (xyz (* 0.03 span) 0 (* 0.42 rise)) #:lens 33)
