; The type and its forms. A stream holds a promise of a cell: #f if it is empty, otherwise a pair of the promise of its
; first element and its rest, a stream.

(define-record-type stream-type (make-stream promise) stream? (promise stream-promise))
(define stream-null (make-stream (make-promise #f)))
(define (cell s)
  (if (not (stream? s)) (error "a stream is expected here, not" s))
  (force (stream-promise s)))
(define (cell-of who s)
  (let ((found (cell s)))
    (if (not found) (error (string-append who ": the stream is empty")))
    found))
(define (stream-pair? x) (and (stream? x) (cell x) #t))
(define (stream-null? x) (and (stream? x) (not (cell x))))
(define (stream-car s) (force (car (cell-of "stream-car" s))))
(define (stream-cdr s) (cdr (cell-of "stream-cdr" s)))

(define-syntax later (syntax-rules () ((_ expression) (make-stream (delay-force (promise-of expression))))))
(define (promise-of s)
  (if (not (stream? s)) (error "a stream is expected here, not" s))
  (stream-promise s))
(define-syntax stream-cons
  (syntax-rules () ((_ first rest) (make-stream (make-promise (cons (delay first) (later rest)))))))
(define-syntax stream-lambda (syntax-rules () ((_ formals . body) (lambda formals (later (let () . body))))))
(define-syntax define-stream (syntax-rules () ((_ (name . formals) . body) (define name (stream-lambda formals . body)))))
(define-syntax stream-let
  (syntax-rules ()
    ((_ loop ((name value) ...) . body) ((letrec ((loop (stream-lambda (name ...) . body))) loop) value ...))))
(define-syntax stream
  (syntax-rules ()
    ((_) stream-null)
    ((_ first . more) (stream-cons first (stream . more)))))

; (stream-match s (pattern [guard] expression) ...): a pattern is (), (a b ...), (a b . rest), a name or _.
(define-syntax stream-match
  (syntax-rules () ((_ expression clause ...) (let ((s expression)) (clauses-of s clause ...)))))
(define-syntax clauses-of
  (syntax-rules ()
    ((_ s) (error "stream-match: no pattern fits"))
    ((_ s (pattern guard value) . more)
     (let ((next (lambda () (clauses-of s . more)))) (fit s pattern (if guard value (next)) (next))))
    ((_ s (pattern value) . more)
     (let ((next (lambda () (clauses-of s . more)))) (fit s pattern value (next))))))
(define-syntax fit
  (syntax-rules (_)
    ((fit s () then otherwise) (if (stream-null? s) then otherwise))
    ((fit s (_ . more) then otherwise)
     (if (stream-pair? s) (let ((rest (stream-cdr s))) (fit rest more then otherwise)) otherwise))
    ((fit s (first . more) then otherwise)
     (if (stream-pair? s) (let ((first (stream-car s)) (rest (stream-cdr s))) (fit rest more then otherwise)) otherwise))
    ((fit s _ then otherwise) then)
    ((fit s name then otherwise) (let ((name s)) then))))

; (stream-of expression (name in stream) (name is value) condition ...)
(define-syntax stream-of (syntax-rules () ((_ expression . parts) (collect expression stream-null . parts))))
(define-syntax collect
  (syntax-rules (in is)
    ((_ expression tail) (stream-cons expression tail))
    ((_ expression tail (name in source) . parts)
     (stream-let each ((left source))
       (if (stream-null? left)
           tail
           (let ((name (stream-car left))) (collect expression (each (stream-cdr left)) . parts)))))
    ((_ expression tail (name is value) . parts) (let ((name value)) (collect expression tail . parts)))
    ((_ expression tail condition . parts) (if condition (collect expression tail . parts) tail))))
