; Dormers of roofs. In a dormer's own frame the origin is the point of the outline below the middle of its front, X goes
; along the edge, Y inwards, Z upwards from the outline.

(define-record-type dormer-plan (make-dormer-plan edge place width height kind pitch setback overhang window) dormer-plan?
  (edge plan-edge) (place plan-place) (width plan-width) (height plan-height) (kind plan-kind) (pitch plan-pitch) (setback plan-setback)
  (overhang plan-overhang) (window plan-window))

(define (dormer edge place width #:height [height any? 1.4] #:kind [kind any? 'gable] #:pitch [pitch any? #f] #:setback [setback any? 0.5]
                #:overhang [overhang any? 0.15] #:window [window any? "window"])
  (if (not (and (exact-integer? edge) (> edge 0))) (error 'dormer "edge must be the number of an edge, from 1, got ~s" edge))
  (check-number 'dormer "place" place)
  (for-each (lambda (n x) (check-positive 'dormer n x)) '("width" "height") (list width height))
  (for-each (lambda (n x) (if (not (and (real? x) (finite? x) (>= x 0))) (error 'dormer "~a must be a number of 0 or more, got ~s" n x)))
    '("setback" "overhang") (list setback overhang))
  (if (not (memq kind '(gable shed))) (error 'dormer "kind must be 'gable or 'shed, got ~s" kind))
  (if (not (or (not pitch) (and (real? pitch) (< 0 pitch (/ pi 2))))) (error 'dormer "pitch must be radians between 0 and pi/2, got ~s" pitch))
  (make-dormer-plan edge place width height kind (or pitch (degrees->radians (if (eq? kind 'gable) 40 8))) setback overhang window))

(define (dormers-of l)
  (let ((all (if (dormer-plan? l) (list l) l)))
    (if (not (and (list? all) (every dormer-plan? all))) (error 'roof "dormers must be a list of dormers, as dormer returns them, got ~s" l))
    all))

(define cheek 0.12) ; thickness of the walls of a dormer, at most a quarter of its width

; Returns a list of what a dormer adds to the roof, what it cuts out of a roof with a thickness, and its window.
(define (dormer-solids d loops pitches mansard top thick)
  (let* ((n (length pitches)) (edge (plan-edge d))
         (starts (apply append loops)) (ends (append-map (lambda (l) (append (cdr l) (list (car l)))) loops))
         (p (if (<= edge n) (list-ref starts (- edge 1)) (error 'dormer "edge must be a number from 1 to ~a, got ~s" n edge)))
         (q (list-ref ends (- edge 1))) (l (distance p q)) (u (way p q)) (w (plan-width d)) (h (plan-height d)) (s (plan-setback d))
         (slope (tan (or (list-ref pitches (- edge 1)) (error 'dormer "edge ~a is a gable: a dormer needs a plane of the roof" edge))))
         (own (tan (plan-pitch d))) (foot (* s slope)) (eave (+ foot h)) (gable? (eq? (plan-kind d) 'gable)) (o (plan-overhang d)) (c (min cheek (/ w 4)))
         (high (if gable? (+ eave (* w 1/2 own)) (if (< own slope) (/ (- (* eave slope) (* s slope own)) (- slope own)) +inf.0)))
         (depth (if (and mansard (> high (first mansard))) (+ (/ (first mansard) slope) (/ (- high (first mansard)) (tan (second mansard)))) (/ high slope)))
         (inwards? (let ((m (aside (mid p q) u (* 1e-3 l)))) (odd? (count (lambda (loop) (inside? m loop)) loops))))
         (at (plan-place d)) (middle (p+v p (v*r u at)))
         (placed (lambda (x) (do-move (do-rotate x 'z (pol-phi (if inwards? u (turned-back u)))) (p->q origin middle)))))
    (if (or (< at (/ w 2)) (> (+ at (/ w 2)) l))
        (error 'dormer "the dormer goes from ~a to ~a along an edge of ~a" (shown (- at (/ w 2))) (shown (+ at (/ w 2))) (shown l)))
    (if (> (+ (cz p) high) (- top 1e-9))
        (error 'dormer "the dormer rises to ~a, the roof only to ~a: make it lower or narrower, or its setback less" (shown (+ (cz p) high)) (shown top)))
    (let* ((end (+ depth thick)) (r (/ w 2)) (t (max thick 0.05))
           ; fronts are polygons of X and Z, sides polygons of Y and Z
           (front (lambda (from to . points) (do-extrude (make-polygon (map (lambda (a) (xyz (car a) from (cdr a))) points)) (vxyz 0 (- to from) 0))))
           (side (lambda (half . points) (do-extrude (make-polygon (map (lambda (a) (xyz (- half) (car a) (cdr a))) points)) (vxyz (* 2 half) 0 0))))
           (body (lambda (r from lower) ; the dormer's space between walls at r, below a roof that is lower
                   (if gable?
                       (front from end (cons (- r) 0) (cons r 0) (cons r (+ (- eave lower) (* own (- (/ w 2) r)))) (cons 0 (- high lower)) (cons (- r) (+ (- eave lower) (* own (- (/ w 2) r)))))
                       (side r (cons from 0) (cons end 0) (cons end (+ (- eave lower) (* own (- end s)))) (cons from (+ (- eave lower) (* own (- from s))))))))
           (cap (if gable?
                    (let ((e (+ r o)) (low (- eave (* o own))))
                      (front (- s o) end (cons (- e) low) (cons 0 high) (cons e low) (cons e (- low t)) (cons 0 (- high t)) (cons (- e) (- low t))))
                    (let ((z (lambda (y) (+ eave (* own (- y s))))))
                      (side (+ r o) (cons (- s o) (z (- s o))) (cons end (z end)) (cons end (- (z end) t)) (cons (- s o) (- (z (- s o)) t))))))
           (clear (- h t 0.45)) (wide (- w (* 2 c) 0.2)) (sill (+ foot 0.3))
           (window? (and (plan-window d) (> thick 0) (> wide 0.35) (> clear 0.35)))
           (hole (make-box (xyz (/ wide -2) (- s 0.5) sill) (xyz (/ wide 2) (+ s c 0.01) (+ sill clear)))))
      (map placed
        (list (unite (body r s 0) cap)
              (unite (body (- r c) (+ s c) t) (if window? hole '()))
              (if window? (do-move (prefab (plan-window d) #:width wide #:height clear #:wall c) (vxyz (/ wide -2) s sill)) (empty-object)))))))
