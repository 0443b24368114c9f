; object-kind, object-arguments and object-children say enough to make any object again: an equal one.
(define drawn '())
(define (draw . objects) (set! drawn (append (filter object? (flatten objects)) drawn)) (unite objects))

; the last argument of what is round is the facets a turn, where they were given
(define (round-one make count args)
  (if (> (length args) count) (apply make (append (take args count) (list '#:segments (last args)))) (apply make args)))

(define (rows points columns) (if (null? points) '() (cons (take points columns) (rows (drop points columns) columns))))

(define (again kind args kids)
  (define (a i) (list-ref args i))
  (define (segments i) (and (> (length args) i) (a i)))
  (case kind
    [(empty-object) (empty-object)]
    [(line) (if (a 1) (make-polygon (a 0)) (make-line (a 0)))]
    [(arc) (make-arc (a 0) (a 1) (a 2) (a 3) #:segments (segments 4))]
    [(circle) (make-circle (a 0) (a 1) #:segments (segments 2))]
    [(spline)
     (let ([points (if (a 1) (append (a 0) (list (car (a 0)))) (a 0))])
       (if (and (= 0 (vlength (a 2))) (= 0 (vlength (a 3)))) (make-spline points #:segments (segments 4)) (make-spline points (a 2) (a 3) #:segments (segments 4))))]
    [(join-curves) (apply join-curves kids)]
    [(xline) (make-xline (a 0) (a 1))]
    [(ray) (make-ray (a 0) (a 1))]
    [(region) (apply make-region kids)]
    [(text) (make-text (a 0) (a 1) (a 2) #:align (string->symbol (a 4)) #:valign (string->symbol (a 5)) #:spacing (a 6))]
    [(box) (make-box (a 0) (a 1))]
    [(wedge) (make-wedge (a 0) (a 1))]
    [(sphere) (make-sphere (a 0) (a 1) #:segments (segments 2))]
    [(cylinder) (make-cylinder (a 0) (a 1) (a 2) #:segments (segments 3))]
    [(cone) (make-cone (a 0) (a 1) (a 2) #:segments (segments 3))]
    [(cut-cone) (make-cut-cone (a 0) (a 1) (a 2) (a 3) #:segments (segments 4))]
    [(e-cone) (make-e-cone (a 0) (a 1) (a 2) (a 3) (a 4) #:segments (segments 5))]
    [(pyramid) (make-pyramid (a 0) (a 1) (a 2) (a 3) (a 4))]
    [(torus) (make-torus (a 0) (a 1) (a 2) #:segments (segments 3))]
    [(superellipsoid) (make-superellipsoid (a 0) (a 1) (a 2) #:segments (segments 3))]
    [(half-space) (make-half-space (make-plane (a 0) (a 1)))]
    [(polyface-mesh) (make-polyface-mesh (a 0) (a 1))]
    [(mesh) (make-mesh (rows (a 0) (a 1)) #:closed-u (a 2) #:closed-v (a 3))]
    [(extrude) (do-extrude (car kids) (if (null? (cdr kids)) (a 0) (cadr kids)) (a 1) #:twist (a 2) #:scale (a 3) #:centre (a 4))]
    [(sweep) (if (a 2) (do-sweep (car kids) (cadr kids) (a 0) (a 1) #:base (a 3)) (do-sweep (car kids) (cadr kids) (a 0) (a 1)))]
    [(thicken) (do-thicken (car kids) (a 0) #:segments (segments 1))]
    [(slice) (do-slice (car kids) (make-plane (a 0) (a 1)))]
    [(revolve) (do-revolve (car kids) (make-axis (a 0) (a 1)) (a 2) (a 3) #:segments (segments 4))]
    [(loft) (do-loft kids (a 0) (a 1) (a 2) (a 3))]
    [(ruled-loft) (do-ruled-loft kids)]
    [(guided-loft) (do-guided-loft (take kids (a 0)) (if (a 1) (list-ref kids (a 0)) (drop kids (a 0))))]
    [(offset) (do-offset (car kids) (a 0) #:corners (string->symbol (a 1)))]
    [(section) (do-section (car kids) (make-plane (a 0) (a 1)))]
    [(project) (do-project (car kids) (make-plane (a 0) (a 1)))]
    [(edges) (do-edges (car kids))]
    [(transform) (do-transform (car kids) (a 0))]
    [(with-material) (with-material (a 0) (car kids))]
    [(layer) (layer (a 0) (car kids))]
    [(native) (native (string->symbol (a 0)) (a 1) #:otherwise (car kids))]
    [(highlight) (highlight (car kids))]
    [(ghost) (ghost (car kids))]
    [(only) (only (car kids))]
    [(unite) (apply unite kids)]
    [(intersect) (apply intersect kids)]
    [(subtract) (apply subtract kids)]
    [(hull) (hull (a 0) kids)]
    [(arch) (apply arch args)]
    [else (error "no way to make it again:" kind)]))
(define (rebuild o) (again (object-kind o) (object-arguments o) (map rebuild (object-children o))))

(define (check name objects)
  (let ([bad (filter (lambda (o) (not (equal? o (rebuild o)))) objects)])
    (printf "~a ~a\n" name (if (null? bad) 'same (map object-kind bad)))))

(define-primitive (arch [span positive?]) (do-extrude (subtract (make-rectangle (xy -3 0) (xy 3 4)) (make-circle origin (/ span 2))) 1))
(define box (make-box origin (xyz 1 2 3)))
(define ring (make-circle (xyz 3 0 0) 1))
(check "one of each"
  (list (empty-object) (make-line (xy 0 0) (xy 1 1)) (make-polygon (xy 0 0) (xy 1 1) (xy 2 0)) (make-arc origin 1 0 1) (make-arc origin 1 0 1 #:segments 7) ring
        (make-spline (xy 0 0) (xy 1 1) (xy 2 0)) (make-spline (list (xy 0 0) (xy 1 1) (xy 2 0)) ux uy) (make-spline (xy 0 0) (xy 1 1) (xy 2 0) (xy 0 0))
        (join-curves (make-line (xy 0 0) (xy 1 0)) (make-line (xy 1 0) (xy 1 1))) (make-xline origin (xyz 1 1 1)) (make-ray origin ux) (make-region ring)
        (make-text origin 1 "Ab" #:align 'center #:valign 'top #:spacing 1.5) box (make-wedge origin (xyz 1 1 1)) (make-sphere origin 1 #:segments 9) (make-cylinder origin 3 1)
        (make-cone origin (xyz 0 0 2) 1) (make-cut-cone origin 1 (xyz 0 0 2) 0.5) (make-e-cone origin 1 2 (xyz 0 0 3) 0.5) (make-pyramid origin 1 5 (xyz 0 0 2)) (make-torus origin 3 1)
        (make-superellipsoid 0.5 0.7 2) (make-polyface-mesh (list origin (xyz 1 0 0) (xyz 0 1 0) (xyz 0 0 1)) '((1 3 2) (1 2 4) (2 3 4) (3 1 4)))
        (make-mesh (list (list origin (xyz 1 0 0)) (list (xyz 0 1 0) (xyz 1 1 1)))) (do-extrude ring 2 0.1) (do-extrude ring (make-line origin (xyz 0 0 3) (xyz 1 0 5)))
        (do-extrude (make-region ring) 2 #:twist 1 #:centre #t) (do-sweep ring (make-line origin (xyz 0 0 5)) 1 2) (do-thicken ring 0.2) (do-slice (make-sphere origin 2) 'yz) (do-revolve ring 'y 0 1)
        (do-loft (list ring (do-move ring uz) (do-move ring (vxyz 1 0 2))) 0.1 1 0 0) (do-ruled-loft (list ring (do-move ring uz)))
        (do-guided-loft (list ring (do-move ring uz)) (make-line (xyz 3 0 0) (xyz 3 0 1))) (do-offset ring 0.5) (do-offset (make-rectangle (xy 0 0) (xy 1 2)) 1 #:corners 'round)
        (do-section box (make-plane (xyz 0 0 1) uz)) (do-project box 'xy) (do-edges box) (do-rotate box 'z 1) (with-material steel box) (color "#123456" box)
        (with-material (make-material #:name "oak" #:roughness 0.3) box) (layer "a \"b\"" box) (native 'povray "sphere { 0, 1 }" #:otherwise box) (highlight box) (ghost box) (only box)
        (unite box ring) (intersect box (make-half-space 'xy)) (subtract box (make-sphere origin 1)) (hull box (make-sphere (xyz 5 5 5) 1) (xyz 9 9 9)) (arch 2)))
; expect: one of each same
(for ([name '("cylinder-grid" "doric-columns" "gare-do-oriente" "rotunda" "twisted-tower")])
  (set! drawn '())
  (load (string-append "../../examples/" name ".vs"))
  (check name drawn)
  (displayln (> (length drawn) 0)))
; expect: cylinder-grid same
; expect: #t
; expect: doric-columns same
; expect: #t
; expect: gare-do-oriente same
; expect: #t
; expect: rotunda same
; expect: #t
; expect: twisted-tower same
; expect: #t
