; The numbers for which a procedure has its least value. NLopt asks for values, and the loop here answers.

(define methods '(gradient simplex crs isres))

; Returns the vector of partial derivatives at xs, exact but for rounding.
(define (slopes-at f xs) (list->vector (map inexact (apply gradient f xs))))

; Returns true if the language can differentiate f at xs.
(define (differentiable? f xs)
  (guard (x (#t #f)) (every (lambda (s) (and (real? s) (finite? s))) (apply gradient f xs))))

(define (bounds-of what value n default)
  (let ((l (cond ((not value) (make-list n default)) ((list? value) value) (else (make-list n value)))))
    (if (not (and (= (length l) n) (every (lambda (x) (and (real? x) (= x x))) l)))
        (error 'optimise "~a must be a number, or a list of ~a numbers, got ~s" what n value))
    (map (lambda (x) (max -1e301 (min 1e301 (inexact x)))) l)))

; Returns the value of a function as a number that the search takes: beyond all bounds where f is infinite.
(define (search-value f xs name)
  (let ((v (apply f xs)))
    (if (not (and (real? v) (= v v))) (error 'optimise "~a must give a number, got ~s at ~s" name v xs))
    (max -1e300 (min 1e300 (inexact v)))))

; Answers the questions of a search until its end; returns the state's number, the value and the unknowns.
(define (answer-all search functions)
  (let loop ()
    (let* ((q (core:search-next search)) (xs (vector->list (third q))))
      (if (< (first q) 0) (list (first q) (second q) xs)
          (let ((f (vector-ref functions (first q))) (name (if (= (first q) 0) "f" "a constraint")))
            (core:search-answer search (search-value f xs name) (if (second q) (slopes-at f xs) #()))
            (loop))))))

(define (optimise f starts #:method [method any? #f] #:from [from any? #f] #:to [to any? #f] #:subject-to [limits any? '()] #:steps [steps any? #f]
                  #:tolerance [tolerance any? 1e-10])
  (if (not (procedure? f)) (error 'optimise "f must be a procedure, got ~s" f))
  (let* ((xs (map (lambda (x) (if (and (real? x) (finite? x)) (inexact x) (error 'optimise "starts must be numbers, got ~s" starts))) (if (list? starts) starts (list starts))))
         (n (length xs)) (low (bounds-of 'from from n -1e301)) (high (bounds-of 'to to n 1e301)) (constraints (if (procedure? limits) (list limits) limits)))
    (if (= n 0) (error 'optimise "starts must be one number or more, got ()"))
    (if (not (and (list? constraints) (every procedure? constraints))) (error 'optimise "subject-to must be procedures, got ~s" limits))
    (if (not (memq method '(#f gradient simplex crs isres))) (error 'optimise "method must be one of ~s, got ~s" methods method))
    (if (not (or (not steps) (and (exact-integer? steps) (<= 1 steps 1000000000)))) (error 'optimise "steps must be an exact integer of 1 or more, got ~s" steps))
    (need-positive 'optimise 'tolerance tolerance)
    (for-each (lambda (x a b) (if (< x a) (error 'optimise "the start ~a is below ~a" x a)) (if (> x b) (error 'optimise "the start ~a is above ~a" x b))) xs low high)
    (let ((chosen (or method (if (every (lambda (g) (differentiable? g xs)) (cons f constraints)) 'gradient 'simplex))))
      (if (and (memq chosen '(crs isres)) (any (lambda (a b) (or (< a -1e300) (> b 1e300))) low high))
          (error 'optimise "'~a needs bounds: give #:from and #:to" chosen))
      (if (and (eq? chosen 'crs) (pair? constraints)) (error 'optimise "'crs takes no #:subject-to; 'isres does"))
      (let* ((most (or steps (if (memq chosen '(crs isres)) (* 5000 n) (* 2000 n))))
             (search (core:search-new (list-index (lambda (m) (eq? m chosen)) methods) (list->vector xs) (list->vector low) (list->vector high)
                       (vector (length constraints) most tolerance)))
             (end (answer-all search (list->vector (cons f constraints)))))
        (if (= (first end) -4) (error 'optimise "the search cannot be done by '~a with these bounds" chosen))
        (if (and (= (first end) -2) (memq chosen '(gradient simplex)))
            (warn (format "optimise: ~a evaluations did not suffice; #:steps allows more" most)))
        (if (list? starts) (third end) (car (third end)))))))
