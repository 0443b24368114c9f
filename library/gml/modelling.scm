; Polygons, double faces, extrusions, bridges, materials, macros, and the final drawing. After boundary.scm.

(define (need-polygon who a)
  (let ((l (need-elements who a)))
    (for-each (lambda (p) (need-vector who p)) l)
    l))

; ---- the eight modes: the sharpness of the edges of a ring, and of those from ring to ring ----

(define modes
  '#((#f . smooth) (#t . smooth) (#f . sharp) (#t . sharp) (#f . like-vertex) (#t . like-vertex) (#f . continue)
     (#t . continue)))
(define (mode-of who m)
  (let ((n (if (and (number? m) (integer? m)) (exact m) m)))
    (if (not (and (exact-integer? n) (<= 0 n 7)))
        (refuse who
          (string-append "a mode is a number from 0 to 7 (smooth-smooth, sharp-smooth, smooth-sharp, sharp-sharp, "
                         "smooth-like-vertex, sharp-like-vertex, smooth-continue, sharp-continue)")
          m))
    (vector-ref modes n)))

; ---- polygons ----

; Returns two directions perpendicular to the normal; the smallest turn from +Z to the normal turns +X to the first.
(define (across who normal)
  (let* ((n (v-unit who normal)) (x (cx n)) (y (cy n)) (z (cz n)))
    (if (< z -0.999999999)
        (cons (xyz 1 0 0) (xyz 0 -1 0))
        (let ((k (/ 1.0 (+ 1.0 z))))
          (cons (xyz (- 1.0 (* x x k)) (- (* x y k)) (- x)) (xyz (- (* x y k)) (- 1.0 (* y y k)) (- y)))))))

(operator (circle centre normal radius n)
  (need-vector 'circle centre)
  (need-vector 'circle normal)
  (need-number 'circle radius)
  (need-count 'circle n)
  (if (< n 3) (error 'circle "a circle has at least 3 corners, got ~a" n))
  (let ((uv (across 'circle normal)))
    (let loop ((i (- n 1)) (l '()))
      (if (< i 0)
          (list->array l)
          (let ((a (* i (/ 2pi n))))
            (loop (- i 1)
              (cons (v+ centre (v+ (v* (car uv) (* radius (cos a))) (v* (cdr uv) (* radius (sin a))))) l)))))))

; The rectangle between two corners in a plane across an axis. Modes 0 and 1 are X, 2 and 3 Y, 4 and 5 Z; odd ones face
; along the axis.
(operator (quad p q mode)
  (need-vector 'quad p)
  (need-vector 'quad q)
  (if (not (and (exact-integer? mode) (<= 0 mode 5)))
      (refuse 'quad "a mode is a number from 0 to 5 (-X, +X, -Y, +Y, -Z, +Z)" mode))
  (let* ((axis (quotient mode 2)) (at (lambda (x y z) (xyz x y z)))
         (x0 (min (cx p) (cx q))) (x1 (max (cx p) (cx q))) (y0 (min (cy p) (cy q))) (y1 (max (cy p) (cy q)))
         (z0 (min (cz p) (cz q))) (z1 (max (cz p) (cz q)))
         (corners
           (case axis
             ((0) (list (at (cx p) y0 z0) (at (cx p) y1 z0) (at (cx p) y1 z1) (at (cx p) y0 z1)))
             ((1) (list (at x0 (cy p) z0) (at x0 (cy p) z1) (at x1 (cy p) z1) (at x1 (cy p) z0)))
             (else (list (at x0 y0 (cz p)) (at x1 y0 (cz p)) (at x1 y1 (cz p)) (at x0 y1 (cz p)))))))
    (list->array (if (odd? mode) corners (reverse corners)))))

(operator (project_polyplane polygon direction normal distance)
  (need-vector 'project_polyplane direction)
  (need-vector 'project_polyplane normal)
  (need-number 'project_polyplane distance)
  (list->array (map (lambda (p) (onto-plane 'project_polyplane p direction normal distance))
                 (need-polygon 'project_polyplane polygon))))

; Merges equal neighbours to one corner, which like-vertex keeps sharp; returns a list of (point . corner?).
(define (corners-of places)
  (let loop ((l places) (out '()))
    (if (null? l)
        (let ((out (reverse out)))
          (if (and (pair? out) (pair? (cdr out)) (equal? (caar out) (car (last out))))
              (cons (cons (caar out) #t) (drop-right (cdr out) 1))
              out))
        (if (and (pair? out) (equal? (car l) (caar out)))
            (loop (cdr l) (cons (cons (car l) #t) (cdr out)))
            (loop (cdr l) (cons (cons (car l) #f) out))))))

; Makes a face and its back, which share their edges. Returns the edge of the face from the first point to the second.
(operator (poly2doubleface polygon mode)
  (let* ((mode (mode-of 'poly2doubleface mode)) (corners (corners-of (need-polygon 'poly2doubleface polygon)))
         (n (length corners)))
    (if (< n 3) (error 'poly2doubleface "a face has at least 3 corners, got ~a" n))
    (let* ((front (new-face #f)) (back (new-face #f))
           (vertices (map (lambda (c) (make-vertex (car c) (case (cdr mode) ((sharp) #t) ((smooth) #f) (else (cdr c)))))
                       corners))
           (out (map (lambda (v) (make-edge v #f #f #f front (car mode))) vertices))
           (in (map (lambda (v) (make-edge v #f #f #f back (car mode))) (append (cdr vertices) (list (car vertices))))))
      (for-each link! out (append (cdr out) (list (car out))))
      (for-each link! (append (cdr in) (list (car in))) in)
      (for-each mates! out in)
      (set-face-edge! front (car out))
      (set-face-edge! back (car in))
      (car out))))

; ---- extrusion ----

; Returns the offsets of the corners, perpendicular to the normal, that move each side inwards by 1.
(define (inward places normal)
  (let* ((n (length places)) (v (list->vector places)))
    (map
      (lambda (i)
        (let* ((p (vector-ref v i)) (a (v-cross normal (direction (vector-ref v (modulo (- i 1) n)) p)))
               (b (v-cross normal (direction p (vector-ref v (modulo (+ i 1) n))))) (k (+ 1.0 (v-dot a b))))
          (if (< k 1e-9) (xyz 0 0 0) (v* (v+ a b) (/ 1.0 k)))))
      (iota n))))
(define (direction p q) (let* ((d (v- q p)) (l (v-length d))) (if (= l 0) (xyz 0 0 0) (v* d (/ 1.0 l)))))

; Adds a ring: the face of e moves to the places, and each of its edges gets a side. Returns the edge above e.
(define (extrude-to e places mode)
  (let* ((ring (face-edges e)) (f (edge-face e)) (sharp (car mode))
         (risers ; whether the edge up from each vertex is sharp
           (map (lambda (x)
                  (case (cdr mode)
                    ((sharp) #t)
                    ((smooth) #f)
                    ((like-vertex) (vertex-corner (edge-vertex x)))
                    (else (let ((l (vertex-edges x))) ; the edge of the vertex that is not of the ring
                            (if (= (length l) 3)
                                (edge-sharp
                                  (find (lambda (y) (not (or (eq? y x) (eq? y (edge-mate (edge-previous x)))))) l))
                                (vertex-corner (edge-vertex x)))))))
                ring))
         (above (map (lambda (p x) (make-vertex p (vertex-corner (edge-vertex x)))) places ring))
         (top (map (lambda (v) (make-edge v #f #f #f f sharp)) above))
         (sides (map (lambda (x) (new-face x)) ring))
         (next (lambda (l) (append (cdr l) (list (car l)))))
         (up (map (lambda (x side riser) (make-edge (edge-vertex (edge-next x)) #f #f #f side riser)) ring sides
               (next risers)))
         (back (map (lambda (v side) (make-edge v #f #f #f side sharp)) (next above) sides))
         (down (map (lambda (v side riser) (make-edge v #f #f #f side riser)) above sides risers)))
    (for-each link! top (next top))
    (for-each (lambda (x u b d) (link! x u) (link! u b) (link! b d) (link! d x)) ring up back down)
    (for-each mates! top back)
    (for-each mates! up (next down))
    (set-face-edge! f (car top))
    (car top)))

(define (extrusion who v)
  (need-vector who v)
  (cons (mode-of who (cz v)) (cons (cx v) (cy v))))

(operator! (extrude e v)
  (need-edge 'extrude e)
  (let* ((steps (map (lambda (s) (extrusion 'extrude s)) (if (array? v) (array->list v) (list v))))
         (places (face-places e)) (normal (normal-of 'extrude places)) (in (inward places normal)))
    (let loop ((e e) (steps steps) (first #f))
      (if (null? steps)
          (begin (if (array? v) (gml:push (or first e))) (gml:push e))
          (let* ((inset (cadar steps)) (height (cddar steps))
                 (to (extrude-to e (map (lambda (p i) (v+ p (v+ (v* i inset) (v* normal height)))) places in)
                       (caar steps))))
            (loop to (cdr steps) (or first to)))))))

(operator (extrude-simple e distance sharp)
  (need-edge 'extrude-simple e)
  (need-number 'extrude-simple distance)
  (let* ((places (face-places e)) (by (v* (normal-of 'extrude-simple places) distance)))
    (extrude-to e (map (lambda (p) (v+ p by)) places) (if (true? sharp) '(#t . sharp) '(#f . smooth)))))

; ---- bridges: a ring of sides between the borders replaces two faces with equally many corners ----

(define (bridge who a b sharp)
  (other-faces who a b)
  (let* ((ring (face-edges a)) (n (length ring)) (f (edge-face a)) (g (edge-face b)))
    (if (not (= n (length (face-edges b)))) (error who "the faces have ~a and ~a corners" n (length (face-edges b))))
    (if (pair? (append (face-rings f) (face-rings g))) (error who "a face with rings is not bridged"))
    (let* ((opposite
             (let loop ((i 0) (x b) (l '())) (if (= i n) (reverse l) (loop (+ i 1) (edge-previous x) (cons x l)))))
           ; a runs from v to w; the opposite edge runs from the vertex beyond w's to the one beyond v's
           (across (map (lambda (x) (edge-previous x)) opposite))
           (sides (map (lambda (x) (new-face x)) ring))
           (next (lambda (l) (append (cdr l) (list (car l)))))
           (over (map (lambda (x y side) (make-edge (edge-vertex (edge-next x)) #f #f #f side sharp)) ring across
                   sides))
           (home (map (lambda (y side) (make-edge (edge-vertex (edge-next y)) #f #f #f side sharp)) across sides)))
      (for-each (lambda (x o y h side) (link! x o) (link! o y) (link! y h) (link! h x) (set-edge-face! y side)) ring
        over across home sides)
      (for-each mates! over (next home))
      (drop-face f)
      (drop-face g)
      (car home))))
(operator (bridgerings-simple a b sharp) (need-edge 'bridgerings-simple a) (need-edge 'bridgerings-simple b)
  (bridge 'bridgerings-simple a b (true? sharp)))
(operator (bridgerings a b mode)
  (need-edge 'bridgerings a)
  (need-edge 'bridgerings b)
  (bridge 'bridgerings a b (not (eq? (cdr (mode-of 'bridgerings mode)) 'smooth))))

; ---- materials ----

(define (material-of who v)
  (if (or (symbol? v) (string? v) (point? v)) v (refuse who "a material is a name, or a colour (red,green,blue)" v)))
(operator! (setcurrentmaterial m) (set-model-material! (model) (material-of 'setcurrentmaterial m)))
(operator (getcurrentmaterial) (or (model-material (model)) 'none))
(operator! (pushcurrentmaterial m)
  (set-model-materials! (model) (cons (model-material (model)) (model-materials (model))))
  (set-model-material! (model) (material-of 'pushcurrentmaterial m)))
(operator (popcurrentmaterial)
  (let ((was (or (model-material (model)) 'none)) (kept (model-materials (model))))
    (if (pair? kept) (begin (set-model-material! (model) (car kept)) (set-model-materials! (model) (cdr kept))))
    was))
(define (set-material! e m) (set-face-material! (edge-face e) m))
(operator! (setfacematerial e m) (need-edge 'setfacematerial e) (set-material! e (material-of 'setfacematerial m)))
(operator! (materialF e m) (need-edge 'materialF e) (set-material! e (material-of 'materialF m)))

(define (text-of who v)
  (cond ((string? v) v) ((symbol? v) (symbol->string v)) (else (refuse who "a name or a string is needed" v))))

; A name means the material in the property of that name of the current node or a node above it, otherwise the
; language's material or colour. Any other name means the plain material: the host or the project of the model knows it.
(define materials (make-hash))
(define (resource m)
  (let ((p (and (symbol? m) (property-find (node-current) m))))
    (and p (material? (property-value p)) (property-value p))))
(define (painted m o)
  (let ((known (cond ((resource m) => (lambda (r) (lambda (o) (with-material r o))))
                     (else (hash-ref materials m 'new)))))
    (if (eq? known 'new)
        (begin
          (set! known
            (cond
              ((point? m) (lambda (o) (color (list (cx m) (cy m) (cz m)) o)))
              ((guard (e (#t #f)) (with-material (text-of 'material m) o))
               (lambda (o) (with-material (text-of 'material m) o)))
              ((guard (e (#t #f)) (color (text-of 'material m) o)) (lambda (o) (color (text-of 'material m) o)))
              (else (lambda (o) o))))
          (hash-set! materials m known)))
    (known o)))

; ---- macros: the faces made since newmacro can be removed together ----

(define macros-made 0)
(define (drop-macro m number)
  (for-each (lambda (f) (hash-remove! (model-faces m) f)) (hash-ref (model-macros m) number '()))
  (hash-remove! (model-macros m) number))
(operator! (newmacro) (set! macros-made (+ macros-made 1)) (set-model-macro! (model) macros-made))
(operator (currentmacro) (or (model-macro (model)) 0))
(operator! (deletemacro number)
  (let ((m (model)))
    (drop-macro m number)
    (if (eqv? number (model-macro m)) (set-model-macro! m #f))))
(operator! (deleteallmacros)
  (let ((m (model)))
    (for-each (lambda (f) (hash-remove! (model-faces m) f)) (hash-keys (model-faces m)))
    (for-each (lambda (k) (hash-remove! (model-macros m) k)) (hash-keys (model-macros m)))
    (set-model-macro! m #f)))

; ---- the shells as objects of the drawing ----

; Joins a face's rings to its border: each by a cut, there and back, between their nearest corners. Then triangulates by
; cutting ears.
(define (places->triangles corners normal) ; corners: a list of (number . place); returns lists of three numbers
  (let* ((uv (across 'face normal)) (flat (lambda (c) (cons (v-dot (cdr c) (car uv)) (v-dot (cdr c) (cdr uv)))))
         (turn (lambda (a b c)
                 (- (* (- (car b) (car a)) (- (cdr c) (cdr a))) (* (- (cdr b) (cdr a)) (- (car c) (car a)))))))
    (let cut ((l (map (lambda (c) (cons (car c) (flat c))) corners)) (tried 0) (out '()))
      (let ((n (length l)))
        (cond
          ((< n 3) out)
          ((> tried n) out) ; the rest has no area
          (else
            (let* ((a (car l)) (b (cadr l)) (c (caddr l)) (t (turn (cdr a) (cdr b) (cdr c))))
              (if (and (> t 0)
                       (not (any (lambda (x)
                                   (let ((p (cdr x)))
                                     (and (not (equal? p (cdr a))) (not (equal? p (cdr b))) (not (equal? p (cdr c)))
                                          (>= (turn (cdr a) (cdr b) p) 0) (>= (turn (cdr b) (cdr c) p) 0)
                                            (>= (turn (cdr c) (cdr a) p) 0))))
                                 (cdddr l))))
                  (cut (cons a (cddr l)) 0 (cons (list (car a) (car b) (car c)) out))
                  (cut (append (cdr l) (list a)) (+ tried 1) out)))))))))

(define (nearest-cut border ring) ; both are lists of (number . place); returns the border with the ring in it
  (let* ((best #f) (at-border #f) (at-ring #f))
    (for-each
      (lambda (b)
        (for-each
          (lambda (r)
            (let ((d (v-length (v- (cdr b) (cdr r)))))
              (if (or (not best) (< d best)) (begin (set! best d) (set! at-border b) (set! at-ring r))))) ring))
      border)
    (let* ((from (memq at-ring ring)) (turned (append from (take ring (- (length ring) (length from)))))
           (here (memq at-border border)))
      (append (take border (- (length border) (length here))) (list at-border) turned (list at-ring) here))))

; Returns the faces of a shell, from one of them on, through mates and rings.
(define (shell-of f seen)
  (let loop ((work (list f)) (out '()))
    (if (null? work)
        (reverse out)
        (let ((g (car work)))
          (if (hash-ref seen g #f)
              (loop (cdr work) out)
              (begin
                (hash-set! seen g #t)
                (loop (append (map (lambda (e) (edge-face (edge-mate e))) (face-edges (face-edge g)))
                        (list (face-base g)) (face-rings g) (cdr work))
                      (cons g out))))))))

(define (subdivisions)
  (let ((n (current-segments))) (max 1 (min 6 (exact (ceiling (/ (log (/ (if (number? n) n 32) 4.0)) (log 2.0))))))))

(define (shell-object faces)
  (let* ((numbers (make-hasheq)) (places '())
         (number (lambda (v)
                   (or (hash-ref numbers v #f)
                       (let ((n (+ 1 (hash-count numbers)))) (hash-set! numbers v n)
                         (set! places (cons (vertex-place v) places)) n))))
         (corners
           (lambda (f) (map (lambda (e) (cons (number (edge-vertex e)) (edge-place e))) (face-edges (face-edge f)))))
         (bases (filter (lambda (f) (eq? f (face-base f))) faces))
         (polygons
           (append-map
             (lambda (f)
               (let ((border (corners f)))
                 (if (null? (face-rings f))
                     (list (map car border))
                     (places->triangles (fold-left* nearest-cut (cons border (map corners (face-rings f))))
                       (normal-of 'face (map cdr border))))))
             bases))
         (polygons (filter (lambda (p) (> (length p) 2)) polygons))
         (polygons (if (and (= (length polygons) 2) (= (length (car polygons)) (length (cadr polygons))))
                       (list (car polygons)) polygons)))
    (if (null? polygons)
        #f
        (let* ((o (make-polyface-mesh (reverse places) polygons)) (material (face-material (car faces)))
               (edges (append-map (lambda (f) (face-edges (face-edge f))) faces))
               (creases (filter-map (lambda (e)
                                      (let ((a (number (edge-vertex e))) (b (number (edge-vertex (edge-mate e)))))
                                        (and (edge-sharp e) (< a b) (list a b))))
                                    edges))
               (o (if (every edge-sharp edges) o (make-subdivision o (subdivisions) #:creases creases))))
          (if (and material (not (eq? material 'none))) (painted material o) o)))))

(define (model-objects m)
  (let ((seen (make-hasheq)))
    (let loop ((l (hash-keys (model-faces m))) (out '()))
      (cond ((null? l) (reverse out))
            ((hash-ref seen (car l) #f) (loop (cdr l) out))
            (else (let ((o (shell-object (shell-of (car l) seen)))) (loop (cdr l) (if o (cons o out) out))))))))
