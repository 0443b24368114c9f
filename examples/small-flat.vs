; A small flat that checks itself. Rules state the demands on the flat: a room that breaks one turns red in pictures and
; plans. Move a slider in `vs view examples/small-flat.vs`, or type `vs examples/small-flat.vs -D bath-width=1.5 -o plan.svg`.
; Then write 1.5 as the default of bath-width below: `vs cure examples/small-flat.vs` finds the nearest good value.
(import (visualscheme) (visualscheme building))
(define-parameter width 7.2 #:min 6 #:max 10) ; metres, between the middles of the outer walls
(define-parameter bath-width 1.9 #:min 1.4 #:max 3)
(define-parameter window-width 1.4 #:min 0.6 #:max 2)
(define depth 6.8)
(define hall 2.2) ; the depth of hall and bath

; 1. The walls. A door or window stands on its wall: the number is the distance along the wall's path.
(define (outside path)
  (wall path
        #:layers '((0.01 plaster) (0.14 insulation) (0.175 block) (0.015 plaster))
        #:height 2.6))
(define (inside p q)
  (wall (list p q) #:layers '((0.015 plaster) (0.1 block) (0.015 plaster)) #:height 2.6))
(define middle (/ width 2))
(define south
  (window (window (outside (list (xy 0 0) (xy width 0))) 1.8 window-width 1.4)
          (- width 1.8)
          window-width 1.4))
(define east (outside (list (xy width 0) (xy width depth))))
(define north (door (outside (list (xy width depth) (xy 0 depth))) (- width bath-width 1.2) 1 2.1))
(define west (outside (list (xy 0 depth) (xy 0 0))))
(define across
  (door (door (inside (xy width (- depth hall)) (xy 0 (- depth hall))) (- middle 0.9))
        (+ middle 0.7)))
(define between (inside (xy middle 0) (xy middle (- depth hall))))
(define bath-wall (door (inside (xy bath-width depth) (xy bath-width (- depth hall))) 1.5 0.75))
(define walls (join-walls south east north west across between bath-wall))

; 2. The rooms, found from the walls. A point in each room gives it a name.
(define names
  (list (list "Living" (xy 1 1))
        (list "Bed" (xy (- width 1) 1))
        (list "Bath" (xy 0.8 (- depth 1)))
        (list "Hall" (xy (- width 1) (- depth 1)))))
(define flat (rooms walls #:names names))
(define (named name) (room-named flat name))

; 3. The rules. Each has a name and a condition; the condition is any expression.
(require-that "The bath has room for a shower" (>= (room-area (named "Bath")) 2.9))
(require-that "A wheelchair turns in the hall" (>= (room-width (named "Hall")) 1.5))
(require-that "The bed room is a double room" (>= (room-area (named "Bed")) 12))
(require-that "The bath opens to the hall" (rooms-connected? (named "Bath") (named "Hall")))
(for-each
  (lambda (name)
    (require-that (format "~a: an eighth of the floor is window" name)
                  (>= (daylight-ratio (named name)) 1/8)))
  '("Living" "Bed"))
(for-each
  (lambda (room)
    (require-that (format "~a: at most 15 m to the door" (room-name room))
                  (<= (exit-distance room flat) 15)))
  flat)

; 4. The drawing and the plan.
(draw walls
      (with-material 'concrete (slab (outer-outline walls #:height 0) #:layers 0.2))
      (plan-symbols walls))
(camera (xyz (* 0.3 width) -7 11) (xyz middle 3 0.6) #:lens 35)
(view "plan" 'plan #:cut 1.2 #:scale 75)
(dimension-walls (list south east north) #:view "plan")
(label-rooms flat #:view "plan")
