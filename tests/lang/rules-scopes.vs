; Scopes as values, their readers in and out of rules; clauses, modules, chance and flags; components of each class.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define cube (make-box (xyz 0 0 0) (xyz 1 1 1)))
(define b (make-box-scope (xyz 1 2 3) 4 3 2))
(define out '())
(define (note s x) (set! out (cons x out)) s)
(define (noted thunk) (set! out '()) (thunk) (reverse out))
; a root's frame is right-handed: x along, y up, z to -Y
(displayln (scope-frame b)) ; expect: (make-matrix 1 0 0 1 0 0 -1 2 0 1 0 3 0 0 0 1)
(displayln (list (scope-parent b) (scope-path b) (scope-depth b) (scope-index b) (scope-count b) (scope-first? b) (scope-last? b) (scope-left-angle b) (scope-right-angle b) (scope-flags b))) ; expect: (#f () 0 0 1 #t #t 0.0 0.0 ())
(define turtle (make-turtle-scope origin ux uz 3 2))
(define all
  (list b (make-ffd-scope (xyz 0 0 0) (xyz 2 0 0) (xyz 0 0 3) (xyz 2 0 3) (xyz 0 -1 0) (xyz 1 -1 0) (xyz 0 -1 3) (xyz 1 -1 3)) turtle
    (make-mesh-scope cube) (make-polygon-scope (make-polygon (xy 0 0) (xy 3 0) (xy 0 3))) (make-triangle-scope origin (xy 1 0) (xy 0 1))
    (make-curve-scope (make-line origin (xy 3 4))) (make-surface-scope (make-surface (lambda (u v) (xyz u v 0)) 0 1 0 2))))
; each satisfies one predicate of a class, and scope?
(define classes (list box-scope? ffd-scope? turtle-scope? mesh-scope? polygon-scope? triangle-scope? curve-scope? surface-scope?))
(displayln (map (lambda (s) (length (filter (lambda (class?) (class? s)) classes))) all)) ; expect: (1 1 1 1 1 1 1 1)
(displayln (map (lambda (class? s) (class? s)) classes all))                              ; expect: (#t #t #t #t #t #t #t #t)
(displayln (list (every scope? all) (scope? cube) (box-scope? 5)))                        ; expect: (#t #f #f)
; an operator gives another scope and leaves the first as it was
(define (sizes s) (list (scope-size-x s) (scope-size-y s) (scope-size-z s)))
(displayln (map sizes (list (scope-scale b 2) (scope-scale b 1 2 3) (scope-height b 9) (scope-size b 1 #f 2) b))) ; expect: ((8.0 6.0 4.0) (4.0 6.0 6.0) (4.0 9.0 2.0) (1.0 3.0 2.0) (4.0 3.0 2.0))
(displayln (scope-corner (scope-turn b 'y pi/2) 1 0 0)) ; expect: (xyz 1 6 3)
(displayln (scope-corner (scope-turn b 'z pi/2) 1 0 0)) ; expect: (xyz 1 2 7)
(displayln (scope-corner (scope-turn b 'x pi/2) 0 1 0)) ; expect: (xyz 1 -1 3)
; the path from the root, the parent, the place among those made; flags, plain and by a test, in the whole subtree and never beside
(define-rule (leaf [self box-scope?]) [(=> (note (list (scope-path self) (scope-path (scope-parent self)) (scope-index self) (scope-count self) (scope-flags self))))])
(define-rule (between [self box-scope?]) [(=> (scope-split 'y (rest leaf)))])
(define-rule (mid [self box-scope?]) [(=> (with-flags '(a (b (scope-first? self)) (c #f)) between) (leaf))])
(define-rule (top [self box-scope?]) [(=> (scope-repeat 'x 2 mid) (leaf))])
(for-each displayln (noted (lambda () (top b))))
; expect: (((top repeat 0) (mid flags 0) (between split 0)) ((top repeat 0) (mid flags 0)) 0 1 (a b))
; expect: (((top repeat 0) (mid leaf 0)) ((top repeat 0)) 0 2 ())
; expect: (((top repeat 1) (mid flags 1) (between split 0)) ((top repeat 1) (mid flags 1)) 0 1 (a))
; expect: (((top repeat 1) (mid leaf 1)) ((top repeat 1)) 1 2 ())
; expect: (((top leaf 0)) () 0 1 ())
; the first clause that holds; a module sees its parameters or shadows them, and rules of the same name
(define-rule (paint [self box-scope?] [width number? 5])
  (define-rule (shadowing [self box-scope?] [width number? 7]) [(=> (note width))])
  (define-rule (seeing [self box-scope?]) [(=> (note width))])
  (define-rule (leaf [self box-scope?]) [(=> (note 'shadowed))])
  [#:when #f (=> (note 'first))]
  [#:when (= 1 1) (=> (shadowing) (seeing) (leaf))]
  [#:when #t (=> (note 'third))]
  [(=> (note 'last))])
(displayln (noted (lambda () (paint b))))   ; expect: (7 5 shadowed)
(displayln (noted (lambda () (paint b 9)))) ; expect: (7 9 shadowed)
; no clause that holds, and a sequence of nothing, give the empty object; several objects are gathered
(define-rule (nothing [self box-scope?]) [#:when #f (=> (scope-place cube))])
(define-rule (two [self box-scope?]) [(=> (scope-place cube) (scope-move 9 0 0) (scope-place cube))])
(displayln (list (object-kind (nothing b)) (object-count (two b)))) ; expect: (empty-object 2)
; rules as parameters: a template that is given two rules, and one of them with its own arguments
(define-rule (template [self box-scope?] [odd procedure?] [even procedure?])
  (define-rule (bay [self box-scope?]) [#:when (odd? (scope-index self)) (=> (odd))] [(=> (even))])
  [(=> (scope-repeat 'x 1 bay))])
(define-rule (say [self box-scope?] [x any?]) [(=> (note x))])
(define-rule (plain [self box-scope?]) [(=> (note 'plain))])
(displayln (noted (lambda () (template b (rule-with say 'odd) plain)))) ; expect: (plain odd plain odd)
; chances at their ends; one alone may leave nothing
(define-rule (sure [self box-scope?]) [(=> #:chance 1 (note 1)) (=> #:chance 0 (note 0)) (=> (note 'rest))])
(define-rule (never [self box-scope?]) [(=> #:chance 0 (note 0))])
(define (many rule) (noted (lambda () (scope-repeat (make-box-scope origin 1000 1 1) 'x 1 rule))))
(displayln (list (every (lambda (x) (equal? x 1)) (many sure)) (many never))) ; expect: (#t ())
; half a part more is another part
(displayln (map (lambda (n) (length (noted (lambda () (scope-repeat (make-box-scope origin n 1 1) 'x 2 (lambda (s) (note s 0) '())))))) '(0.5 2.9 3 4.9 5)))  ; expect: (1 1 2 2 3)
; components: how many of each, and where they are
(define (made s of) (let ((l '())) (scope-component s (lambda (c) (set! l (cons c l)) '()) #:of of) (reverse l)))
(define (counts s . of) (map (lambda (what) (length (made s what))) of))
(displayln (counts b 'faces 'sides 'edges 'vertices 'front 'top))             ; expect: (6 4 12 8 1 1)
(displayln (counts (list-ref all 1) 'faces 'edges 'vertices))                 ; expect: (6 12 8)
(displayln (counts (list-ref all 4) 'edges 'vertices))                        ; expect: (3 3)
(displayln (counts (list-ref all 5) 'edges 'vertices))                        ; expect: (3 3)
; a mesh's edges and vertices are shared by its faces and counted once: Euler's formula holds
(define (euler o) (apply (lambda (f e v) (list f e v (+ v (- e) f))) (counts (make-mesh-scope o) 'faces 'edges 'vertices)))
(displayln (euler cube))                                                      ; expect: (6 12 8 2)
(displayln (euler (do-rotate cube 'z 0.3)))                                   ; expect: (6 12 8 2)
(displayln (last (euler (make-sphere origin 1 #:segments 24))))               ; expect: 2
(displayln (last (euler (make-torus origin 3 1 #:segments 24))))              ; expect: 0
(define upright (filter (lambda (c) (= (cz (scope-corner c 0 0 0)) (- 1 (cz (scope-corner c 1 0 0))))) (made (make-mesh-scope cube) 'edges)))
(displayln (list (length upright) (map sizes (list (car upright)))))          ; expect: (4 ((1.0 0.0 0.0)))
; y is up along level edges: a rail of .1 lies on the cube's top and below it
(define rails (map (lambda (c) (scope-place (scope-size c #f 0.1 0.1) cube)) (made (make-mesh-scope cube) 'edges)))
(displayln (near? (apply + (map volume rails)) (* 12 0.01)))                  ; expect: #t
(displayln (counts (make-mesh-scope (make-rectangle (xy 0 0) (xy 4 4))) 'faces 'edges 'vertices)) ; expect: (1 4 4)
(displayln (counts (make-mesh-scope (empty-object)) 'faces 'edges 'vertices)) ; expect: (0 0 0)
(fails (made (make-mesh-scope cube) 'front)) ; expect: scope-component: #:of must be one of 'faces 'edges 'vertices, for a mesh, got front
(fails (made (list-ref all 4) 'faces))      ; expect: scope-component: #:of must be 'edges or 'vertices, for a polygon, a triangle or a curve, got faces
(fails (made (list-ref all 6) 'faces))      ; expect: scope-component: #:of must be 'edges or 'vertices, for a polygon, a triangle or a curve, got faces
(fails (made turtle 'faces))                ; expect: scope-component: s must be a box scope, an FFD scope, a mesh scope, a polygon scope, a triangle scope or a curve scope, got #<turtle-scope root>
; a curve's samples: an open one has an edge less than vertices; edges stand upright, z to the right of the way, whichever way they lead
(define way (make-curve-scope (make-line (xyz 0 0 0) (xyz 3 4 0) (xyz 3 4 5))))
(displayln (append (counts way 'edges 'vertices) (counts (make-curve-scope (make-polygon (xy 0 0) (xy 1 0) (xy 0 1))) 'edges 'vertices))) ; expect: (2 3 3 3)
(displayln (map scope-size-x (made way 'edges)))                 ; expect: (5.0 5.0)
(displayln (near? (scope-frame (first (made way 'edges))) (make-matrix 0.6 0 0.8 0 0.8 0 -0.6 0 0 1 0 0 0 0 0 1))) ; expect: #t
(displayln (map (lambda (c) (scope-corner c 0 0 0)) (made (scope-move way 1 0 0) 'vertices))) ; expect: ((xyz 1 0 0) (xyz 4 4 0) (xyz 4 4 5))
(displayln (near? (apply + (map scope-size-x (made (make-curve-scope (make-circle origin 1)) 'edges))) 2pi 0.01)) ; expect: #t
; a mesh as a floor plan: its face raised, as G2 loads meshes
(define-rule (site [self mesh-scope?]) [(=> (scope-component plot))])
(define-rule (plot [self polygon-scope?]) [(=> (scope-extrude 3 #:side wall #:top (lambda (s) (note s 'roof) '())))])
(define-rule (wall [self box-scope?]) [(=> (scope-size #f #f 0.5) (scope-place cube))])
(displayln (near? (volume (site (make-mesh-scope (make-rectangle (xy 0 0) (xy 4 2))))) (* 12 3 0.5))) ; expect: #t
; tropism: half of the angle, all of it, and none; straight against the vector there is no way to turn
(define (ahead s) (p-p (scope-corner (turtle-width (turtle-height s 0) 0) 0 0 1) origin))
(define (heading s) (ahead (turtle-forward s 1)))
(displayln (map (lambda (k) (near? (heading (turtle-toward turtle uz k)) (vxyz (cos (* k pi/2)) 0 (sin (* k pi/2))))) '(0 0.5 1))) ; expect: (#t #t #t)
