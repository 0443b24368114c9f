; Makes wrong calls: reads the names that a program sees, one a line, and calls each procedure with arguments that hardly any
; takes: one to four of a kind, and none, and many. (The text names a file that no call can make.) The message of an error must begin with
; the name that was called. One line a test.

(define %page (interaction-environment))

; what calls its argument, reads the console, ends the program, or prints what it is given
(define %apart
  '(apply call-with-values make-parameter with-exception-handler call/cc call-with-current-continuation call-with-escape-continuation call/ec
    call-with-output-string with-output-to-string call-with-port
    error raise raise-continuable exit emergency-exit load eval unfold unfold-right
    read read-line read-char peek-char read-string read-u8 peek-u8 read-bytevector read-bytevector! char-ready? u8-ready?
    display displayln print write write-simple write-shared writeln write-string write-char write-u8 write-bytevector newline fresh-line pretty-print printf))

(define (%begins? name text)
  (let ((n (string-length name)))
    (and (> (string-length text) n) (string=? name (substring text 0 n)) (memv (string-ref text n) '(#\: #\space)) #t)))

; #f, or what the error said
(define (%said f arguments)
  (call/cc
    (lambda (leave)
      (with-exception-handler
        (lambda (e) (leave (if (error-object? e) (condition/report-string e) "something that is no error")))
        (lambda () (apply f arguments) #f)))))

(define (%circular) (let ((l (list 1 2))) (set-cdr! (cdr l) l) l))
(define (%kinds)                           ; fresh ones: some procedures change their arguments
  (list (%circular) (list (%circular)) (let ((l (list 1 2))) (set-car! l l) l) (eof-object) -1 1.5 "no such folder/x" #\a (cons 1 2) (list 'a 'b) (lambda any 1) (make-hash) (vector 1 2) (bytevector 1)))

(define (%wrong name f)
  (let ((bad '()))
    (define (try arguments)
      (let ((said (%said f arguments)))
        (if (and said (not (%begins? name said))) (set! bad (cons said bad)))))
    (for-each
      (lambda (n)
        (for-each (lambda (k) (try (make-list n (list-ref (%kinds) k)))) (iota (length (%kinds)))))
      '(1 2 3 4))
    (try '())
    (try (make-list 40 (eof-object)))
    (if (null? bad)
        (printf "ok manual/wrong:~a\n" name)
        (printf "not ok manual/wrong:~a\n    ~a\n" name (car bad)))))

(let loop ()
  (let ((name (read-line)))
    (if (not (eof-object? name))
        (let ((f (call/cc (lambda (leave) (with-exception-handler (lambda (e) (leave #f)) (lambda () (eval (string->symbol name) %page)))))))
          (if (and (procedure? f) (not (memq (string->symbol name) %apart))) (%wrong name f))
          (loop)))))
