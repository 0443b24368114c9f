; Patterns become code when a program is expanded. A pattern is
;
;   _  name  "datum"  'datum  `quasi-pattern         anything; anything, and bound; what is equal?
;   (p q . rest)  (p ... q)  (p ..2 q)  #(p ...)     lists and vectors; any number of p, or two and more
;   (? predicate p ...)  (= procedure p)             what the predicate accepts; the procedure's result
;   (and p ...)  (or p ...)  (not p)                 patterns combined
;
; A name that a pattern has twice asks for equal values. `match-code` gives the code that runs `found`, a procedure from the names bound so far
; to code, where the pattern fits the value in the variable `x`, and calls the variable `fail` where it does not. A name of a pattern stays as
; the program wrote it; all other variables are fresh.

; What one expansion carries: the renaming and the comparison of identifiers, and a count for fresh variables.
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

; How many a pattern's mark of repetition asks for: 0 for ... and ___, 3 for ..3; #f: it is none.
(define (repetition e x)
  (and (identifier? x)
       (let ((text (symbol->string (syntax->datum x))))
         (cond ((or (word? e x '...) (word? e x '___)) 0)
               ((and (> (string-length text) 2) (string=? (substring text 0 2) "..")) (string->number (substring text 2)))
               (else #f)))))

; The pattern that a quasi-pattern stands for: what is not unquoted is a datum.
(define (quasi-pattern e p)
  (cond ((and (pair? p) (word? e (car p) 'unquote) (pair? (cdr p)) (null? (cddr p))) (cadr p))
        ((pair? p) (cons (quasi-pattern e (car p)) (quasi-pattern e (cdr p))))
        ((vector? p) (list->vector (quasi-pattern e (vector->list p))))
        ((or (null? p) (repetition e p)) p)
        (else (list (word e 'quote) p))))

; The names that a pattern binds, each once, in the order of their places.
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

; A part of the value, kept in a variable while it is matched.
(define (with-part e part p bound found fail)
  (let ((x (fresh e "part")))
    `(,(word e 'let) ((,x ,part)) ,(match-code e p x bound found fail))))

(define (match-all e patterns x bound found fail)
  (if (null? patterns)
      (found bound)
      (match-code e (car patterns) x bound (lambda (bound) (match-all e (cdr patterns) x bound found fail)) fail)))

; The first alternative that fits. The code behind all of them is a procedure of the names that the first binds; an alternative without such a
; name gives #f for it.
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

; Any number of items that fit p, at least so many, and then the rest. The rest's own pairs are counted off first, so nothing is tried twice.
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
