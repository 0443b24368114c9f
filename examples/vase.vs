; A marble vase on a plinth.
;
; What it teaches: words for one program. POV-Ray knows stone by its veins, other formats know a colour. `native` gives POV-Ray its own words and
; says, after #:otherwise, what all the others get; the shape is the same in each, and the model stays one.

; The vase is turned: its wall lies between two curves, and goes round the axis; the foot is two cones.
(define body '((0.34 0.35) (0.78 0.8) (1.12 1.6) (0.95 2.4) (0.5 3.0) (0.42 3.3) (0.62 3.6))) ; radius and height

(define (side thinner)
  (make-spline (map (lambda (rh) (xz (- (first rh) thinner) (second rh))) body)))
(define (across rh)
  (make-line (xz (first rh) (second rh)) (xz (- (first rh) 0.08) (second rh))))

(define wall
  (make-region (side 0) (across (last body)) (side 0.08) (across (first body))))

(define vase
  (unite (make-cut-cone (xyz 0 0 0) 0.72 (xyz 0 0 0.15) 0.66)
         (make-cut-cone (xyz 0 0 0.15) 0.6 (xyz 0 0 0.45) 0.36)
         (do-revolve wall 'z)))

; Its looks in POV-Ray's own language: two layers of veins and a polish.
(define marble "
  texture {
    pigment {
      marble turbulence 0.9 octaves 5 lambda 2.2 rotate <15, 40, 10> scale 0.55
      color_map { [0.0 rgb <.93,.91,.86>] [0.6 rgb <.86,.83,.78>] [0.85 rgb <.55,.5,.46>] [1.0 rgb <.3,.27,.26>] }
    }
    finish { ambient 0 diffuse 0.75 specular 0.5 roughness 0.01 reflection { 0.02, 0.2 } }
  }")

(define (marbled o)
  (native 'povray marble #:otherwise (color "#dcd7cc" o)))

(define plinth
  (unite (make-box (xyz -1 -1 -2.4) (xyz 1 1 -2.1))
         (make-box (xyz -0.85 -0.85 -2.1) (xyz 0.85 0.85 -0.3))
         (make-box (xyz -1 -1 -0.3) (xyz 1 1 0))))

(draw (marbled vase))
(draw (with-material stone plinth))

; It stands in a court of gravel before a clipped hedge.
(define hedge (make-material #:name "hedge" #:color "#3f5a2c" #:roughness 1 #:pattern 'mottled #:pattern-size 0.12 #:pattern-color "#26391b"))
(draw (with-material hedge
        (make-box (xyz -16 4 -2.4) (xyz 16 5.4 1.2))
        (make-cone (xyz -4.4 2.4 -2.4) (xyz -4.4 2.4 0.4) 0.85) (make-cone (xyz 4.6 2.4 -2.4) (xyz 4.6 2.4 0.4) 0.85)))

(ground -2.4 #:material 'gravel)
(sun #:azimuth 238 #:altitude 34)
(camera (xyz 2.2 -9.2 -0.8) (xyz 0.2 0 0.6) #:lens 32 #:upright #t)
