; (visualscheme building): words of a building stay objects like others; tests/cli/building-ifc has their classes
(import (visualscheme) (visualscheme building))
(define outline (list (xyz 0 0 3) (xyz 6 0 3) (xyz 6 4 3) (xyz 0 4 3)))
(define all
  (list (slab outline) (column origin) (beam origin (xy 5 0)) (stair origin (xyz 4.2 0 2.8)) (ramp origin (xyz 7 0 0.4)) (railing (list (xy 0 0) (xy 4 0)))
        (roof outline) (curtain-wall (list (xy 0 0) (xy 6 0))) (wall (list (xy 0 0) (xy 6 0)))))
(displayln (map solid? all))                             ; expect: (#t #t #t #t #t #t #t #t #t)
(displayln (map (lambda (o) (equal? (bounding-box o) (bounding-box (lowered o)))) all)) ; expect: (#t #t #t #t #t #t #t #t #t)
(displayln (near? (volume (subtract (roof outline #:pitch pi/4) (make-half-space (make-plane (xyz 3 0 0) ux)))) (/ (volume (roof outline #:pitch pi/4)) 2))) ; expect: #t
