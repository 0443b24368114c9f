; Data beside a program: texts, folders, tables, JSON, and files that are wrong
(define (said thunk) (call/cc (lambda (k) (with-exception-handler (lambda (e) (k (if (error-object? e) (error-object-message e) e))) thunk))))
(define-syntax told (syntax-rules () ((_ e) (displayln (said (lambda () e))))))
(write (file->lines "lib/lines.txt")) (newline)          ; expect: ("one" "two" "" "four")
(write (string-length (file->string "lib/lines.txt"))) (newline) ; expect: 14
(write (directory-files "lib" ".csv")) (newline)         ; expect: ("empty.csv" "european.csv" "good.csv" "ragged.csv" "twice.csv" "unclosed.csv")
(define rows (load-csv "lib/good.csv"))
(write (map (lambda (r) (data-ref r 'width)) rows)) (newline)        ; expect: (1.5 #f -20.0)
(write (map (lambda (r) (data-ref r "note, long")) rows)) (newline)  ; expect: ("say \"hi\"" "two\nlines" "")
(write (car rows)) (newline)                             ; expect: ((name . "A") (width . 1.5) (|note, long| . "say \"hi\"") (count . 1))
(write (load-csv "lib/european.csv")) (newline)          ; expect: (((a . 1.5) (b . "x")) ((a . #f) (b . "y")))
(write (load-csv "lib/european.csv" #:header #f)) (newline) ; expect: (("a" "b") ("1,5" "x") ("" "y"))
(write (load-csv "lib/good.csv" #:types '((count . text) (name . symbol)))) (newline) ; expect: (((name . A) (width . 1.5) (|note, long| . "say \"hi\"") (count . "1")) ((name . B) (width . #f) (|note, long| . "two\nlines") (count . "2")) ((name . C) (width . -20.0) (|note, long| . "") (count . "3")))
(write (load-csv "lib/empty.csv")) (newline)             ; expect: ()
(told (load-csv "lib/ragged.csv"))       ; expect: load-csv: tests/lang/language/lib/ragged.csv:3: this row has 3 cells, the first 2
(told (load-csv "lib/unclosed.csv"))     ; expect: load-csv: tests/lang/language/lib/unclosed.csv:2: a " is missing: this cell is never closed
(told (load-csv "lib/twice.csv"))        ; expect: load-csv: tests/lang/language/lib/twice.csv:1: two columns are called a
(told (load-csv "lib/good.csv" #:types '((name . number)))) ; expect: load-csv: tests/lang/language/lib/good.csv:2: column name: expected a number, got "A"
(told (data-ref (car rows) 'wdth))       ; expect: data-ref: there is no wdth; there are (name width |note, long| count)
(define j (load-json "lib/good.json"))
(write j) (newline)                      ; expect: ((a . #(1 2.5 null #t)) (text . "é\n") (deep (x)) (big . 9007199254740993))
(write (data-ref j 'a 1)) (newline)      ; expect: 2.5
(told (data-ref j 'a 9))                 ; expect: data-ref: there is no element 9, the array has 4
(write (equal? j (string->json (json->string j)))) (newline)   ; expect: #t
(told (load-json "lib/bad.json"))        ; expect: load-json: tests/lang/language/lib/bad.json:2:7: unexpected token near '}'
(told (load-json "lib/doubled.json"))    ; expect: load-json: tests/lang/language/lib/doubled.json:1:12: duplicate object key near '"a"'
(told (string->json (make-string 100000 #\[))) ; expect: string->json: text:1:2049: maximum parsing depth reached near '['
(told (json->string (list 1 car)))       ; expect: json->string: JSON has no form for #<procedure car>
(let ([ring (list 1)]) (set-cdr! ring ring) (told (json->string (vector ring)))) ; expect: json->string: JSON has no form for #0=(1 . #0#)
(write-json '((at . #(1 2)) (name . "wall")))
; expect: {
; expect:   "at": [
; expect:     1,
; expect:     2
; expect:   ],
; expect:   "name": "wall"
; expect: }
(displayln (json->string (list (xyz 1 2 3) 1/4 'wood "a\"b\\c\t" (vector) '())))  ; expect: [[1.0, 2.0, 3.0], 0.25, "wood", "a\"b\\c\t", [], {}]
(displayln (format "~6a|~6@a|~6d|~8,2f|~,1f|~2,'0d:~2,'0d|~3f" 'oak 'elm 42 9.456 2/3 7 5 1.5)) ; expect: oak   |   elm|    42|    9.46|0.7|07:05|1.5
(displayln (format "~,2f ~,0f ~,3f" -0.001 2.5 1e20))   ; expect: 0.00 2 100000000000000000000.000
(told (format "~99999a" 1))              ; expect: format: a field of the format may be up to 10000 wide
(told (format "~5" 1))                   ; expect: format: the format ends within a directive
(struct door (width [height #:mutable]))
(define d (door 1 2))
(set-door-height! d 5)
(displayln (list (door-width d) (door-height d) (door? d)))   ; expect: (1 5 #t)
(define-struct wall (a b))
(define w (make-wall 1 2)) (set-wall-a! w 9) (displayln (wall-a w))     ; expect: 9
(told (eval '(struct 5) (interaction-environment)))           ; expect: a structure is written (struct name (field ...)), and not
(told (load-csv "lib/none.csv"))         ; expect: load-csv: cannot open tests/lang/language/lib/none.csv: no such file
