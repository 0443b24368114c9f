; 225 houses, no two alike, each carved: walls, four windows, a door, a roof and a chimney. A parameter changes one of them.
(define-parameter door 1.0 #:min 0.5 #:max 2.0 #:label "width of one house's door")
(define-parameter side 15 #:min 1 #:max 60)
(define (house x y w d h door)
  (unite
    (subtract
      (make-box (xyz x y 0) (xyz (+ x w) (+ y d) h))
      (make-box (xyz (+ x .3) (+ y .3) .3) (xyz (+ x w -.3) (+ y d -.3) (- h .3)))
      (make-box (xyz (+ x (/ w 2)) (- y 1) .3) (xyz (+ x (/ w 2) door) (+ y 1) 2.3))
      (for/list ([k (in-range 4)])
        (make-cylinder (xyz (+ x 1 (* k .9)) (- y 1) (- h 1)) (xyz (+ x 1 (* k .9)) (+ y 1) (- h 1)) .35)))
    (make-pyramid (xyz (+ x (/ w 2)) (+ y (/ d 2)) h) (* .5 (+ w d)) 4 (xyz (+ x (/ w 2)) (+ y (/ d 2)) (+ h 3)))
    (make-cylinder (xyz (+ x 1.5) (+ y 1.5) h) 3 .4)
    (make-sphere (xyz (+ x 1.5) (+ y 1.5) (+ h 3.2)) .5)))
(for* ([i (in-range side)] [j (in-range side)])
  (let ([w (+ 6 (random 2.0))] [d (+ 5 (random 2.0))] [h (+ 3 (random 1.5))])
    (draw (house (* 18 i) (* 18 j) w d h (if (and (= i 2) (= j 3)) door 1.0)))))
