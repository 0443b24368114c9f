; Listing 4.3 of the VisualScheme thesis: a cylinder between two arbitrary points, made of an upright one.
;
; The listing's cylinder is centred on the origin; make-cylinder stands on its base, in the thesis' Appendix A and here. And it turns about z first
; and about x then, which leaves an upright cylinder in the plane of y and z: a zenith angle is a turn about y, and the azimuth's comes last.
; Lines that differ say so. make-cylinder takes two points, too, and cylinder-from-to is in the library: the program is here to be read.

(define (cylinder-from-to from to radius)
  (let* ([v-cyl (p->q from to)]             ; vector inside the cylinder
         [height (vlength v-cyl)]           ; height of the cylinder
         [m (p+v from (v*r v-cyl 1/2))]     ; middle of the cylinder
         [v-phi (esf-phi v-cyl)]            ; azimuth
         [v-psi (esf-psi v-cyl)]            ; zenith angle

         [cyl (make-cylinder (xyz 0 0 (/ height -2)) height radius)]    ; repaired: (make-cylinder origin height radius)
         [r1 (rotate cyl 'y v-psi)]         ; repaired: (rotate cyl 'z v-phi)
         [r2 (rotate r1 'z v-phi)])         ; repaired: (rotate r1 'x v-psi)
    (translate r2 (p->q origin m))))

; A tripod and its rings: every strut ends where it should.
(define feet (map (lambda (phi) (pol 4 phi)) (enumerate 0 2*pi 3)))
(define top (xyz 0 0 6))

(for-each
 (lambda (foot next)
   (draw (cylinder-from-to foot top 0.25))
   (draw (cylinder-from-to (intermediate-point foot top 1/3) (intermediate-point next top 1/3) 0.15)))
 feet
 (append (rest feet) (list (first feet))))
