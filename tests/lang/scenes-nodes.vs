; Nodes: the tree, frames, drawings, the focus, and what a scene shows.
(define (show . items) (for-each display items) (newline))
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (show (condition/report-string c)))) e (show "no error")))))
(define (place node) (let ((m (node-worldtransform node))) (bounding-box (do-transform (make-box origin (xyz 1 1 1)) m))))
(define cube (make-box origin (xyz 1 1 1)))
(define root (node-getroot))

; the spiral of the first example: each click hangs a part below the last
(define phase 0)
(define active (node-create #:parent root))
(define spiral '())
(define (click)
  (define node (node-create #:drawing cube))
  (define a (degrees->radians phase))
  (node-translate node (vxyz (sin a) (cos a) 1))
  (node-addchild active node)
  (set! active node)
  (set! phase (+ phase 25))
  (set! spiral (cons (car (place node)) spiral)))
(click) (click) (click)
(show (near? (reverse spiral) (list (xyz 0 1 1) (xyz 0.4226 1.9063 2) (xyz 1.1887 2.5491 3)) 5e-5)) ; expect: #t
(show (volume (node-object root)))                                  ; expect: 3.0

; moving a child takes it from where it hung, and all above show it
(node-clear)
(show (node-getchildren root))                                      ; expect: ()
(define a (node-create #:name "a" #:parent root))
(define b (node-create #:name "b" #:parent root #:translate (vxyz 5 0 0)))
(define c (node-create #:name "c" #:parent a #:drawing cube))
(show (bounding-box (node-object root)))                            ; expect: ((xyz 0 0 0) (xyz 1 1 1))
(node-addchild b c)
(show (bounding-box (node-object root)))                            ; expect: ((xyz 5 0 0) (xyz 6 1 1))
(show (map node-getchildren (list a b)))                            ; expect: (() (#<node name=c type=context>))
(node-translate c (vxyz 0 0 2))
(show (bounding-box (node-object root)))                            ; expect: ((xyz 5 0 2) (xyz 6 1 3))
(show (eq? (node-object b) (node-object b)))                        ; expect: #t
(node-removechild b 0)
(show (empty-object? (node-object root)))                           ; expect: #t
(node-translate c (vxyz 0 0 3))
(node-addchild a c)
(show (bounding-box (node-object root)))                            ; expect: ((xyz 0 0 3) (xyz 1 1 4))
(show (eq? (node-find "c") c) (node-find "d"))                      ; expect: #t#f
(show (eq? (node-find "c" #:from a) c) (node-find "c" #:from b))    ; expect: #t#f

; about X first, then Y, then Z; quarter turns are exact
(define n (node-create #:drawing (make-box origin (xyz 1 2 3))))
(node-rotate n (vxyz 90 0 0))
(show (bounding-box (node-object n)))                               ; expect: ((xyz 0 -3 0) (xyz 1 0 2))
(node-rotate n (vxyz 90 90 0))
(show (bounding-box (node-object n)))                               ; expect: ((xyz 0 -3 -1) (xyz 2 0 0))
(node-rotate n (vxyz -270 450 360))
(show (bounding-box (node-object n)))                               ; expect: ((xyz 0 -3 -1) (xyz 2 0 0))
(define (again node) (let ((m (node-create))) (node-transform m (node-gettransform node)) m))
(show (map (lambda (r) (node-rotate n r) (near? (node-gettransform (again n)) (node-gettransform n)))
                (list (vxyz 10 20 30) (vxyz -100 80 170) (vxyz 30 90 20) (vxyz 30 -90 20) (vxyz 0 0 180)))) ; expect: (#t #t #t #t #t)
(node-scale n (vxyz 2 -1 1))
(show (near? (node-gettransform (again n)) (node-gettransform n)))  ; expect: #t
(node-rotate n (vxyz 0 0 0))
(show (bounding-box (node-object n)))                               ; expect: ((xyz 0 -2 0) (xyz 2 0 3))

; the focus: draw and erase-all are its node's
(node-begin a)
(draw cube)
(show (length (node-getdrawing a)) (length (node-getdrawing root))) ; expect: 10
(node-begin b)
(draw cube) (draw cube)                                                  ; expect warning: drawn already
(node-begin a)
(show (length (node-getdrawing a)) (length (node-getdrawing b)))    ; expect: 12
(erase-all)
(node-end)
(show (eq? (node-current) b) (length (node-getdrawing b)))          ; expect: #t2
(node-end)
(show (length (node-getdrawing a)))                                 ; expect: 0
(node-setdrawing a (list cube cube))
(show (length (node-getdrawing a)))                                 ; expect: 2
(node-end)
(show (length (node-getdrawing a)) (eq? (node-current) root))       ; expect: 2#t
(fails (node-end))                                                       ; expect: node-end: no node was begun: the root's focus cannot be ended
; an error in the body of with-node ends its focus
(fails (with-node a (draw cube) (car 5)))                                ; expect: car: expected a pair, got 5
(show (eq? (node-current) root) (length (node-getdrawing a)))       ; expect: #t3
(show (eq? (with-node a (erase-all)) a) (node-getdrawing a))        ; expect: #t()
; a continuation into the body brings its focus back
(define k #f)
(define turns 0)
(with-node b (erase-all) (call/cc (lambda (here) (set! k here))) (draw cube))
(show (length (node-getdrawing b)) (eq? (node-current) root))       ; expect: 1#t
(set! turns (+ turns 1))
(if (< turns 2) (k #f))                                                  ; expect: 2#t
(show (length (node-getdrawing b)))                                 ; expect: 2
(node-begin a)
(node-clear)
(show (eq? (node-current) root) (node-getname root))                ; expect: #troot

; errors say what is wrong
(fails (node-addchild a a))               ; expect: node-addchild: child #<node name="a" type=context> holds parent #<node name="a" type=context>: a node cannot hang below itself
(node-addchild a b) (node-addchild b c)
(fails (node-addchild c a))               ; expect: node-addchild: child #<node name="a" type=context> holds parent #<node name="c" type=context>: a node cannot hang below itself
(fails (node-addchild a root))            ; expect: node-addchild: child is the root, which has no parent
(fails (node-addchild a 'b))              ; expect: node-addchild: child must be a node, got b
(fails (node-removechild a c))            ; expect: node-removechild: child #<node name="c" type=context> hangs below another node: #<node name="b" type=context>
(fails (node-removechild root a))         ; expect: node-removechild: child #<node name="a" type=context> hangs below no node
(fails (node-removechild a 1))            ; expect: node-removechild: index must be from 0 to 0, got 1
(fails (node-getchild root 0))            ; expect: node-getchild: #<node name="root" type=context> has no children
(fails (node-getchild a -1))              ; expect: node-getchild: index must be an exact integer from 0 on, got -1
(fails (node-create 'lamp))               ; expect: node-create: type must be one of (context), got lamp
(fails (node-create #:name 'lamp))        ; expect: node-create: expected a string, got lamp
(fails (node-create #:parent 3))          ; expect: node-create: parent must be a node, got 3
(fails (node-setname a 3))                ; expect: node-setname: name must be a string, got 3
(fails (node-translate a 3))              ; expect: node-translate: v must be a gvector of finite coordinates, got 3
(fails (node-scale a (vxyz 1 0 1)))       ; expect: node-scale: factors must not be 0 along any axis, got (vxyz 1 0 1)
(fails (node-setdrawing a 3))             ; expect: node-setdrawing: drawing must be an object or a list of objects, got 3
(fails (register-node-type 'context list)) ; expect: register-node-type: the type context is the language's own
(register-node-type 'pair (lambda (node) (node-create #:parent node #:drawing cube) (node-create #:parent node #:drawing cube #:translate ux)))
(show (volume (node-object (node-create 'pair))))                   ; expect: 2.0

; depth and width
(define top (node-create))
(let deeper ((n 20000) (node top))
  (if (> n 0) (deeper (- n 1) (node-create #:parent node #:translate uz #:drawing (if (= n 1) cube '())))))
(show (bounding-box (node-object top)))                             ; expect: ((xyz 0 0 20000) (xyz 1 1 20001))
(define wide (node-create))
(for ([i (in-range 20000)]) (node-create #:parent wide))
(show (length (node-getchildren wide)))                             ; expect: 20000
