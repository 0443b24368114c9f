; A colonnade: columns along two sides of a court
(define radius 0.4)
(define height 5)

(define (column foot)
  (unite (make-cylinder foot height radius)
         (capital (+z foot height))))

(define (capital p)
  (make-box p (* 2 radius) (* 2 radius) 0.3))

(define (spacing length n)
  (/ length (- n 1)))

(define (feet from direction n step)
  (map (lambda (i) (p+v from (v*r direction (* i step))))
       (iota n)))

(define (row from direction n length)
  (let ((step (spacing length)))
    (map column (feet from direction n step))))

(define (corners size)
  (list (xyz 0 0 0) (xyz size 0 0)
        (xyz size size 0) (xyz 0 size 0)))

(define (court size n)
  (let ((c (corners size)))
    (unite (row (list-ref c 0) (vxyz 1 0 0) n size)
           (row (list-ref c 3) (vxyz 1 0 0) n size))))

(draw (court 20 6))
