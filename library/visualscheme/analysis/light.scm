; Light: view factors between polygons, daylight under the overcast sky of the CIE, grids, hours of sun on faces, and colours
; on faces.

; ---- view factors ----

; Gauss's rule with eight points on the part from 0 to 1: lists of a place and a weight.
(define gauss-rule
  (append-map (lambda (x w) (list (list (/ (- 1 x) 2) (/ w 2)) (list (/ (+ 1 x) 2) (/ w 2))))
    '(0.1834346424956498 0.5255324099163290 0.7966664774136267 0.9602898564975363)
    '(0.3626837833783620 0.3137066458778873 0.2223810344533745 0.1012285362903763)))

(define (need-polygon who name l)
  (if (not (and (list? l) (>= (length l) 3) (every point? l))) (error who "~a must be a list of three points or more, got ~s" name l)))
(define (polygon-vector l) (let ((m (car l))) (fold (lambda (p q sum) (v+v sum (v*r (cross (p->q m p) (p->q m q)) 1/2))) (vxyz 0 0 0) l (append (cdr l) (list (car l))))))
(define (sides-of l) (map list l (append (cdr l) (list (car l)))))

; Returns the double integral of (ln r^2) / 2 over two sides. A side with itself has a closed form; sides that meet have a
; weak singularity at the corner, towards which their parts are halved.
(define (side-pair a b depth)
  (let* ((p (first a)) (d (p->q p (second a))) (q (first b)) (e (p->q q (second b))) (toward (dot d e)))
    (define (by-rule s0 s1 t0 t1)
      (fold (lambda (s sum)
              (fold (lambda (t sum)
                      (let ((v (p->q (p+v p (v*r d (+ s0 (* (first s) (- s1 s0))))) (p+v q (v*r e (+ t0 (* (first t) (- t1 t0))))))))
                        (+ sum (* (second s) (second t) (- s1 s0) (- t1 t0) 1/2 (log (max 1e-300 (dot v v)))))))
                sum gauss-rule))
        0 gauss-rule))
    (cond
      ((= toward 0) 0)
      ((or (and (near? p (second b)) (near? (second a) q)) (and (near? p q) (near? (second a) (second b)))) (* toward (- (log (vlength d)) 3/2)))
      (else
       (let split ((s0 0) (s1 1) (t0 0) (t1 1) (depth depth))
         (let* ((middle (p->q (p+v p (v*r d (/ (+ s0 s1) 2))) (p+v q (v*r e (/ (+ t0 t1) 2))))) (size (+ (* (- s1 s0) (vlength d)) (* (- t1 t0) (vlength e)))))
           (if (or (= depth 0) (> (vlength middle) size)) (* toward (by-rule s0 s1 t0 t1))
               (let ((s (/ (+ s0 s1) 2)) (t (/ (+ t0 t1) 2)))
                 (+ (split s0 s t0 t (- depth 1)) (split s s1 t0 t (- depth 1)) (split s0 s t t1 (- depth 1)) (split s s1 t t1 (- depth 1)))))))))))

; Returns the part of the radiation of a that reaches b, by the integral around both. Nothing may be between, and each must
; lie in front of the other.
(define (view-factor a b)
  (need-polygon 'view-factor 'a a)
  (need-polygon 'view-factor 'b b)
  (let ((na (polygon-vector a)) (nb (polygon-vector b)))
    (define (behind from n to) (every (lambda (p) (<= (dot n (p->q (car from) p)) (* 1e-9 (vlength n)))) to))
    (if (or (= 0 (vlength na)) (= 0 (vlength nb))) (error 'view-factor "a polygon has no area"))
    (if (or (behind a na b) (behind b nb a)) 0
        (abs (/ (fold (lambda (s sum) (fold (lambda (t sum) (+ sum (side-pair s t 5))) sum (sides-of b))) 0 (sides-of a)) 2 pi (vlength na))))))

; ---- daylight ----

; Returns n directions to the sky, each with an equal part of the light that an overcast sky (CIE) gives to a level place:
; the luminance grows as 1 + 2 sin of the altitude.
(define (sky-directions n)
  (let ((golden (* pi (- 3 (sqrt 5)))))
    (map (lambda (k)
           (let* ((part (* 7/6 (/ (+ k 0.5) n)))
                  (c (let loop ((c (sqrt (/ (+ k 0.5) n))) (turns 0)) ; c: sine of the altitude, by Newton
                       (let ((f (- (+ (* 1/2 c c) (* 2/3 c c c)) part))) (if (or (= turns 20) (< (abs f) 1e-14)) c (loop (- c (/ f (+ c (* 2 c c)))) (+ turns 1))))))
                  (s (sqrt (max 0 (- 1 (* c c))))))
             (xyz (* s (cos (* k golden))) (* s (sin (* k golden))) c)))
      (iota n))))

(define (flat-list o) (if (list? o) (append-map flat-list o) (list o)))

; Returns the reflectance of each object: a number for all, or a list with one for each.
(define (reflectances-of who reflectance objects)
  (let ((l (if (list? reflectance) reflectance (map (lambda (o) reflectance) objects))))
    (for-each (lambda (x) (if (not (and (real? x) (<= 0 x 0.95))) (error who "reflectance must be a number from 0 to 0.95, or a list of them, got ~s" x))) (if (null? l) (list reflectance) l))
    (if (not (= (length l) (length objects))) (error who "reflectance must be one, or a list of ~a, one for each object of #:among, got ~a" (length objects) (length l)))
    (list->vector (map inexact l))))

; Returns the daylight factors of places that look upwards: their part of the light of an overcast sky, by rays.
(define (daylight-factor points #:among [among any? '()] #:glass [glass any? 1] #:inner [inner any? 0] #:reflectance [reflectance any? 0] #:albedo [albedo any? 0.2] #:rays [rays any? 4096])
  (daylight-of 'daylight-factor points among (lambda (sky reflected) (+ inner (* glass (+ sky reflected)))) (list glass inner albedo) reflectance rays))

; Returns the illuminance of places that look upwards, in lx, when a level place in the open has `outdoor` lx.
(define (illuminance points #:outdoor [outdoor any? 10000] #:among [among any? '()] #:glass [glass any? 1] #:inner [inner any? 0] #:reflectance [reflectance any? 0] #:albedo [albedo any? 0.2] #:rays [rays any? 4096])
  (need-positive 'illuminance 'outdoor outdoor)
  (daylight-of 'illuminance points among (lambda (sky reflected) (* outdoor (+ inner (* glass (+ sky reflected))))) (list glass inner albedo) reflectance rays))

; parts: those of glass, inner surfaces and ground. Glass takes its part of all light, which has entered through it.
(define (daylight-of who points among total parts reflectance rays)
  (let* ((places (if (point? points) (list points) points)) (objects (flat-list among)) (albedo (third parts)))
    (for-each (lambda (o) (if (not (and (object? o) (or (solid? o) (surface? o) (empty-object? o)))) (error who "among must be solids and surfaces, got ~a" (if (object? o) (format "a ~a" (object-kind o)) o)))) objects)
    (if (not (and (list? places) (every point? places))) (error who "points must be a point or a list of points, got ~s" points))
    (for-each (lambda (name x) (if (not (and (real? x) (<= 0 x 1))) (error who "~a must be a number from 0 to 1, got ~s" name x))) '(glass inner albedo) parts)
    (if (not (and (exact-integer? rays) (<= 16 rays 1000000))) (error who "rays must be an exact integer from 16 to 1000000, got ~s" rays))
    (let* ((each (reflectances-of who reflectance objects)) (normals (map (lambda (p) (xyz 0 0 1)) places))
           (sky (core:lit places normals (sky-directions rays) (/ 1. rays) objects))
           (reflected (if (every (lambda (x) (= x 0)) (vector->list each)) (map (lambda (p) 0) places)
                          (vector->list (core:reflected-daylight places normals rays each (inexact albedo) objects))))
           (all (map total sky reflected)))
      (if (point? points) (car all) all))))

; ---- grids ----

; Returns the points of a grid within a room, so high above it: the middles of squares of the side `step` that lie within the
; room, `margin` from its walls.
(define (grid-points room #:step [step any? 0.5] #:height [height any? 0] #:margin [margin any? 0])
  (for-each (lambda (name x) (need-number 'grid-points name x)) '(height margin) (list height margin))
  (need-positive 'grid-points 'step step)
  (if (< margin 0) (error 'grid-points "margin must not be negative, got ~s" margin))
  (let* ((whole (region-of 'grid-points room)) (region (if (= margin 0) whole (do-offset whole (- margin)))) (box (bounding-box region)))
    (if (not box) '()
        (let* ((low (first box)) (wide (p->q low (second box))) (count (lambda (length) (max 1 (exact (floor (+ (/ length step) 1e-9))))))
               (nx (count (cx wide))) (ny (count (cy wide))))
          (if (> (* nx ny) 1000000) (error 'grid-points "step ~a is too fine for a room of ~a by ~a" step (cx wide) (cy wide)))
          (append-map
            (lambda (j)
              (filter-map (lambda (i)
                            (let ((p (+xy low (+ (/ (- (cx wide) (* nx step)) 2) (* step (+ i 1/2))) (+ (/ (- (cy wide) (* ny step)) 2) (* step (+ j 1/2))))))
                              (and (contains? region p) (+z p height))))
                (iota nx)))
            (iota ny))))))

; Returns level squares of this side with these middles, as faces.
(define (grid-faces points side)
  (if (not (and (list? points) (every point? points))) (error 'grid-faces "points must be a list of points, got ~s" points))
  (need-positive 'grid-faces 'side side)
  (let ((h (/ side 2))) (map (lambda (p) (list (+xy p (- h) (- h)) (+xy p h (- h)) (+xy p h h) (+xy p (- h) h))) points)))

; ---- faces ----

; Returns the faces of surfaces and solids as lists of points.
(define (faces-in o)
  (append-map
    (lambda (o)
      (let* ((mesh (lowered o)) (at (if (eq? (object-kind mesh) 'polyface-mesh) (list->vector (cons #f (first (object-arguments mesh)))) (error 'faces-in "o must be surfaces or solids, got a ~a" (object-kind o)))))
        (map (lambda (f) (map (lambda (k) (vector-ref at k)) f)) (second (object-arguments mesh)))))
    (if (list? o) o (list o))))

(define (middle-of face) (p+v origin (v/r (fold (lambda (p sum) (v+v sum (p->q origin p))) (vxyz 0 0 0) face) (length face))))

; Returns the hours of sun on each face.
(define (sun-hours-on faces #:latitude latitude #:longitude [longitude any? 0] #:date date #:among [among any? '()] #:step [step any? 1/6])
  (for-each (lambda (f) (need-polygon 'sun-hours-on "a face" f)) faces)
  (solar-hours (map middle-of faces) (map polygon-vector faces) #:latitude latitude #:longitude longitude #:date date #:among among #:step step))

(define (color-faces faces values #:from [from any? #f] #:to [to any? #f])
  (if (not (and (list? faces) (list? values) (= (length faces) (length values)))) (error 'color-faces "there must be a value for each face"))
  (for-each (lambda (f) (need-polygon 'color-faces "a face" f)) faces)
  (for-each (lambda (v) (need-number 'color-faces "a value" v)) values)
  (let ((low (or from (apply min values))) (high (or to (apply max values))))
    (map (lambda (f v) (color (scale-color v low high) (if (null? (cdddr f)) (make-3dface (first f) (second f) (third f) (third f)) (make-polyface-mesh f (list (iota (length f) 1)))))) faces values)))
