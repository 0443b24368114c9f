; (visualscheme analysis): lines of moments and arrows of reactions
(import (visualscheme) (visualscheme analysis))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(define tube (tube-section 0.1 0.005))
(define (beam supports . loads) (frame-solve (frame (list origin (xyz 4 0 0)) '((1 2)) #:supports supports #:sections tube #:loads loads)))
(define ends '((1 pinned rx) (2 y z)))
; 2000 N/m on 4 m: the line hangs q l^2 / 8 = 4000 Nm below the middle, all along a parabola; a cantilever's lies above its root
(define line (first (moment-lines (beam ends (list 'members (vxyz 0 0 -2000))) #:factor 1e-3)))
(say (every (lambda (p) (near? (cz p) (- (* (cx p) (- 4 (cx p)))) 1e-9)) (take (first (object-arguments line)) 17)))
; expect: (#t)
(define root (first (moment-lines (beam '(1) (list 2 (vxyz 0 0 -1000))) #:factor 1e-3)))
(say (near? (second (bounding-box root)) (xyz 4 0 4) 1e-9) (near? (first (bounding-box root)) origin 1e-9))
; expect: (#t #t)
; about z: a force along y; without bending, no lines; without a factor, a quarter of the longest member
(define aside (beam '(1) (list 2 (vxyz 0 1000 0))))
(say (near? (apply max (map (lambda (p) (abs (cy p))) (bounding-box (first (moment-lines aside #:about 'z))))) 1 1e-9)
     (moment-lines aside) (moment-lines (beam '(1) (list 2 (vxyz 1000 0 0)))))
; expect: (#t () ())
; arrows point along the forces and end in the nodes
(define arrows (reaction-arrows (beam ends (list 'members (vxyz 0 0 -2000))) #:factor 1e-3))
(say (map (lambda (a) (near? (- (cz (second (bounding-box a))) (cz (first (bounding-box a)))) 4 1e-9)) arrows) (map (lambda (a) (near? (cz (second (bounding-box a))) 0 1e-9)) arrows))
; expect: ((#t #t) (#t #t))
(say (length (reaction-arrows aside)))
; expect: (1)
(fails (moment-lines aside #:about 'x)) ; expect: moment-lines: about must be 'y or 'z, got x
(fails (reaction-arrows 3))             ; expect: reaction-arrows: r must be a result of frame-solve, got 3
; expect no other warnings
