; (visualscheme analysis): buckling by Euler's four cases, and vibration of beams, by closed forms; large frames; messages
(import (visualscheme) (visualscheme analysis))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(define (within? a b part) (<= (abs (- a b)) (* part (abs b))))
(define tube (tube-section 0.1 0.005))
(define i (/ (* pi (- (expt 0.1 4) (expt 0.09 4))) 64))
(define a (section-area tube))
(define e 210e9)
(define h 4)
(define euler (/ (* pi pi e i) (* h h)))
(define (pressed supports members nodes load) (frame-solve (frame nodes members #:supports supports #:sections tube #:loads (list (list load (vxyz 0 0 -1000))))))
(define (factor r) (* 1000 (mode-value (car (buckling-modes r)))))
(define column (list origin (xyz 0 0 h)))

; Euler's cases: pinned 1, cantilever 1/4, fixed and pinned 2.0457, fixed 4; hinges as supports; an oblique column
(define (case-of supports member) (/ (factor (pressed supports (list member) column 2)) euler))
(say (within? (case-of '((1 pinned rz) (2 x y)) '(1 2)) 1 1e-4) (within? (case-of '(1) '(1 2)) 1/4 1e-4)
     (within? (case-of '(1 (2 x y)) '(1 2)) 2.045748 5e-4) (within? (case-of '(1 (2 x y rx ry rz)) '(1 2)) 4 1e-3)
     (within? (case-of '(1 (2 x y rx ry rz)) '(1 2 hinged)) 1 1e-4) (within? (case-of '(1 (2 x y rx ry rz)) '(1 2 hinged-end)) 2.045748 5e-4))
; expect: (#t #t #t #t #t #t)
(define lean (list origin (xyz 1 2 (sqrt (- (* h h) 5)))))
(define leaning (frame-solve (frame lean '((1 2)) #:supports '(1) #:sections tube #:loads (list (list 2 (v*r (unitize (p->q (second lean) origin)) 1000.0))))))
(say (within? (/ (factor leaning) euler) 1/4 1e-4)) ; expect: (#t)
; own weight: a mast that stands free buckles at 7.8373 E I / L^3 (Greenhill)
(define mast (frame-solve (frame column '((1 2)) #:supports '(1) #:sections tube #:loads '(weight))))
(say (within? (* (mode-value (car (buckling-modes mast #:segments 24))) 9.81 7850 a h) (/ (* 7.8373 e i) (* h h)) 2e-3)) ; expect: (#t)
; two pinned bars buckle as the weaker one does; tension alone buckles nothing
(define pair (frame-solve (frame (list (xz -3 0) (xz 0 4) (xz 3 0)) '((1 2) (2 3)) #:supports '((1 pinned) (3 pinned)) #:joints 'pinned #:plane 'xz
                            #:sections (list (tube-section 0.1 0.005) (tube-section 0.12 0.005)) #:loads (list (list 2 (vxyz 0 0 -8000))))))
(define modes (buckling-modes pair #:modes 2))
(say (within? (* 5000 (mode-value (first modes))) (/ (* pi pi e i) 25) 1e-4) (>= (mode-value (second modes)) (mode-value (first modes)))
     (buckling-modes (frame-solve (frame column '((1 2)) #:supports '(1) #:sections tube #:loads (list (list 2 (vxyz 0 0 1000)))))))
; expect: (#t #t ())
; a portal of ten bays, beyond the size of the whole space: as one bay whose beam is stiff and whose feet are pinned
(define bays 10)
(define feet (map (lambda (k) (xz (* 3 k) 0)) (iota (+ bays 1))))
(define heads (map (lambda (k) (xz (* 3 k) h)) (iota (+ bays 1))))
(define n (+ bays 1))
(define portal
  (frame-solve (frame (append feet heads) (append (map (lambda (k) (list k (+ n k))) (iota n 1)) (map (lambda (k) (list (+ n k) (+ n k 1))) (iota bays 1)))
                 #:supports (map (lambda (k) (list k 'pinned)) (iota n 1)) #:plane 'xz #:sections (append (make-list n tube) (make-list bays (any-section 1e-1 #:iy 1 #:iz 1 #:it 1)))
                 #:loads (list (list (iota n (+ n 1)) (vxyz 0 0 -1000))))))
(say (within? (/ (factor portal) euler) 1/4 1e-3)) ; expect: (#t)

; vibration: a simple beam (n^2 pi^2), a cantilever (3.51602, 22.0345), a mass on a light cantilever
(define (beam supports member) (frame (list origin (xyz h 0 0)) (list member) #:supports supports #:sections tube))
(define unit (/ (sqrt (/ (* e i) (* 7850 a (expt h 4)))) 2 pi))
(define (values-of modes) (map mode-value modes))
(define (match? modes wanted) (every (lambda (m w) (within? m (* w unit) 1e-3)) (values-of modes) wanted))
(say (match? (vibration-modes (beam '((1 pinned rx) (2 y z)) '(1 2)) #:modes 4) (list (* pi pi) (* pi pi) (* 4 pi pi) (* 4 pi pi)))
     (match? (vibration-modes (beam '(1) '(1 2)) #:modes 4) '(3.51602 3.51602 22.0345 22.0345))
     (match? (vibration-modes (beam '(1 2) '(1 2 hinged)) #:modes 2) (list (* pi pi) (* pi pi)))
     (let ((light (frame (list origin (xyz h 0 0)) '((1 2)) #:supports '(1) #:sections tube #:materials e)))
       (within? (mode-value (car (vibration-modes light #:masses '((2 500))))) (/ (sqrt (/ (* 3 e i) (* 500 h h h))) 2 pi) 1e-6)))
; expect: (#t #t #t #t)
; more segments, lower values; a space frame beyond the whole space
(define net (space-frame (lambda (u v) (xyz (* 12 u) (* 12 v) 0)) 4 4 2))
(define grid (frame (first net) (second net) #:supports '((1 pinned) (5 pinned) (21 pinned) (25 pinned)) #:sections (tube-section 0.08 0.004)))
(define coarse (values-of (vibration-modes grid #:modes 3 #:segments 2)))
(define fine (values-of (vibration-modes grid #:modes 3 #:segments 4)))
(say (every (lambda (c f) (and (<= f (* c (+ 1 1e-9))) (within? f c 0.02))) coarse fine) (apply <= fine)) ; expect: (#t #t)
(say (length (mode-curves (first modes))) (near? (apply max (map (lambda (p) (vlength (p->q origin p))) (bounding-box (mode-curves (car (buckling-modes mast)) #:size 1)))) 4 1))
; expect: (2 #t)

(fails (buckling-modes 3))                  ; expect: buckling-modes: r must be a result of frame-solve, got 3
(fails (buckling-modes mast #:modes 0))     ; expect: buckling-modes: modes must be an exact integer from 1 to 1000, got 0
(fails (buckling-modes mast #:segments 65)) ; expect: buckling-modes: segments must be an exact integer from 1 to 64, got 65
(fails (vibration-modes (frame column '((1 2)) #:supports '(1) #:sections tube #:materials e))) ; expect: vibration-modes: the frame has no mass: its materials have no #:density
(fails (vibration-modes grid #:masses '((99 5)))) ; expect: vibration-modes: masses: a node must be a number from 1 to 41, got 99
(fails (vibration-modes (frame column '((1 2)) #:supports '((1 pinned)) #:plane 'xz #:sections tube)))
; expect: vibration-modes: the frame is a mechanism: node 2 moves along (vxyz 1 0 0), and nothing resists; add a support, a member or a rigid joint
(fails (mode-curves 3))                     ; expect: mode-curves: m must be a mode, got 3
