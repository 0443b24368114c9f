; (visualscheme building): rooms, their areas by closed forms, and doors between them
(import (visualscheme) (visualscheme building))
(define (plan . walls) (join-walls walls))
(define (turn-of l) (apply + (map (lambda (a b) (- (* (cx a) (cy b)) (* (cx b) (cy a)))) l (append (cdr l) (list (car l))))))
(define shell (wall (make-rectangle (xy 0 0) (xy 8 5)) #:height 3 #:layers '((0.3 brick) (0.1 plaster))))
(define across (wall (list (xy 5 0) (xy 5 5)) #:height 3 #:layers 0.2))
(define one (first (rooms shell)))
(displayln (list (room? one) (room? 3) (room-name one) (near? (room-area one) (* 7.6 4.6)) (near? (room-perimeter one) (* 2 (+ 7.6 4.6))) (near? (room-volume one) (* 3 7.6 4.6))
                 (near? (volume (room-solid one)) (room-volume one)) (near? (area (room-region one)) (room-area one)) (near? (room-height one) 3)))
; expect: (#t #f 1 #t #t #t #t #t #t)

; four rooms, numbered from the lower left; names; the lowest wall is the height
(define four (rooms (plan shell across (wall (list (xy 0 2) (xy 8 2)) #:height 2.5 #:layers 0.2)) #:names (list (list "bath" (xy 6 1)) (list 'hall (xy 1 4)))))
(displayln (list (map room-name four) (every near? (map room-area four) (map * '(4.7 2.7 4.7 2.7) '(1.7 1.7 2.7 2.7))) (map room-height four)))
; expect: ((1 bath hall 4) #t (2.5 2.5 2.5 2.5))
; a round room in a square one; a free wall and a column of walls take their area
(define ring (wall (make-circle (xy 4 2.5) 1) #:height 3 #:layers 0.2))
(displayln (let ((found (rooms (list shell ring)))) (list (length found) (near? (apply + (map room-area found)) (- (* 7.6 4.6) (volume (do-scale ring (list 1 1 1/3)))) 1e-9))))
; expect: (2 #t)
(displayln (near? (room-area (first (rooms (list shell (wall (list (xy 2 2) (xy 4 2)) #:height 3 #:layers 0.5))))) (- (* 7.6 4.6) 1))) ; expect: #t
(displayln (list (rooms '()) (rooms across) (near? (gross-area (plan shell across)) (* 8.4 5.4)) (gross-area '())))
; expect: (() () #t 0)

; doors: from outside, between rooms; an opening to the floor is one, a window is not
(define two (rooms (plan (window (door shell 2) 6 1 1) (opening (door across 1) 3.5 1.5 2)) #:names (list (list 'west (xy 2 2)) (list 'east (xy 6 2)))))
(displayln (room-graph two))              ; expect: ((#f west 0.9) (east west 0.9) (east west 1.5))
(displayln (map (lambda (r) (length (room-doors r))) two)) ; expect: (3 2)
; walls that meet at any angle, and a curved one, leave no gap through which a room would leak
(define star (join-walls (map (lambda (i) (wall (list (pol 4 (* i 2/7 pi)) (pol 4 (* (+ i 1) 2/7 pi))) #:layers '((0.1 brick) (0.05 plaster)))) (iota 7))
                         (map (lambda (i) (wall (list origin (pol 4 (* i 2/7 pi))) #:layers 0.1)) (iota 7))))
(displayln (let ((all (rooms star))) (list (length all) (every (lambda (r) (near? (room-area r) (room-area (first all)) 1e-9)) all)))) ; expect: (7 #t)
(displayln (length (rooms (plan (wall (make-arc origin 3 0 pi)) (wall (list (xy -3 0) (xy 3 0))) (wall (list (xy 0 0) (xy 0 3))))))) ; expect: 2

; the outline of the outer faces: without the corners of joints on straight walls, from the lower left
(displayln (let ((o (outer-outline (plan shell across)))) (list (length o) (near? (first o) (xyz -0.2 -0.2 3)) (near? (third o) (xyz 8.2 5.2 3)) (cz (first (outer-outline shell #:height 1))) (> (turn-of o) 0)))) ; expect: (4 #t #t 1.0 #t)
(define (layered . points) (wall points #:layers '((0.115 brick) (0.14 insulation) (0.175 block) (0.015 plaster)))) ; no slit at the joint
(displayln (length (outer-outline (plan (layered (xy 0 0) (xy 12 0) (xy 12 8) (xy 0 8) (xy 0 0)) (wall (list (xy 7 0) (xy 7 8)) #:layers '((0.015 plaster) (0.115 block) (0.015 plaster))))))) ; expect: 4
(displayln (length (outer-outline (list shell (wall (make-rectangle (xy 20 0) (xy 24 3))))))) ; expect: 2
(displayln (near? (volume (roof (outer-outline shell) #:pitch pi/4)) (let ((w 5.4) (l 8.4)) (+ (/ (* w w (- l w)) 4) (/ (expt w 3) 6))) 1e-9)) ; expect: #t

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (rooms 3))                                       ; expect: rooms: wall must be a wall, as wall or join-walls return it, got 3
(fails (rooms shell #:names '("bath")))                 ; expect: rooms: names must be lists of a name and a point, got "bath"
(fails (rooms shell #:names (list (list "a" (xy 9 9))))) ; expect: rooms: no walls enclose (xyz 9 9 0), the place of "a"
(fails (rooms shell #:names (list (list "a" (xy 1 1)) (list "b" (xy 2 2))))) ; expect: rooms: "a" and "b" name one room: walls with a gap, or none, are between (xyz 1 1 0) and (xyz 2 2 0)
(fails (outer-outline '()))                             ; expect: outer-outline: walls must be one wall or more, got ()
(fails (room-area 3))                                   ; expect: room-area: room must be a room, as rooms returns it, got 3
(fails (rooms shell #:names 3))                         ; expect: rooms: names must be lists of a name and a point, got 3
(fails (room-graph 3))                                  ; expect: room-graph: rooms must be a list of rooms, as rooms returns it, got 3
