; The procedures. An expression is accepted wherever a regexp is.

(define (regexp sre) (if (regexp? sre) sre (compile-sre sre)))
(define (regexp->sre re) (regexp-sre (regexp re)))
(define-syntax rx (syntax-rules () ((_ sre ...) (regexp (quasiquote (: sre ...))))))
(define (valid-sre? sre)
  (guard (e (#t #f)) (regexp sre) #t))

(define (find-in sre text start end anchored? whole?)
  (find-match (regexp sre) text start start (or end (string-length text)) anchored? whole?))
(define (regexp-matches re [text string?] [start any? 0] [end any? #f]) (find-in re text start end #t #t))
(define (regexp-matches? re [text string?] [start any? 0] [end any? #f]) (and (find-in re text start end #t #t) #t))
(define (regexp-search re [text string?] [start any? 0] [end any? #f]) (find-in re text start end #f #f))

; ---- matches ----
(define (ends-at m field)
  (if (exact-integer? field)
      (if (< -1 field (vector-length (match-ends m)))
          (vector-ref (match-ends m) field)
          (error "regexp-match: there is no such submatch" field))
      (let ((named (filter (lambda (row) (eqv? (car row) field)) (regexp-names (match-regexp m)))))
        (if (null? named) (error "regexp-match: there is no such submatch" field))
        (any (lambda (row) (vector-ref (match-ends m) (cdr row))) named))))
(define (regexp-match-count [m regexp-match?]) (regexp-count (match-regexp m)))
(define (regexp-match-submatch [m regexp-match?] [field any? 0])
  (let ((ends (ends-at m field))) (and ends (substring (match-text m) (car ends) (cdr ends)))))
(define (regexp-match-submatch-start [m regexp-match?] [field any? 0]) (let ((ends (ends-at m field))) (and ends (car ends))))
(define (regexp-match-submatch-end [m regexp-match?] [field any? 0]) (let ((ends (ends-at m field))) (and ends (cdr ends))))
(define (regexp-match->list [m regexp-match?])
  (map (lambda (i) (regexp-match-submatch m i)) (iota (+ (regexp-match-count m) 1))))

; ---- all matches, one after the other ----
; Calls (f i match text state) for each match; i is the end of the match before it. Then calls (finish i #f text state).
(define (regexp-fold re [f procedure?] state [text string?] [finish any? #f] [start any? 0] [end any? #f])
  (let ((re (regexp re)) (end (or end (string-length text))))
    (let loop ((i start) (from start) (state state))
      (let ((m (and (<= from end) (find-match re text start from end #f #f))))
        (if m
            (let* ((last (regexp-match-submatch-end m)) (next (if (= last (regexp-match-submatch-start m)) (+ last 1) last)))
              (loop last next (f i m text state)))
            (if finish (finish i #f text state) state))))))

(define (regexp-extract re text [start any? 0] [end any? #f])
  (reverse
    (regexp-fold re
                 (lambda (i m text found) (let ((s (regexp-match-submatch m))) (if (string=? s "") found (cons s found))))
                 '() text #f start end)))

; Returns the text between the matches; with `matches?` the matches, too. An empty match separates nothing.
(define (parts-of re text start end matches?)
  (define from start)
  (define (part m found)
    (let ((a (regexp-match-submatch-start m)) (b (regexp-match-submatch-end m)))
      (if (= a b)
          found
          (let ((found (cons (substring text from a) found)))
            (set! from b)
            (if matches? (cons (substring text a b) found) found)))))
  (let ((found (regexp-fold re (lambda (i m text found) (part m found)) '() text #f start end))
        (end (or end (string-length text))))
    (reverse (if (and matches? (= from end) (pair? found)) found (cons (substring text from end) found)))))
(define (regexp-split re [text string?] [start any? 0] [end any? #f]) (parts-of re text start end #f))
(define (regexp-partition re [text string?] [start any? 0] [end any? #f]) (parts-of re text start end #t))

; ---- replacement ----
; A replacement is a text, the number or name of a submatch, pre or post, a procedure of the match, or a list of these.
(define (replacement new m start end)
  (cond ((string? new) new)
        ((pair? new) (apply string-append (map (lambda (n) (replacement n m start end)) new)))
        ((null? new) "")
        ((procedure? new) (replacement (new m) m start end))
        ((eq? new 'pre) (substring (match-text m) start (regexp-match-submatch-start m)))
        ((eq? new 'post) (substring (match-text m) (regexp-match-submatch-end m) end))
        (else (or (regexp-match-submatch m new) ""))))
; Replaces the match with this number, or all for #f.
(define (replaced re text new start end number)
  (define pieces '())
  (define from start)
  (define last (or end (string-length text)))
  (regexp-fold re
               (lambda (i m text n)
                 (if (or (not number) (= n number))
                     (begin
                       (set! pieces (cons* (replacement new m start last) (substring text from (regexp-match-submatch-start m)) pieces))
                       (set! from (regexp-match-submatch-end m))))
                 (+ n 1))
               0 text #f start end)
  (apply string-append (reverse (cons (substring text from last) pieces))))
(define (regexp-replace re [text string?] new [start any? 0] [end any? #f] [number any? 0])
  (replaced re text new start end number))
(define (regexp-replace-all re [text string?] new [start any? 0] [end any? #f]) (replaced re text new start end #f))
