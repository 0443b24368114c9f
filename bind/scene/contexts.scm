; Contexts: each node may have its own program with its own environment, in the one heap. After actions.scm. Names that
; begin with % are hidden from programs. Compiled into the binary when it is built.

(define (node-environment node)
  (%need-node 'node-environment 'node node)
  (or (%node-program node)
      (begin (%set-node-program! node (%new-program)) (%node-program node))))

; Evaluates the expression in the node's environment, with the focus on the node: its drawing becomes the node's.
(define (node-eval node expression)
  (%need-node 'node-eval 'node node)
  (let ((value #f) (environment (node-environment node)))
    (%with-node node (lambda () (set! value (eval expression environment))))
    value))

; Returns the value of a name that the node's program has defined.
(define (node-ref node name)
  (%need-node 'node-ref 'node node)
  (%need-symbol 'node-ref 'name name)
  (if (not (and (%node-program node) (%program-defines? (%node-program node) name)))
      (error 'node-ref "the program of ~s defines no ~a" node name))
  (eval name (%node-program node)))

; ---- resources: contexts share a property of a node above them ----

; Returns the property of this name of the node itself (local), otherwise of the nearest node above it that has one, and
; last of the root (global); #f if none of them has it.
(define (property-find node name)
  (%need-node 'property-find 'node node)
  (%need-symbol 'property-find 'name name)
  (let up ((n node))
    (or (hash-ref (%node-table n) name #f)
        (and (not (eq? n (%root))) (up (or (%node-parent n) (%root)))))))

; ---- for hosts ----

(define (%host-procedure number) (lambda arguments (apply %host-call number arguments)))
(define (%host-define name value) (eval (list 'define name (list 'quote value)) (interaction-environment)))
(define (%node-create type name parent) (node-create type #:name name #:parent parent))

; Evaluates every expression of the text in turn; returns the last one's value.
(define (%node-eval-text node text)
  (let ((port (open-input-string text)))
    (let loop ((value #f))
      (let ((expression (read port)))
        (if (eof-object? expression) value (loop (node-eval node expression)))))))

; Returns hits as lists: distance point node path file line column.
(define (%pick-for-host from direction)
  (map (lambda (hit)
         (append (map (lambda (key) (data-ref hit key)) '(distance point node path))
                 (or (data-ref hit 'place) (list #f 0 0))))
       (node-pick from direction)))
