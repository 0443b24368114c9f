; The roof of the Gare do Oriente as an engineer sees it: the trees of gare-do-oriente.vs, on their own lines, as a frame of
; steel under weight, glass, snow and wind. Colours show the share of strength that each member uses. The slider `factor`
; draws the movements, so many times as large.
;
; What it teaches: points of a drawing become nodes of a frame, design-cases makes the combinations of EN 1990,
; utilisation checks each member by EN 1993, vibration-modes finds how the roof swings.
; The sections and the shares of the wind are choices of this example, not those of the station.
;
;   vs gare-analysed.vs -D factor=50 -o moved.html
;   vs gare-analysed.vs -D wind=40 -o storm.png
(import (visualscheme) (visualscheme analysis))

(define-parameter columns 4 #:min 1 #:max 8 #:label "trees along the platforms")
(define-parameter rows 3 #:min 1 #:max 6 #:label "platforms")
(define-parameter rho 20.0 #:min 10 #:max 40 #:label "radius of the beams' arcs, metres")
(define-parameter psi0 (/ pi 8) #:min 0.1 #:max 1 #:label "zenith angle where the beams carry the roof")
(define-parameter n-bars 10 #:min 3 #:max 20 #:label "bars in a roof plate")
(define-parameter snow 0.8 #:min 0 #:max 3)    ; kN/m2 on the ground
(define-parameter wind 27 #:min 10 #:max 50)   ; m/s
(define-parameter factor 0 #:min 0 #:max 200 #:label "movements drawn so many times as large")
(define h0 1)
(define h1 3)
(define glass-weight -600)                     ; N/m2, with its glazing bars

; ---- nodes and members ----

; Points that are nearer than a millimetre are one node.
(define numbers (make-hash))
(define nodes '())
(define count 0)
(define (node p)
  (let ((key (map (lambda (x) (exact (round (* 1000 x)))) (list (cx p) (cy p) (cz p)))))
    (or (hash-ref numbers key #f)
        (begin (set! count (+ 1 count)) (hash-set! numbers key count) (set! nodes (cons p nodes)) count))))

; members: lists of two nodes and a kind; the neighbour's edge has the same bars once
(define members '())
(define known (make-hash))
(define (member! kind p q)
  (let* ((a (node p)) (b (node q)) (key (list (min a b) (max a b))))
    (if (not (or (= a b) (hash-ref known key #f))) (begin (hash-set! known key #t) (set! members (cons (list kind a b) members))))))
(define (chain! kind l) (for-each (lambda (p q) (member! kind p q)) (drop-right l 1) (cdr l)))

; The glass between two ridges: quadrilaterals, and a triangle in the middle.
(define panes '())
(define (panes! l m)
  (for-each
    (lambda (p q r s)
      (let ((face (delete-duplicates (map node (list p q r s))))) (set! panes (cons face panes))))
    (drop-right l 1) (cdr l) (cdr m) (drop-right m 1)))

(define r (arc-width rho psi0 pi/2))
(define width (* 2 r))
(define feet '())
(define (tree p)
  (let ((pr (+z p (- (arc-height rho psi0 pi/2) h0))))
    (define (edge phi) (line-sequence pr (+cil pr r phi h0) n-bars))
    (define (corner phi) (line-sequence pr (+cil pr (* (sqrt 2) r) (+ phi pi/4) h1) n-bars))
    (for-each
      (lambda (phi)
        (let ((beam (reverse (linear-h-arc-sequence (+pol p rho phi) rho (+ phi pi) psi0 pi/2 n-bars)))
              (ridge (edge phi)) (next (edge (+ phi pi/2))) (left (corner phi)) (right (corner (- phi pi/2))))
          (chain! 'ridge ridge)
          (chain! 'diagonal left)
          (for-each (lambda (a b c) (member! 'bar a b) (member! 'bar b c)) ridge left next)
          (chain! 'beam beam)
          (member! 'beam (last beam) (last ridge))
          (for-each (lambda (b c d) (member! 'prop b c) (member! 'prop b d)) (cdr beam) (cdr left) (cdr right))
          (panes! ridge left)
          (panes! left next)))
      (list 0 pi/2 pi (* 3 pi/2)))
    (set! feet (cons (node p) feet))))
(for-each (lambda (i) (for-each (lambda (j) (tree (xyz (* width i) (* width j) 0))) (iota rows))) (iota columns))

; ---- the frame ----

(define all-nodes (reverse nodes))
(define all-members (reverse members))
(define place (list->vector (cons #f all-nodes)))
(define (middle m) (let ((p (vector-ref place (second m))) (q (vector-ref place (third m)))) (p+v p (v*r (p->q p q) 1/2))))
; The arcs taper towards the ground, as those of the drawing do.
(define (section-of m)
  (case (car m)
    ((beam) (let ((h (+ 0.5 (* 0.5 (/ (cz (middle m)) rho))))) (box-section (* 0.5 h) h 0.03)))
    ((ridge) (tube-section 0.4064 0.016))
    ((diagonal) (tube-section 0.3239 0.0125))
    ((bar) (tube-section 0.1683 0.008))
    (else (tube-section 0.2191 0.01))))
(define pressure (wind-pressure wind (arc-height rho psi0 pi/2)))
(define loads
  (list (list "dead" 'weight (list 'plan panes (vxyz 0 0 glass-weight)))
        (list "snow" (list 'plan panes (vxyz 0 0 (- (snow-load (* 1000 snow))))))
        ; the wind lifts the roof by half of its pressure, and pushes it along x by a tenth
        (list "wind" (list 'faces panes (vxyz (* 0.1 pressure) 0 (* 0.5 pressure))))))
(define station
  (frame all-nodes (map cdr all-members) #:sections (map section-of all-members) #:materials 's355 #:supports feet #:loads loads))
(define solved (frame-solve station))
(define design (design-cases solved #:permanent '("dead") #:variable '(("snow" snow) ("wind" wind))))
(define worst "1.35 dead + 1.5 snow + 0.9 wind")
(define shares (map (lambda (k) (utilisation design k)) (iota (length all-members) 1)))
(define (greatest kind) (apply max (filter-map (lambda (m u) (and (eq? (car m) kind) u)) all-members shares)))
(define (percent x) (format "~a %" (exact (round (* 100 x)))))
(printf "~a members; greatest shares of strength:~%" (length all-members))
(for-each (lambda (kind) (printf "  ~as ~a~%" kind (percent (greatest kind)))) '(beam ridge diagonal bar prop))
(define sunk (apply max (map (lambda (k) (- (cz (displacement solved k #:case "snow")))) (iota (length all-nodes) 1))))
(printf "snow lowers the roof by ~a mm; it vibrates ~a times a second~%" (round (* 1000 sunk))
  (/ (round (* 100 (mode-value (first (vibration-modes station #:segments 1))))) 100))

; ---- the picture ----

(define long (* width columns))
(define (platform j) (make-box (xyz (- (/ width -2) 4) (- (* width j) 6) -1.1) (xyz (+ (- long (/ width 2)) 4) (+ (* width j) 6) 0)))
(define (person x y coat)
  (unite (color "#3b3f4a" (make-cut-cone (xyz x y 0) 0.16 (xyz x y 0.86) 0.2))
         (color coat (make-cut-cone (xyz x y 0.76) 0.22 (xyz x y 1.42) 0.17) (make-sphere (xyz x y 1.4) 0.175))
         (color "#c99d7c" (make-sphere (xyz x y 1.66) 0.115))))
(draw
  (frame-picture design #:case worst #:factor factor)
  (color '(0.55 0.54 0.52) (map platform (iota rows)))
  (person 7 -2 "#8c4a3a") (person 8 -1.4 "#39708a") (person 20 1 "#c9b68f") (person 36 -1 "#5a6470")
  (do-move (do-rotate (color-legend 0 1 #:size 1.4 #:format percent) 'z -0.91) (vxyz 12 -17 -1)))
(units 'm)
(ground -1.1 #:material (make-material #:name "paving" #:color "#8b8a86" #:roughness 0.9))
(sun #:azimuth 222 #:altitude 42)
(camera (xyz -34 -26 7) (xyz 26 20 12) #:lens 26 #:upright #t)
