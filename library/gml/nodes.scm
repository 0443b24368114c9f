; The scene's nodes as GML's contexts: each has a model of its own. After modelling.scm.

(define (need-scene-node who v) (if (not (node? v)) (refuse who "an operand must be a node" v)))
(define (gvector->point v) (xyz (cx v) (cy v) (cz v)))
(define (as-gvector who v) (need-vector who v) (vxyz (cx v) (cy v) (cz v)))

(operator (node-create type)
  (need-name 'node-create type)
  (node-create (if (memq type '(gmlcontext gmlContext context)) 'context type)))
(operator! (node-clear)
  (for-each (lambda (n) (hash-remove! models n)) (hash-keys models))
  (node-clear))
(operator! (node-begin n) (need-scene-node 'node-begin n) (node-begin n))

; What was modelled in a context is its drawing from the end on.
(define (keep-drawing node)
  (let ((m (hash-ref models node #f)))
    (if m (node-setdrawing node (model-objects m)))))
(operator! (node-end)
  (let ((node (node-current)))
    (if (not (eq? node (node-getroot))) (keep-drawing node))
    (node-end)))
(operator! (node-addchild parent child) (need-scene-node 'node-addchild parent) (need-scene-node 'node-addchild child)
  (node-addchild parent child))
(operator! (node-removechild parent child)
  (need-scene-node 'node-removechild parent)
  (node-removechild parent child))
(operator! (node-removechildren n) (need-scene-node 'node-removechildren n) (node-removechildren n))
(operator (node-getparent n) (need-scene-node 'node-getparent n)
  (or (node-getparent n) (error 'node-getparent "the node hangs nowhere")))
(operator (node-getchild n i) (need-scene-node 'node-getchild n) (node-getchild n i))
(operator (node-getchildren n) (need-scene-node 'node-getchildren n) (list->array (node-getchildren n)))
(operator! (node-find name)
  (let ((n (node-find (text-of 'node-find name))))
    (if (not n) (error 'node-find (string-append "there is no node " (text-of 'node-find name))))
    (gml:push n)))
(operator! (node-setname n name) (need-scene-node 'node-setname n) (node-setname n (text-of 'node-setname name)))
(operator (node-getname n) (need-scene-node 'node-getname n) (or (node-getname n) ""))
(operator (node-current) (node-current))
(operator (node-getroot) (node-getroot))

(define-syntax frame-operators
  (syntax-rules ()
    ((_ (name set) ...) (begin (operator! (name n v) (need-scene-node 'name n) (set n (as-gvector 'name v))) ...))))
(frame-operators
  (node-translate node-translate) (node-rotate node-rotate) (node-scale node-scale)
  (set-translate node-translate) (set-rotate node-rotate) (set-scale node-scale))
(define-syntax frame-readers
  (syntax-rules () ((_ (name get) ...) (begin (operator (name n) (need-scene-node 'name n) (gvector->point (get n)))
                                         ...))))
(frame-readers
  (node-gettranslate node-gettranslate) (node-getrotate node-getrotate) (node-getscale node-getscale))

; The end of a file: contexts that were left open keep what was modelled, and the root's part is drawn.
(define (gml:finish)
  (let unwind ()
    (if (not (eq? (node-current) (node-getroot))) (begin (keep-drawing (node-current)) (node-end) (unwind))))
  (let ((m (hash-ref models (node-getroot) #f)))
    (if m (let ((l (model-objects m))) (if (pair? l) (begin (hash-remove! models (node-getroot)) (apply draw l)))))))
