; Listings 5.1 to 5.5 of the VisualScheme thesis: the roof of the Gare do Oriente, in the thesis' order and names. A library: 5.4-parametrisations.vs
; and 5.5-gare.vs draw with it.
;
; Repairs are marked. What the listings call and the thesis does not print (rod, rods, beam-base) stands first.

(define (rod p0 p1)                         ; the thinnest of the rods; nothing where both ends are one point, as the first of every sequence
  (if (near? p0 p1) (empty-object) (make-cylinder p0 p1 0.1)))

(define (rods ps qs)
  (unite (map rod ps qs)))

; check: allow unused-parameter
(define (beam-base p rho phi)               ; a circle, as the thesis had it for its first tests
  (make-circle p (/ rho 30)))

; Listing 5.1: the model's basic shapes

(define (support-rod-medium p0 p1)
  (make-cylinder p0 p1 0.4))

(define (support-rod-small p0 p1)
  (make-cylinder p0 p1 0.2))

(define (triangle p0 p1 p2)
  (do-thicken (make-region (make-line (list p0 p1 p2 p0))) 0.0001))

; Listing 5.2: a roof plate

(define (roof-plate p0 p1 p2 n)
  (unite
    (rods (line-sequence p0 p1 n)
          (line-sequence p0 p2 n))
    (triangle p0 p1 p2)))

; Listing 5.3: a support beam

(define (arc-beam p rho phi psi0 psi1 n)
  (do-sweep
    (beam-base p rho phi)
    (make-spline
      (arc-sequence (+pol p rho phi) rho (+ phi pi) psi0 psi1 n))     ; repaired: phi, which would lead away from p
    0     ;; Taper angle (in Appendix A the argument is the twist)
    0.5)) ;; Scale

; Listing 5.4 (a): roof support rods

(define (roof-support p pr rho phi psi0 psi1 p0 p1 n-bars)
  (unite
    (map (lambda (p0 p1 p2)
           (unite
             (rod p0 p1)
             (rod p0 p2)))
         (reverse (linear-h-arc-sequence (+pol p rho phi) rho (+ phi pi)    ; repaired: p, which is on the arc and not its centre
                                         psi0 psi1 n-bars))
         (line-sequence pr p0 n-bars)                                       ; repaired: a parenthesis before this line ends the map too early
         (line-sequence pr p1 n-bars))))

; Listing 5.4 (b): the completed prototype

(define (beams-and-roof p rho psi0 psi1 n h0 h1 n-bars)
  (let* ([pc (+z p (arc-height rho pi/2 psi1))]               ;; Point of contact among beams
         [pr (+z pc (- (arc-height rho psi0 pi/2) h0))]       ;; Center of ceiling
         [r (arc-width rho psi0 pi/2)])
    (define (helper phi)                                      ; repaired: (define helper (phi) ...
      (let ([p0 (+cil pr r phi h0)]
            [p1 (+cil pr (* (sqrt 2) r) (+ phi pi/4) h1)]
            [p2 (+cil pr r (+ phi pi/2) h0)]
            [p3 (+cil pr (* (sqrt 2) r) (- phi pi/4) h1)])
        (unite (support-rod-medium pr p0)
               (support-rod-small pr p1)
               (roof-plate pr p0 p1 n-bars)
               (roof-plate pr p1 p2 n-bars)
               (arc-beam pc rho phi psi0 psi1 n)
               (roof-support pc pr rho phi psi0 (min psi1 pi/2) p1 p3 n-bars))))  ; repaired: psi1; rods stand on what is above the contact
    (unite
      (map helper
           (enumerate 0 2*pi 4)))))                               ; repaired: a parenthesis too many at the end

; Listing 5.5: the full Gare do Oriente

(define (gare x y)
  (let ((rho 20)
        (psi0 (/ pi 8))
        (psi1 (/ pi 2)))
    (let ((width (* 2 (arc-width rho psi0 psi1))))
      (distribute-in-space
        (lambda (p)
          (beams-and-roof p rho psi0 psi1 30 1 3 10))
        (xyz 0 0 0)         ; origin of the box
        (xyz width width 0) ; box boundary
        x                   ; X dimension
        y                   ; Y dimension
        1))))               ; Z dimension; repaired: a parenthesis too many at the end
