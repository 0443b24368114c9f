; Columns in a row.
(load "parts.vs")
(define-parameter count 3 #:min 1)

; Swaps two variables.
(define-syntax swap!
  (syntax-rules () ((_ a b) (let ((tmp a)) (set! a b) (set! b tmp)))))

(define-syntax-rule (twice form) (begin form form))

(define (row n [gap positive? 2] #:at [at point? origin])
  "n columns in a row"
  (let loop ([i 0] [tmp '()])              ; tmp is no macro's
    (if (= i n)
        (unite tmp)
        (loop (+ i 1) (cons (column (+x at (* i gap))) tmp)))))

(define-record-type pair2 (make-pair2 a b) pair2? (a pair2-a set-pair2-a!) (b pair2-b))
(define p (make-pair2 1 `(2 ,(+ 1 2) . x)))
(let ([tmp 5] [other (pair2-a p)])
  (swap! tmp other)
  (twice (display tmp)))
(for/list ([k 3] #:when (odd? k)) (* k k))
(draw (row count))
