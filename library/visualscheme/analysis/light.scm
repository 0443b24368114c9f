; Light: view factors between polygons, the daylight factor under the overcast sky of the CIE, hours of sun on faces, and
; colours on faces.

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

; Returns the daylight factors of places that look upwards: their part of the light of an overcast sky, by rays.
(define (daylight-factor points #:among [among any? '()] #:glass [glass any? 1] #:inner [inner any? 0] #:rays [rays any? 4096])
  (let ((places (if (point? points) (list points) points)))
    (if (not (and (list? places) (every point? places))) (error 'daylight-factor "points must be a point or a list of points, got ~s" points))
    (for-each (lambda (name x) (if (not (and (real? x) (<= 0 x 1))) (error 'daylight-factor "~a must be a number from 0 to 1, got ~s" name x))) '(glass inner) (list glass inner))
    (if (not (and (exact-integer? rays) (<= 16 rays 1000000))) (error 'daylight-factor "rays must be an exact integer from 16 to 1000000, got ~s" rays))
    (let ((parts (map (lambda (x) (+ inner (* glass x))) (core:lit places (map (lambda (p) (xyz 0 0 1)) places) (sky-directions rays) (/ 1. rays) (if (list? among) among (list among))))))
      (if (point? points) (car parts) parts))))

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
