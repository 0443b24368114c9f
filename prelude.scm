; The language's own library, in Scheme: every standard procedure that calls a procedure it was given, so that call/cc, errors,
; limits and interrupts work through all of them. No geometry. Compiled into the binary when it is built.
;
; Names that begin with % are not visible to programs. Procedures without procedure arguments are C (vm/). Lists are walked left to
; right and results built without mutation, so a continuation captured in the middle may be re-entered any number of times.

; ---- syntax ----
; What needs no C: rules over the core syntax of vm/forms.def and the procedures % of vm/control.c.

(define-syntax define-syntax-rule
  (syntax-rules ()
    ((_ (name . pattern) template) (define-syntax name (syntax-rules () ((_ . pattern) template))))))

(define-syntax %call-with-values-of          ; (%call-with-values-of expression formals body ...)
  (syntax-rules ()
    ((_ expression formals . body) (call-with-values (lambda () expression) (lambda formals . body)))))

(define-syntax receive
  (syntax-rules ()
    ((_ formals expression . body) (%call-with-values-of expression formals . body))))

(define-syntax let*-values
  (syntax-rules ()
    ((_ () . body) (let () . body))
    ((_ ((formals expression) . more) . body) (%call-with-values-of expression formals (let*-values more . body)))))

; The formals of a clause get fresh names first, so that no expression sees a name bound by another clause.
(define-syntax let-values
  (syntax-rules ()
    ((_ (((name) expression) ...) . body) (let ((name expression) ...) . body))
    ((_ ((formals expression)) . body) (%call-with-values-of expression formals . body))
    ((_ (clause ...) . body) (%let-values (clause ...) () . body))))
(define-syntax %let-values
  (syntax-rules ()
    ((_ () ((name value) ...) . body) (let ((name value) ...) . body))
    ((_ ((formals expression) . more) bound . body) (%let-values-formals formals () expression more bound . body))))
(define-syntax %let-values-formals
  (syntax-rules ()
    ((_ () (fresh ...) expression more bound . body)
     (%call-with-values-of expression (fresh ...) (%let-values more bound . body)))
    ((_ (name . names) (fresh ...) expression more (pair ...) . body)
     (%let-values-formals names (fresh ... x) expression more (pair ... (name x)) . body))
    ((_ rest (fresh ...) expression more (pair ...) . body)
     (%call-with-values-of expression (fresh ... . x) (%let-values more (pair ... (rest x)) . body)))))

(define-syntax define-values
  (syntax-rules ()
    ((_ () expression) (define unused (%call-with-values-of expression () #f)))
    ((_ (name) expression) (define name (%call-with-values-of expression (x) x)))
    ((_ (name . names) expression) (%define-values (name . names) () expression))
    ((_ rest expression) (define rest (%call-with-values-of expression x x)))))
(define-syntax %define-values
  (syntax-rules ()
    ((_ () (name ...) expression)
     (begin (define found (%call-with-values-of expression list-of-values (%count-values list-of-values '(name ...) #f)))
            (define name (%next-value found)) ...))
    ((_ (name . names) (known ...) expression) (%define-values names (known ... name) expression))
    ((_ rest (name ...) expression)
     (begin (define found (%call-with-values-of expression list-of-values (%count-values list-of-values '(name ...) #t)))
            (define name (%next-value found)) ...
            (define rest (car found))))))
; the values in a box of one pair, taken off one by one
(define (%count-values values names rest?)
  (if (or (< (length values) (length names)) (and (not rest?) (> (length values) (length names))))
      (error (string-append "define-values: expected " (number->string (length names)) (if rest? " or more" "")
                            (if (= (length names) 1) " value" " values") ", got")
             (length values)))
  (list values))
(define (%next-value box)
  (let ((value (car (car box))))
    (set-car! box (cdr (car box)))
    value))

(define-syntax parameterize
  (syntax-rules ()
    ((_ ((parameter value) ...) . body) (%parameterize (list parameter ...) (list value ...) (lambda () . body)))))

(define-syntax delay-force (syntax-rules () ((_ expression) (%lazy (lambda () expression)))))
(define-syntax delay (syntax-rules () ((_ expression) (delay-force (%kept-promise expression)))))
(define-syntax cons-stream (syntax-rules () ((_ first rest) (cons first (delay rest)))))

(define-syntax let/cc (syntax-rules () ((_ k . body) (call-with-current-continuation (lambda (k) . body)))))
(define-syntax let/ec (syntax-rules () ((_ k . body) (call-with-current-continuation (lambda (k) . body)))))

(define-syntax case*
  (syntax-rules ()
    ((_ object clause ...) (let ((x object)) (%case* x clause ...)))))
(define-syntax %case*
  (syntax-rules (else =>)
    ((_ x) (if #f #f))
    ((_ x (else => procedure)) (procedure x))
    ((_ x (else value ...)) (begin value ...))
    ((_ x (predicate => procedure) clause ...) (if (predicate x) (procedure x) (%case* x clause ...)))
    ((_ x (predicate value ...) clause ...) (if (predicate x) (begin value ...) (%case* x clause ...)))))

(define-syntax guard
  (syntax-rules ()
    ((_ (name clause ...) . body)
     ((call-with-current-continuation
       (lambda (leave)
         (with-exception-handler
          (lambda (condition)
            ((call-with-current-continuation
              (lambda (resume)
                (leave (lambda () (let ((name condition)) (%guard-clauses (resume (lambda () (raise-continuable condition))) clause ...))))))))
          (lambda ()
            (call-with-values (lambda () . body)
              (lambda results (leave (lambda () (apply values results)))))))))))))
(define-syntax %guard-clauses
  (syntax-rules (else =>)
    ((_ again) again)
    ((_ again (else value ...)) (begin value ...))
    ((_ again (test => procedure) clause ...) (let ((x test)) (if x (procedure x) (%guard-clauses again clause ...))))
    ((_ again (test) clause ...) (let ((x test)) (if x x (%guard-clauses again clause ...))))
    ((_ again (test value ...) clause ...) (if test (begin value ...) (%guard-clauses again clause ...)))))

; ---- for: clauses (name sequence) side by side, for* nested; #:when guards what follows it ----
; A sequence is a list, a vector, a string, a hash table, a number (0 to n - 1), or (in-range a b step), (in-list l), (in-vector v) ...
; In for, names side by side walk together; in for*, every clause is a loop of its own.
(define-syntax for (syntax-rules () ((_ clauses . body) (begin (%for-each clauses (let () . body)) (if #f #f)))))
(define-syntax for* (syntax-rules () ((_ clauses . body) (begin (%for-each* clauses (let () . body)) (if #f #f)))))
(define-syntax for/list
  (syntax-rules () ((_ clauses . body) (let ((found '())) (%for-each clauses (set! found (cons (let () . body) found))) (reverse found)))))
(define-syntax for*/list
  (syntax-rules () ((_ clauses . body) (let ((found '())) (%for-each* clauses (set! found (cons (let () . body) found))) (reverse found)))))
(define-syntax for/vector (syntax-rules () ((_ clauses . body) (list->vector (for/list clauses . body)))))
(define-syntax for/sum
  (syntax-rules () ((_ clauses . body) (let ((sum 0)) (%for-each clauses (set! sum (+ sum (let () . body)))) sum))))
(define-syntax for*/sum
  (syntax-rules () ((_ clauses . body) (let ((sum 0)) (%for-each* clauses (set! sum (+ sum (let () . body)))) sum))))
(define-syntax for/and
  (syntax-rules () ((_ clauses . body) (let/ec leave (let ((last #t)) (%for-each clauses (begin (set! last (let () . body)) (if (not last) (leave #f)))) last)))))
(define-syntax for/or
  (syntax-rules () ((_ clauses . body) (let/ec leave (%for-each clauses (let ((x (let () . body))) (if x (leave x)))) #f))))
(define-syntax for/fold
  (syntax-rules ()
    ((_ ((name start)) clauses . body) (let ((name start)) (%for-each clauses (set! name (let () . body))) name))
    ((_ ((name start) ...) clauses . body)
     (let ((name start) ...) (%for-each clauses (%set-values (name ...) (let () . body))) (values name ...)))))
(define-syntax %set-values
  (syntax-rules () ((_ (name ...) expression) (%set-values-from (name ...) () expression))))
(define-syntax %set-values-from
  (syntax-rules ()
    ((_ () ((name x) ...) expression) (%call-with-values-of expression (x ...) (set! name x) ...))
    ((_ (name . names) (pair ...) expression) (%set-values-from names (pair ... (name x)) expression))))

(define-syntax %for-each*
  (syntax-rules ()
    ((_ () action) action)
    ((_ (#:when test . more) action) (if test (%for-each* more action)))
    ((_ (#:unless test . more) action) (if test #f (%for-each* more action)))
    ((_ (clause . more) action) (%for-one clause (%for-each* more action)))))
(define-syntax %for-each
  (syntax-rules ()
    ((_ () action) action)
    ((_ (#:when test . more) action) (if test (%for-each more action)))
    ((_ (#:unless test . more) action) (if test #f (%for-each more action)))
    ((_ (clause #:when . more) action) (%for-one clause (%for-each (#:when . more) action)))
    ((_ (clause #:unless . more) action) (%for-one clause (%for-each (#:unless . more) action)))
    ((_ (clause) action) (%for-one clause action))
    ((_ (clause . more) action) (%for-together (clause . more) () action))))
; one name: the ranges run without making a list
(define-syntax %for-one
  (syntax-rules (in-range in-list in-naturals)
    ((_ (name (in-range end)) action) (let ((to end)) (do ((i 0 (+ i 1))) ((>= i to)) (let ((name i)) action))))
    ((_ (name (in-range start end)) action) (let ((from start) (to end)) (do ((i from (+ i 1))) ((>= i to)) (let ((name i)) action))))
    ((_ (name (in-range start end step)) action)
     (let ((from start) (to end) (by step))
       (do ((i from (+ i by))) ((if (< by 0) (<= i to) (>= i to))) (let ((name i)) action))))
    ((_ (name (in-naturals)) action) (do ((i 0 (+ i 1))) (#f) (let ((name i)) action)))
    ((_ ((name ...) sequence) action) (let next ((l (%sequence sequence))) (if (pair? l) (begin (apply (lambda (name ...) action) (car l)) (next (cdr l))))))
    ((_ (name sequence) action) (let next ((l (%sequence sequence))) (if (pair? l) (begin (let ((name (car l))) action) (next (cdr l))))))))
; several: lists, until the shortest ends; a #:when behind some of them guards the rest
(define-syntax %for-together
  (syntax-rules ()
    ((_ () ((name sequence l) ...) action)
     (let next ((l (%sequence sequence)) ...)
       (if (and (pair? l) ...) (begin (let ((name (car l)) ...) action) (next (cdr l) ...)))))
    ((_ (#:when . more) done action) (%for-together () done (%for-each (#:when . more) action)))
    ((_ (#:unless . more) done action) (%for-together () done (%for-each (#:unless . more) action)))
    ((_ ((name sequence) . more) (done ...) action) (%for-together more (done ... (name sequence l)) action))))
(define (in-range start . more)
  (let* ((from (if (pair? more) start 0))
         (to (if (pair? more) (car more) start))
         (by (if (and (pair? more) (pair? (cdr more))) (cadr more) 1)))
    (let next ((i from) (found '()))
      (if (if (< by 0) (<= i to) (>= i to)) (reverse found) (next (+ i by) (cons i found))))))
(define (in-list l) l)
(define (in-vector v) (vector->list v))
(define (in-string s) (string->list s))
(define (in-hash h) (map (lambda (p) (list (car p) (cdr p))) (hash->list h)))
(define (in-naturals . start) (error "in-naturals: it stands only as the one sequence of a clause: (for ((i (in-naturals))) ...)"))
(define (%sequence s)
  (cond ((pair? s) s)
        ((null? s) s)
        ((vector? s) (vector->list s))
        ((string? s) (string->list s))
        ((and (exact-integer? s) (>= s 0)) (iota s))
        ((bytevector? s) (let next ((i (- (bytevector-length s) 1)) (l '())) (if (< i 0) l (next (- i 1) (cons (bytevector-u8-ref s i) l)))))
        ((hash? s) (in-hash s))
        (else (error "for: expected a list, a vector, a string, a hash table or a count, got" s))))

; ---- contracts: (list-of p), (and p q), (or p q) in parameter lists; a predicate that raises counts as false ----
(define (%holds? p x) (call-with-current-continuation (lambda (k) (with-exception-handler (lambda (e) (k #f)) (lambda () (p x))))))
(define (list-of p) (lambda (l) (and (list? l) (let next ((l l)) (or (null? l) (and (p (car l)) (next (cdr l))))))))
(define (%contract-and . ps) (lambda (x) (let next ((ps ps)) (or (null? ps) (and (%holds? (car ps) x) (next (cdr ps)))))))
(define (%contract-or . ps) (lambda (x) (let next ((ps ps)) (and (pair? ps) (or (%holds? (car ps) x) (next (cdr ps)))))))

; ---- macros by renaming ----
(define (%expand-by-renaming transformer form home use)
  (let ((table (list '())))
    (transformer form (lambda (id) (%rename table home id)) (lambda (a b) (%same-identifier? use a b)))))

; ---- checks: the same wording as C's ----

(define (%need-procedure who name f)
  (if (not (procedure? f)) (error who "~a must be a procedure, got ~s" name f)))

; The end of a walk over `whole` that stopped at `rest`: a proper list ends in ().
(define (%need-end who whole rest)
  (if (not (null? rest)) (error who "expected a list, got ~s" whole)))

(define (%need-index who name n)
  (if (not (and (exact-integer? n) (>= n 0))) (error who "~a must be an exact integer from 0 on, got ~s" name n)))

; ---- several lists at once: the shortest ends the walk ----

(define (%any-end? lists)
  (let loop ((ls lists))
    (and (pair? ls) (or (not (pair? (car ls))) (loop (cdr ls))))))

(define (%cars lists)
  (let loop ((ls lists) (acc '()))
    (if (pair? ls) (loop (cdr ls) (cons (car (car ls)) acc)) (reverse acc))))

(define (%cdrs lists)
  (let loop ((ls lists) (acc '()))
    (if (pair? ls) (loop (cdr ls) (cons (cdr (car ls)) acc)) (reverse acc))))

; the cars, with `last` behind them
(define (%cars+ lists last) (append (%cars lists) (list last)))

; ---- mapping ----

(define map
  (case-lambda
    ((f list)
     (%need-procedure 'map 'f f)
     (let loop ((l list) (acc '()))
       (if (pair? l)
           (loop (cdr l) (cons (f (car l)) acc))
           (begin (%need-end 'map list l) (reverse acc)))))
    ((f list1 list2)
     (%need-procedure 'map 'f f)
     (let loop ((a list1) (b list2) (acc '()))
       (if (and (pair? a) (pair? b))
           (loop (cdr a) (cdr b) (cons (f (car a) (car b)) acc))
           (begin
             (if (not (pair? a)) (%need-end 'map list1 a) (%need-end 'map list2 b))
             (reverse acc)))))
    ((f . lists)
     (%need-procedure 'map 'f f)
     (let loop ((ls lists) (acc '()))
       (if (%any-end? ls)
           (reverse acc)
           (loop (%cdrs ls) (cons (apply f (%cars ls)) acc)))))))

(define for-each
  (case-lambda
    ((f list)
     (%need-procedure 'for-each 'f f)
     (let loop ((l list))
       (if (pair? l)
           (begin (f (car l)) (loop (cdr l)))
           (%need-end 'for-each list l))))
    ((f list1 list2)
     (%need-procedure 'for-each 'f f)
     (let loop ((a list1) (b list2))
       (if (and (pair? a) (pair? b))
           (begin (f (car a) (car b)) (loop (cdr a) (cdr b)))
           (if (not (pair? a)) (%need-end 'for-each list1 a) (%need-end 'for-each list2 b)))))
    ((f . lists)
     (%need-procedure 'for-each 'f f)
     (let loop ((ls lists))
       (if (not (%any-end? ls))
           (begin (apply f (%cars ls)) (loop (%cdrs ls))))))))

(define append-map
  (case-lambda
    ((f list)
     (%need-procedure 'append-map 'f f)
     (let loop ((l list) (acc '()))
       (if (pair? l)
           (loop (cdr l) (append-reverse (f (car l)) acc))
           (begin (%need-end 'append-map list l) (reverse acc)))))
    ((f . lists) (apply append (apply map f lists)))))

(define (filter-map f . lists)
  (%need-procedure 'filter-map 'f f)
  (let loop ((ls lists) (acc '()))
    (if (%any-end? ls)
        (reverse acc)
        (let ((v (apply f (%cars ls))))
          (loop (%cdrs ls) (if v (cons v acc) acc))))))

(define (vector-map f . vectors)
  (%need-procedure 'vector-map 'f f)
  (if (and (pair? vectors) (null? (cdr vectors)))
      (let* ((v (car vectors)) (n (vector-length v)))
        (let loop ((i 0) (acc '()))
          (if (< i n)
              (loop (+ i 1) (cons (f (vector-ref v i)) acc))
              (list->vector (reverse acc)))))
      (list->vector (apply map f (map vector->list vectors)))))

(define (vector-for-each f . vectors)
  (%need-procedure 'vector-for-each 'f f)
  (if (and (pair? vectors) (null? (cdr vectors)))
      (let* ((v (car vectors)) (n (vector-length v)))
        (let loop ((i 0))
          (if (< i n)
              (begin (f (vector-ref v i)) (loop (+ i 1))))))
      (apply for-each f (map vector->list vectors))))

(define (string-map f . strings)
  (%need-procedure 'string-map 'f f)
  (list->string (apply map f (map string->list strings))))

(define (string-for-each f . strings)
  (%need-procedure 'string-for-each 'f f)
  (apply for-each f (map string->list strings)))

(define (string-count s pred)
  (%need-procedure 'string-count 'pred pred)
  (count pred (string->list s)))

; Index of the first character that is `what` (a character) or satisfies it, or #f.
(define (string-index s what)
  (let ((n (string-length s))
        (hit? (if (char? what) (lambda (c) (char=? c what)) what)))
    (%need-procedure 'string-index 'what hit?)
    (let loop ((i 0))
      (and (< i n)
           (if (hit? (string-ref s i)) i (loop (+ i 1)))))))

; ---- folding ----

; SRFI 1: (f element accumulated); with several lists (f e1 e2 ... accumulated).
(define fold
  (case-lambda
    ((f init list)
     (%need-procedure 'fold 'f f)
     (let loop ((l list) (acc init))
       (if (pair? l)
           (loop (cdr l) (f (car l) acc))
           (begin (%need-end 'fold list l) acc))))
    ((f init . lists)
     (%need-procedure 'fold 'f f)
     (let loop ((ls lists) (acc init))
       (if (%any-end? ls)
           acc
           (loop (%cdrs ls) (apply f (%cars+ ls acc))))))))

(define fold-right
  (case-lambda
    ((f init list)
     (%need-procedure 'fold-right 'f f)
     (let loop ((l (reverse list)) (acc init))
       (if (pair? l) (loop (cdr l) (f (car l) acc)) acc)))
    ((f init . lists)
     (%need-procedure 'fold-right 'f f)
     (let loop ((rows (reverse (apply map list lists))) (acc init))
       (if (pair? rows)
           (loop (cdr rows) (apply f (append (car rows) (list acc))))
           acc)))))

; PLT's names, which take their arguments in the same order.
(define foldl fold)
(define foldr fold-right)

(define (reduce f identity list)
  (%need-procedure 'reduce 'f f)
  (if (null? list) identity (fold f (car list) (cdr list))))

(define (reduce-right f identity list)
  (%need-procedure 'reduce-right 'f f)
  (if (null? list)
      identity
      (let ((r (reverse list)))
        (fold f (car r) (cdr r)))))

; SRFI 1: (unfold stop? mapper successor seed [tail-gen]): the thesis calls it with these four.
(define unfold
  (case-lambda
    ((stop? mapper successor seed) (unfold stop? mapper successor seed (lambda (x) '())))
    ((stop? mapper successor seed tail-gen)
     (%need-procedure 'unfold 'stop? stop?)
     (%need-procedure 'unfold 'mapper mapper)
     (%need-procedure 'unfold 'successor successor)
     (let loop ((seed seed) (acc '()))
       (if (stop? seed)
           (append-reverse acc (tail-gen seed))
           (loop (successor seed) (cons (mapper seed) acc)))))))

(define unfold-right
  (case-lambda
    ((stop? mapper successor seed) (unfold-right stop? mapper successor seed '()))
    ((stop? mapper successor seed tail)
     (let loop ((seed seed) (acc tail))
       (if (stop? seed)
           acc
           (loop (successor seed) (cons (mapper seed) acc)))))))

; ---- choosing ----

(define (filter pred list)
  (%need-procedure 'filter 'pred pred)
  (let loop ((l list) (acc '()))
    (if (pair? l)
        (loop (cdr l) (if (pred (car l)) (cons (car l) acc) acc))
        (begin (%need-end 'filter list l) (reverse acc)))))

(define (remove pred list)
  (%need-procedure 'remove 'pred pred)
  (let loop ((l list) (acc '()))
    (if (pair? l)
        (loop (cdr l) (if (pred (car l)) acc (cons (car l) acc)))
        (begin (%need-end 'remove list l) (reverse acc)))))

(define (partition pred list)
  (%need-procedure 'partition 'pred pred)
  (let loop ((l list) (in '()) (out '()))
    (cond ((null? l) (values (reverse in) (reverse out)))
          ((not (pair? l)) (%need-end 'partition list l))
          ((pred (car l)) (loop (cdr l) (cons (car l) in) out))
          (else (loop (cdr l) in (cons (car l) out))))))

(define (delete x list . same)
  (let ((same? (if (pair? same) (car same) equal?)))
    (remove (lambda (y) (same? x y)) list)))

; The first of equal elements stays. With equal? it takes linear time.
(define delete-duplicates
  (case-lambda
    ((list)
     (let ((seen (make-hash)))
       (filter (lambda (x) (if (%hash-get seen x #f) #f (begin (hash-set! seen x #t) #t))) list)))
    ((list same?)
     (%need-procedure 'delete-duplicates 'same? same?)
     (let loop ((l list) (acc '()))
       (if (pair? l)
           (loop (cdr l)
                 (if (let in? ((a acc)) (and (pair? a) (or (same? (car a) (car l)) (in? (cdr a)))))
                     acc
                     (cons (car l) acc)))
           (reverse acc))))))
(define remove-duplicates delete-duplicates)

(define (find pred list)
  (%need-procedure 'find 'pred pred)
  (let loop ((l list))
    (cond ((pair? l) (if (pred (car l)) (car l) (loop (cdr l))))
          (else (%need-end 'find list l) #f))))

(define (find-tail pred list)
  (%need-procedure 'find-tail 'pred pred)
  (let loop ((l list))
    (cond ((pair? l) (if (pred (car l)) l (loop (cdr l))))
          (else (%need-end 'find-tail list l) #f))))

; Both end in a tail call of pred on the last elements, as SRFI 1 wants.
(define any
  (case-lambda
    ((pred list)
     (%need-procedure 'any 'pred pred)
     (and (pair? list)
          (let loop ((x (car list)) (l (cdr list)))
            (if (pair? l)
                (or (pred x) (loop (car l) (cdr l)))
                (pred x)))))
    ((pred . lists)
     (%need-procedure 'any 'pred pred)
     (and (not (%any-end? lists))
          (let loop ((ls lists))
            (let ((next (%cdrs ls)))
              (if (%any-end? next)
                  (apply pred (%cars ls))
                  (or (apply pred (%cars ls)) (loop next)))))))))

(define every
  (case-lambda
    ((pred list)
     (%need-procedure 'every 'pred pred)
     (or (not (pair? list))
         (let loop ((x (car list)) (l (cdr list)))
           (if (pair? l)
               (and (pred x) (loop (car l) (cdr l)))
               (pred x)))))
    ((pred . lists)
     (%need-procedure 'every 'pred pred)
     (or (%any-end? lists)
         (let loop ((ls lists))
           (let ((next (%cdrs ls)))
             (if (%any-end? next)
                 (apply pred (%cars ls))
                 (and (apply pred (%cars ls)) (loop next)))))))))
(define ormap any)
(define andmap every)

(define (count pred . lists)
  (%need-procedure 'count 'pred pred)
  (let loop ((ls lists) (n 0))
    (if (%any-end? ls)
        n
        (loop (%cdrs ls) (if (apply pred (%cars ls)) (+ n 1) n)))))

(define (list-index pred . lists)
  (%need-procedure 'list-index 'pred pred)
  (let loop ((ls lists) (i 0))
    (cond ((%any-end? ls) #f)
          ((apply pred (%cars ls)) i)
          (else (loop (%cdrs ls) (+ i 1))))))

(define (take-while pred list)
  (%need-procedure 'take-while 'pred pred)
  (let loop ((l list) (acc '()))
    (if (and (pair? l) (pred (car l)))
        (loop (cdr l) (cons (car l) acc))
        (reverse acc))))

(define (drop-while pred list)
  (%need-procedure 'drop-while 'pred pred)
  (let loop ((l list))
    (if (and (pair? l) (pred (car l))) (loop (cdr l)) l)))

(define (span pred list)
  (%need-procedure 'span 'pred pred)
  (let loop ((l list) (acc '()))
    (if (and (pair? l) (pred (car l)))
        (loop (cdr l) (cons (car l) acc))
        (values (reverse acc) l))))

(define (break pred list) (span (lambda (x) (not (pred x))) list))

(define member
  (case-lambda
    ((x list) (%member x list))
    ((x list same?)
     (%need-procedure 'member 'same? same?)
     (find-tail (lambda (y) (same? x y)) list))))

(define assoc
  (case-lambda
    ((key alist) (%assoc key alist))
    ((key alist same?)
     (%need-procedure 'assoc 'same? same?)
     (find (lambda (entry) (same? key (car entry))) alist))))

; ---- making ----

(define (list-tabulate n f)
  (%need-index 'list-tabulate 'n n)
  (%need-procedure 'list-tabulate 'f f)
  (let loop ((i 0) (acc '()))
    (if (< i n) (loop (+ i 1) (cons (f i) acc)) (reverse acc))))

(define (build-list n f)
  (%need-index 'build-list 'n n)
  (%need-procedure 'build-list 'f f)
  (list-tabulate n f))

(define (build-vector n f)
  (%need-index 'build-vector 'n n)
  (%need-procedure 'build-vector 'f f)
  (list->vector (list-tabulate n f)))

(define (build-string n f)
  (%need-index 'build-string 'n n)
  (%need-procedure 'build-string 'f f)
  (list->string (list-tabulate n f)))

; ---- sorting: stable, by merging runs of doubling length; n log n calls of less? ----

(define (%merge-run! less? from to lo mid hi)
  (let loop ((i lo) (j mid) (k lo))
    (if (< k hi)
        (if (and (< i mid) (or (>= j hi) (not (less? (vector-ref from j) (vector-ref from i)))))
            (begin (vector-set! to k (vector-ref from i)) (loop (+ i 1) j (+ k 1)))
            (begin (vector-set! to k (vector-ref from j)) (loop i (+ j 1) (+ k 1)))))))

(define (%sort-vector less? v)
  (let ((n (vector-length v)))
    (let passes ((width 1) (from (vector-copy v)) (to (make-vector n #f)))
      (if (>= width n)
          from
          (let runs ((lo 0))
            (if (< lo n)
                (begin
                  (%merge-run! less? from to lo (min n (+ lo width)) (min n (+ lo width width)))
                  (runs (+ lo width width)))
                (passes (* 2 width) to from)))))))

; (sort sequence less? [#:key key]): a new list of a list, a new vector of a vector
(define (sort sequence less? #:key [key any? #f])
  (%need-procedure 'sort 'less? less?)
  (let ((less? (if key (lambda (a b) (less? (key a) (key b))) less?)))
    (cond ((vector? sequence) (%sort-vector less? sequence))
          ((list? sequence) (vector->list (%sort-vector less? (list->vector sequence))))
          (else (error 'sort "sequence must be a list or a vector, got ~s" sequence)))))
(define (list-sort less? list) (sort list less?))

(define (vector-sort! v less?)
  (let ((sorted (sort v less?)))
    (let loop ((i 0))
      (if (< i (vector-length v))
          (begin (vector-set! v i (vector-ref sorted i)) (loop (+ i 1)))))))

(define (argmin f list) (%extreme 'argmin f list <))
(define (argmax f list) (%extreme 'argmax f list >))
(define (%extreme who f list better?)
  (%need-procedure who 'f f)
  (if (not (pair? list)) (error who "list must be a list of one element or more, got ~s" list))
  (let loop ((l (cdr list)) (best (car list)) (value (f (car list))))
    (if (pair? l)
        (let ((v (f (car l))))
          (if (better? v value) (loop (cdr l) (car l) v) (loop (cdr l) best value)))
        best)))

; ---- hash tables ----

; failure: what to answer where the key is missing; a procedure is called. Without it a missing key is an error.
(define %hash-missing (list 'missing))
(define hash-ref
  (case-lambda
    ((table key)
     (let ((v (%hash-get table key %hash-missing)))
       (if (eq? v %hash-missing)
           (error 'hash-ref "no such key: ~s" key)
           v)))
    ((table key failure)
     (let ((v (%hash-get table key %hash-missing)))
       (cond ((not (eq? v %hash-missing)) v)
             ((procedure? failure) (failure))
             (else failure))))))

(define (hash-ref! table key make)
  (let ((v (%hash-get table key %hash-missing)))
    (if (eq? v %hash-missing)
        (let ((new (if (procedure? make) (make) make)))
          (hash-set! table key new)
          new)
        v)))

(define hash-update!
  (case-lambda
    ((table key f) (hash-set! table key (f (hash-ref table key))))
    ((table key f failure) (hash-set! table key (f (hash-ref table key failure))))))

; The entries as they were when the walk began.
(define (hash-for-each table f)
  (%need-procedure 'hash-for-each 'f f)
  (for-each (lambda (entry) (f (car entry) (cdr entry))) (hash->list table)))

(define (hash-map table f)
  (%need-procedure 'hash-map 'f f)
  (map (lambda (entry) (f (car entry) (cdr entry))) (hash->list table)))

; ---- procedures on procedures ----

(define (identity x) x)
(define (const x) (lambda args x))
(define (negate f)
  (%need-procedure 'negate 'f f)
  (lambda args (not (apply f args))))

; (compose f g h): x -> (f (g (h x))); several values go through
(define (compose . fs)
  (for-each (lambda (f) (%need-procedure 'compose 'f f)) fs)
  (cond ((null? fs) values)
        ((null? (cdr fs)) (car fs))
        (else
         (let ((f (car fs)) (g (apply compose (cdr fs))))
           (lambda args (call-with-values (lambda () (apply g args)) f))))))

(define (curry f . first)
  (%need-procedure 'curry 'f f)
  (lambda rest (apply f (append first rest))))

; ---- ports ----

(define (call-with-port port f)
  (%need-procedure 'call-with-port 'f f)
  (call-with-values
   (lambda () (f port))
   (lambda results
     (close-port port)
     (apply values results))))

(define (call-with-input-file name f) (call-with-port (open-input-file name) f))
(define (call-with-output-file name f) (call-with-port (open-output-file name) f))

(define (with-input-from-file name thunk)
  (let ((port (open-input-file name)))
    (call-with-port port (lambda (p) (parameterize ((current-input-port p)) (thunk))))))

(define (with-output-to-file name thunk)
  (let ((port (open-output-file name)))
    (call-with-port port (lambda (p) (parameterize ((current-output-port p)) (thunk))))))

(define (call-with-output-string f)
  (%need-procedure 'call-with-output-string 'f f)
  (let ((port (open-output-string)))
    (f port)
    (get-output-string port)))

(define (with-output-to-string thunk)
  (%need-procedure 'with-output-to-string 'thunk thunk)
  (call-with-output-string (lambda (port) (parameterize ((current-output-port port)) (thunk)))))

; ---- escapes ----

(define (call-with-escape-continuation f) (call/cc f))
(define call/ec call-with-escape-continuation)

; ---- the ports that printing and reading use ----

(define current-input-port (%port-parameter 0))
(define current-output-port (%port-parameter 1))
(define current-error-port (%port-parameter 2))

; ---- numbers ----

; the simplest fraction of lo <= q <= hi, 0 < lo: by continued fractions
(define (%simplest lo hi)
  (let ((whole (floor lo)))
    (cond ((= whole lo) whole)
          ((< whole (floor hi)) (+ whole 1))
          (else (+ whole (/ 1 (%simplest (/ 1 (- hi whole)) (/ 1 (- lo whole)))))))))

(define (rationalize x y)
  (if (and (exact? x) (exact? y))
      (let ((lo (- x (abs y))) (hi (+ x (abs y))))
        (cond ((> lo 0) (%simplest lo hi))
              ((< hi 0) (- (%simplest (- hi) (- lo))))
              (else 0)))
      (cond ((or (nan? x) (nan? y)) +nan.0)
            ((infinite? y) (if (infinite? x) +nan.0 0.0))
            ((infinite? x) (inexact x))
            (else (inexact (rationalize (exact x) (exact y)))))))

(define (symbol<? a b . more)
  (apply string<? (symbol->string a) (symbol->string b) (map symbol->string more)))

; ---- complex numbers, of which there are the real ones: names of (scheme complex) ----

(define (real-part x) (%need-real 'real-part 'x x) x)
(define (imag-part x) (%need-real 'imag-part 'x x) 0)
(define (%angle x)
  (%need-real 'angle 'x x)
  (if (negative? x) pi (if (exact? x) 0 0.0)))
(define (make-rectangular x y)
  (%need-real 'make-rectangular 'x x)
  (if (and (number? y) (exact? y) (zero? y)) x (error 'make-rectangular "y must be 0, there are no complex numbers, got ~s" y)))
(define (make-polar r angle)
  (%need-real 'make-polar 'r r)
  (if (and (number? angle) (exact? angle) (zero? angle)) r (error 'make-polar "angle must be 0, there are no complex numbers, got ~s" angle)))
(define (%need-real who name x) (if (not (number? x)) (error who "~a must be a number, got ~s" name x)))

; ---- the rest of SRFI 1 ----

(define empty '())
(define (xcons a b) (cons b a))
(define (car+cdr pair) (values (car pair) (cdr pair)))
(define take! take)
(define drop-right! drop-right)
(define split-at! split-at)
(define take-while! take-while)
(define span! span)
(define break! break)
(define filter! filter)
(define remove! remove)
(define partition! partition)
(define delete! delete)
(define delete-duplicates! delete-duplicates)
(define append-map! append-map)
(define map! map)
(define map-in-order map)
(define (sublist list start end) (take (drop list start) (- end start)))

(define (circular-list . elements)
  (if (null? elements) (error 'circular-list "needs an element"))
  (let ((l (list-copy elements)))
    (set-cdr! (last-pair l) l)
    l))

; 'proper, 'dotted or 'circular; the hare goes two steps for the tortoise's one
(define (%list-shape x)
  (let loop ((hare x) (tortoise x))
    (cond ((null? hare) 'proper)
          ((not (pair? hare)) 'dotted)
          ((null? (cdr hare)) 'proper)
          ((not (pair? (cdr hare))) 'dotted)
          (else
           (let ((hare (cddr hare)) (tortoise (cdr tortoise)))
             (if (eq? hare tortoise)
                 (if (pair? hare) 'circular (if (null? hare) 'proper 'dotted))
                 (loop hare tortoise)))))))
(define (proper-list? x) (eq? (%list-shape x) 'proper))
(define (dotted-list? x) (eq? (%list-shape x) 'dotted))
(define (circular-list? x) (eq? (%list-shape x) 'circular))
(define (length+ x) (and (not (circular-list? x)) (let loop ((l x) (n 0)) (if (pair? l) (loop (cdr l) (+ n 1)) n))))
(define (not-pair? x) (not (pair? x)))
(define null-list? null?)

(define (list= same? . lists)
  (%need-procedure 'list= 'same? same?)
  (let next ((ls lists))
    (or (null? ls)
        (null? (cdr ls))
        (and (let loop ((a (car ls)) (b (cadr ls)))
               (cond ((null? a) (null? b))
                     ((null? b) #f)
                     (else (and (same? (car a) (car b)) (loop (cdr a) (cdr b))))))
             (next (cdr ls))))))

(define (concatenate lists) (apply append lists))
(define (append* first . more) (apply apply append first more))
(define (zip . lists) (apply map list lists))
(define (unzip1 lists) (map first lists))
(define (unzip2 lists) (values (map first lists) (map second lists)))
(define (unzip3 lists) (values (map first lists) (map second lists) (map third lists)))

(define (pair-fold f init list)
  (%need-procedure 'pair-fold 'f f)
  (let loop ((l list) (acc init))
    (if (pair? l)
        (let ((next (cdr l))) (loop next (f l acc)))
        acc)))
(define (pair-fold-right f init list)
  (%need-procedure 'pair-fold-right 'f f)
  (fold f init (pair-fold cons '() list)))
(define (pair-for-each f list)
  (%need-procedure 'pair-for-each 'f f)
  (let loop ((l list))
    (if (pair? l)
        (let ((next (cdr l))) (f l) (loop next)))))

(define (alist-cons key value alist) (cons (cons key value) alist))
(define (alist-copy alist) (map (lambda (entry) (if (pair? entry) (cons (car entry) (cdr entry)) entry)) alist))
(define (alist-delete key alist . same)
  (let ((same? (if (pair? same) (car same) equal?)))
    (remove (lambda (entry) (same? key (car entry))) alist)))
(define alist-delete! alist-delete)
(define %concatenate! concatenate)
(define (%unzip4 lists) (values (map first lists) (map second lists) (map third lists) (map fourth lists)))
(define (%unzip5 lists) (values (map first lists) (map second lists) (map third lists) (map fourth lists) (map fifth lists)))

(define (%in? same? x list) (any (lambda (y) (same? y x)) list))
(define (lset<= same? . lists)
  (let next ((ls lists))
    (or (null? ls)
        (null? (cdr ls))
        (and (every (lambda (x) (%in? same? x (cadr ls))) (car ls)) (next (cdr ls))))))
(define (lset= same? . lists)
  (and (apply lset<= same? lists) (apply lset<= same? (reverse lists))))
(define (lset-adjoin same? list . elements)
  (fold (lambda (x acc) (if (%in? same? x acc) acc (cons x acc))) list elements))
(define (lset-union same? . lists)
  (reduce (lambda (list acc)
            (if (null? acc) list (fold (lambda (x acc) (if (%in? same? x acc) acc (cons x acc))) acc list)))
          '() lists))
(define (lset-intersection same? list . others)
  (filter (lambda (x) (every (lambda (o) (%in? same? x o)) others)) list))
(define (lset-difference same? list . others)
  (filter (lambda (x) (not (any (lambda (o) (%in? same? x o)) others))) list))
(define (lset-xor same? . lists)
  (reduce (lambda (b a)
            (append (filter (lambda (x) (not (%in? same? x a))) b) (filter (lambda (x) (not (%in? same? x b))) a)))
          '() lists))

(define (%lset-diff+intersection same? list . others)
  (%need-procedure 'lset-diff+intersection 'same? same?)
  (partition (lambda (x) (not (any (lambda (o) (%in? same? x o)) others))) list))
(define %lset-union! lset-union)
(define %lset-intersection! lset-intersection)
(define %lset-difference! lset-difference)
(define %lset-xor! lset-xor)
(define %lset-diff+intersection! %lset-diff+intersection)

; ---- lists and vectors in PLT's and MIT's words ----

(define (remq x list) (delete x list eq?))
(define (remv x list) (delete x list eqv?))
(define delq remq)
(define (member? x list) (if (member x list) #t #f))
(define (index-of list x . same)
  (let ((same? (if (pair? same) (car same) equal?)))
    (list-index (lambda (y) (same? y x)) list)))
(define (indexes-of list x)
  (let loop ((l list) (i 0) (acc '()))
    (if (pair? l)
        (loop (cdr l) (+ i 1) (if (equal? (car l) x) (cons i acc) acc))
        (reverse acc))))
(define (list-update list i f)
  (%need-procedure 'list-update 'f f)
  (append (take list i) (cons (f (list-ref list i)) (drop list (+ i 1)))))
(define (list-set list i value) (list-update list i (lambda (old) value)))

; in random order (Fisher and Yates)
(define (shuffle list)
  (let ((v (list->vector list)))
    (let loop ((i (- (vector-length v) 1)))
      (if (> i 0)
          (let* ((j (random (+ i 1))) (x (vector-ref v i)))
            (vector-set! v i (vector-ref v j))
            (vector-set! v j x)
            (loop (- i 1)))
          (vector->list v)))))

(define (vector-sort v less?) (sort v less?))
(define (vector-head v end) (vector-copy v 0 end))
(define (vector-tail v start) (vector-copy v start))
(define (vector-grow v n)
  (let ((new (make-vector n)))
    (vector-copy! new 0 v)
    new))
(define (vector-count pred v)
  (%need-procedure 'vector-count 'pred pred)
  (let loop ((i 0) (n 0))
    (if (< i (vector-length v)) (loop (+ i 1) (if (pred (vector-ref v i)) (+ n 1) n)) n)))
(define (vector-index pred v)
  (%need-procedure 'vector-index 'pred pred)
  (let loop ((i 0))
    (and (< i (vector-length v)) (if (pred (vector-ref v i)) i (loop (+ i 1))))))
; (compare element key) is below, equal to or above 0
(define (vector-binary-search v key compare)
  (%need-procedure 'vector-binary-search 'compare compare)
  (let loop ((lo 0) (hi (vector-length v)))
    (and (< lo hi)
         (let* ((mid (quotient (+ lo hi) 2)) (order (compare (vector-ref v mid) key)))
           (cond ((zero? order) mid)
                 ((negative? order) (loop (+ mid 1) hi))
                 (else (loop lo mid)))))))

(define (string-search-forward text string start) (string-search string text start))
(define (string-search-all text string)
  (let loop ((from 0) (acc '()))
    (let ((i (and (<= from (string-length string)) (string-search string text from))))
      (if i (loop (+ i 1) (cons i acc)) (reverse acc)))))

; ---- hash tables in SRFI 69's words ----

; the equivalence: eq? and eqv? as they are, any other stands for equal?
(define (make-hash-table . equivalence)
  (if (and (pair? equivalence) (memq (car equivalence) (list eq? eqv? =))) (make-hasheqv) (make-hash)))
(define (alist->hash-table alist . equivalence)
  (let ((table (apply make-hash-table equivalence)))
    (for-each (lambda (entry) (if (not (hash-has-key? table (car entry))) (hash-set! table (car entry) (cdr entry)))) alist)
    table))
(define (hash-table-ref table key . failure)
  (if (and (pair? failure) (car failure)) (hash-ref table key (car failure)) (hash-ref table key)))
(define (hash-table-ref/default table key default) (%hash-get table key default))
(define (hash-table-update! table key f . failure)
  (hash-set! table key (f (apply hash-table-ref table key failure))))
(define (hash-table-update!/default table key f default)
  (hash-set! table key (f (%hash-get table key default))))
(define (hash-table-walk table f) (hash-for-each table f))
(define (hash-table-fold table f init)
  (%need-procedure 'hash-table-fold 'f f)
  (fold (lambda (entry acc) (f (car entry) (cdr entry) acc)) init (hash->list table)))

; ... of which these are seen only through (srfi 69), where `hash` is another procedure than here
(define (%hash x . bound) (if (pair? bound) (modulo (equal-hash x) (car bound)) (equal-hash x)))
(define %string-hash %hash)
(define (%string-ci-hash s . bound) (apply %hash (string-foldcase s) bound))
(define %hash-by-identity %hash)
(define (%hash-table-equivalence-function table) (if (%hash-eqv? table) eqv? equal?))
(define (%hash-table-hash-function table) %hash)
(define (%hash-table-merge! to from)
  (hash-for-each from (lambda (key value) (if (not (hash-has-key? to key)) (hash-set! to key value))))
  to)

; ---- small syntax of other Schemes ----

(define-syntax and-let*                     ; SRFI 2
  (syntax-rules ()
    ((_ ()) #t)
    ((_ () . body) (let () . body))
    ((_ ((name expression))) expression)
    ((_ ((expression))) expression)
    ((_ (name)) name)
    ((_ ((name expression) . more) . body) (let ((name expression)) (if name (and-let* more . body) #f)))
    ((_ ((expression) . more) . body) (if expression (and-let* more . body) #f))
    ((_ (name . more) . body) (if name (and-let* more . body) #f))))

; SRFI 26, seen as cut and cute where (srfi 26) is imported. In %cut-more: names of the slots so far, the parts of the call so far.
(define-syntax %cut (syntax-rules () ((_ . parts) (%cut-more () () . parts))))
(define-syntax %cut-more
  (syntax-rules (<> <...>)
    ((_ (slot ...) (f part ...)) (lambda (slot ...) ((begin f) part ...)))
    ((_ (slot ...) (f part ...) <...>) (lambda (slot ... . rest) (apply f part ... rest)))
    ((_ (slot ...) (part ...) <> . more) (%cut-more (slot ... x) (part ... x) . more))
    ((_ slots (part ...) expression . more) (%cut-more slots (part ... expression) . more))))
(define-syntax %cute (syntax-rules () ((_ . parts) (%cute-more () () () . parts))))
(define-syntax %cute-more
  (syntax-rules (<> <...>)
    ((_ kept (slot ...) (f part ...)) (let kept (lambda (slot ...) (f part ...))))
    ((_ kept (slot ...) (f part ...) <...>) (let kept (lambda (slot ... . rest) (apply f part ... rest))))
    ((_ kept (slot ...) (part ...) <> . more) (%cute-more kept (slot ... x) (part ... x) . more))
    ((_ (bound ...) slots (part ...) expression . more) (%cute-more (bound ... (x expression)) slots (part ... x) . more))))

(define-syntax begin0
  (syntax-rules ()
    ((_ first . body) (call-with-values (lambda () first) (lambda results (let () #f . body) (apply values results))))))
(define-syntax rec
  (syntax-rules ()
    ((_ (name . parameters) . body) (letrec ((name (lambda parameters . body))) name))
    ((_ name value) (letrec ((name value)) name))))
(define-syntax while
  (syntax-rules () ((_ test . body) (let loop () (if test (begin (let () #f . body) (loop)))))))
(define-syntax until
  (syntax-rules () ((_ test . body) (while (not test) . body))))
(define-syntax fluid-let
  (syntax-rules ()
    ((_ ((name value)) . body)
     (let ((new value) (old #f))
       (dynamic-wind
        (lambda () (set! old name) (set! name new))
        (lambda () . body)
        (lambda () (set! new name) (set! name old)))))
    ((_ () . body) (let () . body))
    ((_ (binding . more) . body) (fluid-let (binding) (fluid-let more . body)))))
