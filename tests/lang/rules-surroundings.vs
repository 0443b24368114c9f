; What rules ask of what was made: touching, lying inside, marks, signals, detail, and the tree of a derivation.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define cube (make-box (xyz 0 0 0) (xyz 1 1 1)))
(define ball (make-sphere (xyz 0 0 0) 1))
(define (at x y z dx dy dz) (make-box-scope (xyz x y z) dx dy dz))
; of an object: box against box, with a face in common, and with a gap
(define (touch s o) (touches? s #:of o))
(displayln (list (touch (at 1 0 0 1 1 1) cube) (touch (at 1 1 1 1 1 1) cube) (touch (at 1.001 0 0 1 1 1) cube))) ; expect: (#t #t #f)
; bounds that meet are not enough: the corner of a sphere's box is empty
(displayln (touch (at 0.8 -0.8 0.8 0.2 0.2 0.2) ball)) ; expect: #f
(displayln (touch (at 0.5 -0.5 0.5 0.2 0.2 0.2) ball)) ; expect: #t
; wholly inside a solid, around one, and in a hollow
(define shell (subtract (make-sphere (xyz 0 0 0) 2) (make-sphere (xyz 0 0 0) 1.5)))
(displayln (list (touch (at -0.1 0.1 -0.1 0.2 0.2 0.2) ball) (touch (at -5 5 -5 10 10 10) ball) (touch (at -0.1 0.1 -0.1 0.2 0.2 0.2) shell))) ; expect: (#t #t #f)
(define (in s o) (inside? s #:of o))
(displayln (list (in (at -0.1 0.1 -0.1 0.2 0.2 0.2) ball) (in (at -0.1 0.1 -0.1 0.2 0.2 2) ball) (in (at -0.1 0.1 -0.1 0.2 0.2 0.2) shell))) ; expect: (#t #f #f)
; its corners are in the shell, and its middle is in the hollow
(displayln (in (at -1 1 -1 2 2 2) shell))              ; expect: #f
(displayln (in (at 0 1 0 1 1 1) (do-move cube (vxyz 0 0 0)))) ; expect: #t
; surfaces and curves
(define sheet (make-surface (lambda (u v) (xyz (* 4 u) (* 4 v) (sin (* 4 u)))) 0 1 0 1))
(displayln (list (touch (at 1.5 1.6 0.9 0.1 0.1 0.2) sheet) (touch (at 1.5 1.6 0.2 0.1 0.1 0.2) sheet))) ; expect: (#t #f)
(displayln (list (touch (at 0.4 0 0.4 0.2 0.2 0.2) (make-line (xyz 0 -0.1 0) (xyz 1 -0.1 1))) (touch (at 0.4 0 0 0.2 0.2 0.2) (make-line (xyz 0 -0.1 0) (xyz 1 -0.1 1))))) ; expect: (#t #f)
; hexahedra, by their tetrahedra: half of the box is filled
(define wedge (make-ffd-scope (xyz 0 0 0) (xyz 1 0 0) (xyz 0 0 1) (xyz 1 0 1) (xyz 0 0 0) (xyz 1 -1 0) (xyz 0 0 1) (xyz 1 -1 1)))
(displayln (list (touch wedge (make-box (xyz 0.1 -0.9 0.4) (xyz 0.2 -0.8 0.6))) (touch wedge (make-box (xyz 0.8 -0.2 0.4) (xyz 0.9 -0.1 0.6))))) ; expect: (#f #t)
; faces have no size along z
(define (face-touches o) (let ((n 0)) (scope-component (at 0 1 0 1 1 1) (lambda (s) (if (touch s o) (set! n (+ n 1))) '())) n))
(displayln (face-touches (make-box (xyz 0.4 0.4 0.9) (xyz 0.6 0.6 1.1)))) ; expect: 1
(displayln (face-touches (make-box (xyz 0.9 0.9 0.9) (xyz 1.1 1.1 1.1)))) ; expect: 3

; polygons, triangles, curves, meshes and surfaces are asked as they are, not as the boxes around them
(define ell (make-polygon-scope (make-polygon (xy 0 0) (xy 4 0) (xy 4 1) (xy 1 1) (xy 1 4) (xy 0 4))))
(define (post x y) (make-box (xyz x y -1) (xyz (+ x 0.5) (+ y 0.5) 1)))
(displayln (list (touch ell (post 2 2)) (touch ell (post 2 0.2)) (touch ell (post 0.8 2)) (touch ell (post 1 1)))) ; expect: (#f #t #t #t)
(define (raised-ell k) (do-move (do-extrude (make-polygon (xy (- k) (- k)) (xy (+ 4 k) (- k)) (xy (+ 4 k) (+ 1 k)) (xy (+ 1 k) (+ 1 k)) (xy (+ 1 k) (+ 4 k)) (xy (- k) (+ 4 k))) 2) (vxyz 0 0 -1)))
(displayln (list (in ell (make-box (xyz -1 -1 -1) (xyz 5 5 1))) (in ell (raised-ell 0.1)) (in ell (raised-ell 0)) (in ell (raised-ell -0.1)))) ; expect: (#t #t #t #f)
(define holed (make-polygon-scope (make-region (make-rectangle (xy 0 0) (xy 4 4)) (make-rectangle (xy 1 1) (xy 3 3)))))
(displayln (list (touch holed (post 1.5 1.5)) (touch holed (post 0.2 0.2)))) ; expect: (#f #t)
(define corner (make-triangle-scope origin (xy 4 0) (xy 0 4)))
(displayln (list (touch corner (post 3 3)) (touch corner (post 1 1)))) ; expect: (#f #t)
(define slope (make-curve-scope (make-line (xyz 0 0 0) (xyz 4 4 0) (xyz 8 0 0))))
(displayln (list (touch slope (post 3 0)) (touch slope (post 2 2)) (touch slope (post 5.9 1.9)))) ; expect: (#f #t #t)
(define hollow (make-mesh-scope (subtract (make-box (xyz -3 -3 -3) (xyz 3 3 3)) (make-box (xyz -2 -2 -2) (xyz 2 2 2)))))
(displayln (list (touch hollow (post 0 0)) (touch hollow (make-box (xyz 2.2 0 0) (xyz 2.6 1 1))) (touch hollow (post 1.8 0)) (touch hollow (post 5 5)))) ; expect: (#f #t #t #f)
(define wave (make-surface-scope sheet))
(displayln (list (touch wave (make-box (xyz 1.5 1.5 0) (xyz 1.6 1.6 0.5))) (touch wave (make-box (xyz 1.5 1.5 0.9) (xyz 1.6 1.6 1.1))))) ; expect: (#f #t)

; of what was made so far: by flag, and of all; the second block finds the first
(define found '())
(define (note! s x) (set! found (append found (list x))) s)
(define-rule (block [self box-scope?]) [(=> (note! (touches? self #:flag 'red)) (note! (touches? self)) (scope-place cube))])
(define-rule (row [self box-scope?])
  [(=> (scope-split 'x (absolute 1 (lambda (s) (with-flags s '(red) block))) (absolute 1 block) (absolute 1 block) (rest block)))])
(define-rule (coloured [self box-scope?])
  (define-rule (flagged [self box-scope?]) [(=> (with-flags '(red) block))])
  [(=> (scope-split 'x (absolute 1 flagged) (absolute 1 block) (absolute 1 block) (rest block)))])
(define o (coloured (at 0 0 0 4 1 1)))
(displayln found)                                      ; expect: (#f #f #t #t #f #t #f #t)
; many: a cell of 4096 touches its neighbours that were made before it; counted also by a table of them
(define touched 0)
(define (count! s) (if (touches? s) (set! touched (+ touched 1))) s)
(define-rule (cell [self box-scope?]) [#:when (< (random) 0.3) (=> (count!) (scope-place cube))] [(=>)])
(define-rule (cells [self box-scope?]) [(=> (scope-repeat 'z 1 cell))])
(define-rule (line [self box-scope?]) [(=> (scope-repeat 'y 1 cells))])
(define many (scope-repeat (at 0 0 0 16 16 16) 'x 1 line))
(displayln (< 1000 (object-count many) 1500))          ; expect: #t
(define placed (map bounding-box (object-children many)))
(define (corner b) (map inexact (list (floor (cx (car b))) (floor (cz (car b))) (- (ceiling (- (cy (cadr b)) 1e-9))))))
(define seen (make-hash))
(define expected 0)
(for-each
  (lambda (b)
    (let* ((c (corner b)) (x (first c)) (y (second c)) (z (third c)))
      (if (any (lambda (d) (hash-ref seen (map + c d) #f)) '((0 0 -1) (0 -1 0) (0 -1 -1) (0 -1 1) (-1 0 0) (-1 0 -1) (-1 0 1) (-1 -1 0) (-1 1 0) (-1 -1 -1) (-1 -1 1) (-1 1 -1) (-1 1 1)))
          (set! expected (+ expected 1)))
      (hash-set! seen c #t)))
  placed)
(displayln (list (> touched 800) (= touched expected))) ; expect: (#t #t)

; marks: found where they are, also moved, turned, scaled and copied
(define-rule (masonry [self box-scope?])
  [(=> (scope-mark 'stone 'climbable #t 'rough 0.4) (scope-place cube))])
(define-rule (glass-wall [self box-scope?]) [(=> (scope-mark 'pane) (scope-place cube))])
(define-rule (front [self box-scope?]) [(=> (scope-split 'x (absolute 2 masonry) (absolute 1 glass-wall) (rest masonry)))])
(define house (front (at 0 0 0 5 3 0.5)))
(displayln (object-count house))                       ; expect: 3
(displayln (map scope-name (find-scopes house)))       ; expect: (stone pane stone)
(displayln (map scope-size-x (find-scopes house 'stone))) ; expect: (2.0 2.0)
(define one (car (find-scopes house 'stone)))
(displayln (list (scope-property one 'climbable) (scope-property one 'rough) (scope-property one 'colour "none"))) ; expect: (#t 0.4 none)
(displayln (map scope-size-x (find-scopes house #:where (lambda (s) (not (scope-property s 'climbable)))))) ; expect: (1.0)
(displayln (scope-path one))                           ; expect: ((front split 0))
(define two (unite house (do-scale (do-rotate house 'z pi/2) 2)))
(displayln (map scope-size-x (find-scopes two 'stone))) ; expect: (2.0 2.0 4.0 4.0)
(displayln (near? (scope-corner (third (find-scopes two 'stone)) 1 0 0) (xyz 0 4 0))) ; expect: #t
(define mirrored (do-mirror house (make-plane (xyz 0 0 0) ux)))
(define m (car (find-scopes mirrored 'stone)))
(displayln (list (scope-corner m 0 0 0) (scope-corner m 1 1 1))) ; expect: ((xyz -2 0 0) (xyz 0 -0.5 3))
(define sheared (do-transform house (make-matrix 1 0 0.5 0 0 1 0 0 0 0 1 0 0 0 0 1)))
(displayln (ffd-scope? (car (find-scopes sheared 'stone)))) ; expect: #t
(displayln (near? (volume (map (lambda (s) (scope-place s cube)) (find-scopes sheared))) (volume house))) ; expect: #t
(displayln (map scope-name (find-scopes (subtract house cube)))) ; expect: (stone pane stone)
(displayln (find-scopes cube))                         ; expect: ()
(displayln (scope-name (at 0 0 0 1 1 1)))              ; expect: #f
; a row of rows is searched once for each mark, and rows without marks not at all
(define (twice o n) (if (= n 0) o (let ((p (twice o (- n 1)))) (unite p (do-move p (vxyz (expt 2 n) 0 0))))))
(displayln (length (find-scopes (unite (twice cube 40) house)))) ; expect: 3

; signals: the branch opens the wall where it comes through
(define-rule (wall [self box-scope?])
  [(=> (with-flags '(wall) waiting))])
(define-rule (waiting [self box-scope?]) [(=> (scope-await 'branch opened))])
(define-rule (opened [self box-scope?])
  [#:when (null? (scope-signals self)) (=> (scope-place cube))]
  [(=> (around (scope-overlap self (car (scope-signals self)))))])
(define (around s b)
  (let ((low (car b)) (high (cadr b)))
    (scope-split s 'x (absolute (cx low) cube) (absolute (- (cx high) (cx low)) (lambda (s) (scope-split s 'y (absolute (cy low) cube) (absolute (- (cy high) (cy low)) #f) (rest cube)))) (rest cube))))
(define-rule (branch [self box-scope?])
  [#:when (touches? self #:flag 'wall) (=> (scope-signal 'branch) (scope-place ball))]
  [(=> (scope-place ball))])
(define-rule (yard [self box-scope?])
  [(=> (scope-split 'z (absolute 1 wall) (rest branches)))])
(define-rule (branches [self box-scope?])
  [(=> (scope-move 2 1 -2) (scope-size 1 1 4) (branch))])
(define garden (yard (at 0 0 0 8 3 5)))
(displayln (near? (volume (filter (lambda (o) (near? (cy (cadr (bounding-box o))) 0)) (object-children garden))) (- 24 1))) ; expect: #t
(displayln (map caar (derivation garden)))             ; expect: (#f)
; waits without a signal are derived all the same, the first first
(define order '())
(define (say! s x) (set! order (cons x order)) '())
(define-rule (three [self box-scope?])
  [(=> (scope-await 'a (lambda (s) (say! s 1))) (say! 0))])
(define-rule (first-then [self box-scope?])
  [(=> (scope-await 'a (lambda (s) (say! s 1) (scope-await s 'b (lambda (s) (say! s 3))))) (scope-repeat 'x 1 (lambda (s) (say! s 0))) (scope-await 'a (lambda (s) (say! s 2))))])
(first-then (at 0 0 0 2 1 1))
(displayln (reverse order))                            ; expect: (0 0 1 3 2)

; detail: a lens of 36 mm sees as much as it is far away; the diagonal of a 3-4-12 box is 13
(displayln (scope-detail (at 0 0 0 3 4 12)))           ; expect: +inf.0
(camera (xyz -100 0 0) (xyz 0 0 0) #:lens 36)
(displayln (near? (scope-detail (at -1.5 6 -2 3 4 12)) (* 640 (/ 13 93.5)))) ; expect: #t
(displayln (near? (scope-detail (at -1.5 6 -2 3 4 12) #:width 1280) (* 1280 (/ 13 93.5)))) ; expect: #t
(displayln (scope-detail (at -101 1 -1 2 2 2)))        ; expect: +inf.0

; the tree: what made what, also through derivations of their own
(displayln (derivation house))                         ; expect: (((#f front 0) ((front split 0)) ((front split 1)) ((front split 2))))
(displayln (equal? (derivation house) (derivation (do-move house (vxyz 1 2 3))))) ; expect: #t
(displayln (derivation (row (at 0 0 0 3 1 1))))        ; expect: (((#f row 0) ((row split 0) ((row flags 0))) ((row split 1)) ((row split 2)) ((row split 3))))
(displayln (derivation (scope-repeat (at 0 0 0 2 1 1) 'x 1 cube))) ; expect: (((#f repeat 0)) ((#f repeat 1)))
(define-rule (deep [self box-scope?] [n integer?]) [#:when (= n 0) (=> (scope-place cube))] [(=> (deep (- n 1)))])
(define (depth t) (let loop ((t (car t)) (d 1)) (if (null? (cdr t)) d (loop (cadr t) (+ d 1)))))
(displayln (depth (derivation (deep (at 0 0 0 1 1 1) 900)))) ; expect: 901
; that of an object that is still there is kept, whatever was derived since
(define early (front (at 0 0 0 5 3 0.5)))
(define later #f)
(do ((i 0 (+ i 1))) ((= i 200)) (set! later (front (at i 0 0 5 3 0.5))))
(displayln (length (cdar (derivation early))))         ; expect: 3

(fails (derivation cube))              ; expect: derivation: no rule gave this object; a derivation is that of an object as a rule gave it, also moved or painted
(fails (scope-mark (at 0 0 0 1 1 1) 'x)) ; expect: scope-mark: works only in a rule: outside of a rule there is no scope
(fails (scope-mark (at 0 0 0 1 1 1) 5))  ; expect: scope-mark: name must be a symbol, got 5
(define-rule (odd [self box-scope?]) [(=> (scope-mark 'x 'y))])
(fails (odd (at 0 0 0 1 1 1)))         ; expect: scope-mark: behind the name stand properties and their values, as in (scope-mark s 'wall 'material 'stone), got (y)
(fails (find-scopes house "stone"))    ; expect: find-scopes: name must be a symbol, got "stone"
(fails (find-scopes house #:where 5))  ; expect: find-scopes: #:where must be a procedure, got 5
(fails (find-scopes 5))                ; expect: find-scopes: o must be an object or a list of objects, got 5
(fails (touches? cube))                ; expect: touches?: s must be a scope, got (make-box (xyz 0 0 0) (xyz 1 1 1))
(fails (inside? (at 0 0 0 1 1 1) #:flag 5)) ; expect: inside?: flag must be a symbol, got 5
(fails (scope-signal 5 'x))            ; expect: scope-signal: s must be a scope, got 5
(fails (scope-await (at 0 0 0 1 1 1) 'x 5)) ; expect: scope-await: rule must be a rule (a procedure of a scope), an object to place, or #f, got 5
