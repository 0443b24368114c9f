; Nodes: a tree that changes, beside the immutable tree of the drawing. A node has a frame (move, turn, scale) in its
; parent's, its own drawing, children, and properties. Nodes below the root are part of the model. After properties.scm;
; names that begin with % are hidden from programs. Compiled into the binary when it is built.
;
; A node with several places shares its drawing's objects, which are stored once. The picture of a node is one object.
; It is kept until the node or a node below it changes: a change makes only the pictures of the nodes above it anew.

(define-record-type %node (%make-node name type %parent %children %translate %rotate %scale %drawing %table %shown %actions %program %gizmo) node?
  (name %node-name %set-node-name!)
  (type %node-type)
  (%parent %node-parent %set-node-parent!)       ; a node or #f
  (%children %node-children)                     ; a table of nodes, in order
  (%translate %node-translation %set-node-translation!)
  (%rotate %node-rotation %set-node-rotation!)   ; degrees about X, then Y, then Z
  (%scale %node-scaling %set-node-scaling!)
  (%drawing %node-drawing %set-node-drawing!)    ; a list of objects; out of date while the node has the focus
  (%table %node-table)                           ; its properties
  (%shown %node-shown %set-node-shown!)          ; its picture in the parent's frame; if #f, so are those above
  (%actions %node-actions %set-node-actions!)    ; a table from an action to the procedure for it, or #f
  (%program %node-program %set-node-program!)    ; the environment of its own program, or #f
  (%gizmo %node-gizmo %set-node-gizmo!))         ; its handles if it is a gizmo, otherwise #f

(define %zero (vxyz 0 0 0))
(define %one (vxyz 1 1 1))

; ---- the controller: one for each interpreter, made at its first use ----

(define-record-type %controller (%make-controller root %focus %properties %types) %controller?
  (root %controller-root)
  (%focus %controller-focus %set-controller-focus!) ; nodes, the innermost first; the last is the root
  (%properties %controller-properties)
  (%types %controller-types))                       ; name of a type -> procedure that prepares a new node

(define %the-controller #f)
(define %events '(Node.create Node.addChild Node.removeChild Node.removeChildren Node.begin Node.end Node.selected))

(define (node-controller)
  (or %the-controller
      (let* ((root (%new-node "root" 'context)) (c (%make-controller root (list root) (make-hasheq) (make-hasheq))))
        (for-each (lambda (name) (hash-set! (%controller-properties c) name (%make-property name #f #f #f (make-hasheqv)))) %events)
        (hash-set! (%controller-types c) 'context (lambda (node) node))
        (set! %the-controller c)
        (%host-set! 4 %scene-objects)
        c)))

(define (%event? p) (and (memq (%property-name p) %events) (eq? p (hash-ref (%controller-properties (node-controller)) (%property-name p) #f))))

; An event is a property of the controller: its value is the node of the event, and setting the same node again is an
; event, too.
(define (%emit name node)
  (let ((p (hash-ref (%controller-properties (node-controller)) name #f)))
    (%set-property-value! p node)
    (%notify p)))

(define (%root) (%controller-root (node-controller)))
(define (%focus) (car (%controller-focus (node-controller))))

(define (node-getroot) (%root))
(define (node-current) (%focus))

; ---- arguments ----

(define (%need-node who what x) (if (not (node? x)) (error who "~a must be a node, got ~s" what x)))

; Returns a gvector of finite coordinates; accepts a point, too.
(define (%need-place who what x)
  (if (not (and (or (gvector? x) (point? x)) (finite? (cx x)) (finite? (cy x)) (finite? (cz x))))
      (error who "~a must be a gvector of finite coordinates, got ~s" what x))
  (vxyz (cx x) (cy x) (cz x)))

(define (%need-factors who what x)
  (let ((v (if (and (real? x) (finite? x)) (vxyz x x x) (%need-place who what x))))
    (if (or (= (cx v) 0) (= (cy v) 0) (= (cz v) 0))
        (error who "~a must not be 0 along any axis, got ~s" what x))
    v))

(define (%need-objects who what x)
  (cond
    ((object? x) (list x))
    ((and (list? x) (every object? x)) x)
    (else (error who "~a must be an object or a list of objects, got ~s" what x))))

(define (%not-root who node)
  (if (eq? node (%root)) (error who "the root stands where the world is: it has no place in another frame")))

; ---- making ----

(define (%new-node name type)
  (%make-node name type #f (make-hasheq) %zero %zero %one '() (make-hasheq) #f #f #f #f))

(define (node-create [type any? 'context] #:name [name any? #f] #:drawing [drawing any? '()] #:parent [parent any? #f]
                     #:translate [translate any? #f] #:rotate [rotate any? #f] #:scale [scale any? #f])
  (let* ((types (%controller-types (node-controller))) (make (hash-ref types type #f)))
    (if (not make) (error 'node-create "type must be one of ~s, got ~s" (hash-keys types) type))
    (if name (%need-string 'node-create name))
    (if parent (%need-node 'node-create 'parent parent))
    (let* ((objects (%need-objects 'node-create 'drawing drawing))
           (translate (if translate (%need-place 'node-create 'translate translate) %zero))
           (rotate (if rotate (%need-place 'node-create 'rotate rotate) %zero))
           (scale (if scale (%need-factors 'node-create 'scale scale) %one))
           (node (%make-node name type #f (make-hasheq) translate rotate scale objects (make-hasheq) #f #f #f #f)))
      (make node)
      (%emit 'Node.create node)
      (if parent (node-addchild parent node))
      node)))

; A type is a name for nodes with the same begin: the procedure gets each new node before the event is emitted.
(define (register-node-type name procedure)
  (%need-symbol 'register-node-type 'name name)
  (%need-procedure 'register-node-type 'procedure procedure)
  (if (eq? name 'context) (error 'register-node-type "the type context is the language's own"))
  (hash-set! (%controller-types (node-controller)) name procedure))

(define (node-type node) (%need-node 'node-type 'node node) (%node-type node))

; Removes every node below the root, and resets the root. Subscriptions and types stay.
(define (node-clear)
  (let* ((c (node-controller)) (root (%root)))
    (let unwind () (if (pair? (cdr (%controller-focus c))) (begin (%end-focus c) (unwind))))
    (%remove-children! root)
    (%drawing-swap! '() #f)
    (%set-node-drawing! root '())
    (%set-node-name! root "root")
    (for-each (lambda (name) (hash-remove! (%node-table root) name)) (hash-keys (%node-table root)))
    (%touch root)))

; ---- the tree ----

(define (%children node) (hash-keys (%node-children node)))

; Discards the picture of the node and of all nodes above it.
(define (%touch node)
  (let up ((n node))
    (if n
        (let ((known (%node-shown n)))
          (%set-node-shown! n #f)
          (if (or known (eq? n node)) (up (%node-parent n)))))))

(define (%hangs-below? node below)
  (let up ((n below)) (and n (or (eq? n node) (up (%node-parent n))))))

(define (node-addchild parent child)
  (%need-node 'node-addchild 'parent parent)
  (%need-node 'node-addchild 'child child)
  (if (eq? child (%root)) (error 'node-addchild "child is the root, which has no parent"))
  (if (or (eq? parent child) (and (> (hash-count (%node-children child)) 0) (%hangs-below? child parent)))
      (error 'node-addchild "child ~s holds parent ~s: a node cannot hang below itself" child parent))
  (if (%node-parent child) (%remove! (%node-parent child) child))
  (hash-set! (%node-children parent) child #t)
  (%set-node-parent! child parent)
  (%touch parent)
  (%emit 'Node.addChild child))

(define (%remove! parent child)
  (hash-remove! (%node-children parent) child)
  (%set-node-parent! child #f)
  (%touch parent)
  (%emit 'Node.removeChild child))

; child: a node, or its number from 0
(define (node-removechild parent child)
  (%need-node 'node-removechild 'parent parent)
  (let ((child (if (exact-integer? child) (%child 'node-removechild parent child) child)))
    (%need-node 'node-removechild 'child child)
    (cond
      ((not (%node-parent child)) (error 'node-removechild "child ~s hangs below no node" child))
      ((not (eq? (%node-parent child) parent)) (error 'node-removechild "child ~s hangs below another node: ~s" child (%node-parent child))))
    (%remove! parent child)))

(define (%remove-children! node)
  (let ((children (%children node)))
    (for-each (lambda (child) (hash-remove! (%node-children node) child) (%set-node-parent! child #f)) children)
    (%touch node)
    (if (pair? children) (%emit 'Node.removeChildren node))))

(define (node-removechildren node)
  (%need-node 'node-removechildren 'node node)
  (%remove-children! node))

(define (%child who node index)
  (let ((count (hash-count (%node-children node))))
    (cond
      ((not (and (exact-integer? index) (>= index 0))) (error who "index must be an exact integer from 0 on, got ~s" index))
      ((= count 0) (error who "~s has no children" node))
      ((>= index count) (error who "index must be from 0 to ~a, got ~a" (- count 1) index)))
    (list-ref (%children node) index)))

(define (node-getchild node index) (%need-node 'node-getchild 'node node) (%child 'node-getchild node index))
(define (node-getchildren node) (%need-node 'node-getchildren 'node node) (%children node))
(define (node-getparent node) (%need-node 'node-getparent 'node node) (%node-parent node))

; Visits the nodes from this one on, parents before their children, in the children's order. A procedure that changes
; the tree affects only the nodes that are not visited yet.
(define (%walk node visit)
  (let loop ((rest (list node)))
    (if (pair? rest)
        (begin
          (visit (car rest))
          (loop (append (%children (car rest)) (cdr rest)))))))

(define (node-find name #:from [from any? #f])
  (%need-string 'node-find name)
  (if from (%need-node 'node-find 'from from))
  (call/ec (lambda (return)
    (%walk (or from (%root)) (lambda (n) (if (equal? (%node-name n) name) (return n))))
    #f)))

(define (node-setname node name)
  (%need-node 'node-setname 'node node)
  (if (not (string? name)) (error 'node-setname "name must be a string, got ~s" name))
  (%set-node-name! node name))
(define (node-getname node) (%need-node 'node-getname 'node node) (%node-name node))

; ---- frames ----

(define (node-translate node v)
  (%need-node 'node-translate 'node node)
  (%not-root 'node-translate node)
  (%set-node-translation! node (%need-place 'node-translate 'v v))
  (%touch node))
(define (node-rotate node degrees)
  (%need-node 'node-rotate 'node node)
  (%not-root 'node-rotate node)
  (%set-node-rotation! node (%need-place 'node-rotate 'degrees degrees))
  (%touch node))
(define (node-scale node factors)
  (%need-node 'node-scale 'node node)
  (%not-root 'node-scale node)
  (%set-node-scaling! node (%need-factors 'node-scale 'factors factors))
  (%touch node))

(define (node-gettranslate node) (%need-node 'node-gettranslate 'node node) (%node-translation node))
(define (node-getrotate node) (%need-node 'node-getrotate 'node node) (%node-rotation node))
(define (node-getscale node) (%need-node 'node-getscale 'node node) (%node-scaling node))

(define (%frame node) (%node-matrix (%node-translation node) (%node-rotation node) (%node-scaling node)))
(define (%unmoved? node)
  (and (equal? (%node-translation node) %zero) (equal? (%node-rotation node) %zero) (equal? (%node-scaling node) %one)))

; A gvector moves, as node-translate does; a matrix is split into a scale, a turn and a move.
(define (node-transform node frame)
  (%need-node 'node-transform 'node node)
  (%not-root 'node-transform node)
  (if (matrix? frame)
      (let ((parts (%matrix-parts frame)))
        (if (not parts) (error 'node-transform "frame must be made of a scale, a turn and a move, without a shear, got ~s" frame))
        (%set-node-translation! node (first parts))
        (%set-node-rotation! node (second parts))
        (%set-node-scaling! node (third parts)))
      (%set-node-translation! node (%need-place 'node-transform 'frame frame)))
  (%touch node))

(define (node-gettransform node) (%need-node 'node-gettransform 'node node) (%frame node))

; Returns the matrix from the node's own coordinates to the world's, or to those of the top node above it.
(define (node-worldtransform node)
  (%need-node 'node-worldtransform 'node node)
  (let up ((n (%node-parent node)) (m (%frame node)))
    (if n (up (%node-parent n) (if (%unmoved? n) m (matrix* (%frame n) m))) m)))

; ---- drawings ----

(define (%own-drawing node) (if (eq? node (%focus)) (%drawing-list) (%node-drawing node)))

(define (node-setdrawing node drawing)
  (%need-node 'node-setdrawing 'node node)
  (let ((objects (%need-objects 'node-setdrawing 'drawing drawing)))
    (if (eq? node (%focus)) (pair? (%drawing-swap! objects (not (eq? node (%root)))))) ; the value of the old drawing is not needed
    (%set-node-drawing! node objects)
    (%touch node)))

; Returns the objects of the node alone, in its own frame.
(define (node-getdrawing node) (%need-node 'node-getdrawing 'node node) (%own-drawing node))

(define (%shown node)
  (or (%node-shown node)
      (let* ((parts (append (%own-drawing node) (map %shown (%children node))))
             (object (%one-object parts))
             (placed (if (or (%unmoved? node) (empty-object? object)) object (do-transform object (%frame node)))))
        (%set-node-shown! node placed)
        placed)))

(define (%one-object parts)
  (let ((parts (filter (lambda (o) (not (empty-object? o))) parts)))
    (cond ((null? parts) (unite)) ((null? (cdr parts)) (car parts)) (else (unite parts)))))

; Draws in the focus do not notify its node, so its picture is discarded first.
(define (node-object node)
  (%need-node 'node-object 'node node)
  (%touch (%focus))
  (%shown node))

; For C, when a drawing is handed over: returns (#t object ...) to show beside the drawing, or (#f object ...) to show
; instead of it if a node other than the root has the focus. The nodes drop the objects: an object that only nodes hold
; would count as shared, and would not be simplified.
(define (%scene-objects)
  (let ((root (%root)) (outside? (not (eq? (%focus) (%root)))))
    (%touch (%focus))
    (let ((objects (filter (lambda (o) (not (empty-object? o))) (map %shown (%children root)))))
      (%walk root (lambda (n) (%set-node-shown! n #f)))
      (cons (not outside?) (if outside? (append (%node-drawing root) objects) objects)))))

; ---- the focus: the node to whose drawing draw adds ----

; The drawing of the node with the focus is where draw puts objects; those of the others are in their nodes.
(define (%give-focus from to)
  (if (not (eq? from to))
      (begin
        (%set-node-drawing! from (%drawing-swap! (%node-drawing to) (not (eq? to (%root)))))
        (%touch from))))

(define (node-begin node)
  (%need-node 'node-begin 'node node)
  (let* ((c (node-controller)) (before (%focus)))
    (%set-controller-focus! c (cons node (%controller-focus c)))
    (%give-focus before node)
    (%emit 'Node.begin node)))

(define (%end-focus c)
  (let ((node (%focus)))
    (%set-controller-focus! c (cdr (%controller-focus c)))
    (%give-focus node (%focus))
    (%emit 'Node.end node)))

(define (node-end)
  (let ((c (node-controller)))
    (if (null? (cdr (%controller-focus c))) (error 'node-end "no node was begun: the root's focus cannot be ended"))
    (%end-focus c)))

(define-syntax with-node
  (syntax-rules ()
    ((_ node body ...) (%with-node node (lambda () body ... #f)))))

; Returns the node. Any exit from the body restores the focus; a body that is entered again gets it back.
(define (%with-node node body)
  (let ((outside #f) (inside #f) (c (node-controller)))
    (%need-node 'with-node 'node node)
    (dynamic-wind
      (lambda () (if inside (let ((before (%focus))) (%set-controller-focus! c inside) (%give-focus before (%focus)))
                     (begin (set! outside (%controller-focus c)) (node-begin node))))
      body
      (lambda ()
        (let ((before (%focus)))
          (set! inside (%controller-focus c))
          (%set-controller-focus! c outside)
          (%give-focus before (car outside))
          (%emit 'Node.end before))))
    node))
