; A hundred thousand posts, each as high as it happens to be, and one that a parameter says.
(define-parameter count 100000)
(define-parameter height 3)
(for ([i count])
  (draw (make-cylinder (xyz (* 1.5 (modulo i 317)) (* 1.5 (quotient i 317)) 0) (if (= i 777) height (+ 1 (* 0.00001 i))) 0.5)))
