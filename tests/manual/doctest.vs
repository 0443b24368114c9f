; Runs the manual's examples: (doctest place text kind expected) reads the forms of `text`, evaluates them one after another in
; the page's environment, and holds the last one to what the page says of it. One line a test, in the words of tests/run.sh.
;
;   value   `; => v`       its values, written, with a blank between them
;   prints  `; prints: t`  what it printed
;   error   `; error: t`   an error whose message contains t
;   runs                   a block that claims nothing has to run

(define %page (interaction-environment))

(define (%doctest-value thunk)
  (call-with-values thunk
    (lambda values (string-join (map (lambda (v) (call-with-output-string (lambda (port) (write v port)))) values) " "))))

; the forms of text, all but the last evaluated; the last one's thunk
(define (%doctest-last text)
  (let* ((port (open-input-string text)) (first (read port)))
    (if (eof-object? first) (error "an example without an expression"))
    (let loop ((form first))
      (let ((next (read port)))
        (cond ((eof-object? next) (lambda () (eval form %page)))
              (else (eval form %page) (loop next)))))))

(define (%doctest-said thunk)
  (call/cc
    (lambda (leave)
      (with-exception-handler
        (lambda (e)
          (leave (cons 'error (if (error-object? e) (condition/report-string e) (%doctest-value (lambda () e))))))
        (lambda () (cons 'value (thunk)))))))

(define (doctest place text kind expected)
  (let* ((said (%doctest-said
                 (lambda ()
                   (case kind
                     ((prints) (with-output-to-string (lambda () ((%doctest-last text)))))
                     (else (%doctest-value (lambda () ((%doctest-last text)))))))))
         (good? (case kind
                  ((error) (and (eq? (car said) 'error) (string-contains? (cdr said) expected)))
                  ((runs) (eq? (car said) 'value))
                  (else (and (eq? (car said) 'value) (string=? (cdr said) expected))))))
    (printf "~a manual/~a\n" (if good? "ok" "not ok") place)
    (if (not good?)
        (printf "    ~a\n    the manual says ~a: ~a\n    there was a~a: ~a\n" text kind expected
                (if (eq? (car said) 'error) "n error" " value") (cdr said)))))
