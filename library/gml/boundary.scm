; The boundary of a shape: linked faces, edges and vertices. Each edge is two half edges, mates, one along either face.
; Euler's operators change them and keep every shell closed. After control.scm.
;
; The half edge e runs from its vertex to that of its next one, counterclockwise around its face, seen from outside. A
; face within another one, its base, is a ring of it: a hole.

; The fields of an edge are not printed: they link to its whole shape.
(define-record-type |%edge of GML| (make-edge %vertex %next %previous %mate %face %sharp) edge?
  (%vertex edge-vertex set-edge-vertex!)
  (%next edge-next set-edge-next!)
  (%previous edge-previous set-edge-previous!)
  (%mate edge-mate set-edge-mate!)
  (%face edge-face set-edge-face!)   ; #f: the edge was removed
  (%sharp edge-sharp set-edge-sharp!))
(define-record-type <vertex> (make-vertex place corner) vertex? (place vertex-place set-vertex-place!)
  (corner vertex-corner))
(define-record-type <face> (make-face edge base rings material) face?
  (edge face-edge set-face-edge!)
  (base face-base set-face-base!)   ; the face itself unless it is a ring
  (rings face-rings set-face-rings!)
  (material face-material set-face-material!))

; The model of a context: its faces in the order of making, and the properties for new parts.
(define-record-type <model> (make-model faces material materials sharpness macros macro) model?
  (faces model-faces)
  (material model-material set-model-material!)
  (materials model-materials set-model-materials!) ; those that were pushed
  (sharpness model-sharpness set-model-sharpness!) ; a stack
  (macros model-macros)                            ; a table from a number to the faces made since its newmacro
  (macro model-macro set-model-macro!))            ; the number, or #f

(define models (make-hasheq)) ; by node
(define (model)
  (let ((node (node-current)))
    (or (hash-ref models node #f)
        (let ((m (make-model (make-hasheq) #f '() '(#t) (make-hasheq) #f))) (hash-set! models node m) m))))

(define (new-face edge)
  (let* ((m (model)) (f (make-face edge #f '() (model-material m))))
    (set-face-base! f f)
    (if edge (set-edge-face! edge f))
    (hash-set! (model-faces m) f #t)
    (if (model-macro m)
        (hash-set! (model-macros m) (model-macro m) (cons f (hash-ref (model-macros m) (model-macro m) '()))))
    f))
(define (drop-face f) (hash-remove! (model-faces (model)) f))

(define (new-edge vertex face) (make-edge vertex #f #f #f face (car (model-sharpness (model)))))
(define (link! a b) (set-edge-next! a b) (set-edge-previous! b a))
(define (mates! a b) (set-edge-mate! a b) (set-edge-mate! b a))
(define (sharpen! e sharp) (set-edge-sharp! e sharp) (set-edge-sharp! (edge-mate e) sharp))
(define (edge-place e) (vertex-place (edge-vertex e)))

(define (need-edge who e)
  (if (not (edge? e)) (refuse who "an operand must be an edge" e))
  (if (not (edge-face e)) (error who "the edge was taken away")))

; Returns the half edges around a face, and those that leave a vertex, from e on.
(define (face-edges e)
  (let loop ((x (edge-previous e)) (l '())) (if (eq? x e) (cons e l) (loop (edge-previous x) (cons x l)))))
(define (vertex-cw e) (edge-next (edge-mate e)))
(define (vertex-ccw e) (edge-mate (edge-previous e)))
(define (vertex-edges e)
  (let loop ((x (vertex-ccw e)) (l '())) (if (eq? x e) (cons e l) (loop (vertex-ccw x) (cons x l)))))

; Returns the sum of Newell's cross products: twice the area, along the normal.
(define (normal-sum places)
  (let loop ((l places) (x 0.0) (y 0.0) (z 0.0))
    (if (null? l)
        (xyz x y z)
        (let ((p (car l)) (q (if (pair? (cdr l)) (cadr l) (car places))))
          (loop (cdr l)
                (+ x (* (- (cy p) (cy q)) (+ (cz p) (cz q))))
                (+ y (* (- (cz p) (cz q)) (+ (cx p) (cx q))))
                (+ z (* (- (cx p) (cx q)) (+ (cy p) (cy q)))))))))
(define (normal-of who places)
  (let* ((n (normal-sum places)) (l (v-length n)))
    (if (= l 0) (error who "the corners of the face lie on a line, and it has no normal"))
    (v* n (/ 1.0 l))))
(define (face-places e) (map edge-place (face-edges e)))
(define (middle places) (v* (fold-left* v+ places) (/ 1.0 (length places))))
(define (fold-left* f l) (let loop ((v (car l)) (l (cdr l))) (if (null? l) v (loop (f v (car l)) (cdr l)))))

; ---- Euler's operators ----

(define (same-face who a b) (if (not (eq? (edge-face a) (edge-face b))) (error who "the edges must be of one face")))
(define (other-faces who a b) (if (eq? (edge-face a) (edge-face b)) (error who "the edges must be of two faces")))

(define (make-vefs p q)
  (let* ((f (new-face #f)) (a (new-edge (make-vertex p #f) f)) (b (new-edge (make-vertex q #f) f)))
    (set-face-edge! f a)
    (link! a b)
    (link! b a)
    (mates! a b)
    b))

; Splits the vertex of the edges: those from a on, clockwise, until b, move to the new vertex at p. With a = b, a new
; edge ends in the new vertex.
(define (make-ev a b p)
  (let* ((v (edge-vertex b)) (new (make-vertex p #f)) (f (edge-face b)))
    (if (not (eq? (edge-vertex a) v)) (error 'makeEV "the edges must leave one vertex"))
    (let ((out (new-edge new f)) (back (new-edge v (edge-face a))) (before-a (edge-previous a))
          (before-b (edge-previous b)))
      (if (eq? a b)
          (begin (link! before-a back) (link! back out) (link! out a))
          (begin
            (let loop ((x a)) (if (not (eq? x b)) (begin (set-edge-vertex! x new) (loop (vertex-cw x)))))
            (link! before-b out)
            (link! out b)
            (link! before-a back)
            (link! back a)))
      (mates! out back)
      out)))

; Divides the face by an edge from b's vertex to a's: the edges from a until b get a new face.
(define (make-ef a b)
  (same-face 'makeEF a b)
  (let* ((f (new-face #f)) (one (new-edge (edge-vertex b) f)) (two (new-edge (edge-vertex a) (edge-face a)))
         (before-a (edge-previous a)) (before-b (edge-previous b)))
    (set-face-edge! f one)
    (set-face-edge! (edge-face a) two)
    (if (eq? a b)
        (link! one one)
        (begin
          (let loop ((x a)) (if (not (eq? x b)) (begin (set-edge-face! x f) (loop (edge-next x)))))
          (link! before-b one)
          (link! one a)))
    (link! before-a two)
    (link! two b)
    (mates! one two)
    one))

(define (gone! e) (set-edge-face! e #f))

(define (kill-ef e)
  (let ((m (edge-mate e)))
    (other-faces 'killEF e m)
    (let ((from (edge-face e)) (to (edge-face m)))
      (for-each (lambda (x) (set-edge-face! x to)) (face-edges e))
      (drop-face from)
      (let ((ep (edge-previous e)) (en (edge-next e)) (mp (edge-previous m)) (mn (edge-next m)))
        (if (not (eq? ep e)) (begin (link! ep mn) (link! mp en)) (link! mp mn))
        (set-face-edge! to mn))
      (gone! e)
      (gone! m))))

(define (kill-ev e)
  (let* ((m (edge-mate e)) (to (edge-vertex m)))
    (if (eq? (edge-vertex e) to) (error 'killEV "the edge must join two vertices"))
    (for-each (lambda (x) (set-edge-vertex! x to)) (vertex-edges e))
    (let ((ep (edge-previous e)) (en (edge-next e)) (mp (edge-previous m)) (mn (edge-next m)))
      (cond ((and (eq? en m) (eq? mn e)) (error 'killEV "this is the last edge of its shell"))
            ((eq? en m) (link! ep mn) (set-face-edge! (edge-face e) mn))
            ((eq? mn e) (link! mp en) (set-face-edge! (edge-face e) en))
            (else (link! ep en) (link! mp mn) (set-face-edge! (edge-face e) en) (set-face-edge! (edge-face m) mn))))
    (gone! e)
    (gone! m)))

(define (drop-ring base ring) (set-face-rings! base (filter (lambda (r) (not (eq? r ring))) (face-rings base))))

; Joins the ring to its base's border by an edge between the two; returns the half edge that begins at the ring.
(define (make-e-kill-r ring-edge base-edge)
  (let ((ring (edge-face ring-edge)) (base (edge-face base-edge)))
    (if (or (eq? ring base) (not (eq? (face-base ring) base)))
        (error 'makeEkillR "the first edge must be of a ring of the second one's face"))
    (let ((one (new-edge (edge-vertex ring-edge) base)) (two (new-edge (edge-vertex base-edge) base))
          (before-ring (edge-previous ring-edge)) (before-base (edge-previous base-edge)))
      (for-each (lambda (x) (set-edge-face! x base)) (face-edges ring-edge))
      (drop-ring base ring)
      (drop-face ring)
      (link! before-ring one)
      (link! one base-edge)
      (link! before-base two)
      (link! two ring-edge)
      (mates! one two)
      one)))

(define (make-f-kill-rh ring-edge)
  (let ((ring (edge-face ring-edge)))
    (if (eq? (face-base ring) ring) (error 'makeFkillRH "the edge must be of a ring"))
    (drop-ring (face-base ring) ring)
    (set-face-base! ring ring)))

(define (kill-f-make-rh ring-edge base-edge)
  (let ((ring (edge-face ring-edge)) (base (edge-face base-edge)))
    (other-faces 'killFmakeRH ring-edge base-edge)
    (if (not (and (eq? (face-base ring) ring) (eq? (face-base base) base)))
        (error 'killFmakeRH "neither face may be a ring"))
    (for-each (lambda (r) (set-face-base! r base)) (face-rings ring))
    (set-face-rings! base (append (face-rings ring) (list ring) (face-rings base)))
    (set-face-rings! ring '())
    (set-face-base! ring base)))

(define (kill-e-make-r e)
  (let* ((m (edge-mate e)) (base (edge-face e)))
    (same-face 'killEmakeR e m)
    (if (or (eq? (edge-next e) m) (eq? (edge-next m) e)) (error 'killEmakeR "the edge ends in a vertex of its own"))
    (let ((ep (edge-previous e)) (en (edge-next e)) (mp (edge-previous m)) (mn (edge-next m)))
      (link! mp en)
      (link! ep mn)
      (let ((ring (new-face mn)))
        (for-each (lambda (x) (set-edge-face! x ring)) (face-edges mn))
        (set-face-base! ring (face-base base))
        (set-face-rings! (face-base base) (cons ring (face-rings (face-base base))))
        (set-face-edge! base en)
        (gone! e)
        (gone! m)
        mn))))

(operator (makeVEFS p q) (need-vector 'makeVEFS p) (need-vector 'makeVEFS q) (make-vefs p q))
(operator (makeEV a b p) (need-edge 'makeEV a) (need-edge 'makeEV b) (need-vector 'makeEV p) (make-ev a b p))
(operator (makeEVone a p) (need-edge 'makeEVone a) (need-vector 'makeEVone p) (make-ev a a p))
(operator (makeEF a b) (need-edge 'makeEF a) (need-edge 'makeEF b) (make-ef a b))
(operator (makeEkillR r f) (need-edge 'makeEkillR r) (need-edge 'makeEkillR f) (make-e-kill-r r f))
(operator! (makeFkillRH r) (need-edge 'makeFkillRH r) (make-f-kill-rh r))
(operator! (killFmakeRH r f) (need-edge 'killFmakeRH r) (need-edge 'killFmakeRH f) (kill-f-make-rh r f))
(operator (killEmakeR e) (need-edge 'killEmakeR e) (kill-e-make-r e))
(operator! (killEF e) (need-edge 'killEF e) (kill-ef e))
(operator! (killEV e) (need-edge 'killEV e) (kill-ev e))
(operator! (killVEFS e)
  (need-edge 'killVEFS e)
  (if (not (eq? (edge-next (edge-next e)) e)) (error 'killVEFS "the shell must be of one edge"))
  (drop-face (edge-face e))
  (gone! (edge-mate e))
  (gone! e))

; ---- navigation, questions, moves ----

; edge faceCCW, or edge number faceCCW with a number of steps.
(define-syntax edge-steps
  (syntax-rules ()
    ((_ (name f) ...)
     (begin (operator (name e) (if (number? e) (steps 'name f e) (begin (need-edge 'name e) (f e)))) ...))))
(define (steps who f n)
  (need-count who n)
  (let ((e (gml:pop who)))
    (need-edge who e)
    (let turn ((e e) (n n)) (if (= n 0) e (turn (f e) (- n 1))))))
(edge-steps (faceCCW edge-next) (faceCW edge-previous) (vertexCW vertex-cw) (vertexCCW vertex-ccw))

(define-syntax edge-operators
  (syntax-rules () ((_ (name f) ...) (begin (operator (name e) (need-edge 'name e) (f e)) ...))))
(edge-operators
  (edgemate edge-mate) (edgeflip edge-mate)
  (vertexpos edge-place) (edgedirection (lambda (e) (v- (edge-place (edge-next e)) (edge-place e))))
  (valence (lambda (e) (length (vertex-edges e)))) (facedegree (lambda (e) (length (face-edges e))))
  (facenormal (lambda (e) (normal-of 'facenormal (face-places e))))
  (facemidpoint (lambda (e) (middle (face-places e))))
  (faceplanedist (lambda (e) (- (v-dot (normal-of 'faceplanedist (face-places e)) (edge-place e)))))
  (isBaseface (lambda (e) (flag (eq? (edge-face e) (face-base (edge-face e))))))
  (baseface (lambda (e) (face-edge (face-base (edge-face e)))))
  (issharp (lambda (e) (flag (edge-sharp e))))
  (getfacematerial (lambda (e) (or (face-material (edge-face e)) 'none))))
(operator (isValidEdge e) (flag (and (edge? e) (edge-face e))))
(operator! (faceplane e)
  (need-edge 'faceplane e)
  (let ((n (normal-of 'faceplane (face-places e)))) (gml:push n) (gml:push (- (v-dot n (edge-place e))))))
(operator (nextring e)
  (need-edge 'nextring e)
  (let* ((f (edge-face e)) (base (face-base f))
         (rest (if (eq? f base) (face-rings base) (cdr (memq f (face-rings base))))))
    (face-edge (if (pair? rest) (car rest) base))))
(operator (sameEdge a b) (need-edge 'sameEdge a) (need-edge 'sameEdge b) (flag (or (eq? a b) (eq? a (edge-mate b)))))
(operator (sameFace a b) (need-edge 'sameFace a) (need-edge 'sameFace b) (flag (eq? (edge-face a) (edge-face b))))
(operator (sameVertex a b) (need-edge 'sameVertex a) (need-edge 'sameVertex b)
  (flag (eq? (edge-vertex a) (edge-vertex b))))
(operator! (connectedvertices a b)
  (need-edge 'connectedvertices a)
  (need-edge 'connectedvertices b)
  (let ((e (find (lambda (x) (eq? (edge-vertex (edge-mate x)) (edge-vertex b))) (vertex-edges a))))
    (if e (gml:push e))
    (gml:push (flag e))))

(define (move-vertex v by) (set-vertex-place! v (v+ (vertex-place v) by)))
(operator! (moveV e p) (need-edge 'moveV e) (need-vector 'moveV p) (set-vertex-place! (edge-vertex e) p))
(operator! (moveE e by) (need-edge 'moveE e) (need-vector 'moveE by) (move-vertex (edge-vertex e) by)
  (move-vertex (edge-vertex (edge-mate e)) by))
(operator! (moveF e by) (need-edge 'moveF e) (need-vector 'moveF by)
  (for-each (lambda (x) (move-vertex (edge-vertex x) by)) (face-edges e)))
(operator! (sharpE e sharp) (need-edge 'sharpE e) (sharpen! e (true? sharp)))
(operator! (sharpF e sharp) (need-edge 'sharpF e) (for-each (lambda (x) (sharpen! x (true? sharp))) (face-edges e)))
(operator! (sharpV e sharp) (need-edge 'sharpV e) (for-each (lambda (x) (sharpen! x (true? sharp))) (vertex-edges e)))

(operator! (setsharpness s) (set-model-sharpness! (model) (cons (true? s) (cdr (model-sharpness (model))))))
(operator (getsharpness) (flag (car (model-sharpness (model)))))
(operator! (pushsharpness s) (set-model-sharpness! (model) (cons (true? s) (model-sharpness (model)))))
(operator (popsharpness)
  (let ((s (model-sharpness (model))))
    (if (pair? (cdr s)) (set-model-sharpness! (model) (cdr s)))
    (flag (car s))))
