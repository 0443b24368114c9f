; Tests predicates made of predicates: and, or, not and list-of in contracts at any depth, their procedures, and what is said of a procedure as a test.
(define-syntax refused
  (syntax-rules () ((_ e) (displayln (guard (c (#t (error-object-message c))) e 'taken)))))

(define (faces [l (list-of (list-of (and positive? integer?)))]) l)
(displayln (faces '((1 2) ()))) ; expect: ((1 2) ())
(refused (faces '((1 -2)))) ; expect: faces: l must be (list-of (list-of (and positive? integer?))), got
(refused (faces '((1 2.5)))) ; expect: faces: l must be (list-of (list-of (and positive? integer?))), got
(refused (faces '(1))) ; expect: faces: l must be (list-of (list-of (and positive? integer?))), got

(define (size [x (or symbol? (and number? (not negative?) (or integer? (list-of string?))))]) x)
(displayln (list (size 'large) (size 3))) ; expect: (large 3)
(refused (size -3)) ; expect: size: x must be (or symbol? (and number? (not negative?) (or integer? (list-of string?)))), got
(refused (size 1/2)) ; expect: size: x must be (or symbol? (and number? (not negative?) (or integer? (list-of string?)))), got

(define natural? (and-of integer? positive?))
(displayln (map natural? '(1 -1 1/2 "a"))) ; expect: (#t #f #f #f)
(displayln (map (or-of integer? string?) '(1 "a" a))) ; expect: (#t #t #f)
(displayln (map (not-of (list-of natural?)) '((1 2) (0) x))) ; expect: (#f #t #t)
(refused (and-of integer? 3)) ; expect: and-of: a predicate must be a procedure of one argument, got 3
(define (door [n natural?]) n)
(displayln (door 2)) ; expect: 2

; three deep, in a keyword, in the rest, in a primitive of the program's own
(define (deep [l (list-of (list-of (list-of (and integer? (or positive? zero?)))))]) l)
(displayln (deep '(((1 0)) ()))) ; expect: (((1 0)) ())
(refused (deep '(((1 -2))))) ; expect: deep: l must be (list-of (list-of (list-of (and integer? (or positive? zero?))))), got
(define keyed (lambda (#:k [k (list-of (or (and integer? positive?) string?)) '()]) k))
(displayln (keyed #:k '(1 "a"))) ; expect: (1 a)
(refused (keyed #:k '(-1))) ; expect: keyed: k must be (list-of (or (and integer? positive?) string?)), got
(define (all . [r (list-of (list-of (or integer? string?)))]) r)
(refused (all '(1 "a") '(a))) ; expect: all: r must be (list-of (list-of (or integer? string?))), got
(define-primitive (slab [w (and number? (not (or negative? zero?)))]) (make-sphere origin w))
(refused (slab 0)) ; expect: slab: w must be (and number? (not (or negative? zero?))), got

; a program's own and is its own
(define (own)
  (define (not p) number?)
  (define (f [x (not string?)]) x)
  (f 1))
(displayln (own)) ; expect: 1

(define wrong? (and integer? positive?)) ; expect warning: integer? is a procedure, which counts as true
(define also-wrong? (list-of (or integer? string?))) ; expect warning: integer? is a procedure, which counts as true
(define (even-natural? x) (and (natural? x) (even? x)))
(if even-natural? 1 2) ; expect warning: even-natural? is a procedure, which counts as true
(cond [(lambda (x) x) 1]) ; expect warning: this lambda is a procedure, which counts as true
(define third? (or (list-of string?) number?)) ; expect warning: (list-of ...) gives a procedure, which counts as true
; a variable may hold a procedure or #f
(define hook #f)
(if hook (hook))
(define (twice f) (if f (f (f 1)) 0))
(displayln (twice #f)) ; expect: 0
; expect no other warnings
