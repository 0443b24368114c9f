; The procedures of SRFI 125. No table is immutable.

; ---- constructors ----

(define (make-hash-table [type any? equal?] . more) (table-of type more))
(define (hash-table type . keys-and-values)
  (let ((table (table-of type '())))
    (apply hash-table-set! table keys-and-values)
    table))
(define (hash-table-unfold [stop? procedure?] [mapper procedure?] [successor procedure?] seed type . more)
  (let ((table (table-of type more)))
    (let loop ((state seed))
      (if (stop? state)
          table
          (begin
            (call-with-values (lambda () (mapper state)) (lambda (key value) (put! table key value)))
            (loop (successor state)))))))
; The first of equal keys counts.
(define (alist->hash-table [alist (list-of pair?)] [type any? equal?] . more)
  (let ((table (table-of type more)))
    (for-each (lambda (entry) (put! table (car entry) (cdr entry))) (reverse alist))
    table))

; ---- predicates and single keys ----

(define (hash-table-contains? [table hash-table?] key) (not (missing? (value-of table key missing))))
(define hash-table-exists? hash-table-contains?)
(define (hash-table-empty? [table hash-table?]) (= 0 (size-of table)))
(define (hash-table-mutable? [table hash-table?]) #t)
(define (hash-table=? [values comparator?] [a hash-table?] [b hash-table?])
  (and (= (size-of a) (size-of b))
       (every (lambda (entry)
                (let ((other (value-of b (car entry) missing))) (and (not (missing? other)) (=? values (cdr entry) other))))
              (entries a))))

(define (no-key who) (lambda (key) (error (string-append who ": the table has no such key:") key)))
(define (found who table key failure success)
  (let ((value (value-of table key missing)))
    (cond ((not (missing? value)) (if success (success value) value))
          (failure (failure))
          (else ((no-key who) key)))))
(define (procedure-or-#f? x) (or (not x) (procedure? x)))
(define (hash-table-ref [table hash-table?] key [failure procedure-or-#f? #f] [success procedure-or-#f? #f])
  (found "hash-table-ref" table key failure success))
(define (hash-table-ref/default [table hash-table?] key default) (value-of table key default))

(define (hash-table-set! [table hash-table?] . keys-and-values)
  (let loop ((l keys-and-values))
    (cond ((null? l))
          ((null? (cdr l)) (error "hash-table-set!: no value follows the key" (car l)))
          (else (put! table (car l) (cadr l)) (loop (cddr l))))))
; Returns how many of the keys the table had.
(define (hash-table-delete! [table hash-table?] . keys) (count (lambda (key) (delete! table key)) keys))
(define (hash-table-intern! [table hash-table?] key [failure procedure?])
  (let ((value (value-of table key missing)))
    (if (missing? value)
        (let ((new (failure)))
          (put! table key new)
          new)
        value)))
(define (hash-table-update! [table hash-table?] key [f procedure?] [failure procedure-or-#f? #f] [success procedure-or-#f? #f])
  (put! table key (f (found "hash-table-update!" table key failure success))))
(define (hash-table-update!/default [table hash-table?] key [f procedure?] default) (put! table key (f (value-of table key default))))
; Removes an entry, and returns its key and value.
(define (hash-table-pop! [table hash-table?])
  (if (hash-table-empty? table) (error "hash-table-pop!: the table is empty"))
  (let ((entry (car (entries table))))
    (delete! table (car entry))
    (values (car entry) (cdr entry))))
(define (hash-table-clear! [table hash-table?]) (clear! table))

; ---- the whole table ----

(define (hash-table-size [table hash-table?]) (size-of table))
(define (hash-table-keys [table hash-table?]) (map car (entries table)))
(define (hash-table-values [table hash-table?]) (map cdr (entries table)))
(define (hash-table-entries [table hash-table?])
  (let ((all (entries table))) (values (map car all) (map cdr all))))
(define (hash-table->alist [table hash-table?]) (entries table))

; Editions of SRFI 125 differ in the order of these two arguments: both orders are right. Returns the table and the procedure.
(define (sorted-arguments who a b)
  (cond ((and (hash-table? a) (procedure? b)) (values a b))
        ((and (procedure? a) (hash-table? b)) (values b a))
        (else (error (string-append who ": expected a procedure and a hash table, got") a b))))
(define (hash-table-find a b [failure procedure?])
  (call-with-values (lambda () (sorted-arguments "hash-table-find" a b))
    (lambda (table f)
      (let loop ((l (entries table)))
        (if (null? l) (failure) (or (f (car (car l)) (cdr (car l))) (loop (cdr l))))))))
(define (hash-table-count a b)
  (call-with-values (lambda () (sorted-arguments "hash-table-count" a b))
    (lambda (table good?) (count (lambda (entry) (good? (car entry) (cdr entry))) (entries table)))))

; ---- mapping and folding ----

; Returns a table of the same keys, whose values f makes from the values.
(define (hash-table-map [f procedure?] type [table hash-table?])
  (let ((new (table-of type '())))
    (for-each (lambda (entry) (put! new (car entry) (f (cdr entry)))) (entries table))
    new))
(define (hash-table-for-each a b)
  (call-with-values (lambda () (sorted-arguments "hash-table-for-each" a b))
    (lambda (table f) (for-each (lambda (entry) (f (car entry) (cdr entry))) (entries table)))))
(define (hash-table-walk [table hash-table?] [f procedure?]) (hash-table-for-each f table))
(define (hash-table-map! [f procedure?] [table hash-table?])
  (for-each (lambda (entry) (put! table (car entry) (f (car entry) (cdr entry)))) (entries table)))
(define (hash-table-map->list [f procedure?] [table hash-table?])
  (map (lambda (entry) (f (car entry) (cdr entry))) (entries table)))
; As (hash-table-fold f seed table), or in the order of SRFI 69: (hash-table-fold table f seed).
(define (hash-table-fold a b c)
  (if (hash-table? a)
      (fold-entries a b c)
      (fold-entries c a b)))
(define (fold-entries [table hash-table?] [f procedure?] seed)
  (fold (lambda (entry state) (f (car entry) (cdr entry) state)) seed (entries table)))
(define (hash-table-prune! [drop? procedure?] [table hash-table?])
  (for-each (lambda (entry) (if (drop? (car entry) (cdr entry)) (delete! table (car entry)))) (entries table)))

; ---- copies and sets ----

(define (hash-table-empty-copy [table hash-table?]) (empty-like table))
(define (hash-table-copy [table hash-table?] [mutable? any? #t])
  (let ((copy (empty-like table)))
    (for-each (lambda (entry) (put! copy (car entry) (cdr entry))) (entries table))
    copy))
; Each changes the first table, and returns it.
(define (hash-table-union! [to hash-table?] [from hash-table?])
  (for-each (lambda (entry) (if (not (hash-table-contains? to (car entry))) (put! to (car entry) (cdr entry)))) (entries from))
  to)
(define hash-table-merge! hash-table-union!)
(define (hash-table-intersection! [to hash-table?] [from hash-table?])
  (hash-table-prune! (lambda (key value) (not (hash-table-contains? from key))) to)
  to)
(define (hash-table-difference! [to hash-table?] [from hash-table?])
  (hash-table-prune! (lambda (key value) (hash-table-contains? from key)) to)
  to)
(define (hash-table-xor! [to hash-table?] [from hash-table?])
  (for-each (lambda (entry) (if (not (delete! to (car entry))) (put! to (car entry) (cdr entry)))) (entries from))
  to)

; ---- hash functions, by the names of SRFI 69 ----

(define hash default-hash)
(define hash-by-identity default-hash)
(define (hash-table-equivalence-function [table hash-table?])
  (cond ((keyed-table? table) (keyed-table-same? table))
        ((own-eqv? table) eqv?)
        (else equal?)))
; Returns #f for a table whose hash function is the language's own.
(define (hash-table-hash-function [table hash-table?]) (and (keyed-table? table) (keyed-table-code table)))
; Tells two equal strings of different places apart, as only a table by eqv? does.
(define (own-eqv? table)
  (let ((probe (empty-like table)))
    (hash-set! probe (string #\a) #t)
    (not (hash-has-key? probe (string #\a)))))
