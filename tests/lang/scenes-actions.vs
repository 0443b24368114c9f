; Actions in their order, picking, programs of a node's own.
(define (show . items) (for-each display items) (newline))
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (show (condition/report-string c)))) e (show "no error")))))
(define root (node-getroot))
(define told '())
(define (tell . what) (set! told (cons what told)))
(define (told!) (let ((l (reverse told))) (set! told '()) l))
(define (watched name parent . actions)
  (let ((n (node-create #:name name #:parent parent)))
    (for-each (lambda (action) (node-on n action (lambda (node . rest) (tell action (node-getname node) rest)))) actions)
    n))
(define a (watched "a" root 'update 'draw 'finish 'paint))
(define b (watched "b" a 'update 'finish))
(define c (watched "c" root 'draw 'update))
(node-frame 0.5)
(show (told!)) ; expect: ((update a (0.5)) (update b (0.5)) (update c (0.5)) (draw a (0.5)) (draw c (0.5)) (finish a (0.5)) (finish b (0.5)))
(action-apply 'paint root 'red 2)
(show (told!)) ; expect: ((paint a (red 2)))
(node-on a 'paint #f)
(action-apply 'paint root)
(show (told!)) ; expect: ()
(fails (action-apply "paint" root))      ; expect: action-apply: action must be a symbol, got "paint"
(fails (node-on a 'paint 3))             ; expect: node-on: handler must be a procedure, got 3
(fails (node-frame 'soon))               ; expect: node-frame: seconds must be a number of 0 or more, got soon
; a node that a procedure takes away is not come to
(node-on a 'sweep (lambda (node) (node-removechildren node)))
(node-on b 'sweep (lambda (node) (tell 'b)))
(action-apply 'sweep root)
(show (told!)) ; expect: ()

; picking: nearest first, through frames; the bore of a drilled block lets the ray through
(node-clear)
(define block (subtract (make-box (xyz -1 -1 -1) (xyz 1 1 1)) (make-cylinder (xyz 0 0 -2) 4 0.5)))
(define low (node-create #:name "low" #:parent root #:drawing block))
(define high (node-create #:name "high" #:parent low #:drawing block #:translate (vxyz 0 0 10) #:rotate (vxyz 0 0 45) #:scale 2))
(define (names hits) (map (lambda (h) (node-getname (data-ref h 'node))) hits))
(define (distances hits) (map (lambda (h) (/ (round (* 1e6 (data-ref h 'distance))) 1e6)) hits))
(define down (vxyz 0 0 -3))
(show (names (node-intersect (xyz 0 0 30) down)))                     ; expect: ()
(show (names (node-intersect (xyz 0.9 0 30) down)))                   ; expect: (low)
(show (names (node-intersect (xyz 0.9 0.9 30) down)))                 ; expect: (high low)
(show (distances (node-intersect (xyz 0.9 0.9 30) down)))             ; expect: (18.0 29.0)
(show (names (node-intersect (xyz 2.5 0 30) down)))                   ; expect: (high)
(show (names (node-intersect (xyz 0.9 0.9 30) down high)))            ; expect: (high)
(show (names (node-intersect (xyz 0.9 0.9 30) (vxyz 0 0 1))))         ; expect: ()
(show (map node-getname (data-ref (first (node-intersect (xyz 0.9 0.9 30) down)) 'path))) ; expect: (root low high)
(show (cddr (data-ref (first (node-intersect (xyz 0.9 0 30) down)) 'place)) (data-ref (first (node-intersect (xyz 0.9 0 30) down)) 'point)) ; expect: (25)(xyz 0.9 0 1)
(define chosen '())
(property-subscribe (property-ref (node-controller) 'Node.selected) (lambda (node) (set! chosen (cons (node-getname node) chosen))))
(node-pick (xyz 0.9 0.9 30) down)
(node-pick (xyz 50 0 30) down)
(show chosen)                                                         ; expect: (high)
(define sheet (node-create #:parent root #:name "sheet" #:translate (vxyz 20 0 0)
                           #:drawing (make-surface (lambda (u v) (xyz u v 0)) 0 1 0 1 #:nu 2 #:nv 2)))
(show (names (node-intersect (xyz 20.3 0.3 5) down)) (names (node-intersect (xyz 20.3 0.3 -5) (vxyz 0 0 1)))) ; expect: (sheet)(sheet)
; a node of a host's that shows no drawing says where it is met; of a drawing and that, the nearer counts
(define bare (node-create #:parent root #:name "bare"))
(node-on bare 'intersect (lambda (node from direction) (tell (node-getname node) from direction) (and (= (cx from) 60) (- (cz from) 2))))
(show (names (node-intersect (xyz 60 0 5) down)) (distances (node-pick (xyz 60 0 5) down)) chosen) ; expect: (bare)(3.0)(bare high)
(show (first (told!)))                                                ; expect: (bare (xyz 60 0 5) (vxyz 0 0 -1))
(show (data-ref (first (node-intersect (xyz 60 0 5) down)) 'point) (data-ref (first (node-intersect (xyz 60 0 5) down)) 'place)) ; expect: (xyz 60 0 2)#f
(node-setdrawing bare (make-box (xyz 59 -1 2.5) (xyz 61 1 4)))
(show (distances (node-intersect (xyz 60 0 5) down)) (names (node-intersect (xyz 60.5 0 5) down bare))) ; expect: (1.0)(bare)
(node-on bare 'intersect (lambda (node from direction) -1))
(fails (node-intersect (xyz 60 0 5) down bare))                       ; expect: node-intersect: the procedure of #<node name="bare" type=context> for the action intersect must give a distance from 0 on or #f, got -1
(node-on bare 'intersect #f)
(told!)
(fails (node-intersect origin 'z))                                    ; expect: node-intersect: direction must be a gvector longer than 0, got z
(fails (node-pick 3 down))                                            ; expect: node-pick: from must be a point of finite coordinates, got 3

; programs of their own
(define table (node-create))
(define chair (node-create))
(node-eval table '(define height 0.75))
(node-eval chair '(define height 0.45))
(node-eval chair '(draw (make-box origin (xyz 1 1 height))))
(show (node-ref table 'height) (node-ref chair 'height))              ; expect: 0.750.45
(show (volume (node-object chair)) (length (node-getdrawing root)))   ; expect: 0.450
(node-eval chair '(define (car x) 'mine))
(show (node-eval chair '(car 1)) (car '(ours)))                       ; expect: mineours
(fails (node-ref table 'width))                                       ; expect: node-ref: the program of #<node name=#f type=context> defines no width
(fails (node-eval table '(draw 5)))                                   ; expect: draw: objects must be an object or a list of objects, got 5
(show (eq? (node-current) root))                                      ; expect: #t
(fails (node-eval 3 1))                                               ; expect: node-eval: node must be a node, got 3
