; The expansion of patterns to code. A pattern is
;
;   _  name  "datum"  'datum  `quasi-pattern         anything; anything, and bound; an equal? value
;   (p q . rest)  (p ... q)  (p ..2 q)  #(p ...)     lists and vectors; any number of p, or two and more
;   (? predicate p ...)  (= procedure p)             a value that satisfies the predicate; the procedure's result
;   (and p ...)  (or p ...)  (not p)                 patterns combined
;
; Two equal names in a pattern need equal values. `match-code` returns code that matches the value in the variable `x`.
; After a match it runs `found`, a procedure from the names bound so far to code; otherwise it calls the variable
; `fail`. A name of a pattern stays as the program wrote it; all other variables are fresh.

; The data of one expansion: the renaming and the comparison of identifiers, and a count for fresh variables.
(define-record-type expansion (make-expansion rename compare count) expansion?
  (rename expansion-rename)
  (compare expansion-compare)
  (count expansion-count set-expansion-count!))

(define (word e name) ((expansion-rename e) name))
(define (word? e x name) (and (identifier? x) ((expansion-compare e) x (word e name))))
(define (fresh e stem)
  (set-expansion-count! e (+ (expansion-count e) 1))
  (word e (string->symbol (string-append stem (number->string (expansion-count e))))))
(define (same-name? e) (lambda (a b) ((expansion-compare e) a b)))

(define (refuse why pattern) (error (string-append "match: " why) (syntax->datum pattern)))

; Returns the least count of a pattern's mark of repetition: 0 for ... and ___, 3 for ..3; #f if it is none.
(define (repetition e x)
  (and (identifier? x)
       (let ((text (symbol->string (syntax->datum x))))
         (cond ((or (word? e x '...) (word? e x '___)) 0)
               ((and (> (string-length text) 2) (string=? (substring text 0 2) "..")) (string->number (substring text 2)))
               (else #f)))))

; Returns the pattern of a quasi-pattern: its parts that are not unquoted are data.
(define (quasi-pattern e p)
  (cond ((and (pair? p) (word? e (car p) 'unquote) (pair? (cdr p)) (null? (cddr p))) (cadr p))
        ((pair? p) (cons (quasi-pattern e (car p)) (quasi-pattern e (cdr p))))
        ((vector? p) (list->vector (quasi-pattern e (vector->list p))))
        ((or (null? p) (repetition e p)) p)
        (else (list (word e 'quote) p))))

; Returns the names that a pattern binds, each once, in the order of their places.
(define (pattern-names e p)
  (define (add names found) (fold (lambda (name found) (if (member name found (same-name? e)) found (append found (list name)))) found names))
  (define (all patterns) (fold (lambda (p found) (add (pattern-names e p) found)) '() patterns))
  (cond ((identifier? p) (if (or (word? e p '_) (repetition e p)) '() (list p)))
        ((vector? p) (pattern-names e (vector->list p)))
        ((not (pair? p)) '())
        ((word? e (car p) 'quote) '())
        ((word? e (car p) 'quasiquote) (pattern-names e (quasi-pattern e (cadr p))))
        ((or (word? e (car p) '?) (word? e (car p) '=)) (all (cddr p)))
        ((or (word? e (car p) 'and) (word? e (car p) 'or) (word? e (car p) 'not)) (all (cdr p)))
        (else (add (pattern-names e (cdr p)) (pattern-names e (car p))))))

(define (match-code e p x bound found fail)
  (define (need length)
    (if (not (and (list? p) (length (cdr p)))) (refuse "this pattern has too few or too many parts:" p)))
  (define (test condition then) `(,(word e 'if) ,condition ,then (,fail)))
  (define (equal-to datum) (test `(,(word e 'equal?) ,x ,datum) (found bound)))
  (cond ((word? e p '_) (found bound))
        ((repetition e p) (refuse "a mark of repetition follows no pattern:" p))
        ((identifier? p)
         (if (member p bound (same-name? e)) (equal-to p) `(,(word e 'let) ((,p ,x)) ,(found (cons p bound)))))
        ((null? p) (test `(,(word e 'null?) ,x) (found bound)))
        ((vector? p) (test `(,(word e 'vector?) ,x) (with-part e `(,(word e 'vector->list) ,x) (vector->list p) bound found fail)))
        ((not (pair? p)) (equal-to p))
        ((word? e (car p) 'quote) (need (lambda (parts) (= (length parts) 1))) (equal-to p))
        ((word? e (car p) 'quasiquote)
         (need (lambda (parts) (= (length parts) 1)))
         (match-code e (quasi-pattern e (cadr p)) x bound found fail))
        ((word? e (car p) '?) (need pair?) (test `(,(cadr p) ,x) (match-all e (cddr p) x bound found fail)))
        ((word? e (car p) '=)
         (need (lambda (parts) (= (length parts) 2)))
         (with-part e `(,(cadr p) ,x) (caddr p) bound found fail))
        ((word? e (car p) 'and) (need list?) (match-all e (cdr p) x bound found fail))
        ((word? e (car p) 'or) (need list?) (match-any e (cdr p) x bound found fail))
        ((word? e (car p) 'not) (need (lambda (parts) (= (length parts) 1))) (match-none e (cadr p) x bound found fail))
        ((word? e (car p) '$) (refuse "records are matched by (? predicate), not by" p))
        ((and (pair? (cdr p)) (repetition e (cadr p))) =>
         (lambda (least) (match-many e (car p) least (cddr p) x bound found fail)))
        (else
         (test `(,(word e 'pair?) ,x)
               (with-part e `(,(word e 'car) ,x) (car p) bound
                 (lambda (bound) (with-part e `(,(word e 'cdr) ,x) (cdr p) bound found fail))
                 fail)))))

; Matches a part of the value, which it keeps in a variable.
(define (with-part e part p bound found fail)
  (let ((x (fresh e "part")))
    `(,(word e 'let) ((,x ,part)) ,(match-code e p x bound found fail))))

(define (match-all e patterns x bound found fail)
  (if (null? patterns)
      (found bound)
      (match-code e (car patterns) x bound (lambda (bound) (match-all e (cdr patterns) x bound found fail)) fail)))

; Matches the first alternative that fits. The code after them is a procedure of the names that the alternatives bind;
; an alternative that lacks a name passes #f for it.
(define (match-any e patterns x bound found fail)
  (define (new names) (remove (lambda (name) (member name bound (same-name? e))) names))
  (let* ((names (new (pattern-names e (cons (word e 'or) patterns))))
         (then (fresh e "then")))
    `(,(word e 'let) ((,then (,(word e 'lambda) ,names ,(found (append names bound)))))
      ,(let alternatives ((left patterns))
         (if (null? left)
             `(,fail)
             (let ((next (fresh e "next")))
               `(,(word e 'let) ((,next (,(word e 'lambda) () ,(alternatives (cdr left)))))
                 ,(match-code e (car left) x bound
                    (lambda (now) `(,then ,@(map (lambda (name) (if (member name now (same-name? e)) name #f)) names)))
                    next))))))))

(define (match-none e p x bound found fail)
  (let ((otherwise (fresh e "otherwise")))
    `(,(word e 'let) ((,otherwise (,(word e 'lambda) () ,(found bound))))
      ,(match-code e p x bound (lambda (bound) `(,fail)) otherwise))))

; Matches `least` or more items that fit p, and then the rest. It counts the rest's own pairs first, so it tries nothing
; twice.
(define (match-many e p least rest x bound found fail)
  (define (pairs-of rest)
    (cond ((not (pair? rest)) 0)
          ((and (pair? (cdr rest)) (repetition e (cadr rest))) (refuse "a list has one mark of repetition, and here are two:" rest))
          (else (+ 1 (pairs-of (cdr rest))))))
  (let* ((names (remove (lambda (name) (member name bound (same-name? e))) (pattern-names e p)))
         (lists (map (lambda (name) (fresh e "found")) names))
         (count (fresh e "count"))
         (loop (fresh e "loop"))
         (item (fresh e "item"))
         (left (fresh e "left"))
         (call (lambda (name . parts) (cons (word e name) parts))))
    (call 'let `((,count ,(call '- (call 'count-pairs x) (pairs-of rest))))
      (call 'if (call '>= count least)
        (call 'let loop `((,left ,x) (,count ,count) ,@(map (lambda (l) (list l (call 'quote '()))) lists))
          (call 'if (call '> count 0)
            (call 'let `((,item ,(call 'car left)))
              (match-code e p item bound
                (lambda (bound)
                  `(,loop ,(call 'cdr left) ,(call '- count 1) ,@(map (lambda (name l) (call 'cons name l)) names lists)))
                fail))
            (call 'let (map (lambda (name l) (list name (call 'reverse l))) names lists)
              (match-code e rest left (append names bound) found fail))))
        `(,fail)))))
