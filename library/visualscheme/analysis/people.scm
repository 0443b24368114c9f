; People: how fast a crowd walks and leaves, rooms cut from a model, places where a wheelchair turns, areas by use.

; ---- crowds, by the SFPE Handbook of Fire Protection Engineering ("Employing the hydraulic model in assessing emergency
; movement"): speed k (1 - a D), flow by density and effective width ----

; kind, factor k in m/s, and the strip along each side, in m, that nobody uses
(define passages '((door 1.4 0.15) (corridor 1.4 0.2) (ramp 1.4 0.2) (stair 1.08 0.15)))
(define crowding 0.266) ; a, in m2 for each person
(define (passage who kind) (or (assq kind passages) (error who "kind must be one of ~s, got ~s" (map car passages) kind)))

(define (walking-speed density #:kind [kind any? 'corridor])
  (if (not (and (real? density) (>= density 0))) (error 'walking-speed "density must be a number of 0 or more, got ~s" density))
  (if (> density 3.76) (warn (format "walking-speed: nobody moves among ~a persons a square metre" density)))
  (max 0 (* (second (passage 'walking-speed kind)) (- 1 (* crowding (max 0.54 density))))))

; Returns the seconds in which a crowd passes a width, at the greatest flow or that of a density.
(define (flow-time people width #:kind [kind any? 'door] #:density [density any? #f])
  (need-positive 'flow-time 'width width)
  (if (not (and (real? people) (>= people 0))) (error 'flow-time "people must be a number of 0 or more, got ~s" people))
  (let* ((p (passage 'flow-time kind)) (free (- width (* 2 (third p)))) (d (or density (/ 1 2 crowding))) (flow (* (second p) d (- 1 (* crowding d)))))
    (if (<= free 0) (error 'flow-time "a ~a of ~a m is too narrow: ~a m at its sides are not used" kind width (* 2 (third p))))
    (if (<= flow 0) (error 'flow-time "nobody moves among ~a persons a square metre" density))
    (/ people flow free)))

; Returns the seconds until all are out. crowds: lists of a point and a number of people; exits: lists of an exit, as egress
; took it, and its width. Each crowd goes its shortest way.
(define (egress-time r crowds exits #:density [density any? 1])
  (need-egress 'egress-time r)
  (if (not (and (pair? crowds) (every (lambda (c) (and (list? c) (= (length c) 2) (point? (first c)) (real? (second c)) (>= (second c) 0))) crowds)))
      (error 'egress-time "crowds must be lists of a point and a number of people, got ~s" crowds))
  (if (not (and (pair? exits) (every (lambda (e) (and (list? e) (= (length e) 2))) exits))) (error 'egress-time "exits must be lists of an exit and its width, got ~s" exits))
  (let* ((doors (map (lambda (e) (need-positive 'egress-time 'width (second e)) (list (opening 'egress-time 'exits (first e)) (second e))) exits)) (speed (walking-speed density))
         (ways (map (lambda (c)
                      (let* ((way (or (way-from 'egress-time r (first c)) (error 'egress-time "there is no way out from ~s" (first c)))) (end (last (way-points r (first c) way))))
                        (list (argument-of-least (lambda (d) (vlength (let ((v (p->q (first d) end))) (vxyz (cx v) (cy v) 0)))) doors) (/ (first way) speed) (second c))))
                 crowds)))
    (apply max
      (map (lambda (d)
             (let ((mine (filter (lambda (w) (and (eq? (first w) d) (> (third w) 0))) ways)))
               (if (null? mine) 0
                   (max (apply max (map second mine)) (+ (apply min (map second mine)) (flow-time (apply + (map third mine)) (second d)))))))
        doors))))
(define (argument-of-least f l) (fold (lambda (x best) (if (< (f x) (f best)) x best)) (car l) (cdr l)))

; ---- rooms of a cut ----

; Returns the filled parts of regions, without what lies in their holes twice: a list of regions with their holes.
(define (parts-of region)
  (let* ((loops (map corners-of (outline region))) (as-region (lambda (l) (make-region (apply make-polygon l))))
         (within? (lambda (a b) (and (not (eq? a b)) (contains? (as-region b) (interior-of a)))))
         (depth (lambda (l) (length (filter (lambda (o) (within? l o)) loops)))))
    (filter-map (lambda (l) (and (even? (depth l))
                                 (let ((holes (filter (lambda (h) (and (within? h l) (= (depth h) (+ 1 (depth l))))) loops)))
                                   (if (null? holes) (as-region l) (subtract (as-region l) (map as-region holes))))))
      loops)))
; Returns a point within a polygon, next to its first side.
(define (interior-of l)
  (let* ((region (make-region (apply make-polygon l))) (a (first l)) (b (second l)) (side (cross (vxyz 0 0 1) (p->q a b))))
    (let loop ((k 1e-3))
      (let ((p (p+v (mid a b) (v*r side k))) (q (p+v (mid a b) (v*r side (- k))))) (cond ((contains? region p) p) ((contains? region q) q) ((> k 1e-9) (loop (/ k 10))) (else (mid a b)))))))

; Returns the rooms and the doors of walls: two lists of regions in the plane z = low. Where a wall is at the height `high`
; but not at `low`, there is a door.
(define (rooms-of-cut walls #:low [low any? 1] #:high [high any? 2.3])
  (for-each (lambda (name x) (need-number 'rooms-of-cut name x)) '(low high) (list low high))
  (if (>= low high) (error 'rooms-of-cut "low must be below high, got ~s and ~s" low high))
  (let* ((solid (if (list? walls) (apply unite walls) walls)) (box (or (bounding-box solid) (error 'rooms-of-cut "the walls are empty")))
         (no-wall (lambda (z) (error 'rooms-of-cut "no wall is at the height ~a" z))) (check (for-each (lambda (z) (if (not (< (cz (first box)) z (cz (second box)))) (no-wall z))) (list low high))) (cut (lambda (z) (do-section solid (make-plane (xyz 0 0 z) (vxyz 0 0 1)))))
         (above (do-move (cut high) (vxyz 0 0 (- low high)))) (below (cut low)))
    (if (or (empty-object? above) (empty-object? below)) (no-wall (if (empty-object? above) high low)))
    (let* ((loops (map corners-of (outline above))) (filled (apply unite (map (lambda (l) (make-region (apply make-polygon l))) loops))) (inside (subtract filled above)) (gaps (subtract above below)))
      (list (if (empty-object? inside) '() (parts-of inside)) (if (empty-object? gaps) '() (parts-of gaps))))))

; ---- wheelchairs ----

; Returns the region of a room that a circle of this diameter reaches; empty where no wheelchair turns.
(define (turning-area room #:diameter [d any? 1.5])
  (need-positive 'turning-area 'diameter d)
  (let* ((region (region-of 'turning-area room)) (box (bounding-box region)) (far (vxyz (* 2 d) (* 2 d) 0))
         (outside (subtract (make-region (make-rectangle (p-v (first box) far) (p+v (second box) far))) region))
         (centres (subtract region (do-offset outside (/ d 2) #:corners 'round))))
    (if (or (empty-object? centres) (< (area centres) 1e-9)) (empty-object) (intersect region (do-offset centres (/ d 2) #:corners 'round)))))

; ---- areas by use ----

; Uses of DIN 277: usable areas 1 to 7, technical areas, and areas for traffic.
(define room-uses '(nuf1 nuf2 nuf3 nuf4 nuf5 nuf6 nuf7 tf vf))

; Returns rows of a use and its area, with sums. rooms: lists of a use and a room or an area.
(define (areas-by-use rooms #:gross [gross any? #f])
  (if (not (and (list? rooms) (every (lambda (r) (and (list? r) (= (length r) 2))) rooms))) (error 'areas-by-use "rooms must be lists of a use and a room, got ~s" rooms))
  (if gross (need-positive 'areas-by-use 'gross gross))
  (for-each (lambda (r) (if (not (memq (first r) room-uses)) (error 'areas-by-use "a use must be one of ~s, got ~s" room-uses (first r)))) rooms)
  (let* ((size (lambda (r) (if (real? (second r)) (second r) (area (region-of 'areas-by-use (second r))))))
         (sum (lambda (uses) (apply + (map size (filter (lambda (r) (memq (first r) uses)) rooms))))) (net (sum room-uses)))
    (append (filter-map (lambda (u) (and (assq u rooms) (list u (sum (list u))))) room-uses)
      (list (list 'nuf (sum (take room-uses 7))) (list 'nrf net))
      (if gross (begin (if (< gross net) (warn (format "areas-by-use: the rooms have ~a m2, more than the gross area of ~a m2" net gross))) (list (list 'kgf (- gross net)) (list 'bgf gross))) '()))))
