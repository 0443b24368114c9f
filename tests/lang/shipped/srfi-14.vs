; SRFI 14, as it comes with the language
(import (scheme base) (scheme write) (srfi 14))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (char-set-size (string->char-set "hello"))) ; expect: 4
(show (char-set-contains? char-set:digit #\5)) ; expect: #t
(show (char-set-contains? char-set:letter #\é)) ; expect: #t
(show (char-set->string (char-set-intersection (string->char-set "aXbY") char-set:upper-case))) ; expect: "XY"
(show (char-set<= char-set:hex-digit char-set:ascii)) ; expect: #t
(show (char-set= (char-set #\a #\b) (list->char-set '(#\b #\a)))) ; expect: #t
(show (char-set-size (char-set-complement char-set:empty))) ; expect: 1112064
