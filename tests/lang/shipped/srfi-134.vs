; SRFI 134, immutable deques, as it comes with the language
(import (scheme base) (scheme write) (srfi 134))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(define d (ideque 1 2 3 4 5))
(show (ideque->list (ideque-add-front (ideque-remove-back d) 0)))     ; expect: (0 1 2 3 4)
(show (ideque->list d))                                               ; expect: (1 2 3 4 5)
(show (list (ideque-front d) (ideque-back d) (ideque-length d) (ideque-ref d 2))) ; expect: (1 5 5 3)
(show (call-with-values (lambda () (ideque-split-at d 2)) (lambda (a b) (list (ideque->list a) (ideque->list b))))) ; expect: ((1 2) (3 4 5))
(show (ideque->list (ideque-append d (ideque-reverse d))))            ; expect: (1 2 3 4 5 5 4 3 2 1)
(show (ideque->list (ideque-filter odd? (ideque-map (lambda (x) (* x x)) d)))) ; expect: (1 9 25)
(show (ideque-fold + 0 d))                                            ; expect: 15
(show (guard (e (#t (error-object-message e))) (ideque-front (ideque)))) ; expect: "Empty deque:"
