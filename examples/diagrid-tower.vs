; A tower of 24 storeys whose diagrid of steel tubes sizes itself under weight, floors and wind. Each group of tubes, two storeys
; of one face, takes the lightest tube of a catalogue that suffices; so the tubes grow towards the ground.
;
; What it teaches: design-cases makes the combinations of EN 1990, wind-pressure the wind of EN 1991, size-frame chooses sections
; until the check of EN 1993 holds, frame-picture shows them with their shares.
(import (visualscheme) (visualscheme analysis))

(define-parameter storeys 24 #:min 8 #:max 60)      ; in steps of two
(define-parameter storey 4 #:min 3 #:max 6)         ; metres
(define-parameter radius 14 #:min 8 #:max 30)
(define-parameter sides 12 #:min 8 #:max 32 #:step 2)
(define-parameter wind 27 #:min 15 #:max 45)        ; m/s

; Rings of nodes lie every two storeys, and each is turned by half a side against the next.
(define rings (+ 1 (quotient storeys 2)))
(define (ring-height k) (* 2 storey k))
(define (waist k) (* radius (- 1 (* 0.22 (sin (* pi (/ k (- rings 1))))))))
(define (place k i) (cyl (waist k) (* 2 pi (/ (+ i (/ k 2)) sides)) (ring-height k)))
(define (number k i) (+ 1 (* k sides) (modulo i sides)))
(define ring (iota sides))
(define nodes (append-map (lambda (k) (map (lambda (i) (place k i)) ring)) (iota rings)))
(define diagonals (append-map (lambda (k) (append-map (lambda (i) (list (list (number k i) (number (+ k 1) i)) (list (number k i) (number (+ k 1) (- i 1))))) ring)) (iota (- rings 1))))
(define hoops (append-map (lambda (k) (map (lambda (i) (list (number k i) (number k (+ i 1)))) ring)) (iota (- rings 1) 1)))
(define members (append diagonals hoops))
(define feet (iota sides 1))

; Two floors hang on each ring, half of them in the core; the wind blows along x on the width of the tower.
(define (floor-load k) (* 2 pi (square (waist k)) 1/2))
(define (at-ring k load) (list (map (lambda (i) (number k i)) ring) (v/r load sides)))
(define upper (iota (- rings 1) 1))
(define loads
  (list (cons "dead" (cons 'weight (map (lambda (k) (at-ring k (vxyz 0 0 (* -4.5e3 (floor-load k))))) upper)))
        (cons "live" (map (lambda (k) (at-ring k (vxyz 0 0 (* -2.5e3 (floor-load k))))) upper))
        (cons "wind" (map (lambda (k) (at-ring k (vxyz (* 0.9 (wind-pressure wind (ring-height k) #:terrain 'III) 2 (waist k) 2 storey) 0 0))) upper))))
(define catalogue (map (lambda (d) (tube-section (first d) (second d)))
                    '((0.1683 0.008) (0.2191 0.01) (0.273 0.0125) (0.3239 0.0125) (0.3556 0.016) (0.4064 0.02) (0.457 0.025) (0.508 0.032) (0.61 0.04))))
; Groups: the diagonals between two rings, and each ring's hoop.
(define (span from n) (iota n (+ 1 from)))
(define groups (append (map (lambda (k) (span (* 2 sides k) (* 2 sides))) (iota (- rings 1))) (map (lambda (k) (span (+ (length diagonals) (* sides k)) sides)) (iota (- rings 1)))))
(define r
  (size-frame (frame nodes members #:supports (list (list feet 'pinned)) #:loads loads #:sections (first catalogue) #:materials 's355) catalogue
    #:combine (lambda (r) (design-cases r #:permanent "dead" #:variable '(("live" b) ("wind" wind))))
    #:share (lambda (r i) (utilisation r i #:forming 'hot)) #:groups groups))

(define weight
  (apply + (map (lambda (m i) (* 7850 (section-area (member-section r i)) (distance (list-ref nodes (- (first m) 1)) (list-ref nodes (- (second m) 1))))) members (iota (length members) 1))))
(define shares (map (lambda (i) (utilisation r i #:forming 'hot)) (iota (length members) 1)))
(define windy "1.35 dead + 1.5 wind + 1.05 live")
(printf "~a members, ~a t of steel, greatest share ~a~%" (length members) (round (/ weight 1000)) (/ (round (* 100 (apply max shares))) 100))

(define top (ring-height (- rings 1)))
(camera (xyz -62 -100 30) (xyz 3 0 (* 0.5 top)) #:lens 40)
(draw
  (frame-picture r #:case windy)
  (color '(0.86 0.87 0.88) (map (lambda (k) (make-cylinder (xyz 0 0 (* storey k)) 0.25 (* 0.97 (waist (/ k 2))))) (iota storeys 1)))
  (color '(0.6 0.61 0.63) (make-cylinder origin (xyz 0 0 (+ top 3)) 5.5))
  (color '(0.83 0.81 0.77) (make-box (xyz -300 -300 -0.3) (xyz 300 300 0)))
  (do-move (do-rotate (color-legend 0 1 #:size 5 #:format (lambda (v) (format "~a %" (exact (round (* 100 v)))))) 'z -0.55) (vxyz 19 -14 0)))
