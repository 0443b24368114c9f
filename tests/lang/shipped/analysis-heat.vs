; (visualscheme analysis): U-values and the monthly balance, beside calculations by hand
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max (abs a) (abs b)))))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
; plaster, brick, insulation, render: .13 + .0214286 + .5333333 + 4.5714286 + .0172414 + .04 = 5.3134319
(say (same? (u-value '((0.015 0.7) (0.24 0.45) (0.16 0.035) (0.015 0.87))) (/ 1 (+ 0.13 0.04 3/140 (/ 0.24 0.45) (/ 0.16 0.035) (/ 0.015 0.87))))
     (near? (u-value '((0.015 0.7) (0.24 0.45) (0.16 0.035) (0.015 0.87))) 0.1882023 1e-7)
     (same? (u-value '((0.02 0.13) 0.18 (0.02 0.13)) #:inner 0.1 #:outer 0.1) (/ 1 (+ 0.2 0.18 (/ 0.04 0.13)))))
; expect: (#t #t #t)
(fails (u-value '()))               ; expect: u-value: layers must be a list of lists of a thickness and a conductivity, got ()
(fails (u-value '((0.2 0))))        ; expect: u-value: a layer must be (list thickness conductivity) in m and W/mK, or a resistance in m2K/W, got (0.2 0)
(fails (u-value '((0.2 1)) #:inner -1)) ; expect: u-value: inner must be a resistance of 0 or more, got -1
(u-value '((240 0.8)))              ; expect warning: u-value: a layer is 240 m thick: metres are expected, 1 mm is 0.001 m

; January of a house, by hand: losses of 97.5 W/K through surfaces and 200/3 W/K by air; 20 K, 744 h; gains 400 W and the sun
(define cold '(0 1 4 8 13 16 18 21 14 9 4 1))
(define sun '(30 45 70 90 100 100 105 95 80 55 35 25))
(define (house capacity)
  (heat-balance #:surfaces '((300 0.2) (100 0.3 0.5) (25 0.9)) #:windows (list (list 20 0.5 sun)) #:volume 400 #:outside cold #:internal 400 #:capacity capacity))
(define january (first (house 4e7)))
(define losses (* (+ 97.5 200/3) 20 0.744))
(define gains (+ (* 0.4 744) 300))
(define a (+ 1 (/ 4e7 3600 (+ 97.5 200/3) 15)))
(define use (let ((g (/ gains losses))) (/ (- 1 (expt g a)) (- 1 (expt g (+ a 1))))))
(say (same? (first january) (* 97.5 20 0.744)) (same? (second january) (* 200/3 20 0.744)) (same? (third january) 297.6) (same? (fourth january) 300)
     (same? (fifth january) use) (same? (sixth january) (- losses (* use gains))))
; expect: (#t #t #t #t #t #t)
; a month warmer than the house needs no heat; a heavier house uses more of its gains; gains that equal the losses
(say (sixth (list-ref (house 4e7) 7)) (every (lambda (heavy light) (<= (sixth heavy) (+ (sixth light) 1e-9))) (house 1e9) (house 1e6))
     (same? (fifth (first (heat-balance #:surfaces '((100 1)) #:outside (make-list 12 10) #:internal 1000))) 1/2))
; expect: (0.0 #t #t)
(fails (heat-balance #:surfaces '((1 1)) #:outside '(1 2))) ; expect: heat-balance: outside must be a list of 12 numbers, got (1 2)
(fails (heat-balance #:surfaces '((1)) #:outside cold))     ; expect: heat-balance: a surface must be (list area u-value) or (list area u-value factor), got (1)
(fails (heat-balance #:windows '((1 2 3)) #:outside cold))  ; expect: heat-balance: a window must be (list area g irradiations), got (1 2 3)
; expect no other warnings
