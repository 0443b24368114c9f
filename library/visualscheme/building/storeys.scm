; Slabs, columns, beams, stairs, ramps and railings.

(define (check-point who name p) (if (not (point? p)) (error who "~a must be a point, got ~s" name p)))

; Returns the loops of points of an outline: lists of points, closed curves, or lists of these.
(define (outline-loops who outline)
  (define (loop-points o)
    (cond ((curve? o) (let ((points (curve-samples o))) (if (meet? (car points) (last points)) (cdr points) (error who "the outline must be closed, got ~s" o))))
          ((and (list? o) (pair? o) (every point? o)) o)
          (else (error who "outline must be points or a closed curve, or a list of these, got ~s" outline))))
  (loops-of who (if (or (curve? outline) (and (pair? outline) (point? (car outline)))) (list (loop-points outline))
                    (if (list? outline) (map loop-points outline) (loop-points outline)))))

; An object with its class of IFC.
(define-primitive (element [class any?] [body any?]) body)

(define (slab outline #:layers [layers any? 0.2] #:holes [holes any? '()])
  (let* ((layers (layers-of 'slab layers))
         (loops (append (outline-loops 'slab outline) (if (null? holes) '() (outline-loops 'slab holes)))) (top (cz (caar loops))))
    (check-uncrossed 'slab loops)
    (element "slab"
      (unite (map (lambda (l down) (in-material (second l) (area-solid loops (- top down (first l)) (- top down))))
               layers (drop-right (sums 0 (map first layers)) 1))))))

; Returns width and depth of a section: a number, or a list of two.
(define (section-size who size)
  (cond ((positive-number? size) (list size size))
        ((and (list? size) (= (length size) 2) (every positive-number? size)) size)
        (else (error who "size must be a positive number or a list of two, got ~s" size))))

(define (column place #:height [height any? 2.75] #:size [size any? 0.3] #:turn [turn any? 0] #:material [material any? #f])
  (check-point 'column "place" place)
  (check-positive 'column "height" height)
  (check-number 'column "turn" turn)
  (element "column"
   (in-material material
    (if (curve? size) (do-move (do-extrude size height) (p->q origin place))
        (let* ((s (section-size 'column size)) (w (/ (first s) 2)) (d (/ (second s) 2)))
          (do-move (do-rotate (make-box (xyz (- w) (- d) 0) (xyz w d height)) 'z turn) (p->q origin place)))))))

; A beam hangs below the line from p to q.
(define (beam p q #:size [size any? '(0.2 0.4)] #:material [material any? #f])
  (check-point 'beam "p" p)
  (check-point 'beam "q" q)
  (if (meet? p q) (error 'beam "the ends of the beam must differ, got ~s" p))
  (let* ((s (section-size 'beam size)) (u (unitize (p->q p q))) (level? (< (abs (cz u)) 0.999999))
         (side (if level? (unitize (cross uz u)) uy)) (down (v*r (cross u side) (- (second s)))) (half (v*r side (/ (first s) 2))))
    (element "beam" (in-material material
      (hull (append-map (lambda (e) (list (p+v e half) (p-v e half) (p+v (p+v e half) down) (p+v (p-v e half) down))) (list p q)))))))

; Stairs.

(define (rule-of who rule)
  (cond ((eq? rule '2r+t) 0.63) ((or (not rule) (positive-number? rule)) rule)
        (else (error who "rule must be '2r+t (0.63), a length or #f, got ~s" rule))))

(define most-parts 10000) ; of a stair or a railing: a number beyond comes from a slip in a length

; Returns the number of rises whose treads, of lengths that the procedure goings returns, fit the rule best.
(define (best-rises who rise rule goings)
  (define (misfit n)
    (let ((found (goings n)))
      (if found (apply max (map (lambda (t) (abs (- (+ (* 2 (/ rise n)) t) (or rule 0.63)))) found)) +inf.0)))
  (let* ((least (max 2 (exact (ceiling (- (/ rise 0.21) 1e-9))))) (most (exact (floor (/ rise 0.14)))) (all (iota (max 1 (- most least -1)) least)) (best (argmin misfit all)))
    (if (and (not rule) (= (misfit best) +inf.0)) (error who "a rise of ~a is too low for the flights of this stair" (shown rise)))
    (if (> (misfit best) (if rule 0.06 1e300))
        (error who "no number of steps makes twice the rise and the tread ~a, give or take 0.06, for a rise of ~a: move the head, or pass #:rule #f"
          rule (shown rise)))
    best))

; Returns a flight of n treads from p in the direction v: steps above, a slope below, which a floor cuts off.
(define (flight p v n rise going width waist floor?)
  (let* ((end (* n going)) (from (/ (* waist going) rise))
         (outline (append (list (cons 0 0))
                          (append-map (lambda (i) (list (cons (* i going) (* (+ i 1) rise)) (cons (* (+ i 1) going) (* (+ i 1) rise)))) (iota n))
                          (cond ((not floor?) (list (cons end (- (* n rise) waist)) (cons 0 (- waist))))
                                ((< from end) (list (cons end (- (* n rise) waist)) (cons from 0)))
                                (else (list (cons end 0))))))
         (start (aside p v (/ width -2))))
    (do-extrude (make-polygon (map (lambda (o) (+z (p+v start (v*r v (car o))) (cdr o))) outline)) (v*r (left v) width))))

; Returns a plate below the points, which lie in one height.
(define (landing points thickness) (do-extrude (make-polygon points) (- thickness)))

(define (straight-stair from to width rule waist)
  (let* ((rise (- (cz to) (cz from))) (l (distance (flat from) (flat to))))
    (if (< l nearly) (error 'stair "head and foot of a straight stair must not lie above each other"))
    (let ((n (best-rises 'stair rise rule (lambda (n) (list (/ l (- n 1)))))))
      (list (flight from (way from to) (- n 1) (/ rise n) (/ l (- n 1)) width waist #t) from to))))

; Two flights with a landing at the corner.
(define (cornered-stair from to width rule waist turn)
  (let* ((rise (- (cz to) (cz from))) (a (xyz (cx to) (cy from) (cz from))) (b (xyz (cx from) (cy to) (cz from)))
         (corner (if (eq? (> (cross-2d (p->q from a) (p->q a to)) 0) (eq? turn 'left)) a b))
         (l1 (- (distance from corner) (/ width 2))) (l2 (- (distance corner (xyz (cx to) (cy to) (cz from))) (/ width 2))))
    (if (or (<= l1 0) (<= l2 0)) (error 'stair "the flights of the stair must be longer than half its width"))
    (let* ((first-treads (lambda (n) (max 1 (min (- n 3) (exact (round (/ (* (- n 2) l1) (+ l1 l2))))))))
           (n (best-rises 'stair rise rule
                (lambda (n) (and (> n 3) (list (/ l1 (first-treads n)) (/ l2 (- n 2 (first-treads n))))))))
           (n1 (first-treads n)) (n2 (- n 2 n1)) (r (/ rise n)) (v (way from corner)) (w (way corner to)) (h (/ width 2))
           (high (+z corner (* (+ n1 1) r))) (at (lambda (a b) (aside (p+v high (v*r v a)) v b))))
      (list (unite (flight from v n1 r (/ l1 n1) width waist #t)
                   (landing (list (at (- h) (- h)) (at h (- h)) (at h h) (at (- h) h)) (+ waist r))
                   (flight (p+v high (v*r w h)) w n2 r (/ l2 n2) width waist #f))
            from (p+v high (v*r v (- h))) high (p+v high (v*r w h)) to))))

(define (at-rule rise n rule)
  (let ((t (- (or rule 0.63) (* 2 (/ rise n)))))
    (if (< 0.2 t 0.4) t (error 'stair "a rise of ~a makes ~a steps with treads of ~a: pass another #:rule" (shown rise) n (shown t)))))

; Two flights side by side, and a landing at their far ends.
(define (returning-stair from to width rule waist turn)
  (let* ((rise (- (cz to) (cz from))) (side (p->q (flat from) (flat to))) (gap (vlength side)))
    (if (< gap (- width nearly)) (error 'stair "the flights of a stair of ~a overlap: head and foot are ~a apart" width (shown gap)))
    (let* ((v (let ((s (left (unitize side)))) (if (eq? turn 'left) (turned-back s) s)))
           (n (argmin (lambda (n) (abs (- (/ rise n) 0.17))) (iota (+ 1 (exact (ceiling (/ rise 0.34)))) 4 2)))
           (treads (- (quotient n 2) 1)) (r (/ rise n)) (t (at-rule rise n rule)) (l (* treads t)) (h (/ width 2))
           (high (+z (p+v from (v*r v l)) (* (+ treads 1) r))) (s (unitize side))
           (at (lambda (a b) (p+v (p+v high (v*r v a)) (v*r s b)))))
      (list (unite (flight from v treads r t width waist #t)
                   (landing (list (at 0 (- h)) (at width (- h)) (at width (+ gap h)) (at 0 (+ gap h))) (+ waist r))
                   (flight (at 0 gap) (turned-back v) treads r t width waist #f))
            from (at 0 0) (at h 0) (at h gap) (at 0 gap) to))))

; Treads around the middle between foot and head, and a newel if there is little room, with as many full turns as the rule needs.
(define (winding-stair from to width rule waist turn)
  (let* ((rise (- (cz to) (cz from))) (c (mid (flat from) (flat to))) (radius (distance c (flat from))) (sign (if (eq? turn 'left) 1 -1)))
    (if (< radius (+ (/ width 2) 0.05)) (error 'stair "a spiral stair of width ~a needs foot and head ~a apart, or more" width (+ width 0.1)))
    (let* ((tread (lambda (turns n) (/ (* radius pi (+ 1 (* 2 turns))) (- n 1))))
           (fit (lambda (turns) (lambda (n) (list (tread turns n)))))
           (misfit (lambda (turns)
                     (let ((n (best-rises 'stair rise #f (fit turns)))) (abs (- (+ (* 2 (/ rise n)) (tread turns n)) (or rule 0.63))))))
           (turns (argmin misfit '(0 1 2 3 4))) (n (best-rises 'stair rise rule (fit turns)))
           (r (/ rise n)) (step (/ (* pi (+ 1 (* 2 turns))) (- n 1))) (a0 (pol-phi (p->q c (flat from)))) (inner (- radius (/ width 2))) (outer (+ radius (/ width 2)))
           (at (lambda (rho i) (+pol c rho (+ a0 (* sign step i))))) (shares (division 0 1 4)))
      (cons (unite (map (lambda (i)
                    (area-solid (list (append (map (lambda (s) (at outer (+ i s))) shares) (reverse (map (lambda (s) (at inner (+ i s))) shares))))
                      (+ (cz from) (max 0 (- (* i r) waist))) (+ (cz from) (* (+ i 1) r))))
               (iota (- n 1)))
             (if (< inner 0.3) (make-cylinder (+z c (cz from)) (+ rise 1) inner) '()))
            (map (lambda (i) (+z (at radius i) (+ (cz from) (* i r)))) (iota n))))))

; made: the solid of a stair, then its walking line, points from the foot to the head.
(define-primitive (stair-object [made any?]) (car made))

(define (stair from to #:kind [kind any? 'straight] #:width [width any? 1] #:rule [rule any? '2r+t] #:turn [turn any? 'left] #:waist [waist any? 0.15])
  (check-point 'stair "from" from)
  (check-point 'stair "to" to)
  (check-positive 'stair "width" width)
  (check-positive 'stair "waist" waist)
  (if (not (memq turn '(left right))) (error 'stair "turn must be 'left or 'right, got ~s" turn))
  (if (<= (cz to) (cz from)) (error 'stair "the foot of the stair must be below its head, got ~s and ~s" from to))
  (if (> (- (cz to) (cz from)) (* 0.14 most-parts)) (error 'stair "a rise of ~a needs more than ~a steps" (shown (- (cz to) (cz from))) most-parts))
  (let ((rule (rule-of 'stair rule)))
    (stair-object
      (case kind
        ((straight) (straight-stair from to width rule waist))
        ((L) (cornered-stair from to width rule waist turn))
        ((U) (returning-stair from to width rule waist turn))
        ((spiral) (winding-stair from to width rule waist turn))
        (else (error 'stair "kind must be 'straight, 'L, 'U or 'spiral, got ~s" kind))))))

(define (ramp from to #:width [width any? 1.2] #:slope [slope any? 0.06] #:thickness [thickness any? 0.2])
  (check-point 'ramp "from" from)
  (check-point 'ramp "to" to)
  (for-each (lambda (n x) (check-positive 'ramp n x)) '("width" "slope" "thickness") (list width slope thickness))
  (let* ((l (distance (flat from) (flat to))) (rise (- (cz to) (cz from))))
    (if (< l nearly) (error 'ramp "the ends of the ramp must not lie above each other, got ~s and ~s" from to))
    (if (> (abs rise) (* l (+ slope 1e-9)))
        (error 'ramp "the ramp rises ~a on a length of ~a: a slope of ~a needs ~a" (shown rise) (shown l) slope (shown (/ (abs rise) slope))))
    (let* ((v (way from to)) (side (lambda (p) (aside p v (/ width -2)))) (a (side from)) (b (side to)))
      (element "ramp" (do-extrude (make-polygon a b (+z b (- thickness)) (+z a (- thickness))) (v*r (left v) width))))))

(define (railing path #:height [height any? 1] #:spacing [spacing any? 1] #:rails [rails any? 2] #:radius [radius any? 0.02])
  (for-each (lambda (n x) (check-positive 'railing n x)) '("height" "spacing" "radius") (list height spacing radius))
  (if (not (and (exact-integer? rails) (>= rails 0))) (error 'railing "rails must be a whole number of 0 or more, got ~s" rails))
  (let* ((points (without-meeting (cond ((curve? path) (curve-samples path)) ((and (list? path) (every point? path)) path) (else '()))))
         (long? (or (> (length points) 1) (error 'railing "path must be a curve, or a list of two points or more, got ~s" path)))
         (few? (or (< (points-length points) (* most-parts spacing)) (error 'railing "a spacing of ~a makes more than ~a posts" spacing most-parts)))
         (corner? (lambda (i) (or (= i 0) (= i (- (length points) 1))
                                  (> (angle-between (p->q (list-ref points (- i 1)) (list-ref points i)) (p->q (list-ref points i) (list-ref points (+ i 1)))) 0.3))))
         (stops (map (lambda (i) (points-length (take points (+ i 1)))) (filter corner? (iota (length points)))))
         (feet (append (append-map (lambda (a b)
                                     (let ((n (max 1 (exact (ceiling (- (/ (- b a) spacing) 1e-9))))))
                                       (map (lambda (s) (place-in-space points s)) (division a b n #f))))
                         stops (cdr stops))
                       (list (last points))))
         (bar (lambda (z r) (unite (map (lambda (a b) (make-capsule (+z a z) (+z b z) r)) points (cdr points))))))
    (element "railing"
      (unite (map (lambda (p) (make-cylinder p height (* 0.8 radius))) feet)
             (bar height radius)
             (map (lambda (i) (bar (/ (* height (+ i 1)) (+ rails 1)) (/ radius 2))) (iota rails))))))
(define (place-in-space points s)
  (let ((l (distance (car points) (cadr points))))
    (if (or (<= s l) (null? (cddr points))) (intermediate-point (car points) (cadr points) (/ s l)) (place-in-space (cdr points) (- s l)))))
