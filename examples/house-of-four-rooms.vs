; A house of four rooms: walls of brick, insulation and block with a curved end, doors and windows, a hipped roof with a
; dormer, and the plan with the names and areas of its rooms.
(import (visualscheme) (visualscheme building))
(define outer '((0.115 brick) (0.14 insulation) (0.175 block) (0.015 plaster)))
(define inner '((0.015 plaster) (0.115 block) (0.015 plaster)))
(define (outside path) (wall path #:layers outer #:height 2.7))
(define (inside . points) (wall points #:layers inner #:height 2.7))

; the storey
(define south (window (window (outside (list (xy 0 0) (xy 9 0))) 1.7 1.4 1.3) 6.5 2.2 1.4))
(define (pane w h thick) (with-material 'glass (make-box (xyz -0.05 0.2 -0.05) (xyz (+ w 0.05) 0.22 (+ h 0.05)))))
(define bow (window (outside (make-arc (xy 9 3.5) 3.5 -pi/2 pi/2)) 5.5 1.6 1.6 #:sill 0.6 #:fill pane))
(define north (window (outside (list (xy 9 7) (xy 0 7))) 6 1.2 1.2))
(define west (door (outside (list (xy 0 7) (xy 0 0))) 1.7 1 2.1))
(define middle (door (door (inside (xy 0 4) (xy 9 4)) 2 0.9 2) 6.5 0.9 2))
(define walls
  (join-walls south bow north west middle
    (inside (xy 3.6 0) (xy 3.6 4)) (inside (xy 4.6 4) (xy 4.6 7)) (inside (xy 9 4) (xy 9 7))))
(define storey (rooms walls #:names (list (list "Bedroom" (xy 2 2)) (list "Living" (xy 7 2)) (list "Hall" (xy 2 6)) (list "Kitchen" (xy 6 6)))))

; the roof over the outside of the walls, with a dormer
(define eaves (outer-outline walls))
(define hipped
  (roof eaves #:pitch (degrees->radians 38) #:overhang 0.4 #:thickness 0.2
    #:dormers (dormer 1 4.7 1.8 #:height 1.5 #:setback 0.8)))

(draw walls
      (with-material 'concrete (slab (outer-outline walls #:height 0) #:layers 0.25))
      (color "firebrick" hipped))
(draw (do-move (prefab "person") (vxyz 8 -2.5 -0.25)))
(ground -0.25 #:material 'grass)
(camera (xyz 19 -9 6) (xyz 6.5 2.6 1.6) #:lens 35)
(view "plan" 'plan #:cut 1.2)
(label-rooms storey #:view "plan")
