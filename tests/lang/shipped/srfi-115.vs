; SRFI 115, as it comes with the language
(import (scheme base) (scheme write) (srfi 115))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (regexp-matches? '(: (+ digit) "." (+ digit)) "12.5")) ; expect: #t
(show (regexp-match->list (regexp-search '(: ($ (+ alpha)) "=" ($ (+ num))) "width: x=12, y=3"))) ; expect: ("x=12" "x" "12")
(show (regexp-replace-all '(+ space) "a  b   c" "_")) ; expect: "a_b_c"
(show (regexp-split #\, "a,b,,c")) ; expect: ("a" "b" "" "c")
(show (regexp-extract '(+ digit) "12 of 345")) ; expect: ("12" "345")
(show (regexp-replace '(: ($ (+ digit)) "x" ($ (+ digit))) "800x600" '(2 " by " 1))) ; expect: "600 by 800"
(show (regexp-matches? '(w/nocase "wall") "WALL")) ; expect: #t
(show (regexp-matches? '(or "door" "window") "wall")) ; expect: #f
(show (regexp-match-submatch (regexp-search '(: "id=" (-> id (+ alnum))) "wall id=W17;") 'id)) ; expect: "W17"
(show (string-length (regexp-replace-all "a" (make-string 20000 #\a) "bb"))) ; expect: 40000
