; SRFI 121-158, as it comes with the language
(import (scheme base) (scheme write) (srfi 158) (only (srfi 121) gappend))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (generator->list (gtake (make-range-generator 0) 4))) ; expect: (0 1 2 3)
(show (generator->list (gappend (generator 1 2) (generator 3)))) ; expect: (1 2 3)
(show (generator->list (gfilter odd? (make-iota-generator 6)))) ; expect: (1 3 5)
(show (generator->list (make-coroutine-generator (lambda (yield) (yield 1) (yield 2))))) ; expect: (1 2)
(show (generator-fold + 0 (list->generator '(1 2 3)))) ; expect: 6
(show (let ((a (sum-accumulator))) (a 1) (a 2) (a (eof-object)))) ; expect: 3
(show (generator->list (gmap * (generator 1 2) (generator 3 4)))) ; expect: (3 8)
