; The commands that make curves and faces.

; Asks for points up to Enter or Close. finish gets the points in their order, and whether the curve closes.
(define (asks-points first least finish)
  (define (more l)
    (define (enough n) (if (< (length l) n) (error 'command "~a needs ~a points, got ~a" command-name n (length l))))
    (asks "a point, and Enter (\"\") at the end" as-point (lambda (p) (more (cons p l)))
      (option "" (enough least) (finish (reverse l) #f))
      (option "Close" (enough 3) (finish (reverse l) #t))
      (option "Undo" (more (if (pair? l) (cdr l) l)))))
  (asks first as-point (lambda (p) (more (list p)))))
(define (distinct l)
  (let loop ((l l) (done '()))
    (cond ((null? l) (reverse done)) ((and (pair? done) (equal? (car l) (car done))) (loop (cdr l) done))
          (else (loop (cdr l) (cons (car l) done))))))
(define (path points closed?)
  (let ((l (distinct points))) (if closed? (apply make-polygon l) (make-line l))))

; Each segment is a line of its own.
(define-command '("LINE" "L")
  (asks-points "a first point" 2
    (lambda (points closed?)
      (for-each (lambda (p q) (if (not (equal? p q)) (made! (make-line p q))))
        points (if closed? (append (cdr points) (list (car points))) (cdr points)))
      #f)))
(define-command '("3DPOLY" "3P") (asks-points "a first point" 2 (lambda (points closed?) (made (path points closed?)))))

; ---- polylines: pieces are lines and arcs that continue in the direction of the piece before ----

; Returns the arc from p to q that leaves p in the direction v, in the plane of XY.
(define (tangent-arc p v q)
  (let* ((u (unitize v)) (n (vxyz (- (cy u)) (cx u) 0)) (d (p->q p q)) (side (dot d n)))
    (if (< (abs side) (* 1e-12 (vlength d)))
        (make-line p q)
        (arc-about (p+v p (v*r n (/ (dot d d) (* 2 side)))) p q (> side 0)))))
(define (arc-about c p q left?)
  (let* ((a (atan (- (cy p) (cy c)) (- (cx p) (cx c)))) (b (atan (- (cy q) (cy c)) (- (cx q) (cx c))))
         (b (cond ((and left? (<= b a)) (+ b 2pi)) ((and (not left?) (>= b a)) (- b 2pi)) (else b))))
    (make-arc c (distance c p) a b)))
; Returns the direction at q of the arc from p that leaves p in the direction v.
(define (direction-after v p q)
  (let* ((d (unitize (p->q p q))) (u (unitize v))) (v-v (v*r d (* 2 (dot d u))) u)))
(define-command '("PLINE" "PL")
  (let ()
    (define (finish pieces) (made (if (null? (cdr pieces)) (car pieces) (apply join-curves (reverse pieces)))))
    (define (more start p v pieces arc?)
      (define (piece q)
        (cond ((equal? p q) (list v pieces))
              (arc? (list (direction-after v p q) (cons (tangent-arc p v q) pieces)))
              (else (list (unitize (p->q p q)) (cons (make-line p q) pieces)))))
      (define (to q) (let ((r (piece q))) (more start q (car r) (cadr r) arc?)))
      (define (widths) (asks "a width" as-number (lambda (a) (asks "a width" as-number (lambda (b) (more start p v pieces arc?)) (option "" (more start p v pieces arc?))))))
      (define (close) (if (null? pieces) (error 'command "PLINE needs 2 points, got 1")) (finish (cadr (piece start))))
      (asks "a point, and Enter (\"\") at the end" as-point to
        (option "" (if (null? pieces) (error 'command "PLINE needs 2 points, got 1")) (finish pieces))
        (option "CLose" (close))
        (if arc? (option "CEnter" (asks "a centre" as-point (lambda (c) (asks "an end" as-point (lambda (q)
                                    (let ((radius (p->q c q)))
                                      (more start q (vxyz (- (cy radius)) (cx radius) 0) (cons (arc-about c p q #t) pieces) #t)))))))
                 (option "Close" (close)))
        (option "Arc" (more start p v pieces #t))
        (option "Line" (more start p v pieces #f))
        (option "Width" (widths)) (option "Halfwidth" (widths))))
    (asks "a first point" as-point (lambda (p) (more p p (vxyz 1 0 0) '() #f)))))

; ---- splines ----

(define-command '("SPLINE" "SPL")
  (asks-points "a first point" 2
    (lambda (points closed?)
      (made! (make-spline (if closed? (append points (list (car points))) points)))
      ; Enter twice keeps the directions at the ends
      (asks "Enter" (lambda (v) #f) (lambda (v) #f) (cons 'end #f)
        (option "" (asks "Enter" (lambda (v) #f) (lambda (v) #f) (cons 'end #f) (option "" #f)))))))

; ---- circles and arcs ----

; Returns the centre of the circle through three points, in the plane of XY.
(define (circle-center a b c)
  (let* ((u (p->q a b)) (v (p->q a c)) (n (cross u v)) (nn (dot n n)))
    (if (= nn 0) (error 'command "~a: the three points are on a line" command-name))
    (p+v a (v/r (v+v (v*r (cross v n) (dot u u)) (v*r (cross n u) (dot v v))) (* 2 nn)))))
(define (asks-three next)
  (asks "a first point" as-point (lambda (a) (asks "a second point" as-point (lambda (b) (asks "a third point" as-point (lambda (c) (next a b c))))))))
(define-command '("CIRCLE" "C")
  (asks "a centre" as-point
    (lambda (p) (asks-radius "a radius" p (lambda (r) (made (make-circle p r)))))
    (option "3P" (asks-three (lambda (a b c) (let ((m (circle-center a b c))) (made (make-circle m (distance m a)))))))
    (option "2P" (asks "a first point" as-point (lambda (a) (asks "a second point" as-point
      (lambda (b) (made (make-circle (mid a b) (/ (distance a b) 2))))))))))
(define-command '("ARC" "A")
  (let ()
    (define (around c p)
      (define (angle a) (let ((from (atan (- (cy p) (cy c)) (- (cx p) (cx c))))) (made (make-arc c (distance c p) from (+ from a)))))
      (asks "an end" as-point (lambda (q) (made (arc-about c p q #t)))
        (option "Angle" (asks "an angle" as-degrees angle))
        (option "chord Length" (asks "a length" as-number (lambda (l) (angle (* 2 (asin (/ l (* 2 (distance c p)))))))))))
    (define (after p)
      (asks "a second point" as-point
        (lambda (m) (asks "an end" as-point
          (lambda (q) (let ((c (circle-center p m q))) (made (arc-about c p q (> (cz (cross (p->q p m) (p->q m q))) 0)))))))
        (option "Center" (asks "a centre" as-point (lambda (c) (around c p))))
        (option "End"
          (asks "an end" as-point
            (lambda (q)
              (define (with-angle a)
                (let ((h (/ (distance p q) 2 (tan (/ a 2)))) (d (unitize (p->q p q))))
                  (made (arc-about (p+v (mid p q) (v*r (vxyz (- (cy d)) (cx d) 0) h)) p q (> a 0)))))
              (asks "a centre" as-point (lambda (c) (made (arc-about c p q #t)))
                (option "Center" (asks "a centre" as-point (lambda (c) (made (arc-about c p q #t)))))
                (option "Angle" (asks "an angle" as-degrees with-angle))
                (option "Direction" (asks "a direction" (as-degrees-from p) (lambda (a) (made (tangent-arc p (vpol 1 a) q)))))
                (option "Radius" (asks "a radius" as-number
                  (lambda (r) (with-angle (* 2 (asin (min 1 (/ (distance p q) 2 r)))))))))))))) 
    (asks "a start" as-point after
      (option "Center" (asks "a centre" as-point (lambda (c) (asks "a start" as-point (lambda (p) (around c p)))))))))

; ---- faces: four points, then two more for each further face ----

(define-command '("3DFACE" "3F")
  (let ()
    (define (third a b)
      (asks "a third point" as-point
        (lambda (c)
          (asks "a fourth point" as-point (lambda (d) (made! (make-3dface a b c d)) (third d c))
            (option "" (made! (make-3dface a b c c)) (third c c))))
        (option "" #f)))
    (asks "a first point" as-point (lambda (a) (asks "a second point" as-point (lambda (b) (third a b)))))))
(define-command '("RECTANG" "RECTANGLE" "REC")
  (asks "a corner" as-point (lambda (p) (asks "the other corner" as-point (lambda (q) (made (make-rectangle p q)))))))
