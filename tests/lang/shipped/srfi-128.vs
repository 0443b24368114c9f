; SRFI 128: each name; the default comparator by its laws on samples of all types
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(import (srfi 128))
(define numbers (make-comparator number? = < number-hash))
(define strings (make-comparator string? string=? string<? string-hash))
(define bare (make-comparator symbol? eq? #f #f))
(define default (make-default-comparator))
(show (map (lambda (c) (list (comparator? c) (comparator-ordered? c) (comparator-hashable? c))) (list numbers bare default))) ; expect: ((#t #t #t) (#t #f #f) (#t #t #t))
(show (comparator? 5)) ; expect: #f
(show (list (eq? (comparator-type-test-predicate numbers) number?) (eq? (comparator-equality-predicate numbers) =) (eq? (comparator-ordering-predicate numbers) <) (eq? (comparator-hash-function numbers) number-hash))) ; expect: (#t #t #t #t)
(show (list (comparator-test-type numbers 1) (comparator-test-type numbers 'a) (comparator-check-type numbers 1) (= (comparator-hash numbers 1) (comparator-hash numbers 1.0)))) ; expect: (#t #f #t #t)
(show (list (=? numbers 1 1.0 1) (=? numbers 1 2) (<? numbers 1 2 3) (<? numbers 1 3 2) (>? numbers 3 2 1) (>? numbers 3 3) (<=? numbers 1 1 2) (<=? numbers 2 1) (>=? numbers 2 2 1) (>=? numbers 1 2))) ; expect: (#t #f #t #f #t #f #t #f #t #f)
(show (map (lambda (x) (comparator-if<=> numbers x 2 'less 'equal 'greater)) '(1 2 3))) ; expect: (less equal greater)
(show (map (lambda (x) (comparator-if<=> x "b" 'less 'equal 'greater)) '("a" "b" "c"))) ; expect: (less equal greater)
; Hash functions: equal values have equal hashes, below the bound.
(define (hashes-agree? hash . values) (and (every (lambda (v) (= (hash v) (hash (car values)))) values) (<= 0 (hash (car values)) (- (hash-bound) 1))))
(show (list (hashes-agree? boolean-hash #t #t) (hashes-agree? char-hash #\a #\a) (hashes-agree? char-ci-hash #\a #\A) (hashes-agree? string-hash "abc" (string #\a #\b #\c)))) ; expect: (#t #t #t #t)
(show (list (hashes-agree? string-ci-hash "abC" "ABc") (hashes-agree? symbol-hash 'a 'a) (hashes-agree? number-hash 2 2.0 4/2) (hashes-agree? number-hash (expt 2 100) (inexact (expt 2 100))))) ; expect: (#t #t #t #t)
(show (list (hashes-agree? default-hash (list 1 "a" #\c) (list 1.0 "a" #\c)) (hashes-agree? default-hash (vector 1 '(2)) (vector 1.0 '(2))) (= (default-hash "ab") (string-hash "ab")) (= (default-hash 'ab) (symbol-hash 'ab)) (= (default-hash 7) (number-hash 7)) (= (default-hash #\a) (char-hash #\a)) (= (default-hash #f) (boolean-hash #f)))) ; expect: (#t #t #t #t #t #t #t)
(show (list (exact-integer? (hash-salt)) (<= 0 (hash-salt) (- (hash-bound) 1)) (= (string-hash "a" 10) (string-hash "a")))) ; expect: (#t #t #t)
; Comparators of structures
(define pairs (make-pair-comparator numbers strings))
(show (list (comparator-test-type pairs '(1 . "a")) (comparator-test-type pairs '(1 . 2)) (=? pairs '(1 . "a") (cons 1.0 "a")) (<? pairs '(1 . "a") '(1 . "b") '(2 . "a")) (= (comparator-hash pairs '(1 . "a")) (comparator-hash pairs '(1.0 . "a"))))) ; expect: (#t #f #t #t #t)
(define lists (make-list-comparator numbers list? null? car cdr))
(show (list (comparator-test-type lists '(1 2)) (comparator-test-type lists '(1 a)) (=? lists '(1 2) '(1.0 2)) (<? lists '() '(1) '(1 2) '(2)) (<? lists '(2) '(1 2)) (= (comparator-hash lists '(1 2)) (comparator-hash lists '(1.0 2))))) ; expect: (#t #f #t #t #f #t)
(define vectors (make-vector-comparator numbers vector? vector-length vector-ref))
(show (list (comparator-test-type vectors #(1 2)) (comparator-test-type vectors #(1 a)) (=? vectors #(1 2) #(1.0 2)) (<? vectors #(9) #(1 2) #(1 3)) (<? vectors #(1 2) #(9)) (= (comparator-hash vectors #(1 2)) (comparator-hash vectors #(1.0 2))))) ; expect: (#t #f #t #t #f #t)
(show (comparator-ordered? (make-pair-comparator numbers bare))) ; expect: #f
(show (let ((s (string #\a))) (list (=? (make-eq-comparator) s s) (=? (make-eq-comparator) s "a") (=? (make-eqv-comparator) 2 2) (=? (make-eqv-comparator) 2 2.0) (=? (make-equal-comparator) s "a")))) ; expect: (#t #f #t #f #t)
; The default comparator: on all samples exactly one of <, =, > holds, the order is transitive, and equal values have equal hashes.
(define samples (list '() '(1) '(1 2) '(1 . 2) '(2) #f #t #\a #\b "" "a" "b" 'a 'b -1 0 0.0 1/2 1 1.0 2 (expt 10 30) #() #(1) #(0 0) #(1 "a") #u8() #u8(1 2) #u8(2)))
(define (each-pair f) (every (lambda (a) (every (lambda (b) (f a b)) samples)) samples))
(show (each-pair (lambda (a b) (= 1 (count (lambda (x) x) (list (<? default a b) (=? default a b) (>? default a b))))))) ; expect: #t
(show (each-pair (lambda (a b) (or (not (=? default a b)) (= (default-hash a) (default-hash b)))))) ; expect: #t
(show (each-pair (lambda (a b) (or (not (<? default a b)) (every (lambda (c) (or (not (<? default b c)) (<? default a c))) samples))))) ; expect: #t
(show (list (<? default '() '(1)) (<? default #f #t) (<? default #(2) #(1 1)) (<? default '(1 1) '(2)))) ; expect: (#t #t #t #t)
(show (let ((long (iota 100000))) (list (=? default long (map inexact long)) (<? default long (append long '(1)))))) ; expect: (#t #t)
; Types of programs are registered.
(define-record-type room (make-room area) room? (area room-area))
(show (guard (c (#t (error-object-message c))) (<? default (make-room 1) (make-room 2)))) ; expect: "the default comparator has no order for this value; comparator-register-default! adds one:"
(comparator-register-default! (make-comparator room? (lambda (a b) (= (room-area a) (room-area b))) (lambda (a b) (< (room-area a) (room-area b))) (lambda (r) (number-hash (room-area r)))))
(show (list (=? default (make-room 1) (make-room 1.0)) (<? default (make-room 1) (make-room 2)) (<? default #u8() (make-room 1)) (= (default-hash (make-room 2)) (number-hash 2)))) ; expect: (#t #t #t #t)
(show (list (=? default (xyz 1 2 3) (xyz 1 2 3)) (= (default-hash (xyz 1 2 3)) (default-hash (xyz 1 2 3))))) ; expect: (#t #t)
(show (guard (c (#t (error-object-message c))) (<? bare 'a 'b))) ; expect: "this comparator has no order; make-comparator takes it as its third argument; to compare:"
(show (guard (c (#t (error-object-message c))) (comparator-hash bare 'a))) ; expect: "this comparator has no hash function; make-comparator takes it as its fourth argument; to hash:"
(comparator-check-type numbers 'a) ; expect error: comparator-check-type: the comparator is not for values such as a
