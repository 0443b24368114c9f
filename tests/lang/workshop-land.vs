; terrain: it passes through all points and along every breakline; cut and fill against closed forms
(random-seed! 7)
(define (hill x y) (+ (* 3 (sin (/ x 7))) (* 2 (cos (/ y 5)))))
(define survey (for/list ([i 300]) (let ((x (random-range 0. 100)) (y (random-range 0. 80))) (xyz x y (hill x y)))))
(define border (list (xy 0 0) (xy 100 0) (xy 100 80) (xy 0 80)))
(define (at land x y) (cz (project-point land (xyz x y 1000) (vxyz 0 0 -1))))
(define (on? land p) (near? (at land (cx p) (cy p)) (cz p) 1e-6))
(define (faces land) (length (second (object-arguments land))))
; the triangles cover the rectangle once: the areas that they have from above add up
(define (covered land)
  (let ((points (list->vector (first (object-arguments land)))))
    (apply + (map (lambda (f)
                    (let ((c (map (lambda (i) (let ((p (vector-ref points (- i 1)))) (xy (cx p) (cy p)))) f)))
                      (/ (cz (cross (p->q (first c) (second c)) (p->q (first c) (third c)))) 2)))
                  (second (object-arguments land))))))
(define bare (terrain (append border survey)))
(displayln (list (surface? bare) (every (lambda (p) (on? bare p)) survey) (faces bare) (near? (covered bare) 8000 1e-6)))
; expect: (#t #t 602 #t)

; breaklines that do not cross: rays of a star, a closed curve about it, lines with several corners, and through points
(define (spot r a) (xy (+ 50 (* r (cos a))) (+ 40 (* r (sin a)))))
(define rays (for/list ([i 13]) (let ((a (* 2pi (/ i 13)))) (list (+z (spot 2 a) 20) (+z (spot 25 a) (+ 5 i))))))
(define ring (make-polygon (for/list ([i 40]) (+z (spot 30 (* 2pi (/ i 40))) (/ i 4)))))
(define road (for/list ([x (in-range 3 98 19/2)]) (xyz x (+ 4 (sin x)) (/ x 10))))
(define lines (append rays (list ring road (make-line (xyz 1 77 2) (xyz 50 78 3) (xyz 99 76 9)))))
(define (corners l) (if (list? l) l (append (first (object-arguments l)) (if (second (object-arguments l)) (list (first (first (object-arguments l)))) '()))))
(define (along? land l) (let ((c (corners l))) (every (lambda (p q) (every (lambda (t) (on? land (intermediate-point p q t))) '(0 0.01 1/3 0.5 0.77 1))) (take c (- (length c) 1)) (cdr c))))
(define land (terrain (append border survey) #:breaklines lines))
(displayln (list (every (lambda (p) (on? land p)) survey) (map (lambda (l) (along? land l)) lines) (near? (covered land) 8000 1e-6) (= (faces land) (+ 602 (* 2 (+ 26 40 10 3))))))
; expect: (#t (#t #t #t #t #t #t #t #t #t #t #t #t #t #t #t #t) #t #t)
; the old line fails: without breaklines the land does not follow them
(displayln (any (lambda (l) (along? (terrain (append border survey (append-map corners lines))) l)) lines))  ; expect: #f
; a breakline through points of the survey is divided there; one on the border changes nothing; a grid is rows of points
(define grid (for/list ([i 6]) (for/list ([j 6]) (xyz i j (* i j)))))
(define cut (terrain grid #:breaklines (list (list (xyz 0 0 0) (xyz 5 5 25)) (list (xyz 0 0 0) (xyz 0 5 0)) (list (xyz 1 0 0) (xyz 3 1 3)))))
(displayln (list (faces (terrain grid)) (faces cut) (near? (covered cut) 25) (map (lambda (t) (round (* 100 (at cut t t)))) '(0.5 1.5 2.5)) (near? (at cut 2 0.5) 1.5)))
; expect: (50 50 #t (50.0 250.0 650.0) #t)
; far from the origin, as surveys are
(define far (vxyz 350000 5700000 120))
(define moved (terrain (map (lambda (p) (p+v p far)) (append border survey)) #:breaklines (map (lambda (l) (map (lambda (p) (p+v p far)) (corners l))) lines)))
(displayln (list (= (faces moved) (faces land)) (near? (area moved) (area land) 1e-3)))  ; expect: (#t #t)

; cut and fill: planes, a wedge, a pit, a design on a part of the land, with triangles of its own
(define (plane f x0 y0 x1 y1 n) (terrain (for*/list ([i (+ n 1)] [j (+ n 1)]) (let ((x (+ x0 (* (- x1 x0) (/ i n)))) (y (+ y0 (* (- y1 y0) (/ j n))))) (xyz x y (f x y))))))
(define (moved-earth a b) (call-with-values (lambda () (cut-and-fill a b)) (lambda l (map (lambda (v) (/ (round (* 1e4 v)) 1e4)) l))))
(define slope (plane (lambda (x y) x) 0 0 10 10 5))
(displayln (moved-earth slope (plane (lambda (x y) 5) 0 0 10 10 3)))       ; expect: (125.0 125.0)
(displayln (moved-earth slope (plane (lambda (x y) 2) 0 0 10 10 1)))       ; expect: (320.0 20.0)
(displayln (moved-earth slope slope))                                      ; expect: (0.0 0.0)
(displayln (moved-earth slope (plane (lambda (x y) 6) 4 2 9 7 1)))         ; expect: (22.5 10.0)
(displayln (moved-earth (plane (lambda (x y) 0) 0 0 10 10 1) (plane (lambda (x y) (- y 5)) -5 0 25 10 2))) ; expect: (125.0 125.0)
(displayln (moved-earth (plane (lambda (x y) 0) 0 0 4 4 1) (plane (lambda (x y) 1) 6 0 9 4 1)))  ; expect: (0.0 0.0)
(define pit (terrain (list (xyz 0 0 0) (xyz 6 0 0) (xyz 6 6 0) (xyz 0 6 0) (xyz 3 3 -4))))
(displayln (moved-earth (plane (lambda (x y) 0) -1 -1 7 7 1) pit))         ; expect: (48.0 0.0)

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (c (#t (condition/report-string c))) e "no error")))))
(fails (terrain (list origin (xy 1 1))))                   ; expect: terrain: points must hold 3 points or more, got 2
(fails (terrain (list origin (xy 1 1) (xy 2 2))))          ; expect: terrain: points must be three or more that do not lie on one line, seen from above
(fails (terrain (list origin (xy 1 0) (xyz 0 1 2) (xyz 0 1 3))))  ; expect: terrain: points at (xy 0 1) have two heights, 2 and 3; omit one of them
(fails (terrain grid #:breaklines (list (list (xy 0.5 0.5) (xyz 4.5 4 0)) (list (xy 0.5 4) (xyz 4 0.5 0))))) ; expect: terrain: breaklines must not cross; two cross at (xy 2.366667 2.133333): they need a point there
(fails (terrain grid #:breaklines (list 3)))               ; expect: terrain: breaklines must be a list of curves and lists of points, got 3
(fails (cut-and-fill slope (make-sphere origin 1)))        ; expect: cut-and-fill: design must be a surface, such as (terrain points), got (make-sphere (xyz 0 0 0) 1)
(fails (cut-and-fill (make-3dface origin (xy 1 0) (xyz 1 0 1) (xyz 0 0 1)) slope)) ; expect: cut-and-fill: land must be a surface without upright faces, got (make-polyface-mesh (list (xyz 0 0 0) (xyz 1 0 0) (xyz 1 0 1) (xyz 0 0 1)) '((1 2 3) (1 3 4)))
