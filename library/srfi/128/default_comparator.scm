; The default comparator, which compares any two values of the language: first by type, then by value. Types that it does not
; order are registered with comparator-register-default!.

(define registered '())
(define (comparator-register-default! [c comparator?]) (set! registered (append registered (list c))))
(define (registered-for x) (find (lambda (c) (comparator-test-type c x)) registered))

; The types in their order, each with its equality, order and hash function.
(define (bytes-in-order? a b)
  (let ((n (bytevector-length a)))
    (if (= n (bytevector-length b))
        (let loop ((i 0))
          (and (< i n)
               (let ((x (bytevector-u8-ref a i)) (y (bytevector-u8-ref b i))) (if (= x y) (loop (+ i 1)) (< x y)))))
        (< n (bytevector-length b)))))
(define (symbol-in-order? a b) (string<? (symbol->string a) (symbol->string b)))
(define (simple-type x)
  (cond ((null? x) 0) ((pair? x) 1) ((boolean? x) 2) ((char? x) 3) ((string? x) 4) ((symbol? x) 5) ((number? x) 6) ((vector? x) 7)
        ((bytevector? x) 8) (else #f)))
(define equalities
  (vector eq? (lambda (a b) (pairs-same? a b)) eq? char=? string=? eq? = (lambda (a b) (vectors-same? a b)) equal?))
(define orders
  (vector (lambda (a b) #f) (lambda (a b) (pairs-in-order? a b)) (lambda (a b) (and (not a) b)) char<? string<? symbol-in-order? <
          (lambda (a b) (vectors-in-order? a b)) bytes-in-order?))

(define (default-same? a b)
  (let ((type (simple-type a)))
    (cond ((not (eqv? type (simple-type b))) #f)
          (type ((vector-ref equalities type) a b))
          (else
           (let ((c (registered-for a)))
             (if (and c (comparator-test-type c b)) ((comparator-equality-predicate c) a b) (equal? a b)))))))
; Lists are compared in a loop: their length has no limit.
(define (pairs-same? a b)
  (and (default-same? (car a) (car b))
       (let ((a (cdr a)) (b (cdr b))) (if (and (pair? a) (pair? b)) (pairs-same? a b) (default-same? a b)))))
(define (pairs-in-order? a b)
  (if (default-same? (car a) (car b))
      (let ((a (cdr a)) (b (cdr b))) (if (and (pair? a) (pair? b)) (pairs-in-order? a b) (default-in-order? a b)))
      (default-in-order? (car a) (car b))))
(define (vectors-same? a b) (=? vector-comparator a b))
(define (vectors-in-order? a b) (<? vector-comparator a b))

; Values of registered types come after the others, in the order of their registration.
(define (type-order x)
  (or (simple-type x)
      (let loop ((l registered) (i 9))
        (cond ((null? l) (error "the default comparator has no order for this value; comparator-register-default! adds one:" x))
              ((comparator-test-type (car l) x) i)
              (else (loop (cdr l) (+ i 1)))))))
(define (default-in-order? a b)
  (let ((type-a (type-order a)) (type-b (type-order b)))
    (cond ((not (= type-a type-b)) (< type-a type-b))
          ((< type-a 9) ((vector-ref orders type-a) a b))
          (else ((comparator-ordering-predicate (registered-for a)) a b)))))

(define (default-hash x . ignored)
  (cond ((number? x) (number-hash x))
        ((pair? x) (let loop ((x x) (code 17)) (if (pair? x) (loop (cdr x) (joined-hash code (default-hash (car x)))) (joined-hash code (default-hash x)))))
        ((vector? x) (comparator-hash vector-comparator x))
        ((or (simple-type x) (not (registered-for x))) (equal-hash x))
        (else (comparator-hash (registered-for x) x))))

(define default-comparator (make-comparator any? default-same? default-in-order? default-hash))
(define vector-comparator (make-vector-comparator default-comparator vector? vector-length vector-ref))
(define (make-default-comparator) default-comparator)
(define eq-comparator (make-comparator any? eq? default-in-order? default-hash))
(define eqv-comparator (make-comparator any? eqv? default-in-order? default-hash))
(define equal-comparator (make-comparator any? equal? default-in-order? default-hash))
(define (make-eq-comparator) eq-comparator)
(define (make-eqv-comparator) eqv-comparator)
(define (make-equal-comparator) equal-comparator)
