; What public suites found: reading, quasiquotation, apply, case, line ends
(define (said thunk) (call/cc (lambda (k) (with-exception-handler (lambda (e) (k (if (error-object? e) (error-object-message e) e))) thunk))))
(define (all-of text) (let ([p (open-input-string text)]) (let loop ([l '()]) (let ([d (read p)]) (if (eof-object? d) (reverse l) (loop (cons d l)))))))
(write (all-of "#t(5) 6"))                      (newline) ; expect: (#t (5) 6)
(write (all-of "#f[5]#true(a)#\\a(b)#u8(1 2)#(3)(4)")) (newline) ; expect: (#f (5) #t (a) #\a (b) #u8(1 2) #(3) (4))
(write (all-of "#d10(1)#xff(2)#e1.5(3)"))       (newline) ; expect: (10 (1) 255 (2) 3/2 (3))
(write (all-of "1 ; one\r2 ; two\r\n3 #| \r |# 4")) (newline) ; expect: (1 2 3 4)
(write (read (open-input-string "\"a\\  \r   b\rc\r\nd\""))) (newline) ; expect: "ab\nc\nd"
(let ([p (open-input-string "one\rtwo\r\nthree\n\rfive\r")])
  (let loop ()
    (let ([l (read-line p)])
      (unless (eof-object? l) (write l) (newline) (loop)))))
; expect: "one"
; expect: "two"
; expect: "three"
; expect: ""
; expect: "five"
(write (let ([q '(1 2)]) ``(foo ,,@q)))         (newline) ; expect: `(foo (unquote 1 2))
(write (let ([q '(1 2)]) ``(foo ,@,@q)))        (newline) ; expect: `(foo (unquote-splicing 1 2))
(write (let ([q '()]) ``(foo ,,@q)))            (newline) ; expect: `(foo (unquote))
(write (let ([x 1]) ``(a ,(b ,x) ,,x)))         (newline) ; expect: `(a ,(b 1) ,1)
(displayln (said (lambda () (apply +))))                  ; expect: apply needs at least 2 arguments (procedure first arguments ...), got 1
(displayln (said (lambda () (apply + 5))))                ; expect: apply: the last argument must be a list, got
(displayln (apply + 1 2 '(3)))                            ; expect: 6
(displayln (string-upcase "ﬀ ß և ᾳ ﬃ"))                  ; expect: FF SS ԵՒ ΑΙ FFI
(write (map char->integer (string->list (string-upcase "\x1F0;\x390;\x149;")))) (newline) ; expect: (74 780 921 776 769 700 78)
(displayln (string-upcase "ẞ İ éa"))                      ; expect: ẞ İ ÉA
(displayln (char-upcase #\ß))                             ; expect: ß
(write (all-of "#TRUE #False #T #tRuE #F"))    (newline) ; expect: (#t #f #t #t #f)
(write (map char->integer (string->list (symbol->string (read (open-input-string "|a\rb\r\nc|")))))) (newline) ; expect: (97 13 98 13 10 99)
(write (map char-lower-case? '(#\ª #\º #\ʰ #\ⁿ #\a #\A #\1 #\中))) (newline) ; expect: (#t #t #t #t #t #f #f #f)
(displayln (string-downcase "AΣ'X ΑΣ. ΑΣΣ Σ ΑΣ́"))        ; expect: aσ'x ας. ασς σ ας́
(write (map char->integer (string->list (string-downcase "İ")))) (newline) ; expect: (105 775)
