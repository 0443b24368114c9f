; Geometry: a million points through composed closures and 4 x 4 transforms.
(define (translated f v) (lambda (t) (p+v (f t) v)))
(define (scaled f s) (lambda (t) (let ((p (f t))) (xyz (* s (cx p)) (* s (cy p)) (* s (cz p))))))
(define (transformed f m) (lambda (t) (apply-matrix m (f t))))
(define (apply-matrix m p)
  (let ((x (cx p)) (y (cy p)) (z (cz p)))
    (xyz (+ (* (vector-ref m 0) x) (* (vector-ref m 1) y) (* (vector-ref m 2) z) (vector-ref m 3))
         (+ (* (vector-ref m 4) x) (* (vector-ref m 5) y) (* (vector-ref m 6) z) (vector-ref m 7))
         (+ (* (vector-ref m 8) x) (* (vector-ref m 9) y) (* (vector-ref m 10) z) (vector-ref m 11)))))
(define (helix r pitch) (lambda (t) (xyz (* r (cos t)) (* r (sin t)) (* pitch t))))
(define path
  (translated
    (transformed
      (scaled (helix 3.0 .25) 1.5)
      (vector .8 -.6 0.0 1.0
              .6 .8 0.0 2.0
              0.0 0.0 1.0 3.0
              0.0 0.0 0.0 1.0))
    (vxyz 10.0 20.0 30.0)))
(define (run n)
  (let loop ((i 0) (p (path 0.0)) (length 0.0))
    (if (= i n)
        length
        (let ((q (path (* .0001 (+ i 1)))))
          (loop (+ i 1) q (+ length (distance p q)))))))
(write (inexact->exact (round (* 1000 (run 1000000)))))
