; SRFI 127, as it comes with the language
(import (scheme base) (scheme write) (srfi 127) (only (srfi 158) make-range-generator))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (lseq-realize (lseq-take (generator->lseq (make-range-generator 5)) 3))) ; expect: (5 6 7)
(show (lseq-realize (lseq-map + '(1 2) '(10 20)))) ; expect: (11 22)
(show (lseq-find even? '(1 3 4))) ; expect: 4
