; Numbers of rooms that rules of a design limit: clear widths, daylight, ways to exits.

(define (room-named rooms name)
  (or (find (lambda (r) (equal? (space-name r) name)) (rooms-of 'room-named rooms))
      (error 'room-named "no room has the name ~s; the names are ~s" name (map space-name rooms))))

; Returns true if a door, or an opening down to the floor, connects the rooms.
(define (rooms-connected? a b)
  (let ((other (space-name (space-of 'rooms-connected? b))))
    (any (lambda (g) (and (gap-way? g) (or (equal? (gap-right g) other) (equal? (gap-left g) other))))
      (if (equal? other (space-name (space-of 'rooms-connected? a))) '() (space-gaps a)))))

; Returns the area of windows and openings to the outside, as a part of the floor's area.
(define (daylight-ratio r)
  (let ((open (filter (lambda (g) (and (not (gap-way? g)) (not (and (gap-right g) (gap-left g))))) (space-gaps (space-of 'daylight-ratio r)))))
    (/ (apply + (map gap-area open)) (room-area r))))

; ---- clear width ----

; Returns the sides of a room, each as a pair of points with the room on its left.
(define (sides-of r)
  (append-map
    (lambda (loop outer?)
      (let ((l (if (eq? outer? (> (turn loop) 0)) loop (reverse loop)))) (map cons l (append (cdr l) (list (car l))))))
    (space-loops r) (cons #t (map (lambda (l) #f) (cdr (space-loops r))))))

(define facing (- (cos (degrees->radians 30)))) ; sides face each other up to this product of their directions

; Returns the distance between two sides where they face each other, or #f.
(define (side-distance s t)
  (let* ((v (way (car s) (cdr s))) (over (lambda (p) (dot v (p->q (car s) p)))) (off (lambda (p) (cross-2d v (p->q (car s) p))))
         (a (over (cdr t))) (b (over (car t))) (l (distance (car s) (cdr s))) (from (max 0 a)) (to (min l b)))
    (and (< (dot v (way (car t) (cdr t))) facing) (> (- to from) nearly)
         (let* ((height (lambda (x) (let ((k (/ (- x a) (- b a)))) (+ (* (- 1 k) (off (cdr t))) (* k (off (car t)))))))
                (least (min (height from) (height to))))
           (and (> least nearly) least)))))

; Returns the least distance of walls that face each other within 30 degrees; without such walls, the largest circle's diameter.
(define (room-width r)
  (let ((found (append-map (lambda (rest) (filter-map (lambda (t) (side-distance (car rest) t)) (cdr rest))) (tails (sides-of (space-of 'room-width r))))))
    (if (pair? found) (apply min found)
        (let ((middle (region-middle (room-region r))))
          (* 2 (apply min (map (lambda (l) (call-with-values (lambda () (distance-along (append l (list (car l))) (flat middle))) (lambda (s d) d))) (space-loops r))))))))
(define (tails l) (if (null? l) '() (cons l (tails (cdr l)))))

; ---- ways to exits ----

; Returns the length of the way from the farthest place of the room through doors to the nearest door to the outside; +inf.0
; if there is none. Places are the room's corners and a grid.
(define (exit-distance r rooms)
  (let* ((all (rooms-of 'exit-distance rooms)) (ways (filter gap-way? (all-gaps (cons (space-of 'exit-distance r) all))))
         (exits (filter-map (lambda (g) (and (not (and (gap-right g) (gap-left g))) (gap-at g))) ways)))
    (if (null? exits) +inf.0
        (let* ((area (unite (map room-region all) (map (lambda (g) (make-region (make-polygon (map (lambda (p) (xyz (cx p) (cy p) (space-base r))) (gap-outline g))))) ways)))
               (loops (map (lambda (c) (car (object-arguments c))) (outline area)))
               (plan (list (append-map values loops) (list->vector (map length loops)) (make-vector (length loops) 0)))
               (places (apply core:plan-ways (append plan (list exits '()))))
               (far (lambda (p) (let ((way (apply core:plan-way (append plan (list places p))))) (if way (first way) +inf.0)))))
          (apply max (map far (places-in r)))))))

; Returns the corners of a room and points of a grid within it, each point a fortieth of the longer side from the next.
(define (places-in r)
  (let* ((outer (car (space-loops r))) (xs (map cx outer)) (ys (map cy outer)) (region (room-region r)) (z (space-base r))
         (d (/ (max (- (apply max xs) (apply min xs)) (- (apply max ys) (apply min ys))) 40)))
    (append (apply append (space-loops r))
      (filter (lambda (p) (contains? region p))
        (append-map (lambda (x) (map (lambda (y) (xyz x y z)) (range (apply min ys) (apply max ys) d))) (range (apply min xs) (apply max xs) d))))))
