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
; the longest of the leftmost, unless an operator takes as little as it can
(show (regexp-match-submatch (regexp-search '(or "foo" "foobar") "xfoobar"))) ; expect: "foobar"
(show (regexp-match-submatch (regexp-search '(: "<" (*? any) ">") "x<a><b>"))) ; expect: "<a>"
(show (regexp-match-submatch (regexp-search '(: "a" (**? 1 3 "b")) "abbb"))) ; expect: "ab"
; submatches are numbered by where they open, also in repetitions
(show (regexp-match->list (regexp-search '(: ($ ($ "a") "b") ($ "c")) "abc"))) ; expect: ("abc" "ab" "a" "c")
(show (regexp-match->list (regexp-matches '(** 1 3 (: ($ alpha) ($ digit))) "a1b2"))) ; expect: ("a1b2" "b" "2")
(show (regexp-match->list (regexp-matches '(: (w/nocapture ($ "a")) (? ($ "b"))) "a"))) ; expect: ("a" #f)
(show (let ((m (regexp-search '(-> n (+ digit)) "ab12"))) (list (regexp-match-submatch-start m 'n) (regexp-match-submatch-end m) (regexp-match-count m)))) ; expect: (2 4 1)
; repetitions by numbers
(show (map (lambda (n) (regexp-matches? '(** 2 4 "ab") (apply string-append (make-list n "ab")))) '(1 2 4 5))) ; expect: (#f #t #t #f)
(show (map (lambda (s) (list (regexp-matches? '(= 2 alpha) s) (regexp-matches? '(>= 2 alpha) s))) '("a" "ab" "abc"))) ; expect: ((#f #f) (#t #t) (#f #t))
; positions
(show (regexp-replace-all 'bol "a\nb" "> ")) ; expect: "> a\n> b"
(show (regexp-match-submatch-start (regexp-search '(word "cat") "concat cat"))) ; expect: 7
(show (map (lambda (s) (and (regexp-search '(: bos (+ alpha) eos) s) #t)) '("abc" "abc "))) ; expect: (#t #f)
(show (regexp-extract 'word "two words")) ; expect: ("two" "words")
; sets of characters
(show (map (lambda (set) (regexp-extract `(+ ,set) "aZ9_ é-")) '((/ "az") ("a9Z") (~ (or alpha " ")) (- alnum "9") (& alpha upper) (w/ascii alpha)))) ; expect: (("a") ("aZ9") ("9_" "-") ("aZ" "é") ("Z") ("aZ"))
(show (regexp-matches? '(w/nocase "a" (w/case "b") ("xyz")) "AbZ")) ; expect: #t
; parts
(show (regexp-partition '(+ (or space punct)) "Hello, world!\n")) ; expect: ("Hello" ", " "world" "!\n")
(show (regexp-split '(+ space) " fee fi fo fum\n")) ; expect: ("" "fee" "fi" "fo" "fum" "")
(show (regexp-extract '(* numeric) "192.168.0.1")) ; expect: ("192" "168" "0" "1")
(show (regexp-replace "a" "banana" (lambda (m) (list "<" 0 ">")) 0 #f 1)) ; expect: "ban<a>na"
(show (regexp-replace "n" "ban" '(pre post))) ; expect: "baba"
(show (regexp-fold "a" (lambda (i m s found) (cons i found)) '() "banana")) ; expect: (4 2 0)
(show (regexp->sre (rx "a" (* digit)))) ; expect: (: "a" (* digit))
(show (map valid-sre? '("a" (* "a") (foo) (** 5 2 "a") (backref 1)))) ; expect: (#t #t #f #f #f)
; no expression takes more than its size times the text's length: these would take ages by trying all ways
(show (regexp-matches? `(: ,@(make-list 200 '(? "a")) ,@(make-list 200 "a")) (make-string 200 #\a))) ; expect: #t
(show (regexp-matches? '(* (* (* "a"))) (string-append (make-string 20000 #\a) "b"))) ; expect: #f
(regexp '(** 1 1000 (** 1 1000 "a"))) ; expect error: it is too large; numbers of repetitions multiply
