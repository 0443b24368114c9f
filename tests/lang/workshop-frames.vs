; Frames: counts by Euler's formula, bars without overlap at mitres, flat hexagons; bricks that do not overlap.
(define (total l) (apply + l))
(define (overlap l) (- (total (map volume l)) (volume (unite l))))

(define (shared l) ; the volume that two of them share
  (if (null? l) 0 (+ (shared (cdr l)) (total (map (lambda (o) (volume (intersect (car l) o))) (cdr l))))))

; geodesic spheres: 10 n^2 + 2 points, 30 n^2 edges, 20 n^2 triangles, all points on the sphere
(for ([n '(1 2 3 5)])
  (define panels (geodesic-panels n 2 #:center (xyz 1 2 3)))
  (define net (panel-net panels))
  (displayln (list (= (length panels) (* 20 n n)) (= (length (first net)) (+ 2 (* 10 n n))) (= (length (second net)) (* 30 n n))
                   (every (lambda (p) (near? (distance p (xyz 1 2 3)) 2)) (first net)))))
; expect: (#t #t #t #t)
; expect: (#t #t #t #t)
; expect: (#t #t #t #t)
; expect: (#t #t #t #t)

; the cells are flat, and those about one corner share their edges
(define cells (geodesic-panels 4 1 #:cells 'hexagons))
(define (off-plane l)
  (let ((n (unitize (cross (p->q (first l) (second l)) (p->q (first l) (third l))))))
    (apply max (map (lambda (p) (abs (dot n (p->q (first l) p)))) l))))
(displayln (list (length cells) (length (filter (lambda (c) (= (length c) 5)) cells)) (< (apply max (map off-plane cells)) 1e-12)))
; expect: (162 12 #t)
(displayln (map length (panel-net cells)))
; expect: (320 480)

; outwards: the triangles close to a solid with nothing turned
(define numbered (panel-net (geodesic-panels 2 1)))
(displayln (every (lambda (c) (> (dot (cross (p->q (first c) (second c)) (p->q (first c) (third c))) (p->q origin (first c))) 0))
                  (append (geodesic-panels 3 1) cells)))
; expect: #t

; balls and bars; nodes without bars are no balls
(define corner (list (list origin (xy 4 0) (xyz 0 3 0) (xyz 0 0 3) (xyz 9 9 9)) '((1 2) (1 3) (1 4))))
(define parts (frame-members corner 0.2 #:node-radius 0.5))
(displayln (map object-kind parts))
; expect: (sphere sphere sphere sphere cylinder cylinder cylinder)

; mitred bars meet without overlap and without a gap, in any number
(define bent (frame-members (list (list (xy 0 0) (xy 3 0) (xy 3 2)) '((1 2) (2 3))) 0.1 #:nodes 'mitred))
(displayln (list (near? (shared bent) 0 1e-9) (> (volume (unite bent)) (* 0.99 pi 0.01 5))))
; expect: (#t #t)
(define star (frame-members (list (cons origin (map (lambda (i) (pol 2 (* i (/ pi 3)))) (iota 6))) (map (lambda (i) (list 1 i)) (iota 6 2))) 0.1 #:nodes 'mitred))
(displayln (list (near? (shared star) 0 1e-9) (near? (overlap star) 0 2e-4)))
; expect: (#t #t)
(displayln (near? (shared (frame-members corner 0.2 #:nodes 'mitred)) 0 1e-9))
; expect: #t

; the two bars of a mitre share the corners of the cutting plane, to the last digit; mitres that cut nothing are omitted
(define (cuts bar) (map (lambda (o) (take (car (object-arguments o)) 3)) (cdr (object-children bar))))
(define all-cuts (append-map cuts star))
(displayln (list (length all-cuts) (length (delete-duplicates all-cuts))))
; expect: (12 6)

; 199 mitred bars of a curved roof, which took half a minute with half-spaces as long as the bars
(define (shell u v) (xyz (* 20 u) (* 12 v) (+ 4 (* 8 u (- 1 u)) (* 4 v (- 1 v)))))
(define shell-bars (frame-members (panel-net (panel-corners shell (quad-grid 10 9))) 0.05 #:nodes 'mitred))
; the union has bars of 32 facets, a single bar the volume of its formula
(displayln (near? (/ (volume (unite shell-bars)) (total (map volume shell-bars))) (* (/ 16 pi) (sin (/ pi 16))) 1e-3))
; expect: #t

; a space frame: every point carries bars, and no bar is twice there
(define frame (space-frame (lambda (u v) (xyz (* 6 u) (* 4 v) (* u v))) 4 3 1))
(displayln (list (length (first frame)) (length (second frame)) (length (delete-duplicates (map (lambda (m) (list (apply min m) (apply max m))) (second frame))))))
; expect: (32 96 96)
(displayln (delete-duplicates (sort (append-map values (second frame)) <) =))
; expect: (1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32)

; bricks of each bond do not overlap, on lines and on circles; a straight course is as long as its line
(for ([bond '(running third stack flemish)])
  (define straight (brick-wall (make-line origin (xy 1.6 0)) #:height 0.249 #:bond bond))
  (define around (brick-wall (make-circle origin 2) #:height 0.166 #:bond bond))
  (displayln (list (near? (overlap straight) 0 1e-8) (near? (overlap around) 0 1e-8)
                   (near? (cx (second (bounding-box (unite straight)))) 1.6 0.06))))
; expect: (#t #t #t)
; expect: (#t #t #t)
; expect: (#t #t #t)
; expect: (#t #t #t)
(brick-wall (make-circle origin 1) #:height 1 #:bond 'english) ; expect error: brick-wall: bond must be 'running, 'third, 'stack or 'flemish, got english
