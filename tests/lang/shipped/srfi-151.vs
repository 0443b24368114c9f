; SRFI 151: each name, by its examples and edges
(import (scheme base) (scheme write) (srfi 151))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (list (bitwise-not 10) (bitwise-not -37) (bitwise-ior 3 10) (bitwise-and 11 26) (bitwise-xor 3 10) (bitwise-eqv 37 12))) ; expect: (-11 36 11 10 9 -42)
(show (list (bitwise-and) (bitwise-ior) (bitwise-xor) (bitwise-eqv) (bitwise-eqv 5) (bitwise-eqv 1 2 4) (bitwise-eqv 1 (bitwise-eqv 2 4)))) ; expect: (-1 0 0 -1 5 7 7)
(show (list (bitwise-nand 11 26) (bitwise-nor 11 26) (bitwise-andc1 11 26) (bitwise-andc2 11 26) (bitwise-orc1 11 26) (bitwise-orc2 11 26))) ; expect: (-11 -28 16 1 -2 -17)
(show (list (arithmetic-shift 8 2) (arithmetic-shift 8 -1) (arithmetic-shift -100000000000000000000000000000000 -100))) ; expect: (32 4 -79)
(show (map bit-count (list 0 -1 7 13 -13 30 -30 (expt 2 100) (- (expt 2 100)) (- (+ 1 (expt 2 100))) (- (expt 2 1000) 1)))) ; expect: (0 0 3 3 2 4 4 1 100 1 1000)
(show (map integer-length (list 0 1 -1 7 -7 8 -8 (expt 2 99)))) ; expect: (0 1 0 3 3 4 3 100)
(show (list (bitwise-if 3 1 8) (bitwise-if 3 8 1) (bitwise-if 1 1 2) (bitwise-if 60 240 15))) ; expect: (9 0 3 51)
(show (list (bit-set? 1 1) (bit-set? 0 1) (bit-set? 3 10) (bit-set? 1000000 -1) (bit-set? 1000000 1) (bit-set? 2 6) (bit-set? 99 (expt 2 99)))) ; expect: (#f #t #t #t #f #t #t)
(show (list (copy-bit 0 0 #t) (copy-bit 2 0 #t) (copy-bit 2 15 #f) (copy-bit 0 -1 #f) (bit-swap 0 2 4) (bit-swap 0 2 -2))) ; expect: (1 4 11 -2 1 -5)
(show (list (any-bit-set? 3 6) (any-bit-set? 3 12) (every-bit-set? 4 6) (every-bit-set? 7 6))) ; expect: (#t #f #t #f)
(show (map first-set-bit (list 1 2 0 40 -28 (expt 2 99) (expt -2 99)))) ; expect: (0 1 -1 3 2 99 99)
(show (list (bit-field 874 0 4) (bit-field 874 3 9) (bit-field 874 4 9) (bit-field 874 4 10) (bit-field 6 2 999) (bit-field (expt 2 128) 128 129) (bit-field -1 3 6))) ; expect: (10 45 22 54 1 1 7)
(show (list (bit-field-any? 874 0 1) (bit-field-any? 874 0 4) (bit-field-every? 6 1 3) (bit-field-every? 6 0 3) (bit-field-any? 6 2 2) (bit-field-every? 6 2 2))) ; expect: (#f #t #t #f #f #t)
(show (list (bit-field-clear 42 1 4) (bit-field-set 42 1 4) (bit-field-replace 42 2 1 4) (bit-field-replace 6 1 0 1) (bit-field-replace 6 1 1 2) (bit-field-replace-same 15 0 1 3))) ; expect: (32 46 36 7 6 9)
(show (list (bit-field-rotate 6 0 0 10) (bit-field-rotate (expt 2 128) 1 0 129) (bit-field-rotate 6 1 1 2) (bit-field-rotate 6 1 2 4) (bit-field-rotate 7 -1 1 4) (bit-field-rotate 7 5 3 3))) ; expect: (6 1 6 10 11 7)
(show (list (bit-field-reverse 6 1 3) (bit-field-reverse 6 1 4) (bit-field-reverse 1 0 32) (bit-field-reverse 1 0 31) (bit-field-reverse #x140000000000000000000000000000000 0 129))) ; expect: (6 12 2147483648 1073741824 5)
(show (list (bits->list 117) (bits->list 58 4) (bits->list 3 5) (bits->list 0) (bits->vector 6 4) (bits->vector 6))) ; expect: ((#t #f #t #f #t #t #t) (#f #t #f #t) (#t #t #f #f #f) () #(#f #t #t #f) #(#f #t #t))
(show (list (list->bits '(#t #f #t #f #t #t #t)) (list->bits '()) (list->bits '(#f #f #t #t)) (vector->bits #(#f #t #t #f)) (bits #t #f #t #f #t #t #t) (bits))) ; expect: (117 0 12 6 117 0)
(show (list (bitwise-fold cons '() 87) (bitwise-fold cons '() 0) (bitwise-fold cons '() -3))) ; expect: ((#t #f #t #f #t #t #t) () (#f #t))
(show (let ((count 0)) (bitwise-for-each (lambda (b) (if b (set! count (+ count 1)))) 87) count)) ; expect: 5
(show (bitwise-unfold (lambda (i) (= i 10)) even? (lambda (i) (+ i 1)) 0)) ; expect: 341
(show (let ((g (make-bitwise-generator 6)) (h (make-bitwise-generator -2 1))) (let* ((a (g)) (b (g)) (c (g)) (d (g))) (list a b c d (h))))) ; expect: (#f #t #t #f #t)
; The bits of a random-looking number and of its complement are those of the list.
(define n (- (expt 7 200) (expt 3 100)))
(show (list (= n (list->bits (bits->list n))) (= (bit-count n) (bit-count (bitwise-not n))) (= n (bit-field-reverse (bit-field-reverse n 0 600) 0 600)))) ; expect: (#t #t #t)
(bit-field 5 3 1) ; expect error: bit-field: the field must not end before it starts, got 3 1
