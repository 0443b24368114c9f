; Computes the volume of a drawing from random points, for comparison with its mesh's: run `vs tests/tools/before.vs MODEL tests/tools/volume.vs`.
;
; Points are sampled in the parts' bounding boxes; a point that lies in k of them counts one k-th, so that every place of the union counts once.
; Whether a point is inside is `contains?`, which answers from formulas. The printed pair: estimate, standard error.

(define (parts o)
  (if (memq (object-kind o) '(union unite material layer))
      (append-map parts (object-children o))
      (list o)))

(define boxed
  (list->vector
   (filter (lambda (p) (cdr p))
           (map (lambda (o) (cons o (bounding-box o)))
                (filter solid? (append-map parts drawn-objects))))))

(define (low i) (first (cdr (vector-ref boxed i))))
(define (high i) (second (cdr (vector-ref boxed i))))
(define (box-volume i)
  (let ([d (- (high i) (low i))]) (* (cx d) (cy d) (cz d))))

(define n (vector-length boxed))
(define sums (make-vector (+ n 1) 0.0))
(do ([i 0 (+ i 1)]) ((= i n))
  (vector-set! sums (+ i 1) (+ (vector-ref sums i) (box-volume i))))
(define total (vector-ref sums n))

; The part whose share of `total` holds x.
(define (pick x)
  (let loop ([a 0] [b n])
    (if (= (+ a 1) b)
        a
        (let ([m (quotient (+ a b) 2)])
          (if (< x (vector-ref sums m)) (loop a m) (loop m b))))))

(define (in-box? p i)
  (let ([a (low i)] [b (high i)])
    (and (<= (cx a) (cx p) (cx b)) (<= (cy a) (cy p) (cy b)) (<= (cz a) (cz p) (cz b)))))

; 1/k if the point is inside any part, else 0.
(define (weight p)
  (let loop ([i 0] [k 0] [inside #f])
    (cond [(= i n) (if inside (/ 1.0 k) 0.0)]
          [(in-box? p i) (loop (+ i 1) (+ k 1) (or inside (contains? (car (vector-ref boxed i)) p)))]
          [else (loop (+ i 1) k inside)])))

(define (sample)
  (let* ([i (pick (* total (random)))] [a (low i)] [b (high i)])
    (weight (xyz (+ (cx a) (* (random) (- (cx b) (cx a))))
                 (+ (cy a) (* (random) (- (cy b) (cy a))))
                 (+ (cz a) (* (random) (- (cz b) (cz a))))))))

(let loop ([i 0] [sum 0.0] [squares 0.0])
  (if (< i samples)
      (let ([w (sample)]) (loop (+ i 1) (+ sum w) (+ squares (* w w))))
      (let* ([mean (/ sum i)] [variance (- (/ squares i) (* mean mean))])
        (display (* total mean)) (display " ")
        (display (* total (sqrt (/ variance i)))) (newline))))
