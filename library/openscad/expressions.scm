; Expressions: (expression tree scope) returns a form of Scheme. A tree becomes its form in place, which keeps the place
; in the source.

(define (constant? t) (or (number? t) (string? t) (boolean? t)))

; Returns true if the form may be evaluated any number of times.
(define (simple-form? f) (or (symbol? f) (constant? f)))

(define (expression t s)
  (cond ((constant? t) t)
        (else
         (case (car t)
           ((var) (variable t s))
           ((undef) (becomes-form! t (list (word s 'quote) 'undef)))
           ((+ - * /) (arithmetic t s))
           ((< > <= >=) (comparison t s))
           ((== !=) (equality t s))
           ((% ^) (becomes! t (word s (if (eq? (car t) '%) 'scad:modulo 'scad:power)) (expression (cadr t) s) (expression (caddr t) s)))
           ((&&) (becomes! t (word s 'if) (test (cadr t) s) (truth (caddr t) s) #f))
           ((|\x7C;\x7C;|) (becomes! t (word s 'if) (test (cadr t) s) #t (truth (caddr t) s)))
           ((not) (becomes! t (word s 'if) (test (cadr t) s) #f #t))
           ((negate) (if (number? (cadr t)) (- (cadr t)) (becomes! t (word s 'scad:negate) (expression (cadr t) s))))
           ((plus) (expression (cadr t) s))
           ((?) (becomes! t (word s 'if) (test (cadr t) s) (expression (caddr t) s) (expression (cadddr t) s)))
           ((call) (call t s))
           ((index) (becomes! t (word s 'scad:index) (expression (cadr t) s) (expression (caddr t) s)))
           ((member) (becomes! t (word s 'scad:member) (expression (cadr t) s) (list (word s 'quote) (caddr t))))
           ((list) (list-of-elements t s))
           ((range) (apply becomes! t (word s (if (= (length t) 3) 'scad:range 'scad:range-by)) (map (lambda (e) (expression e s)) (cdr t))))
           ((fn) (function-literal t s))
           ((let) (let-form t s (lambda (inner) (expression (caddr t) inner))))
           ((assert) (sequence t s (lambda () (assertion (cadr t) s)) expression))
           ((echo) (sequence t s (lambda () (echoes (cadr t) s)) expression))
           (else (error "scad-program: unknown tree ~s" (car t)))))))

; (assert ...) value and (echo ...) value; the value may be missing.
(define (sequence t s first value)
  (let ((made (first)))
    (becomes! t (word s 'begin) (becomes-form! (list #f) made) (if (pair? (cddr t)) (value (caddr t) s) (list (word s 'quote) 'undef)))))
(define (argument-list arguments s)
  (cons (word s 'list)
    (map (lambda (a) (list (word s 'cons) (and (car a) (symbol->string (car a))) (expression (cadr a) s))) arguments)))
(define (echoes arguments s) (list (word s 'scad:echo) (argument-list arguments s)))
(define (assertion arguments s)
  (let* ((named (lambda (name n)
           (let ((given (or (assq name arguments) (let ((l (filter (lambda (a) (not (car a))) arguments))) (and (> (length l) n) (list-ref l n))))))
             (and given (cadr given)))))
         (condition (named 'condition 0)) (message (named 'message 1)))
    (if (not condition) (list (word s 'begin))
        (let ((text (source-text condition)))
          (list (word s 'if) (test condition s) #f (list (word s 'scad:failed) text (if message (expression message s) (list (word s 'quote) 'undef))))))))

; ---- variables ----

(define (variable t s)
  (let* ((name (cadr t)) (found (find-variable s name)))
    (cond ((eq? name '$parent_modules) (list (word s 'scad:parent-modules)))
          ((eq? name '$children) (if (scope-kids s) (becomes! t (word s 'scad:kids-count) (scope-kids s)) (unknown-variable t s name)))
          ((special? name) (becomes! t (word s 'scad:special-value) (special-cell s name)))
          (found found)
          ((eq? name 'PI) pi)
          (else (unknown-variable t s name)))))
(define (unknown-variable t s name) (becomes! t (word s 'scad:unknown) "variable" (symbol->string name)))

; ---- truth ----

(define (always-boolean? t) (and (pair? t) (memq (car t) '(&& |\x7C;\x7C;| not == !=)) #t))
(define (truth t s) (if (or (boolean? t) (always-boolean? t)) (expression t s) (list (word s 'scad:true?) (expression t s))))
(define (test t s)
  (cond ((and (pair? t) (memq (car t) '(< > <= >=))) (list (word s 'eq?) #t (expression t s)))
        (else (truth t s))))

; ---- operators: numbers inline, all other values by a procedure ----

; Returns (let (bindings) form), where (make l r) returns the form of the operation on two simple forms.
(define (with-operands t s make)
  (let* ((a (expression (cadr t) s)) (b (expression (caddr t) s))
         (l (if (simple-form? a) a (fresh s 'l))) (r (if (simple-form? b) b (fresh s 'r)))
         (bindings (append (if (eq? l a) '() (list (list l a))) (if (eq? r b) '() (list (list r b))))))
    (if (null? bindings) (make l r) (list (word s 'let) bindings (make l r)))))
(define (guarded s l r fast slow)
  (define (check x rest) (if (number? x) rest (list (word s 'if) (list (word s 'flonum?) x) rest slow)))
  (check l (check r fast)))
(define (number-or-simple? t) (or (number? t) (pair? t)))
(define slow-words '((+ . scad:add) (- . scad:subtract) (* . scad:multiply) (/ . scad:divide) (< . scad:less) (> . scad:more) (<= . scad:less-equal) (>= . scad:more-equal)))
(define (arithmetic t s)
  (let ((op (car t)) (slow (word s (cdr (assq (car t) slow-words)))))
    (if only-translates? (becomes! t slow (expression (cadr t) s) (expression (caddr t) s)) (becomes-form! t (with-operands t s
      (lambda (l r)
        (if (or (string? l) (string? r) (boolean? l) (boolean? r)) (list slow l r)
            (guarded s l r (list (word s op) l r) (list slow l r)))))))))
(define comparison arithmetic)
(define (equality t s)
  (let ((equal (lambda (a b) (list (word s 'scad:equal?) a b))) (same? (eq? (car t) '==)))
    (let ((form (equal (expression (cadr t) s) (expression (caddr t) s))))
      (if same? (becomes-form! t form) (becomes! t (word s 'not) form)))))

; A function that is the value of a variable may call itself by that name. Returns (let ((symbol 'undef)) (set! ...) rest).
(define (function-tree? t) (and (pair? t) (eq? (car t) 'fn)))
(define (own-function s symbol t inner rest)
  (list (word s 'let) (list (list symbol (list (word s 'quote) 'undef))) (list (word s 'set!) symbol (expression t inner)) rest))

; ---- let: each value sees the names before it ----

; Calls (body scope) after the names are in the scope. Special variables get their values for the time of the body.
(define (let-form t s body)
  (let loop ((l (cadr t)) (inner s) (wrap (lambda (form) form)))
    (cond ((null? l) (let ((form (wrap (body inner)))) (if (pair? form) (becomes-form! t form) form)))
          ((not (caar l)) (loop (cdr l) inner wrap))
          ((special? (caar l))
           (let ((value (expression (cadar l) inner)) (cell (special-cell s (caar l))))
             (loop (cdr l) inner (lambda (form) (wrap (list (word s 'scad:with-special) cell value form))))))
          (else
           (let* ((own? (function-tree? (cadar l))) (tree (cadar l)) (value (if own? #f (expression tree inner))) (symbol (new-symbol inner (caar l))) (next (inner-scope inner (list (cons (caar l) symbol)))))
             (loop (cdr l) next
               (lambda (form) (wrap (if own? (own-function s symbol tree next form) (list (word s 'let) (list (list symbol value)) form))))))))))

; ---- lists: elements are added to a list that is in reverse order ----

(define (plain-element? e) (not (and (pair? e) (memq (car e) '(for if each let)) #t)))
(define (list-of-elements t s)
  (if (every plain-element? (cdr t))
      (apply becomes! t (word s 'vector) (map (lambda (e) (expression e s)) (cdr t)))
      (becomes! t (word s 'scad:vector-of) (elements (cdr t) s (list (word s 'quote) '())))))
(define (elements l s all) (in-order l s all (lambda (e all) (element e s all))))
; Returns a form that makes items one after the other: (make item all) is a form for the list `all` with the item's values.
(define (in-order items s all make)
  (cond ((null? items) all)
        ((null? (cdr items)) (make (car items) all))
        (else (let* ((l (fresh s 'all)) (first (make (car items) all))) (list (word s 'let) (list (list l first)) (in-order (cdr items) s l make))))))

; Returns a form for the list `all` (a form) with the values of the element in front.
(define (element e s all)
  (define (bound symbol form make) (if (simple-form? form) (make form) (list (word s 'let) (list (list symbol form)) (make symbol))))
  (cond ((plain-element? e)
         (if (and (pair? e) (memq (car e) '(assert echo)) (pair? (cddr e)) (not (plain-element? (caddr e))))
             (let ((made (if (eq? (car e) 'assert) (assertion (cadr e) s) (echoes (cadr e) s))))
               (becomes! e (word s 'begin) made (element (caddr e) s all)))
             (list (word s 'cons) (expression e s) all)))
        ((eq? (car e) 'each)
         (if (plain-element? (cadr e)) (becomes! e (word s 'scad:each) (expression (cadr e) s) all)
             (becomes! e (word s 'scad:each-of) (element (cadr e) s (list (word s 'quote) '())) all)))
        ((eq? (car e) 'if)
         (let ((l (fresh s 'all)))
           (becomes! e (word s 'let) (list (list l all))
             (list (word s 'if) (test (cadr e) s) (element (caddr e) s l) (if (pair? (cdddr e)) (element (cadddr e) s l) l)))))
        ((eq? (car e) 'let)
         (let ((l (fresh s 'all)))
           (list (word s 'let) (list (list l all)) (let-form e s (lambda (inner) (element (caddr e) inner l))))))
        ((= (length e) 5) (while-loop e s all))
        (else (loops e (cadr e) s all (lambda (inner l) (element (caddr e) inner l))))))

; for (i = values, j = values) ...: (body scope list) returns a form for the list with the values of one turn in front.
(define (loops t names s all body)
  (if (null? names)
      (body s all)
      (let* ((name (or (caar names) 'it)) (values (expression (cadar names) s)) (l (fresh s 'all)) (x (fresh s name)) (dynamic (special? name))
             (inner (if dynamic s (inner-scope s (list (cons name x)))))
             (rest (loops (car names) (cdr names) inner l body)))
        (becomes! t (word s 'scad:fold)
          (list (word s 'lambda) (list x l) (if dynamic (list (word s 'scad:with-special) (special-cell s name) x rest) rest))
          all values))))

; for (i = 0; test; i = next) ... A name that only `next` gives begins with its value outside of the loop.
(define (begun first next s)
  (let ((missing (filter (lambda (n) (and (car n) (not (assq (car n) first)))) next)))
    (append first (map (lambda (n) (list (car n) (if (find-variable s (car n)) (list 'var (car n)) (list 'undef)))) missing))))
(define (while-loop e s all)
  (let* ((loop (fresh s 'loop)) (l (fresh s 'all)) (next (cadddr e)) (first (begun (cadr e) next s)))
    (let begin ((a first) (inner s) (names '()) (wrap (lambda (form) form)))
      (if (pair? a)
          (let* ((value (expression (cadar a) inner)) (symbol (fresh s (or (caar a) 'it))))
            (begin (cdr a) (inner-scope inner (list (cons (caar a) symbol))) (cons (cons (caar a) symbol) names)
              (lambda (form) (wrap (list (word s 'let) (list (list symbol value)) form)))))
          (let* ((names (reverse names)) (symbols (map cdr names))
                 (element-form (let ((in (fresh s 'all))) (list in (element (list-ref e 4) inner in))))
                 (test-form (test (caddr e) inner)))
            (let step ((n next) (turn inner) (updated '()) (wrap-next (lambda (form) form)))
              (if (pair? n)
                  (let* ((value (expression (cadar n) turn)) (symbol (fresh s (or (caar n) 'it))))
                    (step (cdr n) (inner-scope turn (list (cons (caar n) symbol))) (cons (cons (caar n) symbol) updated)
                      (lambda (form) (wrap-next (list (word s 'let) (list (list symbol value)) form)))))
                  (let ((again (append (list loop (cadr element-form)) (map (lambda (b) (let ((u (assq (car b) updated))) (if u (cdr u) (cdr b)))) names))))
                    (becomes-form! e
                      (wrap (list (word s 'let) loop (cons (list l all) (map (lambda (x) (list x x)) symbols))
                              (list (word s 'if) test-form
                                (list (word s 'let) (list (list (car element-form) l))
                                  (list (word s 'let) (list (list (fresh s 'made) (cadr element-form)))
                                    (wrap-next again)))
                                l))))))))))))

; ---- functions ----

; Returns (lambda (parameters) body), which takes a value for each parameter, or the mark scad:absent. (body scope)
; returns the form of the body.
(define (procedure-form parameters s first body)
  (let* ((bound (map (lambda (p) (cons (car p) (if (special? (car p)) (fresh s 'special) (new-symbol s (car p))))) parameters))
         (inner (inner-scope s (filter (lambda (b) (not (special? (car b)))) bound)))
         (absent (word s 'scad:absent)))
    (define (default p b form)
      (list (word s 'let) (list (list (cdr b) (list (word s 'if) (list (word s 'eq?) (cdr b) absent)
                                                (if (pair? (cdr p)) (expression (cadr p) s) (list (word s 'quote) 'undef)) (cdr b)))) form))
    (define (dynamic form)
      (let loop ((l bound))
        (cond ((null? l) form)
              ((special? (caar l)) (list (word s 'scad:with-special) (special-cell s (caar l)) (cdar l) (loop (cdr l))))
              (else (loop (cdr l))))))
    (let ((whole (dynamic (body inner))))
      (list (word s 'lambda) (append first (map cdr bound))
        (let loop ((p parameters) (b bound)) (if (null? p) whole (default (car p) (car b) (loop (cdr p) (cdr b)))))))))

(define (function-literal t s)
  (let ((text (source-text t)) (names (map car (cadr t))))
    (becomes! t (word s 'scad:function) (list (word s 'quote) names) text
      (procedure-form (cadr t) s '() (lambda (inner) (expression (caddr t) inner))))))

; ---- calls ----

(define (call t s)
  (let* ((f (cadr t)) (name (and (pair? f) (eq? (car f) 'var) (cadr f))) (arguments (caddr t)))
    (cond ((or (not name) (and (not (special? name)) (find-variable s name)))
           (call-value t (expression f s) name arguments s))
          ((special? name) (call-value t (expression f s) #f arguments s))
          (else (call-function t name arguments s)))))
(define (call-function t name arguments s)
  (let ((d (find-definition s scope-functions name)))
    (cond (d (call-known t (definition-symbol d) '() (caddr (definition-tree d)) arguments s))
          ((hash-ref builtin-functions name #f) => (lambda (f) (apply becomes! t (word s f) (map (lambda (a) (expression (cadr a) s)) arguments))))
          (else (becomes! t (word s 'scad:unknown) "function" (symbol->string name))))))

; A variable that may contain a function; if it contains none, the name is that of a function of the program.
(define (call-value t f name arguments s)
  (let ((d (and name (find-definition s scope-functions name))) (value (fresh s 'f)))
    (if (or d (and name (hash-ref builtin-functions name #f)))
        (let ((copy (list 'call #f (copy-tree arguments))))
          (becomes! t (word s 'let) (list (list value f))
            (list (word s 'if) (list (word s 'scad:function?) value)
              (list (word s 'scad:call) value (argument-values arguments s))
              (call-function copy name (caddr copy) s))))
        (becomes! t (word s 'scad:call) f (argument-values arguments s)))))
(define (argument-values arguments s)
  (cons (word s 'list)
    (map (lambda (a) (list (word s 'cons) (and (car a) (list (word s 'quote) (car a))) (expression (cadr a) s))) arguments)))
(define (copy-tree t) (if (pair? t) (cons (copy-tree (car t)) (copy-tree (cdr t))) t))

; A call of a procedure whose parameters are known: names become places. first: forms of arguments before these.
(define (call-known t symbol first parameters arguments s)
  (let* ((n (length parameters)) (values (make-vector n #f)) (absent (word s 'scad:absent)))
    (define (place-of name) (let loop ((l parameters) (i 0)) (cond ((null? l) #f) ((eq? (caar l) name) i) (else (loop (cdr l) (+ i 1))))))
    (let loop ((l arguments) (next 0) (bindings '()) (specials '()) (warnings '()))
      (if (pair? l)
          (let* ((name (caar l)) (i (if name (place-of name) next)) (form (expression (cadar l) s)))
            (cond ((and i (< i n))
                   (if (vector-ref values i)
                       (loop (cdr l) (if name next (+ next 1)) bindings specials warnings)
                       (begin (vector-set! values i (list form)) (loop (cdr l) (if name next (+ next 1)) bindings specials warnings))))
                  ((and name (special? name)) (loop (cdr l) next bindings (cons (cons (special-cell s name) form) specials) warnings))
                  (else (loop (cdr l) (if name next (+ next 1)) bindings specials
                          (cons (if name (list (word s 'scad:unknown-argument) (symbol->string name)) (list (word s 'scad:too-many))) warnings)))))
          (let* ((values (map (lambda (v) (if v (car v) absent)) (vector->list values)))
                 (form (append (list symbol) first values))
                 (form (fold (lambda (b form) (list (word s 'scad:with-special) (car b) (cdr b) form)) form specials)))
            (if (null? warnings) (becomes-form! t form)
                (becomes-form! t (append (list (word s 'begin)) (reverse warnings) (list (becomes-form! (list #f) form))))))))))

; ---- the text of an expression, as messages and values of functions show it ----

(define (joined l) (if (null? l) "" (fold (lambda (x all) (string-append all ", " x)) (car l) (cdr l))))
(define (named-text p) (if (pair? (cdr p)) (string-append (symbol->string (car p)) " = " (source-text (cadr p))) (symbol->string (car p))))
(define (argument-text a) (if (car a) (string-append (symbol->string (car a)) " = " (source-text (cadr a))) (source-text (cadr a))))
(define (number-text x) (if (and (integer? x) (< (abs x) 1e6)) (number->string (exact x)) (number->string x)))
(define (source-text t)
  (define (in-brackets before l after) (string-append before (joined (map source-text l)) after))
  (cond ((number? t) (number-text t)) ((string? t) (string-append "\"" t "\"")) ((boolean? t) (if t "true" "false"))
        (else
         (case (car t)
           ((var) (symbol->string (cadr t)))
           ((undef) "undef")
           ((not) (string-append "!" (source-text (cadr t))))
           ((negate) (string-append "-" (source-text (cadr t))))
           ((plus) (source-text (cadr t)))
           ((?) (string-append "(" (source-text (cadr t)) " ? " (source-text (caddr t)) " : " (source-text (cadddr t)) ")"))
           ((call) (string-append (source-text (cadr t)) "(" (joined (map argument-text (caddr t))) ")"))
           ((index) (string-append (source-text (cadr t)) "[" (source-text (caddr t)) "]"))
           ((member) (string-append (source-text (cadr t)) "." (symbol->string (caddr t))))
           ((list) (in-brackets "[" (cdr t) "]"))
           ((range) (string-append "[" (source-text (cadr t)) " : " (source-text (caddr t)) (if (pair? (cdddr t)) (string-append " : " (source-text (cadddr t))) "") "]"))
           ((fn) (string-append "function(" (joined (map named-text (cadr t))) ") " (source-text (caddr t))))
           ((let assert echo) (string-append (symbol->string (car t)) "(" (joined (map argument-text (cadr t))) ")" (if (pair? (cddr t)) (string-append " " (source-text (caddr t))) "")))
           ((each) (string-append "each " (source-text (cadr t))))
           ((for) (string-append "for(" (joined (map argument-text (cadr t))) ") " (source-text (list-ref t (- (length t) 1)))))
           ((if) (string-append "if(" (source-text (cadr t)) ") " (source-text (caddr t)) (if (pair? (cdddr t)) (string-append " else " (source-text (cadddr t))) "")))
           (else (string-append "(" (source-text (cadr t)) " " (symbol->string (car t)) " " (source-text (caddr t)) ")"))))))
