; what the reader makes of texts: numbers, characters, strings, comments, labels, keywords, brackets
(define (read-back text) (read (open-input-string text)))
(define-syntax show (syntax-rules () ((_ text ...) (begin (begin (write (read-back text)) (newline)) ...))))
(show "(a . b)")                      ; expect: (a . b)
(show "(a . (b . (c)))")              ; expect: (a b c)
(show "[1 2 (3 [4])]")                ; expect: (1 2 (3 (4)))
(show "#(1 #(2))")                    ; expect: #(1 #(2))
(show "#u8(1 255)")                   ; expect: #u8(1 255)
(show "#;(skipped #;too) shown")      ; expect: shown
(show "#| a #| nested |# b |# shown") ; expect: shown
(show "; line\n shown")               ; expect: shown
(show "'a" "`(a ,b ,@c)")
; expect: 'a
; expect: `(a ,b ,@c)
(show "\"tab\\tquote\\\"x\\x41;\"")   ; expect: "tab\tquote\"xA"
(show "\"a\\\n      b\"")             ; expect: "ab"
(show "#\\a" "#\\space" "#\\x41" "#\\λ" "#\\(" "#\\nul")
; expect: #\a
; expect: #\space
; expect: #\A
; expect: #\λ
; expect: #\(
; expect: #\null
(show "|two words|" "||" "foo|Bar|")
; expect: |two words|
; expect: ||
; expect: fooBar
(show "2pi" "1+" "+x" "-" "..." "a->b" "2*pi" "->")
; expect: 2pi
; expect: 1+
; expect: +x
; expect: -
; expect: ...
; expect: a->b
; expect: 2*pi
; expect: ->
(show "-1/2" "#xff" "1e3" "#e1.5" "+inf.0" "1." ".5")
; expect: -1/2
; expect: 255
; expect: 1000.0
; expect: 3/2
; expect: +inf.0
; expect: 1.0
; expect: 0.5
(show "#!fold-case ABC" "#t" "#true" "#false")
; expect: abc
; expect: #t
; expect: #t
; expect: #f
(show "#0=(a b . #0#)" "#1=(x #1# y)") 
; expect: #0=(a b . #0#)
; expect: #0=(x #0# y)
(let ((x (read-back "(#0=(1 2) #0#)"))) (display (eq? (car x) (cadr x))) (newline))   ; expect: #t
(define (trouble text)
  (display (guard (e ((read-error? e) (error-object-message e))) (read-back text)))
  (newline))
(trouble "(1 2")        ; expect: this parenthesis is never closed: a ) is missing
(trouble "(1 . )")      ; expect: a datum is missing after the . of this list
(trouble "(1 . 2 3)")   ; expect: only one datum may follow the . of a list
(trouble "#\\foo")      ; expect: no character has the name #\foo
(trouble "\"open")      ; expect: this string is never closed: a " is missing
(trouble "#| open")     ; expect: this comment #| is never closed by |#
(trouble "#5#")         ; expect: there is no label #5= before this
(trouble "#zz")         ; expect: #zz is not known here: # begins #t, #f, #\a (a character), #(1 2) (a vector), #:name (a keyword) and #;, #| (comments); ; begins a comment to the end of the line
(trouble "\"\\q\"")     ; expect: \q means nothing in a string; a backslash is written \\
