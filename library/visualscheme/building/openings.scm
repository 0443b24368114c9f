; Openings in walls, with windows, doors, or a procedure of the user's own.

; Returns the distance along the wall's path of a place: a number, or a point near the path.
(define (place-in who d place)
  (cond ((point? place)
         (call-with-values (lambda () (distance-along (walling-points d) (flat place)))
           (lambda (s gap)
             (if (> gap (* 2 (- (last (walling-offsets d)) (first (walling-offsets d)))))
                 (error who "place must be near the wall's path, got ~s, ~a away" place gap))
             s)))
        ((and (real? place) (finite? place)) place)
        (else (error who "place must be a distance along the wall's path, or a point, got ~s" place))))

(define (shown x) (/ (round (* 1e4 (exact->inexact x))) 1e4))

(define (with-opening who kind w place width height sill fill)
  (check-positive who "width" width)
  (check-positive who "height" height)
  (check-number who "sill" sill)
  (let* ((d (data-of who w)) (at (place-in who d place)) (l (points-length (walling-points d))) (from (- at (/ width 2))) (to (+ at (/ width 2))))
    (if (> width l) (error who "the opening is ~a wide, the wall only ~a long" (shown width) (shown l)))
    (if (or (< from -1e-9) (> to (+ l 1e-9)))
        (error who "the opening goes from ~a to ~a along a wall of ~a" (shown from) (shown to) (shown l)))
    (if (or (< sill 0) (> (+ sill height) (+ (walling-height d) 1e-9)))
        (error who "the opening goes from ~a to ~a above the foot of a wall of ~a" (shown sill) (shown (+ sill height)) (shown (walling-height d))))
    (for-each
      (lambda (h)
        (if (and (< (abs (- (hole-at h) at)) (- (/ (+ width (hole-width h)) 2) 1e-9))
                 (< (max sill (hole-sill h)) (- (min (+ sill height) (+ (hole-sill h) (hole-height h))) 1e-9)))
            (error who "the opening overlaps another one, whose middle is at ~a" (shown (hole-at h)))))
      (walling-openings d))
    (let ((h (make-hole* kind at width height sill fill)))
      (if (and fill (> (angle-between (way-at d from) (way-at d to)) 0.8)) (error who "the opening goes around a corner of the wall"))
      (drawn-wall (with-hole d h)))))

(define (way-at d s) (call-with-values (lambda () (place-along (walling-points d) s)) (lambda (p v) v)))

(define (opening w place width height #:sill [sill any? 0] #:fill [fill any? #f])
  (with-opening 'opening 'opening w place width height sill fill))
(define (window w place width height #:sill [sill any? 0.9] #:fill [fill any? "window"])
  (with-opening 'window 'window w place width height sill fill))
(define (door w place [width any? 0.9] [height any? 2.1] #:sill [sill any? 0] #:fill [fill any? "door"])
  (with-opening 'door 'door w place width height sill fill))

; Returns the corners in plan of what an opening cuts out of all layers: it follows the path between its jambs, beyond the faces.
(define (hole-outline d h)
  (let* ((thick (- (last (walling-offsets d)) (first (walling-offsets d)))) (over (/ thick 8))
         (points (without-short-ends thick (part-of (walling-points d) (- (hole-at h) (/ (hole-width h) 2)) (+ (hole-at h) (/ (hole-width h) 2)))))
         (side (lambda (o) (points-aside 'opening points #f o))))
    (append (side (- (first (walling-offsets d)) over)) (reverse (side (+ (last (walling-offsets d)) over))))))

(define (hole-cutter d h)
  (let ((bottom (+ (walling-base d) (hole-sill h)))) (area-solid (list (hole-outline d h)) bottom (+ bottom (hole-height h)))))

; Returns points without corners so near an end that an offset of d would turn the path back there.
(define (without-short-ends d points)
  (define (cut points)
    (if (and (pair? (cddr points))
             (let ((v (way (first points) (second points))) (w (way (second points) (third points))))
               (< (distance (first points) (second points)) (* 1.2 d (tan (/ (min 3 (angle-between v w)) 2))))))
        (cut (cons (car points) (cddr points)))
        points))
  (reverse (cut (reverse (cut points)))))

; Returns the window, door or other filling in its place, or #f. Its lower left corner, seen from the wall's right side, is
; the origin of the filling.
(define (hole-filled d h)
  (let ((fill (hole-fill h)) (thick (- (last (walling-offsets d)) (first (walling-offsets d)))))
    (and fill
         (let* ((o (cond ((string? fill) (prefab fill #:width (hole-width h) #:height (hole-height h) #:wall thick))
                         ((procedure? fill) (fill (hole-width h) (hole-height h) thick))
                         (else fill))))
           (call-with-values (lambda () (place-along (walling-points d) (hole-at h)))
             (lambda (p v)
               (let ((corner (aside (p+v p (v*r v (/ (hole-width h) -2))) v (first (walling-offsets d)))))
                 (do-move (do-rotate o 'z (pol-phi v)) (p->q origin (+z corner (+ (walling-base d) (hole-sill h))))))))))))
