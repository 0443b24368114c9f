; What is cut too finely says so, at its place; a twist of many turns is cut as finely as one of few.
(define fine (make-sphere origin 1.2 #:segments 100000))
(displayln (abs (round (- (volume fine) (* 4/3 pi 1.728))))) ; expect: 0.0
(define (turns n) (do-sweep (make-rectangle (xy -1 -1) (xy 1 1)) (make-line origin (xyz 0 0 30)) (* n 2pi)))
(displayln (near? (volume (subtract (turns 70) (make-box (xyz -9 -9 -9) (xyz 9 9 -1)))) 120 2)) ; expect: #t
(displayln (volume (subtract (make-box (xyz -1 -1 -1) (xyz 1 1 1)) fine))) ; expect error: a sphere of 4096 facets a turn has 17 million triangles
