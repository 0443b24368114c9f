; SRFI 125: each name, on tables of each kind; the operations on random keys equal those on association lists
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(define own-table (make-hash))
(import (srfi 125) (srfi 128))
(define numbers (make-comparator number? = < number-hash))
(define texts (make-comparator string? string-ci=? string-ci<? string-ci-hash))
; The kinds: own tables, tables with checked keys, tables with buckets.
(define kinds (list (make-eq-comparator) (make-eqv-comparator) (make-equal-comparator) (make-default-comparator) numbers equal? =))
(define (sorted table) (list-sort (hash-table->alist table)))
(define (list-sort l) (sort l (lambda (a b) (< (car a) (car b)))))
(define (in-each f) (let ((first (f (car kinds)))) (if (every (lambda (kind) (equal? (f kind) first)) kinds) first (map f kinds))))
(show (in-each (lambda (kind) (sorted (hash-table kind 1 'a 2 'b 1 'c))))) ; expect: ((1 . c) (2 . b))
(show (in-each (lambda (kind) (sorted (alist->hash-table '((1 . a) (2 . b) (1 . c)) kind))))) ; expect: ((1 . a) (2 . b))
(show (in-each (lambda (kind) (sorted (hash-table-unfold (lambda (i) (= i 3)) (lambda (i) (values i (* i i))) (lambda (i) (+ i 1)) 0 kind))))) ; expect: ((0 . 0) (1 . 1) (2 . 4))
(define (sample kind) (alist->hash-table '((1 . 10) (2 . 20) (3 . 30)) kind))
(show (in-each (lambda (kind) (let ((t (sample kind))) (list (hash-table? t) (hash-table-contains? t 1) (hash-table-exists? t 9) (hash-table-empty? t) (hash-table-empty? (make-hash-table kind)) (hash-table-mutable? t) (hash-table-size t)))))) ; expect: (#t #t #f #f #t #t 3)
(show (in-each (lambda (kind) (let ((t (sample kind))) (list (hash-table-ref t 1) (hash-table-ref t 9 (lambda () 'none)) (hash-table-ref t 1 (lambda () 'none) -) (hash-table-ref/default t 9 'none) (hash-table-ref/default t 2 'none)))))) ; expect: (10 none -10 none 20)
(show (in-each (lambda (kind) (let ((t (sample kind))) (hash-table-set! t 4 40 1 11) (list (hash-table-delete! t 2 9 3) (sorted t) (hash-table-size t)))))) ; expect: (2 ((1 . 11) (4 . 40)) 2)
(show (in-each (lambda (kind) (let* ((t (sample kind)) (new (hash-table-intern! t 7 (lambda () 70))) (old (hash-table-intern! t 7 (lambda () 0)))) (list new old))))) ; expect: (70 70)
(show (in-each (lambda (kind) (let ((t (sample kind))) (hash-table-update! t 1 (lambda (x) (+ x 1))) (hash-table-update! t 5 list (lambda () 'new)) (hash-table-update! t 2 list (lambda () 'new) -) (hash-table-update!/default t 6 list 0) (sorted t))))) ; expect: ((1 . 11) (2 -20) (3 . 30) (5 new) (6 0))
(show (in-each (lambda (kind) (let ((t (sample kind))) (call-with-values (lambda () (hash-table-pop! t)) (lambda (k v) (list (= v (* 10 k)) (hash-table-size t) (hash-table-contains? t k)))))))) ; expect: (#t 2 #f)
(show (in-each (lambda (kind) (let ((t (sample kind))) (hash-table-clear! t) (list (hash-table-size t) (hash-table->alist t)))))) ; expect: (0 ())
(show (in-each (lambda (kind) (let ((t (sample kind))) (list (sort (hash-table-keys t) <) (sort (hash-table-values t) <) (call-with-values (lambda () (hash-table-entries t)) (lambda (k v) (equal? (map (lambda (x) (* 10 x)) k) v)))))))) ; expect: ((1 2 3) (10 20 30) #t)
(show (in-each (lambda (kind) (let ((t (sample kind))) (list (hash-table-find (lambda (k v) (and (= k 2) v)) t (lambda () 'none)) (hash-table-find t (lambda (k v) #f) (lambda () 'none)) (hash-table-count (lambda (k v) (> v 15)) t) (hash-table-count t (lambda (k v) #t))))))) ; expect: (20 none 2 3)
(show (in-each (lambda (kind) (sorted (hash-table-map - kind (sample kind)))))) ; expect: ((1 . -10) (2 . -20) (3 . -30))
(show (in-each (lambda (kind) (let ((t (sample kind)) (sum 0)) (hash-table-for-each (lambda (k v) (set! sum (+ sum k v))) t) (hash-table-walk t (lambda (k v) (set! sum (+ sum k v)))) (hash-table-map! (lambda (k v) (+ k v)) t) (list sum (sorted t)))))) ; expect: (132 ((1 . 11) (2 . 22) (3 . 33)))
(show (in-each (lambda (kind) (let ((t (sample kind))) (list (sort (hash-table-map->list + t) <) (hash-table-fold (lambda (k v s) (+ k v s)) 0 t) (hash-table-fold t (lambda (k v s) (+ k v s)) 0)))))) ; expect: ((11 22 33) 66 66)
(show (in-each (lambda (kind) (let ((t (sample kind))) (hash-table-prune! (lambda (k v) (odd? k)) t) (sorted t))))) ; expect: ((2 . 20))
(show (in-each (lambda (kind) (let* ((t (sample kind)) (copy (hash-table-copy t #t)) (empty (hash-table-empty-copy t))) (hash-table-set! copy 1 0) (hash-table-set! empty 1 0) (list (sorted t) (sorted copy) (sorted empty)))))) ; expect: (((1 . 10) (2 . 20) (3 . 30)) ((1 . 0) (2 . 20) (3 . 30)) ((1 . 0)))
(define (other kind) (alist->hash-table '((2 . 0) (4 . 40)) kind))
(show (in-each (lambda (kind) (map (lambda (f) (sorted (f (sample kind) (other kind)))) (list hash-table-union! hash-table-merge! hash-table-intersection! hash-table-difference! hash-table-xor!))))) ; expect: (((1 . 10) (2 . 20) (3 . 30) (4 . 40)) ((1 . 10) (2 . 20) (3 . 30) (4 . 40)) ((2 . 20)) ((1 . 10) (3 . 30)) ((1 . 10) (3 . 30) (4 . 40)))
(show (in-each (lambda (kind) (list (hash-table=? numbers (sample kind) (sample kind)) (hash-table=? numbers (sample kind) (other kind)) (hash-table=? numbers (hash-table kind 1 2) (hash-table kind 1 2.0)) (hash-table=? numbers (hash-table kind 1 2) (hash-table kind 3 2)))))) ; expect: (#t #f #t #f)
; Keys that the equality takes for one
(show (list (hash-table-size (hash-table numbers 1 'a 1.0 'b)) (hash-table-ref (hash-table texts "Door" 1) "DOOR") (hash-table-size (hash-table string-ci=? "a" 1 "A" 2)) (hash-table-size (hash-table equal? 1 'a 1.0 'b)) (hash-table-size (hash-table eq? "a" 1 (string #\a) 2)) (hash-table-size (hash-table string=? "a" 1 (string #\a) 2)))) ; expect: (1 1 1 2 2 1)
(show (hash-table-size (hash-table (make-default-comparator) '(1 "a") 1 '(1.0 "a") 2 #(1) 3 'b 4))) ; expect: 3
; A hash function that is the same for all keys makes one bucket.
(show (let ((t (make-hash-table = (lambda (x) 0) 100))) (for-each (lambda (i) (hash-table-set! t i (* i i))) (iota 50)) (hash-table-delete! t 7 8) (list (hash-table-size t) (hash-table-ref/default t 49 #f) (hash-table-ref/default t 7 #f)))) ; expect: (48 2401 #f)
; Own tables of the language
(hash-set! own-table 'a 1)
(show (list (hash-table? own-table) (hash-table-ref own-table 'a) (hash? (make-hash-table (make-equal-comparator))) (hash? (make-hash-table)))) ; expect: (#t 1 #t #t)
(show (map (lambda (k) (hash-table-equivalence-function (make-hash-table k))) (list eqv? equal? string=? =))) ; expect: (#<procedure eqv?> #<procedure equal?> #<procedure string=?> #<procedure =>)
(show (list (hash-table-hash-function (make-hash-table equal?)) (eq? (hash-table-hash-function (make-hash-table texts)) string-ci-hash) (= (hash '(1 2)) (default-hash '(1 2))) (= (hash "a" 5) (string-hash "a" 5)) (= (string-ci-hash "A" 5) (string-ci-hash "a")) (= (hash-by-identity 'a) (hash 'a)))) ; expect: (#f #t #t #t #t #t)
; Random operations, against an association list
(define (agrees? kind seed)
  (random-seed! seed)
  (let ((t (make-hash-table kind)))
    (let loop ((i 0) (model '()))
      (if (= i 300)
          (equal? (sorted t) (list-sort model))
          (let* ((key (random 20)) (rest (remove (lambda (e) (= (car e) key)) model)))
            (if (= 0 (random 3))
                (begin (hash-table-delete! t key) (loop (+ i 1) rest))
                (begin (hash-table-set! t key i) (loop (+ i 1) (cons (cons key i) rest)))))))))
(show (every (lambda (kind) (every (lambda (seed) (agrees? kind seed)) (iota 5))) kinds)) ; expect: #t
(define-syntax refused (syntax-rules () ((_ e) (guard (c (#t (display (error-object-message c)) (for-each (lambda (x) (display " ") (write x)) (error-object-irritants c)) (newline))) e))))
(refused (hash-table-ref (sample equal?) 9)) ; expect: hash-table-ref: the table has no such key: 9
(refused (hash-table-update! (sample numbers) 9 list)) ; expect: hash-table-update!: the table has no such key: 9
(refused (hash-table-set! (make-hash-table texts) 5 1)) ; expect: hash-table-set!: the table's comparator is not for keys such as 5
(refused (hash-table equal? 1 2 3)) ; expect: hash-table-set!: no value follows the key 3
(refused (hash-table-pop! (make-hash-table equal?))) ; expect: hash-table-pop!: the table is empty
(refused (make-hash-table 5)) ; expect: make-hash-table: expected a comparator or an equality such as string=?, got 5
(refused (make-hash-table char-ci=?)) ; expect: make-hash-table: this equality needs a hash function; a comparator of (srfi 128) has both: #<procedure char-ci=?>
(refused (hash-table-count 1 2)) ; expect: hash-table-count: expected a procedure and a hash table, got 1 2
(hash-table-ref '((1 . 2)) 1) ; expect error: hash-table-ref: table must be hash-table?, got ((1 . 2))
