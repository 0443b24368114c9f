; The compilation of an expression to a graph of states. A state is a vector
;
;   #(mark take SET NEXT)       takes one character of the set, then the next state
;   #(mark fork FIRST SECOND)   both states; the first is preferred
;   #(mark save PLACE NEXT)     saves the position as an end of a submatch
;   #(mark test (f i) NEXT)     continues if the test of the text, its ends and the position is true
;   #(mark found)               the whole expression matches
;
; Its mark is the last step of a search that reached it. Repetitions by numbers are written out, up to a limit.

(define most-states 100000)

(define-record-type regexp-type (make-regexp start sre count names lazy? step) regexp?
  (start regexp-start)
  (sre regexp-sre)
  (count regexp-count)                       ; submatches
  (names regexp-names)                       ; of submatches: a list of (name . number)
  (lazy? regexp-lazy?)                       ; has operators that match as little as possible: the first match counts
  (step regexp-step set-regexp-step!))       ; the steps of all searches so far

; ---- tests of a position: the text, the searched part, the position ----
(define (begins? s from to i) (= i from))
(define (ends? s from to i) (= i to))
(define (line-begins? s from to i) (or (= i from) (memv (string-ref s (- i 1)) '(#\newline #\return))))
(define (line-ends? s from to i) (or (= i to) (memv (string-ref s i) '(#\newline #\return))))
(define (word-before? s from i) (and (> i from) (word-char? (string-ref s (- i 1)))))
(define (word-after? s to i) (and (< i to) (word-char? (string-ref s i))))
(define (word-begins? s from to i) (and (not (word-before? s from i)) (word-after? s to i)))
(define (word-ends? s from to i) (and (word-before? s from i) (not (word-after? s to i))))
(define (inside-word? s from to i) (and (word-before? s from i) (word-after? s to i)))
(define named-tests
  `((bos . ,begins?) (eos . ,ends?) (bol . ,line-begins?) (eol . ,line-ends?)
    (bow . ,word-begins?) (eow . ,word-ends?) (nwb . ,inside-word?)))

; ---- the numbers of submatches, from left to right ----
; Returns the expression with (submatch-number N sre ...) for each, their count, and the list of names.
(define (number-submatches sre)
  (define count 0)
  (define names '())
  (define (next-number!) (set! count (+ count 1)) count)
  (define (each sres capture?) (map (lambda (s) (walk s capture?)) sres))
  (define (submatch parts capture? name)
    (if capture?
        (let ((n (next-number!)))
          (if name (set! names (cons (cons name n) names)))
          (cons* 'submatch-number n (each parts #t)))
        (cons ': (each parts #f))))
  (define (walk sre capture?)
    (if (and (pair? sre) (list? sre))
        (case (car sre)
          (($ submatch) (submatch (cdr sre) capture? #f))
          ((-> submatch-named)
           (if (null? (cdr sre)) (refuse "a name is missing:" sre))
           (submatch (cddr sre) capture? (cadr sre)))
          ((w/nocapture) (cons ': (each (cdr sre) #f)))
          (else (each sre capture?)))
        sre))
  (let ((numbered (walk sre #t))) (values numbered count (reverse names))))

; ---- states, made from the end of an expression to its beginning ----
(define (compile-sre sre)
  (define states 0)
  (define lazy #f)
  (define (state . parts)
    (set! states (+ states 1))
    (if (> states most-states) (refuse "it is too large; numbers of repetitions multiply:" sre))
    (list->vector (cons -1 parts)))

  (define (sequence sres mode next)
    (let loop ((left (reverse sres)) (next next))
      (if (null? left) next (loop (cdr left) (one (car left) mode next)))))
  (define (fork greedy? first second) (if greedy? (state 'fork first second) (begin (set! lazy #t) (state 'fork second first))))
  (define (optional sres greedy? mode next) (fork greedy? (sequence sres mode next) next))
  (define (any-number sres greedy? mode next)
    (let ((again (fork greedy? next next)))
      (vector-set! again (if greedy? 2 3) (sequence sres mode again))
      again))
  (define (repeated least most sres greedy? mode next)
    (if (not (and (exact-integer? least) (>= least 0) (or (not most) (and (exact-integer? most) (>= most least)))))
        (refuse "a repetition needs whole numbers, the smaller first:" sre))
    (if (> (or most least) most-states) (refuse "it is too large; numbers of repetitions multiply:" sre))
    ; x{2,4} is x x (x (x)?)?, and each omitted x leads to the end.
    (let optionals ((i least) (inner (if most next (any-number sres greedy? mode next))))
      (if (and most (< i most))
          (optionals (+ i 1) (fork greedy? (sequence sres mode inner) next))
          (let required ((i 0) (next inner))
            (if (< i least) (required (+ i 1) (sequence sres mode next)) next)))))
  (define (submatch number sres mode next)
    (state 'save (* 2 number) (sequence sres mode (state 'save (+ (* 2 number) 1) next))))
  (define (one sre mode next)
    (let ((set (set-of sre mode)))
      (cond (set (state 'take set next))
            ((string? sre) (sequence (string->list sre) mode next))
            ((and (symbol? sre) (assq sre named-tests)) => (lambda (row) (state 'test (cdr row) next)))
            ((eq? sre 'word) (one '(word+ any) mode next))
            ((eq? sre 'grapheme) (refuse "clusters of characters are not part of it:" sre))
            ((not (and (pair? sre) (list? sre))) (refuse "this is no expression:" sre))
            (else (compound sre (car sre) (cdr sre) mode next)))))
  (define (compound sre head parts mode next)
    (define (number) (if (pair? parts) (car parts) (refuse "a number is missing:" sre)))
    (define (two-numbers) (if (and (pair? parts) (pair? (cdr parts))) (cadr parts) (refuse "a number is missing:" sre)))
    (case head
      ((: seq) (sequence parts mode next))
      ((or) (if (null? parts) (state 'take (lambda (c) #f) next)
                (let loop ((left parts))
                  (if (null? (cdr left)) (one (car left) mode next)
                      (let ((first (one (car left) mode next))) (state 'fork first (loop (cdr left))))))))
      ((? optional) (optional parts #t mode next))
      ((?? non-greedy-optional) (optional parts #f mode next))
      ((* zero-or-more) (any-number parts #t mode next))
      ((*? non-greedy-zero-or-more) (any-number parts #f mode next))
      ((+ one-or-more) (repeated 1 #f parts #t mode next))
      ((= exactly) (repeated (number) (number) (cdr parts) #t mode next))
      ((>= at-least) (repeated (number) #f (cdr parts) #t mode next))
      ((** repeated) (two-numbers) (repeated (car parts) (cadr parts) (cddr parts) #t mode next))
      ((**? non-greedy-repeated) (two-numbers) (repeated (car parts) (cadr parts) (cddr parts) #f mode next))
      ((submatch-number) (submatch (car parts) (cdr parts) mode next))
      ((word) (sequence `(bow ,@parts eow) mode next))
      ((word+) (sequence `(bow (+ (& (or alphanumeric "_") (or ,@parts))) eow) mode next))
      ((w/nocase) (sequence parts (cons 'nocase mode) next))
      ((w/case) (sequence parts (delete 'nocase mode) next))
      ((w/ascii) (sequence parts (cons 'ascii mode) next))
      ((w/unicode) (sequence parts (delete 'ascii mode) next))
      ((look-ahead look-behind neg-look-ahead neg-look-behind backref)
       (refuse "this is not regular, and would not be found in linear time:" sre))
      (else (refuse "this is no expression:" sre))))

  (call-with-values (lambda () (number-submatches sre))
    (lambda (numbered count names)
      (let ((start (submatch 0 (list numbered) '() (state 'found))))
        (make-regexp start sre count names lazy 0)))))
