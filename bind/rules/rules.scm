; Rules: define-rule, the loop that runs them, and the operators that take rules. After primitives.scm; scopes and the
; stack of a derivation are C (bind/rules/). Names that begin with % are hidden from programs. Compiled into the binary
; when it is built.
;
; A rule and an operator are marked procedures. In a sequence of a rule they get a live scope: they push their work on the
; stack of the running derivation and return nothing. With a plain scope they begin a derivation and return its object.
; Therefore calls of rules do not nest, at any depth.

; ---- the loop ----

(define (%grow d)
  (let loop ((s (%derivation-next d)))
    (if s
        (begin
          (%derivation-made d ((%derivation-rule d) s))
          (loop (%derivation-next d))))))

; Takes the result of an operator: a derivation to run, or nothing.
(define (%grown d)
  (if (%derivation? d)
      (begin
        (dynamic-wind
          (lambda () (%derivation-enter d))
          (lambda () (%grow d))
          (lambda () (%derivation-leave d)))
        (%derivation-object d))))

(define (derive s rule #:depth [depth any? 1000]) (%grown (%derive s rule depth)))

; Returns the rule with its further arguments bound.
(define (rule-with rule . arguments)
  (%need-procedure 'rule-with 'rule rule)
  (%marked-as (lambda (s) (apply rule s arguments)) rule))

; ---- define-rule ----

; Applies a rule to its scope: runs its body now, leaves it on the stack, or runs a new derivation.
(define (%apply-rule self fits? name class place body)
  (if (fits? self)
      (let ((how (%rule-enter self name body)))
        (cond ((eq? how #t) (body self))
              (how (%grown how))))
      (%rule-refuses name class place self)))

(define-syntax define-rule
  (er-macro-transformer
    (lambda (form rename compare)
      (define (refuse text . what) (cons* (rename 'syntax-error) (string-append "define-rule: " text) what))
      (define (word x) (and (identifier? x) (symbol->string (syntax->datum x))))
      (define (keyword? x text) (equal? (word x) text))
      (define (arrow? x) (and (pair? x) (identifier? (car x)) (compare (car x) (rename '=>))))
      (define (clause? x) (and (pair? x) (or (arrow? x) (arrow? (car x)) (keyword? (car x) "#:when"))))
      (define unspecific (list (rename 'if) #f #f))
      ; returns a contract's predicate as an expression: and, or and not combine predicates in it
      (define (predicate x)
        (if (and (pair? x) (list? x) (identifier? (car x)))
            (let ((known (find (lambda (p) (compare (car x) (rename (car p)))) '((and . and-of) (or . or-of) (not . not-of)))))
              (if known (cons (rename (cdr known)) (map predicate (cdr x))) x))
            x))
      ; the code for one form of a sequence: it handles the form's value, and returns the next self
      (define (step self x)
        (let* ((form (if (identifier? x) (list x) x)) (op (car form)))
          (list (rename '%took) self
            (cond
              ((and (identifier? op) (compare op (rename 'with-flags)))
               (%cons-at form op (cons (list (rename '%live) (rename '%flagged) self) (cdr form))))
              ((identifier? op)
               (%cons-at form op (cons (list (rename '%live) op self) (cdr form))))
              (else
                (list (rename 'let) (list (list (rename 'op) op))
                  (%cons-at form (rename 'op) (cons (list (rename '%live) (rename 'op) self) (cdr form)))))))))
      (define (steps self forms)
        (cond
          ((null? forms) unspecific)
          ((null? (cdr forms)) (list (rename 'begin) (step self (car forms)) unspecific))
          (else (list (rename 'let) (list (list self (step self (car forms)))) (steps self (cdr forms))))))
      ; a sequence as (chance . forms); chance #f: it has none
      (define (sequence x)
        (if (and (pair? (cdr x)) (keyword? (cadr x) "#:chance"))
            (if (pair? (cddr x)) (cons (caddr x) (cdddr x)) (cons #f '()))
            (cons #f (cdr x))))
      (define (sequences self all)
        (if (and (= (length all) 1) (not (car (car all))))
            (steps self (cdr (car all)))
            (list (rename 'let) (list (list (rename 'chosen) (cons (rename '%choose) (map car all))))
              (let loop ((all all) (i 0))
                (if (null? all)
                    unspecific
                    (list (rename 'if) (list (rename 'eqv?) (rename 'chosen) i)
                      (steps self (cdr (car all)))
                      (loop (cdr all) (+ i 1))))))))
      (define (wrong clause)
        (cond
          ((not (list? clause)) "a clause is [#:when test sequence ...] or [sequence ...], not")
          ((and (keyword? (car clause) "#:when") (null? (cdr clause))) "a test is missing after #:when in")
          ((not (every arrow? (clause-sequences clause))) "a sequence is (=> form ...) or (=> #:chance p form ...); this clause has something else:")
          ((any (lambda (s) (not (list? s))) (clause-sequences clause)) "a sequence is (=> form ...), not")
          ((any (lambda (s) (any (lambda (f) (not (or (identifier? f) (and (list? f) (pair? f))))) (cdr (sequence s)))) (clause-sequences clause))
           "a form of a sequence is (operator argument ...) or the name of a rule; this clause has something else:")
          (else
            (let ((constant (filter real? (map (lambda (s) (car (sequence s))) (clause-sequences clause)))))
              (cond
                ((any (lambda (p) (not (<= 0 p 1))) constant) "a chance is a number from 0 to 1; this clause has another:")
                ((> (apply + constant) (+ 1 1e-9)) "the chances of this clause sum to more than 1:")
                (else #f))))))
      (define (clause-sequences clause)
        (cond ((arrow? clause) (list clause)) ((keyword? (car clause) "#:when") (cddr clause)) (else clause)))
      (define (clauses self all)
        (if (null? all)
            unspecific
            (let* ((clause (car all)) (body (sequences self (map sequence (clause-sequences clause)))))
              (if (keyword? (car clause) "#:when")
                  (list (rename 'if) (cadr clause) body (clauses self (cdr all)))
                  body))))
      (cond
        ((not (and (list? form) (>= (length form) 3) (pair? (cadr form)) (identifier? (caadr form)) (pair? (cdadr form))))
         (refuse "it is written (define-rule (name [self box-scope?] parameter ...) clause ...)"))
        (else
          (let* ((name (caadr form)) (first (cadr (cadr form))) (others (cddr (cadr form)))
                 (self (if (pair? first) (car first) first))
                 (class (if (and (pair? first) (pair? (cdr first))) (cadr first) (rename 'scope?)))
                 (definitions (take-while (lambda (x) (not (clause? x))) (cddr form)))
                 (all (drop-while (lambda (x) (not (clause? x))) (cddr form)))
                 (bad (find (lambda (c) (if (clause? c) (wrong c) "definitions stand before the clauses, not")) all))
                 (inner (rename (syntax->datum name))))
            (cond
              ((not (identifier? self)) (refuse "the first parameter is the scope, as in [self box-scope?], not" first))
              ((null? all) (refuse "a rule has clauses, such as [(=> (scope-place brick))]; this one has none:" name))
              (bad (refuse (if (clause? bad) (wrong bad) "definitions stand before the clauses; this stands behind one:") bad))
              (else
                `(,(rename 'define) ,name
                  (,(rename 'let) ((,(rename 'fits?) ,(predicate class)))
                    (,(rename 'define) (,inner ,self . ,others)
                      (,(rename '%apply-rule) ,self ,(rename 'fits?) (,(rename 'quote) ,(syntax->datum name))
                        ,(call-with-output-string (lambda (port) (write (syntax->datum class) port)))
                        ,(%place-of form)
                        (,(rename 'letrec) ((,inner (,(rename 'lambda) (,self) ,@definitions ,(clauses self all)))) ,inner)))
                    (,(rename '%marked) ,inner)))))))))))

; ---- flags ----

; flags is a quoted list of names and of (name test) with an expression as test; or an expression for such a list.
(define-syntax with-flags
  (er-macro-transformer
    (lambda (form rename compare)
      (if (not (and (list? form) (= (length form) 4)))
          (list (rename 'syntax-error) "with-flags is written (with-flags scope '(flag (flag test) ...) rule)")
          (let ((flags (caddr form)))
            (%cons-at form (rename '%flagged)
              (list (cadr form)
                (if (and (pair? flags) (identifier? (car flags)) (compare (car flags) (rename 'quote)) (list? (cadr flags)))
                    (cons (rename 'list)
                      (map (lambda (x)
                             (if (and (list? x) (= (length x) 2))
                                 (list (rename 'cons) (list (rename 'quote) (car x)) (cadr x))
                                 (list (rename 'quote) x)))
                        (cadr flags)))
                    flags)
                (cadddr form))))))))

; ---- operators ----

(define-syntax %define-operator
  (syntax-rules ()
    ((_ (name . parameters) call)
     (define name (let () (define (name . parameters) (%grown call)) (%marked name))))))

(%define-operator (%flagged s flags rule) (%with-flags s flags rule))
(%define-operator (scope-split s axis . parts) (%scope-split s axis parts))
(%define-operator (scope-repeat s axis approx rule) (%scope-repeat s axis approx rule))
(%define-operator (scope-component s rule #:of [of any? #f]) (if of (%scope-component s rule #:of of) (%scope-component s rule)))
(%define-operator (scope-extrude s h #:side [side any? #f] #:top [top any? #f] #:bottom [bottom any? #f])
  (%scope-extrude s h #:side side #:top top #:bottom bottom))
(%define-operator (scope-place s object) (%scope-place s object))
(%define-operator (scope-prism s angle rule) (%scope-prism s angle rule))
(%define-operator (scope-round-corner s angle approx rule) (%scope-round-corner s angle approx rule))
(%define-operator (scope-triangulate s rule) (%scope-triangulate s rule))
(%define-operator (scope-subdivide s rule) (%scope-subdivide s rule))
(%define-operator (turtle-front s rule) (%turtle-front s rule))

; ---- signals and marks ----

(%define-operator (scope-await s name rule) (%scope-await s name rule))

; A mark is an object without geometry, made with the scope, the name, and the properties as an association list.
(define %mark-type (%custom-type 'marked-scope 'scope-mark))

(define (scope-mark s name . properties)
  (%need-symbol 'scope-mark 'name name)
  (let loop ((l properties) (known '()))
    (cond
      ((null? l)
       (%scope-mark s (%custom %mark-type (list s name (reverse known)) (empty-object))))
      ((not (and (symbol? (car l)) (pair? (cdr l))))
       (error 'scope-mark
         "behind the name stand properties and their values, as in (scope-mark s 'wall 'material 'stone), got ~s"
         properties))
      (else (loop (cddr l) (cons (cons (car l) (cadr l)) known))))))

; Returns (scope name properties) for the number, or #f: users' kinds may have any name.
(define (%mark-values number)
  (let ((entry (and number (hash-ref %custom-values number #f))))
    (and entry (eq? (car entry) %mark-type) (cdr entry))))

(define (%need-scope who s) (if (not (scope? s)) (error who "s must be a scope, got ~s" s)))

(define (scope-name s)
  (%need-scope 'scope-name s)
  (let ((mark (%mark-values (%scope-mark-number s)))) (and mark (cadr mark))))

(define (scope-property s name [default any? #f])
  (%need-scope 'scope-property s)
  (%need-symbol 'scope-property 'name name)
  (let* ((mark (%mark-values (%scope-mark-number s))) (found (and mark (assq name (third mark)))))
    (if found (cdr found) default)))

(define (find-scopes o [name any? #f] #:flag [flag any? #f] #:where [where any? #f])
  (if (not (or (not name) (symbol? name))) (error 'find-scopes "name must be a symbol, got ~s" name))
  (if (not (or (not flag) (symbol? flag))) (error 'find-scopes "#:flag must be a symbol, got ~s" flag))
  (if where (%need-procedure 'find-scopes '#:where where))
  (let loop ((l (%find-scopes o)) (found '()))
    (if (null? l)
        (reverse found)
        (let ((mark (%mark-values (caar l))))
          (if (and mark (or (not name) (eq? name (cadr mark))) (or (not flag) (flag? (car mark) flag)))
              (let ((s (%scope-found (car mark) (caar l) (cdar l))))
                (loop (cdr l) (if (or (not where) (where s)) (cons s found) found)))
              (loop (cdr l) found))))))

; ---- the tree of a derivation ----

; From the last entry to the first: when a scope is added to its parent's children, its own are complete.
(define (derivation o)
  (if (not (object? o)) (error 'derivation "o must be an object, got ~s" o))
  (let* ((record (or (%derivation-record o)
                     (error 'derivation
                       "no rule gave this object; a derivation is that of an object as a rule gave it, also moved or painted")))
         (n (quotient (vector-length record) 6))
         (entry (lambda (i k) (vector-ref record (+ (* 6 i) k))))
         (below (make-vector n #f))
         (roots '()))
    (do ((i 0 (+ i 1))) ((= i n)) (vector-set! below i (make-vector (entry i 2) '())))
    (do ((i (- n 1) (- i 1)))
        ((< i 0) roots)
      (do ((k (- (entry i 2) 1) (- k 1)))
          ((< k 0))
        (let* ((index (if (= (entry i 2) 1) (entry i 3) k))
               (node (cons (list (entry i 4) (entry i 5) index) (vector-ref (vector-ref below i) k)))
               (parent (entry i 0)))
          (if (= parent i)
              (set! roots (cons node roots))
              (let ((all (vector-ref below parent)) (at (entry i 1)))
                (vector-set! all at (cons node (vector-ref all at))))))))))

; ---- the parts of a split ----

(define (%rule? x) (or (procedure? x) (object? x) (not x)))
(define (%part kind n rule)
  (if (not (and (real? n) (finite? n) (>= n 0))) (error kind "n must be a number from 0 on, got ~s" n))
  (if (not (%rule? rule)) (error kind "rule must be a rule (a procedure of a scope), an object to place, or #f, got ~s" rule))
  (vector kind n rule))
(define (absolute n rule) (%part 'absolute n rule))
(define (relative f rule) (%part 'relative f rule))
; (rest rule) and (rest weight rule), besides (rest list) of lists
(define %list-rest rest)
(define rest
  (case-lambda
    ((l) (if (and (%rule? l) l) (%part 'rest 1 l) (if l (%list-rest l) (%part 'rest 1 #f))))
    ((weight rule) (%part 'rest weight rule))))
