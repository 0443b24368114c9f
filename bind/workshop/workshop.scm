; From the model to the workshop: the sun, contours, slices, ribs, terrain and tables. After probes.scm. Names that begin
; with % are hidden from programs. Compiled into the binary when it is built.

; ---- the sun ----

; Returns the hour between from and to at which (rise? hour) changes.
(define (%change-of rise? from to)
  (let ((first? (rise? from)))
    (let loop ((low from) (high to))
      (let ((middle (/ (+ low high) 2)))
        (cond ((< (- high low) 1e-9) middle)
              ((eq? (rise? middle) first?) (loop middle high))
              (else (loop low middle)))))))

; Returns the sun's way over the sky of one day, on a sphere about `center`: from sunrise to sunset, or a closed curve.
(define (sun-path #:latitude latitude #:longitude [longitude any? 0] #:date date
                  #:center [center any? origin] #:radius [radius any? 1])
  (%need-point 'sun-path 'center center)
  (%need-positive 'sun-path 'radius radius)
  (define (at hour) (%sun-path hour #:latitude latitude #:longitude longitude #:date date))
  (define (up? hour) (>= (cz (at hour)) 0))
  (define (place hour) (p+v center (v*r (at hour) radius)))
  (let* ((hours (map (lambda (i) (/ i 6)) (iota 145)))
         (lit (filter up? hours)))
    (cond
      ((null? lit)
       (%warn "sun-path: the sun does not rise on that day at that place: nothing is made (the empty object)")
       (empty-object))
      ((= (length lit) 145) (make-polygon (map place (iota 144 0 1/6))))
      (else
        ; the day may span midnight of mean local time: it begins after the last dark hour that a lit one follows
        (let* ((begin (or (find (lambda (h) (and (not (up? h)) (up? (+ h 1/6)))) hours) 0))
               (rise (%change-of up? begin (+ begin 1/6)))
               (end (or (find (lambda (h) (not (up? h))) (map (lambda (i) (+ begin (/ i 6))) (iota 144 2))) (+ begin 24)))
               (set (%change-of up? (- end 1/6) end))
               (middle (filter (lambda (h) (< (+ rise 1/60) h (- set 1/60))) (map (lambda (i) (+ begin (/ i 6))) (iota 144 1)))))
          (make-line (map place (append (list rise) middle (list set)))))))))

; Returns the hours of sun of a day at each of the points, by the sun in the middle of each step.
(define (solar-hours points normals #:latitude latitude #:longitude [longitude any? 0] #:date date
                     #:among [among any? '()] #:step [step any? 1/6] #:from [from any? 0] #:to [to any? 24])
  (%need-points 'solar-hours 'points (if (point? points) (list points) points) 0)
  (%need-positive 'solar-hours 'step step)
  (if (not (and (real? from) (real? to) (<= 0 from to 24) (< from to)))
      (error 'solar-hours "from and to must be hours from 0 to 24, from the earlier, got ~s and ~s" from to))
  (if (> (/ (- to from) step) 10000) (error 'solar-hours "step must be at least ~a hours, got ~s" (/ (- to from) 10000.) step))
  (let* ((places (if (point? points) (list points) points))
         (given (if (gvector? normals) (map (lambda (p) normals) places) normals)))
    (if (not (and (list? given) (every (lambda (v) (and (gvector? v) (> (vlength v) 0) (finite? (vlength v)))) given)))
        (error 'solar-hours "normals must be a gvector longer than 0 or a list of them, got ~s" normals))
    (if (not (= (length given) (length places)))
        (error 'solar-hours "normals must be ~a gvectors, one for each point, got ~a" (length places) (length given)))
    (let* ((n (max 1 (exact (ceiling (- (/ (- to from) step) 1e-9)))))
           (hours (/ (- to from) n))
           (suns (filter (lambda (v) (> (cz v) 0))
                         (map (lambda (i) (%solar-hours-at (+ from (* hours (+ i 1/2))) #:latitude latitude #:longitude longitude #:date date))
                              (iota n)))))
      (if (null? suns)
          (map (lambda (p) 0.0) places)
          (%solar-hours places (map (lambda (v) (p+v origin v)) given) (map (lambda (v) (p+v origin v)) suns) hours
                        (if (list? among) (map %drawn among) (%drawn among)))))))

; ---- contours ----

; Returns 1, 2 or 5 times a power of ten that divides a height into about ten.
(define (%round-step height)
  (let* ((least (/ height 10.)) (power (expt 10. (floor (/ (log least) (log 10.))))) (rest (/ least power)))
    (* power (cond ((<= rest 1.0001) 1) ((<= rest 2) 2) ((<= rest 5) 5) (else 10)))))

(define (%need-height who name x)
  (if (and x (not (and (real? x) (finite? x)))) (error who "~a must be a number, finite, got ~s" name x)))

; Returns the level lines of a solid or surface: a list of curves for each height, the lowest first.
(define (contours o #:from [from any? #f] #:to [to any? #f] #:step [step any? #f] #:plane [plane any? 'xy])
  (%need-height 'contours 'from from)
  (%need-height 'contours 'to to)
  (if step (%need-positive 'contours 'step step))
  (let ((span (%contours (%drawn o) plane #f)))
    (if (not span)
        '()
        (let* ((low (car span)) (high (cdr span)) (blur (* 1e-9 (max (abs low) (abs high) (- high low)))))
          (if (and (not step) (<= (- high low) blur)) (error 'contours "o is flat: #:step must be given"))
          (let* ((step (or step (%round-step (- high low))))
                 (from (or from (+ 0.0 (* step (ceiling (/ (- low blur) step))))))
                 (count (+ 1 (exact (floor (+ 1e-9 (/ (- (or to high) from) step)))))))
            (if (> count 10000) (error 'contours "there are more than 10000 heights from ~a on by ~a" from step))
            (map (lambda (level) (if (solid? o) (append-map outline level) level))
                 (%contours (%drawn o) plane (map (lambda (i) (+ from (* step i))) (reverse (iota (max count 0)))))))))))

; Returns a number as text: whole where it is whole, else with three decimals at most.
(define (%height-text z) (number->string (%short z)))

; Returns the positions on a curve, from its start, between which a text of this width fits best: where the curve is
; straightest.
(define (%text-place curve width)
  (let ((l (curve-length curve)))
    (define (straightness m) (distance (curve-point curve (- m (/ width 2))) (curve-point curve (+ m (/ width 2)))))
    (let ((middles (map (lambda (i) (+ (/ width 2) (* (- l width) (/ i 16)))) '(8 7 9 6 10 5 11 4 12 3 13))))
      (let loop ((m (car middles)) (rest (cdr middles)))
        (cond ((null? rest) (cons (- m (/ width 2)) (+ m (/ width 2))))
              ((> (straightness (car rest)) (* 1.001 (straightness m))) (loop (car rest) (cdr rest)))
              (else (loop m (cdr rest))))))))

; Returns a contour interrupted by its height, as a list of curves; a short contour alone.
(define (%labelled-contour curve size)
  (let* ((z (cz (curve-point curve 0))) (text (%height-text z)) (width (* size (+ 1 (/ (%stroke-width text) 8)))) (l (curve-length curve)))
    (if (< l (* 3 width))
        (list curve)
        (let* ((place (%text-place curve width)) (p (curve-point curve (car place))) (q (curve-point curve (cdr place))))
          (if (= (distance p q) 0) (error 'label-contours "size ~a is too small for a curve ~a long" size (%number-text l)))
          (let* ((back? (or (< (cx q) (- (cx p) 1e-9)) (and (<= (abs (- (cx q) (cx p))) 1e-9) (< (cy q) (cy p)))))
                 (d (unitize (if back? (p->q q p) (p->q p q))))
                 (at (p+v (mid p q) (v*r (vxyz (cy d) (- (cx d)) 0) (/ size 2))))
                 (ends (list (cons 0 (car place)) (cons (cdr place) l)))
                 (lines (if (%closed-curve? curve)
                            (list (make-line (append (%curve-points curve (cdr place) l) (cdr (%curve-points curve 0 (car place))))))
                            (map (lambda (e) (make-line (%curve-points curve (car e) (cdr e)))) ends)))
                 (name (object-layer curve)))
            (map (lambda (o) (if name (layer name o) o))
                 (append lines (list (engrave text size #:at at #:angle (pol-phi d) #:align 'centre #:underline #f)))))))))

; Returns true if all points of a curve have one height.
(define (%level-curve? curve)
  (let ((b (bounding-box curve)))
    (<= (- (cz (second b)) (cz (first b))) (* 1e-6 (+ (abs (cz (first b))) (distance (first b) (second b)))))))

; Returns contours as `contours` returns them; each n-th is interrupted by its height, in letters of single lines.
(define (label-contours lines size #:every [every-nth any? 5])
  (if (not (and (list? lines) (every (lambda (l) (and (list? l) (every (lambda (c) (and (object? c) (curve? c))) l))) lines)))
      (error 'label-contours "lines must be a list of lists of curves, as contours returns them, got ~s" lines))
  (%need-positive 'label-contours 'size size)
  (%need-count 'label-contours 'every every-nth 10000)
  (for-each (lambda (c) (if (not (%level-curve? c)) (error 'label-contours "each curve of lines must have one height, got ~s" c))) (append-map values lines))
  (define (height level) (cz (curve-point (car level) 0)))
  (let* ((heights (map height (filter pair? lines)))
         (step (if (or (null? heights) (null? (cdr heights))) 0 (apply min (map - (cdr heights) heights)))))
    (define (main? z)
      (or (<= step 0) (let ((i (/ z step every-nth))) (< (abs (- i (round i))) 1e-6))))
    (map (lambda (level)
           (if (and (pair? level) (main? (height level))) (append-map (lambda (c) (%labelled-contour c size)) level) level))
         lines)))

; ---- slices ----

; Returns the name of the layer in which the whole object is, or #f; the innermost wins.
(define (%whole-layer o)
  (let loop ((o o) (name #f))
    (case (object-kind o)
      ((layer) (loop (car (object-children o)) (car (object-arguments o))))
      ((with-material transform) (loop (car (object-children o)) name))
      (else name))))

; Returns, for each slice, the places of its pins in its own plane: two in each pair of slices, kept from pair to pair as
; long as they fit. reach: how far a pin's middle must be from the border.
(define (%pin-places regions heights plane reach)
  (define normal (%slices-normal plane))
  (define (up p d) (p+v p (v*r normal d)))
  (define (room p) (make-region (make-circle p (* 3 reach) #:plane plane)))
  ; Returns the middles of the largest circles of at least this radius, at most n of them, apart from those given.
  (define (found-in common given n)
    (let* ((free (if (null? given) common (subtract common (map room given))))
           (best (and (> n 0) (%largest-circle free))))
      (if (and best (>= (cdr best) reach))
          (cons (car best) (found-in common (cons (car best) given) (- n 1)))
          '())))
  (let loop ((l regions) (h heights) (carried '()) (all '()) (number 1) (bare '()))
    (if (or (null? l) (null? (cdr l)))
        (begin (%warn-of-no-pins (reverse bare) reach) (reverse (cons carried all)))
        (let* ((step (- (cadr h) (car h)))
               (common (and (car l) (cadr l) (intersect (car l) (do-move (cadr l) (v*r normal (- step))))))
               (border (if (and common (pair? carried)) (outline common) '()))
               (kept (filter (lambda (p) (and (pair? border) (contains? common p) (every (lambda (c) (>= (distance p (closest-point c p)) reach)) border))) carried))
               (pins (if common (append kept (found-in common carried (- 2 (length kept)))) '())))
          (loop (cdr l) (cdr h) (map (lambda (p) (up p step)) pins)
                (cons (append carried (filter (lambda (p) (not (member p carried))) pins)) all) (+ number 1)
                (if (null? pins) (cons number bare) bare))))))

; Warns of the slices, by number, that have no pin to the next one.
(define (%warn-of-no-pins bare reach)
  (if (pair? bare)
      (%warn (format "slices: ~a meet in too little for a pin, whose middle must be ~a from the border; a smaller #:diameter fits more"
               (if (null? (cdr bare))
                   (format "slices ~a and ~a" (car bare) (+ (car bare) 1))
                   (format "~a pairs of slices, the first ~a and ~a," (length bare) (car bare) (+ (car bare) 1)))
               (%to-six reach)))))

; Returns the slices of a solid as flat objects, the lowest first, each in the plane halfway up it: the region to cut, in
; layer "cut" or that of o, and in layer "engrave" its number and the outline of the slice above.
(define (slices o thickness #:plane [plane any? 'xy] #:registration [registration any? #f] #:diameter [diameter any? #f]
                #:numbers [numbers any? #t])
  (%need-positive 'slices 'thickness thickness)
  (if diameter (%need-positive 'slices 'diameter diameter))
  (if (not (memq registration '(#f dowels tabs))) (error 'slices "registration must be 'dowels, 'tabs or #f, got ~s" registration))
  (let ((span (%slices (%drawn o) plane #f)))
    (if (not span)
        '()
        (let* ((low (car span)) (high (cdr span)) (count (max 1 (exact (ceiling (- (/ (- high low) thickness) 1e-9))))))
          (if (> count 10000) (error 'slices "a thickness of ~a makes ~a slices; 10000 are the most" thickness count))
          (let* ((heights (map (lambda (i) (let ((z (+ low (* i thickness)))) (/ (+ z (min high (+ z thickness))) 2))) (iota count)))
                 (made (%slices (%drawn o) plane (reverse heights)))
                 (name (or (%whole-layer o) "cut"))
                 (wide (or diameter thickness))
                 (pins (if registration (%pin-places (map car made) heights plane (if (eq? registration 'dowels) wide (* 1.2 wide))) (map (lambda (m) '()) made))))
            (define (pin p)
              (make-region (if (eq? registration 'dowels) (make-circle p (/ wide 2) #:plane plane) (make-regular-polygon p (/ wide (sqrt 2)) 4 pi/4 #:plane plane))))
            (define (number i region)
              (let ((place (and numbers (%largest-circle region))) (text (number->string i)))
                (define (written text)
                  (outline (make-text (car place) (min (* 2 thickness) (* 0.8 (cdr place))) text #:align 'center #:valign 'center #:plane plane)))
                (cond ((not place) '())
                      ((%turns-over? text) (append (written text) (written (make-string (string-length text) #\_))))
                      (else (written text)))))
            (filter-map
              (lambda (m pins i)
                (and (car m)
                     (let* ((region (if (null? pins) (car m) (subtract (car m) (map pin pins))))
                            (engraved (append (cdr m) (number i region))))
                       (if (null? engraved)
                           (layer name region)
                           (layer (format "slice ~a" i) (layer name region) (layer "engrave" engraved))))))
              made pins (iota count 1)))))))

; ---- ribs ----

(define (%to-six x) (/ (round (* 1e6 x)) 1e6))

; Returns the flat part of a rib: its region to cut and its name to engrave.
(define (%rib-part o name region numbers size placed flat plane)
  (let* ((middle (and numbers (%largest-circle region)))
         (cut (layer (or (%whole-layer o) "cut") region))
         (part (if middle
                   (layer name cut
                     (layer "engrave" (outline (make-text (car middle) (min size (* 0.5 (cdr middle))) name #:align 'center #:valign 'center #:plane plane))))
                   cut)))
    (if placed part (do-transform part flat))))

; Returns two values: the ribs across X and those across Y of a solid, as flat parts with slots into each other.
(define (ribs o #:x [x any? 4] #:y [y any? 4] #:thickness thickness #:clearance [clearance any? 0]
              #:numbers [numbers any? #t] #:placed [placed any? #f])
  (%need-count 'ribs 'x x 1000)
  (%need-count 'ribs 'y y 1000)
  (%need-positive 'ribs 'thickness thickness)
  (if (not (and (real? clearance) (finite? clearance) (> (+ thickness clearance) 0)))
      (error 'ribs "clearance must be a number that leaves a slot, got ~s" clearance))
  (define (places span n) (map (lambda (i) (+ (car span) (* (/ (+ i 1/2) n) (- (cdr span) (car span))))) (iota n)))
  (define half (/ (+ thickness clearance) 2))
  ; Returns the heights of a region within a strip of its plane as a pair, or #f.
  (define (heights region strip)
    (let ((b (and region (bounding-box (intersect region strip)))))
      (and b (cons (cz (first b)) (cz (second b))))))
  (let ((across-x (%ribs (%drawn o) 'yz #f)) (across-y (%ribs (%drawn o) 'xz #f)) (upright (%ribs (%drawn o) 'xy #f)))
    (if (not across-x)
        (values '() '())
        (let* ((xs (places across-x x)) (ys (places across-y y)) (low (- (car upright) 1)) (high (+ (cdr upright) 1))
               (gap (apply min (append (if (> x 1) (list (- (cadr xs) (car xs))) '()) (if (> y 1) (list (- (cadr ys) (car ys))) '()) (list +inf.0)))))
          (define (in-x at y0 y1 z0 z1) (make-polygon (xyz at y0 z0) (xyz at y1 z0) (xyz at y1 z1) (xyz at y0 z1)))
          (define (in-y at x0 x1 z0 z1) (make-polygon (xyz x0 at z0) (xyz x1 at z0) (xyz x1 at z1) (xyz x0 at z1)))
          (if (<= gap (* 2 half)) (error 'ribs "the ribs are ~a apart, and a slot takes ~a: fewer ribs fit" (%to-six gap) (* 2 half)))
          (let* ((x-regions (map car (%ribs (%drawn o) 'yz (reverse xs)))) (y-regions (map car (%ribs (%drawn o) 'xz (reverse ys))))
                 ; the height at which the slots of two ribs meet, or #f where the ribs do not meet
                 (meets (map (lambda (at across)
                               (map (lambda (other along)
                                      (let ((a (heights across (in-x at (- other half) (+ other half) low high)))
                                            (b (heights along (in-y other (- at half) (+ at half) low high))))
                                        (and a b (< (max (car a) (car b)) (min (cdr a) (cdr b)))
                                             (/ (+ (max (car a) (car b)) (min (cdr a) (cdr b))) 2))))
                                    ys y-regions))
                             xs x-regions)))
            (define (slotted region slots) (if (null? slots) region (subtract region slots)))
            (values
              (filter-map
                (lambda (at region row i)
                  (and region
                       (%rib-part o (format "X~a" i)
                         (slotted region (filter-map (lambda (other z) (and z (in-x at (- other half) (+ other half) low z))) ys row))
                         numbers (* 3 thickness) placed (make-matrix 0 1 0 0 0 0 1 0 1 0 0 (- at) 0 0 0 1) 'yz)))
                xs x-regions meets (iota x 1))
              (filter-map
                (lambda (at region column i)
                  (and region
                       (%rib-part o (format "Y~a" i)
                         (slotted region (filter-map (lambda (other z) (and z (in-y at (- other half) (+ other half) z high))) xs column))
                         numbers (* 3 thickness) placed (make-matrix 1 0 0 0 0 0 1 0 0 -1 0 at 0 0 0 1) 'xz)))
                ys y-regions (apply map list meets) (iota y 1))))))))

; ---- land ----

; Returns the corners of a breakline: a list of points, or a curve.
(define (%breakline-points b)
  (cond
    ((and (list? b) (pair? b) (every %finite-point? b)) b)
    ((and (object? b) (curve? b) (eq? (object-kind (lowered b)) 'line))
     (let ((l (object-arguments (lowered b)))) (if (cadr l) (append (car l) (list (caar l))) (car l))))
    (else (error 'terrain "breaklines must be a list of curves and lists of points, got ~s" b))))

; Returns the surface over points, seen from above as Delaunay triangles, with the breaklines as edges.
(define (terrain points #:breaklines [breaklines any? '()])
  (let ((points (if (and (pair? points) (list? points) (every list? points)) (append-map values points) points)))
    (%need-points 'terrain 'points points 3)
    (let* ((lines (map %breakline-points (if (or (object? breaklines) (and (pair? breaklines) (point? (car breaklines)))) (list breaklines) breaklines)))
           (made (%terrain points (append-map values lines) (map length lines))))
      (make-polyface-mesh (car made) (cdr made)))))

; Returns two values: the volume to take away from the land to make the design, and that to add, where both are.
(define (cut-and-fill land design)
  (let* ((a (%cut-and-fill (%drawn land) #f #f 'land)) (b (%cut-and-fill (%drawn design) #f #f 'design))
         (bottom (min (car a) (car b))) (top (max (cdr a) (cdr b))) (margin (+ 1 (- top bottom)))
         (low (- bottom margin)) (high (+ top margin)))
    (define (under o name) (let ((m (%cut-and-fill (%drawn o) low #f name))) (make-polyface-mesh (car m) (cdr m))))
    (define (column o name) (let ((m (%cut-and-fill (%drawn o) low high name))) (make-polyface-mesh (car m) (cdr m))))
    (values (volume (subtract (intersect (under land 'land) (column design 'design)) (under design 'design)))
            (volume (subtract (intersect (under design 'design) (column land 'land)) (under land 'land))))))
