; A template that cannot be used is told where it stands, at the definition
(define (said form) (call/cc (lambda (k) (with-exception-handler (lambda (e) (k (error-object-message e))) (lambda () (eval form (interaction-environment)))))))
(displayln (said '(define-syntax bad (syntax-rules () ((_ a ...) (list a))))))   ; expect: a matches a sequence: an ellipsis must follow it in the template
(displayln (said '(define-syntax bad (syntax-rules () ((_ a) (list a ...))))))   ; expect: an ellipsis of the template follows nothing that repeats
(displayln (said '(define-syntax bad (syntax-rules () ((_ (a ...) ...) (list a ...))))))   ; expect: a matches a sequence: an ellipsis must follow it in the template
(displayln (said '(define-syntax bad (syntax-rules () ((_ a ...) (list (a ...) ...))))))   ; expect: an ellipsis of the template follows nothing that repeats
(displayln (said '(define-syntax bad (syntax-rules () ((_ a ...) #(a))))))   ; expect: a matches a sequence: an ellipsis must follow it in the template
(displayln (said '(define-syntax bad (syntax-rules () ((_ (a ...) ...) '#(a ...))))))   ; expect: a matches a sequence: an ellipsis must follow it in the template
(displayln (said '(define-syntax bad (syntax-rules () ((_ (a) ...) (list #(a ...) ...))))))   ; expect: an ellipsis of the template follows nothing that repeats
(displayln (said '(define-syntax bad (syntax-rules () ((_ a) #(a ...))))))   ; expect: an ellipsis of the template follows nothing that repeats
; those that are right stay right
(define-syntax pairs (syntax-rules () ((_ (a b ...) ...) '((a (b a) ...) ...))))
(displayln (pairs (1 2 3) (4)))                                         ; expect: ((1 (2 1) (3 1)) (4))
(define-syntax flat (syntax-rules () ((_ (a ...) ...) '(a ... ...))))
(displayln (flat (1 2) () (3)))                                         ; expect: (1 2 3)
(define-syntax twice (syntax-rules () ((_ (a ...) ...) '(((a ...) (a ...)) ...))))
(displayln (twice (1 2) (3)))                                           ; expect: (((1 2) (1 2)) ((3) (3)))
(define-syntax dots (syntax-rules () ((_ a ...) '(a ... (... ...)))))
(displayln (dots 1 2))                                                  ; expect: (1 2 ...)
(define-syntax vec (syntax-rules () ((_ a ...) '#(0 a ... 9))))
(displayln (vec 1 2))                                                   ; expect: #(0 1 2 9)
(define-syntax rows (syntax-rules () ((_ (a ...) ...) '#(#(a ...) ... 9 a ... ...))))
(displayln (rows (1 2) (3)))                                            ; expect: #(#(1 2) #(3) 9 1 2 3)
(define-syntax tail (syntax-rules () ((_ a ... . r) '(a ... . r))))
(displayln (tail 1 2))                                                  ; expect: (1 2)
(define-syntax be-like-begin (syntax-rules () ((_ name) (define-syntax name (syntax-rules () ((_ e (... ...)) (begin e (... ...))))))))
(be-like-begin sequence)
(displayln (sequence 1 2 3))                                            ; expect: 3
(define-syntax wrong (syntax-rules ()
  ((_ a)
   (list a
         a ...)))) ; expect error: an ellipsis of the template follows nothing that repeats
