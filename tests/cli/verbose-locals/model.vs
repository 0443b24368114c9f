; Each procedure fails where variables of every kind are in scope.
(define (in-let w)
  (let ([a (* w 2)] [b "text"])
    (let* ([c (+ a 1)] [a (list c b)])
      (car (vector-ref (vector a) c)))))

(define (in-loop n)
  (let loop ([i 0] [sum 0])
    (if (= i n) (+ (car sum) 1) (loop (+ i 1) (+ sum i)))))

(define (in-do n)
  (do ([i 0 (+ i 1)] [l '() (cons i l)])
      ((= i n) (+ 1 (vector-ref l 0)))))

(define (in-define x)
  (define y (* x x))
  (define (helper z) (+ z (car y)))
  (define last 5)
  (+ 1 (helper last)))

(define (in-closure x)
  (let ([k 10])
    (define big (lambda (z) (let ([t (+ z k)]) (+ (vector-ref x t) 1))))
    (+ 1 (big 3))))

(define (in-for n) (for/list ([i (in-range n)]) (let ([j (- i 2)]) (/ i (+ j 0)))))

(define (assigned n) (let ([count 0]) (set! count (+ count n)) (+ 1 (car count))))

(define (in-values n)
  (let-values ([(q r) (floor/ n 3)])
    (define-values (s t) (values q (+ r 1)))
    (+ (car s) t)))

; before a scope and behind it its variables are not shown; an inner one hides the outer of its name
(define (shadowed x)
  (let ([x (let ([early 1]) (+ early x))])
    (let ([x (list x)] [p (let ([later 2]) later)])
      (+ 1 (vector-ref x p)))))

(define-parameter what "none")
(define (run)
  (case (string->symbol what)
    [(let) (in-let 3)]
    [(loop) (in-loop 3)]
    [(do) (in-do 3)]
    [(define) (in-define 4)]
    [(closure) (in-closure 7)]
    [(for) (in-for 4)]
    [(assigned) (assigned 3)]
    [(values) (in-values 7)]
    [(shadow) (shadowed 5)]))
(display (list (run)))
