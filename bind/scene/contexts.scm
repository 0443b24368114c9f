; Contexts: each node may have a program of its own, in an environment of its own, over the one heap. After actions.scm. Names that begin with % are not
; visible to programs. Compiled into the binary when it is built.

(define (node-environment node)
  (%need-node 'node-environment 'node node)
  (or (%node-program node)
      (begin (%set-node-program! node (%new-program)) (%node-program node))))

; The expression is evaluated in the node's environment, with the node as the focus: what it draws is the node's.
(define (node-eval node expression)
  (%need-node 'node-eval 'node node)
  (let ((value #f) (environment (node-environment node)))
    (%with-node node (lambda () (set! value (eval expression environment))))
    value))

; A name that the node's program has defined.
(define (node-ref node name)
  (%need-node 'node-ref 'node node)
  (%need-symbol 'node-ref 'name name)
  (if (not (and (%node-program node) (%program-defines? (%node-program node) name)))
      (error 'node-ref "the program of ~s defines no ~a" node name))
  (eval name (%node-program node)))

; ---- resources: what several contexts share is a property of a node above them ----

; The property of this name of the node itself (local), of the nearest node above it, or of the root (global); #f: none of
; them has it.
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

; Every expression of the text in turn; the last one's value.
(define (%node-eval-text node text)
  (let ((port (open-input-string text)))
    (let loop ((value #f))
      (let ((expression (read port)))
        (if (eof-object? expression) value (loop (node-eval node expression)))))))

; Hits as lists: distance point node path file line column.
(define (%pick-for-host from direction)
  (map (lambda (hit)
         (append (map (lambda (key) (data-ref hit key)) '(distance point node path))
                 (or (data-ref hit 'place) (list #f 0 0))))
       (node-pick from direction)))
