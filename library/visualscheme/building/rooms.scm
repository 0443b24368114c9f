; Rooms: what walls enclose in plan.

(define-record-type space (make-space name loops height base doors) space?
  (name space-name) (loops space-loops) (height space-height) (base space-base) (doors space-doors))
(define (room? x) (space? x))
(define (space-of who r) (if (space? r) r (error who "room must be a room, as rooms returns it, got ~s" r)))

; Returns the loops of the ground that all walls cover, each with whether it is the edge of a room. Loops of less than a
; thousandth of a square unit are dropped: they come from rounding at joints.
(define (covered-loops data)
  (let* ((regions (append-map (lambda (d) (map (lambda (a) (apply make-region (map make-polygon a))) (apply append (third (first (walling-slabs d)))))) data))
         (found (filter (lambda (l) (> (abs (turn l)) 2e-3))
                  (map (lambda (c) (car (object-arguments c))) (outline (unite regions))))))
    (map (lambda (l) (cons (odd? (count (lambda (o) (and (not (eq? o l)) (inside? (inner-point l) o))) found)) l)) found)))

; Returns a point inside the loop, near its longest edge.
(define (inner-point loop)
  (let* ((edges (map cons loop (append (cdr loop) (list (car loop))))) (e (argmax (lambda (e) (distance (car e) (cdr e))) edges))
         (side (if (> (turn loop) 0) 1 -1)))
    (aside (mid (car e) (cdr e)) (way (car e) (cdr e)) (* side 1e-4 (distance (car e) (cdr e))))))

; names: lists of a name and a point in the room.
(define (rooms walls #:names [names any? '()])
  (let* ((data (map (lambda (w) (data-of 'rooms w)) (flatten (list walls)))) (loops (if (null? data) '() (covered-loops data)))
         (outer (map cdr (remove car loops))) (inner (map cdr (filter car loops)))
         (base (if (null? data) 0 (apply min (map walling-base data))))
         (top (if (null? data) 0 (apply min (map (lambda (d) (+ (walling-base d) (walling-height d))) data))))
         (sorted (sort inner < #:key (lambda (l) (+ (* 1e6 (round (* 10 (apply min (map cy l))))) (apply min (map cx l))))))
         (holes-of (lambda (l) (filter (lambda (o) (and (inside? (inner-point o) l) (< (abs (turn o)) (abs (turn l))))) outer)))
         (in? (lambda (p l) (and (inside? p l) (not (any (lambda (o) (inside? p o)) (holes-of l)))))))
    (if (not (list? names)) (error 'rooms "names must be lists of a name and a point, got ~s" names))
    (for-each
      (lambda (n)
        (if (not (and (list? n) (= (length n) 2) (point? (second n)))) (error 'rooms "names must be lists of a name and a point, got ~s" n))
        (if (not (any (lambda (l) (in? (second n) l)) sorted)) (error 'rooms "no walls enclose ~s, the place of ~s" (second n) (first n))))
      names)
    (let* ((name-of (lambda (l i) (let ((n (find (lambda (n) (in? (second n) l)) names))) (if n (first n) i))))
           (named (map (lambda (l i) (cons l (name-of l i))) sorted (iota (length sorted) 1)))
           (at (lambda (p) (let ((found (find (lambda (r) (in? p (car r))) named))) (and found (cdr found)))))
           (doors (append-map (lambda (d) (map (lambda (h) (door-sides d h at)) (filter passage? (walling-openings d)))) data)))
      (map (lambda (r)
             (make-space (cdr r) (cons (car r) (holes-of (car r))) (- top base) base
               (filter (lambda (door) (or (equal? (first door) (cdr r)) (equal? (second door) (cdr r)))) doors)))
        named))))

(define (passage? h) (or (eq? (hole-kind h) 'door) (and (eq? (hole-kind h) 'opening) (= (hole-sill h) 0))))

; Returns the names of what lies on the right and on the left of a door, #f outside, and its width.
(define (door-sides d h at)
  (call-with-values (lambda () (place-along (walling-points d) (hole-at h)))
    (lambda (p v)
      (list (at (aside p v (- (first (walling-offsets d)) 0.05))) (at (aside p v (+ (last (walling-offsets d)) 0.05))) (hole-width h)))))

(define (room-name r) (space-name (space-of 'room-name r)))
(define (room-area r)
  (let ((sizes (map (lambda (l) (/ (abs (turn l)) 2)) (space-loops (space-of 'room-area r))))) (- (car sizes) (apply + (cdr sizes)))))
(define (room-perimeter r) (apply + (map (lambda (l) (points-length (cons (last l) l))) (space-loops (space-of 'room-perimeter r)))))
(define (room-height r) (space-height (space-of 'room-height r)))
(define (room-volume r) (* (room-area r) (room-height r)))
(define (room-region r)
  (apply make-region (map (lambda (l) (make-polygon (map (lambda (p) (xyz (cx p) (cy p) (space-base r))) l))) (space-loops (space-of 'room-region r)))))
(define (room-solid r) (do-extrude (room-region r) (room-height r)))
(define (room-doors r) (space-doors (space-of 'room-doors r)))

; Returns the doors between rooms, each once: the names on both sides and the width.
(define (room-graph rooms) (delete-duplicates (append-map room-doors (rooms-of 'room-graph rooms)) eq?))
(define (rooms-of who l) (if (list? l) l (error who "rooms must be a list of rooms, as rooms returns it, got ~s" l)))

; Returns the area within the outer faces of the walls.
(define (gross-area walls)
  (let ((loops (covered-loops (map (lambda (w) (data-of 'gross-area w)) (flatten (list walls))))))
    (apply + (map (lambda (l) (/ (abs (turn (cdr l))) 2))
               (filter (lambda (l) (and (not (car l)) (not (any (lambda (o) (and (not (eq? o l)) (not (car o)) (inside? (inner-point (cdr l)) (cdr o)))) loops)))) loops)))))

; Writes name and area of each room into the drawing's views, where the room is widest.
(define (label-rooms rooms #:view [view any? #f])
  (for-each (lambda (r) (room-label (room-region r) (format "~a" (room-name r)) #:digits 1 #:view view)) (rooms-of 'label-rooms rooms)))
