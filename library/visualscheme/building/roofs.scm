; Roofs over outlines: planes that rise inwards from the edges, by the straight skeleton. An edge moves inwards by the
; cotangent of its pitch for each unit of height. The edge of a gable does not move.

(define (loops-of who outline)
  (define (open-loop l) (if (and (list? l) (pair? l) (every point? l) (pair? (cdr l)) (meet? (car l) (last l))) (drop-right l 1) l))
  (let ((loops (if (and (pair? outline) (point? (car outline))) (list (open-loop outline)) (if (list? outline) (map open-loop outline) outline))))
    (if (not (and (pair? loops) (list? loops) (every (lambda (l) (and (list? l) (every point? l) (> (length l) 2))) loops)))
        (error who "outline must be a list of three points or more, or a list of such lists, got ~s" outline))
    (let ((z (cz (caar loops))))
      (if (not (every (lambda (l) (every (lambda (p) (near? (cz p) z)) l)) loops))
          (error who "the points of outline must have one height, got ~s" outline)))
    (check-uncrossed who loops)
    loops))

; Fails if an edge of the loops crosses another one; loops may touch. Edges in order of their least X: only those that overlap in X are compared.
(define (check-uncrossed who loops)
  (define (compare e f)
    (let ((x (segments-cross (first e) (second e) (first f) (second f) 0)))
      (if (and x (< 1e-9 (first x) (- 1 1e-9)) (< 1e-9 (second x) (- 1 1e-9)))
          (error who "~a at ~s" (if (eq? (third e) (third f)) "the outline crosses itself" "two loops of the outline cross") (third x)))))
  (define (low e) (min (cx (first e)) (cx (second e))))
  (define (high e) (max (cx (first e)) (cx (second e))))
  (let each ((edges (sort (append-map (lambda (l) (map (lambda (p q) (list p q l)) l (append (cdr l) (list (car l))))) loops) < #:key low)))
    (if (pair? edges)
        (let ((e (car edges)))
          (let next ((l (cdr edges)))
            (if (and (pair? l) (<= (low (car l)) (high e))) (begin (compare e (car l)) (next (cdr l)))))
          (each (cdr edges))))))

; Returns the pitch of each of n edges, #f for a gable.
(define (pitches-of who pitch gables n)
  (define (good? p) (and (real? p) (< 0 p (/ pi 2))))
  (let ((each (if (list? pitch) pitch (make-list n pitch))))
    (if (not (every good? each)) (error who "pitch must be radians between 0 and pi/2, or a list of them, got ~s; (degrees->radians 35) is 35 degrees" pitch))
    (if (not (= (length each) n)) (error who "pitch must be ~a numbers, one for each edge, got ~a" n (length each)))
    (if (not (and (list? gables) (every (lambda (g) (and (exact-integer? g) (<= 1 g n))) gables)))
        (error who "gables must be numbers of edges from 1 to ~a, got ~s" n gables))
    (map (lambda (p i) (if (memv i gables) #f p)) each (iota n 1))))

(define (speed p) (if p (/ 1 (tan p)) 0))

; Returns the way from p to q of length 1, and the turn of it to the left.
(define (way p q) (unitize (vxyz (- (cx q) (cx p)) (- (cy q) (cy p)) 0)))
(define (left v) (vxyz (- (cy v)) (cx v) 0))

; Returns twice the area of a loop, positive if it is counter-clockwise.
(define (turn loop)
  (let ((p (car loop)))
    (apply + (map (lambda (a b) (- (* (- (cx a) (cx p)) (- (cy b) (cy p))) (* (- (cx b) (cx p)) (- (cy a) (cy p)))))
               loop (append (cdr loop) (list p))))))

(define (inside? p loop)
  (odd? (count (lambda (a b)
                 (and (not (eq? (> (cy a) (cy p)) (> (cy b) (cy p))))
                      (< (cx p) (+ (cx a) (/ (* (- (cy p) (cy a)) (- (cx b) (cx a))) (- (cy b) (cy a)))))))
          loop (append (cdr loop) (list (car loop))))))

; Returns the loop with each edge moved outwards by its distance; sign is 1 if the inside is on the left of the edges.
; Fails if an edge would turn round.
(define (widened who loop sign distances)
  (define (corner p before after d e)
    (let* ((m (v*r (left before) (- sign))) (n (v*r (left after) (- sign))) (k (- (* (cx m) (cy n)) (* (cy m) (cx n)))))
      (if (< (abs k) 1e-9) (p+v p (v*r n e))
          (+xy p (/ (- (* d (cy n)) (* e (cy m))) k) (/ (- (* (cx m) e) (* (cx n) d)) k)))))
  (let* ((next (append (cdr loop) (list (car loop)))) (ways (map way loop next)) (turned (lambda (l) (cons (last l) (drop-right l 1)))))
    (let* ((wide (map corner loop (turned ways) ways (turned distances) distances)))
      (for-each (lambda (p w a b)
                  (if (<= (dot w (p->q a b)) 0) (error who "the overhang closes the outline at ~s: make it less" p)))
        loop ways wide (append (cdr wide) (list (car wide))))
      wide)))

(define (split l sizes) (if (null? sizes) '() (cons (take l (car sizes)) (split (drop l (car sizes)) (cdr sizes)))))

; Tests a mansard: #f, or a list of the height of the break and the pitch above it.
(define (check-mansard who m)
  (if (not (or (not m) (and (list? m) (= (length m) 2) (positive-number? (first m)) (real? (second m)) (< 0 (second m) (/ pi 2)))))
      (error who "mansard must be a list of the height of the break and the pitch above it, in radians between 0 and pi/2, got ~s" m)))

; Returns the faces of a roof: lists of the number of the edge, or #f, and of points.
(define (faces who outline pitch gables overhang mansard)
  (if (not (and (real? overhang) (finite? overhang) (>= overhang 0))) (error who "overhang must be a number of 0 or more, got ~s" overhang))
  (check-mansard who mansard)
  (let* ((loops (loops-of who outline)) (sizes (map length loops)) (pitches (pitches-of who pitch gables (apply + sizes)))
         (flattest (apply min (/ pi 2) (filter values pitches)))
         ; the eaves are level: they lie as far below the outline as the flattest plane falls on its overhang
         (fall (if (= flattest (/ pi 2)) 0 (* overhang (tan flattest))))
         (distances (map (lambda (p) (if p (/ fall (tan p)) overhang)) pitches))
         (z (- (cz (caar loops)) fall))
         (sign (lambda (loop)
                 (let ((holes (count (lambda (l) (and (not (eq? l loop)) (inside? (car loop) l))) loops)))
                   (if (eq? (> (turn loop) 0) (even? holes)) 1 -1))))
         (wide (if (> overhang 0) (map (lambda (l d) (widened who l (sign l) d)) loops (split distances sizes)) loops))
         (plain (straight-skeleton wide (map speed pitches))))
    (map (lambda (face) (cons (car face) (map (lambda (p) (xyz (cx p) (cy p) (+ z (cz p)))) (cdr face))))
         (if mansard (broken who plain (+ (first mansard) fall) (lambda (edge) (if (and edge (list-ref pitches (- edge 1))) (/ 1 (tan (second mansard))) 0)))
             plain))))

(define (roof-faces outline #:pitch [pitch any? (degrees->radians 35)] #:gables [gables any? '()] #:overhang [overhang any? 0] #:mansard [mansard any? #f])
  (faces 'roof-faces outline pitch gables overhang mansard))

; A mansard: the faces below the break, and above it the skeleton of the level outline at the break.

; Returns the faces with those above the height replaced; speed-of returns the speed of an edge above the break.
(define (broken who faces height speed-of)
  (let* ((known '())
         (one (lambda (p) ; returns the point that faces share
                (or (find (lambda (k) (< (distance k p) 1e-7)) known) (begin (set! known (cons p known)) p))))
         (low (map (lambda (f) (below f height one)) faces))
         (segments (append-map second low))
         (loops (chained-loops (map cdr segments)))
         (edge-from (lambda (p) (car (find (lambda (s) (eq? (second s) p)) segments))))
         (edges (append-map (lambda (l) (map edge-from l)) loops))
         (foot (lambda (p) (xy (cx p) (cy p)))))
    (if (null? loops) faces
        (let* ((lower (filter (lambda (f) (> (length f) 3)) (map first low)))
               (upper (map (lambda (f)
                             (cons (and (car f) (list-ref edges (- (car f) 1)))
                                   (map (lambda (p)
                                          (let ((q (xyz (cx p) (cy p) (+ height (cz p))))) (if (< (cz p) 1e-9) (one q) q)))
                                     (cdr f))))
                           (straight-skeleton (map (lambda (l) (map foot l)) loops) (map speed-of edges))))
               (gable? (lambda (f) (and (car f) (= 0 (speed-of (car f)))))))
          (append (fold (lambda (f lower) (map (lambda (g) (if (eqv? (car f) (car g)) (raised-gable g f) g)) lower)) lower (filter gable? upper))
                  (remove gable? upper))))))

; Returns the gable's lower part g with the upper part f, if they have an edge in common.
(define (raised-gable g f)
  (define (from p l) (let ((i (list-index (lambda (q) (eq? q p)) l))) (append (drop l i) (take l i))))
  (let* ((l (cdr g))
         (a (find (lambda (p) (and (memq p (cdr f)) (memq (cadr (append (from p l) (list p))) (cdr f)))) l)))
    (if (not a) g
        (let ((rest (from a l))) (cons (car g) (append (drop-right (from a (cdr f)) 1) (cdr rest)))))))

; Returns the part of a face below the height, and its segments at the height as lists of the edge, start and end.
(define (below face height one)
  (define (above? p) (> (cz p) (+ height 1e-9)))
  (define (crossing p q) (let ((r (intermediate-point p q (/ (- height (cz p)) (- (cz q) (cz p)))))) (one (xyz (cx r) (cy r) height))))
  (let* ((points (cdr face)) (first-low (or (list-index (lambda (p) (not (above? p))) points) 0))
         (around (append (drop points first-low) (take points first-low))))
    (let loop ((l around) (kept '()) (left #f) (segments '()))
      (if (null? l) (list (cons (car face) (reverse kept)) segments)
          (let* ((p (car l)) (q (if (pair? (cdr l)) (cadr l) (car around))) (kept (if (above? p) kept (cons p kept))))
            (cond ((and (not (above? p)) (above? q)) (let ((x (crossing p q))) (loop (cdr l) (cons x kept) x segments)))
                  ((and (above? p) (not (above? q)))
                   (let ((x (crossing p q)))
                     (if (eq? x left) (loop (cdr l) kept #f segments)
                         (loop (cdr l) (cons x kept) #f (cons (list (car face) left x) segments)))))
                  (else (loop (cdr l) kept left segments))))))))

; Returns the closed loops of segments, lists of start and end. Ends and starts are the same points.
(define (chained-loops segments)
  (if (null? segments) '()
      (let follow ((loop (list (caar segments))) (end (cadar segments)) (rest (cdr segments)))
        (let ((next (find (lambda (s) (eq? (first s) end)) rest)))
          (if next (follow (cons end loop) (second next) (remove (lambda (s) (eq? s next)) rest))
              (cons (reverse loop) (chained-loops rest)))))))

; Numbers points from 1 by their coordinates: returns the procedure that numbers, and one that returns all points.
(define (numbering)
  (let ((known (make-hash)) (all '()) (n 0))
    (values
      (lambda (p)
        (let ((key (list (cx p) (cy p) (cz p))))
          (or (hash-ref known key #f)
              (begin (set! n (+ n 1)) (set! all (cons p all)) (hash-set! known key n) n))))
      (lambda () (reverse all)))))

; Removes each element that equals the next one around the list.
(define (without-repeats l)
  (filter-map (lambda (a b) (if (equal? a b) #f a)) l (append (cdr l) (list (car l)))))

; Returns the solid of roof faces: above them their planes, below their projections. Where a face is vertical, its projection
; has no area: face and projection are one polygon, without the edge at the foot that both have.
(define (faces-solid all gables)
  (let* ((foot (apply min (append-map (lambda (f) (map cz (cdr f))) all)))
         (down (lambda (p) (xyz (cx p) (cy p) foot)))
         (level? (lambda (f) (and (car f) (not (memv (car f) gables)) (> (abs (turn (cdr f))) 1e-9)))))
    (call-with-values numbering
      (lambda (number points)
        (define (closed f)
          (let* ((top (map number (cdr f))) (low (map number (map down (cdr f)))))
            (if (level? f) (list top (without-repeats (reverse low)))
                (let* ((foot (map (lambda (a b) (if (= a b) a 0)) top low))
                       (next (append (cdr foot) (list (car foot))))
                       (at (or (list-index (lambda (a b) (and (> a 0) (> b 0))) foot next) (list-index positive? foot) 0))
                       (around (lambda (l) (append (drop l (+ at 1)) (take l (+ at 1))))))
                  (list (without-repeats (append (around top) (cdr (reverse (around low))))))))))
        (let* ((polygons (filter (lambda (p) (> (length p) 2)) (append-map closed all)))
               (solid (make-polyface-mesh (points) polygons)))
          (if (not (solid? solid))
              (error 'roof "parallel edges of unequal pitch make a vertical step, which has no solid: give them one pitch, or use roof-faces"))
          solid)))))

(define (roof outline #:pitch [pitch any? (degrees->radians 35)] #:gables [gables any? '()] #:overhang [overhang any? 0] #:mansard [mansard any? #f]
                      #:dormers [dormers any? '()] #:thickness [thickness any? #f])
  (if (not (or (not thickness) (and (real? thickness) (> thickness 0)))) (error 'roof "thickness must be a positive number, got ~s" thickness))
  (let* ((all (faces 'roof outline pitch gables overhang mansard)) (solid (faces-solid all gables))
         (top (apply max (append-map (lambda (f) (map cz (cdr f))) all)))
         (loops (loops-of 'roof outline)) (pitches (pitches-of 'roof pitch gables (apply + (map length loops))))
         (built (map (lambda (d) (dormer-solids d loops pitches mansard top (or thickness 0))) (dormers-of dormers))))
    (element "roof"
      (cond ((and (null? built) thickness) (subtract solid (do-move solid (vxyz 0 0 (- thickness)))))
            ((null? built) solid)
            (thickness
              (unite (subtract (unite solid (map first built)) (do-move solid (vxyz 0 0 (- thickness))) (map second built)) (map third built)))
            (else (unite solid (map first built)))))))
