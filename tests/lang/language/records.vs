; What define-record-type makes runs without a frame of its own where nothing is wrong; nothing of it may be seen
(define (said thunk) (call/cc (lambda (k) (with-exception-handler (lambda (e) (k (if (error-object? e) (cons (error-object-message e) (error-object-irritants e)) e))) thunk))))
(define-syntax told (syntax-rules () ((_ e) (begin (write (said (lambda () e))) (newline)))))
(define-record-type spot (make-spot x y) spot? (x spot-x set-spot-x!) (y spot-y))
(define-record-type hub (make-hub y) hub? (x hub-x set-hub-x!) (y hub-y) (z hub-z set-hub-z!))
(define-record-type turned (make-turned y x) turned? (x turned-x) (y turned-y))
(define-record-type nothing (make-nothing) nothing?)
(define s (make-spot 1 2))
(define h (make-hub 7))
; plain calls, in the middle and at the end of a procedure
(define (x-of s) (spot-x s))
(define (copy s) (make-spot (spot-x s) (spot-y s)))
(define (is? s) (spot? s))
(define (put s v) (set-spot-x! s v))
(told (list (spot-x s) (spot-y s) (x-of s) (x-of (copy s)) (is? s) (is? h) (is? 5) (spot? (copy s)))) ; expect: (1 2 1 1 #t #f #f #t)
(told (begin (set-spot-x! s 5) (put s (+ 1 (spot-x s))) (spot-x s))) ; expect: 6
(told (list (hub-x h) (hub-y h) (hub-z h)))                  ; expect: (#f 7 #f)
(told (begin (set-hub-z! h (list s)) (eq? s (car (hub-z h))))) ; expect: #t
(told (let ((t (make-turned 1 2))) (list (turned-x t) (turned-y t)))) ; expect: (2 1)
(told (list (nothing? (make-nothing)) (eq? (make-nothing) (make-nothing)) (nothing? s))) ; expect: (#t #f #f)
(told (list (eq? (put s 1) (if #f #f)) (eq? (set-spot-x! s 1) (if #f #f)))) ; expect: (#t #t)
; as values: what calls procedures calls these
(told (map spot-x (list s (make-spot 'a 'b))))               ; expect: (1 a)
(told (map make-spot '() '()))                               ; expect: ()
(told (map spot-y (map make-spot '(1 2 3) '(4 5 6))))        ; expect: (4 5 6)
(told (apply spot-x (list s)))                               ; expect: 1
(told (spot-x (apply make-spot '(8 9))))                     ; expect: 8
(told (list (vector-map spot? (vector s h 1)) (call-with-values (lambda () (values 3 4)) (lambda (a b) (spot-y (make-spot a b)))))) ; expect: (#(#t #f #f) 4)
(told (spot-y (call-with-values (lambda () (values 3 4)) make-spot))) ; expect: 4
(told (sort (map spot-x (list (make-spot 3 0) (make-spot 1 0))) <)) ; expect: (1 3)
(told (dynamic-wind nothing? (lambda () 1) nothing?))        ; expect: ("nothing? needs 1 argument (record), got 0")
(told (with-exception-handler spot? (lambda () (raise-continuable s)))) ; expect: #t
(told (let ((get spot-x) (make make-spot)) (get (make 'in 'out)))) ; expect: in
(told ((if #t spot-y spot-x) s))                             ; expect: 2
; mistakes are told as before
(told (spot-x 5))                                            ; expect: ("spot-x: expected a spot, got" 5)
(told (spot-x h))                                            ; expect: ("spot-x: expected a spot, got" #<hub x=#f y=7 z=(#<spot x=1 y=2>)>)
(told (spot-y '()))                                          ; expect: ("spot-y: expected a spot, got" ())
(told (set-spot-x! h 1))                                     ; expect: ("set-spot-x!: expected a spot, got" #<hub x=#f y=7 z=(#<spot x=1 y=2>)>)
(told (map spot-x (list s h)))                               ; expect: ("spot-x: expected a spot, got" #<hub x=#f y=7 z=(#<spot x=1 y=2>)>)
(told (apply spot-x '()))                                    ; expect: ("spot-x needs 1 argument (record), got 0")
(told (spot-x))                                              ; expect: ("spot-x needs 1 argument (record), got 0")
(told (spot-x s s))                                          ; expect: ("spot-x needs 1 argument (record), got 2")
(told (make-spot 1))                                         ; expect: ("make-spot needs 2 arguments (x y), got 1")
(told (apply make-spot '(1 2 3)))                            ; expect: ("make-spot needs 2 arguments (x y), got 3")
(told (spot? ))                                              ; expect: ("spot? needs 1 argument (record), got 0")
(told (set-spot-x! s))                                       ; expect: ("set-spot-x! needs 2 arguments (record value), got 1")
(told (spot-x #:of s))                                       ; expect: ("spot-x has no keyword #:of")
; a name that is defined anew, or assigned, means what it means then
(define old-x spot-x)
(define (both s) (list (old-x s) (spot-x s)))
(told (both s))                                              ; expect: (1 1)
(set! spot-x (lambda (s) (list 'mine (spot-y s))))
(told (both s))                                              ; expect: (1 (mine 2))
(define spot-x old-x)
(told (both s))                                              ; expect: (1 1)
(define spot (list 'no 'type))
(told (spot-y s))                                            ; expect: ("spot-y: expected a record, got" #<spot x=1 y=2>)
(told (spot? s))                                             ; expect: #f
(told (make-spot 1 2))                                       ; expect: ("record: type must be a record type, got" (no type))
(define spot 5)
(told (spot-y s))                                            ; expect: ("spot-y: expected a record, got" #<spot x=1 y=2>)
(told (list (spot? s) (spot? 5)))                            ; expect: (#f #f)
; another type under the old type's name: its records may lack the field
(define spot nothing)
(define none (make-nothing))
(define (y-of r) (spot-y r))
(define (put-x r) (set-spot-x! r 12345678))
(told (y-of none))                                           ; expect: ("spot-y: expected a nothing with such a field, got" #<nothing>)
(told (put-x none))                                          ; expect: ("set-spot-x!: expected a nothing with such a field, got" #<nothing>)
(told (map spot-y (list none)))                              ; expect: ("spot-y: expected a nothing with such a field, got" #<nothing>)
(told (apply set-spot-x! (list none 1)))                     ; expect: ("set-spot-x!: expected a nothing with such a field, got" #<nothing>)
(define spot hub)
(told (spot-y h))                                            ; expect: 7
; types of a procedure's own: each call makes another
(define (family) (define-record-type own (make-own a) own? (a own-a set-own-a!)) (list make-own own? own-a set-own-a!))
(define one (family))
(define two (family))
(define mine ((car one) 'first))
(told (list ((cadr one) mine) ((cadr two) mine) ((caddr one) mine))) ; expect: (#t #f first)
(told (begin ((cadddr one) mine 'second) ((caddr one) mine))) ; expect: second
(told ((caddr two) mine))                                    ; expect: ("own-a: expected a own, got" #<own a=second>)
(told (let () (define-record-type point (make-point x) point? (x x-of)) (define p (make-point 4)) (list (x-of p) (point? p) (point? s)))) ; expect: (4 #t #f)
(told (let () (define before (make-late 1)) (define-record-type late (make-late x) late? (x late-x)) before)) ; expect: ("make-late is used before it has a value")
; a continuation that comes back into a map has the elements of its own time
(define-record-type cell (make-cell v) cell? (v cell-v set-cell-v!))
(define again #f)
(define count 0)
(define seen '())
(let ((l (map (lambda (c) (if (and (not again) (= (cell-v c) 2)) (call/cc (lambda (k) (set! again k)))) (cell-v c)) (map make-cell '(1 2 3)))))
  (set! seen (cons l seen))
  (set! count (+ count 1))
  (if (< count 3) (again count)))
(told seen)                                                  ; expect: ((1 2 3) (1 2 3) (1 2 3))
; a store into an old record of what is new, and many records
(define keep (make-cell #f))
(define (fill n) (do ((i 0 (+ i 1)) (l '() (cons (make-cell i) l))) ((= i n) (set-cell-v! keep l))))
(fill 200000)
(define sum 0)
(told (begin (for-each (lambda (c) (set! sum (+ sum (cell-v c)))) (cell-v keep)) (list sum (length (cell-v keep))))) ; expect: (19999900000 200000)
