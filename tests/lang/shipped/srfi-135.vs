; SRFI 135, immutable texts, as it comes with the language
(import (scheme base) (scheme write) (only (scheme char) char-whitespace?) (srfi 135))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(define t (string->text "a facade of glass"))
(show (list (text? t) (textual? "x") (text? "x") (text-length t) (text-ref t 2))) ; expect: (#t #t #f 17 #\f)
(show (textual->string (subtext t 2 8)))                              ; expect: "facade"
(show (list (textual-contains t "a") (textual-contains-right t "a") (textual-index t char-whitespace? 2))) ; expect: (0 14 8)
(show (map textual->string (textual-split t " ")))                    ; expect: ("a" "facade" "of" "glass")
(show (map textual->string (textual-split "/usr/share" "/" 'prefix))) ; expect: ("usr" "share")
(show (textual->string (textual-join (list "a" (text #\b) "c") ", "))) ; expect: "a, b, c"
(show (list (textual=? t "a facade of glass") (textual<? "a" (text #\b)))) ; expect: (#t #t)
(show (textual->string (textual-replace t "wall" 2 8)))               ; expect: "a wall of glass"
(show (textual->utf16be (text #\a #\x1F3DB)))                         ; expect: #u8(0 97 216 60 223 219)
(show (textual->string (utf16->text (textual->utf16 "é𝄞"))))          ; expect: "é𝄞"
(show (guard (e (#t (error-object-message e))) (subtext t 5 50)))     ; expect: "subtext: start and end must lie within the text, got"
(show (guard (e (#t (error-object-message e))) (text-length "s")))    ; expect: "text-length: expected a text, got"
