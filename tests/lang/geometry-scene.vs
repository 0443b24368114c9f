; drawing and looks: what the procedures give back, and what is thrown away
(define s (make-sphere origin 1))
(define b (make-box origin (xyz 1 1 1)))
(define m (make-material #:name "old oak" #:color "#804020" #:roughness 0.7))
(displayln (material? m))                              ; expect: #t
(displayln (object-kind (with-material m s b)))        ; expect: with-material
(displayln (with-material concrete s))                 ; expect: (with-material "concrete" (make-sphere (xyz 0 0 0) 1))
(displayln (equal? (with-material 'glass s) (with-material glass s))) ; expect: #t
(displayln (equal? (with-material "glass" s) (with-material glass s))) ; expect: #t
(displayln (color (list 1 0.5 0) s))                   ; expect: (color (list 1 0.5 0) (make-sphere (xyz 0 0 0) 1))
(displayln (layer "walls" s))                          ; expect: (layer "walls" (make-sphere (xyz 0 0 0) 1))
(displayln (with-material glass '()))                  ; expect: (empty-object)
(displayln (draw s))                                   ; expect: (make-sphere (xyz 0 0 0) 1)
(displayln (draw (list s (list b))))                   ; expect: (unite (make-sphere (xyz 0 0 0) 1) (make-box (xyz 0 0 0) (xyz 1 1 1)))
(camera (xyz 10 -10 5) origin #:lens 50)
(view-from 'top)
(zoom-extents)
(sun #:azimuth 120 #:altitude 30)
(sun #:latitude 38.77 #:longitude -9.09 #:date "2026-06-21" #:time "15:00+01:00")
(sky #:color "lightblue")
(ground -1 #:material grass)
(units 'mm)
(displayln (parameterize ((current-segments 8)) (make-sphere origin 2))) ; expect: (make-sphere (xyz 0 0 0) 2 #:segments 8)
(displayln (make-sphere origin 2))                     ; expect: (make-sphere (xyz 0 0 0) 2)
(current-segments)
; a pattern is part of a material, and is printed with it
(displayln (make-material #:name "m" #:color (list 1 1 1) #:pattern 'tiles #:pattern-size 2 #:pattern-angle 30)) ; expect: (make-material #:name "m" #:color (list 1 1 1) #:pattern 'tiles #:pattern-size 2 #:pattern-angle 30)
