; Rules on boxes, hexahedra and polygons: closed forms, chance by path, errors with both places.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define cube (make-box (xyz 0 0 0) (xyz 1 1 1)))
(define bar (make-box-scope origin 10 3 0.2))
(define (sizes op) (let ((found '())) (op (lambda (s) (set! found (cons (scope-size-x s) found)) '())) (reverse found)))
(displayln (sizes (lambda (r) (scope-split bar 'x (absolute 2 r) (rest r) (absolute 3 r))))) ; expect: (2.0 5.0 3.0)
(displayln (sizes (lambda (r) (scope-split bar 'x (relative 0.2 r) (rest 3 r) (rest r)))))   ; expect: (2.0 6.0 2.0)
(displayln (near? (sizes (lambda (r) (scope-repeat bar 'x 3.4 r))) (list 10/3 10/3 10/3)))    ; expect: #t
(displayln (length (sizes (lambda (r) (scope-repeat bar 'x 4 r)))))     ; expect: 3
(displayln (length (sizes (lambda (r) (scope-repeat bar 'x 100 r)))))   ; expect: 1
(displayln (sizes (lambda (r) (scope-component bar r))))                ; expect: (10.0 0.2 10.0 0.2 10.0 10.0)
(displayln (length (sizes (lambda (r) (scope-component bar r #:of 'vertices))))) ; expect: 8
; faces look out: a cube half its size placed on each stands outside
(displayln (bounding-box (scope-component (make-box-scope origin 1 1 1) (lambda (s) (scope-place (scope-size s #f #f 1) cube))))) ; expect: ((xyz -1 -2 -1) (xyz 2 1 2))
(define box (make-ffd-scope (xyz 0 0 0) (xyz 10 0 0) (xyz 0 0 3) (xyz 10 0 3) (xyz 0 -1 0) (xyz 10 -1 0) (xyz 0 -1 3) (xyz 10 -1 3)))
(displayln (bounding-box (scope-split box 'x (absolute 2 #f) (rest cube) (absolute 3 #f)))) ; expect: ((xyz 2 -1 0) (xyz 7 0 3))
(displayln (near? (volume (scope-repeat box 'y 1 cube)) 30)) ; expect: #t
; outer angles sum to a turn
(define (turn-of . corners)
  (let ((sum 0))
    (scope-extrude (make-polygon-scope (apply make-polygon corners)) 2 #:side (lambda (s) (set! sum (+ sum (scope-right-angle s))) '()))
    (near? sum 2pi)))
(displayln (turn-of (xy 0 0) (xy 4 0) (xy 4 2) (xy 2 2) (xy 2 5) (xy 0 5)))                    ; expect: #t
(displayln (turn-of (xy 0 0) (xy 6 0) (xy 6 4) (xy 4 4) (xy 4 2) (xy 2 2) (xy 2 4) (xy 0 4))) ; expect: #t
(displayln (turn-of (xy 2 0) (xy 1 1.7) (xy -1 1.7) (xy -2 0) (xy -1 -1.7) (xy 1 -1.7)))      ; expect: #t
; clauses, parameters, modules, flags
(define-rule (front [self box-scope?] [n integer? 3])
  (define-rule (bay [self box-scope?])
    [#:when (flag? self 'door) (=> (scope-height 1) (scope-place cube))]
    [#:when (= n 2) (=> (scope-split 'y (absolute 2 cube) (rest #f)))]
    [(=> (scope-place cube))])
  [(=> (scope-repeat 'x (/ 10 n) (lambda (s) (with-flags s '((door (= (scope-index s) 1))) bay))))])
(displayln (near? (volume (front bar)) (* 0.2 (+ 10/3 10 10)))) ; expect: #t
(displayln (near? (volume (front bar 2)) (* 0.2 (+ 10 5))))     ; expect: #t
(define-rule (flagged [self box-scope?]) [#:when (flag? self 'corner) (=> (scope-place cube))] [(=>)])
(define-rule (pair [self box-scope?]) [(=> (scope-split 'x (absolute 4 (lambda (s) (with-flags s '(corner) flagged))) (rest flagged)))])
(displayln (bounding-box (pair bar)))       ; expect: ((xyz 0 -0.2 0) (xyz 4 0 3))
; a rule is a procedure: what it gives is an object, in an expression too
(define-rule (twice [self box-scope?]) [(=> (scope-place (unite (front self) (do-move (front self) (vxyz 0 0 9)))))])
(displayln (object? (twice bar)))           ; expect: #t
; chance: the same for the same path, whatever other rules do
(define choices '())
(define (note s c) (set! choices (cons c choices)) '())
(define-rule (choice [self box-scope?]) [(=> #:chance 0.5 (note 0)) (=> #:chance 0.2 (note 1)) (=> (note 2)) (=> (note 3))])
(define-rule (window-a [self box-scope?]) [(=> (scope-place cube))])
(define-rule (window-b [self box-scope?]) [(=> (scope-repeat 'x 0.3 cube)) (=> (scope-place cube) (scope-place cube))])
(define (street window)
  (define-rule (house [self box-scope?]) [(=> (scope-split 'x (absolute 0.5 window) (rest choice)))])
  (set! choices '())
  (scope-repeat (make-box-scope origin 10000 3 1) 'x 1 house)
  choices)
(define one (street window-a))
(displayln (length one))                    ; expect: 10000
(displayln (equal? one (street window-b)))  ; expect: #t
(random-seed! 7)
(displayln (equal? one (street window-a)))  ; expect: #f
; chi squared, three degrees of freedom: under 16.27 for p > .001
(define (chi2 found expected) (apply + (map (lambda (f e) (/ (* (- f e) (- f e)) e)) found expected)))
(define (how-many c) (length (filter (lambda (x) (= x c)) one)))
(displayln (< (chi2 (map how-many '(0 1 2 3)) '(5000 2000 1500 1500)) 16.27)) ; expect: #t
; the generator of the program is as if no rule had run
(random-seed! 3) (define before (list (random 1000000) (random 1000000)))
(random-seed! 3) (define first-number (random 1000000)) (street window-a)
(displayln (equal? before (list first-number (random 1000000)))) ; expect: #t
; errors
(define-rule (leaf [self turtle-scope?]) [(=> (scope-place cube))])
(define-rule (ever [self box-scope?]) [(=> (ever))])
(fails (leaf bar))                          ; expect: leaf: self must satisfy turtle-scope?, got a box scope; the rule is at tests/lang/rules-boxes.vs:68:1
(fails (leaf 5))                            ; expect: leaf: self must satisfy turtle-scope?; the rule is at tests/lang/rules-boxes.vs:68:1, got 5
(fails (scope-repeat bar 'x 1 leaf))        ; expect: leaf: self must satisfy turtle-scope?, got a box scope; the rule is at tests/lang/rules-boxes.vs:68:1
(fails (ever bar))                          ; expect: ever: the derivation is 1000 levels deep, at .../ever/ever.0/ever/ever.0/ever/ever.0/ever/ever.0/ever/ever.0/ever/ever.0/ever/ever.0/ever/ever.0/ever/ever.0/ever/ever.0/ever/ever.0/ever/ever.0; a rule that calls itself needs a clause that ends, or (derive scope rule #:depth n)
(fails (scope-split bar 'x (absolute 6 cube) (absolute 5 cube))) ; expect: scope-split: the parts sum to 11, but the scope is 10 along x
(fails (scope-split bar 'w (absolute 6 cube)))  ; expect: scope-split: axis must be one of 'x, 'y, 'z, got w
(fails (scope-split bar 'x 5))              ; expect: scope-split: part must be (absolute n rule), (relative f rule) or (rest [weight] rule), got 5
(fails (scope-split bar 'x))                ; expect: scope-split: takes (scope-split s axis part ...), and each part is (absolute n rule), (relative f rule) or (rest [weight] rule)
(fails (absolute -1 cube))                  ; expect: absolute: n must be a number from 0 on, got -1
(fails (absolute 1 5))                      ; expect: absolute: rule must be a rule (a procedure of a scope), an object to place, or #f, got 5
(fails (scope-repeat bar 'x 1 5))           ; expect: scope-repeat: rule must be a rule (a procedure of a scope), an object to place, or #f, got 5
(fails (scope-repeat bar 'x 1e-9 cube))     ; expect: scope-repeat: 10 by 1e-09 would be 10000000000 parts, more than 10000000
(fails (scope-extrude bar 2 #:top cube))    ; expect: scope-extrude: s must be a polygon scope or a triangle scope, got #<box-scope root>
(fails (scope-component bar cube #:of 'top-left)) ; expect: scope-component: #:of must be one of 'faces 'sides 'edges 'vertices 'front 'back 'left 'right 'top 'bottom, got top-left
(fails (scope-repeat bar 'x 1 (lambda (s) 5))) ; expect: rule: the value of a rule must be an object or a list of objects, got 5
(fails (scope-repeat bar 'x 20 (lambda (s) s))) ; expect: rule: the value of a rule must be an object or a list of objects (scope-place puts one into the scope), got #<box-scope repeat.0>
(define-rule (unlikely [self box-scope?] [p number?]) [(=> #:chance p (scope-place cube)) (=> #:chance 0.7 (scope-place cube))])
(fails (unlikely bar 0.5))                  ; expect: unlikely: the chances of a clause sum to 1.2, which is more than 1
(fails (unlikely bar 2))                    ; expect: unlikely: #:chance must be a number from 0 to 1, got 2
(fails (with-flags bar '(5) cube))          ; expect: with-flags: flags must be a list of names and of (name test), got 5
(fails (make-box-scope origin -1 1 1))      ; expect: make-box-scope: dx must be positive, got -1
(scope-split bar 'x (absolute 4 cube))      ; expect warning: scope-split: the parts sum to 4, but the scope is 10 along x: the rest stays empty; write (rest #f) if the rest is to be empty
(define-rule (street-of [self box-scope?])
  [(=> (scope-repeat 'x 1 leaf))])          ; expect error: leaf: self must satisfy turtle-scope?, got a box scope; the rule is at tests/lang/rules-boxes.vs:68:1
(street-of bar)
