; Statements: a statement becomes a form that puts the objects it makes in front of a list of objects.

(define (nothing s) (list (word s 'quote) '()))
(define (definition? t) (and (memq (car t) '(function module)) #t))
(define (assignment? t) (eq? (car t) '=))
(define (makes-objects? t) (not (or (definition? t) (assignment? t) (eq? (car t) 'use))))

; ---- definitions ----

(define (table-of statements kind symbol-of scope-of)
  (let ((table (make-hasheq)))
    (for-each
      (lambda (t) (if (eq? (car t) kind) (hash-set! table (cadr t) (make-definition (symbol-of (cadr t)) t (scope-of) #f))))
      statements)
    table))
(define (symbol-with before name after) (string->symbol (string-append before (symbol->string name) after)))

; Returns the form of a definition's procedure. A module's first argument is its children.
(define (definition-form d s)
  (let ((t (definition-tree d)))
    (if (eq? (car t) 'function)
        (procedure-form (caddr t) s '() (lambda (inner) (expression (cadddr t) inner)))
        (let* ((kids (fresh s 'kids)) (outer (make-scope '() no-names no-names kids s '() (scope-whole s))))
          (procedure-form (caddr t) outer (list kids)
            (lambda (inner) (in-module t s (body (cdddr t) inner (lambda (statements inner) (statement-list statements inner (nothing s)))))))))))
(define (in-module t s form)
  (if (whole-tracks-modules? (scope-whole s)) (list (word s 'scad:in-module) (symbol->string (cadr t)) form) form))

; Returns the assignments, in the order of the first to each name, with the last value for each name.
(define (last-assignments statements)
  (let ((last (make-hasheq)))
    (for-each (lambda (t) (if (assignment? t) (hash-set! last (cadr t) t))) statements)
    (let loop ((l statements) (seen '()))
      (cond ((null? l) (reverse seen))
            ((and (assignment? (car l)) (hash-ref last (cadr (car l)) #f))
             => (lambda (t) (hash-remove! last (cadr t)) (loop (cdr l) (cons t seen))))
            (else (loop (cdr l) seen))))))

; Returns a form for statements with a scope of their own. (make statements scope) returns the form for those that make
; objects. Functions and modules see all variables of the scope, a value only those before it.
(define (body statements s make)
  (let* ((assigned (last-assignments statements)) (defined (filter definition? statements)) (made (filter makes-objects? statements)))
    (cond ((and (null? assigned) (null? defined)) (make made s))
          ((null? defined) (assigned-form assigned s #f made make))
          (else
           (let* ((symbols (map (lambda (t) (cons (cadr t) (fresh s (cadr t)))) (filter (lambda (t) (not (special? (cadr t)))) assigned)))
                  (full #f)
                  (functions (table-of defined 'function (lambda (n) (fresh s (symbol-with "f:" n ""))) (lambda () #f)))
                  (modules (table-of defined 'module (lambda (n) (fresh s (symbol-with "" n ":"))) (lambda () #f)))
                  (all (append (hash-values functions) (hash-values modules))))
             (for-each (lambda (d) (set-definition-wanted! d #t)) all)
             (set! full (make-scope symbols functions modules (scope-kids s) s '() (scope-whole s)))
             (let ((procedures (map (lambda (d) (list (definition-symbol d) (definition-form d full))) all))
                   (start (make-scope '() functions modules (scope-kids s) s '() (scope-whole s))))
               (list (word s 'let) (map (lambda (b) (list (cdr b) (list (word s 'quote) 'undef))) symbols)
                 (list (word s 'letrec) procedures (assigned-form assigned start symbols made make)))))))))

; symbols: the symbols of variables that exist already, or #f.
(define (assigned-form assigned s symbols made make)
  (if (null? assigned) (make made s)
      (let* ((t (car assigned)) (name (cadr t)) (own? (and (function-tree? (caddr t)) (not symbols) (not (special? name)))) (value (if own? #f (expression (caddr t) (if symbols (with-own s name symbols t) s)))))
        (if (special? name)
            (list (word s 'scad:with-special) (special-cell s name) value (assigned-form (cdr assigned) s symbols made make))
            (let* ((symbol (if symbols (cdr (assq name symbols)) (new-symbol s name))) (inner (inner-scope s (list (cons name symbol))))
                   (rest (assigned-form (cdr assigned) inner symbols made make)))
              (if symbols (list (word s 'begin) (list (word s 'set!) symbol value) rest)
                  (if own? (own-function s symbol (caddr t) inner rest)
                  (list (word s 'let) (list (list symbol value)) rest))))))))
(define (with-own s name symbols t)
  (if (and (function-tree? (caddr t)) (assq name symbols)) (inner-scope s (list (assq name symbols))) s))

; ---- statements that make objects ----

(define (statement-list statements s all) (in-order statements s all (lambda (t all) (statement t s all))))

(define (statement t s all)
  (case (car t)
    ((if) (let* ((l (fresh s 'all)) (branch (lambda (statements) (body statements s (lambda (made inner) (statement-list made inner l))))))
            (becomes! t (word s 'let) (list (list l all))
              (list (word s 'if) (test (cadr t) s) (branch (caddr t)) (if (pair? (cdddr t)) (branch (cadddr t)) l)))))
    ((mark) (becomes! t (word s 'scad:mark) (cadr t) (statement (caddr t) s (nothing s)) all))
    ((missing) (becomes! t (word s 'begin) (list (word s 'scad:missing) (cadr t)) all))
    ((do) (instance t (cadr t) (caddr t) (cdddr t) s all))
    (else (error "scad-program: unknown statement ~s" (car t)))))

(define (instance t name arguments kids s all)
  (define (children inner all) (body kids inner (lambda (made inner) (statement-list made inner all))))
  (case name
    ((for) (loops t arguments s all children))
    ((intersection_for)
     (becomes! t (word s 'scad:intersection-for)
       (loops (list #f) arguments s (nothing s) (lambda (inner l) (list (word s 'cons) (children inner (nothing s)) l))) all))
    ((let assign)
     (let ((l (fresh s 'all)))
       (let ((form (let-form (list #f arguments) s (lambda (inner) (children inner l)))))
         (becomes! t (word s 'let) (list (list l all)) form))))
    ((echo) (let ((made (echoes arguments s))) (then t made (children s all) s)))
    ((assert) (let ((made (assertion arguments s))) (then t made (children s all) s)))
    (else
     (let ((d (find-definition s scope-modules name)))
       (cond (d (joined-to t (call-known (list #f) (definition-symbol d) (list (kids-form kids s)) (caddr (definition-tree d)) arguments s) s all))
             ((eq? name 'children)
              (becomes! t (word s 'scad:children) (or (scope-kids s) (word s 'scad:no-kids))
                (if (pair? arguments) (expression (cadar arguments) s) (word s 'scad:absent)) all))
             ((hash-ref builtin-modules name #f)
              => (lambda (row) (joined-to t (call-known (list #f) (word s (car row)) (list (kids-form kids s)) (map list (cdr row)) arguments s) s all)))
             (else (then t (list (word s 'scad:unknown) "module" (symbol->string name)) all s)))))))

(define (then t first rest s) (becomes! t (word s 'begin) first rest))
(define (joined-to t form s all)
  (if (and (pair? all) (eq? (car all) (word s 'quote)) (null? (cadr all))) (becomes-form! t form)
      (becomes! t (word s 'scad:join) form all)))

; Children: their number, and a procedure of the index of a child that returns the objects of that child.
(define (kids-form statements s)
  (let ((count (length (filter makes-objects? statements))) (i (fresh s 'i)))
    (if (= count 0) (word s 'scad:no-kids)
        (list (word s 'scad:kids) count
          (list (word s 'lambda) (list i)
            (body statements s
              (lambda (made inner)
                (let loop ((l made) (k 0))
                  (if (null? (cdr l)) (statement (car l) inner (nothing s))
                      (list (word s 'if) (list (word s 'eq?) i k) (statement (car l) inner (nothing s)) (loop (cdr l) (+ k 1))))))))))))
