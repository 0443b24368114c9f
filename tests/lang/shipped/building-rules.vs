; (visualscheme building): rules of a design, and the numbers of rooms that they limit
(import (visualscheme) (visualscheme building))
(define shell (window (door (wall (make-rectangle (xy 0 0) (xy 8 5)) #:layers 0.4) 2 1) 6 1 1.5))
(define divider (door (wall (list (xy 5 0) (xy 5 5)) #:layers 0.2) 2))
(define walls (join-walls shell divider))
(define all (rooms walls #:names (list (list "bath" (xy 7 1)) (list "hall" (xy 1 1)))))
(define bath (room-named all "bath"))
(define hall (room-named all "hall"))
(draw walls)

; a rule that is met is silent; each comparison reports its values
(displayln (list (require-that "met" (>= (room-area bath) 4)) (require-that "also met" (rooms-connected? bath hall)))) ; expect: (#t #t)
(displayln (require-that "area" (>= (room-area bath) 14))) ; expect: #f
; expect warning 13: rule "area" is not met: (>= (room-area bath) 14), where (room-area bath) is 12.42
(require-that "chain" (< 1 (room-width bath) 2.5))      ; expect warning: rule "chain" is not met: (< 1 (room-width bath) 2.5), where (room-width bath) is 2.7
(require-that "equal" (= (+ 1 1) 3))                    ; expect warning: where (+ 1 1) is 2
(require-that "less" (<= 3 2))                          ; expect warning: rule "less" is not met: (<= 3 2)
(require-that "more" (> 2 2))                           ; expect warning: rule "more" is not met
(require-that "light" (>= (daylight-ratio hall) 1/10))  ; expect warning: where (daylight-ratio hall) is 0.0
(require-that "way" (<= (exit-distance bath (list bath)) 30)) ; expect warning: where (exit-distance bath (list bath)) is +inf.0
(require-that "door" (rooms-connected? hall hall))      ; expect warning: rule "door" is not met: (rooms-connected? hall hall)
; a loop tests one rule for each room: each that breaks it has its own warning
(for-each (lambda (r) (require-that (format "~a is wide" (room-name r)) (>= (room-width r) 5))) all)
; expect warning 23: rule "hall is wide" is not met
; expect warning 23: rule "bath is wide" is not met
; a user's own comparison is any other condition
(let ((>= (lambda (a b) #f))) (require-that "own" (>= 2 1)))  ; expect warning: rule "own" is not met: (>= 2 1)
; #:at takes rooms, walls, other objects, points and lists of these
(require-that "places" #f #:at (list bath divider (make-sphere origin 1) (xyz 1 1 1) (list hall))) ; expect warning: rule "places" is not met
; expect no other warnings

; numbers of rooms by closed forms
(define (room-of . points) (first (rooms (wall (make-polygon points) #:layers 0.2))))
(displayln (list (near? (room-width bath) 2.7) (near? (room-width hall) 4.6) (near? (daylight-ratio bath) (/ 1.5 (* 2.7 4.6))))) ; expect: (#t #t #t)
(displayln (near? (room-width (room-of (xy 0 0) (xy 6 0) (xy 6 1.4) (xy 2 1.4) (xy 2 5) (xy 0 5))) 1.2)) ; expect: #t
(displayln (near? (room-width (room-of (xy 0 0) (xy 6 0) (xy 3 (* 3 (sqrt 3))))) (- (* 2 (sqrt 3)) 0.2) 1e-2)) ; expect: #t
; a pillar narrows a room: 4 between the walls, 1.3 beside the pillar
(define pillar (wall (list (xy 3 1.7) (xy 3 2.3)) #:layers 1))
(displayln (near? (room-width (first (rooms (list (wall (make-rectangle (xy 0 0) (xy 6 4)) #:layers 0.2) pillar)))) 1.6)) ; expect: #t
(displayln (near? (exit-distance hall all) (sqrt (+ (square 2.9) (square 4.8))))) ; expect: #t
(displayln (< (exit-distance hall all) (exit-distance bath all) 8))               ; expect: #t
(define loft (first (rooms (opening (wall (make-rectangle (xy 0 0) (xy 4 4)) #:layers 0.2) 2 1 1 #:sill 1)))) ; no door leads out
(displayln (list (exit-distance loft (list loft)) (near? (daylight-ratio loft) (/ 1 (square 3.8))))) ; expect: (+inf.0 #t)

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (require-that 3 #f))                      ; expect: require-that: name must be a string, got 3
(fails (require-that "a" #f #:at 3))             ; expect: require-that: at must be rooms, objects or points, got 3
(fails (room-named all "attic"))                 ; expect: room-named: no room has the name "attic"; the names are ("hall" "bath")
(fails (room-width 3))                           ; expect: room-width: room must be a room, as rooms returns it, got 3
(fails (daylight-ratio 3))                       ; expect: daylight-ratio: room must be a room, as rooms returns it, got 3
(fails (rooms-connected? hall 3))                ; expect: rooms-connected?: room must be a room, as rooms returns it, got 3
(fails (exit-distance hall 3))                   ; expect: exit-distance: rooms must be a list of rooms, as rooms returns it, got 3
(fails (require-that "a" (>= (room-area 3) 1)))  ; expect: room-area: room must be a room, as rooms returns it, got 3
