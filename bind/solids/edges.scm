; Faces and edges of solids as values, and selectors of them. After whole_solids.scm. Names that begin with % are hidden
; from programs. Compiled into the binary when it is built.

; ---- faces and edges: objects of two kinds, whose children are a surface and a curve ----

(define %face-type (%custom-type 'face 'face))
(define %edge-type (%custom-type 'edge 'edge))

(define (%face? x) (and (object? x) (%custom-is? %face-type x)))
(define (%edge? x) (and (object? x) (%custom-is? %edge-type x)))
(define (%need-face who f) (if (not (%face? f)) (error who "f must be a face of a solid, got ~s" f)))
(define (%need-edge who e) (if (not (%edge? e)) (error who "e must be an edge of a solid, got ~s" e)))

; A face: its form (0 a plane, 1 a cylinder, 2 another), area, normal or axis direction, a point of the plane or axis,
; the radius (negative for a hole), the primitive that it came from.
(define (%face-value f i) (list-ref (cdr (%custom-entry f)) i))
(define (%face-plane? f) (= (%face-value f 0) 0))
(define (%face-round? f) (= (%face-value f 0) 1))
(define (%face-direction f) (%face-value f 2))
(define (%face-point f) (%face-value f 3))
(define (%face-radius f) (%face-value f 4))

(define (face-area f) (%need-face 'face-area f) (%face-value f 1))
(define (face-normal f)
  (%need-face 'face-normal f)
  (if (not (%face-plane? f)) (error 'face-normal "f must be a plane face; this one is curved"))
  (%face-direction f))
(define (face-origin f) (%need-face 'face-origin f) (and (%face-value f 5) (object-origin (%face-value f 5))))

; An edge: its angle, its two faces, its points, whether it is closed, and its form: line, circle or another.
(define (%edge-value e i) (list-ref (cdr (%custom-entry e)) i))
(define (%edge-points e) (%edge-value e 3))
(define (%edge-closed? e) (%edge-value e 4))
(define (%edge-straight? e) (eq? (%edge-value e 5) 'line))
(define (%edge-circular? e) (eq? (%edge-value e 5) 'circle))
(define (%edge-convex? e) (< (%edge-value e 0) pi))
(define (%edge-ends e) (let ((p (%edge-points e))) (list (first p) (last p))))

(define (edge-angle e) (%need-edge 'edge-angle e) (%edge-value e 0))
(define (edge-faces e) (%need-edge 'edge-faces e) (list (%edge-value e 1) (%edge-value e 2)))

(define (%collinear? points)
  (let* ((p (first points)) (q (last points)) (long (distance p q)))
    (and (> long 0) (every (lambda (r) (<= (vlength (cross (p->q p q) (p->q p r))) (* 1e-7 long long))) points))))

; Returns the circle about the axis of the round face that contains all points: its centre, or #f.
(define (%circle-about face points)
  (let* ((d (%face-direction face)) (at (%face-point face)) (rise (lambda (p) (dot d (p->q at p)))) (z (rise (first points)))
         (size (+ (abs (%face-radius face)) (distance at (first points)))))
    (and (every (lambda (p) (<= (abs (- (rise p) z)) (* 1e-6 size))) points) (p+v at (v*r d z)))))

; Returns the matrix that places the circle about the origin in XY: its centre, axis, and the point on +X.
(define (%frame-at center axis p)
  (let* ((z (unitize axis)) (q (p->q center p)) (x (unitize (v-v q (v*r z (dot q z))))) (y (cross z x)))
    (make-matrix (cx x) (cx y) (cx z) (cx center) (cy x) (cy y) (cy z) (cy center) (cz x) (cz y) (cz z) (cz center) 0 0 0 1)))

; Returns the angle of p in the frame, from 0 to 2 pi.
(define (%angle-in frame p)
  (let* ((q (%matrix-times-point (matrix-inverse frame) p)) (a (atan (cy q) (cx q)))) (if (< a 0) (+ a (* 2 pi)) a)))
(define (%matrix-times-point m p) (car (curve-division (do-transform (make-line p (+x p 1)) m) 1)))

(define (%polyline points closed) (make-line (if closed (append points (list (car points))) points)))

(define (%make-edge data faces)
  (let* ((a (list-ref faces (first data))) (b (list-ref faces (second data))) (closed (third data)) (angle (fourth data))
         (points (cddddr data)) (round (find (lambda (f) (and (%face-round? f) (not (%collinear? points)))) (list a b)))
         (center (and round (%circle-about round points)))
         (values-of (lambda (points form) (list angle a b points closed form))))
    (cond
      ((and (not closed) (%collinear? points))
       (let ((ends (list (first points) (last points)))) (%custom %edge-type (values-of ends 'line) (apply make-line ends))))
      (center
        (let* ((frame (%frame-at center (%face-direction round) (first points))) (r (abs (%face-radius round)))
               (turned (if (and (not closed) (> (%angle-in frame (second points)) pi))
                           (%frame-at center (v*r (%face-direction round) -1) (first points))
                           frame)))
          (%custom %edge-type (values-of points 'circle)
            (do-transform (if closed (make-circle origin r) (make-arc origin r 0 (%angle-in turned (last points)))) turned))))
      (else (%custom %edge-type (values-of points 'other) (%polyline points closed))))))

; Returns a pair: the faces and the edges of a solid.
(define (%faces-and-edges o)
  (let* ((data (%solid-faces o))
         (faces (map (lambda (f) (%custom %face-type (append (take f 5) (list (list-ref f 6))) (list-ref f 5))) (car data))))
    (cons faces (map (lambda (e) (%make-edge e faces)) (cdr data)))))

(define (%selector who name s)
  (cond
    ((procedure? s) s)
    ((and (list? s) (every object? s)) (lambda (x) (and (member x s) #t)))
    (else (error who "~a must be a selector, such as (edges-along 'z), or a list, got ~s" name s))))

(define (solid-faces o [select any? #f])
  (let ((all (car (%faces-and-edges (%solid-given 'solid-faces 'o o)))))
    (if select (filter (%selector 'solid-faces 'select select) all) all)))
(define (solid-edges o [select any? #f])
  (let ((all (cdr (%faces-and-edges (%solid-given 'solid-edges 'o o)))))
    (if select (filter (%selector 'solid-edges 'select select) all) all)))

; ---- selectors: procedures of an edge or a face ----

(define (%parallel? u v) (<= (vlength (cross u v)) (* 1e-6 (vlength u) (vlength v))))

(define (edges-along axis)
  (let ((d (%edges-along axis)))
    (lambda (e) (and (%edge-straight? e) (%parallel? d (apply p->q (%edge-ends e)))))))
(define (edges-of sel)
  (let ((f (%selector 'edges-of 'sel sel))) (lambda (e) (and (any f (edge-faces e)) #t))))
(define (edges-between a b)
  (let ((f (%selector 'edges-between 'a a)) (g (%selector 'edges-between 'b b)))
    (lambda (e) (let ((s (edge-faces e))) (and (or (and (f (first s)) (g (second s))) (and (g (first s)) (f (second s)))) #t)))))
(define (edges-where pred)
  (if (not (procedure? pred)) (error 'edges-where "pred must be a procedure of an edge, got ~s" pred))
  (lambda (e) (%need-edge 'edges-where e) (and (pred e) #t)))
(define (faces-towards v)
  (let ((d (%faces-towards v)))
    (lambda (f) (%need-face 'faces-towards f) (and (%face-plane? f) (%parallel? d (%face-direction f)) (> (dot d (%face-direction f)) 0)))))
(define (faces-where pred)
  (if (not (procedure? pred)) (error 'faces-where "pred must be a procedure of a face, got ~s" pred))
  (lambda (f) (%need-face 'faces-where f) (and (pred f) #t)))

(define (%selectors who l) (map (lambda (s) (%selector who 's s)) l))
(define (all-of . s) (let ((l (%selectors 'all-of s))) (lambda (x) (every (lambda (f) (f x)) l))))
(define (any-of . s) (let ((l (%selectors 'any-of s))) (lambda (x) (and (any (lambda (f) (f x)) l) #t))))
(define (none-of . s) (let ((l (%selectors 'none-of s))) (lambda (x) (not (any (lambda (f) (f x)) l)))))
