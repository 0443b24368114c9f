; What crosses between programs in Scheme and scripts in JavaScript or GML. Each of those languages adds an opener, a procedure that gets a value
; of its own and returns the value of Scheme that it stands for, whose elements may be the language's still; else `unknown`.
(define-library (scripts)
  (export from-script opener! opened unknown walker procedure-shape)
  (import (visualscheme) (procedure shapes))
  (begin
    (define unknown (list 'unknown))
    (define openers '())
    (define (opener! f) (set! openers (cons f openers)))
    (define (opened v)
      (let loop ((l openers))
        (if (null? l) unknown (let ((o ((car l) v))) (if (eq? o unknown) (loop (cdr l)) o)))))

    ; (walk once) returns the procedure that converts one value; (once v make) is (make), made once for each v.
    (define (walker who walk)
      (let* ((seen (make-hasheq)) (open (list 'open)))
        (walk
          (lambda (v make)
            (let ((known (hash-ref seen v #f)))
              (cond ((eq? known open) (error who "the value contains itself"))
                    (known known)
                    (else
                     (hash-set! seen v open)
                     (let ((new (make))) (hash-set! seen v new) new))))))))

    (define (from-script v)
      (define (walk once)
        (define (convert v)
          (cond ((or (number? v) (string? v) (symbol? v) (boolean? v) (null? v)) v)
                ((pair? v) (if (list? v) (map convert v) (once v (lambda () (cons (convert (car v)) (convert (cdr v)))))))
                ((vector? v) (once v (lambda () (vector-map convert v))))
                ((hash-table? v)
                 (once v (lambda () (let ((t (hash-copy v))) (hash-for-each v (lambda (k x) (hash-set! t k (convert x)))) t))))
                (else (let ((o (opened v))) (if (eq? o unknown) v (once v (lambda () (convert o))))))))
        convert)
      ((walker 'from-script walk) v))))
