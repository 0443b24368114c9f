; Random plans of walls of (visualscheme building), joined: the volume of their union is the sum of their layers' volumes,
; thus no two layers overlap; each layer is a solid; the walls' middles are filled up to the joints.
;   vs tests/oracle/wall_graphs.vs -D cases=1000
(import (visualscheme) (visualscheme building))
(define-parameter cases 10)
(define-parameter seed 1)
(define stacks '(0.3 0.1 ((0.115 brick) (0.1 insulation) (0.175 block) (0.015 plaster)) ((0.015 plaster) (0.1 block) (0.015 plaster))
                 ((0.015 plaster) (0.1 concrete)) ((0.02 wood) (0.2 insulation) (0.12 wood core) (0.02 plaster))))
(define (pick l) (list-ref l (random (length l))))
(define (fault . x) (display seed) (displayln x))

; A wall from p to q or from q to p, at times a little curved.
(define (random-wall p q)
  (let* ((bulge (vxyz (* -0.03 (- (cy q) (cy p))) (* 0.03 (- (cx q) (cx p))) 0)) (align (pick '(centre centre left right))))
    (cons (equal? align 'centre)
          (wall (case (random 4) ((0) (make-spline (list p (p+v (mid p q) bulge) q))) ((1) (list p q)) (else (list q p)))
            #:layers (pick stacks) #:height (pick '(1 2 3)) #:base (pick '(0 0 1/2)) #:align align))))

; Walls between the nodes of a shaken grid, none at less than 34 degrees to another.
(define (plan)
  (define nodes (make-hash))
  (define ways (make-hash))
  (for* ((i 3) (j 3)) (hash-set! nodes (list i j) (xy (+ (* 4 i) (random 1.6)) (+ (* 4 j) (random 1.6)))))
  (define (apart? v node) (every (lambda (w) (> (angle-between v w) 0.6)) (hash-ref ways node '())))
  (define (tried a b)
    (let* ((p (hash-ref nodes a)) (q (hash-ref nodes b)) (v (p->q p q)) (back (p->q q p)))
      (if (and (< (random 1.0) 0.6) (apart? v a) (apart? back b))
          (begin
            (hash-set! ways a (cons v (hash-ref ways a '())))
            (hash-set! ways b (cons back (hash-ref ways b '())))
            (list (random-wall p q)))
          '())))
  (append-map
    (lambda (i)
      (append-map
        (lambda (j)
          (append (if (< i 2) (tried (list i j) (list (+ i 1) j)) '()) (if (< j 2) (tried (list i j) (list i (+ j 1))) '())
                  (cond ((not (and (< i 2) (< j 2))) '())
                        ((= 0 (random 2)) (tried (list i j) (list (+ i 1) (+ j 1))))
                        (else (tried (list (+ i 1) j) (list i (+ j 1)))))))
        '(0 1 2)))
    '(0 1 2)))

(define (check)
  (let ((made (plan)))
    (if (pair? made)
        (let* ((joined (join-walls (map cdr made))) (layers (append-map wall-layers joined)) (all (unite joined)) (sum (apply + (map volume layers))))
          (if (not (near? (/ (volume all) sum) 1 1e-8)) (fault "volumes of union and layers:" (volume all) sum))
          (if (not (every (lambda (l) (and (solid? l) (> (volume l) 0))) layers)) (fault "a layer is empty"))
          (for-each
            (lambda (m w)
              (if (car m)
                  (let* ((path (wall-path w)) (ends (list path (reverse path))))
                    (for-each (lambda (e)
                                (let ((p (+z (intermediate-point (first e) (second e) 0.01) 0.1)))
                                  (if (not (contains? all p)) (fault "a gap at" p))))
                      ends))))
            made joined)))))
(let ((first-seed seed))
  (for ((s (range first-seed (+ first-seed cases))))
    (set! seed s)
    (random-seed! s)
    (guard (x ((error-object? x) (fault (error-object-message x)))) (check))))
