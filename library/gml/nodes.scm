; The scene's nodes as GML's contexts, each with its own model. After modelling.scm.

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

; At its end, the model of a context becomes its drawing.
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
(operator (node-controller) (node-controller))
(operator (node-current) (node-current))
(operator (node-getroot) (node-getroot))

(define-syntax frame-operators
  (syntax-rules ()
    ((_ (name set) ...) (begin (operator! (name n v) (need-scene-node 'name n) (set n (as-gvector 'name v))) ...))))
(frame-operators
  (node-transform node-transform) (node-translate node-translate) (node-rotate node-rotate) (node-scale node-scale)
  (set-translate node-translate) (set-rotate node-rotate) (set-scale node-scale))
(define-syntax frame-readers
  (syntax-rules () ((_ (name get) ...) (begin (operator (name n) (need-scene-node 'name n) (gvector->point (get n)))
                                         ...))))
(frame-readers
  (node-gettransform node-gettranslate) (node-gettranslate node-gettranslate) (node-getrotate node-getrotate) (node-getscale node-getscale))

; ---- the host's scene graph, which is the same tree ----

(operator (osg-ctxconvert n) (need-scene-node 'osg-ctxconvert n) n)
(operator (osg-getroot) (node-getroot))
(operator! (osg-addchild parent child)
  (need-scene-node 'osg-addchild parent) (need-scene-node 'osg-addchild child)
  (node-addchild parent child))

; ---- viewers, by their names ----

(operator! (viewer-activate name) (viewer-activate (string->symbol (text-of 'viewer-activate name))))

; ---- gizmos ----

(define (dictionary-of . pairs)
  (let ((d (make-hasheq)))
    (let loop ((l pairs)) (if (pair? l) (begin (hash-set! d (car l) (cadr l)) (loop (cddr l)))))
    d))

; The root's model was drawn at the end of its file. After a callback that changes it, its objects are drawn anew.
(define root-model #f)
(define root-drawn '())
(define (with-root-model thunk)
  (let ((root (node-getroot)))
    (if (and root-model (not (hash-ref models root #f))) (hash-set! models root root-model))
    (thunk)
    (let ((m (hash-ref models root #f)) (others (without root-drawn (node-getdrawing root))))
      (if m (keep-root-drawn! m))
      (node-setdrawing root (append others root-drawn)))))
(define (without some objects) ; each as often as it occurs
  (let ((counts (make-hash)))
    (for-each (lambda (o) (hash-set! counts o (+ 1 (hash-ref counts o 0)))) some)
    (filter (lambda (o)
              (let ((n (hash-ref counts o 0)))
                (if (> n 0) (hash-set! counts o (- n 1)))
                (= n 0)))
      objects)))
(define (keep-root-drawn! m)
  (set! root-model m)
  (set! root-drawn (model-objects m))
  (hash-remove! models (node-getroot)))

; A callback runs in the context and with the dictionaries in which it was made; its leftover operands are dropped.
(define (in-place p)
  (let ((context (node-current)) (begun dictionaries))
    (lambda ()
      (let ((outer dictionaries) (outer-leave leave) (bottom depth))
        (dynamic-wind
          (lambda () (set! dictionaries begun) (set! leave #f))
          (lambda ()
            (with-node context
              (if (eq? context (node-getroot))
                  (with-root-model (lambda () (execute p)))
                  (begin (execute p) (keep-drawing context)))))
          (lambda () (set! dictionaries outer) (set! leave outer-leave)))
        (let drop () (if (> depth bottom) (begin (pop) (drop))))))))

; model sliders number { place number } { before } { clicked } GIZMOS.gizmo-trigger: appends a dictionary to the array
; sliders; its gizmo-create makes the trigger below the model.
(define (gizmo-trigger)
  (need 'gizmo-trigger 6)
  (let* ((clicked (pop)) (before (pop)) (place (pop)) (number (pop)) (sliders (pop)) (model (pop)))
    (need-scene-node 'gizmo-trigger model)
    (need-array 'gizmo-trigger sliders)
    (for-each (lambda (p) (need-procedure 'gizmo-trigger p)) (list place before clicked))
    (let ((call (in-place clicked)) (prepare (in-place before)))
      (array-append! sliders
        (dictionary-of
          'gizmo-create
          (lambda ()
            (execute place)
            (let* ((top (gml:pop 'gizmo-trigger)) (at (if (number? top) (gml:pop 'gizmo-trigger) top)))
              (need-vector 'gizmo-trigger at)
              (make-trigger at (lambda (node) (prepare) (call)) #:parent model)))
          'gizmo-activate (lambda () #t))))))

; offset constraint size create-manipulator: makes a node with a tripod beside it. Its entry `trans` is a node that
; follows the tripod's drags.
(define (create-manipulator who flat?)
  (need who 3)
  (let* ((size (pop)) (constraint (pop)) (offset (pop)))
    (need-number who size)
    (need-vector who constraint)
    (need-vector who offset)
    (let* ((node (node-create)) (trans (node-create #:parent node))
           (room (vxyz (cx constraint) (cy constraint) (if flat? 0 (cz constraint))))
           (tripod (make-tripod offset room #:size (inexact size) #:parent node)))
      (property-subscribe (property-ref tripod 'value) (lambda (v) (node-translate trans v)))
      (property-put! node 'trans trans)
      (property-put! node 'tripod tripod)
      (gml:push node))))
(define (manipulator who)
  (let ((n (gml:pop who)))
    (need-scene-node who n)
    (if (eq? (entry n 'tripod) gml:unset) (error who "the node is no manipulator"))
    n))
(define (manipulator-set who)
  (lambda ()
    (need who 2)
    (let* ((v (pop)) (n (manipulator who)))
      (property-set! (property-ref (property-get n 'tripod) 'value) (as-gvector who v)))))
(define (manipulator-get who)
  (lambda () (gml:push (gvector->point (property-get (property-get (manipulator who) 'tripod) 'value)))))

(hash-set! operators 'GIZMOS (dictionary-of 'gizmo-trigger gizmo-trigger))
(define tools
  (dictionary-of
    'create-manipulator (lambda () (create-manipulator 'create-manipulator #f))
    'create-manip-XY (lambda () (create-manipulator 'create-manip-XY #t))
    'manip-translate (manipulator-set 'manip-translate) 'manip-set-translate (manipulator-set 'manip-set-translate)
    'manip-gettranslate (manipulator-get 'manip-gettranslate) 'manip-get-translate
      (manipulator-get 'manip-get-translate)))
(hash-set! operators 'GrimaldoDemos (dictionary-of 'Tools tools))

; The end of a file: open contexts keep their models, and the root's model is drawn.
(define (gml:finish)
  (let unwind ()
    (if (not (eq? (node-current) (node-getroot))) (begin (keep-drawing (node-current)) (node-end) (unwind))))
  (let ((m (hash-ref models (node-getroot) #f)))
    (if m (begin (keep-root-drawn! m) (if (pair? root-drawn) (apply draw root-drawn))))))
