; meshes: from files beside the program and face by face; what is wrong with them, and mending
(define (about x y) (displayln (near? x y (* 1e-9 (abs y)))))
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (display (error-object-message c)) (display " ") (displayln (error-object-irritants c)))) e (displayln "no error")))))
(define-syntax crosses ; which of the faces is named first is the kernel's business
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (map (lambda (part) (string-contains? (error-object-message c) part)) '("the faces cross or overlap: at face " "near (xyz " "places more; #:repair #t")))))
             e (displayln "no error")))))
(define cube (load-mesh "lib/meshes/cube.off"))
(displayln (list (volume cube) (object-kind cube) (bounding-box cube))) ; expect: (1.0 polyface-mesh ((xyz 0 0 0) (xyz 1 1 1)))
(displayln (volume (subtract cube (translate cube (vxyz 0.5 0.5 0.5))))) ; expect: 0.875
(fails (load-mesh "lib/meshes/nothing.stl"))         ; expect: load-mesh: cannot open tests/lang/lib/meshes/nothing.stl: no such file ()
(fails (load-mesh "lib/meshes/cube.dxf"))            ; expect: load-mesh: file must be a name that ends in .stl, .obj, .off or .ply, got (lib/meshes/cube.dxf)
(fails (load-mesh 'cube))                            ; expect: load-mesh: file must be a string ("cube"?), got (cube)
(fails (load-mesh "lib/meshes/open.off"))            ; expect: load-mesh: open.off: the mesh is open at the edge from (xyz 1 0 0) to (xyz 1 1 0) of face 1, and at 3 edges more; #:repair #t closes it ()
(fails (load-mesh "lib/meshes/bad.stl"))             ; expect: load-mesh: bad.stl: line 6: expected a number, got "x" ()
(fails (load-mesh "lib/meshes/index.obj"))           ; expect: load-mesh: index.obj: face 4 refers to point 5, but there are 4 ()
(fails (load-mesh "lib/meshes/huge.ply"))            ; expect: load-mesh: huge.ply: line 10: the file is cut off: it is too short for 4000000000 of element vertex ()
(about (volume (load-mesh "lib/meshes/strips.ply")) 1/3)   ; expect: #t
(fails (load-mesh "lib/meshes/sheet.off" #:repair #t)) ; expect: load-mesh: sheet.off: the faces are a surface, which encloses nothing: make-polyface-mesh makes one of them ()
(crosses (load-mesh "lib/meshes/crossing.obj"))      ; expect: (#t #t #t)
(displayln (volume (load-mesh "lib/meshes/open.off" #:repair #t))) ; expect: 1.0
(define whole (load-mesh "lib/meshes/crossing.obj" #:repair #t))
(define (tetrahedron . corners) (make-polyface-mesh corners '((1 3 2) (1 2 4) (2 3 4) (3 1 4))))
(about (volume whole)                                ; expect: #t
       (volume (unite (tetrahedron origin (xyz 1 0 0) (xyz 0 1 0) (xyz 0 0 1)) (tetrahedron (xyz .2 .2 -.5) (xyz .9 .2 0) (xyz .2 .9 0) (xyz .2 .2 .5)))))

(define corners (map (lambda (i) (xyz (modulo i 2) (modulo (quotient i 2) 2) (quotient i 4))) (iota 8)))
(define faces '((1 3 4 2) (5 6 8 7) (1 2 6 5) (3 7 8 4) (1 5 7 3) (2 4 8 6)))
(define (further fs) (map (lambda (f) (map (lambda (i) (+ i 8)) f)) fs))
(define (moved v) (append corners (map (lambda (p) (+ p v)) corners)))
(define small (append corners (map (lambda (p) (mid p (xyz 0.5 0.5 0.5))) corners)))
(displayln (volume (make-polyface-mesh corners (map reverse faces)))) ; expect: 1.0
(displayln (list (surface? (make-polyface-mesh corners (cdr faces))) (volume (make-polyface-mesh corners (cdr faces) #:repair #t)))) ; expect: (#t 1.0)
(displayln (volume (make-polyface-mesh corners (cons (reverse (car faces)) (cdr faces))))) ; expect: 1.0
(displayln (volume (make-polyface-mesh (moved (vxyz 2 0 0)) (append faces (further faces))))) ; expect: 2.0
(displayln (volume (make-polyface-mesh (moved (vxyz 1 0 0)) (append faces (further faces))))) ; expect: 2.0
(displayln (volume (make-polyface-mesh small (append faces (further (map reverse faces)))))) ; expect: 0.875
(crosses (make-polyface-mesh small (append faces (further faces)))) ; expect: (#t #t #t)
(displayln (volume (make-polyface-mesh small (append faces (further faces)) #:repair #t))) ; expect: 1.0
(displayln (volume (make-polyface-mesh (moved (vxyz 0.5 0.5 0.5)) (append faces (further faces)) #:repair #t))) ; expect: 1.875
(displayln (volume (make-polyface-mesh (moved (vxyz 1e-8 0 0)) (append (list-head faces 3) (further (list-tail faces 3))) #:repair #t))) ; expect: 1.0
(displayln (volume (make-polyface-mesh corners (append faces (list (car faces) (cadr faces) (reverse (cadr faces)))) #:repair #t))) ; expect: 1.0
(fails (make-polyface-mesh corners faces #:repair 1)) ; expect: make-polyface-mesh: repair must be #t or #f, got (1)
(make-polyface-mesh corners (cdr faces) #:repair #t) ; expect warning: repaired: closed 1 hole
