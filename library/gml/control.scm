; Control: conditions, loops, exits and exceptions. After collections.scm.

(define (need-procedure who v)
  (if (not (or (block? v) (procedure? v) (outside? v))) (refuse who "an operand must be a procedure { ... }" v)))

(operator! (exec p) (execute p))
(operator! (if condition p) (need-procedure 'if p) (if (true? condition) (execute p)))
(operator! (ifelse condition p q) (need-procedure 'ifelse p) (need-procedure 'ifelse q)
  (execute (if (true? condition) p q)))
(operator (ifpop a b condition) (if (true? condition) b a))

; ---- loops: exit leaves the innermost ----

(define leave #f) ; the continuation after the innermost loop

(define (with-exit who p turns)
  (need-procedure who p)
  (let ((outer leave))
    (call-with-current-continuation (lambda (k) (set! leave k) (turns)))
    (set! leave outer)))

(operator! (exit) (if leave (leave #t) (error 'exit "no loop stands round it")))
(operator! (loop p) (with-exit 'loop p (lambda () (let turn () (execute p) (turn)))))
(operator! (repeat n p) (need-count 'repeat n)
  (with-exit 'repeat p (lambda () (do ((i 0 (+ i 1))) ((= i n)) (execute p)))))
(operator! (while p q)
  (need-procedure 'while q)
  (with-exit 'while p (lambda () (let turn () (execute p) (if (true? (gml:pop 'while)) (begin (execute q) (turn)))))))

; The n-th iteration has from + n step, so that roundings of the steps do not add up.
(define (count-loop who from step to p within?)
  (for-each (lambda (v) (need-number who v)) (list from step to))
  (if (= step 0) (error who "the step is 0"))
  (with-exit who p
    (lambda ()
      (let turn ((n 0))
        (let ((i (+ from (* n step))))
          (if (if (> step 0) (within? i to) (within? to i)) (begin (gml:push i) (execute p) (turn (+ n 1)))))))))
(operator! (for from step to p) (count-loop 'for from step to p <=))
(operator! (forx from step to p) (count-loop 'forx from step to p <))

(define (all-of who v) (if (and (not (array? v)) (dictionary? v)) (map (lambda (k) (entry v k)) (keys-of who v))
                         (need-elements who v)))
(operator! (forall a p)
  (with-exit 'forall p (lambda () (for-each (lambda (e) (gml:push e) (execute p)) (all-of 'forall a)))))
(operator! (twoforall a b p)
  (let ((a (all-of 'twoforall a)) (b (all-of 'twoforall b)))
    (if (not (= (length a) (length b))) (error 'twoforall "the arrays have ~a and ~a elements" (length a) (length b)))
    (with-exit 'twoforall p (lambda () (for-each (lambda (x y) (gml:push x) (gml:push y) (execute p)) a b)))))
(operator! (map a p)
  (gml:push mark)
  (with-exit 'map p (lambda () (for-each (lambda (e) (gml:push e) (execute p)) (all-of 'map a))))
  (close-array))
(operator! (twomap a b p)
  (let ((a (all-of 'twomap a)) (b (all-of 'twomap b)))
    (if (not (= (length a) (length b))) (error 'twomap "the arrays have ~a and ~a elements" (length a) (length b)))
    (gml:push mark)
    (with-exit 'twomap p (lambda () (for-each (lambda (x y) (gml:push x) (gml:push y) (execute p)) a b)))
    (close-array)))

; ---- exceptions: { ... } { handler } catch; throw goes to the innermost handler ----

(define handler #f)
(operator! (throw) (if handler (handler #t) (error "thrown, and nothing catches it")))
(operator! (catch p q)
  (need-procedure 'catch p)
  (need-procedure 'catch q)
  (let ((outer handler) (outer-leave leave) (begun dictionaries))
    (let ((thrown? (call-with-current-continuation (lambda (k) (set! handler k) (execute p) #f))))
      (set! handler outer)
      (if thrown?
          (begin (set! leave outer-leave) (set! dictionaries begun) (execute q))))))
