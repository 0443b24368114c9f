; The forms of AutoLISP. nil is the empty list, and everything else counts as true. Scope is dynamic: a variable is a
; global of the program, and a function keeps the values that its parameters and locals had before.

(define t-value (quote :t))
(define :t t-value)
(define :nil '())
(define (truth b) (if b t-value '()))

; ---- variables that active functions keep: thunks that restore them, the innermost first ----

(define kept '())
(define (lisp:enter! restore) (set! kept (cons restore kept)))
(define (lisp:leave!)
  (let ((restore (car kept)))
    (set! kept (cdr kept))
    (restore)))
(define (leave-to! before)
  (if (not (eq? kept before)) (begin (lisp:leave!) (leave-to! before))))

; ---- functions ----

; (lisp:fn (a b / c) body ...): the procedure's own parameters are named as the variables, without the colon.
(define-syntax lisp:fn
  (er-macro-transformer
    (lambda (form rename compare)
      (define names (if (pair? (cadr form)) (cadr form) '()))
      (define (proper? l) (or (null? l) (and (pair? l) (symbol? (car l)) (proper? (cdr l)))))
      (define (before-slash l) (if (or (null? l) (eq? (car l) ':/)) '() (cons (car l) (before-slash (cdr l)))))
      (define (argument p) (rename (string->symbol (substring (symbol->string p) 1 (string-length (symbol->string p))))))
      (define (kept-as p) (rename (string->symbol (string-append "before" (symbol->string p)))))
      (define set (rename 'set!))
      (define body (cons (rename ':progn) (cddr form)))
      (define (whole parameters locals)
        (define all (append parameters locals))
        `(,(rename 'lambda) ,(map argument parameters)
           ,(if (null? all) body
                `(,(rename 'let) ,(map (lambda (p) (list (kept-as p) p)) all)
                   (,(rename 'lisp:enter!) (,(rename 'lambda) () ,@(map (lambda (p) (list set p (kept-as p))) all)))
                   ,@(map (lambda (p) (list set p (argument p))) parameters)
                   ,@(map (lambda (p) (list set p (rename ':nil))) locals)
                   (,(rename 'let) ((,(rename 'value) ,body)) (,(rename 'lisp:leave!)) ,(rename 'value))))))
      (cond ((not (or (eq? (cadr form) ':nil) (proper? names)))
             (list (rename 'syntax-error) "the parameters of a function are names"))
            ((memq ':/ names) => (lambda (rest) (whole (before-slash names) (cdr rest))))
            (else (whole names '()))))))

(define-syntax :lambda (syntax-rules () ((_ parameters . body) (lisp:fn parameters . body))
    ((_ . other) (syntax-error "lambda is written (lambda (a b / local) body ...)"))))
(define-syntax :defun (syntax-rules () ((_ f parameters . body) (define f (lisp:fn parameters . body)))
    ((_ . other) (syntax-error "defun is written (defun name (a b / local) body ...)"))))
(define-syntax lisp:defun
  (syntax-rules () ((_ f parameters . body) (begin (set! f (lisp:fn parameters . body)) (quote f)))
    ((_ . other) (syntax-error "defun is written (defun name (a b / local) body ...)"))))

; ---- quoted data: nil is the empty list there, too; a quoted lambda is the function ----

(define-syntax :quote (syntax-rules (:lambda) ((_ (:lambda . function)) (:lambda . function)) ((_ x) (lisp:data x))
    ((_ . other) (syntax-error "quote is written (quote datum)"))))
(define-syntax :function (syntax-rules () ((_ x) (:quote x))
    ((_ . other) (syntax-error "function is written (function f)"))))
(define-syntax lisp:data
  (er-macro-transformer
    (lambda (form rename compare)
      (define (plain x)
        (cond ((eq? x ':nil) '())
              ((pair? x) (cons (plain (car x)) (plain (cdr x))))
              (else x)))
      (list (rename 'quote) (plain (cadr form))))))

; ---- sequence, choice, repetition ----

(define-syntax :progn (syntax-rules () ((_) '()) ((_ . body) (begin . body))))
; (lisp:set! form name value): form is the form that the message names.
(define-syntax lisp:set!
  (er-macro-transformer
    (lambda (form rename compare)
      (if (symbol? (caddr form))
          (list (rename 'set!) (caddr form) (cadddr form))
          (list (rename 'syntax-error) (string-append (cadr form) " sets a variable, and what follows it is no name"))))))
(define-syntax :setq
  (syntax-rules ()
    ((_) '())
    ((_ x v) (let ((value v)) (lisp:set! "setq" x value) value))
    ((_ x v . more) (begin (:setq x v) (:setq . more)))
    ((_ . other) (syntax-error "setq is written (setq name value ...)"))))
(define-syntax :if
  (syntax-rules ()
    ((_ test then) (if (null? test) '() then))
    ((_ test then else) (if (null? test) else then))
    ((_ . other) (syntax-error "if is written (if test then else)"))))
(define-syntax :cond
  (syntax-rules ()
    ((_) '())
    ((_ (test) . more) (let ((value test)) (if (null? value) (:cond . more) value)))
    ((_ (test . body) . more) (if (null? test) (:cond . more) (:progn . body)))
    ((_ . other) (syntax-error "cond is written (cond (test value ...) ...)"))))
(define-syntax :and (syntax-rules () ((_) t-value) ((_ a . more) (if (null? a) '() (:and . more)))))
(define-syntax :or (syntax-rules () ((_) '()) ((_ a . more) (if (null? a) (:or . more) t-value))))
(define-syntax :while
  (syntax-rules ()
    ((_ test . body) (let loop ((value '())) (if (null? test) value (loop (:progn . body)))))
    ((_ . other) (syntax-error "while is written (while test body ...)"))))
(define-syntax :repeat
  (syntax-rules ()
    ((_ count . body)
     (let ((n (need-whole 'repeat count)))
       (let loop ((i 0) (value '())) (if (< i n) (loop (+ i 1) (:progn . body)) value))))
    ((_ . other) (syntax-error "repeat is written (repeat count body ...)"))))
(define-syntax :foreach
  (syntax-rules ()
    ((_ x items . body)
     (let ((all (need-list 'foreach items)) (old x))
       (lisp:enter! (lambda () (lisp:set! "foreach" x old)))
       (let loop ((l all) (value '()))
         (if (pair? l)
             (begin (lisp:set! "foreach" x (car l)) (loop (cdr l) (:progn . body)))
             (begin (lisp:leave!) value)))))
    ((_ . other) (syntax-error "foreach is written (foreach name list body ...)"))))

; ---- names at run time ----

; The names of forms have no value, but no variable may have them.
(define form-names '(:quote :function :lambda :defun :setq :if :cond :and :or :while :repeat :foreach :progn))
(define (bound? name)
  (or (memq name form-names) (guard (e (#t #f)) (eval name (interaction-environment)) #t)))
(define-syntax lisp:nil! (syntax-rules () ((_ name ...) (begin (define name '()) ...))))
(define (declare! names) (if (pair? names) (eval (cons 'lisp:nil! names) (interaction-environment))))
(define (declare-unbound! names) (declare! (filter (lambda (n) (not (bound? n))) names)))

; Makes the names variables of the program: nil, but the value that the name has in the language.
(define own (make-hasheq))
(define (own! name)
  (let ((value (if (bound? name) (eval name (interaction-environment)) '())))
    (declare! (list name))
    (hash-set! own name #t)
    (if (not (null? value)) ((eval (list 'lisp:setter name) (interaction-environment)) value))))
(define-syntax lisp:setter (syntax-rules () ((_ name) (lambda (value) (set! name value)))))
(define (declare-variables! assigned mentioned)
  (for-each (lambda (n) (if (not (or (memq n form-names) (hash-ref own n #f))) (own! n))) assigned)
  (declare-unbound! mentioned))
(define-syntax lisp:variables
  (syntax-rules () ((_ assigned mentioned) (declare-variables! 'assigned 'mentioned))))

; Returns the function that v is: a procedure, a name that is bound to one, or the data of a lambda.
(define (function-of who v)
  (cond ((procedure? v) v)
        ((memq v form-names) (refuse who "a function" v))
        ((and (symbol? v) (not (bound? v))) (error who "~a is not defined" (shown v)))
        ((symbol? v) (let ((f (eval v (interaction-environment)))) (if (procedure? f) f (refuse who "a function" v))))
        ((and (pair? v) (eq? (car v) ':lambda)) (:eval v))
        (else (refuse who "a function" v))))

; Data as a program: an empty list is nil there, and new names are variables.
(define (:eval v)
  (define (names v l)
    (cond ((pair? v) (names (cdr v) (names (car v) l))) ((symbol? v) (cons v l)) (else l)))
  (define (code v)
    (cond ((null? v) ':nil)
          ((not (pair? v)) v)
          ((eq? (car v) ':quote) v)
          (else (let loop ((v v)) (if (pair? v) (cons (code (car v)) (loop (cdr v))) v)))))
  (declare-unbound! (delete-duplicates (names v '())))
  (eval (code v) (interaction-environment)))
(define (:set name v)
  (if (not (symbol? name)) (refuse 'set "a name" name))
  (declare-unbound! (list name))
  ((eval (list 'lisp:setter name) (interaction-environment)) v)
  v)
(define (:boundp name) (truth (and (symbol? name) (bound? name) (not (memq name form-names)) (not (null? (eval name (interaction-environment)))))))
(define (:apply f l) (apply (function-of 'apply f) (need-list 'apply l)))
(define (:mapcar f . lists) (apply map (function-of 'mapcar f) (map (lambda (l) (need-list 'mapcar l)) lists)))

; ---- errors that a program catches ----

(define-record-type |%error of AutoLISP| (make-caught %text) caught? (%text caught-text))
(define (:vl-catch-all-apply f l)
  (let ((before kept))
    (guard (e (#t (leave-to! before) (make-caught (if (error-object? e) (condition/report-string e) "error"))))
      (:apply f l))))
(define (:vl-catch-all-error-p v) (truth (caught? v)))
(define (:vl-catch-all-error-message v) (if (caught? v) (caught-text v) (refuse 'vl-catch-all-error-message "an error" v)))
