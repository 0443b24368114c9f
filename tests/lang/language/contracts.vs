; Contracts and keywords in parameter lists (thesis, Appendix A's typing predicates)
(load "../r7rs/lib/check.vs")

(define (message thunk)
  (guard (e ((error-object? e)
             (apply string-append (error-object-message e)
                    (map (lambda (i) (string-append " " (call-with-output-string (lambda (p) (write i p))))) (error-object-irritants e)))))
    (thunk)))

(define (natural? n) (and (exact-integer? n) (>= n 0)))

(define (area [w positive?] [h positive? 2]) (* w h))
(check (area 3) => 6)
(check (area 3 4) => 12)
(check-error (area -1))
(check-error (area 3 0))
(check-error (area 'a))
(check (string-contains? (message (lambda () (area -1))) "area") => #t)
(check (string-contains? (message (lambda () (area -1))) "w") => #t)
(check (string-contains? (message (lambda () (area -1))) "positive?") => #t)
(check (string-contains? (message (lambda () (area -1))) "-1") => #t)

; defaults see the parameters before them, and are evaluated at each call
(define (box [w number?] [d number? w] [h number? (+ w d)]) (list w d h))
(check (box 1) => (1 1 2))
(check (box 1 5) => (1 5 6))
(check (box 1 5 9) => (1 5 9))
(define calls 0)
(define (counted [x any? (begin (set! calls (+ calls 1)) calls)]) x)
(check (list (counted) (counted 'given) (counted)) => (1 given 2))

; keywords, in any order
(define (tower [p any?] #:height [h positive? 10] #:floors [n natural? 3]) (list p h n))
(check (tower 'a) => (a 10 3))
(check (tower 'a #:floors 5) => (a 10 5))
(check (tower 'a #:floors 5 #:height 2) => (a 2 5))
(check (tower #:height 2 'a) => (a 2 3))
(check-error (tower 'a #:height -1))
(check-error (tower 'a #:widht 1))
(check-error (tower 'a #:height 1 #:height 2))
(check-error (tower))
(define (must #:give [x number?]) x)
(check (must #:give 1) => 1)
(check-error (must))
(define (bare #:k [k any? 'none] . rest) (list k rest))
(check (bare 1 2) => (none (1 2)))
(check (bare 1 #:k 5 2) => (5 (1 2)))
(define f (lambda ([x number?] #:twice [t boolean? #f]) (if t (* 2 x) x)))
(check (f 4) => 4)
(check (f 4 #:twice #t) => 8)
(check (map (lambda ([x number?]) (+ x 1)) '(1 2)) => (2 3))

; the rest, and combinations
(define (total . [r (list-of number?)]) (apply + r))
(check (total) => 0)
(check (total 1 2 3) => 6)
(check-error (total 1 'b))
(define (ok [x (and integer? positive?)] [y (or string? symbol?) 'none]) (list x y))
(check (ok 1) => (1 none))
(check (ok 1 "s") => (1 "s"))
(check-error (ok 1.5))
(check-error (ok -1))
(check-error (ok 1 2))
(define (lists [l (list-of (list-of (and number? positive?)))]) (length l))
(check (lists '((1 2) () (3))) => 3)
(check-error (lists '((1 -2))))
(check-error (lists 5))

; a predicate that raises counts as false, one that is none is explained
(define (picky [x (lambda (v) (car v))]) 'fine)
(check (picky '(1)) => fine)
(check-error (picky 5))
(define ten 10)
(define (mistaken [n ten]) n)
(check (string-contains? (message (lambda () (mistaken 5))) "[n any? ten]") => #t)
(define (written) (eval '(lambda ([n 10]) n) (interaction-environment))) ; a constant is told where it stands
(check (string-contains? (message written) "a default follows a predicate") => #t)

; the predicate is the definition's, evaluated once
(define limit 10)
(define (below? n) (< n limit))
(define (small [n below?]) n)
(check (small 5) => 5)
(define (below? n) #f)
(check (small 5) => 5)

; PLT's spelling of plain optional arguments works through any?
(define (greet [name any? "you"]) (string-append "hello " name))
(check (greet) => "hello you")
(check (apply tower '(a)) => (a 10 3))

(checked)
; expect: all hold: 47
