; meshes that are wrong in fifty ways: an error that says which faces, a surface where nothing is enclosed, or with #:repair a solid; never a wrong one
(define-syntax try
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (error-object-message c))))
             (let ((o e)) (displayln (list (cond ((solid? o) 'solid) ((surface? o) 'surface) (else 'empty)) (if (solid? o) (/ (round (* 1e9 (volume o))) 1e9) 0))))))))
(define (cube x s) (map (lambda (i) (xyz (+ x (* s (modulo i 2))) (* s (modulo (quotient i 2) 2)) (* s (quotient i 4)))) (iota 8)))
(define faces '((1 3 4 2) (5 6 8 7) (1 2 6 5) (3 7 8 4) (1 5 7 3) (2 4 8 6)))
(define (further n fs) (map (lambda (f) (map (lambda (i) (+ i n)) f)) fs))
; strips of n quads, twisted k half turns
(define (strip n k)
  (values (append (map (lambda (i) (let ((a (* 2 pi (/ i n))) (b (* k pi (/ i n)))) (xyz (* (+ 3 (cos b)) (cos a)) (* (+ 3 (cos b)) (sin a)) (sin b)))) (iota n))
                  (map (lambda (i) (let ((a (* 2 pi (/ i n))) (b (+ pi (* k pi (/ i n))))) (xyz (* (+ 3 (cos b)) (cos a)) (* (+ 3 (cos b)) (sin a)) (sin b)))) (iota n)))))
(define n 12)
(define (mobius-faces) (append (map (lambda (i) (list (+ i 1) (+ i 2) (+ i n 2) (+ i n 1))) (iota (- n 1))) (list (list n (+ n 1) 1 (+ n n)))))
; moebius
(try (make-polyface-mesh (strip n 1) (mobius-faces))) ; expect: (surface 0)
(try (make-polyface-mesh (strip n 1) (mobius-faces) #:repair #t)) ; expect: (solid 11.700659333)
; duplicated face
(try (make-polyface-mesh (cube 0 1) (append faces (list (car faces))))) ; expect: (surface 0)
(try (make-polyface-mesh (cube 0 1) (append faces (list (car faces))) #:repair #t)) ; expect: (solid 1.0)
; duplicated reversed
(try (make-polyface-mesh (cube 0 1) (append faces (list (reverse (car faces)))))) ; expect: (surface 0)
(try (make-polyface-mesh (cube 0 1) (append faces (list (reverse (car faces)))) #:repair #t)) ; expect: (solid 1.0)
; all twice
(try (make-polyface-mesh (cube 0 1) (append faces faces))) ; expect: make-polyface-mesh: the faces cross or overlap: at face 1, near (xyz 0.5 0.4871 0) and at 5 places more; #:repair #t makes one solid of them
(try (make-polyface-mesh (cube 0 1) (append faces faces) #:repair #t)) ; expect: (solid 1.0)
; all twice, once reversed
(try (make-polyface-mesh (cube 0 1) (append faces (map reverse faces)))) ; expect: (surface 0)
(try (make-polyface-mesh (cube 0 1) (append faces (map reverse faces)) #:repair #t)) ; expect: (empty 0)
; zero-area face
(try (make-polyface-mesh (append (cube 0 1) (list (xyz 0.5 0 0))) (append faces '((1 9 2))))) ; expect: (surface 0)
(try (make-polyface-mesh (append (cube 0 1) (list (xyz 0.5 0 0))) (append faces '((1 9 2))) #:repair #t)) ; expect: (solid 1.0)
; t-junction
(try (make-polyface-mesh (append (cube 0 1) (list (xyz 0.5 0 0))) (append '((1 9 6 5) (9 2 6)) (list (list-ref faces 0) (list-ref faces 1) (list-ref faces 3) (list-ref faces 4) (list-ref faces 5))))) ; expect: (surface 0)
(try (make-polyface-mesh (append (cube 0 1) (list (xyz 0.5 0 0))) (append '((1 9 6 5) (9 2 6)) (list (list-ref faces 0) (list-ref faces 1) (list-ref faces 3) (list-ref faces 4) (list-ref faces 5))) #:repair #t)) ; expect: (solid 1.0)
; mixed orientation
(try (make-polyface-mesh (cube 0 1) (append (map reverse (list-head faces 3)) (list-tail faces 3)))) ; expect: (solid 1.0)
(try (make-polyface-mesh (cube 0 1) (append (map reverse (list-head faces 3)) (list-tail faces 3)) #:repair #t)) ; expect: (solid 1.0)
; inside out
(try (make-polyface-mesh (cube 0 1) (map reverse faces))) ; expect: (solid 1.0)
(try (make-polyface-mesh (cube 0 1) (map reverse faces) #:repair #t)) ; expect: (solid 1.0)
; nested inside out
(try (make-polyface-mesh (append (cube 0 1) (map (lambda (p) (mid p (xyz .5 .5 .5))) (cube 0 1))) (append faces (further 8 (map reverse faces))))) ; expect: (solid 0.875)
(try (make-polyface-mesh (append (cube 0 1) (map (lambda (p) (mid p (xyz .5 .5 .5))) (cube 0 1))) (append faces (further 8 (map reverse faces))) #:repair #t)) ; expect: (solid 0.875)
; nested both out
(try (make-polyface-mesh (append (cube 0 1) (map (lambda (p) (mid p (xyz .5 .5 .5))) (cube 0 1))) (append faces (further 8 faces)))) ; expect: make-polyface-mesh: the faces cross or overlap: at face 7, near (xyz 0.5 0.49355 0.25) and at 5 places more; #:repair #t makes one solid of them
(try (make-polyface-mesh (append (cube 0 1) (map (lambda (p) (mid p (xyz .5 .5 .5))) (cube 0 1))) (append faces (further 8 faces)) #:repair #t)) ; expect: (solid 1.0)
(define t1 '((1 3 2) (1 2 4) (2 3 4) (3 1 4)))
(define tp (list (xyz 0 0 0) (xyz 1 0 0) (xyz 0 1 0) (xyz 0 0 1)))
; two tetrahedra on an edge
(try (make-polyface-mesh (append tp (list (xyz 0 -1 0) (xyz 0 -1 -1))) (append t1 '((1 5 2) (1 2 6) (2 5 6) (5 1 6))))) ; expect: (solid 0.333333333)
(try (make-polyface-mesh (append tp (list (xyz 0 -1 0) (xyz 0 -1 -1))) (append t1 '((1 5 2) (1 2 6) (2 5 6) (5 1 6))) #:repair #t)) ; expect: (solid 0.333333333)
; two tetrahedra at a corner
(try (make-polyface-mesh (append tp (list (xyz -1 0 0) (xyz 0 -1 0) (xyz 0 0 -1))) (append t1 '((1 6 5) (1 5 7) (5 6 7) (6 1 7))))) ; expect: (surface 0)
(try (make-polyface-mesh (append tp (list (xyz -1 0 0) (xyz 0 -1 0) (xyz 0 0 -1))) (append t1 '((1 6 5) (1 5 7) (5 6 7) (6 1 7))) #:repair #t)) ; expect: (solid 0.333333333)
; nan
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz (/ 0. 0.) 0 0) (xyz 0 1 0) (xyz 0 0 1)) t1)) ; expect: xyz: x must be finite, got
; index 0
(try (make-polyface-mesh tp '((0 1 2)))) ; expect: make-polyface-mesh: faces must be lists of exact integers from 1, got
(try (make-polyface-mesh tp '((0 1 2)) #:repair #t)) ; expect: make-polyface-mesh: faces must be lists of exact integers from 1, got
; index out
(try (make-polyface-mesh tp '((1 3 9)))) ; expect: make-polyface-mesh: face 1 refers to point 9, but there are 4 points, counted from 1
(try (make-polyface-mesh tp '((1 3 9)) #:repair #t)) ; expect: make-polyface-mesh: face 1 refers to point 9, but there are 4 points, counted from 1
; index repeated
(try (make-polyface-mesh tp '((1 1 2) (1 3 2) (1 2 4) (2 3 4) (3 1 4)))) ; expect: make-polyface-mesh: face 1 uses point 1 twice
(try (make-polyface-mesh tp '((1 1 2) (1 3 2) (1 2 4) (2 3 4) (3 1 4)) #:repair #t)) ; expect: make-polyface-mesh: face 1 uses point 1 twice
; two corners
(try (make-polyface-mesh tp '((1 2)))) ; expect: make-polyface-mesh: faces must be a list of faces, each a list of three or more indices from 1, got
(try (make-polyface-mesh tp '((1 2)) #:repair #t)) ; expect: make-polyface-mesh: faces must be a list of faces, each a list of three or more indices from 1, got
; no faces
(try (make-polyface-mesh tp '())) ; expect: (empty 0)
(try (make-polyface-mesh tp '() #:repair #t)) ; expect: (empty 0)
; no points
(try (make-polyface-mesh '() '())) ; expect: (empty 0)
(try (make-polyface-mesh '() '() #:repair #t)) ; expect: (empty 0)
; fraction
(try (make-polyface-mesh tp '((1 2.5 3)))) ; expect: make-polyface-mesh: faces must be lists of exact integers from 1, got
(try (make-polyface-mesh tp '((1 2.5 3)) #:repair #t)) ; expect: make-polyface-mesh: faces must be lists of exact integers from 1, got
; one point everywhere
(try (make-polyface-mesh (map (lambda (i) (xyz 1 1 1)) (iota 4)) t1)) ; expect: (empty 0)
(try (make-polyface-mesh (map (lambda (i) (xyz 1 1 1)) (iota 4)) t1 #:repair #t)) ; expect: (empty 0)
; flat
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 1 0 0) (xyz 0 1 0) (xyz 1 1 0)) t1)) ; expect: (surface 0)
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 1 0 0) (xyz 0 1 0) (xyz 1 1 0)) t1 #:repair #t)) ; expect: (surface 0)
; huge
(try (make-polyface-mesh (map (lambda (p) (* 1e59 1) (xyz (* 1e59 (cx p)) (* 1e59 (cy p)) (* 1e59 (cz p)))) tp) t1)) ; expect: (solid 1.6666666666666664e176)
(try (make-polyface-mesh (map (lambda (p) (* 1e59 1) (xyz (* 1e59 (cx p)) (* 1e59 (cy p)) (* 1e59 (cz p)))) tp) t1 #:repair #t)) ; expect: (solid 1.6666666666666664e176)
; tiny
(try (make-polyface-mesh (map (lambda (p) (xyz (* 1e-30 (cx p)) (* 1e-30 (cy p)) (* 1e-30 (cz p)))) tp) t1)) ; expect: (solid 0.0)
(try (make-polyface-mesh (map (lambda (p) (xyz (* 1e-30 (cx p)) (* 1e-30 (cy p)) (* 1e-30 (cz p)))) tp) t1 #:repair #t)) ; expect: (solid 0.0)
; tiny and huge
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 1e20 0 0) (xyz 0 1 0) (xyz 0 0 1)) t1)) ; expect: (empty 0)
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 1e20 0 0) (xyz 0 1 0) (xyz 0 0 1)) t1 #:repair #t)) ; expect: (empty 0)
; far away
(try (make-polyface-mesh (map (lambda (p) (xyz (+ 1e9 (cx p)) (cy p) (cz p))) tp) t1)) ; expect: (solid 0.166666667)
(try (make-polyface-mesh (map (lambda (p) (xyz (+ 1e9 (cx p)) (cy p) (cz p))) tp) t1 #:repair #t)) ; expect: (solid 0.166666667)
; too far away
(try (make-polyface-mesh (map (lambda (p) (xyz (+ 1e17 (cx p)) (cy p) (cz p))) tp) t1)) ; expect: (surface 0)
(try (make-polyface-mesh (map (lambda (p) (xyz (+ 1e17 (cx p)) (cy p) (cz p))) tp) t1 #:repair #t)) ; expect: (empty 0)
; bow-tie face
(try (make-polyface-mesh (cube 0 1) (cons '(1 4 3 2) (cdr faces)))) ; expect: (surface 0)
(try (make-polyface-mesh (cube 0 1) (cons '(1 4 3 2) (cdr faces)) #:repair #t)) ; expect: (solid 1.0)
; face not flat
(try (make-polyface-mesh (append (list-head (cube 0 1) 7) (list (xyz 1.2 1.3 1.4))) faces)) ; expect: (solid 1.3)
(try (make-polyface-mesh (append (list-head (cube 0 1) 7) (list (xyz 1.2 1.3 1.4))) faces #:repair #t)) ; expect: (solid 1.3)
; concave face
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 4 0 0) (xyz 4 4 0) (xyz 2 1 0) (xyz 0 0 1) (xyz 4 0 1) (xyz 4 4 1) (xyz 2 1 1)) '((4 3 2 1) (5 6 7 8) (1 2 6 5) (2 3 7 6) (3 4 8 7) (4 1 5 8)))) ; expect: (solid 6.0)
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 4 0 0) (xyz 4 4 0) (xyz 2 1 0) (xyz 0 0 1) (xyz 4 0 1) (xyz 4 4 1) (xyz 2 1 1)) '((4 3 2 1) (5 6 7 8) (1 2 6 5) (2 3 7 6) (3 4 8 7) (4 1 5 8)) #:repair #t)) ; expect: (solid 6.0)
; three sheets on an edge
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 0 0 1) (xyz 1 0 0) (xyz -1 1 0) (xyz -1 -1 0)) '((1 2 3) (1 2 4) (1 2 5)))) ; expect: (surface 0)
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 0 0 1) (xyz 1 0 0) (xyz -1 1 0) (xyz -1 -1 0)) '((1 2 3) (1 2 4) (1 2 5)) #:repair #t)) ; expect: (surface 0)
; self-touching at a corner of a face
(try (make-polyface-mesh (append (cube 0 1) (list (xyz .5 .5 1) (xyz .2 .2 2) (xyz .8 .2 2) (xyz .5 .8 2))) (append faces '((9 11 10) (9 12 11) (9 10 12) (10 11 12))))) ; expect: (solid 1.06)
(try (make-polyface-mesh (append (cube 0 1) (list (xyz .5 .5 1) (xyz .2 .2 2) (xyz .8 .2 2) (xyz .5 .8 2))) (append faces '((9 11 10) (9 12 11) (9 10 12) (10 11 12))) #:repair #t)) ; expect: (solid 1.06)
; poking through
(try (make-polyface-mesh (append (cube 0 1) (list (xyz .5 .5 .9) (xyz .2 .2 2) (xyz .8 .2 2) (xyz .5 .8 2))) (append faces '((9 11 10) (9 12 11) (9 10 12) (10 11 12))))) ; expect: make-polyface-mesh: the faces cross or overlap: at face 2, near (xyz 0.5 0.499296 1) and at 3 places more; #:repair #t makes one solid of them
(try (make-polyface-mesh (append (cube 0 1) (list (xyz .5 .5 .9) (xyz .2 .2 2) (xyz .8 .2 2) (xyz .5 .8 2))) (append faces '((9 11 10) (9 12 11) (9 10 12) (10 11 12))) #:repair #t)) ; expect: (solid 1.065950413)
; boxes sharing a face, kept
(try (make-polyface-mesh (append (cube 0 1) (cube 1 1)) (append faces (further 8 faces)))) ; expect: (solid 2.0)
(try (make-polyface-mesh (append (cube 0 1) (cube 1 1)) (append faces (further 8 faces)) #:repair #t)) ; expect: (solid 2.0)
; of one size, apart, one of them inside out
(try (make-polyface-mesh (append (cube 0 1) (cube 3 1)) (append faces (further 8 (map reverse faces))))) ; expect: make-polyface-mesh: the faces are inside out in part: at face 7, near (xyz 3.5 0.4871 0) and at 5 places more; #:repair #t makes one solid of them
(try (make-polyface-mesh (append (cube 0 1) (cube 3 1)) (append faces (further 8 (map reverse faces))) #:repair #t)) ; expect: (solid 2.0)
; the same all but in one place
(try (make-polyface-mesh (append (cube 0 1) (cube 1e-9 1)) (append faces (further 8 (map reverse faces))))) ; expect: (solid 1e-9)
; boxes overlapping coplanar
(try (make-polyface-mesh (append (cube 0 1) (cube .5 1)) (append faces (further 8 faces)))) ; expect: make-polyface-mesh: the faces cross or overlap: at face 1, near (xyz 0.75 0.4871 0) and at 5 places more; #:repair #t makes one solid of them
(try (make-polyface-mesh (append (cube 0 1) (cube .5 1)) (append faces (further 8 faces)) #:repair #t)) ; expect: (solid 1.5)
; pinched
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 1 1 0) (xyz 1 -1 0) (xyz 1 0 1) (xyz -1 1 0) (xyz -1 -1 0) (xyz -1 0 1)) '((1 2 3) (1 4 2) (1 3 4) (2 4 3) (1 6 5) (1 5 7) (1 7 6) (5 6 7)))) ; expect: (solid 0.666666667)
(try (make-polyface-mesh (list (xyz 0 0 0) (xyz 1 1 0) (xyz 1 -1 0) (xyz 1 0 1) (xyz -1 1 0) (xyz -1 -1 0) (xyz -1 0 1)) '((1 2 3) (1 4 2) (1 3 4) (2 4 3) (1 6 5) (1 5 7) (1 7 6) (5 6 7)) #:repair #t)) ; expect: (solid 0.666666667)
; cube missing a triangle
(try (make-polyface-mesh (cube 0 1) (append '((1 3 4)) (cdr faces)))) ; expect: (surface 0)
(try (make-polyface-mesh (cube 0 1) (append '((1 3 4)) (cdr faces)) #:repair #t)) ; expect: (solid 1.0)
; only one triangle
(try (make-polyface-mesh tp '((1 2 3)))) ; expect: (surface 0)
(try (make-polyface-mesh tp '((1 2 3)) #:repair #t)) ; expect: (surface 0)
; two triangles back to back
(try (make-polyface-mesh tp '((1 2 3) (3 2 1)))) ; expect: (surface 0)
(try (make-polyface-mesh tp '((1 2 3) (3 2 1)) #:repair #t)) ; expect: (empty 0)
