; Parametric chairs, after Grimaldo: one stands on the shelf, to be fitted; the desk has eight places for copies of it.
;
; The sliders beside the shelf set the height of the seat and its width. A click on the chair of the shelf, or on the trigger in front of
; it, puts a copy at the next place of the desk: a ninth is an error, and nothing changes. A click on the trigger behind the desk clears it. Chairs of equal
; measures are one object in several places.

(define root (node-getroot))
(define places 8)
(define floor
  (with-material 'concrete (make-box (xyz -4.6 -2.2 -0.1) (xyz 2.4 2.2 0))))
(define table-top
  (with-material 'oak (make-cylinder (xyz 0 0 0.7) 0.05 1) (make-cylinder origin 0.7 0.12)))
(draw floor table-top (with-material 'plaster (make-box (xyz -4 -0.6 0) (xyz -2.8 0.6 0.4))))

; A chair looks along X: its back is behind it.
(define (chair height width)
  (define half (/ width 2))
  (define (leg x y) (make-box (xyz (- x 0.02) (- y 0.02) 0) (xyz (+ x 0.02) (+ y 0.02) height)))
  (define inner (- half 0.02))
  (with-material 'steel
    (unite
      (make-box (xyz (- half) (- half) (- height 0.04)) (xyz half half height))
      (make-box (xyz (- half) (- half) height) (xyz (- 0.04 half) half (+ height 0.45)))
      (leg inner inner) (leg inner (- inner)) (leg (- inner) inner) (leg (- inner) (- inner)))))

(define shelf (node-create #:name "shelf" #:parent root #:translate (vxyz -3.4 0 0.4)))
(define desk (node-create #:name "desk" #:parent root))

(define height (make-slider (xyz -4 -1.2 0.5) (xyz -4 -1.2 1.5) 0.35 0.75 #:value 0.45 #:name "height" #:parent root))
(define width (make-slider (xyz -4 -1.6 0.1) (xyz -2.8 -1.6 0.1) 0.3 0.6 #:value 0.45 #:name "width" #:parent root))
(define (fit-chair . ignored)
  (node-setdrawing shelf (chair (property-get height 'value) (property-get width 'value))))
(for ([gizmo (list height width)]) (property-subscribe (property-ref gizmo 'value) fit-chair))
(fit-chair)

(define (put-on-desk . ignored)
  (define i (length (node-getchildren desk)))
  (if (>= i places) (error 'put-on-desk "the desk has ~a places, and all are taken" places))
  (define degrees (* 360/8 i))
  (node-create #:name (format "chair ~a" (+ i 1)) #:parent desk #:drawing (node-getdrawing shelf)
               #:translate (vpol 1.4 (degrees->radians degrees)) #:rotate (vxyz 0 0 (+ degrees 180))))

(on-pick shelf put-on-desk)
(make-trigger (xyz -1.8 -1.6 0.1) put-on-desk #:name "put a chair" #:parent root)
(make-trigger (xyz 1.6 1.6 0.1) (lambda (gizmo) (node-removechildren desk)) #:name "clear the desk" #:parent root)
