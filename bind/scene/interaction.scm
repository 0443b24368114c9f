; Interaction: gizmos as data that a host draws, input events, and the procedures that a program registers for them.
; After contexts.scm. Names that begin with % are hidden from programs. Compiled into the binary when it is built.
;
; A gizmo is a node with handles instead of a drawing. It is no part of the model. Its value is its property `value`,
; which notifies its subscribers like any property. The movement of a handle is fixed when it is made: along a line,
; between two ends, in steps.

(define-record-type %gizmo (%make-gizmo kind at axes low high step size procedure) %gizmo?
  (kind %gizmo-kind)           ; trigger, slider, arrow or tripod
  (at %gizmo-at)               ; the place of value 0 (for a slider, of its least value), in the node's coordinates
  (axes %gizmo-axes)           ; the unit gvectors along which its handles move; none for a trigger
  (low %gizmo-low)             ; the least and the greatest value; for a tripod the largest move of one drag, a gvector
  (high %gizmo-high)
  (step %gizmo-step)           ; #f: any value
  (size %gizmo-size)           ; the size of a handle; also the length of an arrow's and a tripod's handle
  (procedure %gizmo-procedure)) ; called by a trigger

(define (%need-size who x)
  (if (not (and (real? x) (finite? x) (> x 0))) (error who "size must be a number above 0, got ~s" x)))
(define (%need-direction who what x)
  (if (not (and (gvector? x) (< 0 (vlength x) +inf.0)))
      (error who "~a must be a gvector longer than 0, got ~s" what x)))

(define (%new-gizmo who name parent gizmo value type [wanted any? #f])
  (if name (%need-string who name))
  (if parent (%need-node who 'parent parent))
  (let ((node (node-create #:name name #:parent parent)))
    (%set-node-gizmo! node gizmo)
    (property-add! node (%typed-property who 'value value type wanted))
    node))

; The type of a value within bounds, and its words for messages.
(define (%between low high [step any? #f])
  (lambda (v)
    (and (real? v) (<= low v high)
         (or (not step) (= v high)
             (let ((turns (/ (- v low) step))) (<= (abs (- turns (round turns))) 1e-9))))))
(define (%between-words low high [step any? #f])
  (string-append (format "be from ~a to ~a" low high) (if step (format " by steps of ~a" step) "")))

(define (make-trigger at procedure #:size [size any? 0.2] #:name [name any? #f] #:parent [parent any? #f])
  (%need-point 'make-trigger 'at at)
  (%need-procedure 'make-trigger 'procedure procedure)
  (%need-size 'make-trigger size)
  (%new-gizmo 'make-trigger name parent (%make-gizmo 'trigger at '() #f #f #f size procedure) 0 number?))

(define (make-slider from to low high #:value [value any? #f] #:step [step any? #f] #:size [size any? 0.2]
                     #:name [name any? #f] #:parent [parent any? #f])
  (%need-point 'make-slider 'from from)
  (%need-point 'make-slider 'to to)
  (if (equal? from to) (error 'make-slider "to must be another point than from, got ~s" to))
  (%need-number 'make-slider 'low low)
  (%need-number 'make-slider 'high high)
  (if (>= low high) (error 'make-slider "high must be above low, got ~s" high))
  (if step (begin (%need-number 'make-slider 'step step)
             (if (<= step 0) (error 'make-slider "step must be above 0, got ~s" step))))
  (%need-size 'make-slider size)
  (let ((value (or value low)))
    (%need-number 'make-slider 'value value)
    (if (not (<= low value high)) (error 'make-slider "value must be from ~s to ~s, got ~s" low high value))
    (%new-gizmo 'make-slider name parent
      (%make-gizmo 'slider from (list (p-p to from)) low high step size #f) value
      (%between low high step) (%between-words low high step))))

(define (make-arrow at direction low high #:value [value any? 0] #:size [size any? 1] #:name [name any? #f]
                    #:parent [parent any? #f])
  (%need-point 'make-arrow 'at at)
  (%need-direction 'make-arrow 'direction direction)
  (%need-number 'make-arrow 'low low)
  (%need-number 'make-arrow 'high high)
  (%need-number 'make-arrow 'value value)
  (if (not (<= low value high)) (error 'make-arrow "value must be from ~s to ~s, got ~s" low high value))
  (%need-size 'make-arrow size)
  (%new-gizmo 'make-arrow name parent
    (%make-gizmo 'arrow at (list (unitize direction)) low high #f size #f) value (%between low high)
    (%between-words low high)))

; Three arrows along X, Y and Z; the value is a gvector. constraint: the largest move of one drag along each axis, in
; either direction; 0 removes the arrow.
(define (make-tripod at constraint #:size [size any? 1] #:name [name any? #f] #:parent [parent any? #f])
  (%need-point 'make-tripod 'at at)
  (if (not (and (gvector? constraint) (>= (cx constraint) 0) (>= (cy constraint) 0) (>= (cz constraint) 0)))
      (error 'make-tripod "constraint must be a gvector of numbers from 0, got ~s" constraint))
  (%need-size 'make-tripod size)
  (%new-gizmo 'make-tripod name parent
    (%make-gizmo 'tripod at (list ux uy uz) constraint constraint #f size #f) %zero gvector?))

(define (gizmo? x) (and (node? x) (%node-gizmo x) #t))
(define (%need-gizmo who x) (if (not (gizmo? x)) (error who "gizmo must be a gizmo, got ~s" x)))

; ---- the places of the handles ----

(define (%axis-parts v) (list (cx v) (cy v) (cz v)))

; Returns lists (axis point) in the node's coordinates: the number of an axis, and the place of the handle that moves
; along it. A trigger's axis is #f.
(define (%handles node g)
  (let ((value (property-get node 'value)) (at (%gizmo-at g)) (axes (%gizmo-axes g)))
    (case (%gizmo-kind g)
      ((trigger) (list (list #f at)))
      ((slider)
       (let ((t (/ (- value (%gizmo-low g)) (- (%gizmo-high g) (%gizmo-low g)))))
         (list (list 0 (p+v at (v*r (car axes) t))))))
      ((arrow) (list (list 0 (p+v at (v*r (car axes) (+ value (%gizmo-size g)))))))
      (else
        (let ((here (p+v at value)))
          (filter-map
            (lambda (axis i room) (and (> room 0) (list i (p+v here (v*r axis (%gizmo-size g))))))
            axes '(0 1 2) (%axis-parts (%gizmo-high g))))))))

; Returns the values that a host draws: a row for data-ref, points in the world's coordinates.
(define (gizmo-data gizmo)
  (%need-gizmo 'gizmo-data gizmo)
  (let* ((g (%node-gizmo gizmo)) (world (node-worldtransform gizmo)) (place (lambda (p) (%matrix-point world p))))
    (list (cons 'kind (%gizmo-kind g))
          (cons 'value (property-get gizmo 'value))
          (cons 'low (%gizmo-low g))
          (cons 'high (%gizmo-high g))
          (cons 'step (%gizmo-step g))
          (cons 'size (%gizmo-size g))
          (cons 'at (place (%gizmo-at g)))
          (cons 'handles (map (lambda (h) (place (cadr h))) (%handles gizmo g)))
          (cons 'axes (filter-map (lambda (h) (and (car h) (%axis-in world g (car h)))) (%handles gizmo g))))))

; The vector of a handle in the world: for a slider from its least value to its greatest; for others for a value greater
; by 1.
(define (%axis-in world g i)
  (let ((at (%gizmo-at g)))
    (p-p (%matrix-point world (p+v at (list-ref (%gizmo-axes g) i))) (%matrix-point world at))))

; For the host: rows of node, kind, value, low, high, step, size, at, handles, axes.
(define (%gizmos-for-host)
  (map (lambda (n) (cons n (map cdr (gizmo-data n)))) (scene-gizmos)))

; Returns all gizmos below the root, or below another node, parents before children.
(define (scene-gizmos [node any? #f])
  (if node (%need-node 'scene-gizmos 'node node))
  (let ((found '()))
    (%walk (or node (%root)) (lambda (n) (if (gizmo? n) (set! found (cons n found)))))
    (reverse found)))

; Gets and sets the values of all gizmos below the node, in their order. A missing value, or one that a gizmo would
; refuse, changes nothing.
(define (gizmo-values [node any? #f])
  (if node (%need-node 'gizmo-values 'node node))
  (map (lambda (n) (property-get n 'value)) (scene-gizmos node)))
(define (gizmo-values! values [node any? #f])
  (if (not (list? values)) (error 'gizmo-values! "values must be a list, got ~s" values))
  (if node (%need-node 'gizmo-values! 'node node))
  (let ((all (scene-gizmos node)))
    (if (not (= (length all) (length values)))
        (error 'gizmo-values! "there are ~a gizmos, got ~a values" (length all) (length values)))
    (for-each (lambda (n v) (property-set! (property-ref n 'value) v)) all values)))

; Returns two booleans for a host: whether it must run frames, since an action runs in each of them, and whether it must
; pass mouse input, since a node handles picks or other input. Gizmos need input as well: scene-gizmos lists them.
(define (scene-needs)
  (let ((frames (and %active-viewer #t)) (input #f))
    (define (has? known actions) (any (lambda (action) (hash-ref known action #f)) actions))
    (%walk (%root)
      (lambda (n)
        (let ((known (%node-actions n)))
          (if (and known (has? known %frame-actions)) (set! frames #t))
          (if (and known (has? known '(pick drag release input))) (set! input #t)))))
    (list frames input)))

; ---- hits on handles ----

; Returns the distance along the ray to a ball, or #f.
(define (%meets-ball from direction centre radius)
  (let* ((to (p-p centre from)) (along (dot to direction)) (away (- (dot to to) (* along along)))
         (room (- (* radius radius) away)))
    (and (>= room 0) (>= along 0) (max 0 (- along (sqrt room))))))

; Returns the nearest handle on the ray: (distance node axis), or #f.
(define (%gizmo-on from direction)
  (let ((best #f))
    (for-each
      (lambda (node)
        (let* ((g (%node-gizmo node)) (world (node-worldtransform node)) (radius (/ (%gizmo-size g) 2)))
          (for-each
            (lambda (h)
              (let ((d (%meets-ball from direction (%matrix-point world (cadr h)) radius)))
                (if (and d (or (not best) (< d (car best)))) (set! best (list d node (car h))))))
            (%handles node g))))
      (scene-gizmos))
    best))

; Returns the place of the line from p that is nearest to the ray, in lengths of v; #f if they are parallel.
(define (%along p v from direction)
  (let* ((w (p-p p from)) (a (dot v v)) (b (dot v direction)) (d (dot v w)) (e (dot direction w)) (below (- a (* b b))))
    (and (> below (* 1e-12 a)) (/ (- (* b e) d) below))))

; ---- dragging: the grabbed node gets all mouse input until the release ----

(define-record-type %hold (%make-hold node axis place line start value) %hold?
  (node %hold-node)
  (axis %hold-axis)     ; the axis of a gizmo; #f: a trigger, or a node of the model
  (place %hold-place)   ; the handle and its direction, in the world, when it was grabbed
  (line %hold-line)
  (start %hold-start)   ; the place on that line
  (value %hold-value))  ; the gizmo's value at that time
(define %held #f)

(define (%take-gizmo node axis from direction)
  (let ((g (%node-gizmo node)))
    (if (not axis)
        (%make-hold node #f #f #f #f #f)
        (let* ((world (node-worldtransform node)) (h (cadr (assv axis (%handles node g))))
               (a (list-ref (%gizmo-axes g) axis))
               (p (%matrix-point world h)) (line (p-p (%matrix-point world (p+v h a)) p)))
          (%make-hold node axis p line (or (%along p line from direction) 0) (property-get node 'value))))))

; Exact steps give exact values: a slider of storeys counts.
(define (%stepped g v)
  (let* ((step (%gizmo-step g)) (low (%gizmo-low g)) (high (%gizmo-high g))
         (v (if step (+ low (* step (exact (round (/ (- v low) step))))) v)))
    (cond ((<= v low) low) ((>= v high) high) (else v))))

(define (%drag-gizmo h from direction)
  (let* ((node (%hold-node h)) (g (%node-gizmo node)) (t (%along (%hold-place h) (%hold-line h) from direction)))
    (if t
        (let* ((moved (- t (%hold-start h))) (was (%hold-value h)))
          (property-set! (property-ref node 'value)
            (case (%gizmo-kind g)
              ((slider) (%stepped g (+ was (* moved (- (%gizmo-high g) (%gizmo-low g))))))
              ((arrow) (%stepped g (+ was moved)))
              (else
                (let* ((i (%hold-axis h)) (room (list-ref (%axis-parts (%gizmo-high g)) i)))
                  (v+v was (v*r (list-ref (%gizmo-axes g) i) (max (- room) (min room moved))))))))))))

; ---- input events ----

(define %input-kinds '(press drag release move key))
(define %input-buttons '(left middle right none))

; Returns the node that handled the event, or #f. A press grabs the nearest gizmo or node on the ray, which gets the
; drags and the release. A release over the pressed trigger calls its procedure. A key goes to the node that was
; selected last, or to the focus, or to the nearest node above it that has a procedure for `key`. Every node with a
; procedure for `input` gets all events.
(define (node-input kind [button any? 'left] [from any? #f] [direction any? #f] [key any? #f])
  (if (not (memq kind %input-kinds)) (error 'node-input "kind must be one of ~s, got ~s" %input-kinds kind))
  (if (not (memq button %input-buttons)) (error 'node-input "button must be one of ~s, got ~s" %input-buttons button))
  (if (or from direction (memq kind '(press drag release))) (%need-ray 'node-input from direction))
  (let ((way (and direction (unitize direction))))
    (%apply-action 'input (%root) (list kind button from way key))
    (case kind
      ((press) (%press from way))
      ((drag)
       (let ((h %held))
         (and h
              (begin
                (if (%hold-axis h) (%drag-gizmo h from way) (%call-action (%hold-node h) 'drag from way))
                (%hold-node h)))))
      ((release)
       (let ((h %held))
         (set! %held #f)
         (and h
              (let* ((node (%hold-node h)) (g (%node-gizmo node)) (over (and g (%gizmo-on from way))))
                (cond ((not g) (%call-action node 'release from way))
                      ((and (eq? (%gizmo-kind g) 'trigger) over (eq? (cadr over) node)) (%click node g)))
                node))))
      ((key) (%key key))
      (else #f))))

(define (%call-action node action . arguments)
  (let ((f (and (%node-actions node) (hash-ref (%node-actions node) action #f))))
    (if f (apply f node arguments))))

; A click changes the trigger's value, the count of clicks.
(define (%click node g)
  (property-set! (property-ref node 'value) (+ 1 (property-get node 'value)))
  ((%gizmo-procedure g) node))

(define (%press from way)
  (let* ((gizmo (%gizmo-on from way)) (hits (%picked from way (%root))))
    (set! %held
      (cond ((and gizmo (or (null? hits) (<= (car gizmo) (cdaar hits))))
             (%take-gizmo (cadr gizmo) (caddr gizmo) from way))
            ((pair? hits) (%make-hold (data-ref (car hits) 'node) #f #f #f #f #f))
            (else #f)))
    (if (and %held (not (gizmo? (%hold-node %held)))) (node-pick from way))
    (and %held (%hold-node %held))))

(define (%key key)
  (let up ((n (or (property-get (node-controller) 'Node.selected) (%focus))))
    (cond ((not n) #f)
          ((and (%node-actions n) (hash-ref (%node-actions n) 'key #f)) => (lambda (f) (f n key) n))
          (else (up (%node-parent n))))))

; ---- procedures that a program registers ----

; An object becomes the drawing of a new node below the focus; a node stays. The procedure gets the node and the hit.
(define (on-pick object procedure)
  (if (not (or (node? object) (object? object))) (error 'on-pick "object must be an object or a node, got ~s" object))
  (%need-procedure 'on-pick 'procedure procedure)
  (let ((node (if (node? object) object (node-create #:drawing object #:parent (%focus)))))
    (node-on node 'pick procedure)
    node))

; The procedure gets the seconds since the last frame. It belongs to a new node; removing the node ends the calls.
(define (every-frame procedure)
  (%need-procedure 'every-frame 'procedure procedure)
  (let ((node (node-create #:parent (%root))))
    (node-on node 'update (lambda (n seconds) (procedure seconds)))
    node))

; ---- viewers: they show the scene; each has a name, and one is active ----

(define-record-type %viewer (%make-viewer name show hide prepare draw finish) %viewer?
  (name %viewer-name) (show %viewer-show) (hide %viewer-hide) (prepare %viewer-prepare) (draw %viewer-draw)
    (finish %viewer-finish))
(define %viewers (make-hasheq))
(define %active-viewer #f)

(define (register-viewer name #:show [show any? #f] #:hide [hide any? #f] #:prepare [prepare any? #f] #:draw
          [draw any? #f]
                         #:finish [finish any? #f])
  (%need-symbol 'register-viewer 'name name)
  (for-each (lambda (what f) (if f (%need-procedure 'register-viewer what f)))
    '(#:show #:hide #:prepare #:draw #:finish) (list show hide prepare draw finish))
  (hash-set! %viewers name (%make-viewer name show hide prepare draw finish)))

; #f: no viewer.
(define (viewer-activate name)
  (let ((next (and name (hash-ref %viewers name #f))))
    (if (and name (not next)) (error 'viewer-activate "name must be one of ~s, got ~s" (hash-keys %viewers) name))
    (if (not (eq? next %active-viewer))
        (begin
          (if (and %active-viewer (%viewer-hide %active-viewer)) ((%viewer-hide %active-viewer)))
          (set! %active-viewer next)
          (if (and next (%viewer-show next)) ((%viewer-show next)))))))
(define (viewer-current) (and %active-viewer (%viewer-name %active-viewer)))

(define (%viewer-frame part seconds)
  (let ((f (and %active-viewer (part %active-viewer)))) (if f (f seconds))))

; ---- detail and culling ----

; The fineness for a host's drawing, from 0.1 to 1. Each frame longer than 1/20 s makes it coarser, each shorter than
; 1/40 s finer. #f: no program has asked.
(define %quality #f)
(define (scene-quality)
  (or %quality
      (begin
        (set! %quality (%typed-property 'scene-quality 'quality 1.0 (%between 0.1 1.0) (%between-words 0.1 1.0)))
        (property-add! (node-controller) %quality)
        %quality)))

(define (%adapt-quality seconds)
  (if (and %quality (> seconds 0))
      (let ((q (property-value %quality)))
        (cond ((> seconds 1/20) (property-set! %quality (max 0.1 (* 0.8 q))))
              ((< seconds 1/40) (property-set! %quality (min 1.0 (* 1.25 q))))))))

; Returns true if the ball meets the cone of half the angle about the direction, a unit gvector, from eye.
(define (%in-cone? centre radius eye direction half)
  (let* ((w (p-p centre eye)) (along (dot w direction)) (across (sqrt (max 0 (- (dot w w) (* along along))))))
    (if (>= (+ (* along (cos half)) (* across (sin half))) 0)
        (<= (- (* across (cos half)) (* along (sin half))) radius)
        (<= (vlength w) radius))))

; Returns the nodes whose own drawing a camera of that angle, across corners, may see: the ball around their bounds
; meets its cone.
(define (node-visible eye direction angle [node any? #f])
  (%need-ray 'node-visible eye direction)
  (if (not (and (real? angle) (< 0 angle pi)))
      (error 'node-visible "angle must be a number above 0 and below pi, got ~s" angle))
  (if node (%need-node 'node-visible 'node node))
  (let ((way (unitize direction)) (found '()))
    (%walk (or node (%root))
      (lambda (n)
        (let* ((own (%one-object (%own-drawing n))) (box (bounding-box (do-transform own (node-worldtransform n)))))
          (if box
              (let ((a (first box)) (b (second box)))
                (if (%in-cone? (mid a b) (/ (distance a b) 2) eye way (/ angle 2)) (set! found (cons n found))))))))
    (reverse found)))
