; SRFI 143: each name, by examples, edges and what is refused
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(define-syntax refused (syntax-rules () ((_ e) (guard (c (#t (display (error-object-message c)) (for-each (lambda (x) (display " ") (write x)) (error-object-irritants c)) (newline))) e))))
(import (srfi 143) (srfi 151) (scheme division))
(show (list fx-width fx-greatest fx-least)) ; expect: (48 140737488355327 -140737488355328)
(show (map fixnum? (list 0 fx-greatest (+ fx-greatest 1) fx-least 1.0 'a))) ; expect: (#t #t #f #t #f #f)
(show (list (fx=? 1 1 1) (fx=?) (fx<? 1 2 3) (fx<? 1 3 2) (fx>? 3 2 1) (fx<=? 1 1 2) (fx>=? 2 2 1) (fx>=? 1 2))) ; expect: (#t #t #t #f #t #t #t #f)
(show (list (fxzero? 0) (fxpositive? 1) (fxpositive? 0) (fxnegative? -1) (fxodd? -3) (fxeven? 4) (fxodd? 4))) ; expect: (#t #t #f #t #t #t #f)
(show (list (fxmax 1 5 3) (fxmin 1 -5 3) (fxmax 7))) ; expect: (5 -5 7)
(show (list (fx+ 2 3) (fx- 2 3) (fxneg 4) (fx* -3 4) (fxquotient -7 2) (fxremainder -7 2) (fxabs -5) (fxsquare -6))) ; expect: (5 -1 -4 -12 -3 -1 5 36)
(show (call-with-values (lambda () (fxsqrt 17)) list)) ; expect: (4 1)
; The carries are those of the definition.
(define (carried n) (call-with-values (lambda () (balanced/ n (expt 2 fx-width))) (lambda (q r) (list r q))))
(define samples (list 0 1 -1 12345 fx-greatest fx-least (quotient fx-least 3)))
(define (all-triples right?) (every (lambda (i) (every (lambda (j) (every (lambda (k) (right? i j k)) samples)) samples)) samples))
(show (all-triples (lambda (i j k) (equal? (carried (+ i j k)) (call-with-values (lambda () (fx+/carry i j k)) list))))) ; expect: #t
(show (all-triples (lambda (i j k) (equal? (carried (- i j k)) (call-with-values (lambda () (fx-/carry i j k)) list))))) ; expect: #t
(show (all-triples (lambda (i j k) (equal? (carried (+ (* i j) k)) (call-with-values (lambda () (fx*/carry i j k)) list))))) ; expect: #t
; On fixnums, each procedure on bits equals that of SRFI 151.
(define (same? f g) (every (lambda (i) (every (lambda (j) (equal? (f i j) (g i j))) samples)) samples))
(show (list (same? fxand bitwise-and) (same? fxior bitwise-ior) (same? fxxor bitwise-xor) (equal? (map fxnot samples) (map bitwise-not samples)))) ; expect: (#t #t #t #t)
(show (map equal? (list (map fxbit-count samples) (map fxlength samples) (map fxfirst-set-bit samples)) (list (map bit-count samples) (map integer-length samples) (map first-set-bit samples)))) ; expect: (#t #t #t)
(show (all-triples (lambda (m i j) (equal? (fxif m i j) (bitwise-if m i j))))) ; expect: #t
(show (list (fxarithmetic-shift 8 2) (fxarithmetic-shift -8 -1) (fxarithmetic-shift-left 1 46) (fxarithmetic-shift-left -1 47) (fxarithmetic-shift-right 8 1) (fxarithmetic-shift-right -1 47))) ; expect: (32 -4 70368744177664 -140737488355328 4 -1)
(show (list (fxbit-set? 1 6) (fxbit-set? 47 -1) (fxcopy-bit 2 15 #f) (fxbit-field 874 3 9) (fxbit-field-rotate 6 1 2 4) (fxbit-field-reverse 6 1 4))) ; expect: (#t #t 11 45 10 12)
(refused (fx+ fx-greatest 1)) ; expect: fx+: the result 140737488355328 has more than 48 bits
(refused (fx- fx-least 1)) ; expect: fx-: the result -140737488355329 has more than 48 bits
(refused (fx* fx-greatest fx-greatest)) ; expect: fx*: the product of 140737488355327 and 140737488355327 has more than 48 bits
(refused (fxsquare fx-least)) ; expect: fxsquare: the product of -140737488355328 and -140737488355328 has more than 48 bits
(refused (fxneg fx-least)) ; expect: fxneg: the result 140737488355328 has more than 48 bits
(refused (fxabs fx-least)) ; expect: fxabs: the result 140737488355328 has more than 48 bits
(refused (fxquotient 1 0)) ; expect: fxquotient: j must be a fixnum other than 0, got 0
(refused (fxquotient fx-least -1)) ; expect: fxquotient: the result 140737488355328 has more than 48 bits
(refused (fxarithmetic-shift 4 46)) ; expect: fxarithmetic-shift: the result 281474976710656 has more than 48 bits
(refused (fxarithmetic-shift 1 48)) ; expect: fxarithmetic-shift: count must be from -47 to 47, got 48
(refused (fxarithmetic-shift-left 1 -1)) ; expect: fxarithmetic-shift-left: count must be from 0 to 47, got -1
(refused (fxcopy-bit 47 0 #t)) ; expect: fxcopy-bit: the result has more than 48 bits: 140737488355328
(refused (fxbit-set? 48 1)) ; expect: fxbit-set?: index must be from-0-to-47?, got 48
(fx+ 1 2.0) ; expect error: fx+: j must be a fixnum, an exact integer of 48 bits, got 2.0
