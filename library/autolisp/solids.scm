; The commands that make solids. Answers that end a command return #f.

(define (made o) (made! o) #f)

; A box from its corner p; next gets both corners.
(define (asks-box next)
  (define (lengths make)
    (list (option "Cube" (asks "a length" as-number (lambda (l) (make l l l))))
          (option "Length"
            (asks "a length" as-number (lambda (l) (asks "a width" as-number (lambda (w)
              (asks "a height" as-number (lambda (h) (make l w h))))))))))
  (define (from-center c)
    (define (make x y z) (next (+xyz c (/ x -2) (/ y -2) (/ z -2)) (+xyz c (/ x 2) (/ y 2) (/ z 2))))
    (apply asks "a corner" as-point
      (lambda (q)
        (let ((d (p->q c q)))
          (if (= (cz d) 0)
              (asks "a height" as-number (lambda (h) (make (* 2 (cx d)) (* 2 (cy d)) h)))
              (make (* 2 (cx d)) (* 2 (cy d)) (* 2 (cz d))))))
      (lengths make)))
  (asks "a corner" as-point
    (lambda (p)
      (apply asks "the other corner" as-point
        (lambda (q) (if (= (cz p) (cz q)) (asks "a height" (as-length-from q) (lambda (h) (next p (+z q h)))) (next p q)))
        (lengths (lambda (x y z) (next p (+xyz p x y z))))))
    (option "Center" (asks "a centre" as-point from-center))))

(define (asks-radius what p next)
  (asks what (as-length-from p) next
    (option "Diameter" (asks "a diameter" (as-length-from p) (lambda (d) (next (/ d 2)))))))
(define (asks-center-and-radius next)
  (asks "a centre" as-point (lambda (p) (asks-radius "a radius" p (lambda (r) (next p r))))))
(define (asks-top p next . options)
  (apply asks "a height" (as-length-from p) (lambda (h) (next (+z p h)))
    (option "Axis endpoint" (asks "the axis' end" as-point next))
    (option "2Point" (asks "a point" as-point (lambda (a) (asks "a point" as-point (lambda (b) (next (+z p (distance a b))))))))
    options))

(define-command '("BOX") (asks-box (lambda (p q) (made (make-box p q)))))
(define-command '("WEDGE" "WE")
  (asks-box (lambda (p q)
    (let ((w (make-wedge p q)))
      ; the full height is above the first corner, and the base is at its height
      (let* ((m (mid p q)) (w (if (< (cx q) (cx p)) (do-mirror w (make-plane m (vxyz 1 0 0))) w)))
        (made (if (< (cz q) (cz p)) (do-mirror w (make-plane m (vxyz 0 0 1))) w)))))))
(define-command '("CYLINDER" "CYL") (asks-center-and-radius (lambda (p r) (asks-top p (lambda (q) (made (make-cylinder p q r)))))))
(define-command '("CONE")
  (asks-center-and-radius
    (lambda (p r)
      (asks-top p (lambda (q) (made (make-cone p q r)))
        (option "Top radius" (asks-radius "a top radius" p (lambda (top) (asks-top p (lambda (q) (made (make-cut-cone p r q top)))))))))))
(define-command '("SPHERE") (asks-center-and-radius (lambda (p r) (made (make-sphere p r)))))
(define-command '("TORUS" "TOR")
  (asks-center-and-radius (lambda (p r) (asks-radius "a tube's radius" p (lambda (tube) (made (make-torus p r tube)))))))

; ---- solids from profiles ----

(define (each-made profiles make) (for-each (lambda (e) (copied! e (make (entity-object e))) (erased! e)) profiles) #f)
(define-command '("EXTRUDE" "EXT")
  (asks-objects
    (lambda (l)
      (define (height taper)
        (asks "a height" as-number
          (lambda (h) (each-made l (lambda (o) (if (= taper 0) (do-extrude o h) (do-extrude o h taper)))))
          (option "Taper angle" (asks "an angle" as-degrees height))
          (option "Direction"
            (asks "a point" as-point (lambda (p) (asks "a point" as-point (lambda (q) (each-made l (lambda (o) (do-extrude o (p->q p q)))))))))
          (option "Path" (asks-object "a path" (lambda (path) (each-made l (lambda (o) (do-sweep o (entity-object path)))))))))
      (height 0))))
(define-command '("REVOLVE" "REV")
  (asks-objects
    (lambda (l)
      (define (about p v)
        (define (turn from) (lambda (a) (let ((axis (make-axis p v))) (each-made l (lambda (o) (do-revolve o axis from (+ from a)))))))
        (asks "an angle" as-degrees (turn 0) (option "" ((turn 0) 2pi))
          (option "STart angle" (asks "an angle" as-degrees (lambda (from) (asks "an angle" as-degrees (turn from)))))))
      (asks "a point of the axis" as-point
        (lambda (p) (asks "a second point of the axis" as-point (lambda (q) (about p (p->q p q)))))
        (option "X" (about (xyz 0 0 0) (vxyz 1 0 0)))
        (option "Y" (about (xyz 0 0 0) (vxyz 0 1 0)))
        (option "Z" (about (xyz 0 0 0) (vxyz 0 0 1)))))))
(define-command '("SWEEP")
  (asks-objects
    (lambda (l)
      (define (path twist scale)
        (asks "a path" as-item
          (lambda (e) (each-made l (lambda (o) (do-sweep o (entity-object e) twist scale))))
          (option "Last" (each-made l (lambda (o) (do-sweep o (entity-object (newest)) twist scale))))
          (option "Twist" (asks "an angle" as-degrees (lambda (a) (path a scale))))
          (option "Scale" (asks "a factor" as-number (lambda (k) (path twist k))))))
      (path 0 1))))
(define-command '("LOFT")
  (asks-objects
    (lambda (l)
      (define (made-of make)
        (let ((o (make (map entity-object l)))) (for-each erased! l) (made o)))
      (asks "an option" (lambda (v) #f) (lambda (v) #f)
        (option "" (made-of do-loft))
        (option "Cross sections only" (made-of do-loft))
        (option "Path" (asks-object "a path" (lambda (path) (made-of (lambda (s) (do-guided-loft s (entity-object path)))))))
        (option "Guides" (asks-objects (lambda (g) (made-of (lambda (s) (do-guided-loft s (map entity-object g)))))))))))

; ---- booleans: the first object stays, changed; the others are erased ----

(define (combined! l others combine)
  (set-entity-object! (car l) (combine (map entity-object l) (map entity-object others)))
  (for-each erased! (cdr l))
  (for-each erased! others)
  #f)
(define-command '("UNION" "UNI") (asks-objects (lambda (l) (combined! l '() (lambda (all none) (unite all))))))
(define-command '("INTERSECT" "IN") (asks-objects (lambda (l) (combined! l '() (lambda (all none) (apply intersect all))))))
(define-command '("SUBTRACT" "SU")
  (asks-objects (lambda (l) (asks-objects (lambda (cut) (combined! l cut (lambda (all cutters) (subtract (unite all) cutters))))))))

; ---- the words of the courses, which are such commands ----

(define (:cut-cone p base-r top-r height) (:command "CONE" p base-r "Top" top-r height) (:entlast))
(define (:box2 p q) (:command "BOX" p q) (:entlast))

