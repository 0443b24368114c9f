; A record's predicate, folds with tests, a primitive with a body.
(define-record-type pin (make-pin a b) pin? (a pin-a) (b pin-b))
(define size (if (pin? (make-pin 3 2)) (pin-a (make-pin 3 2)) 1))
(define even-sum (for/fold ([n 0]) ([i 5] #:when (even? i)) (+ n i)))
(define-values (u v) (for/fold ([a 0] [b 1]) ([i 7] #:when (even? i) #:unless (= i 4)) (values (+ a i) (* b 2))))
(define-primitive (post [at point?] [height number? 2]) (make-cylinder at height 0.2))
(draw (make-box (xyz 0 40 0) (xyz size 42 even-sum)))
(draw (make-box (xyz 10 40 0) (xyz (+ 10 u) (+ 40 v) (pin-b (make-pin 3 2)))))
(draw (post (xyz -5 40 0)) (post (xyz -7 40 0) 5))
