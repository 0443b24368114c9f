; Hygiene, second half of it: a template's free names mean what they meant where the macro was defined.
(load "../r7rs/lib/check.vs")

(define place 'global)
(define-syntax where (syntax-rules () ((_) place)))
(check (let ((place 'local)) (where)) => global)
(check ((lambda (place) (where)) 'local) => global)
(check (let () (define place 'inner) (where)) => global)
(check (let* ((place 1) (place 2)) (where)) => global)
(check (do ((place 0 (+ place 1))) ((= place 1) (where))) => global)
(check (let loop ((place 1)) (if (= place 0) (where) (loop 0))) => global)
(check (let-values (((place) (values 'two))) (where)) => global)
(check ((case-lambda ((place) (where))) 1) => global)
(define-syntax set-place! (syntax-rules () ((_ v) (set! place v))))
(check (let ((place 'local)) (set-place! 'changed) (list place (where))) => (local changed))
(define (place-of) (where))
(check (begin (set! place 'again) (place-of)) => again)

; a macro that is defined inside refers to what is inside
(check (let ((x 'outer)) (let-syntax ((m (syntax-rules () ((_) x)))) (let ((x 'inner)) (m)))) => outer)
(check (let ((x 1)) (define-syntax m (syntax-rules () ((_) x))) (let ((x 2)) (list x (m)))) => (2 1))
(check (let ((x 1)) (define-syntax m (syntax-rules () ((_ e) (let ((x 2)) (list x e))))) (m x)) => (2 1))
(check (let () (define-syntax m (syntax-rules () ((_) (later)))) (define (later) 'late) (m)) => late)
(check (let ((f 1))
         (letrec-syntax ((e? (syntax-rules () ((_) #t) ((_ a b ...) (o? b ...))))
                         (o? (syntax-rules () ((_) #f) ((_ a b ...) (e? b ...)))))
           (let ((o? 'mine)) (e? f f)))) => #t)
(check (let ((x 1))
         (let-syntax ((a (syntax-rules () ((_) x))))
           (let ((x 2))
             (let-syntax ((b (syntax-rules () ((_) (list x (a)))))) (let ((x 3)) (b)))))) => (2 1))
(check (let ((list vector))
         (let-syntax ((m (syntax-rules () ((_ a ...) (list a ...))))) (let ((list cons)) (m 1 2)))) => #(1 2))

; macros that make macros
(define-syntax make-constant (syntax-rules () ((_ name v) (define-syntax name (syntax-rules () ((_) v))))))
(define one 1)
(make-constant get-one one)
(check (let ((one 'local)) (get-one)) => 1)
(define-syntax define-getter (syntax-rules () ((_ name) (begin (define hidden 42) (define (name) hidden)))))
(define hidden 'mine)
(define-getter answer)
(check (answer) => 42)
(define-syntax twice-defined (syntax-rules () ((_ a b) (begin (define-getter a) (define-getter b)))))
(twice-defined answer-1 answer-2)
(check (list (answer-1) (answer-2)) => (42 42))
(define-syntax with-it (syntax-rules () ((_ it v e) (let ((it v)) e))))
(check (with-it x 3 (+ x 1)) => 4)                 ; a name that the use gives does bind
(check (let ((v 9)) (with-it it v (+ it v))) => 18)
(define-syntax my-let (syntax-rules () ((_ ((n v) ...) b ...) ((lambda (n ...) b ...) v ...))))
(check (let ((n 5)) (my-let ((v n) (b 2)) (list n v b))) => (5 5 2))
(define-syntax be-like-begin
  (syntax-rules () ((_ name) (define-syntax name (syntax-rules () ((_ e (... ...)) (begin e (... ...))))))))
(be-like-begin sequence)
(check (let ((begin list)) (sequence 1 2 3)) => 3)
(define-syntax tag-maker
  (syntax-rules () ((_ name tag) (define-syntax name (syntax-rules (tag) ((_ tag) 'tagged) ((_ x) 'other))))))
(tag-maker is-stop? stop)
(check (list (is-stop? stop) (is-stop? go)) => (tagged other))

; literals match by meaning, not by letters
(define-syntax arrow (syntax-rules (=>) ((_ => x) 'arrow) ((_ a x) 'something)))
(check (arrow => 1) => arrow)
(check (let ((=> 0)) (arrow => 1)) => something)
(define-syntax else? (syntax-rules (else) ((_ else) #t) ((_ x) #f)))
(check (list (else? else) (let ((else 1)) (else? else))) => (#t #f))
(check (let ((else #f)) (cond (else 'wrong) (#t 'right))) => right)
(check (let ((=> #f)) (cond (#t => 'right))) => right)
(check (let ((else 3)) (case 3 ((else) 'symbol) ((3) 'three))) => three)
(check (let ((unquote list)) `(1 (unquote 2))) => (1 (unquote 2)))
(define-syntax dots (syntax-rules (...) ((_ ...) 'dots) ((_ x) 'one)))
(check (list (dots ...) (dots 1)) => (dots one))
(define-syntax under (syntax-rules (_) ((under _) 'underscore) ((under x) 'other)))
(check (list (under _) (under 1)) => (underscore other))

; what a template defines at top level under a name of its own is nobody else's; under a name of the use, the program's
(define-syntax define-both (syntax-rules () ((_ mine v) (begin (define own v) (define (mine) own)))))
(define own 'program)
(define-both read-own 'macro)
(check (list own (read-own)) => (program macro))
(define-syntax define-counter
  (syntax-rules () ((_ next) (define next (let ((count 0)) (lambda () (set! count (+ count 1)) count))))))
(define count 'mine)
(define-counter next-1)
(check (list (next-1) (next-1) count) => (1 2 mine))

; explicit renaming: what is renamed is the definition's, what is not is the use's
(define-syntax er-or2
  (er-macro-transformer (lambda (form rename compare)
    (list (rename 'let) (list (list (rename 't) (cadr form)))
          (list (rename 'if) (rename 't) (rename 't) (caddr form))))))
(check (let ((t 5) (if list)) (er-or2 #f t)) => 5)
(define-syntax er-anaphoric
  (er-macro-transformer (lambda (form rename compare) (list (rename 'let) (list (list 'it (cadr form))) (caddr form)))))
(check (er-anaphoric 4 (* it it)) => 16)
(define-syntax er-else? (er-macro-transformer (lambda (form rename compare) (compare (cadr form) (rename 'else)))))
(check (list (er-else? else) (er-else? other) (let ((else 1)) (er-else? else))) => (#t #f #f))

; a program's own names, and the library's that it redefines
(define-syntax my-length (syntax-rules () ((_ l) (length l))))
(check (let ((length car)) (my-length '(7 8))) => 2)
(define (cadr x) 'redefined)
(define-syntax second-of (syntax-rules () ((_ l) (cadr l))))
(check (list (second-of '(1 2)) (let ((cadr car)) (second-of '(1 2)))) => (redefined redefined))
(check (list (second '(1 2)) (sort '((b 2) (a 1)) (lambda (x y) (symbol<? (car x) (car y))))) => (2 ((a 1) (b 2))))
(checked)   ; expect: all hold: 42
