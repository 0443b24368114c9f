; A canopy of sheet metal, part of a cone: its strips laid flat, each with its number, on sheets:
; vs examples/workshop/panels.vs -D flat=#t -o strips.svg

(define-parameter strips 9 #:min 3 #:max 24 #:label "strips")
(define-parameter flat #f #:label "strips on sheets")

(define apex (xyz 0 0 7))
; the canopy's edge: a wave around the apex
(define (edge angle) (+pol (xyz 0 0 (+ 3 (* 0.6 (sin (* 3 angle))))) (+ 4 (* 0.8 (cos (* 2 angle)))) angle))
(define (strip i)
  (make-surface
    (lambda (u v)
      (let ((outer (edge (* pi (/ (+ i u) strips)))))
        (intermediate-point apex outer (+ 0.25 (* 0.75 v)))))
    0 1 0 1 #:nu 12 #:nv 1))
(define surfaces (map strip (iota strips)))

(define (part s i)
  (define cut (unroll s))
  (layer (format "strip ~a" (+ i 1))
    (layer "cut" cut)
    (layer "engrave" (engrave (number->string (+ i 1)) 0.2 #:at (centroid cut) #:align 'centre))))
(define parts (map part surfaces (iota strips)))
(printf "~a square metres of ~a~%" (/ (round (* 100 (apply + (map area parts)))) 100) (/ (round (* 100 (apply + (map area surfaces)))) 100))

(if flat
    (let ((sheets (pack-parts parts #:sheet '(6 2) #:gap 0.02 #:margin 0.02 #:effort 0.2)))
      (printf "~a sheets~%" (length sheets))
      (for ([s sheets] [i (in-naturals)])
        (define down (vxyz 0 (* -2.3 i) 0))
        (draw (layer "sheet" (do-move (make-rectangle origin (xy 6 2)) down)) (do-move s down)))
      (view "strips" 'top #:sheet 'none #:scale 20))
    (begin
      (draw (with-material copper surfaces))
      (camera (xyz 6 -9 8) (xyz 0 1.5 4.4) #:lens 35)))
