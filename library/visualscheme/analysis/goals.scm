; Two goals: choices of which no other is better in both.

; Returns the items, in order of the first goal, that no other beats in both. f, g: procedures of an item; less is better.
(define (pareto-front items f g)
  (for-each (lambda (name p) (if (not (procedure? p)) (error 'pareto-front "~a must be a procedure, got ~s" name p))) '(f g) (list f g))
  (let ((valued (sort (map (lambda (i) (list i (f i) (g i))) items) (lambda (a b) (or (< (second a) (second b)) (and (= (second a) (second b)) (< (third a) (third b))))))))
    (let loop ((l valued) (least #f) (kept '()))
      (cond ((null? l) (reverse kept))
        ((or (not least) (< (third (car l)) least)) (loop (cdr l) (third (car l)) (cons (first (car l)) kept)))
        (else (loop (cdr l) least kept))))))

; Returns places on the front of two goals: lists of the numbers, f and g. Each has the least f of all with at most its g.
(define (pareto-set f g starts #:points [n any? 11] #:from [from any? #f] #:to [to any? #f] #:method [method any? #f] #:steps [steps any? #f])
  (if (not (and (exact-integer? n) (<= 2 n 1000))) (error 'pareto-set "points must be an exact integer from 2 to 1000, got ~s" n))
  (if (not (list? starts)) (error 'pareto-set "starts must be a list of numbers, got ~s" starts))
  (let* ((search (lambda (goal xs limit) (optimise goal xs #:method method #:from from #:to to #:steps steps #:subject-to limit)))
         (at-f (search f starts '())) (at-g (search g starts '())) (high (apply g at-f)) (low (apply g at-g))
         (row (lambda (xs) (list xs (apply f xs) (apply g xs)))))
    (let loop ((k 1) (xs at-f) (rows (list (row at-f))))
      (if (= k (- n 1)) (reverse (cons (row at-g) rows))
          (let* ((most (+ high (* (/ k (- n 1)) (- low high)))) (found (search f xs (lambda l (- (apply g l) most))))) (loop (+ k 1) found (cons (row found) rows)))))))
