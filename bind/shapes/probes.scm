; Intersections of curves and rays with objects, nearest points, projections. After nets.scm. Names that begin with %
; are hidden from programs. Compiled into the binary when it is built.

(define %probe-last (cons #f #f)) ; the last object that was asked about, and its triangles
(define (%probe-of who o)
  (if (not (and (object? o) (or (solid? o) (surface? o)))) (error who "o must be a solid or a surface, got ~s" o))
  (if (not (eq? o (car %probe-last))) (set! %probe-last (cons o (%probe (%drawn o)))))
  (cdr %probe-last))

(define (%need-long-gvector who name v)
  (if (not (and (gvector? v) (> (vlength v) 0) (finite? (vlength v)))) (error who "~a must be a gvector longer than 0, got ~s" name v)))

(define (surface-intersections o c)
  (let ((probe (%probe-of 'surface-intersections o)))
    (%need-curve 'surface-intersections 'c c)
    (%probe-curve probe c)))

(define (closest-point o p)
  (%need-point 'closest-point 'p p)
  (if (and (object? o) (curve? o))
      (curve-point o (%curve-near o p))
      (begin
        (if (not (and (object? o) (or (solid? o) (surface? o)))) (error 'closest-point "o must be a curve, a solid or a surface, got ~s" o))
        (%probe-near (%probe-of 'closest-point o) p))))

(define (project-point o p v)
  (%need-point 'project-point 'p p)
  (%need-long-gvector 'project-point 'v v)
  (%probe-ray (%probe-of 'project-point o) p v))

; Projects the curve's points onto the object; omits parts that miss it.
(define (project-curve o c v #:n [n any? 200])
  (%need-long-gvector 'project-curve 'v v)
  (%need-count 'project-curve 'n n 100000)
  (let ((probe (%probe-of 'project-curve o)))
    (%need-curve 'project-curve 'c c)
    (let loop ((l (map (lambda (p) (%probe-ray probe p v)) (curve-division c n))) (run '()) (lines '()))
      (define (ended) (if (and (pair? run) (pair? (cdr run))) (cons (make-line (reverse run)) lines) lines))
      (cond
        ((null? l) (unite (reverse (ended))))
        ((car l) (loop (cdr l) (if (and (pair? run) (near? (car run) (car l))) run (cons (car l) run)) lines))
        (else (loop (cdr l) '() (ended)))))))

; Returns the curve at distance d from c over the object: to the left, seen from outside; to the right for a negative d.
(define (offset-curve o c d #:n [n any? 200])
  (if (not (and (real? d) (finite? d) (not (= d 0)))) (error 'offset-curve "d must be a number, finite and not 0, got ~s" d))
  (%need-count 'offset-curve 'n n 100000)
  (let ((probe (%probe-of 'offset-curve o)))
    (%need-curve 'offset-curve 'c c)
    (let ((lines (map make-line (%probe-offset probe c d n))))
      (if (null? lines) (error 'offset-curve "no curve lies at distance ~a from c: the object ends before, or c bends more than that" d))
      (unite lines))))

; Returns the part of a surface with u and v in a region of the XY plane.
(define (make-trimmed-surface f region)
  (%need-procedure 'make-trimmed-surface 'f f)
  (if (not (and (object? region) (or (region? region) (curve? region))))
      (error 'make-trimmed-surface "region must be a region, or closed curves, of u and v in the XY plane, got ~s" region))
  (let ((region (if (curve? region) (make-region region) region)))
    (let ((b (bounding-box region)))
      (if (not b) (error 'make-trimmed-surface "the region is empty"))
      (if (not (= (cz (first b)) (cz (second b)) 0))
          (error 'make-trimmed-surface "region must lie in the XY plane, whose x and y are u and v")))
    (do-deform region (lambda (p) (f (cx p) (cy p))))))

; Returns the shortest way over the object between its places nearest to p and q.
(define (geodesic o p q)
  (%need-point 'geodesic 'p p)
  (%need-point 'geodesic 'q q)
  (let* ((probe (%probe-of 'geodesic o)) (way (%probe-geodesic probe p q)))
    (if (null? way) (error 'geodesic "no way leads from ~s to ~s over the object: they lie on separate parts of it" p q))
    (let ((kept (reverse (fold (lambda (p made) (if (and (pair? made) (near? p (car made))) made (cons p made))) '() way))))
      (if (null? (cdr kept)) (empty-object) (make-line kept)))))
