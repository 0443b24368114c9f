; Two curved walls that meet at a small angle, every second time with a third one behind them, joined: the volume of their
; union is the sum of their layers' volumes, thus no two layers overlap, and their middles are filled near the joint.
;   vs tests/oracle/acute_walls.vs -D cases=1000
(import (visualscheme) (visualscheme building))
(define-parameter cases 10)
(define-parameter seed 1)
(define stacks '(0.3 0.1 ((0.115 brick) (0.1 insulation) (0.175 block) (0.015 plaster)) ((0.015 plaster) (0.1 block) (0.015 plaster))))
(define (pick l) (list-ref l (random (length l))))
(define (between a b) (+ a (random (- b a))))
(define found 0)

; A wall from the origin in a direction: an arc of a curvature, or a line.
(define (bow direction curvature long)
  (wall (if (< (abs curvature) 0.02) (list origin (pol long direction))
            (let* ((radius (/ (abs curvature))) (side (if (> curvature 0) pi/2 -pi/2)) (start (- direction side)))
              (make-arc (pol radius (+ direction side)) radius start (+ start (* long curvature)))))
    #:layers (pick stacks) #:height 1))

(define (empty-places body w)
  (let ((path (make-line (map (lambda (p) (+z p 0.1)) (wall-path w)))))
    (count (lambda (k) (not (contains? body (curve-point path (/ (+ 1 k) 22.0))))) (iota 40))))

(define (check)
  (let* ((angle (degrees->radians (between 6.0 35.0)))
         (walls (append (list (bow 0 (between -0.5 0.5) (between 2.0 5.0)) (bow angle (between -0.5 0.5) (between 2.0 5.0)))
                        (if (= 0 (random 2)) (list (bow 3 (between -0.3 0.3) 3)) '())))
         (layers (append-map wall-layers (join-walls walls))) (body (unite layers)) (sum (apply + (map volume layers)))
         (gaps (apply + (map (lambda (w) (empty-places body w)) walls))))
    (set! found (+ found 1))
    (if (not (and (near? (/ (volume body) sum) 1 1e-8) (= gaps 0)))
        (displayln (list seed "degrees:" (radians->degrees angle) "overlap:" (- sum (volume body)) "gaps:" gaps)))))

; A wall that lies within another one, or crosses it twice within its thickness, is refused: no joint is right.
(let ((first-seed seed))
  (for ((s (range first-seed (+ first-seed cases))))
    (set! seed s)
    (random-seed! s)
    (guard (x ((and (error-object? x) (any (lambda (t) (string-contains? (error-object-message x) t)) '("lies within another one" "too short for its joints"))))) (check))))
(if (< found (* 0.9 cases)) (displayln (list "refused" (- cases found) "of" cases)))
