; (visualscheme analysis): trusses of the literature, and the linear part of a truss that snaps through
(import (visualscheme) (visualscheme analysis))
(define (say . l) (displayln l))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max (abs a) (abs b)))))
(define (within? a b part) (<= (abs (- a b)) (* part (abs b))))
(define inch 0.0254)
(define pound 4.4482216152605) ; of force, in N
(define psi (/ pound inch inch))
(define alloy (structural-material (* 1e7 psi)))
(define (in-metres l) (map (lambda (p) (apply xyz (map (lambda (x) (* x inch)) p))) l))
(define (in-newtons . l) (apply vxyz (map (lambda (x) (* x pound)) l)))

; Returns the result of a truss, from its nodes in inches, the members of each group, the areas of the groups in square inches,
; the nodes that are held, and cases.
(define (truss nodes groups areas held cases)
  (frame-solve (frame (in-metres nodes) (apply append groups) #:joints 'pinned #:materials alloy #:supports (map (lambda (n) (list n 'pinned)) held)
                 #:sections (append-map (lambda (g a) (make-list (length g) (* a inch inch))) groups areas) #:loads cases)))
; Returns the weight in pounds, at 0.1 pounds a cubic inch.
(define (weight nodes groups areas)
  (let ((at (list->vector (cons #f (map (lambda (p) (apply xyz p)) nodes)))))
    (* 0.1 (apply + (map (lambda (g a) (* a (apply + (map (lambda (m) (distance (vector-ref at (first m)) (vector-ref at (second m)))) g)))) groups areas)))))
; Returns the greatest movement of nodes along given axes in inches, and the greatest stress in psi.
(define (greatest-movement r nodes axes)
  (apply max (append-map (lambda (c) (append-map (lambda (n) (map (lambda (axis) (abs (/ (axis (displacement r n #:case c)) inch))) axes)) nodes)) (case-names r))))
(define (stresses r c groups areas) ; of each group, a list
  (let loop ((groups groups) (areas areas) (k 1))
    (if (null? groups) '()
        (cons (map (lambda (i) (/ (member-force r i #:case c) (* (car areas) inch inch) psi)) (iota (length (car groups)) k))
              (loop (cdr groups) (cdr areas) (+ k (length (car groups))))))))

; ---- 25 bars: L. A. Schmit, B. Farshi, "Some approximation concepts for structural synthesis", AIAA Journal 12, 1974; the
; areas are the optimum of L. Lamberti, "An efficient simulated annealing algorithm for design optimization of truss
; structures", Computers & Structures 86, 2008: 545.16 lb, with movements up to 0.35 in, and 6.959 ksi of compression ----
(define tower
  '((-37.5 0 200) (37.5 0 200) (-37.5 37.5 100) (37.5 37.5 100) (37.5 -37.5 100) (-37.5 -37.5 100) (-100 100 0) (100 100 0) (100 -100 0) (-100 -100 0)))
(define tower-groups
  '(((1 2)) ((1 4) (2 3) (1 5) (2 6)) ((2 4) (2 5) (1 3) (1 6)) ((3 6) (4 5)) ((3 4) (5 6)) ((3 10) (6 7) (4 9) (5 8)) ((4 7) (3 8) (5 10) (6 9)) ((6 10) (3 7) (4 8) (5 9))))
(define tower-areas '(0.01 1.987 2.9935 0.01 0.01 0.684 1.6769 2.6621))
(define tower-cases
  (list (list "I" (list 1 (in-newtons 0 20000 -5000)) (list 2 (in-newtons 0 -20000 -5000)))
        (list "II" (list 1 (in-newtons 1000 10000 -5000)) (list 2 (in-newtons 0 10000 -5000)) (list 3 (in-newtons 500 0 0)) (list 6 (in-newtons 500 0 0)))))
(define solved (truss tower tower-groups tower-areas '(7 8 9 10) tower-cases))
(say (length (apply append tower-groups)) (near? (weight tower tower-groups tower-areas) 545.16 0.01) (within? (greatest-movement solved (iota 6 1) (list cx cy cz)) 0.35 1e-5)
     (within? (apply max (map abs (list-ref (stresses solved "I" tower-groups tower-areas) 6))) 6959 1e-4))
; expect: (25 #t #t #t)

; ---- 72 bars: R. L. Fox, L. A. Schmit, "Advances in the integrated approach to structural synthesis", Journal of Spacecraft and
; Rockets 3, 1966; the areas are the optimum of R. Sedaghati, "Benchmark case studies in structural design optimization using
; the force method", International Journal of Solids and Structures 42, 2005: 379.62 lb, the top moves 0.25 in ----
(define storeys (append-map (lambda (z) (map (lambda (p) (append p (list z))) '((0 0) (120 0) (120 120) (0 120)))) '(240 180 120 60 0)))
(define storey-groups
  (append-map
    (lambda (k)
      (define (top i) (+ 1 (* 4 k) (modulo i 4)))
      (define (foot i) (+ 4 (top i)))
      (list (map (lambda (i) (list (top i) (foot i))) (iota 4)) (append-map (lambda (i) (list (list (top i) (foot (+ i 1))) (list (top (+ i 1)) (foot i)))) (iota 4))
            (map (lambda (i) (list (top i) (top (+ i 1)))) (iota 4)) (list (list (top 0) (top 2)) (list (top 1) (top 3)))))
    (iota 4)))
(define storey-areas '(0.1565 0.5456 0.4104 0.5697 0.5237 0.5171 0.1 0.1 1.268 0.5117 0.1 0.1 1.886 0.5123 0.1 0.1))
(define storey-cases (list (list "1" (list 1 (in-newtons 5000 5000 -5000))) (list "2" (list '(1 2 3 4) (in-newtons 0 0 -5000)))))
(define high (truss storeys storey-groups storey-areas '(17 18 19 20) storey-cases))
(say (length (apply append storey-groups)) (near? (weight storeys storey-groups storey-areas) 379.62 0.02) (within? (greatest-movement high '(1 2 3 4) (list cx cy)) 0.25 1e-4)
     (within? (abs (apply min (apply append (stresses high "2" storey-groups storey-areas)))) 25000 3e-4))
; expect: (72 #t #t #t)

; ---- two flat bars that snap through: the force at the movement w is 2 E A (h - w) (1 / l - 1 / L), l being the length of
; the moved bars; its slope at 0 is the stiffness of the linear frame ----
(define a 1e-3)
(define (force w h half) (let ((l (lambda (z) (sqrt (+ (* half half) (* z z)))))) (* 2 210e9 a (- h w) (- (/ (l (- h w))) (/ (l h))))))
(define (stiffness h half)
  (/ 1000 (- (cz (displacement (frame-solve (frame (list (xz (- half) 0) (xz 0 h) (xz half 0)) '((1 2) (2 3)) #:joints 'pinned #:plane 'xz #:supports '((1 pinned) (3 pinned))
                                              #:sections a #:loads (list (list 2 (vxyz 0 0 -1000))))) 2)))))
(say (map (lambda (h half) (list (same? (stiffness h half) ((derivative (lambda (w) (force w h half))) 0)) (same? (stiffness h half) (/ (* 2 210e9 a h h) (expt (sqrt (+ (* h h) (* half half))) 3)))))
       '(0.05 0.2 1 4) '(1 3 2 3)))
; expect: (((#t #t) (#t #t) (#t #t) (#t #t)))
; expect no other warnings
