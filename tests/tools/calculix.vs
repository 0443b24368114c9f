; A frame as an input of CalculiX: `vs tests/tools/calculix.vs -D number=N` prints the input of frame N; with -D answer=#t the
; displacements of its nodes, lines of a number and three coordinates. Each member is 16 quadratic beams, which CalculiX
; makes bricks, one across: its torsion constant is that of a section whose warping is x y.
(import (visualscheme) (visualscheme analysis))
(define-parameter number 1 #:min 1 #:max 10)
(define-parameter answer #f)
(define (some a b) (random-range (inexact a) (inexact b)))
(random-seed! (+ 100 number))

; Shapes: a cantilever, a bent one, portals, a tripod, tables, a stair of members; jittered, with random loads.
(define shape
  (list-ref
    '((((0 0 0) (3 0 0)) ((1 2)) (1)) (((0 0 0) (0 0 3) (3 0 3)) ((1 2) (2 3)) (1)) (((0 0 0) (0 0 3) (4 0 3) (4 0 0)) ((1 2) (2 3) (3 4)) (1 4))
      (((0 0 0) (0 0 3) (3 2 3)) ((1 2) (2 3)) (1 3)) (((-2 0 0) (1 2 0) (1 -2 0) (0 0 4)) ((1 4) (2 4) (3 4)) (1 2 3))
      (((0 0 0) (4 0 0) (4 4 0) (0 4 0) (0 0 3) (4 0 3) (4 4 3) (0 4 3)) ((1 5) (2 6) (3 7) (4 8) (5 6) (6 7) (7 8) (8 5)) (1 2 3 4))
      (((0 0 0) (2 0 1) (2 2 2) (0 2 3)) ((1 2) (2 3) (3 4)) (1)) (((0 0 0) (0 0 3) (0 0 6) (3 0 6) (3 0 3) (3 0 0)) ((1 2) (2 3) (3 4) (4 5) (5 6) (2 5)) (1 6))
      (((0 0 0) (3 0 0) (6 0 0) (3 3 0)) ((1 2) (2 3) (2 4)) (1 3)) (((0 0 0) (2 1 3) (5 1 3) (7 0 0)) ((1 2) (2 3) (3 4)) (1 4)))
    (- number 1)))
(define nodes (map (lambda (p) (xyz (+ (first p) (some -0.2 0.2)) (+ (second p) (some -0.2 0.2)) (+ (third p) (some -0.2 0.2)))) (first shape)))
(define members (second shape))
(define held (third shape))
(define loads (filter-map (lambda (k) (and (not (memv k held)) (list k (vxyz (some -900 900) (some -900 900) (some -900 900))))) (iota (length nodes) 1)))
(define loaded (if (null? loads) (list (list 2 (vxyz 100 200 -900))) loads))
(define e 210e9)
(define sections (map (lambda (m) (list (some 0.05 0.08) (some 0.08 0.12))) members)) ; width and height

(define (node k) (list-ref nodes (- k 1)))
(define (say . l) (for-each display l) (newline))
(define (across m) ; the member's own y, as the frame has it
  (let* ((x (unitize (p->q (node (first m)) (node (second m))))) (flat (sqrt (+ (square (cx x)) (square (cy x))))))
    (if (> flat 1e-6) (vxyz (/ (- (cy x)) flat) (/ (cx x) flat) 0) (vxyz 0 1 0))))

(define (print-input)
  (say "*NODE, NSET=ALL")
  (for-each (lambda (p k) (say k ", " (cx p) ", " (cy p) ", " (cz p))) nodes (iota (length nodes) 1))
  (for-each (lambda (m i)
              (for-each (lambda (j) (let ((p (intermediate-point (node (first m)) (node (second m)) (/ j 32.0)))) (say (+ (* 100 i) j) ", " (cx p) ", " (cy p) ", " (cz p)))) (iota 31 1)))
    members (iota (length members) 1))
  (for-each (lambda (m i s)
              (let ((at (lambda (j) (cond ((= j 0) (first m)) ((= j 32) (second m)) (else (+ (* 100 i) j))))) (y (across m)))
                (say "*ELEMENT, TYPE=B32R, ELSET=E" i)
                (for-each (lambda (j) (say (+ (* 100 i) j) ", " (at (* 2 j)) ", " (at (+ 1 (* 2 j))) ", " (at (+ 2 (* 2 j))))) (iota 16))
                (say "*BEAM SECTION, ELSET=E" i ", MATERIAL=STEEL, SECTION=RECT")
                (say (first s) ", " (second s))
                (say (cx y) ", " (cy y) ", " (cz y))))
    members (iota (length members) 1) sections)
  (say "*MATERIAL, NAME=STEEL") (say "*ELASTIC") (say e ", 0.3")
  (say "*BOUNDARY") (for-each (lambda (k) (say k ", 1, 6")) held)
  (say "*STEP") (say "*STATIC") (say "*CLOAD")
  (for-each (lambda (l) (say (first l) ", 1, " (cx (second l))) (say (first l) ", 2, " (cy (second l))) (say (first l) ", 3, " (cz (second l)))) loaded)
  (say "*NODE PRINT, NSET=ALL") (say "U") (say "*END STEP"))

(define (print-answer)
  (define r (frame-solve (frame nodes members #:supports held #:loads loaded #:materials e #:sections (map (lambda (s) (let ((b (first s)) (h (second s))) (any-section (* b h) #:iy (/ (* b h h h) 12) #:iz (/ (* h b b b) 12) #:it (/ (expt (* b h) 3) 3 (+ (* b b) (* h h)))))) sections))))
  (for-each (lambda (k) (let ((d (displacement r k))) (say k " " (cx d) " " (cy d) " " (cz d)))) (iota (length nodes) 1)))
(if answer (print-answer) (print-input))
