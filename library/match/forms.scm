; The forms. After patterns.scm.

; Returns the number of pairs of a list, proper or not; -1 for a circular one.
(define (count-pairs l)
  (let loop ((l l) (behind l) (n 0))
    (cond ((not (pair? l)) n)
          ((not (pair? (cdr l))) (+ n 1))
          ((eq? (cdr l) behind) -1)
          (else (loop (cddr l) (cdr behind) (+ n 2))))))

(define (no-match x) (error "match: no pattern fits" x))

; (match value [pattern body ...] [pattern (=> next) body ...] ...): each clause is a procedure. The clause before it
; calls it after a failure, as does (next).
(define-syntax match
  (er-macro-transformer
    (lambda (form rename compare)
      (define e (make-expansion rename compare 0))
      (define (clause-code clause x fail)
        (if (not (and (list? clause) (pair? clause) (pair? (cdr clause)))) (refuse "a clause is [pattern body ...], not" clause))
        (match-code e (car clause) x '()
          (lambda (bound)
            (let ((body (cdr clause)))
              (if (and (list? (car body)) (= (length (car body)) 2) (word? e (caar body) '=>) (pair? (cdr body)))
                  `(,(rename 'let) ((,(cadar body) ,fail)) ,@(cdr body))
                  `(,(rename 'let) () ,@body))))
          fail))
      (if (not (and (list? form) (pair? (cdr form)))) (refuse "it is written (match value [pattern body ...] ...), not" form))
      (let ((x (fresh e "value")))
        `(,(rename 'let) ((,x ,(cadr form)))
          ,(let clauses ((left (cddr form)))
             (if (null? left)
                 `(,(rename 'no-match) ,x)
                 (let ((next (fresh e "next")))
                   `(,(rename 'let) ((,next (,(rename 'lambda) () ,(clauses (cdr left))))) ,(clause-code (car left) x next))))))))))

(define-syntax match-lambda (syntax-rules () ((_ clause ...) (lambda (x) (match x clause ...)))))
(define-syntax match-lambda* (syntax-rules () ((_ clause ...) (lambda arguments (match arguments clause ...)))))

(define-syntax match-let
  (syntax-rules ()
    ((_ ((pattern expression) ...) . body) (match (list expression ...) ((pattern ...) (let () . body))))
    ((_ loop ((pattern expression) ...) . body)
     ((letrec ((loop (match-lambda* ((pattern ...) (let () . body))))) loop) expression ...))))
(define-syntax match-let*
  (syntax-rules ()
    ((_ () . body) (let () . body))
    ((_ ((pattern expression) . more) . body) (match expression (pattern (match-let* more . body))))))

; The expressions see all names, as in letrec.
(define-syntax match-letrec
  (er-macro-transformer
    (lambda (form rename compare)
      (let* ((bindings (cadr form))
             (names (pattern-names (make-expansion rename compare 0) (map car bindings))))
        `(,(rename 'let) ()
          (,(rename 'define-values) ,names
           (,(rename 'match) (,(rename 'list) ,@(map cadr bindings)) (,(map car bindings) (,(rename 'values) ,@names))))
          (,(rename 'let) () ,@(cddr form)))))))
