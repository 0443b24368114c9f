; Panels: grids of cells over a surface, components fitted to them, and a report on request. After maps.scm. Names that
; begin with % are hidden from programs. Compiled into the binary when it is built.
;
; A grid is a list of cells; a cell is a list of three or more corners (u . v) in the square from 0 to 1.

; Returns the part of a convex cell on one side of a line u or v = limit.
(define (%clip-cell cell take limit below?)
  (define (inside? c) (if below? (<= (take c) limit) (>= (take c) limit)))
  (if (null? cell)
      '()
      (let loop ((l cell) (before (last cell)) (made '()))
        (if (null? l)
            (reverse made)
            (let* ((c (car l)) (in (inside? c))
                   (crossing (if (eq? in (inside? before))
                                 '()
                                 (let ((t (/ (- limit (take before)) (- (take c) (take before)))))
                                   (list (cons (+ (car before) (* t (- (car c) (car before)))) (+ (cdr before) (* t (- (cdr c) (cdr before)))))))))
                   (all (append crossing (if in (list c) '()))))
              (loop (cdr l) c (append (reverse all) made)))))))

(define (%tidy-cell cell)
  (let ((kept (fold (lambda (c made) (if (and (pair? made) (near? (car c) (caar made)) (near? (cdr c) (cdar made))) made (cons c made))) '() cell)))
    (let ((l (reverse kept)))
      (if (and (pair? l) (pair? (cdr l)) (near? (car (car l)) (car (last l))) (near? (cdr (car l)) (cdr (last l)))) (reverse (cdr kept)) l))))

(define (%cell-area cell)
  (let loop ((l cell) (before (last cell)) (sum 0))
    (if (null? l)
        (/ sum 2)
        (loop (cdr l) (car l) (+ sum (- (* (car before) (cdar l)) (* (caar l) (cdr before))))))))

(define (%grid who cells)
  (filter-map
    (lambda (cell)
      (let ((c (%tidy-cell (%clip-cell (%clip-cell (%clip-cell (%clip-cell cell car 0 #f) car 1 #t) cdr 0 #f) cdr 1 #t))))
        (and (>= (length c) 3) (> (abs (%cell-area c)) 1e-9) c)))
    cells))

(define (%need-grid who nu nv)
  (%need-count who 'nu nu 1000)
  (%need-count who 'nv nv 1000))

(define (quad-grid nu nv)
  (%need-grid 'quad-grid nu nv)
  (append-map
    (lambda (i)
      (map (lambda (j)
             (let ((a (/ i nu)) (b (/ (+ i 1) nu)) (c (/ j nv)) (d (/ (+ j 1) nv)))
               (list (cons a c) (cons b c) (cons b d) (cons a d))))
           (iota nv)))
    (iota nu)))

(define (triangle-grid nu nv)
  (%need-grid 'triangle-grid nu nv)
  (append-map (lambda (q) (list (list (first q) (second q) (third q)) (list (first q) (third q) (fourth q)))) (quad-grid nu nv)))

(define (diamond-grid nu nv)
  (%need-grid 'diamond-grid nu nv)
  (%grid 'diamond-grid
    (append-map
      (lambda (i)
        (filter-map
          (lambda (j)
            (and (odd? (+ i j))
                 (map (lambda (d) (cons (/ (+ i (car d)) (* 2 nu)) (/ (+ j (cdr d)) (* 2 nv)))) '((-1 . 0) (0 . -1) (1 . 0) (0 . 1)))))
          (iota (+ (* 2 nv) 1))))
      (iota (+ (* 2 nu) 1)))))

; nu hexagons in each row; each row is shifted by half a hexagon; those on the border are cut.
(define (hexagon-grid nu nv)
  (%need-grid 'hexagon-grid nu nv)
  (%grid 'hexagon-grid
    (append-map
      (lambda (j)
        (map (lambda (i)
               (let ((u (+ i (if (odd? j) 1 1/2))) (v (+ j 1/2)))
                 (map (lambda (d) (cons (/ (+ u (car d)) nu) (/ (+ v (cdr d)) nv)))
                      '((0 . -2/3) (1/2 . -1/3) (1/2 . 1/3) (0 . 2/3) (-1/2 . 1/3) (-1/2 . -1/3)))))
             (iota (+ nu 2) -1)))
      (iota (+ nv 2) -1))))

; Returns the corners (u . v) of a region or a closed curve in the plane XY, such as a cell of voronoi, or #f.
(define (%region-cell o)
  (and (or (region? o) (curve? o))
       (let ((l (outline o)))
         (and (= (length l) 1) (eq? (object-kind (lowered (car l))) 'line)
              (map (lambda (p) (cons (cx p) (cy p))) (car (object-arguments (lowered (car l)))))))))

; Returns the cells of a grid, in which regions are cells, too.
(define (%need-cells who grid)
  (define (cell c) (if (object? c) (%region-cell c) c))
  (let ((cells (and (list? grid) (map cell grid))))
    (if (not (and cells (every (lambda (c) (and (list? c) (>= (length c) 3) (every (lambda (p) (and (pair? p) (real? (car p)) (real? (cdr p)))) c))) cells)))
        (error who "grid must be a grid, such as (quad-grid 8 4), or a list of regions with one border, got ~s" grid))
    cells))

; Returns the corners of a panel without those that equal their neighbour, as at the pole of a dome. #f: it has no area.
(define (%distinct-corners corners)
  (let* ((size (apply max (map (lambda (p) (distance (car corners) p)) corners))) (blur (* 1e-9 size)))
    (define (apart? p q) (> (distance p q) blur))
    (let* ((kept (reverse (fold (lambda (p made) (if (and (pair? made) (not (apart? p (car made)))) made (cons p made))) '() corners)))
           (round (if (and (pair? (cdr kept)) (not (apart? (car kept) (last kept)))) (cdr kept) kept)))
      (and (>= (length round) 3) (> (vlength (%newell round)) (* 1e-12 size size)) round))))

; Returns the corners of each cell on the surface, for the procedure `who`; cells without an area are omitted.
(define (%corners-for who f grid)
  (%need-procedure who 'f f)
  (filter-map
    (lambda (cell)
      (%distinct-corners
        (map (lambda (c)
               (let ((p (f (car c) (cdr c))))
                 (if (%finite-point? p)
                     p
                     (error who "f must give points of finite coordinates; at (u, v) = (~a, ~a) it gave ~s" (car c) (cdr c) p))))
             cell)))
    (%need-cells who grid)))
(define (panel-corners f grid) (%corners-for 'panel-corners f grid))

; component makes an object for the corners of a cell.
(define (panelise f grid component)
  (%need-procedure 'panelise 'component component)
  (unite (map (lambda (corners)
                (let ((o (component corners)))
                  (if (object? o) o (error 'panelise "component must give an object, got ~s" o))))
              (%corners-for 'panelise f grid))))

(define (%mean-point l) (p+v origin (v/r (fold (lambda (p v) (v+v v (p->q origin p))) (vxyz 0 0 0) l) (length l))))
; Returns a normal with twice the panel's area as its length.
(define (%newell l)
  (let ((o (car l)))
    (fold (lambda (p q v) (v+v v (cross (p->q o p) (p->q o q)))) (vxyz 0 0 0) l (append (cdr l) (list o)))))

; Returns a flat or folded plate over the corners, `thickness` thick, smaller on all sides by the gap.
(define (panel-plate corners thickness #:gap [gap any? 0])
  (%need-points 'panel-plate 'corners corners 3)
  (%need-positive 'panel-plate 'thickness thickness)
  (if (not (and (real? gap) (>= gap 0))) (error 'panel-plate "gap must be a number of 0 or more, got ~s" gap))
  (let* ((n (length corners)) (middle (%mean-point corners)) (normal (%newell corners)))
    (if (< (vlength normal) 1e-300) (error 'panel-plate "corners must not lie on one line, got ~s" corners))
    (let* ((up (v*r (unitize normal) (/ thickness 2)))
           (reach (apply min (map (lambda (p q) (let ((d (p->q p q))) (/ (vlength (cross d (p->q p middle))) (vlength d)))) corners (append (cdr corners) (list (car corners))))))
           (k (- 1 (/ gap reach))))
      (if (<= k 0) (error 'panel-plate "gap must be less than ~a, which leaves nothing of this panel, got ~a" reach gap))
      (let ((inner (map (lambda (p) (p+v middle (v*r (p->q middle p) k))) corners)))
        (make-polyface-mesh
          (append (map (lambda (p) (p+v p up)) inner) (map (lambda (p) (p-v p up)) inner) (list (p+v middle up) (p-v middle up)))
          (append-map
            (lambda (i)
              (let ((a (+ i 1)) (b (+ (remainder (+ i 1) n) 1)))
                (list (list a b (+ (* 2 n) 1)) (list (+ n b) (+ n a) (+ (* 2 n) 2)) (list a (+ n a) (+ n b) b))))
            (iota n)))))))

; Returns the largest distance of a corner from the plane fitted to the corners.
(define (%out-of-plane corners)
  (let* ((middle (%mean-point corners)) (n (%newell corners)))
    (if (= (vlength n) 0) 0 (apply max (map (lambda (p) (abs (dot (unitize n) (p->q middle p)))) corners)))))

; Returns all distances between corners in ascending order: panels with equal distances count as copies.
(define (%panel-form corners)
  (sort (let loop ((l corners)) (if (null? l) '() (append (map (lambda (q) (distance (car l) q)) (cdr l)) (loop (cdr l))))) <))

; Returns an association list: the number of panels, of kinds that differ by more than the tolerance, and of panels out
; of plane by more than it; the largest such distance, the least and the greatest area, the longest edge, and the kind
; of each panel.
(define (panel-report f grid #:tolerance [tolerance any? 0.001])
  (%need-positive 'panel-report 'tolerance tolerance)
  (let* ((panels (%corners-for 'panel-report f grid)) (forms '()) (count 0))
    (define (kind-of corners)
      (let* ((form (%panel-form corners))
             (found (find (lambda (k) (and (= (length (cdr k)) (length form)) (every (lambda (a b) (<= (abs (- a b)) tolerance)) (cdr k) form))) forms)))
        (if found
            (car found)
            (begin (set! count (+ count 1)) (set! forms (cons (cons count form) forms)) count))))
    (let* ((kinds (map kind-of panels)) (off (map %out-of-plane panels))
           (areas (map (lambda (c) (/ (vlength (%newell c)) 2)) panels))
           (edges (append-map (lambda (c) (map distance c (append (cdr c) (list (car c))))) panels)))
      (if (null? panels) (error 'panel-report "the grid has no cells"))
      (list (cons 'panels (length panels)) (cons 'kinds count)
            (cons 'bent (length (filter (lambda (d) (> d tolerance)) off))) (cons 'worst (apply max off))
            (cons 'area (list (apply min areas) (apply max areas))) (cons 'longest (apply max edges))
            (cons 'kind-of-each kinds)))))
