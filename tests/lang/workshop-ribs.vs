; ribs: parts of the thickness in place never intersect, and all material of the sections is there but for the slots
(define (region-of part) (let loop ((o part)) (if (region? o) o (loop (car (object-children o))))))
(define (solid part v t) (do-move (do-extrude (region-of part) (v*r v t)) (v*r v (/ t -2))))
(define (placed o nx ny t c) (call-with-values (lambda () (ribs o #:x nx #:y ny #:thickness t #:clearance c #:placed #t)) list))
(define dome (intersect (make-sphere origin 10) (make-box (xyz -10 -10 0) (xyz 10 10 10))))
(define ring (do-move (make-torus origin 8 3) (vxyz 3 -2 7)))
(define vault (subtract (make-box origin (xyz 12 8 6)) (make-box (xyz 1 1 1) (xyz 11 7 5))))
(define pieces (unite (make-box origin (xyz 4 4 4)) (make-box (xyz 6 0 0) (xyz 10 4 7))))
(define leaning (do-rotate (make-cone origin (xyz 0 0 12) 5) 'x 0.5))
(define cases (list (list dome 5 4 0.4 0) (list dome 7 7 0.5 0.1) (list ring 6 5 0.3 0.05) (list vault 4 3 0.5 0) (list pieces 4 3 0.4 0.02) (list leaning 4 4 0.4 0)))
(define (fits? o nx ny t c)
  (let* ((both (placed o nx ny t c)) (a (map (lambda (p) (solid p ux t)) (first both))) (b (map (lambda (p) (solid p uy t)) (second both))))
    (list (length a) (length b) (< (volume (intersect (unite a) (unite b))) 1e-6))))
(displayln (map (lambda (l) (apply fits? l)) cases))
; expect: ((5 4 #t) (7 7 #t) (6 5 #t) (4 3 #t) (4 3 #t) (4 4 #t))
; a box: each rib is the section less its slots, half as deep as the box is high
(define (areas l) (map (lambda (p) (/ (round (* 1e6 (area p))) 1e6)) l))
(define both (placed (make-box origin (xyz 9 6 4)) 3 2 0.5 0.1))
(displayln (list (areas (first both)) (areas (second both))))
; expect: ((21.6 21.6 21.6) (32.4 32.4))
; flat parts lie in XY, of the same areas, upright, with the rib's own layer and name
(define-values (xs ys) (ribs (make-box (xyz 1 2 3) (xyz 10 8 7)) #:x 3 #:y 2 #:thickness 0.5 #:clearance 0.1))
(define (span p) (map (lambda (c) (list (round (cx c)) (round (cy c)) (round (cz c)))) (bounding-box p)))
(displayln (map span (append xs ys)))
; expect: (((2.0 3.0 0.0) (8.0 7.0 0.0)) ((2.0 3.0 0.0) (8.0 7.0 0.0)) ((2.0 3.0 0.0) (8.0 7.0 0.0)) ((1.0 3.0 0.0) (10.0 7.0 0.0)) ((1.0 3.0 0.0) (10.0 7.0 0.0)))
(displayln (list (areas xs) (areas ys)))                   ; expect: ((21.6 21.6 21.6) (32.4 32.4))
(displayln (call-with-values (lambda () (ribs (empty-object) #:thickness 1)) list)) ; expect: (() ())

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (c (#t (condition/report-string c))) e "no error")))))
(fails (ribs (make-circle origin 1) #:thickness 1))        ; expect: ribs: o must be a solid, got (make-circle (xyz 0 0 0) 1)
(fails (ribs dome #:thickness 0))                          ; expect: ribs: thickness must be a positive number, got 0
(fails (ribs dome #:x 0 #:thickness 1))                    ; expect: ribs: x must be an exact integer from 1 to 1000, got 0
(fails (ribs dome #:thickness 1 #:clearance -1))           ; expect: ribs: clearance must be a number that leaves a slot, got -1
(fails (ribs dome #:x 20 #:thickness 1))                   ; expect: ribs: the ribs are 1.0 apart, and a slot takes 1: fewer ribs fit
