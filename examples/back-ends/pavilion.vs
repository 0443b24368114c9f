; A model that brings its back-ends with it: the part list and the plan are loaded as libraries.
;
;   vs pavilion.vs -o pavilion.csv -o pavilion.svg -o pavilion.glb

(load "part-list.vs")
(load "plan.vs")

(define (post p) (make-cylinder p 3 0.15))

(draw (with-material concrete (make-box (xyz -4 -3 -0.2) (xyz 4 3 0))))
(draw (with-material wood
        (unite (map post (list (xy -3 -2) (xy 3 -2) (xy 3 2) (xy -3 2))))))
(draw (with-material steel (subtract (make-cylinder (xyz 0 0 3) 0.2 3.8) (make-cylinder (xyz 0 0 2.9) 0.4 1.2))))
