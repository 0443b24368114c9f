; The parts of stools, packed on sheets of plywood, with what is engraved on them. All sheets:
;   vs examples/workshop/nested.vs -o cutting.svg
; one file for each sheet: vs examples/workshop/nested.vs -D sheet=1 --view cutting -o sheet-001.dxf

(define-parameter stools 4 #:min 1 #:max 12 #:label "stools")
(define-parameter sheet 0 #:min 0 #:max 20 #:label "sheet to cut; 0: all")
(define-parameter kerf 0.2 #:min 0 #:max 1 #:step 0.05 #:label "width of the cut, mm")

(units 'mm)
(define board 12)

; the seat: a disc with slots for the legs and a hole for a hand
(define (slot angle)
  (do-rotate (make-region (make-rectangle (xy 60 (/ board -2)) (xy 110 (/ board 2)))) 'z angle))
(define seat
  (layer "seat"
    (layer "cut" (subtract (make-region (make-circle origin 170)) (map slot (list 0 (/ 2pi 3) (/ 2pi -3))) (make-region (make-circle origin 22))))
    (layer "engrave" (engrave "STOOL" 18 #:at (xy 0 -130) #:align 'centre))))

; a leg: a bent board with a tenon
(define leg
  (layer "leg"
    (layer "cut"
      (make-region (make-polygon (xy 0 0) (xy 45 0) (xy 70 250) (xy 60 380) (xy 60 392) (xy 10 392) (xy 10 380) (xy 0 380) (xy 20 250))))
    (layer "engrave" (engrave "L" 18 #:at (xy 30 150)))))

; the ring that ties the legs lies in the sheet beside them
(define ring
  (layer "ring" (layer "cut" (subtract (make-region (make-regular-polygon origin 110 6)) (make-region (make-circle origin 70))))))

(define parts (list seat leg ring))
(define sheets
  (pack-parts parts #:sheet '(1200 800) #:gap 4 #:margin 5 #:kerf kerf #:count (list stools (* 3 stools) stools) #:effort 0.3))
(printf "~a sheets, ~a % of them used~%" (length sheets)
        (round (/ (* 100 stools (apply + (map (lambda (p n) (* n (area p))) parts '(1 3 1)))) (* (length sheets) 1200 800))))

(for ([s sheets] [i (in-naturals)] #:when (or (= sheet 0) (= sheet (+ i 1))))
  (define down (vxyz 0 (if (= sheet 0) (* -850 i) 0) 0))
  (draw (layer "sheet" (do-move (make-rectangle origin (xy 1200 800)) down) #:color "gray"))
  (draw (do-move s down)))
(view "cutting" 'top #:sheet 'none #:scale 4)
