; SRFI 130, as it comes with the language
(import (only (scheme base) define-syntax syntax-rules begin string-length + list string-ref quote newline) (scheme write) (srfi 130))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (string-take "wall" 2)) ; expect: "wa"
(show (string-split "a b c" " ")) ; expect: ("a" "b" "c")
(show (string-join '("a" "b") "-")) ; expect: "a-b"
(show (string-pad "7" 3)) ; expect: "  7"
(show (string-replicate "abc" 0 7)) ; expect: "abcabca"
