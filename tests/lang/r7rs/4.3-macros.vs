; R7RS 4.3: macros, and hygiene beyond its examples
(load "lib/check.vs")

(check (let-syntax ((given-that (syntax-rules () ((_ test stmt1 stmt2 ...) (if test (begin stmt1 stmt2 ...))))))
         (let ((if #t)) (given-that if (set! if 'now)) if)) => now)
(check (let ((x 'outer)) (let-syntax ((m (syntax-rules () ((m) x)))) (let ((x 'inner)) (m)))) => outer)
(check (letrec-syntax
         ((my-or (syntax-rules () ((my-or) #f) ((my-or e) e) ((my-or e1 e2 ...) (let ((temp e1)) (if temp temp (my-or e2 ...)))))))
         (let ((x #f) (y 7) (temp 8) (let odd?) (if even?)) (my-or x (let temp) (if y) y))) => 7)
(define-syntax be-like-begin
  (syntax-rules () ((be-like-begin name) (define-syntax name (syntax-rules () ((name expr (... ...)) (begin expr (... ...))))))))
(be-like-begin sequence)
(check (sequence 1 2 3 4) => 4)
(check (let ((=> #f)) (cond (#t => 'ok))) => ok)
(check (let ((else #f)) (cond (#f 3) (else 4) (#t 5))) => 5)

(define-syntax swap! (syntax-rules () ((_ a b) (let ((tmp a)) (set! a b) (set! b tmp)))))
(check (let ((tmp 1) (other 2)) (swap! tmp other) (list tmp other)) => (2 1))

; nested ellipses
(define-syntax my-let* (syntax-rules () ((_ () body ...) (let () body ...)) ((_ ((x v) rest ...) body ...) (let ((x v)) (my-let* (rest ...) body ...)))))
(check (my-let* ((a 1) (b (+ a 1)) (c (* b 10))) (list a b c)) => (1 2 20))
(define-syntax flat (syntax-rules () ((_ (a b ...) ...) '(a ... (b ... ) ...))))
(check (flat (1 2 3) (4) (5 6)) => (1 4 5 (2 3) () (6)))
(define-syntax flatter (syntax-rules () ((_ (a ...) ...) '(a ... ...))))
(check (flatter (1 2) () (3)) => (1 2 3))
(define-syntax pairs (syntax-rules () ((_ (k v ...) ...) '((k (v k) ...) ...))))
(check (pairs (a 1 2) (b) (c 3)) => ((a (1 a) (2 a)) (b) (c (3 c))))

; tail patterns
(define-syntax last-of (syntax-rules () ((_ x ... y) 'y)))
(check (last-of 1 2 3) => 3)
(define-syntax middle (syntax-rules () ((_ a x ... b c) '(x ...))))
(check (middle 1 2 3 4 5) => (2 3))
(check (middle 1 2 3) => ())
(define-syntax dotted-tail (syntax-rules () ((_ x ... y . z) '((x ...) y z))))
(check (dotted-tail 1 2 3 . 4) => ((1 2) 3 4))
(define-syntax rest-of (syntax-rules () ((_ a . r) 'r)))
(check (rest-of 1 2 3) => (2 3))

; vector patterns
(define-syntax vec (syntax-rules () ((_ #(a b ...)) '(a (b ...)))))
(check (vec #(1 2 3)) => (1 (2 3)))
(define-syntax to-vec (syntax-rules () ((_ (a ...) ...) '#((a ...) ...))))
(check (to-vec (1) (2 3)) => #((1) (2 3)))

; literals
(define-syntax my-if (syntax-rules (then else) ((_ c then t else e) (if c t e)) ((_ c then t) (if c t 'none))))
(check (my-if #t then 1 else 2) => 1)
(check (my-if #f then 1) => none)
(define-syntax arrow (syntax-rules (=>) ((_ a => b) 'arrow) ((_ a b c) 'three)))
(check (arrow 1 => 2) => arrow)
(check (let ((=> 0)) (arrow 1 => 2)) => three)
(define-syntax under (syntax-rules () ((_ _ x _) 'x)))
(check (under 1 2 3) => 2)

; custom ellipsis
(define-syntax tail-list (syntax-rules ::: () ((_ a b :::) '(b ::: a ...))))
(check (tail-list 1 2 3) => (2 3 1 ...))
(define-syntax def-list (syntax-rules () ((_ name) (define-syntax name (syntax-rules ::: () ((_ x :::) (list x :::)))))))
(def-list my-list)
(check (my-list 1 2 3) => (1 2 3))
(define-syntax ell (syntax-rules () ((_ a) '(a (... ...)))))
(check (ell 1) => (1 ...))

; a macro that defines, and whose own names stay its own
(define-syntax def-getter (syntax-rules () ((_ name value) (begin (define hidden value) (define (name) hidden)))))
(def-getter get-a 1)
(def-getter get-b 2)
(check (list (get-a) (get-b)) => (1 2))
(check-error hidden)
(define-syntax def-public (syntax-rules () ((_ name value) (define name value))))
(def-public public 3)
(check public => 3)
(check (let () (def-public local 4) (+ local 1)) => 5)
(check (let () (def-getter g 8) (g)) => 8)

; keywords as ordinary variables
(check (let ((list (lambda args 'mine))) (list 1 2)) => mine)
(check (let ((if (lambda (a b c) (list a b c)))) (if 1 2 3)) => (1 2 3))
(check (let ((define 5)) (+ define 1)) => 6)
(check (let ((quote -)) '3) => -3)
(define (shadow cond) (cond 5))
(check (shadow (lambda (x) (* x x))) => 25)

; the definition's bindings are the macro's, whatever the place of use has
(define-syntax my-list2 (syntax-rules () ((_ x ...) (list x ...))))
(check (let ((list vector)) (my-list2 1 2)) => (1 2))
(define helper-value 10)
(define-syntax use-helper (syntax-rules () ((_) helper-value)))
(check (let ((helper-value 20)) (use-helper)) => 10)
(set! helper-value 11)
(check (use-helper) => 11)
(define-syntax my-while
  (syntax-rules () ((_ c body ...) (let loop () (when c body ... (loop))))))
(check (let ((i 0) (loop 5)) (my-while (< i 3) (set! i (+ i 1)) (set! loop (* loop 2))) (list i loop)) => (3 40))

; recursion through macros, and macros that expand to macros
(define-syntax reverse-args (syntax-rules () ((_ () (r ...)) '(r ...)) ((_ (a b ...) (r ...)) (reverse-args (b ...) (a r ...)))))
(check (reverse-args (1 2 3) ()) => (3 2 1))
(define-syntax count-args (syntax-rules () ((_) 0) ((_ x y ...) (+ 1 (count-args y ...)))))
(check (count-args a b c d) => 4)
(define-syntax jabberwocky
  (syntax-rules () ((_ hatter) (begin (define march-hare 42) (define-syntax hatter (syntax-rules () ((_) march-hare)))))))
(jabberwocky mad-hatter)
(check (mad-hatter) => 42)
(check (let-syntax ((foo (syntax-rules () ((_ x) (let-syntax ((bar (syntax-rules () ((_ y) (list x y))))) (bar 2)))))) (foo 1)) => (1 2))
(check (let loop ((i 0)) (define-syntax up (syntax-rules () ((_ x) (+ x 1)))) (if (< i 5) (loop (up i)) i)) => 5)

; syntax-rules that match strings, numbers, booleans
(define-syntax kind-of (syntax-rules () ((_ 1) 'one) ((_ "a") 'a) ((_ #t) 'true) ((_ #\c) 'c) ((_ x) 'other)))
(check (list (kind-of 1) (kind-of "a") (kind-of #t) (kind-of #\c) (kind-of 2)) => (one a true c other))

; explicit renaming
(define-syntax er-swap!
  (er-macro-transformer
   (lambda (form rename compare)
     (let ((a (cadr form)) (b (caddr form)))
       `(,(rename 'let) ((,(rename 'tmp) ,a)) (,(rename 'set!) ,a ,b) (,(rename 'set!) ,b ,(rename 'tmp)))))))
(check (let ((tmp 1) (y 2)) (er-swap! tmp y) (list tmp y)) => (2 1))
(define-syntax er-cond
  (er-macro-transformer
   (lambda (form rename compare)
     (if (compare (cadr form) (rename 'else)) ''is-else ''is-not))))
(check (er-cond else) => is-else)
(check (let ((else 1)) (er-cond else)) => is-not)
(define (transformer-helper x) (list 'quote x))
(define-syntax er-helped (er-macro-transformer (lambda (form rename compare) (transformer-helper (cdr form)))))
(check (er-helped a b) => (a b))
(check (let-syntax ((kons (er-macro-transformer (lambda (f r c) `(,(r 'cons) ,@(cdr f)))))) (let ((cons list)) (kons 1 2))) => (1 . 2))

(checked)
; expect: all hold: 51
