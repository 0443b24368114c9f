; Tests the objects of listings 5.1 to 5.5 of the thesis: zenith angles, vertical props, beams that meet where the text says, feet below the point of contact.
(require "../../examples/thesis/gare.vs")
(define (ok? name x want [tolerance any? 1e-9]) (if (not (near? x want tolerance)) (printf "~a: ~a, not ~a\n" name x want)))
(define rho 20)
(define psi0 pi/8)

; psi is the angle from straight up, as in sph: 0 is above the centre, pi/2 level with it
(define arc (arc-sequence origin rho 0 psi0 pi/2 3))
(ok? "an arc begins" (first arc) (sph rho 0 psi0))
(ok? "an arc begins in numbers" (first arc) (xyz 7.653668647301796 0 18.477590650225736))
(ok? "an arc ends" (last arc) (xyz rho 0 0))
(ok? "its height" (arc-height rho psi0 pi/2) (cz (first arc)))
(ok? "its width" (arc-width rho psi0 pi/2) (- rho (cx (first arc))))
(define level-steps (linear-h-arc-sequence origin rho 0 psi0 pi/2 5))
(for ([a level-steps] [b (rest level-steps)])
  (ok? "equal steps as seen from above" (- (cx b) (cx a)) (/ (arc-width rho psi0 pi/2) 4))
  (ok? "on the arc" (distance origin b) rho))

; what roof-support makes its props of: from a point of the beam to the two lines of the roof over it. Seen across the beam every prop is vertical:
; on the axis in the direction phi its ends are equally far out
(define n-bars 10)
(define h0 1)
(define h1 3)
(define (props psi1)
  (let* ([pc (+z origin (arc-height rho pi/2 psi1))] [pr (+z pc (- (arc-height rho psi0 pi/2) h0))] [r (arc-width rho psi0 pi/2)])
    (map list
         (reverse (linear-h-arc-sequence (+pol pc rho 0) rho pi psi0 (min psi1 pi/2) n-bars))
         (line-sequence pr (+cil pr (* (sqrt 2) r) pi/4 h1) n-bars)
         (line-sequence pr (+cil pr (* (sqrt 2) r) -pi/4 h1) n-bars))))
(for ([psi1 (list pi/2 (* 5/8 pi))])
  (for ([prop (props psi1)])
    (ok? "a prop is vertical" (cx (first prop)) (cx (second prop)))
    (ok? "a prop is vertical on the other side" (cx (first prop)) (cx (third prop)))))

; the whole tree: the roof is as wide as the arc, its corners h1 above the middle; slender: at its foot only the beams' sections
(define (tree psi1) (beams-and-roof origin rho psi0 psi1 12 h0 h1 4))
(define (size o) (apply p->q (bounding-box o)))
(define slender (tree pi/2))
(define r (arc-width rho psi0 pi/2))
(ok? "the roof's width" (cx (size slender)) (* 2 r) 0.8)
(ok? "the roof's height" (cz (second (bounding-box slender))) (+ (arc-height rho psi0 pi/2) (- h0) h1) 0.5)
(define (spread o z) (cx (size (intersect o (make-box (xyz -99 -99 (- z 0.1)) (xyz 99 99 (+ z 0.1)))))))
(displayln (< (spread slender 0.5) 3)) ; expect: #t
; figure 5.4 b: past pi/2 the beams go on below their point of contact, and stand on feet that are farther apart
(define spread-feet (tree (* 5/8 pi)))
(define contact (arc-height rho pi/2 (* 5/8 pi)))
(ok? "feet" (spread spread-feet 0.3) (* 2 (arc-width rho pi/2 (* 5/8 pi))) 1.5)
(displayln (< (spread spread-feet (+ contact 0.5)) 3)) ; expect: #t
(ok? "the same roof, as much higher" (cz (second (bounding-box spread-feet))) (+ contact (cz (second (bounding-box slender)))) 0.5)
; listing 5.5: trees side by side, each around the middle of its cell
(define (two) (distribute-in-space (lambda (p) (make-box (+xyz p -1 -1 0) (+xyz p 1 1 2))) origin (xyz (* 2 r) (* 2 r) 0) 2 1 1))
(displayln (near? (first (bounding-box (two))) (xyz (- r 1) (- r 1) 0))) ; expect: #t
