; (visualscheme building): symbols and dimensions of plans
(import (visualscheme) (visualscheme building))
(define w (door (window (wall (list (xy 0 0) (xy 6 0)) #:layers 0.3) 1.5 1 1) 4 1 2))
(define symbols (plan-symbols w))
(define (rounded p) (let ((r (lambda (x) (/ (round (* 1e6 x)) 1e6)))) (list (r (cx p)) (r (cy p)) (r (cz p)))))
(displayln (map (lambda (c) (map rounded (bounding-box c))) symbols))
; expect: (((3.5 0.15 0.01) (3.5 1.15 0.01)) ((3.5 0.15 0.01) (4.5 1.15 0.01)))
(displayln (list (object-layer (first symbols)) (near? (curve-length (second symbols)) pi/2))) ; expect: (symbols #t)
(displayln (plan-symbols (wall (list (xy 0 0) (xy 6 0))))) ; expect: ()
; a stair: walking line, dot, arrow at the head, arrow below the cut; the line lies above the treads
(define stairs
  (list (stair origin (xyz 4.2 0 2.8)) (stair origin (xyz 3.2 3.1 2.8) #:kind 'L) (stair origin (xyz -1.1 0 2.8) #:kind 'U) (stair origin (xyz 1.6 0 2.8) #:kind 'spiral #:width 1.2)))
(displayln (map (lambda (s) (length (plan-symbols s))) stairs)) ; expect: (4 4 4 4)
(displayln (map (lambda (s) (volume (intersect s (map (lambda (c) (do-thicken c 0.01)) (plan-symbols s))))) stairs)) ; expect: (0.0 0.0 0.0 0.0)
(displayln (map (lambda (s) (solid? s)) stairs)) ; expect: (#t #t #t #t)
(displayln (length (plan-symbols (stair origin (xyz 1.4 0 0.7) #:rule #f)))) ; expect: 3
(view "plan" 'plan)
(dimension-walls (join-walls w (wall (make-arc (xy 6 3) 3 -pi/2 pi/2))) #:view "plan")
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (plan-symbols 3))                    ; expect: plan-symbols: objects must be walls or stairs, got 3
(fails (dimension-walls 3))                 ; expect: dimension-walls: wall must be a wall, as wall or join-walls return it, got 3
(fails (dimension-walls w #:offset 'far))   ; expect: dimension-walls: offset must be a number, got far
