; Actions: calls for every node of a tree in turn; and picking. After nodes.scm. Names that begin with % are hidden from
; programs. Compiled into the binary when it is built.
;
; An action is a name. It calls the procedures that nodes have for it; a type gives these to its nodes when they are
; made.

(define %frame-actions '(update draw finish))

(define (node-on node action handler)
  (%need-node 'node-on 'node node)
  (%need-symbol 'node-on 'action action)
  (if handler (%need-procedure 'node-on 'handler handler))
  (let ((known (or (%node-actions node) (begin (%set-node-actions! node (make-hasheq)) (%node-actions node)))))
    (if handler (hash-set! known action handler) (hash-remove! known action))))

(define (%apply-action action node arguments)
  (%walk node
    (lambda (n)
      (let ((f (and (%node-actions n) (hash-ref (%node-actions n) action #f))))
        (if f (apply f n arguments))))))

(define (action-apply action node . arguments)
  (%need-symbol 'action-apply 'action action)
  (%need-node 'action-apply 'node node)
  (%apply-action action node arguments))

; Runs a frame: each action goes through the whole tree before the next begins. seconds: since the last frame.
(define (node-frame [seconds any? 0])
  (if (not (and (real? seconds) (finite? seconds) (>= seconds 0))) (error 'node-frame "seconds must be a number of 0 or more, got ~s" seconds))
  (for-each
    (lambda (action part)
      (%viewer-frame part seconds)
      (%apply-action action (%root) (list seconds)))
    %frame-actions (list %viewer-prepare %viewer-draw %viewer-finish))
  (%adapt-quality seconds))

; ---- picking ----

; Returns the ray's hit on a node itself: ((distance . d) (point . p) (node . n) (path . nodes) (place . (file line
; column))), or #f. A node that its host draws in another way has a procedure for the action intersect, which returns
; the hit.
(define (%pick-in node path matrix from direction)
  (let loop ((objects (%own-drawing node)) (best (%own-hit node from direction)))
    (if (pair? objects)
        (let ((hit (%ray-meets (car objects) matrix from direction)))
          (loop (cdr objects) (if (and hit (or (not best) (< (car hit) (car best)))) hit best)))
        (and best
             (list (cons 'distance (car best))
                   (cons 'point (p+v from (v*r direction (car best))))
                   (cons 'node node)
                   (cons 'path (reverse path))
                   (cons 'place (cdr best)))))))

; Returns (distance . #f), or #f.
(define (%own-hit node from direction)
  (let* ((f (and (%node-actions node) (hash-ref (%node-actions node) 'intersect #f))) (d (and f (f node from direction))))
    (if (and d (not (and (real? d) (finite? d) (>= d 0))))
        (error 'node-intersect "the procedure of ~s for the action intersect must give a distance from 0 on or #f, got ~s" node d))
    (and d (cons d #f))))

(define (%picked from direction node)
  (let loop ((waiting (list (vector node '() (if (%node-parent node) (node-worldtransform (%node-parent node)) (translation-matrix %zero))))) (hits '()))
    (if (null? waiting)
        (sort hits (lambda (a b) (< (cdar a) (cdar b))))
        (let* ((n (vector-ref (car waiting) 0))
               (path (cons n (vector-ref (car waiting) 1)))
               (matrix (if (%unmoved? n) (vector-ref (car waiting) 2) (matrix* (vector-ref (car waiting) 2) (%frame n))))
               (hit (%pick-in n path matrix from direction)))
          (loop (append (map (lambda (child) (vector child path matrix)) (%children n)) (cdr waiting))
                (if hit (cons hit hits) hits))))))

(define (%need-ray who from direction)
  (if (not (and (point? from) (finite? (cx from)) (finite? (cy from)) (finite? (cz from)))) (error who "from must be a point of finite coordinates, got ~s" from))
  (if (not (and (gvector? direction) (< 0 (vlength direction) +inf.0))) (error who "direction must be a gvector longer than 0, got ~s" direction)))

; Returns all nodes from this one on whose own drawing the ray meets, nearest first.
(define (node-intersect from direction [node any? #f])
  (%need-ray 'node-intersect from direction)
  (if node (%need-node 'node-intersect 'node node))
  (%picked from (unitize direction) (or node (%root))))

; Selects the nearest of them: emits the event, and calls the node's own procedure for the action pick.
(define (node-pick from direction [node any? #f])
  (%need-ray 'node-pick from direction)
  (if node (%need-node 'node-pick 'node node))
  (let ((hits (%picked from (unitize direction) (or node (%root)))))
    (if (pair? hits)
        (let* ((hit (car hits)) (n (data-ref hit 'node)) (f (and (%node-actions n) (hash-ref (%node-actions n) 'pick #f))))
          (%emit 'Node.selected n)
          (if f (f n hit))))
    hits))
