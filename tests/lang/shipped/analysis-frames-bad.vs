; (visualscheme analysis): bad frames. Mechanisms name a node that moves; units that must be wrong are warned of
(import (visualscheme) (visualscheme analysis))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(define beam (list origin (xyz 3 0 0)))
(define tube (tube-section 0.1 0.005))
(define down (vxyz 0 0 -100))

; mechanisms: a square of four pinned bars; a beam on one pin; a chain of two bars under a load between them; a beam that slides
(define square (list (xz 0 0) (xz 0 2) (xz 2 2) (xz 2 0)))
(fails (frame-solve (frame square '((1 2) (2 3) (3 4)) #:supports '((1 pinned) (4 pinned)) #:loads (list (list 2 down)) #:sections tube #:joints 'pinned #:plane 'xz)))
; expect: frame-solve: the frame is a mechanism: node 2 moves along (vxyz 1 0 0), and nothing resists; add a support, a member or a rigid joint
(fails (frame-solve (frame square '((1 2 hinged) (2 3 hinged) (3 4 hinged)) #:supports '((1 pinned) (4 pinned)) #:sections tube #:plane 'xz)))
; expect: frame-solve: the frame is a mechanism: node 2 moves along (vxyz 1 0 0), and nothing resists; add a support, a member or a rigid joint
(fails (frame-solve (frame beam '((1 2)) #:supports '((1 pinned)) #:sections tube #:plane 'xz)))
; expect: frame-solve: the frame is a mechanism: node 2 moves along (vxyz 0 0 1), and nothing resists; add a support, a member or a rigid joint
(fails (frame-solve (frame (list origin (xyz 1 0 0) (xyz 2 0 0)) '((1 2) (2 3)) #:supports '((1 pinned) (3 pinned)) #:loads (list (list 2 down)) #:sections tube #:joints 'pinned)))
; expect: frame-solve: the frame is a mechanism: node 2 moves along (vxyz 0 0 1), and nothing resists; add a support, a member or a rigid joint
(fails (frame-solve (frame beam '((1 2)) #:supports '((1 y z rx) (2 y z)) #:loads (list (list 2 (vxyz 5 0 0))) #:sections tube)))
; expect: frame-solve: the frame is a mechanism: node 1 moves along (vxyz 1 0 0), and nothing resists; add a support, a member or a rigid joint
(fails (frame-solve (frame (list origin (xyz 1 0 0) (xyz 2 0 0)) '((1 2)) #:supports '(1) #:loads (list (list 3 down)) #:sections tube)))
; expect: frame-solve: the frame is a mechanism: node 3 moves along (vxyz 0 0 1), and nothing resists; add a support, a member or a rigid joint
(fails (frame-solve (frame beam '((1 2 hinged-end)) #:supports '(1) #:loads (list (list 2 down (vxyz 0 7 0))) #:sections tube)))
; expect: frame-solve: the frame is a mechanism: node 2 turns about (vxyz 0 1 0), and nothing resists; add a support, a member or a rigid joint
; what nothing loads is held, with a warning
(displayln (near? 50 (member-force (frame-solve (frame (list origin (xyz 1 0 0) (xyz 2 0 0)) '((1 2) (2 3)) #:supports '((1 pinned) (3 pinned)) #:loads (list (list 2 (vxyz 100 0 0))) #:sections 1e-3)) 1)))
; expect: #t
; expect warning 25: frame-solve: node 2 is free to move where nothing loads it, and was held there

; missing and wrong parts
(fails (frame beam '((1 2)) #:sections tube))                        ; expect: frame: no support holds the frame: give #:supports, such as '((1 fixed) (5 pinned))
(fails (frame beam '((1 2)) #:supports '(1)))                        ; expect: frame: sections must be given: one such as (tube-section 0.1 0.005), or a list with one for each member
(fails (frame beam '((1 2)) #:supports '(1) #:sections 0))           ; expect: frame: sections must be sections, such as (tube-section 0.1 0.005), or areas in m2, got 0
(fails (round-section 0))                                            ; expect: round-section: d must be positive, got 0
(fails (tube-section 0.1 0.05))                                      ; expect: tube-section: t must be less than half of 0.1, got 0.05
(fails (rectangle-section 0.1 -1))                                   ; expect: rectangle-section: height must be positive, got -1
(fails (box-section 0.1 0.2 0))                                      ; expect: box-section: t must be positive, got 0
(fails (any-section 0.1 #:iy 1e-6))                                  ; expect: any-section: iy and iz must both be positive, or both be 0 for a bar without bending
(fails (frame beam '((1 1)) #:supports '(1) #:sections tube))        ; expect: frame: member 1 has no length: its ends, of nodes 1 and 1, are both at (xyz 0 0 0)
(fails (frame beam '((1 3)) #:supports '(1) #:sections tube))        ; expect: frame: member 1: a node must be a number from 1 to 2, got 3
(fails (frame beam '((1)) #:supports '(1) #:sections tube))          ; expect: frame: member 1 must be a list of two nodes, got (1)
(fails (frame beam '((1 2 loose)) #:supports '(1) #:sections tube))  ; expect: frame: member 1 has the option loose; options are 'hinged, 'hinged-start, 'hinged-end, 'roll before an angle, and 'offset, 'offset-start, 'offset-end before a gvector
(fails (frame beam '((1 2)) #:supports '(3) #:sections tube))        ; expect: frame: supports: a node must be a number from 1 to 2, got 3
(fails (frame beam '((1 2)) #:supports '((1 w)) #:sections tube))    ; expect: frame: supports: w holds nothing; write 'fixed, 'pinned, or some of (x y z rx ry rz), in (1 w)
(fails (frame beam '((1 2)) #:supports '(1) #:sections (list tube tube))) ; expect: frame: sections must be one, or a list of 1, one for each member, got 2
(fails (frame beam '((1 2)) #:supports '(1) #:sections tube #:materials 'gold))
; expect: frame: materials must be one of (s235 s275 s355 c16 c24 c30 gl24h gl28h gl32h c25/30 aluminium), a modulus in Pa or a structural-material, got gold
(fails (frame beam '((1 2)) #:supports '(1) #:sections tube #:loads '((2 100))))
; expect: frame: loads: (2 100) is no load; loads are (list node force), (list node force moment), (list 'member number force-per-metre), (list 'members force-per-metre), (list 'faces faces force-per-m2), (list 'plan faces force-per-m2) and 'weight
(fails (frame beam '((1 2)) #:supports '(1) #:sections tube #:loads (list (list 'member 2 down)))) ; expect: frame: loads: a member must be a number from 1 to 1, got 2
(fails (frame beam '((1 2)) #:supports '(1) #:sections tube #:loads '(weight ("wind" weight)))) ; expect: frame: loads: the case "wind" is beside loads without a case; give each a case
(fails (frame beam '((1 2)) #:supports '(1) #:sections tube #:loads '(("a" weight) ("a" weight)))) ; expect: frame: loads: two cases have one name in ("a" "a")
(fails (frame beam '((1 2)) #:supports '(1) #:sections tube #:plane 'zz)) ; expect: frame: plane must be 'xy, 'xz or 'yz, got zz
(fails (frame beam '((1 2)) #:supports '(1) #:sections tube #:joints 'stiff)) ; expect: frame: joints must be 'rigid or 'pinned, got stiff
(fails (frame '() '((1 2)) #:supports '(1) #:sections tube))         ; expect: frame: nodes must be a list of points, got ()
(fails (frame beam '() #:supports '(1) #:sections tube))             ; expect: frame: members must be a list of lists of two nodes, got ()
(fails (frame-solve 3))                                              ; expect: frame-solve: f must be a frame, got 3

; questions
(define r (frame-solve (frame beam '((1 2)) #:supports '(1) #:sections tube #:loads (list (list "dead" 'weight) (list "wind" (list 2 (vxyz 0 9 0)))))))
(fails (displacement r 3 #:case "wind"))   ; expect: displacement: node: a node must be a number from 1 to 2, got 3
(fails (displacement r 2))                 ; expect: displacement: case must be one of ("dead" "wind"), got #f
(fails (member-force r 2 #:case "dead"))   ; expect: member-force: i must be a member from 1 to 1, got 2
(fails (member-forces r 1 2 #:case "dead")) ; expect: member-forces: t must be a part of the length from 0 to 1, got 2
(fails (combine-cases r '("uls" (1.5 "snow")))) ; expect: combine-cases: case must be one of ("dead" "wind"), got "snow"
(fails (reaction 5 1))                     ; expect: reaction: r must be a result of frame-solve, got 5

; units: MPa, GPa, t/m3, mm, strengths in MPa
(define (units m) (frame beam '((1 2)) #:supports '(1) #:sections tube #:materials m))
(define mega (units 210000))
; expect warning 69: frame: a modulus of 210000 Pa is softer than rubber: pascals are expected, 1 MPa is 1e6 Pa, 1 GPa is 1e9 Pa
(define giga (units 210)) ; expect warning: frame: a modulus of 210 Pa is softer than rubber
(define tonnes (units (structural-material 210e9 #:density 7.85))) ; expect warning: frame: a density of 7.85 is that of no building material: kg/m3 are expected, 7850 for steel
(define newtons (units (structural-material 210e9 #:density 78500))) ; expect warning: frame: a density of 78500 is that of no building material
(define weak (units (structural-material 210e9 #:strength 235))) ; expect warning: frame: a strength of 235 Pa is less than that of snow: pascals are expected
(define wide (frame beam '((1 2)) #:supports '(1) #:sections (tube-section 100 5))) ; expect warning: frame: a section of 1492.25
(define long (frame (list origin (xyz 3000 0 0)) '((1 2)) #:supports '(1) #:sections tube)) ; expect warning: frame: a member is 3000.0 m long: metres are expected
; expect no other warnings

; lists that are no lists, or without an end
(define ring (list 1 2))
(set-cdr! (cdr ring) ring)
(fails (frame beam '((1 2)) #:supports (list ring) #:sections tube))  ; expect: frame: supports must be a list of nodes, or of lists such as (list 1 'pinned), got #0=(1 2 . #0#)
(fails (frame beam '((1 2)) #:supports '((1 . 2)) #:sections tube))   ; expect: frame: supports must be a list of nodes, or of lists such as (list 1 'pinned), got (1 . 2)
(fails (frame beam '((1 2)) #:supports '(1) #:sections tube #:loads (list (cons "snow" 3)))) ; expect: frame: loads: a case must be a list of a name and loads, got ("snow" . 3)
(fails (vibration-modes (frame beam '((1 2)) #:supports '(1) #:sections tube) #:masses '((1 +inf.0)))) ; expect: vibration-modes: masses must be lists of a node and kilograms, got ((1 +inf.0))
(fails (heat-balance #:outside (iota 12) #:windows 3))                ; expect: heat-balance: windows must be a list, got 3

; a load beyond all numbers
(fails (frame-solve (frame beam '((1 2)) #:supports '(1) #:sections tube #:loads (list (list 2 (vxyz 0 0 1e308)))))) ; expect: frame-solve: the loads move the frame by more than any number: check their units
