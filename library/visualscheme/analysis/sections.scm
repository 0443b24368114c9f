; Sections and materials of members, and checks of arguments that all of the library uses. A section's y is horizontal and
; its z upright if the member is horizontal: a rectangle's width lies along y.

(define (positive-number? x) (and (real? x) (finite? x) (> x 0)))
(define (need-positive who name x) (if (not (positive-number? x)) (error who "~a must be positive, got ~s" name x)))
(define (need-number who name x) (if (not (and (real? x) (finite? x))) (error who "~a must be a finite number, got ~s" name x)))

; ---- sections ----

; area in m2; iy, iz: second moments of area about y and z, and it: torsion constant, in m4, 0 for a bar without bending;
; wy, wz: elastic section moduli in m3, #f if unknown; kind: shape, for the checks of standards; width, height and wall in m,
; #f if unknown. A wall is that of a tube or box.
(define-record-type section (make-section kind area iy iz it wy wz width height wall) section?
  (kind section-kind) (area section-area) (iy section-iy) (iz section-iz) (it section-it) (wy section-wy) (wz section-wz)
  (width section-width) (height section-height) (wall section-wall))

(define (round-section d)
  (need-positive 'round-section 'd d)
  (let ((i (/ (* pi (expt d 4)) 64)))
    (make-section 'round (/ (* pi d d) 4) i i (* 2 i) (/ i d 0.5) (/ i d 0.5) d d #f)))

(define (need-wall who t least)
  (need-positive who 't t)
  (if (>= (* 2 t) least) (error who "t must be less than half of ~a, got ~s" least t)))

(define (tube-section d t)
  (need-positive 'tube-section 'd d)
  (need-wall 'tube-section t d)
  (let* ((inner (- d (* 2 t))) (i (/ (* pi (- (expt d 4) (expt inner 4))) 64)))
    (make-section 'tube (/ (* pi (- (* d d) (* inner inner))) 4) i i (* 2 i) (/ i d 0.5) (/ i d 0.5) d d t)))

; Saint-Venant's series for the torsion of a rectangle with the sides a >= b.
(define (rectangle-torsion a b)
  (let ((sum (fold (lambda (n s) (+ s (/ (tanh (/ (* n pi a) 2 b)) (expt n 5)))) 0 (iota 12 1 2))))
    (* 1/3 a b b b (- 1 (* (/ 192 (expt pi 5)) (/ b a) sum)))))
(define (tanh x) (if (> x 20) 1 (let ((e (exp (* 2 x)))) (/ (- e 1) (+ e 1)))))

(define (rectangle-section width height)
  (need-positive 'rectangle-section 'width width)
  (need-positive 'rectangle-section 'height height)
  (make-section 'rectangle (* width height) (/ (* width (expt height 3)) 12) (/ (* height (expt width 3)) 12)
    (rectangle-torsion (max width height) (min width height)) (/ (* width height height) 6) (/ (* height width width) 6) width height #f))

; The torsion constant is Bredt's, for the middle line of the wall.
(define (box-section width height t)
  (need-positive 'box-section 'width width)
  (need-positive 'box-section 'height height)
  (need-wall 'box-section t (min width height))
  (let* ((w (- width (* 2 t))) (h (- height (* 2 t)))
         (iy (/ (- (* width (expt height 3)) (* w (expt h 3))) 12)) (iz (/ (- (* height (expt width 3)) (* h (expt w 3))) 12)))
    (make-section 'box (- (* width height) (* w h)) iy iz (/ (* 2 t (square (- width t)) (square (- height t))) (+ width height (* -2 t)))
      (/ iy height 0.5) (/ iz width 0.5) width height t)))

(define (any-section area #:iy [iy any? 0] #:iz [iz any? 0] #:it [it any? 0] #:wy [wy any? #f] #:wz [wz any? #f])
  (need-positive 'any-section 'area area)
  (for-each (lambda (name x) (if (not (and (real? x) (finite? x) (>= x 0))) (error 'any-section "~a must be a number of 0 or more, got ~s" name x)))
    '(iy iz it) (list iy iz it))
  (if (not (eq? (> iy 0) (> iz 0))) (error 'any-section "iy and iz must both be positive, or both be 0 for a bar without bending"))
  (for-each (lambda (name x) (if x (need-positive 'any-section name x))) '(wy wz) (list wy wz))
  (make-section 'any area iy iz it wy wz #f #f #f))

; ---- materials ----

; modulus and shear: moduli of elasticity and of shear in Pa; density in kg/m3; strength in Pa, #f if unknown
(define-record-type elastic (make-structural-material name modulus shear density strength) structural-material?
  (name material-kind) (modulus modulus-of) (shear shear-of) (density density-of) (strength strength-of))

; Steel: EN 1993-1-1, 3.2.6 and table 3.1 (yield strengths up to 40 mm); EN 1991-1-1, table A.4 (density). Timber: EN 338 and
; EN 14080 (mean moduli and densities; bending strengths). Concrete: EN 1992-1-1, table 3.1. Aluminium: EN 1999-1-1, 3.2.5.
(define known-materials
  (list (make-structural-material 's235 210e9 81e9 7850 235e6) (make-structural-material 's275 210e9 81e9 7850 275e6)
        (make-structural-material 's355 210e9 81e9 7850 355e6) (make-structural-material 'c16 8e9 0.5e9 370 16e6)
        (make-structural-material 'c24 11e9 0.69e9 420 24e6) (make-structural-material 'c30 12e9 0.75e9 460 30e6)
        (make-structural-material 'gl24h 11.5e9 0.65e9 420 24e6) (make-structural-material 'gl28h 12.6e9 0.65e9 460 28e6)
        (make-structural-material 'gl32h 14.2e9 0.65e9 490 32e6) (make-structural-material 'c25/30 31e9 (/ 31e9 2.4) 2500 25e6)
        (make-structural-material 'aluminium 70e9 27e9 2700 #f)))

(define (structural-material modulus #:shear [shear any? #f] #:density [density any? 0] #:strength [strength any? #f] #:name [name any? 'material])
  (need-positive 'structural-material 'modulus modulus)
  (if shear (need-positive 'structural-material 'shear shear))
  (if (not (and (real? density) (finite? density) (>= density 0))) (error 'structural-material "density must be a number of 0 or more, got ~s" density))
  (if strength (need-positive 'structural-material 'strength strength))
  (make-structural-material name modulus (or shear (/ modulus 2.6)) density strength))

; Returns the material that a record, a known name, or a modulus means.
(define (material-of who m)
  (cond
    ((structural-material? m) m)
    ((and (symbol? m) (find (lambda (k) (eq? (material-kind k) m)) known-materials)))
    ((positive-number? m) (structural-material m))
    (else (error who "materials must be one of ~a, a modulus in Pa or a structural-material, got ~s" (map material-kind known-materials) m))))

; Warns of numbers that must be in other units.
(define (check-material-units who m)
  (let ((e (modulus-of m)) (rho (density-of m)) (f (strength-of m)))
    (cond
      ((< e 1e8) (warn (format "~a: a modulus of ~a Pa is softer than rubber: pascals are expected, 1 MPa is 1e6 Pa, 1 GPa is 1e9 Pa" who e)))
      ((> e 1e13) (warn (format "~a: a modulus of ~a Pa is stiffer than diamond: pascals are expected" who e))))
    (if (and f (< f 1e5)) (warn (format "~a: a strength of ~a Pa is less than that of snow: pascals are expected, 1 MPa is 1e6 Pa" who f)))
    (if (and (> rho 0) (or (< rho 20) (> rho 25000)))
        (warn (format "~a: a density of ~a is that of no building material: kg/m3 are expected, 7850 for steel" who rho)))))

(define (check-section-units who s)
  (if (> (section-area s) 25)
      (warn (format "~a: a section of ~a m2 is larger than a room's floor: metres are expected, 1 mm is 0.001 m" who (section-area s)))))
