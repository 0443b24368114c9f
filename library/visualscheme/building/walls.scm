; Walls: layers along a path, openings, and joints with other walls.

; slabs: what a wall is in plan, a list of (bottom top layers), the layers from the right, each a list of areas: a loop, or
; an outer loop with its hole. under: a solid that contains all of the wall, or #f.
(define-record-type walling (make-walling points closed offsets materials core base height slabs openings name under) walling?
  (points walling-points) (closed walling-closed) (offsets walling-offsets) (materials walling-materials) (core walling-core)
  (base walling-base) (height walling-height) (slabs walling-slabs) (openings walling-openings) (name walling-name) (under walling-under))
(define-record-type hole (make-hole* kind at width height sill fill) hole?
  (kind hole-kind) (at hole-at) (width hole-width) (height hole-height) (sill hole-sill) (fill hole-fill))

(define (positive-number? x) (and (real? x) (finite? x) (> x 0)))
(define (check-positive who name x) (if (not (positive-number? x)) (error who "~a must be a positive number, got ~s" name x)))
(define (check-number who name x) (if (not (and (real? x) (finite? x))) (error who "~a must be a number, got ~s" name x)))

; The materials of layers that are not among the ready ones.
(define layer-materials
  `((insulation . ,(make-material #:name "insulation" #:color "khaki" #:roughness 0.9))
    (block . ,(make-material #:name "block" #:color "rosybrown" #:roughness 0.9))
    (plasterboard . ,(make-material #:name "plasterboard" #:color "gainsboro" #:roughness 0.8))
    (screed . ,(make-material #:name "screed" #:color "darkgray" #:roughness 0.8))
    (tile . ,(make-material #:name "tile" #:color "beige" #:roughness 0.3))))
(define (in-material m o)
  (cond ((not m) o)
        ((and (symbol? m) (assq m layer-materials)) => (lambda (known) (with-material (cdr known) o)))
        (else (with-material m o))))

; Returns the layers of a wall or slab as lists of thickness, material and whether this is the core.
(define (layers-of who layers)
  (define (fault) (error who "layers must be a thickness, or a list of layers such as (0.24 brick), got ~s" layers))
  (define (one l)
    (cond ((positive-number? l) (list l #f #f))
          ((not (and (list? l) (<= 1 (length l) 3))) (fault))
          ((positive-number? (car l)) (list (car l) (and (pair? (cdr l)) (cadr l)) (and (pair? (cdr l)) (pair? (cddr l)))))
          ((and (pair? (cdr l)) (positive-number? (cadr l))) (list (cadr l) (car l) (pair? (cddr l))))
          (else (fault))))
  (if (or (number? layers) (pair? layers)) (if (list? layers) (map one layers) (list (one layers))) (fault)))

; The core is the layer that says so, else the thickest that does not insulate.
(define (core-of layers)
  (or (list-index third layers)
      (let* ((bearing (lambda (l) (if (memq (second l) '(insulation air)) 0 (first l)))) (most (apply max (map bearing layers))))
        (list-index (lambda (l) (= (bearing l) most)) layers))))

(define (sums start l) (if (null? l) (list start) (cons start (sums (+ start (car l)) (cdr l)))))

(define (wall path #:height [height any? 2.75] #:layers [layers any? 0.2] #:base [base any? 0] #:align [align any? 'centre] #:name [name any? #f])
  (check-positive 'wall "height" height)
  (check-number 'wall "base" base)
  (let*-values (((points closed z) (path-points 'wall path)) ((layers) (layers-of 'wall layers)))
    (let* ((total (apply + (map first layers)))
           (first-offset (case align ((centre center) (/ total -2)) ((left) (- total)) ((right) 0)
                           (else (error 'wall "align must be 'centre, 'left or 'right, got ~s" align))))
           (offsets (sums first-offset (map first layers))) (materials (map second layers)) (core (core-of layers)))
      (drawn-wall (make-walling points closed offsets materials core (+ base z) height
                    (list (list (+ base z) (+ base z height) (lone-plan points closed offsets materials core))) '() name #f)))))

; Returns the areas of a wall's layers without joints.
(define (lone-plan points closed offsets materials core)
  (if closed
      (let ((loops (map (lambda (o) (cdr (points-aside 'wall points #t o))) offsets)))
        (map (lambda (a b) (list (if (> (abs (turn a)) (abs (turn b))) (list a b) (list b a)))) loops (cdr loops)))
      (let ((p (piece-of 'wall #f points offsets materials core)))
        (map (lambda (l) (list (list l))) (layer-loops p (free-end (branch-of p #t)) (free-end (branch-of p #f)))))))

(define-primitive (wall-object [data any?])
  (let* ((solids (layer-solids data)) (holes (walling-openings data)))
    (unite (if (null? holes) solids (subtract (unite solids) (map (lambda (h) (hole-cutter data h)) holes)))
           (filter-map (lambda (h) (hole-filled data h)) holes))))
(define (drawn-wall data) (wall-object data))
(define (wall? x) (wall-object? x))
(define (data-of who w)
  (if (wall-object? w) (wall-object-data (note-asked w)) (error who "wall must be a wall, as wall or join-walls return it, got ~s" w)))

(define (area-solid loops bottom top)
  (do-extrude (apply make-region (map (lambda (l) (make-polygon (map (lambda (p) (xyz (cx p) (cy p) bottom)) l))) loops)) (- top bottom)))

; Returns the solids of the layers, from the right.
(define (layer-solids data)
  (map (lambda (material k)
         (in-material material
           (below-roof data (map (lambda (s) (map (lambda (a) (area-solid a (first s) (second s))) (list-ref (third s) k))) (walling-slabs data)))))
    (walling-materials data) (iota (length (walling-materials data)))))

(define (wall-layers w) (layer-solids (data-of 'wall-layers w)))
(define (wall-path w)
  (let* ((d (data-of 'wall-path w))) (map (lambda (p) (xyz (cx p) (cy p) (walling-base d))) (walling-points d))))
(define (wall-thickness w) (let ((o (walling-offsets (data-of 'wall-thickness w)))) (- (last o) (first o))))
(define (wall-height w) (walling-height (data-of 'wall-height w)))
(define (wall-base w) (walling-base (data-of 'wall-base w)))
(define (wall-name w) (walling-name (data-of 'wall-name w)))
(define (wall-openings w)
  (map (lambda (h) (list (hole-kind h) (hole-at h) (hole-width h) (hole-height h) (hole-sill h))) (walling-openings (data-of 'wall-openings w))))

(define (with-slabs d slabs)
  (make-walling (walling-points d) (walling-closed d) (walling-offsets d) (walling-materials d) (walling-core d) (walling-base d)
    (walling-height d) slabs (walling-openings d) (walling-name d) (walling-under d)))
(define (with-hole d h)
  (make-walling (walling-points d) (walling-closed d) (walling-offsets d) (walling-materials d) (walling-core d) (walling-base d)
    (walling-height d) (walling-slabs d) (append (walling-openings d) (list h)) (walling-name d) (walling-under d)))
(define (with-roof d top under)
  (let* ((slabs (walling-slabs d)) (highest (last slabs)))
    (make-walling (walling-points d) (walling-closed d) (walling-offsets d) (walling-materials d) (walling-core d) (walling-base d)
      (- top (walling-base d)) (append (drop-right slabs 1) (list (list (first highest) top (third highest)))) (walling-openings d)
      (walling-name d) under)))
(define (below-roof data solids) (if (walling-under data) (intersect (unite solids) (walling-under data)) (unite solids)))

; Returns the walls, joined, which go up to the planes of a roof: its faces, or the thickness below them. Below the eaves, the
; walls may be beside the roof. Several walls are joined again, because all have other heights now.
(define (walls-under walls faces #:thickness [thickness any? 0])
  (check-faces 'walls-under faces)
  (if (not (and (real? thickness) (finite? thickness) (>= thickness 0))) (error 'walls-under "thickness must be a number of 0 or more, got ~s" thickness))
  (let* ((data (map (lambda (w) (data-of 'walls-under w)) (flatten (list walls)))) (points (append-map cdr faces))
         (foot (- (apply min (map cz points)) thickness)) (top (- (apply max (map cz points)) thickness)))
    (if (null? data) '()
        (let* ((corners (append points (append-map walling-points data))) (low (apply min (map walling-base data)))
               (edge (lambda (f get d) (+ (apply f (map get corners)) d)))
               (under (unite (do-move (faces-solid faces '()) (vxyz 0 0 (- thickness)))
                             (make-box (xyz (edge min cx -10) (edge min cy -10) (- (min low foot) 1)) (xyz (edge max cx 10) (edge max cy 10) foot)))))
          (for-each (lambda (d) (if (<= top (walling-base d)) (error 'walls-under "the roof lies below the foot of the wall from ~s" (first (walling-points d))))) data)
          (let ((raised (map (lambda (d) (drawn-wall (with-roof d top under))) data)))
            (if (null? (cdr raised)) raised (join-walls raised)))))))

; Joints.

(define (join-walls . walls)
  (let* ((data (map (lambda (w) (data-of 'join-walls w)) (flatten walls)))
         (top (lambda (d) (+ (walling-base d) (walling-height d))))
         (twice (find-tail (lambda (d) (> (count (lambda (o) (eq? o d)) data) 1)) data))
         (heights (sort (delete-duplicates (append (map walling-base data) (map top data)) =) <))
         (known (make-hash))
         (plan (lambda (bottom up)
                 (let* ((there (map (lambda (d) (and (<= (walling-base d) bottom) (>= (top d) up))) data)))
                   (or (hash-ref known there #f)
                       (let ((found (joint-plan (filter-map (lambda (d t) (and t d)) data there))))
                         (hash-set! known there found)
                         found)))))
         (plans (cond (twice (error 'join-walls "the wall from ~s to ~s is given twice" (first (walling-points (car twice))) (last (walling-points (car twice)))))
                      ((null? data) '())
                      (else (map (lambda (a b) (list a b (plan a b))) heights (cdr heights))))))
    (map (lambda (d)
           (drawn-wall (with-slabs d (stacked (filter-map (lambda (s) (let ((own (assq d (third s)))) (and own (list (first s) (second s) (cdr own))))) plans)))))
      data)))

; Returns slabs with those united that have one plan.
(define (stacked slabs)
  (cond ((or (null? slabs) (null? (cdr slabs))) slabs)
        ((and (= (second (car slabs)) (first (cadr slabs))) (equal? (third (car slabs)) (third (cadr slabs))))
         (stacked (cons (list (first (car slabs)) (second (cadr slabs)) (third (car slabs))) (cddr slabs))))
        (else (cons (car slabs) (stacked (cdr slabs))))))

; Returns for each wall (data . areas of its layers), all walls joined.
(define (joint-plan all)
  (let* ((ends (map (lambda (d) (snapped-points d all)) all)) (nodes (joint-nodes all ends))
         (pieces (append-map (lambda (d points) (pieces-between d points nodes)) all ends))
         (branches (append-map (lambda (p) (list (branch-of p #t) (branch-of p #f))) pieces))
         (found (append-map joint-ends (by-node branches)))
         (end-of (lambda (p start?) (find (lambda (e) (and (eq? (branch-piece (first e)) p) (eq? (branch-start? (first e)) start?))) found)))
         (loops-of (lambda (p) (layer-loops p (second (end-of p #t)) (second (end-of p #f)))))
         (areas-of (lambda (p)
                     (let* ((ends (list (end-of p #t) (end-of p #f))) (cutters (remove (lambda (c) (eq? c p)) (append-map third ends))))
                       (if (null? cutters) (map (lambda (l) (list (list l))) (loops-of p))
                           (layers-outside (loops-of p) (map loops-of cutters) (tips-of p ends) (branch-size (car (first ends)))))))))
    (map (lambda (d)
           (let ((own (filter (lambda (p) (eq? (piece-owner p) d)) pieces)))
             (cons d
               (if (null? own) (lone-plan (walling-points d) (walling-closed d) (walling-offsets d) (walling-materials d) (walling-core d))
                   (let ((layers (apply map append (map areas-of own))))
                     (if (every null? layers)
                         (error 'join-walls "the wall from ~s to ~s lies within another one" (first (walling-points d)) (last (walling-points d))))
                     layers)))))
      all)))

; Returns the nodes where a wall ends and others cut it off, of the ends of one of its pieces.
(define (tips-of p ends)
  (filter-map (lambda (e) (and (not (any (lambda (c) (eq? (piece-owner c) (piece-owner p))) (third e))) (branch-node (first e)))) ends))

(define (by-node branches)
  (if (null? branches) '()
      (call-with-values (lambda () (partition (lambda (b) (meet? (branch-node b) (branch-node (car branches)))) branches))
        (lambda (here others) (cons here (by-node others))))))

; Returns the points of a wall; ends within the body of another wall go on, or back, to that wall's path.
(define (snapped-points d all)
  (define (snapped end before)
    (let ((v (way before end)))
      (or (any (lambda (o)
                 (and (not (eq? o d))
                      (any (lambda (s)
                             (let* ((a (car s)) (b (cdr s)) (w (way a b)) (u (p->q a end)) (h (cross-2d w u)))
                               (and (<= (- (first (walling-offsets o)) nearly) h (+ (last (walling-offsets o)) nearly))
                                    (<= (- nearly) (dot w u) (+ (distance a b) nearly))
                                    (> (abs (cross-2d v w)) 0.1)
                                    (let ((x (segments-cross before (p+v end (v*r v (+ (last (walling-offsets o)) (- (first (walling-offsets o)))))) a b nearly)))
                                      (and x (not (meet? (third x) before)) (cond ((meet? (third x) a) a) ((meet? (third x) b) b) (else (third x))))))))
                        (pairs-of (walling-points o)))))
               all)
          end)))
  (let* ((points (walling-points d)))
    (if (walling-closed d) points
        (let* ((from-start (cons (snapped (first points) (second points)) (cdr points))) (back (reverse from-start)))
          (reverse (cons (snapped (first back) (second back)) (cdr back)))))))

; Returns the points where walls end or cross.
(define (joint-nodes all ends)
  (define (fresh p nodes) (if (any (lambda (n) (meet? n p)) nodes) nodes (cons p nodes)))
  (let* ((at-ends (fold (lambda (d points nodes) (if (walling-closed d) nodes (fresh (first points) (fresh (last points) nodes)))) '() all ends)))
    (let loop ((l ends) (nodes at-ends))
      (if (null? l) nodes
          (loop (cdr l)
            (fold (lambda (points nodes)
                    (fold (lambda (s nodes)
                            (fold (lambda (r nodes)
                                    (let ((x (segments-cross (car s) (cdr s) (car r) (cdr r) nearly))) (if x (fresh (third x) nodes) nodes)))
                              nodes (pairs-of points)))
                      nodes (pairs-of (car l))))
              nodes (cdr l)))))))

; Returns the points of a piece without samples of a curve that are so near to an end that its offset would turn back.
(define (without-near-bends points thickness)
  (define (from-start points)
    (if (and (pair? (cddr points)) (< (distance (first points) (second points)) (* 0.2 thickness))
             (< (angle-between (p->q (first points) (second points)) (p->q (second points) (third points))) 0.15))
        (from-start (cons (first points) (cddr points)))
        points))
  (reverse (from-start (reverse (from-start points)))))

; Returns the pieces of a wall between the nodes on its path; none for a closed path without nodes.
(define (pieces-between d points nodes)
  (let* ((total (points-length points))
         (on (sort (filter-map (lambda (n) (call-with-values (lambda () (distance-along points n)) (lambda (s gap) (and (< gap nearly) (cons s n))))) nodes) < #:key car))
         (made (lambda (points)
                 (piece-of 'join-walls d (without-near-bends points (- (last (walling-offsets d)) (first (walling-offsets d)))) (walling-offsets d)
                   (walling-materials d) (walling-core d))))
         (between (lambda (a b) (append (list (cdr a)) (drop-right (cdr (part-of points (car a) (car b))) 1) (list (cdr b))))))
    (cond ((null? on) '())
          ((not (walling-closed d)) (map (lambda (a b) (made (between a b))) on (cdr on)))
          (else
            (let* ((f (first on)) (l (last on))
                   (around (append (drop-right (part-of points (car l) total) 1) (part-of points 0 (car f)))))
              (append (map (lambda (a b) (made (between a b))) on (cdr on))
                      (list (made (append (list (cdr l)) (filter (lambda (p) (not (or (meet? p (cdr l)) (meet? p (cdr f))))) around) (list (cdr f)))))))))))
