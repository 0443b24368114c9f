; People in plans: ways to exits around walls, and what is seen from a place. Heights play no part.

; ---- rooms ----

(define (corners-of curve)
  (let* ((line (lowered curve)) (points (if (eq? (object-kind line) 'line) (car (object-arguments line)) (curve-division curve 128)))
         (last-point (last points)))
    (if (near? (car points) last-point) (drop-right points 1) points)))

; Returns the closed curves around what a room is: a region, a flat surface, closed curves, or a list of points.
(define (loops-of who room)
  (cond
    ((and (pair? room) (list? room) (every point? room) (pair? (cdr room)) (pair? (cddr room))) (list room))
    ((and (object? room) (or (region? room) (curve? room) (surface? room))) (filter (lambda (l) (> (length l) 2)) (map corners-of (outline room))))
    (else (error who "a room must be a region, a closed curve or a list of points, got ~s" room))))
(define (region-of who room)
  (if (and (object? room) (region? room)) room (apply make-region (map (lambda (l) (make-polygon l)) (loops-of who room)))))

; corners: list of points of all loops; sizes, rooms: vectors
(define-record-type floor-plan (make-floor-plan numbers) floor-plan? (numbers plan-numbers))
(define (plan-of who rooms joined)
  (let* ((all (if (and (list? rooms) (not (and (pair? rooms) (point? (car rooms))))) rooms (list rooms))))
    (if (null? all) (error who "rooms must be one room or more, got ()"))
    (let* ((each (if joined (list (loops-of who (apply unite (map (lambda (r) (region-of who r)) all)))) (map (lambda (r) (loops-of who r)) all)))
           (numbers (list (append-map (lambda (loops) (append-map values loops)) each)
                          (list->vector (append-map (lambda (loops) (map length loops)) each))
                          (list->vector (append-map (lambda (loops k) (map (lambda (l) k) loops)) each (iota (length each)))))))
      (make-floor-plan (lambda () numbers)))))
(define (call-with-plan plan f . more) (apply f (append ((plan-numbers plan)) more)))

; ---- ways out ----

; places: procedure that returns a vector of four numbers each: x, y, length of the way or -1, index of the next place or -1
(define-record-type egress-result (make-egress-result plan places) egress-result? (plan egress-plan) (places egress-places))

; A door or exit is a point, or a line whose middle counts.
(define (opening who what o)
  (cond ((point? o) o) ((and (object? o) (curve? o)) (curve-point o (/ (curve-length o) 2)))
    (else (error who "~a must be points or lines, got ~s" what o))))

(define (egress rooms exits #:doors [doors any? #f])
  (let* ((points (lambda (what l) (map (lambda (o) (opening 'egress what o)) (if (list? l) l (list l)))))
         (out (points 'exits exits)) (within (if doors (points 'doors doors) '())) (plan (plan-of 'egress rooms (not doors))))
    (if (null? out) (error 'egress "exits must be one point or line or more, got ()"))
    (let ((places (call-with-plan plan core:plan-ways out within)))
      (make-egress-result plan (lambda () places)))))

(define (need-egress who r) (if (not (egress-result? r)) (error who "r must be a result of egress, got ~s" r)))
(define (way-from who r p)
  (need-egress who r)
  (if (not (point? p)) (error who "point must be a point, got ~s" p))
  (call-with-plan (egress-plan r) core:plan-way ((egress-places r)) p))

(define (egress-distance r p) (let ((way (way-from 'egress-distance r p))) (and way (first way))))

; Returns the way as a list of points, #f if there is none.
(define (way-points r p way)
  (let ((places ((egress-places r))))
    (let loop ((k (second way)) (l (list p)))
      (if (< k 0) (reverse l)
          (let ((number (lambda (i) (vector-ref places (+ (* 4 k) i)))))
            (loop (exact (number 3)) (cons (xyz (number 0) (number 1) (cz p)) l)))))))
(define (egress-path r p)
  (let ((way (way-from 'egress-path r p)))
    (and way
         (let* ((all (way-points r p way)) (turns (filter-map (lambda (a b) (and (> (distance a b) 1e-9) b)) all (cdr all))))
           (if (null? turns) (empty-object) (make-line (cons p turns)))))))

; Returns the corner from which the way is longest, as a list of its point and the length. Of all places of a plan, the
; farthest is a corner of a wall, or within a room at the place where two ways are equally long; the step finds the latter.
(define (longest-egress r #:step [step any? #f])
  (need-egress 'longest-egress r)
  (if step (need-positive 'longest-egress 'step step))
  (let* ((corners (first ((plan-numbers (egress-plan r))))) (xs (map cx corners)) (ys (map cy corners)) (z (cz (car corners)))
         (side (max (- (apply max xs) (apply min xs)) (- (apply max ys) (apply min ys)))) (d (or step (/ side 40)))
         (grid (if (> (/ side d) 500) (error 'longest-egress "step ~a is too fine for a plan of ~a" step side)
                   (append-map (lambda (x) (map (lambda (y) (xyz x y z)) (range (apply min ys) (apply max ys) d))) (range (apply min xs) (apply max xs) d)))))
    (fold (lambda (p best) (let ((far (egress-distance r p))) (if (and far (or (not best) (> far (second best)))) (list p far) best))) #f (append corners grid))))

; ---- views ----

(define (isovist rooms p)
  (if (not (point? p)) (error 'isovist "p must be a point, got ~s" p))
  (let ((corners (call-with-plan (plan-of 'isovist rooms #t) core:plan-view p)))
    (if (null? corners) (error 'isovist "the point ~s is in no room" p))
    (make-region (make-polygon corners))))
