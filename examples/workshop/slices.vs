; A vase of stacked sheets, for a laser: vs examples/workshop/slices.vs -o cutting.svg
; Layer "cut" is cut; "engrave" has the number of each sheet and the outline of the one above it.

(define-parameter thickness 6 #:min 3 #:max 20 #:label "thickness of the sheets, mm")
(define-parameter dowel 3 #:min 2 #:max 6 #:label "diameter of the dowels, mm")

(units 'mm)
(define (radius z) (+ 42 (* 14 (sin (/ z 22)))))
(define wall (map (lambda (z) (xz (radius z) z)) (range 0 121 4)))
(define profile (make-line (append (list origin) wall (list (xz 0 120)))))
(define outside (do-revolve (join-curves profile (make-line (xz 0 120) origin)) 'z))
(define vase (subtract outside (do-move (do-scale outside origin '(0.55 0.55 1)) (vxyz 0 0 12))))

(define sheets (slices vase thickness #:registration 'dowels #:diameter dowel))
(printf "~a sheets, ~a square centimetres to cut~%"
        (length sheets)
        (round (/ (apply + (map area sheets)) 100)))

; in rows, each as wide as the vase; all in one plane
(define-values (low high) (apply values (bounding-box vase)))
(define pitch (+ 4 (- (cx high) (cx low))))
(for ([s sheets] [i (in-naturals)])
  (define place
    (vxyz (* pitch (remainder i 5)) (* pitch (quotient i 5)) (- (cz (first (bounding-box s))))))
  (draw (with-material 'plywood (do-move s place))))
(view "cutting" 'top #:sheet 'none)
