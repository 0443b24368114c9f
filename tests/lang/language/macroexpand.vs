; macroexpand: the macros at a form's head, whatever makes them
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(define-syntax swap! (syntax-rules () ((_ a b) (let ((old a)) (set! a b) (set! b old)))))
(define-syntax twice (syntax-rules () ((_ e) (swap! e e))))
(define-syntax late (er-macro-transformer (lambda (form rename compare) (list (rename 'twice) (cadr form)))))
(show (macroexpand '(swap! x y)))        ; expect: (let ((old x)) (set! x y) (set! y old))
(show (macroexpand '(twice z)))          ; expect: (let ((old z)) (set! z z) (set! z old))
(show (macroexpand '(late z)))           ; expect: (let ((old z)) (set! z z) (set! z old))
(show (macroexpand '(car (swap! x y))))  ; expect: (car (swap! x y))
(show (macroexpand 5))                   ; expect: 5
(show (macroexpand '(lambda (x) x)))     ; expect: (lambda (x) x)
(macroexpand '(swap! x)) ; expect error: swap!
