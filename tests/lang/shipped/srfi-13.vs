; SRFI 13, as it comes with the language
(import (except (scheme base) string-map string-for-each) (scheme write) (only (scheme char) char-upcase) (srfi 13))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (string-index "hello" #\l)) ; expect: 2
(show (string-pad "7" 3 #\0)) ; expect: "007"
(show (string-pad-right "abcde" 3)) ; expect: "abc"
(show (string-join '("foo" "bar" "baz") ":")) ; expect: "foo:bar:baz"
(show (string-tokenize "Help make programs run, run, RUN!")) ; expect: ("Help" "make" "programs" "run," "run," "RUN!")
(show (string-titlecase "--capitalize tHIS sentence.")) ; expect: "--Capitalize This Sentence."
(show (string-contains "eek -- what a geek." "ee" 12 18)) ; expect: 15
(show (string-take "Pete Szilagyi" 6)) ; expect: "Pete S"
(show (string-drop-right "Beta rules" 6)) ; expect: "Beta"
(show (string-trim-both "  wall  ")) ; expect: "wall"
(show (string-replace "abcdefghi" "xyz" 3 6)) ; expect: "abcxyzghi"
(show (string-concatenate-reverse '("," "ho" ",") "hey")) ; expect: ",ho,hey"
(show (xsubstring "abcdef" 2)) ; expect: "cdefab"
(show (string-count "banana" #\a)) ; expect: 3
(show (string-fold cons '() "abc")) ; expect: (#\c #\b #\a)
(show (string-map char-upcase "abc")) ; expect: "ABC"
(show (string-prefix-length "door" "dose")) ; expect: 2
