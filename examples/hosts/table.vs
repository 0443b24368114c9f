; A table for the viewer beside this file. The slider in front of it sets its height, and the stools follow; the arrow
; makes it longer, the tripod moves the lamp, and a click on the yellow ball sets down another stool. The lamp's shade
; turns.
(define-parameter top-length 2.0 #:min 1.2 #:max 4 #:label "length of the top")

(define table (node-create #:name "table" #:parent (node-getroot)))
(define stools (node-create #:name "stools" #:parent (node-getroot)))
(define top (node-create #:name "top" #:parent table)) ; what stands on the table hangs here
(define lamp (node-create #:name "lamp" #:parent top))
(node-create #:name "floor" #:parent (node-getroot)
             #:drawing (with-material 'concrete (make-box (xyz -1.8 -1.8 -0.1) (xyz 4.2 1.4 0))))

(define height (make-slider (xyz -0.5 -1.6 0.4) (xyz -0.5 -1.6 1.4) 0.4 1.4 #:value 0.8 #:step 0.05
                            #:size 0.2 #:name "height" #:parent (node-getroot)))
(define longer (make-arrow (xyz top-length 0 -0.03) ux -0.8 1.4 #:size 0.4 #:name "longer" #:parent top))
(define mover (make-tripod (xyz 1 0 0) (vxyz 0.6 0.3 0) #:size 0.5 #:name "mover" #:parent top))
(make-trigger (xyz -1.5 -1.6 0.3) (lambda (gizmo) (add-stool)) #:size 0.3 #:name "another" #:parent (node-getroot))

(define (leg x y h) (make-cylinder (xyz x y 0) h 0.05))
(define (furnish)
  (define h (property-get height 'value))
  (define l (+ top-length (property-get longer 'value)))
  (node-setdrawing table
    (with-material 'oak
      (make-box (xyz 0 -0.5 (- h 0.06)) (xyz l 0.5 h))
      (leg 0.1 -0.4 (- h 0.06)) (leg 0.1 0.4 (- h 0.06)) (leg (- l 0.1) -0.4 (- h 0.06)) (leg (- l 0.1) 0.4 (- h 0.06))))
  (node-translate top (vxyz 0 0 h))
  (node-translate lamp (v+v (vxyz 1 0 0) (property-get mover 'value)))
  (node-scale stools (vxyz 1 1 (/ h 0.8))))

(define stool
  (with-material 'steel (make-cylinder origin 0.45 0.04) (make-cylinder (xyz 0 0 0.45) 0.05 0.2)))
(define (add-stool)
  (define i (length (node-getchildren stools)))
  (if (< i 4) ; as many as fit in
    (node-create #:name (format "stool ~a" (+ i 1)) #:parent stools #:drawing stool
                 #:translate (vxyz (+ 0.4 (* 0.5 i)) -0.9 0))))

(node-setdrawing lamp (with-material 'gold (make-cylinder origin 0.4 0.02) (make-cylinder origin 0.02 0.12)))
(define shade
  (node-create #:name "shade" #:parent lamp #:translate (vxyz 0 0 0.35)
               #:drawing (with-material 'plaster (make-cut-cone origin 0.18 (xyz 0 0 0.2) 0.08))))
(every-frame (lambda (seconds) (node-rotate shade (v+v (node-getrotate shade) (vxyz 0 0 (* 90 seconds))))))
(for ([gizmo (list height longer mover)])
  (property-subscribe (property-ref gizmo 'value) (lambda (v) (furnish))))
(add-stool) (add-stool)
(furnish)
