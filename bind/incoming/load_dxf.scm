; Reads .dxf: entities become curves, regions and texts. After load_outline.scm. An entity is a vector: its type, the places
; of its first and last group in the vector of groups. Names that begin with % are hidden from programs.

; A file that is being read: groups, path, layers (small name -> (name . colour)), blocks (name -> (base entities)),
; factor from the file's unit to the model's, omitted types (name -> count), parts of blocks that were made already.
(define-record-type %dxf-file (%make-dxf-file groups path layers blocks factor omitted parts) %dxf-file?
  (groups %dxf-groups-of) (path %dxf-path) (layers %dxf-layers) (blocks %dxf-blocks) (factor %dxf-factor)
  (omitted %dxf-omitted) (parts %dxf-parts))

(define (%dxf-type e) (vector-ref e 0))
(define (%dxf-line e) (+ (vector-ref e 1) 1))

; Returns the value of the first group with that code in the entity, or the default.
(define (%dxf-value f e code default)
  (let ((g (%dxf-groups-of f)) (end (vector-ref e 2)))
    (let loop ((i (+ (vector-ref e 1) 2)))
      (cond ((>= i end) default)
            ((= (vector-ref g i) code) (vector-ref g (+ i 1)))
            (else (loop (+ i 2)))))))

; Calls (use code value) for each group of the entity.
(define (%dxf-each f e use)
  (let ((g (%dxf-groups-of f)) (end (vector-ref e 2)))
    (let loop ((i (+ (vector-ref e 1) 2)))
      (if (< i end) (begin (use (vector-ref g i) (vector-ref g (+ i 1))) (loop (+ i 2)))))))

(define (%dxf-length f e code default) (* (%dxf-factor f) (%dxf-value f e code default)))
(define (%dxf-point f e code)
  (xyz (%dxf-length f e code 0.) (%dxf-length f e (+ code 10) 0.) (%dxf-length f e (+ code 20) 0.)))
(define (%dxf-angle f e code default) (degrees->radians (%dxf-value f e code default)))
(define (%dxf-must f e good? text) (if (not good?) (%outline-fail (%dxf-path f) (%dxf-line e) (string-append (%dxf-type e) ": " text))))

; Returns the matrix of the entity's own coordinates: the plane across its direction of extrusion.
(define (%dxf-plane-of normal)
  (if (= (vlength normal) 0)
      %identity-matrix
      (let* ((n (unitize normal))
             (x (unitize (if (and (< (abs (cx n)) 1/64) (< (abs (cy n)) 1/64)) (cross (vxyz 0 1 0) n) (cross (vxyz 0 0 1) n))))
             (y (cross n x)))
        (make-matrix (cx x) (cx y) (cx n) 0 (cy x) (cy y) (cy n) 0 (cz x) (cz y) (cz n) 0 0 0 0 1))))
(define (%dxf-own-plane f e)
  (let ((x (%dxf-value f e 210 0.)) (y (%dxf-value f e 220 0.)) (z (%dxf-value f e 230 1.)))
    (if (and (= x 0) (= y 0) (> z 0)) %identity-matrix (%dxf-plane-of (vxyz x y z)))))

; ---- colours and layers ----

; The shades of the hues in the table of colours; the pure colours and the greys have numbers of their own.
(define %dxf-shades '#(1 0.65 0.5 0.3 0.15))
(define %dxf-pure '#("#000000" "#ff0000" "#ffff00" "#00ff00" "#00ffff" "#0000ff" "#ff00ff" "#000000" "#808080" "#c0c0c0"))
(define (%dxf-index-color i)
  (define (part x) (exact (round (* 255 x))))
  (define (hex r g b) (%hex-color (+ (* 65536 (part r)) (* 256 (part g)) (part b))))
  (cond ((< i 10) (vector-ref %dxf-pure (max i 0)))
        ((>= i 250) (let ((grey (+ 0.2 (* 0.16 (- (min i 255) 250))))) (hex grey grey grey)))
        (else
          (let* ((hue (/ (- (quotient i 10) 1) 4)) (shade (vector-ref %dxf-shades (quotient (modulo i 10) 2))) (pale? (odd? i)))
            (define (channel k)
              (let* ((far (abs (- (let ((d (- hue (* 2 k)))) (- d (* 6 (floor (/ (+ d 3) 6))))))))
                     (full (min 1 (max 0 (- 2 far)))))
                (* shade (if pale? (/ (+ 1 full) 2) full))))
            (hex (channel 0) (channel 1) (channel 2))))))

; Returns the entity's colour: "#rrggbb", 'block or 'layer.
(define (%dxf-color f e)
  (let ((true-color (%dxf-value f e 420 #f)) (index (%dxf-value f e 62 256)))
    (cond (true-color (%hex-color (modulo true-color 16777216)))
          ((= index 0) 'block)
          ((= (abs index) 256) 'layer)
          (else (%dxf-index-color (abs index))))))

(define (%dxf-layer-row f name) (hash-ref (%dxf-layers f) (string-downcase name) (lambda () (cons name "#000000"))))

; ---- curves ----

; Returns the arc from p to q with a bulge, the tangent of a quarter of its angle, as a step of %joined-steps.
(define (%bulge-step p q bulge)
  (if (or (= bulge 0) (= (distance p q) 0))
      (list 'line q)
      (let* ((half (/ (distance p q) 2)) (sagitta (* half bulge))
             (r (/ (+ (* half half) (* sagitta sagitta)) (* 2 (abs sagitta))))
             (d (unitize (p->q p q))) (left (vxyz (- (cy d)) (cx d) 0))
             (c (p+v (mid p q) (v*r left (/ (- (* half half) (* sagitta sagitta)) (* 2 sagitta)))))
             (a (atan (- (cy p) (cy c)) (- (cx p) (cx c)))) (turn (* 4 (atan bulge))))
        (list 'curve (make-arc c r a (+ a turn)) q))))

; Returns the curve through vertices (point . bulge), or #f.
(define (%bulged-curve vertices closed?)
  (if (or (null? vertices) (null? (cdr vertices)))
      #f
      (%joined-steps (caar vertices)
        (let loop ((v vertices) (steps '()))
          (cond ((pair? (cdr v)) (loop (cdr v) (cons (%bulge-step (caar v) (caadr v) (cdar v)) steps)))
                (closed? (reverse (cons (%bulge-step (caar v) (caar vertices) (cdar v)) steps)))
                (else (reverse steps))))
        closed?)))

(define (%maybe o) (if o (list o) '()))

(define (%dxf-lwpolyline f e)
  (let ((vertices '()) (x #f) (bulge 0) (z (%dxf-length f e 38 0.)) (y 0) (k (%dxf-factor f)))
    (define (keep) (if x (set! vertices (cons (cons (xyz x y z) bulge) vertices))))
    (%dxf-each f e
      (lambda (code value)
        (case code
          ((10) (keep) (set! x (* k value)) (set! y 0) (set! bulge 0))
          ((20) (set! y (* k value)))
          ((42) (set! bulge value)))))
    (keep)
    (map (lambda (o) (%by-matrix (%dxf-own-plane f e) o))
         (%maybe (%bulged-curve (reverse vertices) (odd? (%dxf-value f e 70 0)))))))

(define (%dxf-arc f e)
  (let* ((r (%dxf-length f e 40 0.)) (a (%dxf-angle f e 50 0.)) (b (%dxf-angle f e 51 360.)) (turn (- b a)))
    (%dxf-must f e (> r 0) "its radius is not above 0")
    (let ((turn (- turn (* 2 pi (floor (/ turn (* 2 pi)))))))
      (list (%by-matrix (%dxf-own-plane f e)
              (if (< turn 1e-12) (make-circle (%dxf-point f e 10) r) (make-arc (%dxf-point f e 10) r a (+ a turn))))))))

(define (%dxf-circle f e)
  (%dxf-must f e (> (%dxf-value f e 40 0.) 0) "its radius is not above 0")
  (list (%by-matrix (%dxf-own-plane f e) (make-circle (%dxf-point f e 10) (%dxf-length f e 40 0.)))))

; Returns an elliptical arc about c with the half axes u and v, from parameter a to b, as a curve.
(define (%ellipse-curve c u v a b)
  (let* ((n (cross u v)) (turn (- b a)) (whole? (>= (abs turn) (- (* 2 pi) 1e-9)))
         (n (if (= (vlength n) 0) (vxyz 0 0 1) (unitize n)))
         (arc (if whole? (make-circle origin 1) (make-arc origin 1 a b))))
    (do-transform arc (make-matrix (cx u) (cx v) (cx n) (cx c) (cy u) (cy v) (cy n) (cy c) (cz u) (cz v) (cz n) (cz c) 0 0 0 1))))

(define (%dxf-ellipse f e)
  (let* ((c (%dxf-point f e 10)) (m (%dxf-point f e 11)) (u (vxyz (cx m) (cy m) (cz m)))
         (n (vxyz (%dxf-value f e 210 0.) (%dxf-value f e 220 0.) (%dxf-value f e 230 1.)))
         (ratio (%dxf-value f e 40 1.)) (a (%dxf-value f e 41 0.)) (b (%dxf-value f e 42 (* 2 pi))))
    (%dxf-must f e (> (vlength u) 0) "its longer axis has the length 0")
    (%dxf-must f e (and (> (vlength n) 0) (> (abs ratio) 0)) "its shorter axis has the length 0")
    (let* ((v (v*r (cross (unitize n) u) ratio)) (b (if (> b a) b (+ b (* 2 pi)))))
      (list (%ellipse-curve c u v a b)))))

; Returns the curve of a spline's numbers, or that through its fit points.
(define (%dxf-spline-curve degree points weights knots fits)
  (cond ((and (pair? points) (pair? (cdr points)))
         (make-nurbs-curve points #:degree degree #:weights (and (= (length weights) (length points)) weights) #:knots (and (pair? knots) knots)))
        ((and (pair? fits) (pair? (cdr fits))) (make-spline fits))
        (else (error "it has fewer than two points"))))

(define (%dxf-spline f e)
  (let ((k (%dxf-factor f)) (knots '()) (weights '()) (points '()) (fits '()))
    (define (put l axis value) ; sets y (1) or z (2) of the newest point
      (if (null? l) l
          (let ((p (car l))) (cons (if (= axis 1) (xyz (cx p) (* k value) (cz p)) (xyz (cx p) (cy p) (* k value))) (cdr l)))))
    (%dxf-each f e
      (lambda (code value)
        (case code
          ((40) (set! knots (cons value knots)))
          ((41) (set! weights (cons value weights)))
          ((10) (set! points (cons (xyz (* k value) 0 0) points)))
          ((20) (set! points (put points 1 value)))
          ((30) (set! points (put points 2 value)))
          ((11) (set! fits (cons (xyz (* k value) 0 0) fits)))
          ((21) (set! fits (put fits 1 value)))
          ((31) (set! fits (put fits 2 value))))))
    (list (%dxf-spline-curve (%dxf-value f e 71 3) (reverse points) (reverse weights) (reverse knots) (reverse fits)))))

; ---- polylines and meshes of vertices ----

(define (%mesh-or-nothing points faces)
  (if (null? faces) '() (list (make-polyface-mesh points faces))))

; The faces of a grid of m rows of n points.
(define (%grid-faces m n closed-m? closed-n?)
  (append-map
    (lambda (i)
      (map (lambda (j)
             (let ((i1 (modulo (+ i 1) m)) (j1 (modulo (+ j 1) n)))
               (map (lambda (p) (+ 1 (* n (car p)) (cdr p))) (list (cons i j) (cons i1 j) (cons i1 j1) (cons i j1)))))
           (iota (if closed-n? n (- n 1)))))
    (iota (if closed-m? m (- m 1)))))

(define (%dxf-polyline f e vertices)
  (let* ((flags (%dxf-value f e 70 0)) (bit? (lambda (flags b) (odd? (quotient flags b)))))
    (define (place v) (%dxf-point f v 10))
    (define (flags-of v) (%dxf-value f v 70 0))
    (define (corner v code) (abs (%dxf-value f v code 0)))
    (cond
      ((bit? flags 64)
       (let* ((corners (filter (lambda (v) (and (bit? (flags-of v) 64) (bit? (flags-of v) 128))) vertices))
              (faces (filter (lambda (v) (and (bit? (flags-of v) 128) (not (bit? (flags-of v) 64)))) vertices))
              (lists (map (lambda (v) (filter positive? (map (lambda (c) (corner v c)) '(71 72 73 74)))) faces)))
         (for-each (lambda (l v) (%dxf-must f v (every (lambda (i) (<= i (length corners))) l) "a face has a corner that is not there")) lists faces)
         (%mesh-or-nothing (map place corners) (filter (lambda (l) (> (length l) 2)) lists))))
      ((bit? flags 16)
       (let* ((m (%dxf-value f e 71 0)) (n (%dxf-value f e 72 0))
              (corners (filter (lambda (v) (not (bit? (flags-of v) 16))) vertices)) (all (map place (if (= (length corners) (* m n)) corners vertices))))
         (%dxf-must f e (and (> m 1) (> n 1) (= (length all) (* m n))) (format "a mesh of ~a rows of ~a has ~a vertices" m n (length all)))
         (%mesh-or-nothing all (%grid-faces m n (bit? flags 1) (bit? flags 32)))))
      (else
        (let ((shown (filter (lambda (v) (not (bit? (flags-of v) 16))) vertices)) (closed? (odd? flags)))
          (map (lambda (o) (if (bit? flags 8) o (%by-matrix (%dxf-own-plane f e) o)))
               (%maybe (%bulged-curve (map (lambda (v) (cons (place v) (if (bit? flags 8) 0 (%dxf-value f v 42 0)))) shown) closed?))))))))

(define (%dxf-3dface f e)
  (let* ((points (map (lambda (code) (%dxf-point f e code)) '(10 11 12 13)))
         (all (let loop ((l points) (kept '())) (cond ((null? l) (reverse kept)) ((member (car l) kept) (loop (cdr l) kept)) (else (loop (cdr l) (cons (car l) kept)))))))
    (case (length all)
      ((4) (list (apply make-3dface all)))
      ((3) (list (make-polyface-mesh all '((1 2 3)))))
      (else '()))))

; A filled triangle or quadrilateral; its last two corners are swapped.
(define (%dxf-solid f e)
  (let* ((p (map (lambda (code) (%dxf-point f e code)) '(10 11 13 12))) (closed (%joined-steps (car p) (map (lambda (q) (list 'line q)) (cdr p)) #t)))
    (if closed (map (lambda (o) (%by-matrix (%dxf-own-plane f e) o)) (%region-or-curves (list closed))) '())))

(define (%dxf-mesh f e)
  (let ((k (%dxf-factor f)) (points '()) (x 0) (y 0) (indices '()) (part 'head))
    (%dxf-each f e
      (lambda (code value)
        (cond ((and (= code 92) (eq? part 'head)) (set! part 'points))
              ((and (= code 93) (eq? part 'points)) (set! part 'faces))
              ((= code 94) (set! part 'edges))
              ((eq? part 'points)
               (case code
                 ((10) (set! x (* k value)))
                 ((20) (set! y (* k value)))
                 ((30) (set! points (cons (xyz x y (* k value)) points)))))
              ((and (eq? part 'faces) (= code 90)) (set! indices (cons value indices))))))
    (let loop ((l (reverse indices)) (faces '()))
      (if (null? l)
          (%mesh-or-nothing (reverse points) (reverse faces))
          (let ((n (car l)))
            (%dxf-must f e (and (> n 0) (<= n (length (cdr l)))) "the list of its faces is cut")
            (let ((face (take (cdr l) n)))
              (%dxf-must f e (every (lambda (i) (< -1 i (length points))) face) "a face has a corner that is not there")
              (loop (list-tail (cdr l) n) (if (> n 2) (cons (map (lambda (i) (+ i 1)) face) faces) faces))))))))

; ---- hatches ----

; Reads the boundary paths in order: a reader of the groups one by one, from the group 91 on.
(define (%dxf-hatch f e)
  (define g (%dxf-groups-of f))
  (define end (vector-ref e 2))
  (define k (%dxf-factor f))
  (define z (* k (%dxf-value f e 30 0.)))
  (define at (let loop ((i (+ (vector-ref e 1) 2))) (if (or (>= i end) (= (vector-ref g i) 91)) i (loop (+ i 2)))))
  (define (cut) (%outline-fail (%dxf-path f) (+ at 1) "HATCH: its boundary is cut"))
  (define (need code) ; the value of the next group, which must have this code
    (if (and (< at end) (= (vector-ref g at) code))
        (let ((value (vector-ref g (+ at 1)))) (set! at (+ at 2)) value)
        (cut)))
  (define (next? code) (and (< at end) (= (vector-ref g at) code)))
  (define (maybe code default) (if (next? code) (need code) default))
  (define (point code) (let* ((x (need code)) (y (need (+ code 10)))) (xyz (* k x) (* k y) z)))
  (define (times n read) (let loop ((i 0) (l '())) (if (>= i n) (reverse l) (loop (+ i 1) (cons (read) l)))))
  (define (count code) (let ((n (need code))) (if (or (< n 0) (> n (- end at))) (cut) n)))
  (define (polyline)
    (let* ((bulges? (= 1 (need 72))) (closed? (= 1 (maybe 73 1))) (n (count 93)))
      (%bulged-curve (times n (lambda () (let ((p (point 10))) (cons p (if bulges? (maybe 42 0) 0))))) closed?)))
  (define (vector-to p) (vxyz (cx p) (cy p) 0))
  (define (edge)
    (case (need 72)
      ((1) (let* ((p (point 10)) (q (point 11))) (list p (list 'line q))))
      ((2)
       (let* ((c (point 10)) (r (* k (need 40))) (a (degrees->radians (need 50))) (b (degrees->radians (need 51))) (ccw? (= 1 (need 73))))
         (round-edge c (vxyz r 0 0) (vxyz 0 r 0) a b ccw? (lambda (a b) (if (>= (abs (- b a)) (- (* 2 pi) 1e-9)) (make-circle c r) (make-arc c r a b))))))
      ((3)
       (let* ((c (point 10)) (m (point 11)) (u (vector-to m)) (ratio (need 40)) (a (degrees->radians (need 50))) (b (degrees->radians (need 51))) (ccw? (= 1 (need 73)))
              (v (v*r (vxyz (- (cy u)) (cx u) 0) ratio)))
         (round-edge c u v a b ccw? (lambda (a b) (%ellipse-curve c u v a b)))))
      ((4)
       (let ((degree (need 94)))
         (maybe 73 0) (maybe 74 0)
         (let* ((knots (count 95)) (n (count 96)) (knots (times knots (lambda () (need 40))))
                (all (times n (lambda () (let ((p (point 10))) (cons p (maybe 42 1.))))))
                (fits (if (next? 97) (count 97) 0)))
           (times fits (lambda () (point 11)))
           (maybe 12 0) (maybe 22 0) (maybe 13 0) (maybe 23 0)
           (if (null? all) (cut))
           (list (caar all)
                 (list 'curve (%dxf-spline-curve degree (map car all) (map cdr all) knots '()) (car (last all)))))))
      (else (cut))))
  (define (round-edge c u v a b ccw? make)
    (let* ((sign (if ccw? 1 -1)) (a (* sign a)) (b (* sign b)) (turn (- b a)) (turn (if (< (abs turn) 1e-12) (* sign 2 pi) turn)))
      (define (on t) (p+v c (v+v (v*r u (cos t)) (v*r v (sin t)))))
      (list (on a) (list 'curve (make a (+ a turn)) (on (+ a turn))))))
  (define (edges)
    (let ((all (times (count 93) edge)))
      (and (pair? all) (%joined-steps (caar all) (map cadr all) #t))))
  (define (path)
    (let* ((flags (need 92)) (curve (if (odd? (quotient flags 2)) (polyline) (edges))))
      (times (if (next? 97) (count 97) 0) (lambda () (need 330)))
      curve))
  (if (>= at end) (cut))
  (let ((curves (filter (lambda (c) c) (times (count 91) path))))
    (if (null? curves) '() (map (lambda (o) (%by-matrix (%dxf-own-plane f e) o)) (%region-or-curves curves)))))

; ---- texts ----

; Replaces the codes of single characters: \U+00E9, %%d, %%c, %%p, ^ and a blank.
(define (%dxf-characters text)
  (let ((out (open-output-string)) (n (string-length text)))
    (define (is? i s) (and (<= (+ i (string-length s)) n) (string-ci=? (substring text i (+ i (string-length s))) s)))
    (let loop ((i 0))
      (if (< i n)
          (let ((code (and (is? i "\\U+") (<= (+ i 7) n) (string->number (substring text (+ i 3) (+ i 7)) 16))))
            (cond ((and code (exact-integer? code) (>= code 0) (not (<= #xD800 code #xDFFF))) (write-char (integer->char code) out) (loop (+ i 7)))
                  ((is? i "%%d") (write-char #\° out) (loop (+ i 3)))
                  ((is? i "%%c") (write-char #\⌀ out) (loop (+ i 3)))
                  ((is? i "%%p") (write-char #\± out) (loop (+ i 3)))
                  ((or (is? i "%%u") (is? i "%%o")) (loop (+ i 3)))
                  ((is? i "%%%") (write-char #\% out) (loop (+ i 3)))
                  ((is? i "^ ") (write-char #\^ out) (loop (+ i 2)))
                  (else (write-char (string-ref text i) out) (loop (+ i 1)))))
          (get-output-string out)))))

; Returns an MTEXT's characters without its formats: {\fArial;...}, \H2x;, \P and the like.
(define (%dxf-plain text)
  (let ((out (open-output-string)) (n (string-length text)))
    (define (past-semicolon i) (cond ((>= i n) n) ((char=? (string-ref text i) #\;) (+ i 1)) (else (past-semicolon (+ i 1)))))
    (let loop ((i 0))
      (if (< i n)
          (let ((c (string-ref text i)) (d (if (< (+ i 1) n) (string-ref text (+ i 1)) #\space)))
            (cond ((memv c '(#\{ #\})) (loop (+ i 1)))
                  ((not (char=? c #\\)) (write-char c out) (loop (+ i 1)))
                  ((memv d '(#\P #\X #\N)) (newline out) (loop (+ i 2)))
                  ((char=? d #\~) (write-char #\space out) (loop (+ i 2)))
                  ((memv d '(#\\ #\{ #\})) (write-char d out) (loop (+ i 2)))
                  ((memv d '(#\U #\M)) (write-char c out) (loop (+ i 1)))
                  ((memv d '(#\L #\l #\O #\o #\K #\k)) (loop (+ i 2)))
                  ((char=? d #\S)
                   (let ((end (past-semicolon i)))
                     (write-string (string-replace (string-replace (substring text (+ i 2) (max (+ i 2) (- end 1))) "^" "/") "#" "/") out)
                     (loop end)))
                  ((memv d '(#\f #\F #\H #\h #\C #\c #\A #\T #\Q #\W #\p)) (loop (past-semicolon i)))
                  (else (loop (+ i 1)))))
          (%dxf-characters (get-output-string out))))))

(define (%dxf-letters f e p size string align valign turn)
  (if (or (<= size 0) (string=? (string-trim string) ""))
      '()
      (let ((text (make-text p size string #:align align #:valign valign)))
        (list (%by-matrix (%dxf-own-plane f e) (if (= turn 0) text (do-rotate text p (vxyz 0 0 1) turn)))))))

(define (%dxf-text f e)
  (let* ((across (%dxf-value f e 72 0)) (up (%dxf-value f e 73 0)) (second? (and (or (not (= across 0)) (not (= up 0))) (%dxf-value f e 11 #f)))
         (p (%dxf-point f e (if (and second? (not (memv across '(3 5)))) 11 10))))
    (%dxf-letters f e p (%dxf-length f e 40 0.) (%dxf-characters (%dxf-value f e 1 ""))
      (case across ((1 4) 'center) ((2) 'right) (else 'left))
      (if (= across 4) 'center (case up ((1) 'bottom) ((2) 'center) ((3) 'top) (else 'baseline)))
      (%dxf-angle f e 50 0.))))

(define (%dxf-mtext f e)
  (let* ((parts '()) (at (max 1 (min 9 (%dxf-value f e 71 1)))) (dx (%dxf-value f e 11 #f)) (dy (%dxf-value f e 21 0.)))
    (%dxf-each f e (lambda (code value) (if (memv code '(1 3)) (set! parts (cons value parts)))))
    (%dxf-letters f e (%dxf-point f e 10) (%dxf-length f e 40 0.) (%dxf-plain (apply string-append (reverse parts)))
      (vector-ref '#(left center right) (modulo (- at 1) 3))
      (vector-ref '#(top center bottom) (quotient (- at 1) 3))
      (if (and dx (not (and (= dx 0) (= dy 0)))) (atan dy dx) (%dxf-angle f e 50 0.)))))

; ---- the file ----

(define (%dxf-simple type)
  (case (string->symbol type)
    ((LINE) (lambda (f e) (let ((p (%dxf-point f e 10)) (q (%dxf-point f e 11))) (if (equal? p q) '() (list (make-line p q))))))
    ((LWPOLYLINE) %dxf-lwpolyline)
    ((ARC) %dxf-arc)
    ((CIRCLE) %dxf-circle)
    ((ELLIPSE) %dxf-ellipse)
    ((SPLINE) %dxf-spline)
    ((HATCH) %dxf-hatch)
    ((3DFACE) %dxf-3dface)
    ((SOLID TRACE) %dxf-solid)
    ((MESH) %dxf-mesh)
    ((TEXT ATTRIB) %dxf-text)
    ((MTEXT) %dxf-mtext)
    (else #f)))

(define (%dxf-hidden? f e) (or (= 1 (%dxf-value f e 67 0)) (= 1 (%dxf-value f e 60 0))))

; Calls (use layer colour object) for each object of a list of entities. layer and colour are those of the insertion,
; which entities of layer "0" and of the colour 'block take. active: the names of the blocks around.
(define (%dxf-entities f entities layer colour active use)
  (define (layer-of e) (let ((name (car (%dxf-layer-row f (%dxf-value f e 8 "0"))))) (if (and layer (string=? name "0")) layer name)))
  (define (colour-of e name)
    (let ((c (%dxf-color f e)))
      (cond ((eq? c 'block) (or colour "#000000")) ((eq? c 'layer) (cdr (%dxf-layer-row f name))) (else c))))
  (define (give e objects)
    (let* ((name (layer-of e)) (paint (colour-of e name))) (for-each (lambda (o) (use name paint o)) objects)))
  (let loop ((l entities))
    (if (pair? l)
        (let* ((e (car l)) (type (%dxf-type e)) (make (%dxf-simple type)))
          (cond
            ((string=? type "POLYLINE")
             (let split ((rest (cdr l)) (vertices '()))
               (cond ((and (pair? rest) (string=? (%dxf-type (car rest)) "VERTEX")) (split (cdr rest) (cons (car rest) vertices)))
                     (else
                       (%dxf-must f e (and (pair? rest) (string=? (%dxf-type (car rest)) "SEQEND")) "it has no SEQEND")
                       (if (not (%dxf-hidden? f e))
                           (give e (%outline-at (%dxf-path f) (%dxf-line e) type (lambda () (%dxf-polyline f e (reverse vertices))))))
                       (loop (cdr rest))))))
            ((%dxf-hidden? f e) (loop (cdr l)))
            ((member type '("INSERT" "DIMENSION"))
             (let ((name (layer-of e)))
               (%outline-at (%dxf-path f) (%dxf-line e) type (lambda () (%dxf-insert f e name (colour-of e name) active use))))
             (loop (cdr l)))
            (make (give e (%outline-at (%dxf-path f) (%dxf-line e) type (lambda () (make f e)))) (loop (cdr l)))
            ((member type '("SEQEND" "ATTDEF" "VIEWPORT" "VERTEX" "ACAD_PROXY_ENTITY")) (loop (cdr l)))
            ((and (string=? type "POINT") (string-ci=? (%dxf-value f e 8 "0") "defpoints")) (loop (cdr l))) ; of dimensions
            (else (hash-update! (%dxf-omitted f) type (lambda (n) (+ n 1)) 0) (loop (cdr l))))))))

; Returns the list of (layer colour object) of a block, (name entity ...), that is inserted in a layer with a colour.
(define (%dxf-block-parts f e block layer colour active)
  (hash-ref! (%dxf-parts f) (list (car block) layer colour)
    (lambda ()
      (let ((parts '()) (count 0))
        (%dxf-entities f (cdr block) layer colour (cons (car block) active)
          (lambda (layer colour o)
            (set! count (+ count 1))
            (%dxf-must f e (<= count %outline-most) (format "its block holds more than ~a objects" %outline-most))
            (set! parts (cons (list layer colour o) parts))))
        (reverse parts)))))

(define (%dxf-insert f e layer colour active use)
  (let* ((name (string-downcase (%dxf-value f e 2 ""))) (block (hash-ref (%dxf-blocks f) name #f)) (insert? (string=? (%dxf-type e) "INSERT")))
    (cond
      ((not block) (%dxf-must f e (not insert?) (format "there is no block ~s" name)))
      ((member name active) (%dxf-must f e #f (format "the block ~s contains itself" name)))
      (else
        (let* ((turn (if insert? (%dxf-angle f e 50 0.) 0)) (p (if insert? (%dxf-point f e 10) origin)) (b (if insert? (car block) origin))
               (scale (lambda (code) (let ((s (%dxf-value f e code 1.))) (if (or (not insert?) (= s 0)) 1. s))))
               (columns (if insert? (max 1 (%dxf-value f e 70 1)) 1)) (rows (if insert? (max 1 (%dxf-value f e 71 1)) 1))
               (dx (%dxf-length f e 44 0.)) (dy (%dxf-length f e 45 0.)))
          (%dxf-must f e (<= (* columns rows) 100000) "it has too many rows and columns")
          (let ((inside (%dxf-block-parts f e (cons name (cdr block)) layer colour active)) (plane (if insert? (%dxf-own-plane f e) %identity-matrix)))
            (do ((j 0 (+ j 1))) ((= j rows))
              (do ((i 0 (+ i 1))) ((= i columns))
                (let ((m (%dxf-placement plane p turn (list (scale 41) (scale 42) (scale 43)) (vxyz (* i dx) (* j dy) 0) b)))
                  (for-each (lambda (part) (use (car part) (cadr part) (%by-matrix m (caddr part)))) inside))))))))))

; Returns the matrix of an insertion: the base point to the origin, scaled, moved by the step of its row and column,
; turned, moved to p, in the plane of its extrusion.
(define (%dxf-placement plane p turn scales step base)
  (let* ((sx (car scales)) (sy (cadr scales)) (sz (caddr scales)) (scaled (make-matrix sx 0 0 (- (cx step) (* sx (cx base))) 0 sy 0 (- (cy step) (* sy (cy base))) 0 0 sz (- (* sz (cz base))) 0 0 0 1))
        (turned (if (= turn 0) %identity-matrix (rotation-matrix 'z turn))))
    (matrix* plane (translation-matrix (vxyz (cx p) (cy p) (cz p))) turned scaled)))

; Returns the places of the entities: a list of (section block entity), in order; block is the entity BLOCK or #f.
(define (%dxf-scan groups path use)
  (define n (let loop ((n (* 2 (quotient (vector-length groups) 2)))) (if (and (> n 0) (not (vector-ref groups (- n 2)))) (loop (- n 2)) n)))
  (define (type-at i) (vector-ref groups (+ i 1)))
  (define (end-of i) (let loop ((j (+ i 2))) (if (or (>= j n) (= 0 (vector-ref groups j))) j (loop (+ j 2)))))
  (let loop ((i 0) (section #f) (block #f))
    (if (< i n)
        (let* ((j (end-of i)) (type (if (= 0 (vector-ref groups i)) (type-at i) "")))
          (cond
            ((string=? type "SECTION")
             (if section (%outline-fail path (+ i 1) "a section begins within a section"))
             (loop j (if (and (< (+ i 3) n) (= 2 (vector-ref groups (+ i 2)))) (vector-ref groups (+ i 3)) "") #f))
            ((string=? type "ENDSEC") (loop j #f #f))
            ((string=? type "EOF") (if section (%outline-fail path (+ i 1) (format "the file ends within the section ~a" section))))
            ((string=? type "BLOCK") (let ((e (vector type i j))) (use section e e) (loop j section e)))
            ((string=? type "ENDBLK") (loop j section #f))
            (else (use section block (vector type i j)) (loop j section block)))))))

; Metres in the units of $INSUNITS; 0 has none.
(define %dxf-units '((1 . 0.0254) (2 . 0.3048) (3 . 1609.344) (4 . 0.001) (5 . 0.01) (6 . 1.) (7 . 1000.) (8 . 2.54e-8) (9 . 2.54e-5) (10 . 0.9144)
                     (11 . 1e-10) (12 . 1e-9) (13 . 1e-6) (14 . 0.1) (15 . 10.) (16 . 100.) (21 . 0.30480060960121924)))

; Returns the factor from the header's unit to the model's.
(define (%dxf-header-factor groups)
  (let ((n (vector-length groups)))
    (let loop ((i 0))
      (cond ((or (>= (+ i 3) n) (not (vector-ref groups i))) 1)
            ((and (= 0 (vector-ref groups i)) (equal? (vector-ref groups (+ i 1)) "ENDSEC")) 1)
            ((and (= 9 (vector-ref groups i)) (equal? (vector-ref groups (+ i 1)) "$INSUNITS") (eqv? 70 (vector-ref groups (+ i 2))))
             (let* ((unit (assv (vector-ref groups (+ i 3)) %dxf-units)) (factor (if unit (/ (cdr unit) (%model-metres)) 1)))
               (if (< (abs (- factor 1)) 1e-12) 1 factor)))
            (else (loop (+ i 2)))))))

(define (%load-dxf path made)
  (let* ((groups (%load-outline path)) (f (%make-dxf-file groups path (make-hash) (make-hash) (%dxf-header-factor groups) (make-hash) (make-hash)))
         (entities '()) (bodies (make-hash)))
    (%dxf-scan groups path
      (lambda (section block e)
        (cond
          ((equal? section "TABLES")
           (if (string=? (%dxf-type e) "LAYER")
               (let ((name (%dxf-value f e 2 "0")) (c (%dxf-color f e)))
                 (hash-set! (%dxf-layers f) (string-downcase name) (cons name (if (string? c) c "#000000"))))))
          ((equal? section "BLOCKS")
           (cond ((not block) #f)
                 ((eq? block e) (hash-set! (%dxf-blocks f) (string-downcase (%dxf-value f e 2 "")) (list e)))
                 (else (hash-update! bodies block (lambda (l) (cons e l)) '()))))
          ((equal? section "ENTITIES") (set! entities (cons e entities))))))
    (hash-for-each (hash-copy (%dxf-blocks f))
      (lambda (name entry)
        (let ((e (car entry))) (hash-set! (%dxf-blocks f) name (cons (%dxf-point f e 10) (reverse (hash-ref bodies e '())))))))
    (%dxf-entities f (reverse entities) #f #f '()
      (lambda (name paint o)
        (%outlines-add! made name (layer name #:color (cdr (%dxf-layer-row f name)) (color paint o)))))
    (if (> (hash-count (%dxf-omitted f)) 0)
        (%warn (format "load-outline: ~a: omits ~a" path
                 (string-join (map (lambda (p) (format "~a ~a" (cdr p) (car p))) (sort (hash->list (%dxf-omitted f)) (lambda (a b) (string<? (car a) (car b))))) ", "))))))
