; Rounded and bevelled edges: do-fillet and do-chamfer. After edges.scm. Names that begin with % are hidden from programs.
; Compiled into the binary when it is built.
;
; A convex edge loses a body, and a concave edge gains one. Across the edge E, with directions t1 and t2 into its two
; faces, the body is the triangle E T1 T2 of a chamfer, or the part of the kite E T1 C T2 outside of the circle about C of
; a fillet; it reaches a little out of the material (into it, at a concave edge), so that no faces coincide. Along a
; straight edge it is extruded, along a circle revolved. For a concave edge all is done in the complement of the solid.
; A body ends
;   beyond the corner, where all other edges there are of its own kind (convex or concave);
;   at the plane between two walls, where the edge and one other are selected, and the third is of the other kind;
;   at the third face, or straight, elsewhere.
; Where all edges of a corner are selected and of one kind, and a ball touches all faces, the corner loses (or gains) the
; solid between the faces and the ball.

(define %margin 1/50) ; how far a body reaches out of the material, as a part of the setback

; ---- the section across an edge ----

; A section: its point E, the directions t1 and t2 into the faces, the faces' normals n1 and n2, of the complement if the
; edge is concave. All are in one plane.
(define (%section e p)
  (let* ((convex (%edge-convex? e)) (faces (edge-faces e)) (sign (if convex 1 -1))
         (normals (map (lambda (f) (v*r (%face-normal-at f p) sign)) faces)) (n1 (first normals)) (n2 (second normals)))
    ; the direction in the plane of the two normals, perpendicular to n, away from the other face's normal
    (define (into n other) (unitize (v*r (v-v other (v*r n (dot n other))) -1)))
    (list p (into n1 n2) (into n2 n1) n1 n2)))

; Returns the normal of a plane or round face at a point.
(define (%face-normal-at f p)
  (if (%face-plane? f)
      (%face-direction f)
      (let* ((d (%face-direction f)) (q (p->q (%face-point f) p)) (out (unitize (v-v q (v*r d (dot d q))))))
        (if (> (%face-radius f) 0) out (v*r out -1)))))

; Returns the setback on both faces: of a chamfer its size, of a fillet what its radius needs.
(define (%setback kind size s)
  (if (eq? kind 'chamfer) size (/ size (tan (/ (angle-between (second s) (third s)) 2)))))

; Returns the region to remove in a section: T1, a straight line or an arc, T2, and around outside of the faces.
(define (%section-region kind size s)
  (let* ((p (first s)) (t1 (second s)) (t2 (third s)) (n1 (fourth s)) (n2 (fifth s)) (back (%setback kind size s)) (m (* back %margin))
         (a (p+v p (v*r t1 back))) (b (p+v p (v*r t2 back)))
         (out (list (p+v b (v*r n2 m)) (p+v p (v*r (v+v n1 n2) (/ m (+ 1 (dot n1 n2))))) (p+v a (v*r n1 m)))))
    (if (eq? kind 'chamfer)
        (make-region (apply make-polygon a b out))
        (let* ((center (p+v a (v*r n1 (- size)))) (frame (%frame-at center (cross (p->q center a) (p->q center b)) a)))
          (make-region (join-curves (do-transform (make-arc origin size 0 (%angle-in frame b)) frame) (apply make-line b (append out (list a)))))))))

; ---- corners ----

; Returns a list of corners: (point edge ...), of the edges that end there.
(define (%corners edges size)
  (let ((table (make-hash)) (key (lambda (p) (map (lambda (f) (round (/ (f p) (* 1e-6 size)))) (list cx cy cz)))))
    (for-each
      (lambda (e)
        (if (not (%edge-closed? e))
            (for-each (lambda (p) (hash-set! table (key p) (let ((old (hash-ref table (key p) #f))) (if old (append old (list e)) (list p e))))) (%edge-ends e))))
      edges)
    (lambda (p) (cdr (hash-ref table (key p) (list p))))))

(define (%other-faces edges mine)
  (delete-duplicates (remove (lambda (f) (member f mine)) (append-map edge-faces edges))))

(define (%same-kind? e) (lambda (x) (eq? (%edge-convex? x) (%edge-convex? e))))

; Returns how the body of e ends at the corner p, where `out` leads out along the edge: (past length), or a list of a
; point and a normal of the half-space to keep.
(define (%body-end e p out others selected kind size s)
  (let* ((mine (edge-faces e)) (faces (%other-faces others mine)) (same? (%same-kind? e)) (sign (if (%edge-convex? e) 1 -1))
         (partner (find (lambda (x) (and (member x selected) (same? x) (%edge-straight? x))) others)))
    (define (third-plane)
      (let ((f (and (= (length faces) 1) (first faces))))
        (if (and f (%face-plane? f) (> (abs (dot out (%face-direction f))) 1e-3))
            (list p (v*r (%face-direction f) (if (> (dot out (%face-direction f)) 0) -1 1)))
            (list p (v*r out -1)))))
    (cond
      ((or (null? others) (null? (cdr others))) (list p (v*r out -1))) ; a smooth chain
      ((every same? others) (list 'past (%length-past p out faces sign kind size s)))
      ((and partner (= (length others) 2))
       (let* ((shared (find (lambda (f) (member f (edge-faces partner))) mine))
              (wall (lambda (x) (v*r (%face-normal-at (find (lambda (f) (not (equal? f shared))) (edge-faces x)) p) sign))))
         (if shared (list p (unitize (v-v (wall partner) (wall e)))) (third-plane))))
      (else (third-plane)))))

; Returns how far the body must go on past a corner to leave the other faces.
(define (%length-past p out faces sign kind size s)
  (let* ((back (%setback kind size s)) (reach (map (lambda (t) (v*r t back)) (list (second s) (third s)))))
    (apply max (* 2 %margin back)
      (append-map
        (lambda (f)
          (if (%face-plane? f)
              (let* ((n (v*r (%face-direction f) sign)) (rise (dot n out)))
                (map (lambda (w) (if (> rise 0.05) (+ (/ (- (dot n w)) rise) (* 2 %margin back)) (* 2 back))) reach))
              (list (* 2 back))))
        faces))))

; ---- bodies ----

(define (%cut-body body ends)
  (fold (lambda (end body) (if (eq? (first end) 'past) body (do-slice body (make-plane (first end) (second end))))) body ends))

(define (%straight-body e kind size selected at-corner)
  (let* ((ends (%edge-ends e)) (p (first ends)) (q (second ends)) (along (unitize (p->q p q))) (s (%section e p)) (back (%setback kind size s))
         (others (lambda (r) (remove (lambda (x) (equal? x e)) (at-corner r))))
         (end-p (%body-end e p (v*r along -1) (others p) selected kind size s))
         (end-q (%body-end e q along (others q) selected kind size s))
         (more (lambda (end) (if (eq? (first end) 'past) (second end) (* 2 back))))
         (region (do-move (%section-region kind size s) (v*r along (- (more end-p))))))
    (%cut-body (do-extrude region (v*r along (+ (distance p q) (more end-p) (more end-q)))) (list end-p end-q))))

; A circle: the section is revolved about the axis, with facets where the solid has them.
(define (%round-body e kind size at-corner)
  (let* ((points (%edge-points e)) (p (first points)) (f (find %face-round? (edge-faces e))) (axis (make-axis (%face-point f) (%face-direction f)))
         (region (%section-region kind size (%section e p))))
    (if (%edge-closed? e)
        (do-revolve region axis 0 2pi #:segments (length points))
        (let* ((center (%circle-about f points)) (frame (%frame-at center (%face-direction f) p))
               (ccw (< (%angle-in frame (second points)) pi)) (angle (%angle-in frame (last points)))
               (past (/ (%setback kind size (%section e p)) (abs (%face-radius f))))
               (more (lambda (q) (if (<= (length (at-corner q)) 2) 0 past))) ; 0 in a smooth chain
               (before (more p)) (after (more (last points))))
          (if ccw
              (do-revolve region axis (- before) (+ angle after))
              (do-revolve region axis (- (- angle (* 2 pi)) after) before))))))

(define (%edge-body e kind size selected at-corner)
  (if (%edge-straight? e) (%straight-body e kind size selected at-corner) (%round-body e kind size at-corner)))

; ---- balls at corners ----

; Returns the point whose distance from three planes is 0: the planes through p with normals a, b, c, moved by -r.
(define (%three-planes p normals r)
  (let* ((a (first normals)) (b (second normals)) (c (third normals)) (d (dot a (cross b c))))
    (and (> (abs d) 1e-6)
         (p+v p (v*r (v+v (cross b c) (v+v (cross c a) (cross a b))) (/ (- r) d))))))

; Returns the solid between a corner's faces and the ball that touches them all, or #f.
(define (%corner-body p edges r)
  (let* ((faces (delete-duplicates (append-map edge-faces edges))) (sign (if (%edge-convex? (first edges)) 1 -1))
         (normals (map (lambda (f) (v*r (%face-direction f) sign)) faces)) (ball (%three-planes p normals r)))
    (and ball
         (every (lambda (n) (near? (dot n (p->q ball p)) r (* 1e-6 r))) normals)
         (let* ((feet (map (lambda (n) (p+v ball (v*r n r))) normals))
                (on-edges (map (lambda (e) (let ((d (unitize (apply p->q (%edge-ends e))))) (p+v p (v*r d (dot d (p->q p ball)))))) edges))
                (wider (lambda (q) (p+v ball (v*r (p->q ball q) (+ 1 %margin))))))
           (subtract (hull (cons ball (map wider (cons p (append feet on-edges))))) (make-sphere ball r))))))

(define (%corner-bodies edges selected all r)
  (let ((at (%corners all (%edges-size all))) (seen (make-hash)))
    (append-map
      (lambda (e)
        (append-map
          (lambda (p)
            (let* ((here (at p)) (known (hash-ref seen here #f)))
              (hash-set! seen here #t)
              (if (and (not known) (>= (length here) 3) (every (%same-kind? e) here) (every (lambda (x) (member x selected)) here)
                       (every (lambda (x) (and (%edge-straight? x) (every %face-plane? (edge-faces x)))) here))
                  (let ((b (%corner-body p here r))) (if b (list b) '()))
                  '())))
          (if (%edge-closed? e) '() (%edge-ends e))))
      edges)))

(define (%edges-size edges)
  (let ((b (bounding-box (map (lambda (e) (car (object-children e))) edges)))) (distance (first b) (second b))))

; ---- the largest size that fits ----

; Returns the points of an edge, with more of them on a circle.
(define (%edge-samples e) (if (%edge-closed? e) (append (%edge-points e) (list (car (%edge-points e)))) (%edge-points e)))

; Returns the largest k for which the setbacks k*b of the edge e on face f and k*c of the other edge fit, or #f.
(define (%room-beside e f b other c)
  (let ((samples (%edge-samples other)))
    (cond
      ((and (%edge-straight? e) (%face-plane? f)) (%room-of-line e f b other c samples))
      ((and (%edge-circular? e) (%face-plane? f))
       (let* ((round (find %face-round? (edge-faces e))) (center (%circle-about round (%edge-points e))) (r (abs (%face-radius round)))
              (inward (< (dot (%into e f (first (%edge-points e))) (p->q center (first (%edge-points e)))) 0)))
         (cond
           ((equal? other e) (and inward (/ r b)))
           ((%share-end? e other) #f)
           (else
             (let ((room (apply min (map (lambda (q) (let ((d (- (distance center q) r))) (if (eq? inward (< d 0)) (abs d) +inf.0))) samples))))
               (and (< room +inf.0) (/ room (+ b c))))))))
      ((%face-round? f)
       (let* ((t (%into e f (first (%edge-points e)))) (room (apply min (map (lambda (q) (let ((h (dot t (p->q (first (%edge-points e)) q)))) (if (> h 1e-9) h +inf.0))) samples))))
         (and (%edge-circular? e) (not (equal? e other)) (< room +inf.0) (/ room (+ b c)))))
      (else #f))))

(define (%share-end? e x)
  (and (not (%edge-closed? e)) (not (%edge-closed? x))
       (let ((slack (* 1e-6 (apply distance (%edge-ends e)))))
         (any (lambda (p) (any (lambda (q) (<= (distance p q) slack)) (%edge-ends x))) (%edge-ends e)))))

; Returns the direction from the edge into the face at p.
(define (%into e f p) (let ((s (%section e p))) (if (equal? f (first (edge-faces e))) (second s) (third s))))

(define (%room-of-line e f b other c samples)
  (let* ((ends (%edge-ends e)) (p (first ends)) (q (second ends)) (long (distance p q)) (along (unitize (p->q p q))) (t (%into e f p))
         (at-end? (lambda (r) (any (lambda (x) (< (distance x r) (* 1e-6 long))) samples))))
    (cond
      ((equal? e other) #f)
      ((or (at-end? p) (at-end? q)) #f) ; %room-at-ends
      (else
        (let ((room (%least-height (map (lambda (r) (cons (dot along (p->q p r)) (dot t (p->q p r)))) samples) long)))
          (and (< room +inf.0) (/ room (+ b c))))))))

; Returns the least positive height of a polyline of points (x . y) above 0 <= x <= long, or infinity.
(define (%least-height l long)
  (let ((slack (* 1e-6 long)))
    (define (piece a b)
      (let* ((x0 (car a)) (y0 (cdr a)) (x1 (car b)) (y1 (cdr b)) (dx (- x1 x0))
             (height (lambda (x) (if (< (abs dx) slack) (min y0 y1) (+ y0 (* (- y1 y0) (/ (- x x0) dx))))))
             (low (max slack (min x0 x1))) (high (min (- long slack) (max x0 x1))))
        (if (> low high) +inf.0 (let ((h (min (height low) (height high)))) (if (> h slack) h +inf.0)))))
    (apply min +inf.0 (map piece (drop-right l 1) (cdr l)))))

; Returns the largest k for which both ends' corners within the face leave something of the straight edge e, or #f.
(define (%room-at-ends e f b neighbours)
  (let* ((ends (%edge-ends e)) (long (apply distance ends)))
    (define (taken p q) ; what the corner at p takes off the edge, for k = 1
      (let ((n (find (lambda (x) (and (not (equal? (car x) e)) (%edge-straight? (car x))
                                      (any (lambda (r) (< (distance r p) (* 1e-6 long))) (%edge-ends (car x))))) neighbours)))
        (if n
            (let* ((far (apply max (map (lambda (r) (distance p r)) (%edge-ends (car n)))))
                   (away (find (lambda (r) (> (distance p r) (* 0.5 far))) (%edge-ends (car n))))
                   (phi (angle-between (p->q p q) (p->q p away))) (t (%into e f p)))
              (if (> (dot t (p->q p away)) (* 1e-9 far))
                  (max 0 (/ (+ (cdr n) (* b (cos phi))) (sin phi)))
                  0))
            0)))
    (let ((sum (+ (taken (first ends) (second ends)) (taken (second ends) (first ends))))) (and (> sum 0) (/ long sum)))))

; Returns (k . edge): the largest factor of the size that fits at every selected edge, and the edge that limits it.
(define (%largest kind all selected)
  (let ((unit (lambda (e) (if (member e selected) (%setback kind 1 (%section e (first (%edge-points e)))) 0))) (best +inf.0) (where #f))
    (define (limit! k e) (if (and k (< k best)) (begin (set! best k) (set! where e))))
    (for-each
      (lambda (e)
        (for-each
          (lambda (f)
            (let ((around (map (lambda (x) (cons x (unit x))) (filter (lambda (x) (member f (edge-faces x))) all))) (b (unit e)))
              (for-each (lambda (x) (limit! (%room-beside e f b (car x) (cdr x)) e)) around)
              (if (and (%edge-straight? e) (%face-plane? f)) (limit! (%room-at-ends e f b around) e))))
          (edge-faces e)))
      selected)
    (cons best where)))

; ---- the procedures ----

(define (%edge-middle e) (let ((p (%edge-points e))) (if (%edge-straight? e) (mid (first p) (last p)) (list-ref p (quotient (length p) 2)))))

(define (%check-edge who e)
  (let ((faces (edge-faces e)))
    (define (flat-circle?) (and (%edge-circular? e) (any (lambda (f) (and (%face-plane? f) (%parallel? (%face-direction f) (%face-direction (find %face-round? faces))))) faces)))
    (if (or (< (edge-angle e) 1e-3) (> (edge-angle e) (- (* 2 pi) 1e-3)))
        (error who "at the edge at ~s two parts of o only touch" (%edge-middle e)))
    (if (not (or (and (%edge-straight? e) (every %face-plane? faces)) (flat-circle?)))
        (error who "the edge at ~s lies between curved faces; edges between planes, and circles around cylinders, can be worked" (%edge-middle e)))))

; Returns the selected edges of one kind, with all edges: (all . selected).
(define (%chosen who o select convex)
  (let* ((all (cdr (%faces-and-edges o))) (chosen (filter (lambda (e) (and (eq? (%edge-convex? e) convex) (select e))) all)))
    (for-each (lambda (e) (%check-edge who e)) chosen)
    (cons all chosen)))

(define (%work who kind o size all selected)
  (let* ((most (%largest kind all selected)) (at (%corners all (%edges-size all))))
    (if (> size (* (car most) (+ 1 1e-6)))
        (error who "~a ~a is too large at ~s: the largest that fits there is ~a" (if (eq? kind 'fillet) "r" "d") size (%edge-middle (cdr most)) (%number-text (car most))))
    (append (map (lambda (e) (%edge-body e kind size selected at)) selected)
            (if (eq? kind 'fillet) (%corner-bodies selected selected all size) '()))))

; Concave edges are filled first; then the convex edges of the result are found anew.
(define (%worked who kind o size name edges)
  (let* ((o (%solid-given who 'o o)) (select (if edges (%selector who 'edges edges) (lambda (e) #t))) (found #f))
    (%need-positive-length who name size)
    (if (not (empty-object? o)) (%need-visible who name size o))
    (define (step o convex)
      (let ((chosen (%chosen who o select convex)))
        (if (null? (cdr chosen))
            o
            (let ((bodies (%work who kind o size (car chosen) (cdr chosen))))
              (set! found #t)
              (if convex (subtract o bodies) (unite o bodies))))))
    (let ((made (step (if edges (step o #f) o) #t)))
      (if (not found) (error who "edges selects no edge of o"))
      made)))

(define (do-fillet o r #:edges [edges any? #f]) (%worked 'do-fillet 'fillet o r 'r edges))
(define (do-chamfer o d #:edges [edges any? #f]) (%worked 'do-chamfer 'chamfer o d 'd edges))
