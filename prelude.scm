; The language's own library, in Scheme: every standard procedure that calls a procedure argument, so that call/cc,
; errors, limits and interrupts work through all of them. No geometry. Compiled into the binary when it is built.
;
; Names that begin with % are hidden from programs. Procedures without procedure arguments are C (vm/). Lists are walked
; from left to right, and results are built without mutation; therefore a continuation captured in the middle may be
; re-entered any number of times.

; ---- syntax ----
; Syntax and procedures that need no C: rules over the core syntax of vm/front/forms.def and the % procedures of
; vm/library/control.c.

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
    ((_ ((formals expression) . more) . body) (%call-with-values-of expression formals (let*-values more . body)))
    ((_ . other) (syntax-error "let*-values is written (let*-values (((name ...) expression) ...) body ...)"))))

; The formals of a clause get fresh names first, so no expression sees a name that another clause binds.
(define-syntax let-values
  (syntax-rules ()
    ((_ (((name) expression) ...) . body) (let ((name expression) ...) . body))
    ((_ ((formals expression)) . body) (%call-with-values-of expression formals . body))
    ((_ ((formals expression) ...) . body) (%let-values ((formals expression) ...) () . body))
    ((_ . other) (syntax-error "let-values is written (let-values (((name ...) expression) ...) body ...)"))))
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
; Returns the values as a box of one pair, from which they are taken one by one.
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

; Checks wait for the end of the program (vm/machine/check_queue.c).
(define-syntax check-expect
  (syntax-rules ()
    ((_ expression value) (%check-later 'check-expect 'expression (lambda () expression) (lambda () value)))
    ((_ . other) (syntax-error "check-expect is written (check-expect expression value)"))))
(define-syntax check-within
  (syntax-rules ()
    ((_ expression value tolerance)
     (%check-later 'check-within 'expression (lambda () expression) (lambda () value) (lambda () tolerance)))
    ((_ . other) (syntax-error "check-within is written (check-within expression value tolerance)"))))
(define-syntax check-error
  (syntax-rules ()
    ((_ expression) (%check-later 'check-error 'expression (lambda () expression)))
    ((_ expression text) (%check-later 'check-error 'expression (lambda () expression) (lambda () text)))
    ((_ . other) (syntax-error "check-error is written (check-error expression \"text\")"))))

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
    ((_ x (predicate value ...) clause ...) (if (predicate x) (begin value ...) (%case* x clause ...)))
    ((_ x other . more) (syntax-error "a clause of case* is [predicate value ...] or [predicate => procedure], not" other))))

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
    ((_ again (test value ...) clause ...) (if test (begin value ...) (%guard-clauses again clause ...)))
    ((_ again other . more) (syntax-error "a clause of guard is (test value ...), not" other))))

; ---- for: parallel clauses (name sequence); for*: nested ones; #:when guards the clauses after it ----
; A sequence is a list, a vector, a string, a hash table, a number (0 to n - 1), or (in-range a b step), (in-list l),
; (in-vector v) ... In for, all names advance together; in for*, every clause is a separate loop.
(define-syntax for (syntax-rules () ((_ clauses . body) (begin (%for-each clauses (let () . body)) (if #f #f)))))
(define-syntax for* (syntax-rules () ((_ clauses . body) (begin (%for-each* clauses (let () . body)) (if #f #f)))))
(define-syntax for/list
  (syntax-rules () ((_ clauses . body) (let ((found '()) (captures (%captures))) (%for-each clauses (set! found (cons (let () . body) found))) (%reverse-own found captures)))))
(define-syntax for*/list
  (syntax-rules () ((_ clauses . body) (let ((found '()) (captures (%captures))) (%for-each* clauses (set! found (cons (let () . body) found))) (%reverse-own found captures)))))
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
    ((_ ((name start)) (clause ...) . body) (let ((name start)) (%for-each (clause ...) (set! name (let () . body))) name))
    ((_ ((name start) ...) (clause ...) . body)
     (let ((name start) ...) (%for-each (clause ...) (%set-values (name ...) (let () . body))) (values name ...)))
    ((_ . other) (syntax-error "for/fold is written (for/fold ([total start]) ([name sequence] ...) new-total), as in (for/fold ([sum 0]) ([i 5]) (+ sum i)); not" (for/fold . other)))))
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
    ((_ (clause . more) action) (%for-one clause (%for-each* more action)))
    ((_ . other) (%for-written))))
(define-syntax %for-written
  (syntax-rules ()
    ((_) (syntax-error "a loop is written (for ([name sequence] ...) body ...), as in (for ([i 10]) ...) and (for ([i (in-range 2 10)]) ...), with #:when test between its clauses where wanted"))))
(define-syntax %for-each
  (syntax-rules ()
    ((_ () action) action)
    ((_ (#:when test . more) action) (if test (%for-each more action)))
    ((_ (#:unless test . more) action) (if test #f (%for-each more action)))
    ((_ (clause #:when . more) action) (%for-one clause (%for-each (#:when . more) action)))
    ((_ (clause #:unless . more) action) (%for-one clause (%for-each (#:unless . more) action)))
    ((_ (clause) action) (%for-one clause action))
    ((_ (clause . more) action) (%for-together (clause . more) () action))
    ((_ . other) (%for-written))))
; one name: the ranges make no list
(define-syntax %for-one
  (syntax-rules (in-range in-list in-naturals)
    ((_ (name (in-range end)) action) (let ((to end)) (do ((i 0 (+ i 1))) ((>= i to)) (let ((name i)) action))))
    ((_ (name (in-range start end)) action) (let ((from start) (to end)) (do ((i from (+ i 1))) ((>= i to)) (let ((name i)) action))))
    ((_ (name (in-range start end step)) action)
     (let ((from start) (to end) (by step))
       (do ((i from (+ i by))) ((if (< by 0) (<= i to) (>= i to))) (let ((name i)) action))))
    ((_ (name (in-naturals)) action) (do ((i 0 (+ i 1))) (#f) (let ((name i)) action)))
    ((_ (name (in-naturals start)) action) (do ((i (%natural start) (+ i 1))) (#f) (let ((name i)) action)))
    ((_ ((name ...) sequence) action) (let next ((l (%sequence sequence))) (if (pair? l) (begin (apply (lambda (name ...) action) (car l)) (next (cdr l))))))
    ((_ (name sequence) action) (let next ((l (%sequence sequence))) (if (pair? l) (begin (let ((name (car l))) action) (next (cdr l))))))
    ((_ . other) (%for-written))))
; several names: lists, until the shortest ends; a #:when after some of them guards the rest
(define-syntax %for-together
  (syntax-rules ()
    ((_ () ((name sequence l) ...) action)
     (let next ((l (%sequence-beside sequence)) ...)
       (if (and (%more? l) ...) (begin (let ((name (%next-of l)) ...) action) (next (%after l) ...)))))
    ((_ (#:when . more) done action) (%for-together () done (%for-each (#:when . more) action)))
    ((_ (#:unless . more) done action) (%for-together () done (%for-each (#:unless . more) action)))
    ((_ ((name sequence) . more) (done ...) action) (%for-together more (done ... (name sequence l)) action))
    ((_ . other) (%for-written))))
; (in-naturals) beside another sequence counts on; alone it needs no list
(define-syntax %sequence-beside
  (syntax-rules (in-naturals)
    ((_ (in-naturals)) 0)
    ((_ (in-naturals start)) (%natural start))
    ((_ sequence) (%sequence sequence))))
(define (%natural n) (if (and (exact-integer? n) (>= n 0)) n (error 'in-naturals "start must be an exact integer, 0 or more, got ~s" n)))
(define-syntax %more? (syntax-rules () ((_ l) (if (pair? l) #t (exact-integer? l)))))
(define-syntax %next-of (syntax-rules () ((_ l) (if (pair? l) (car l) l))))
(define-syntax %after (syntax-rules () ((_ l) (if (pair? l) (cdr l) (+ l 1)))))
(define (in-range start . more)
  (let* ((from (if (pair? more) start 0))
         (to (if (pair? more) (car more) start))
         (by (if (and (pair? more) (pair? (cdr more))) (cadr more) 1)))
    (if (not (and (real? from) (real? to) (real? by) (not (zero? by))))
        (error 'in-range "start, end and step must be numbers, the step not 0, got ~s" (cons start more)))
    (let next ((i from) (found '()))
      (if (if (< by 0) (<= i to) (>= i to)) (reverse found) (next (+ i by) (cons i found))))))
(define (in-list l) (%need-list 'in-list l) l)
(define (in-vector v) (%need-vector 'in-vector v) (vector->list v))
(define (in-string s) (%need-string 'in-string s) (string->list s))
(define (in-hash h) (%need-table 'in-hash h) (map (lambda (p) (list (car p) (cdr p))) (hash->list h)))
(define (in-naturals . start) (error "in-naturals: it is only a sequence of a clause: (for ((i (in-naturals))) ...)"))
(define (%sequence s)
  (cond ((pair? s) s)
        ((null? s) s)
        ((vector? s) (vector->list s))
        ((string? s) (string->list s))
        ((and (exact-integer? s) (>= s 0)) (iota s))
        ((bytevector? s) (let next ((i (- (bytevector-length s) 1)) (l '())) (if (< i 0) l (next (- i 1) (cons (bytevector-u8-ref s i) l)))))
        ((hash? s) (in-hash s))
        (else (error "for: expected a list, a vector, a string, a hash table or a count, got" s))))

; ---- predicates made from predicates. In parameter lists and, or and not mean the first three. A predicate that raises
; counts as false. ----
(define (%holds? p x) (call-with-current-continuation (lambda (k) (with-exception-handler (lambda (e) (k #f)) (lambda () (p x))))))
(define (%need-predicates who ps)
  (for-each (lambda (p) (if (not (procedure? p)) (error who "a predicate must be a procedure of one argument, got ~s" p))) ps))
(define (list-of p)
  (%need-predicates 'list-of (list p))
  (lambda (l) (and (list? l) (let next ((l l)) (or (null? l) (and (p (car l)) (next (cdr l))))))))
(define (and-of . ps)
  (%need-predicates 'and-of ps)
  (lambda (x) (let next ((ps ps)) (or (null? ps) (and (%holds? (car ps) x) (next (cdr ps)))))))
(define (or-of . ps)
  (%need-predicates 'or-of ps)
  (lambda (x) (let next ((ps ps)) (and (pair? ps) (or (%holds? (car ps) x) (next (cdr ps)))))))
(define (not-of p)
  (%need-predicates 'not-of (list p))
  (lambda (x) (not (%holds? p x))))

; ---- macros by renaming ----
(define (%expand-by-renaming transformer form home use)
  (let ((table (list '())))
    (transformer form (lambda (id) (%rename table home id)) (lambda (a b) (%same-identifier? use a b)))))

; ---- checks: the same messages as C's ----

(define (%need-procedure who name f)
  (if (not (procedure? f)) (error who "~a must be a procedure, got ~s" name f)))

; Checks the end `rest` of a walk over `whole`: a proper list ends in ().
(define (%need-end who whole rest)
  (if (not (null? rest)) (error who "expected a list, got ~s" whole)))

(define (%need-vector who v) (if (not (vector? v)) (error who "expected a vector, got ~s" v)))
(define (%need-string who s) (if (not (string? s)) (error who "expected a string, got ~s" s)))
(define (%need-table who t) (if (not (hash? t)) (error who "expected a hash table, got ~s" t)))

(define (%need-index who name n)
  (if (not (and (exact-integer? n) (>= n 0))) (error who "~a must be an exact integer from 0 on, got ~s" name n)))

; ---- several lists: the shortest ends the walk ----

(define (%any-end? lists)
  (let loop ((ls lists))
    (and (pair? ls) (or (not (pair? (car ls))) (loop (cdr ls))))))

(define (%cars lists)
  (let loop ((ls lists) (acc '()))
    (if (pair? ls) (loop (cdr ls) (cons (car (car ls)) acc)) (reverse acc))))

(define (%cdrs lists)
  (let loop ((ls lists) (acc '()))
    (if (pair? ls) (loop (cdr ls) (cons (cdr (car ls)) acc)) (reverse acc))))

; Returns the cars, with `last` at the end.
(define (%cars+ lists last) (append (%cars lists) (list last)))

; ---- mapping ----

(define map
  (case-lambda
    ((f list)
     (if (not (%each? f list)) (begin (%need-procedure 'map 'f f) (%need-list 'map list)))
     (%map-each f list))
    ((f list1 list2)
     (%need-procedure 'map 'f f)
     (%need-lists 'map (list list1 list2))
     (let loop ((a list1) (b list2) (acc '()))
       (if (and (pair? a) (pair? b))
           (loop (cdr a) (cdr b) (cons (f (car a) (car b)) acc))
           (reverse acc))))
    ((f list1 list2 . lists)
     (%need-procedure 'map 'f f)
     (let ((lists (cons* list1 list2 lists)))
       (%need-lists 'map lists)
       (let loop ((ls lists) (acc '()))
         (if (%any-end? ls)
             (reverse acc)
             (loop (%cdrs ls) (cons (apply f (%cars ls)) acc))))))))

(define for-each
  (case-lambda
    ((f list)
     (if (not (%each? f list)) (begin (%need-procedure 'for-each 'f f) (%need-list 'for-each list)))
     (%do-each f list))
    ((f list1 list2)
     (%need-procedure 'for-each 'f f)
     (%need-lists 'for-each (list list1 list2))
     (let loop ((a list1) (b list2))
       (if (and (pair? a) (pair? b))
           (begin (f (car a) (car b)) (loop (cdr a) (cdr b))))))
    ((f list1 list2 . lists)
     (%need-procedure 'for-each 'f f)
     (let ((lists (cons* list1 list2 lists)))
       (%need-lists 'for-each lists)
       (let loop ((ls lists))
         (if (not (%any-end? ls))
             (begin (apply f (%cars ls)) (loop (%cdrs ls)))))))))

(define append-map
  (case-lambda
    ((f list)
     (%need-procedure 'append-map 'f f)
     (%need-list 'append-map list)
     (let loop ((l list) (acc '()))
       (if (pair? l)
           (let ((more (f (car l))))
             (%need-list 'append-map more)
             (loop (cdr l) (append-reverse more acc)))
           (reverse acc))))
    ((f list . lists)
     (%need-procedure 'append-map 'f f)
     (let ((lists (cons list lists)))
       (%need-lists 'append-map lists)
       (let loop ((ls lists) (acc '()))
         (if (%any-end? ls)
             (reverse acc)
             (let ((more (apply f (%cars ls))))
               (%need-list 'append-map more)
               (loop (%cdrs ls) (append-reverse more acc)))))))))

(define (filter-map f list . lists)
  (%need-procedure 'filter-map 'f f)
  (let ((lists (cons list lists)))
    (%need-lists 'filter-map lists)
    (let loop ((ls lists) (acc '()))
      (if (%any-end? ls)
          (reverse acc)
          (let ((v (apply f (%cars ls))))
            (loop (%cdrs ls) (if v (cons v acc) acc)))))))

(define (vector-map f vector . vectors)
  (%need-procedure 'vector-map 'f f)
  (%need-vector 'vector-map vector)
  (if (null? vectors)
      (let ((n (vector-length vector)))
        (let loop ((i 0) (acc '()))
          (if (< i n)
              (loop (+ i 1) (cons (f (vector-ref vector i)) acc))
              (list->vector (reverse acc)))))
      (list->vector (apply map f (vector->list vector) (%as-lists 'vector-map %need-vector vector->list vectors)))))

(define (vector-for-each f vector . vectors)
  (%need-procedure 'vector-for-each 'f f)
  (%need-vector 'vector-for-each vector)
  (if (null? vectors)
      (let ((n (vector-length vector)))
        (let loop ((i 0))
          (if (< i n)
              (begin (f (vector-ref vector i)) (loop (+ i 1))))))
      (apply for-each f (vector->list vector) (%as-lists 'vector-for-each %need-vector vector->list vectors))))

(define (string-map f string . strings)
  (%need-procedure 'string-map 'f f)
  (%need-string 'string-map string)
  (let loop ((ls (cons (string->list string) (%as-lists 'string-map %need-string string->list strings))) (acc '()))
    (if (%any-end? ls)
        (list->string (reverse acc))
        (let ((c (apply f (%cars ls))))
          (if (not (char? c)) (error 'string-map "f must give characters, got ~s" c))
          (loop (%cdrs ls) (cons c acc))))))

(define (string-for-each f string . strings)
  (%need-procedure 'string-for-each 'f f)
  (%need-string 'string-for-each string)
  (apply for-each f (string->list string) (%as-lists 'string-for-each %need-string string->list strings)))

(define (%as-lists who need ->list sequences)
  (let loop ((l sequences) (acc '()))
    (if (pair? l)
        (begin (need who (car l)) (loop (cdr l) (cons (->list (car l)) acc)))
        (reverse acc))))

(define (string-count s pred)
  (%need-string 'string-count s)
  (%need-procedure 'string-count 'pred pred)
  (count pred (string->list s)))

; Returns the index of the first character that equals `what` (a character) or satisfies it, or #f.
(define (string-index s what)
  (%need-string 'string-index s)
  (let ((n (string-length s))
        (hit? (if (char? what) (lambda (c) (char=? c what)) what)))
    (if (not (procedure? hit?)) (error 'string-index "what must be a character or a procedure, got ~s" what))
    (let loop ((i 0))
      (and (< i n)
           (if (hit? (string-ref s i)) i (loop (+ i 1)))))))

; ---- folding ----

; SRFI 1: (f element accumulated); with several lists (f e1 e2 ... accumulated).
(define fold
  (case-lambda
    ((f init list)
     (%need-procedure 'fold 'f f)
     (%need-list 'fold list)
     (let loop ((l list) (acc init))
       (if (pair? l) (loop (cdr l) (f (car l) acc)) acc)))
    ((f init list . lists)
     (%need-procedure 'fold 'f f)
     (let ((lists (cons list lists)))
       (%need-lists 'fold lists)
       (let loop ((ls lists) (acc init))
         (if (%any-end? ls)
             acc
             (loop (%cdrs ls) (apply f (%cars+ ls acc)))))))))

(define fold-right
  (case-lambda
    ((f init list)
     (%need-procedure 'fold-right 'f f)
     (%need-list 'fold-right list)
     (let loop ((l (reverse list)) (acc init))
       (if (pair? l) (loop (cdr l) (f (car l) acc)) acc)))
    ((f init list . lists)
     (%need-procedure 'fold-right 'f f)
     (let ((lists (cons list lists)))
       (%need-lists 'fold-right lists)
       (let loop ((rows (let rows ((ls lists) (acc '())) (if (%any-end? ls) acc (rows (%cdrs ls) (cons (%cars ls) acc))))) (acc init))
         (if (pair? rows)
             (loop (cdr rows) (apply f (append (car rows) (cons acc '()))))
             acc))))))

; PLT's names, with their arguments in the same order.
(define foldl (%renamed fold 'foldl))
(define foldr (%renamed fold-right 'foldr))

(define (reduce f identity list)
  (%need-procedure 'reduce 'f f)
  (%need-list 'reduce list)
  (if (null? list) identity (fold f (car list) (cdr list))))

(define (reduce-right f identity list)
  (%need-procedure 'reduce-right 'f f)
  (%need-list 'reduce-right list)
  (if (null? list)
      identity
      (let ((r (reverse list)))
        (fold f (car r) (cdr r)))))

; SRFI 1: (unfold stop? mapper successor seed [tail-gen]); the thesis calls it with the first four.
(define unfold
  (case-lambda
    ((stop? mapper successor seed) (unfold stop? mapper successor seed (lambda (x) '())))
    ((stop? mapper successor seed tail-gen)
     (%need-procedure 'unfold 'stop? stop?)
     (%need-procedure 'unfold 'mapper mapper)
     (%need-procedure 'unfold 'successor successor)
     (%need-procedure 'unfold 'tail-gen tail-gen)
     (let loop ((seed seed) (acc '()))
       (if (stop? seed)
           (append-reverse acc (tail-gen seed))
           (loop (successor seed) (cons (mapper seed) acc)))))))

(define unfold-right
  (case-lambda
    ((stop? mapper successor seed) (unfold-right stop? mapper successor seed '()))
    ((stop? mapper successor seed tail)
     (%need-procedure 'unfold-right 'stop? stop?)
     (%need-procedure 'unfold-right 'mapper mapper)
     (%need-procedure 'unfold-right 'successor successor)
     (let loop ((seed seed) (acc tail))
       (if (stop? seed)
           acc
           (loop (successor seed) (cons (mapper seed) acc)))))))

; ---- choosing ----

(define (filter pred list)
  (%need-procedure 'filter 'pred pred)
  (%need-list 'filter list)
  (let loop ((l list) (acc '()))
    (if (pair? l)
        (loop (cdr l) (if (pred (car l)) (cons (car l) acc) acc))
        (reverse acc))))

(define (remove pred list)
  (%need-procedure 'remove 'pred pred)
  (%need-list 'remove list)
  (let loop ((l list) (acc '()))
    (if (pair? l)
        (loop (cdr l) (if (pred (car l)) acc (cons (car l) acc)))
        (reverse acc))))

(define (partition pred list)
  (%need-procedure 'partition 'pred pred)
  (%need-list 'partition list)
  (let loop ((l list) (in '()) (out '()))
    (cond ((not (pair? l)) (values (reverse in) (reverse out)))
          ((pred (car l)) (loop (cdr l) (cons (car l) in) out))
          (else (loop (cdr l) in (cons (car l) out))))))

(define delete
  (case-lambda
    ((x list) (%need-list 'delete list) (%delete x list equal?))
    ((x list same?)
     (%need-list 'delete list)
     (%need-procedure 'delete 'same? same?)
     (%delete x list same?))))
(define (%delete x list same?)
  (let loop ((l list) (acc '()))
    (if (pair? l)
        (loop (cdr l) (if (same? x (car l)) acc (cons (car l) acc)))
        (reverse acc))))

; Keeps the first of equal elements. With equal? it takes linear time.
(define delete-duplicates
  (case-lambda
    ((list)
     (%need-list 'delete-duplicates list)
     (let ((seen (make-hash)))
       (filter (lambda (x) (if (%hash-get seen x #f) #f (begin (hash-set! seen x #t) #t))) list)))
    ((list same?)
     (%need-list 'delete-duplicates list)
     (%need-procedure 'delete-duplicates 'same? same?)
     (let loop ((l list) (acc '()))
       (if (pair? l)
           (loop (cdr l)
                 (if (let in? ((a acc)) (and (pair? a) (or (same? (car a) (car l)) (in? (cdr a)))))
                     acc
                     (cons (car l) acc)))
           (reverse acc))))))
(define remove-duplicates (%renamed delete-duplicates 'remove-duplicates))

; ---- searching: a circular list never ends, so a search tests for one now and then ----
(define-syntax %turn
  (syntax-rules () ((_ who turn l ...) (if (> turn 0) (- turn 1) (begin (%need-turn who (list l ...)) 100000)))))

(define (find pred list)
  (%need-procedure 'find 'pred pred)
  (let loop ((l list) (turn 1000))
    (cond ((pair? l) (if (pred (car l)) (car l) (loop (cdr l) (%turn 'find turn l))))
          (else (%need-end 'find list l) #f))))

(define (find-tail pred list)
  (%need-procedure 'find-tail 'pred pred)
  (let loop ((l list) (turn 1000))
    (cond ((pair? l) (if (pred (car l)) l (loop (cdr l) (%turn 'find-tail turn l))))
          (else (%need-end 'find-tail list l) #f))))

; Both end in a tail call of pred on the last elements, as SRFI 1 requires.
(define any
  (case-lambda
    ((pred list)
     (%need-procedure 'any 'pred pred)
     (if (pair? list)
         (let loop ((x (car list)) (l (cdr list)) (turn 1000))
           (if (pair? l)
               (or (pred x) (loop (car l) (cdr l) (%turn 'any turn l)))
               (begin (%need-end 'any list l) (pred x))))
         (begin (%need-end 'any list list) #f)))
    ((pred list . lists)
     (%need-procedure 'any 'pred pred)
     (let ((lists (cons list lists)))
       (%need-lists 'any lists)
       (and (not (%any-end? lists))
            (let loop ((ls lists))
              (let ((next (%cdrs ls)))
                (if (%any-end? next)
                    (apply pred (%cars ls))
                    (or (apply pred (%cars ls)) (loop next))))))))))

(define every
  (case-lambda
    ((pred list)
     (%need-procedure 'every 'pred pred)
     (if (pair? list)
         (let loop ((x (car list)) (l (cdr list)) (turn 1000))
           (if (pair? l)
               (and (pred x) (loop (car l) (cdr l) (%turn 'every turn l)))
               (begin (%need-end 'every list l) (pred x))))
         (begin (%need-end 'every list list) #t)))
    ((pred list . lists)
     (%need-procedure 'every 'pred pred)
     (let ((lists (cons list lists)))
       (%need-lists 'every lists)
       (or (%any-end? lists)
           (let loop ((ls lists))
             (let ((next (%cdrs ls)))
               (if (%any-end? next)
                   (apply pred (%cars ls))
                   (and (apply pred (%cars ls)) (loop next))))))))))
(define ormap (%renamed any 'ormap))
(define andmap (%renamed every 'andmap))

(define (count pred list . lists)
  (%need-procedure 'count 'pred pred)
  (let ((lists (cons list lists)))
    (%need-lists 'count lists)
    (let loop ((ls lists) (n 0))
      (if (%any-end? ls)
          n
          (loop (%cdrs ls) (if (apply pred (%cars ls)) (+ n 1) n))))))

(define list-index
  (case-lambda
    ((pred list)
     (%need-procedure 'list-index 'pred pred)
     (let loop ((l list) (i 0) (turn 1000))
       (cond ((pair? l) (if (pred (car l)) i (loop (cdr l) (+ i 1) (%turn 'list-index turn l))))
             (else (%need-end 'list-index list l) #f))))
    ((pred list . lists)
     (%need-procedure 'list-index 'pred pred)
     (let ((lists (cons list lists)))
       (%need-lists 'list-index lists)
       (let loop ((ls lists) (i 0))
         (cond ((%any-end? ls) #f)
               ((apply pred (%cars ls)) i)
               (else (loop (%cdrs ls) (+ i 1)))))))))

(define (take-while pred list)
  (%need-procedure 'take-while 'pred pred)
  (let loop ((l list) (acc '()) (turn 1000))
    (cond ((not (pair? l)) (%need-end 'take-while list l) (reverse acc))
          ((pred (car l)) (loop (cdr l) (cons (car l) acc) (%turn 'take-while turn l)))
          (else (reverse acc)))))

(define (drop-while pred list)
  (%need-procedure 'drop-while 'pred pred)
  (let loop ((l list) (turn 1000))
    (cond ((not (pair? l)) (%need-end 'drop-while list l) l)
          ((pred (car l)) (loop (cdr l) (%turn 'drop-while turn l)))
          (else l))))

(define (span pred list)
  (%need-procedure 'span 'pred pred)
  (%span 'span pred #t list))
; without arguments it stops the program and opens the prompt
(define break
  (case-lambda
    (() (%break))
    ((pred list)
     (%need-procedure 'break 'pred pred)
     (%span 'break pred #f list))))
; Splits the list before its first element for which pred is false (yes? #t) or true (yes? #f).
(define (%span who pred yes? list)
  (let loop ((l list) (acc '()) (turn 1000))
    (cond ((not (pair? l)) (%need-end who list l) (values (reverse acc) l))
          ((eq? yes? (if (pred (car l)) #t #f)) (loop (cdr l) (cons (car l) acc) (%turn who turn l)))
          (else (values (reverse acc) l)))))

(define member
  (case-lambda
    ((x list) (%member x list))
    ((x list same?)
     (%need-procedure 'member 'same? same?)
     (let loop ((l list) (turn 1000))
       (cond ((pair? l) (if (same? x (car l)) l (loop (cdr l) (%turn 'member turn l))))
             (else (%need-end 'member list l) #f))))))

(define assoc
  (case-lambda
    ((key alist) (%assoc key alist))
    ((key alist same?)
     (%need-procedure 'assoc 'same? same?)
     (let loop ((l alist) (turn 1000))
       (cond ((not (pair? l)) (%need-end 'assoc alist l) #f)
             ((not (pair? (car l))) (error 'assoc "alist must be a list of pairs, got ~s" alist))
             ((same? key (car (car l))) (car l))
             (else (loop (cdr l) (%turn 'assoc turn l))))))))

; ---- making ----

(define (list-tabulate n f)
  (%need-index 'list-tabulate 'n n)
  (%need-procedure 'list-tabulate 'f f)
  (let loop ((i 0) (acc '()))
    (if (< i n) (loop (+ i 1) (cons (f i) acc)) (reverse acc))))

(define build-list (%renamed list-tabulate 'build-list))

(define (build-vector n f)
  (%need-index 'build-vector 'n n)
  (%need-procedure 'build-vector 'f f)
  (list->vector (list-tabulate n f)))

(define (build-string n f)
  (%need-index 'build-string 'n n)
  (%need-procedure 'build-string 'f f)
  (list->string (list-tabulate n (lambda (i) (let ((c (f i))) (if (char? c) c (error 'build-string "f must give characters, got ~s" c)))))))

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

; (sort sequence less? [#:key key]): returns a new list for a list, a new vector for a vector.
(define (sort sequence less? #:key [key any? #f])
  (%need-procedure 'sort 'less? less?)
  (let ((less? (if key (lambda (a b) (less? (key a) (key b))) less?)))
    (cond ((vector? sequence) (%sort-vector less? sequence))
          ((list? sequence) (vector->list (%sort-vector less? (list->vector sequence))))
          (else (error 'sort "sequence must be a list or a vector, got ~s" sequence)))))
(define (list-sort less? list)
  (%need-procedure 'list-sort 'less? less?)
  (%need-list 'list-sort list)
  (sort list less?))

(define (vector-sort! v less?)
  (%need-vector 'vector-sort! v)
  (%need-procedure 'vector-sort! 'less? less?)
  (let ((sorted (sort v less?)))
    (let loop ((i 0))
      (if (< i (vector-length v))
          (begin (vector-set! v i (vector-ref sorted i)) (loop (+ i 1)))))))

(define (argmin f list) (%extreme 'argmin f list <))
(define (argmax f list) (%extreme 'argmax f list >))
(define (%extreme who f list better?)
  (%need-procedure who 'f f)
  (if (not (pair? list)) (error who "list must be a list of one element or more, got ~s" list))
  (%need-list who list)
  (let loop ((l (cdr list)) (best (car list)) (value (f (car list))))
    (if (pair? l)
        (let ((v (f (car l))))
          (if (better? v value) (loop (cdr l) (car l) v) (loop (cdr l) best value)))
        best)))

; ---- hash tables ----

; failure: the result for a missing key; a procedure is called. Without it a missing key is an error.
(define %hash-missing (list 'missing))
(define hash-ref
  (case-lambda
    ((table key)
     (%need-table 'hash-ref table)
     (let ((v (%hash-get table key %hash-missing)))
       (if (eq? v %hash-missing)
           (error 'hash-ref "no such key: ~s" key)
           v)))
    ((table key failure)
     (%need-table 'hash-ref table)
     (let ((v (%hash-get table key %hash-missing)))
       (cond ((not (eq? v %hash-missing)) v)
             ((procedure? failure) (failure))
             (else failure))))))

(define (hash-ref! table key make)
  (%need-table 'hash-ref! table)
  (let ((v (%hash-get table key %hash-missing)))
    (if (eq? v %hash-missing)
        (let ((new (if (procedure? make) (make) make)))
          (hash-set! table key new)
          new)
        v)))

(define hash-update!
  (case-lambda
    ((table key f)
     (%need-table 'hash-update! table)
     (%need-procedure 'hash-update! 'f f)
     (let ((v (%hash-get table key %hash-missing)))
       (if (eq? v %hash-missing) (error 'hash-update! "no such key: ~s" key))
       (hash-set! table key (f v))))
    ((table key f failure)
     (%need-table 'hash-update! table)
     (%need-procedure 'hash-update! 'f f)
     (hash-set! table key (f (hash-ref table key failure))))))

; Visits the entries that exist at its begin.
(define (hash-for-each table f)
  (%need-table 'hash-for-each table)
  (%need-procedure 'hash-for-each 'f f)
  (for-each (lambda (entry) (f (car entry) (cdr entry))) (hash->list table)))

(define (hash-map table f)
  (%need-table 'hash-map table)
  (%need-procedure 'hash-map 'f f)
  (map (lambda (entry) (f (car entry) (cdr entry))) (hash->list table)))

; ---- procedures on procedures ----

(define (identity x) x)
(define (const x) (lambda args x))
(define (negate f)
  (%need-procedure 'negate 'f f)
  (lambda args (not (apply f args))))

; (compose f g h): x -> (f (g (h x))); passes several values on.
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
  (if (not (port? port)) (error 'call-with-port "expected a port, got ~s" port))
  (%need-procedure 'call-with-port 'f f)
  (call-with-values
   (lambda () (f port))
   (lambda results
     (close-port port)
     (apply values results))))

(define (call-with-input-file name f)
  (%need-string 'call-with-input-file name)
  (%need-procedure 'call-with-input-file 'f f)
  (call-with-port (open-input-file name) f))
(define (call-with-output-file name f)
  (%need-string 'call-with-output-file name)
  (%need-procedure 'call-with-output-file 'f f)
  (call-with-port (open-output-file name) f))

(define (with-input-from-file name thunk)
  (%need-string 'with-input-from-file name)
  (%need-procedure 'with-input-from-file 'thunk thunk)
  (let ((port (open-input-file name)))
    (call-with-port port (lambda (p) (parameterize ((current-input-port p)) (thunk))))))

(define (with-output-to-file name thunk)
  (%need-string 'with-output-to-file name)
  (%need-procedure 'with-output-to-file 'thunk thunk)
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

(define (call-with-escape-continuation f)
  (%need-procedure 'call-with-escape-continuation 'f f)
  (call/cc f))
(define call/ec (%renamed call-with-escape-continuation 'call/ec))

; ---- the ports that printing and reading use ----

(define current-input-port (%port-parameter 0))
(define current-output-port (%port-parameter 1))
(define current-error-port (%port-parameter 2))

; ---- numbers ----

; Returns the simplest fraction q with lo <= q <= hi, 0 < lo: by continued fractions.
(define (%simplest lo hi)
  (let ((whole (floor lo)))
    (cond ((= whole lo) whole)
          ((< whole (floor hi)) (+ whole 1))
          (else (+ whole (/ 1 (%simplest (/ 1 (- hi whole)) (/ 1 (- lo whole)))))))))

(define (rationalize x y)
  (if (not (and (number? x) (number? y))) (error 'rationalize "x and y must be numbers, got ~s" (if (number? x) y x)))
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
  (for-each (lambda (x) (if (not (symbol? x)) (error 'symbol<? "expected a symbol, got ~s" x))) (cons* a b more))
  (apply string<? (symbol->string a) (symbol->string b) (map symbol->string more)))

; ---- complex numbers, of which only real ones exist: names of (scheme complex) ----

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
