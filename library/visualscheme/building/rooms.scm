; Rooms: what walls enclose in plan.

(define-record-type space (make-space name loops height base gaps) space?
  (name space-name) (loops space-loops) (height space-height) (base space-base) (gaps space-gaps))
; An opening between two rooms: the names of those on the wall's right and left, #f outside. at: its middle; outline: its
; corners in plan, beyond the faces of the wall.
(define-record-type gap (make-gap way? right left width area at outline) gap?
  (way? gap-way?) (right gap-right) (left gap-left) (width gap-width) (area gap-area) (at gap-at) (outline gap-outline))
(define (room? x) (space? x))
(define (space-of who r) (if (space? r) (note-asked r) (error who "room must be a room, as rooms returns it, got ~s" r)))

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
    (for-each
      (lambda (l)
        (let ((own (filter (lambda (n) (in? (second n) l)) names)))
          (if (and (pair? own) (pair? (cdr own)))
              (error 'rooms "~s and ~s name one room: walls with a gap, or none, are between ~s and ~s" (first (first own)) (first (second own))
                (second (first own)) (second (second own))))))
      sorted)
    (let* ((name-of (lambda (l i) (let ((n (find (lambda (n) (in? (second n) l)) names))) (if n (first n) i))))
           (named (map (lambda (l i) (cons l (name-of l i))) sorted (iota (length sorted) 1)))
           (at (lambda (p) (let ((found (find (lambda (r) (in? p (car r))) named))) (and found (cdr found)))))
           (gaps (append-map (lambda (d) (map (lambda (h) (gap-of d h at)) (walling-openings d))) data)))
      (map (lambda (r)
             (make-space (cdr r) (cons (car r) (holes-of (car r))) (- top base) base
               (filter (lambda (g) (or (equal? (gap-right g) (cdr r)) (equal? (gap-left g) (cdr r)))) gaps)))
        named))))

(define (passage? h) (or (eq? (hole-kind h) 'door) (and (eq? (hole-kind h) 'opening) (= (hole-sill h) 0))))

; Returns the opening as it divides rooms; at: a procedure that returns the name of the room at a point.
(define (gap-of d h at)
  (call-with-values (lambda () (place-along (walling-points d) (hole-at h)))
    (lambda (p v)
      (make-gap (passage? h) (at (aside p v (- (first (walling-offsets d)) 0.05))) (at (aside p v (+ (last (walling-offsets d)) 0.05)))
        (hole-width h) (* (hole-width h) (hole-height h)) p (hole-outline d h)))))

(define (room-name r) (space-name (space-of 'room-name r)))
(define (room-area r)
  (let ((sizes (map (lambda (l) (/ (abs (turn l)) 2)) (space-loops (space-of 'room-area r))))) (- (car sizes) (apply + (cdr sizes)))))
(define (room-perimeter r) (apply + (map (lambda (l) (points-length (cons (last l) l))) (space-loops (space-of 'room-perimeter r)))))
(define (room-height r) (space-height (space-of 'room-height r)))
(define (room-volume r) (* (room-area r) (room-height r)))
(define (room-region r)
  (apply make-region (map (lambda (l) (make-polygon (map (lambda (p) (xyz (cx p) (cy p) (space-base r))) l))) (space-loops (space-of 'room-region r)))))
(define (room-solid r) (do-extrude (room-region r) (room-height r)))
(define (room-doors r) (map door-row (filter gap-way? (space-gaps (space-of 'room-doors r)))))
(define (door-row g) (list (gap-right g) (gap-left g) (gap-width g)))

; Returns the doors between rooms, each once: the names on both sides and the width.
(define (room-graph rooms) (map door-row (filter gap-way? (all-gaps (rooms-of 'room-graph rooms)))))
(define (all-gaps rooms) (delete-duplicates (append-map space-gaps rooms) eq?))
(define (rooms-of who l) (if (and (list? l) (every space? l)) l (error who "rooms must be a list of rooms, as rooms returns it, got ~s" l)))

; Returns the loops of the outer faces of walls.
(define (outer-loops data)
  (let ((outer (map cdr (remove car (covered-loops data)))))
    (filter (lambda (l) (not (any (lambda (o) (and (not (eq? o l)) (inside? (inner-point l) o))) outer))) outer)))

; Returns the area within the outer faces of the walls.
(define (gross-area walls)
  (apply + (map (lambda (l) (/ (abs (turn l)) 2)) (outer-loops (map (lambda (w) (data-of 'gross-area w)) (flatten (list walls)))))))

; Returns the outline of the outer faces at a height, by default the highest top of the walls: points, or a list of outlines of
; separate walls.
(define (outer-outline walls #:height [height any? #f])
  (if height (check-number 'outer-outline "height" height))
  (let* ((data (map (lambda (w) (data-of 'outer-outline w)) (flatten (list walls))))
         (top (or height (apply max 0 (map (lambda (d) (+ (walling-base d) (walling-height d))) data))))
         (made (map (lambda (l) (map (lambda (p) (xyz (cx p) (cy p) top)) (from-lower-left (without-flat-corners l)))) (outer-loops data))))
    (cond ((null? made) (error 'outer-outline "walls must be one wall or more, got ()"))
          ((null? (cdr made)) (car made))
          (else made))))

(define flat-corner 1e-5) ; a corner nearer than this to the line between its neighbours, or to a neighbour, is none

; Returns the loop counter-clockwise without corners on the lines between their neighbours, and without slits.
(define (without-flat-corners loop)
  (define (flat? before p after)
    (or (< (distance before p) flat-corner) (< (distance before after) flat-corner)
        (< (abs (cross-2d (way before after) (p->q before p))) flat-corner)))
  (let again ((l (if (> (turn loop) 0) loop (reverse loop))))
    (let ((k (list-index (lambda (before p after) (flat? before p after)) (cons (last l) (drop-right l 1)) l (append (cdr l) (list (car l))))))
      (if (and k (> (length l) 3)) (again (append (take l k) (drop l (+ k 1)))) l))))

(define (from-lower-left l)
  (let ((k (argmin (lambda (i) (let ((p (list-ref l i))) (+ (cy p) (* 1e-3 (cx p))))) (iota (length l))))) (append (drop l k) (take l k))))

; Writes name and area of each room into the drawing's views, where the room is widest.
(define (label-rooms rooms #:view [view any? #f])
  (for-each (lambda (r) (room-label (room-region r) (format "~a" (room-name r)) #:digits 1 #:view view)) (rooms-of 'label-rooms rooms)))
