; Tables: one of the language's own (`hash?`), or a keyed table, which checks its keys by a test of type. A keyed table has
; cells, one of the language's own tables: from keys to values if the equality is at least as fine as equal?; otherwise from
; hash codes to buckets, lists of entries (key . value).

(define-record-type keyed-table (new-keyed-table key? same? code cells buckets? size) keyed-table?
  (key? keyed-table-key?)
  (same? keyed-table-same?)
  (code keyed-table-code)          ; the hash function, or #f
  (cells keyed-table-cells)
  (buckets? keyed-table-buckets?)
  (size keyed-table-size set-keyed-table-size!))
(define (hash-table? x) (or (hash? x) (keyed-table? x)))

; Equalities whose keys and hash functions are known, each as (equality key? hash-function finer-than-equal?).
(define known
  (list (list eq? any? #f #t) (list eqv? any? #f #t) (list equal? any? #f #t) (list string=? string? #f #t) (list char=? char? #f #t)
        (list symbol=? symbol? #f #t) (list boolean=? boolean? #f #t) (list string-ci=? string? string-ci-hash #f)
        (list = number? number-hash #f)))
(define (own-cells same?) (if (memq same? (list eq? eqv?)) (make-hasheqv) (make-hash)))
(define (new-table key? same? code)
  (let* ((row (assq same? known)) (fine? (and row (cadddr row))) (code (or code (and row (caddr row)))))
    (cond ((and fine? (eq? key? any?)) (own-cells same?))
          (fine? (new-keyed-table key? same? code (own-cells same?) #f 0))
          (code (new-keyed-table key? same? code (make-hash) #t 0))
          (else (error "make-hash-table: this equality needs a hash function; a comparator of (srfi 128) has both:" same?)))))
; Returns an empty table; type: a comparator, or an equality before its hash function. The other arguments, such as a size,
; change nothing.
(define (table-of type more)
  (cond ((comparator? type)
         (new-table (comparator-type-test-predicate type) (comparator-equality-predicate type)
                    (and (comparator-hashable? type) (comparator-hash-function type))))
        ((procedure? type)
         (let ((row (assq type known)))
           (new-table (if row (cadr row) any?) type (and (pair? more) (procedure? (car more)) (car more)))))
        (else (error "make-hash-table: expected a comparator or an equality such as string=?, got" type))))
(define (empty-like table)
  (cond ((not (hash? table)) (new-table (keyed-table-key? table) (keyed-table-same? table) (keyed-table-code table)))
        (else (let ((copy (hash-copy table))) (hash-clear! copy) copy))))

; ---- one key ----

(define missing (list 'missing))
(define (missing? x) (eq? x missing))
(define (bucket table code) (own-ref (keyed-table-cells table) code '()))
(define (entry-of table key) (assoc key (bucket table ((keyed-table-code table) key)) (keyed-table-same? table)))
; Returns the value of the key, or `otherwise`.
(define (value-of table key otherwise)
  (cond ((hash? table) (own-ref table key otherwise))
        ((not (keyed-table-buckets? table)) (own-ref (keyed-table-cells table) key otherwise))
        (else (let ((entry (entry-of table key))) (if entry (cdr entry) otherwise)))))

(define (add-entry! table key value)
  (let ((code ((keyed-table-code table) key)))
    (hash-set! (keyed-table-cells table) code (cons (cons key value) (bucket table code)))
    (set-keyed-table-size! table (+ (keyed-table-size table) 1))))
(define (put! table key value)
  (if (hash? table)
      (hash-set! table key value)
      (begin
        (if (not ((keyed-table-key? table) key)) (error "hash-table-set!: the table's comparator is not for keys such as" key))
        (if (keyed-table-buckets? table)
            (let ((entry (entry-of table key))) (if entry (set-cdr! entry value) (add-entry! table key value)))
            (hash-set! (keyed-table-cells table) key value)))))

(define (remove-entry! table entry)
  (let* ((code ((keyed-table-code table) (car entry))) (rest (remove (lambda (e) (eq? e entry)) (bucket table code))))
    (if (null? rest) (hash-remove! (keyed-table-cells table) code) (hash-set! (keyed-table-cells table) code rest))
    (set-keyed-table-size! table (- (keyed-table-size table) 1))))
; Returns whether the table had the key.
(define (delete! table key)
  (let ((had (not (missing? (value-of table key missing)))))
    (cond ((not had) #f)
          ((hash? table) (hash-remove! table key))
          ((keyed-table-buckets? table) (remove-entry! table (entry-of table key)))
          (else (hash-remove! (keyed-table-cells table) key)))
    had))

; ---- the whole table ----

; Returns new pairs of keys and values.
(define (entries table)
  (cond ((hash? table) (hash->list table))
        ((keyed-table-buckets? table)
         (append-map (lambda (bucket) (map (lambda (entry) (cons (car entry) (cdr entry))) (reverse bucket)))
                     (hash-values (keyed-table-cells table))))
        (else (hash->list (keyed-table-cells table)))))
(define (size-of table)
  (cond ((hash? table) (hash-count table))
        ((keyed-table-buckets? table) (keyed-table-size table))
        (else (hash-count (keyed-table-cells table)))))
(define (clear! table)
  (hash-clear! (if (hash? table) table (keyed-table-cells table)))
  (if (keyed-table? table) (set-keyed-table-size! table 0)))
