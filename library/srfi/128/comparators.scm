; Comparators, their hash functions, and comparators for pairs, lists and vectors.

(define-record-type comparator (new-comparator type-test equality ordering hash ordered? hashable?) comparator?
  (type-test comparator-type-test-predicate)
  (equality comparator-equality-predicate)
  (ordering comparator-ordering-predicate)
  (hash comparator-hash-function)
  (ordered? comparator-ordered?)
  (hashable? comparator-hashable?))

(define (procedure-or-#f? x) (or (not x) (procedure? x)))
(define (no-order . values) (error "this comparator has no order; make-comparator takes it as its third argument; to compare:" values))
(define (no-hash . values) (error "this comparator has no hash function; make-comparator takes it as its fourth argument; to hash:" values))
(define (make-comparator [type-test procedure?] [equality procedure?] [ordering procedure-or-#f?] [hash procedure-or-#f?])
  (new-comparator type-test equality (or ordering no-order) (or hash no-hash) (and ordering #t) (and hash #t)))

(define (comparator-test-type [c comparator?] x) ((comparator-type-test-predicate c) x))
(define (comparator-check-type [c comparator?] x)
  (or (comparator-test-type c x) (error "comparator-check-type: the comparator is not for values such as" x)))
(define (comparator-hash [c comparator?] x) ((comparator-hash-function c) x))

; ---- hash functions ----
; Each takes a second argument, as those of SRFI 69 do, and ignores it: so SRFI 125 exports the same procedures.

(define-syntax hash-bound (syntax-rules () ((_) 4294967296)))
; The salt is the same in each run: equal programs have equal results.
(define-syntax hash-salt (syntax-rules () ((_) 1973)))
(define (joined-hash a b) (modulo (+ (* 31 (modulo a (hash-bound))) b) (hash-bound)))

(define (boolean-hash [x boolean?] . ignored) (equal-hash x))
(define (char-hash [x char?] . ignored) (equal-hash x))
(define (char-ci-hash [x char?] . ignored) (equal-hash (char-foldcase x)))
(define (string-hash [x string?] . ignored) (equal-hash x))
(define (string-ci-hash [x string?] . ignored) (equal-hash (string-foldcase x)))
(define (symbol-hash [x symbol?] . ignored) (equal-hash x))
; Numbers that are = have equal hashes.
(define (number-hash [x number?] . ignored) (equal-hash (if (and (inexact? x) (finite? x)) (exact x) x)))

; ---- comparators of structures ----

(define (comparator-orders c) (and (comparator-ordered? c) (comparator-ordering-predicate c)))
(define (comparator-hashes c) (and (comparator-hashable? c) (comparator-hash-function c)))

(define (make-pair-comparator [first comparator?] [rest comparator?])
  (let ((first=? (comparator-equality-predicate first)) (rest=? (comparator-equality-predicate rest))
        (first<? (comparator-orders first)) (rest<? (comparator-orders rest))
        (hash-first (comparator-hashes first)) (hash-rest (comparator-hashes rest)))
    (make-comparator
     (lambda (x) (and (pair? x) (comparator-test-type first (car x)) (comparator-test-type rest (cdr x))))
     (lambda (a b) (and (first=? (car a) (car b)) (rest=? (cdr a) (cdr b))))
     (and first<? rest<?
          (lambda (a b) (if (first=? (car a) (car b)) (rest<? (cdr a) (cdr b)) (first<? (car a) (car b)))))
     (and hash-first hash-rest (lambda (x) (joined-hash (hash-first (car x)) (hash-rest (cdr x))))))))

(define (make-list-comparator [element comparator?] [type-test procedure?] [empty? procedure?] [head procedure?] [tail procedure?])
  (let ((same? (comparator-equality-predicate element)) (less? (comparator-orders element)) (hash (comparator-hashes element)))
    (make-comparator
     (lambda (x)
       (and (type-test x)
            (let loop ((x x)) (or (empty? x) (and (comparator-test-type element (head x)) (loop (tail x)))))))
     (lambda (a b)
       (let loop ((a a) (b b))
         (cond ((empty? a) (empty? b)) ((empty? b) #f) (else (and (same? (head a) (head b)) (loop (tail a) (tail b)))))))
     (and less?
          (lambda (a b)
            (let loop ((a a) (b b))
              (cond ((empty? b) #f)
                    ((empty? a) #t)
                    ((same? (head a) (head b)) (loop (tail a) (tail b)))
                    (else (less? (head a) (head b)))))))
     (and hash (lambda (x) (let loop ((x x) (code 17)) (if (empty? x) code (loop (tail x) (joined-hash code (hash (head x)))))))))))

; A shorter vector comes before a longer one.
(define (make-vector-comparator [element comparator?] [type-test procedure?] [size procedure?] [ref procedure?])
  (let ((same? (comparator-equality-predicate element)) (less? (comparator-orders element)) (hash (comparator-hashes element)))
    (make-comparator
     (lambda (x)
       (and (type-test x)
            (let loop ((i (- (size x) 1))) (or (< i 0) (and (comparator-test-type element (ref x i)) (loop (- i 1)))))))
     (lambda (a b)
       (and (= (size a) (size b)) (let loop ((i (- (size a) 1))) (or (< i 0) (and (same? (ref a i) (ref b i)) (loop (- i 1)))))))
     (and less?
          (lambda (a b)
            (let ((n (size a)))
              (if (= n (size b))
                  (let loop ((i 0))
                    (and (< i n) (if (same? (ref a i) (ref b i)) (loop (+ i 1)) (less? (ref a i) (ref b i)))))
                  (< n (size b))))))
     (and hash
          (lambda (x)
            (let ((n (size x))) (let loop ((i 0) (code n)) (if (= i n) code (loop (+ i 1) (joined-hash code (hash (ref x i))))))))))))

; ---- comparisons of two or more values ----

; Tells whether each value and the next are (related? a b).
(define (chain? related? a b more) (and (related? a b) (or (null? more) (chain? related? b (car more) (cdr more)))))
(define (=? [c comparator?] a b . more) (chain? (comparator-equality-predicate c) a b more))
(define (<? [c comparator?] a b . more) (chain? (comparator-ordering-predicate c) a b more))
(define (>? [c comparator?] a b . more)
  (let ((less? (comparator-ordering-predicate c))) (chain? (lambda (a b) (less? b a)) a b more)))
(define (<=? [c comparator?] a b . more)
  (let ((less? (comparator-ordering-predicate c))) (chain? (lambda (a b) (not (less? b a))) a b more)))
(define (>=? [c comparator?] a b . more)
  (let ((less? (comparator-ordering-predicate c))) (chain? (lambda (a b) (not (less? a b))) a b more)))

(define-syntax comparator-if<=>
  (syntax-rules ()
    ((_ a b less equal greater) (comparator-if<=> (make-default-comparator) a b less equal greater))
    ((_ comparator a b less equal greater)
     (let ((c comparator) (x a) (y b)) (cond ((<? c x y) less) ((=? c x y) equal) (else greater))))))
