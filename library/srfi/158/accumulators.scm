; Accumulators. After generators.scm.

(define (make-accumulator [f procedure?] seed [finish procedure?])
  (lambda (x)
    (if (end? x)
        (finish seed)
        (set! seed (f x seed)))))

(define (keep x) x)
(define (count-accumulator) (make-accumulator (lambda (x n) (+ n 1)) 0 keep))
(define (sum-accumulator) (make-accumulator + 0 keep))
(define (product-accumulator) (make-accumulator * 1 keep))
(define (reverse-list-accumulator) (make-accumulator cons '() keep))
(define (list-accumulator) (make-accumulator cons '() reverse))
(define (reverse-vector-accumulator) (make-accumulator cons '() list->vector))
(define (vector-accumulator) (make-accumulator cons '() (lambda (l) (list->vector (reverse l)))))
(define (string-accumulator) (make-accumulator cons '() (lambda (l) (list->string (reverse l)))))
(define (bytevector-accumulator) (make-accumulator cons '() (lambda (l) (apply bytevector (reverse l)))))

; These fill the given vector from a place on.
(define (filling set collection at) (make-accumulator (lambda (x i) (set collection i x) (+ i 1)) at (lambda (i) collection)))
(define (vector-accumulator! [v vector?] at) (filling vector-set! v at))
(define (bytevector-accumulator! [b bytevector?] at) (filling bytevector-u8-set! b at))
