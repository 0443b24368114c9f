; Symbols of plans: the swings of doors, the arrows of stairs, and dimensions along walls.

(define symbol-lift 0.01) ; of symbols above the floor, which would hide them

; Returns the open leaf of a door and the quarter circle to its closed place. Its hinge is on the left, seen from the wall's
; right, and it opens to the wall's left, as the prefab "door" does.
(define (door-swing d h)
  (call-with-values (lambda () (place-along (walling-points d) (- (hole-at h) (/ (hole-width h) 2))))
    (lambda (p v)
      (let* ((z (+ (walling-base d) (hole-sill h) symbol-lift)) (hinge (+z (aside p v (last (walling-offsets d))) z)) (w (hole-width h)) (a (pol-phi v)))
        (list (make-line hinge (aside hinge v w)) (make-arc hinge w a (+ a pi/2)))))))

(define walking-lift 0.22)  ; of walking lines above the line of a stair's treads: more than a rise
(define cut-of-plans 1.1)   ; a walking line gets an arrow here, below the cut of a plan

; Returns the walking line of a stair with a dot at its foot, and arrows at its head and below the cut of a plan.
(define (stair-arrow line)
  (let* ((points (map (lambda (p) (+z p walking-lift)) line)) (z (+ (cz (car line)) cut-of-plans)))
    (define (arrow p v) (let ((tip (lambda (side) (aside (p+v p (v*r v -0.2)) v (* side 0.1))))) (make-line (tip 1) p (tip -1))))
    (define (below-cut points)
      (let ((p (first points)) (q (second points)))
        (cond ((and (< (cz p) z) (>= (cz q) z)) (list (arrow (intermediate-point p q (/ (- z (cz p)) (- (cz q) (cz p)))) (way p q))))
              ((null? (cddr points)) '())
              (else (below-cut (cdr points))))))
    (append (list (make-line points) (make-circle (first points) 0.05) (arrow (last points) (apply way (take-right points 2)))) (below-cut points))))

(define (plan-symbols . objects)
  (map (lambda (c) (layer "symbols" c))
    (append-map
      (lambda (o)
        (cond ((wall-object? o)
               (let ((d (wall-object-data o))) (append-map (lambda (h) (door-swing d h)) (filter (lambda (h) (eq? (hole-kind h) 'door)) (walling-openings d)))))
              ((stair-object? o) (stair-arrow (cdr (stair-object-made o))))
              (else (error 'plan-symbols "objects must be walls or stairs, got ~s" o))))
      (flatten objects))))

; Draws two chains of dimensions outside each straight wall: the openings, and the whole wall.
(define (dimension-walls walls #:offset [offset any? 0.6] #:view [view any? #f])
  (check-number 'dimension-walls "offset" offset)
  (define (one p q offset) (if (> (distance p q) 1e-6) (if view (dimension p q #:offset offset #:view view) (dimension p q #:offset offset))))
  (for-each
    (lambda (w)
      (let* ((d (data-of 'dimension-walls w)) (points (walling-points d)) (away (- (first (walling-offsets d)) offset)))
        (if (null? (cddr points))
            (let* ((l (points-length points)) (holes (sort (walling-openings d) < #:key hole-at))
                   (stops (append (list 0) (append-map (lambda (h) (list (- (hole-at h) (/ (hole-width h) 2)) (+ (hole-at h) (/ (hole-width h) 2)))) holes) (list l)))
                   (at (lambda (s) (call-with-values (lambda () (place-along points s)) (lambda (p v) (+z p (walling-base d)))))))
              (if (pair? holes) (for-each (lambda (a b) (one (at a) (at b) away)) stops (cdr stops)))
              (one (at 0) (at l) (if (pair? holes) (- away offset) away))))))
    (flatten (list walls))))
