; Hexahedra: prisms, round corners and the turtle against closed forms; looks and copies of what is deformed.
(define cube (make-box (xyz 0 0 0) (xyz 1 1 1)))
(define s 0.4) (define h 0.5)
(define (square) (make-box-scope origin s h 1))
; a prism is half of a square's corner, whatever its angle
(displayln (near? (volume (scope-prism (square) pi/2 cube)) (* 1/2 s s h)))                        ; expect: #t
(displayln (near? (volume (scope-prism (square) pi/3 cube)) (* 1/2 s s (tan pi/6) h)))             ; expect: #t
(displayln (object-kind (scope-prism (square) -1 cube)))                                           ; expect: empty-object
(displayln (near? (volume (scope-round-corner (square) pi/4 (degrees->radians 15) cube)) (* 3 1/2 s s (sin pi/12) h))) ; expect: #t
; a cornice round a right corner: two walls of 5 m, and a prism from each side. The second is the first in the mirror
; of the corner's diagonal, so it is turned half about x: its y goes down and its z to the other side.
(define wall-a (make-box (xyz 0 0 0) (xyz 5 s h)))
(define wall-b (make-box (xyz 5 0 0) (xyz (+ 5 s) -5 h)))
(define-rule (half-corner [self box-scope?]) [(=> (scope-prism pi/2 cube))])
; x out of wall a (+Y), y up: z = x cross y is +X, along the wall and away from it
(define-rule (from-a [self box-scope?]) [(=> (scope-turn 'y pi/2) (scope-size s h #f) (half-corner))])
(define one (do-move (from-a (make-box-scope origin 1 1 1)) (vxyz 5 0 0)))
(displayln (near? (volume one) (* 1/2 s s h)))                    ; expect: #t
(displayln (near? (bounding-box one) (list (xyz 5 0 0) (xyz (+ 5 s) s h)))) ; expect: #t
(define other (do-mirror one (make-plane (xyz 5 0 0) (vxyz 1 -1 0))))
(define corner (unite wall-a one other wall-b))
(displayln (near? (volume (unite one other)) (* s s h)))          ; expect: #t
(displayln (near? (volume corner) 2.08))                          ; expect: #t
; the turtle: width 3, height 2, forward 2, then turned
(define (limb turn)
  (define-rule (grow [self turtle-scope?]) [(=> (turtle-back) (turtle-forward 2) (turn) (turtle-front cube))])
  (volume (grow (make-turtle-scope origin ux uz 3 2))))
(define a pi/5)
(displayln (near? (limb (lambda (t) t)) 12))                                                ; expect: #t
(displayln (near? (limb (lambda (t) (turtle-yaw t a))) (* 6 (+ 1 (cos a)))))                ; expect: #t
(displayln (near? (limb (lambda (t) (turtle-pitch t a))) (* 4 (+ 1 (cos a)) 3/2)))          ; expect: #t
(parameterize ((current-tolerance 0.002))
  (displayln (near? (limb (lambda (t) (turtle-roll t a))) (* 4 (+ 2 (cos a))) 0.01)))       ; expect: #t
; looks stay, and a copy elsewhere is the same mesh, placed
(define ball (unite (color "red" cube) (color "blue" (do-move cube (vxyz 2 0 0)))))
(define-rule (two [self turtle-scope?])
  [(=> (turtle-back) (turtle-forward 2) (turtle-yaw 0.3) (turtle-front ball)
       (turtle-yaw 1) (turtle-back) (turtle-forward 2) (turtle-yaw 0.3) (turtle-front ball))])
(define grown (two (make-turtle-scope (xyz 3 4 5) ux uz 3 2)))
(displayln (map object-kind (object-children grown)))             ; expect: (deform deform)
(displayln (map (lambda (o) (equal? (object-children o) (list ball))) (object-children grown))) ; expect: (#t #t)
(define (read-back o) (eval (read (open-input-string (format "~a" o))) (interaction-environment)))
(displayln (equal? (car (object-children grown)) (read-back (car (object-children grown))))) ; expect: #t
; a parallelepiped only places
(displayln (object-kind (scope-place (make-ffd-scope (xyz 0 0 0) (xyz 2 0 0) (xyz 1 0 3) (xyz 3 0 3) (xyz 0 -1 0) (xyz 2 -1 0) (xyz 1 -1 3) (xyz 3 -1 3)) cube))) ; expect: transform
(define-rule (tower [self turtle-scope?] [n integer?])
  [#:when (= n 0) (=>)]
  [(=> (turtle-back) (turtle-forward 1) (turtle-toward uz 0.2) (turtle-front cube) (tower (- n 1)))])
(displayln (object-count (tower (make-turtle-scope origin ux uz 1 1) 50))) ; expect: 50
