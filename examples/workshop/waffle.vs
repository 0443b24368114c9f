; A bench of ribs that slide into each other: as a model, or as parts for a laser with -D flat=true:
; vs examples/workshop/waffle.vs -D flat=#t -o parts.svg

(define-parameter across 9 #:min 2 #:max 30 #:label "ribs across")
(define-parameter along 3 #:min 2 #:max 8 #:label "ribs along")
(define-parameter thickness 18 #:min 6 #:max 30 #:label "thickness of the board, mm")
(define-parameter flat #f #:label "parts side by side")

(units 'mm)
(define (seat x) (+ 420 (* 30 (cos (/ (* 2 2pi x) 1600)))))
(define top (map (lambda (x) (xz x (seat x))) (range 0 1601 40)))
(define side (make-polygon (append (list (xz 0 0)) top (list (xz 1600 0)))))
(define dish (do-scale (make-sphere origin 1) (list 900 300 70)))
(define bench
  (subtract (do-extrude side (vxyz 0 480 0))
            (do-move dish (vxyz 800 240 465))
            (make-cylinder (xyz 800 -1 -120) (xyz 800 481 -120) 420)))

(define-values (ribs-across ribs-along)
  (ribs bench #:x across #:y along #:thickness thickness #:clearance 0.3 #:placed (not flat)))

; a rib in place is as thick as the board
(define (board part) (do-thicken (part-region part) thickness))

(if flat
    (begin
      (for ([p ribs-across] [i (in-naturals)])
        (draw (do-move p (vxyz (* 520 (remainder i 3)) (* 480 (quotient i 3)) 0))))
      (for ([p ribs-along] [i (in-naturals)]) (draw (do-move p (vxyz 1700 (* 480 i) 0))))
      (view "parts" 'top #:sheet 'none))
    (begin
      (draw (with-material wood (map board (append ribs-across ribs-along))))
      (view-from 'iso)))
