; Rafters and tiles: grids on the faces of roofs. In a face's own plane, X goes along its eave and Y up the slope.

(define (check-faces who l)
  (if (not (and (list? l) (every (lambda (f) (and (list? f) (> (length f) 3) (every point? (cdr f)))) l)))
      (error who "faces must be the faces of a roof, as roof-faces returns them, got ~s" l)))

; Returns the frame of a face (origin, x, y, normal), or #f of a vertical face. The face lies on the left of x.
(define (face-frame f)
  (let* ((points (cdr f))
         (sum (fold (lambda (p q v) (v+v v (cross (p->q (car points) p) (p->q (car points) q)))) (vxyz 0 0 0) points (append (cdr points) (list (car points)))))
         (size (vlength sum)))
    (and (> size 1e-12) (> (cz sum) (* 1e-6 size))
         (let* ((n (v/r sum size)) (x (let ((along (cross uz n))) (if (> (vlength along) 1e-9) (unitize along) ux))) (y (cross n x)))
           (list (argmin (lambda (p) (dot y (p->q (car points) p))) points) x y n)))))
(define (in-frame frame p) (let ((v (p->q (first frame) p))) (xy (dot v (second frame)) (dot v (third frame)))))
(define (out-of-frame frame x y) (p+v (first frame) (v+v (v*r (second frame) x) (v*r (third frame) y))))

; Returns where a line of one coordinate crosses a polygon, ascending, as numbers of the other coordinate.
(define (crossings-at polygon at get other)
  (sort (filter-map (lambda (a b)
                      (and (not (eq? (> (get a) at) (> (get b) at)))
                           (+ (other a) (* (/ (- at (get a)) (- (get b) (get a))) (- (other b) (other a))))))
          polygon (append (cdr polygon) (list (car polygon)))) <))
(define (by-twos l) (if (or (null? l) (null? (cdr l))) '() (cons (list (car l) (cadr l)) (by-twos (cddr l)))))

; Returns the positions of lines with at most the spacing between low and high, the first and last half a width inside.
(define (grid-lines low high spacing width)
  (let* ((from (+ low (/ width 2))) (to (- high (/ width 2))) (n (max 1 (exact (ceiling (- (/ (- to from) spacing) 1e-9))))))
    (if (<= to from) (list (/ (+ low high) 2)) (division from to n))))

(define (roof-rafters faces #:spacing [spacing any? 0.8] #:size [size any? '(0.08 0.18)] #:material [material any? 'wood])
  (check-faces 'roof-rafters faces)
  (check-positive 'roof-rafters "spacing" spacing)
  (let* ((s (section-size 'roof-rafters size)) (half (/ (first s) 2)) (deep (second s)))
    ; a rafter has plumb ends
    (define (rafter frame x from to)
      (let ((down (vxyz 0 0 (- (/ deep (cz (fourth frame)))))) (at (lambda (y) (out-of-frame frame (- x half) y))))
        (in-material material
          (do-extrude (make-polygon (at from) (at to) (p+v (at to) down) (p+v (at from) down)) (v*r (second frame) (* 2 half))))))
    ; Returns the intervals in which the whole width of the rafter at x is below the face.
    (define (intervals polygon x)
      (let* ((each (map (lambda (x) (by-twos (crossings-at polygon x cx cy))) (list (- x half) x (+ x half)))) (sizes (map length each)))
        (if (apply = sizes) (apply map (lambda (a b c) (list (max (first a) (first b) (first c)) (min (second a) (second b) (second c)))) each)
            (second each))))
    (append-map
      (lambda (f)
        (let ((frame (face-frame f)))
          (if (not frame) '()
              (let* ((polygon (map (lambda (p) (in-frame frame p)) (cdr f))) (xs (map cx polygon)))
                (append-map
                  (lambda (x) (filter-map (lambda (i) (and (> (- (second i) (first i)) 1e-6) (rafter frame x (first i) (second i)))) (intervals polygon x)))
                  (grid-lines (+ (apply min xs) 1e-9) (- (apply max xs) 1e-9) spacing (first s)))))))
      faces)))

; Returns the polygon on the side of the line where (get p) is at least `at`, or at most if sign is -1.
(define (half-plane polygon get at sign)
  (define (inside? p) (>= (* sign (- (get p) at)) 0))
  (append-map
    (lambda (p q)
      (let ((cut (lambda () (intermediate-point p q (/ (- at (get p)) (- (get q) (get p)))))))
        (append (if (inside? p) (list p) '()) (if (eq? (inside? p) (inside? q)) '() (list (cut))))))
    polygon (if (null? polygon) '() (append (cdr polygon) (list (car polygon))))))

(define most-tiles 200000)

; Each second course is moved by half a tile. Tiles at the edges of a face are cut.
(define (roof-tiles faces #:size [size any? '(0.3 0.35)] #:thickness [thickness any? 0.02] #:material [material any? #f])
  (check-faces 'roof-tiles faces)
  (check-positive 'roof-tiles "thickness" thickness)
  (let* ((s (section-size 'roof-tiles size)) (w (first s)) (h (second s)) (whole (* w h)))
    (define (tiles-of f)
      (let ((frame (face-frame f)))
        (if (not frame) '()
            (let* ((polygon (map (lambda (p) (in-frame frame p)) (cdr f)))
                   (low (apply min (map cx polygon))) (high (apply max (map cx polygon))) (top (apply max (map cy polygon))))
              (if (> (/ (* (- high low) top) whole) most-tiles) (error 'roof-tiles "a face needs more than ~a tiles of ~a by ~a" most-tiles w h))
              (append-map
                (lambda (row)
                  (let* ((course (half-plane (half-plane polygon cy (* row h) 1) cy (* (+ row 1) h) -1)) (shift (if (odd? row) (/ w -2) 0)))
                    (filter-map
                      (lambda (column)
                        (let* ((x (+ low shift (* column w))) (piece (half-plane (half-plane course cx x 1) cx (+ x w) -1)) (cut (if (null? piece) '() (without-near piece))))
                          (and (> (length cut) 2) (> (abs (turn cut)) (* 1e-6 whole))
                               (in-material material
                                 (do-extrude (make-polygon (map (lambda (p) (out-of-frame frame (cx p) (cy p))) cut)) (v*r (fourth frame) thickness))))))
                      (iota (+ 1 (exact (ceiling (/ (- high low shift) w))))))))
                (iota (exact (ceiling (/ top h)))))))))
    (append-map tiles-of faces)))
