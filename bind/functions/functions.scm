; Functions that keep their expression, and derivatives of any procedure of numbers. After primitives.scm. Names that
; begin with % are hidden from programs. Compiled into the binary when it is built.
;
; A function is a procedure with a note: #(name parameters tree values ranges expression). The tree is the expression with
; its names resolved: a number, (input i), (local i), (free i), (let i tree tree), (call i tree ...) and
; (operator tree ...). `values` is a procedure that returns the list of the current values of the expression's free names.
; %function-tape makes a tape of the tree, which C evaluates (geometry/functions/).

; ---- derivatives ----

; Returns the derivative of v by the variable of this level; of lists and vectors part by part.
(define (%slope who level v)
  (let loop ((v v))
    (cond
      ((pair? v) (cons (loop (car v)) (loop (cdr v))))
      ((null? v) '())
      ((vector? v) (vector-map loop v))
      ((%dual-slope level v))
      (else (error who "f must give a number, a point, a gvector or a list of them, got ~s" v)))))

(define (%need-variable who x)
  (if (not (number? x)) (error who "x must be a number, got ~s" x)))

(define derivative
  (case-lambda
    ((f) (%need-procedure 'derivative 'f f) (lambda (x) (derivative f x)))
    ((f x)
     (%need-procedure 'derivative 'f f)
     (%need-variable 'derivative x)
     (let ((level (%dual-level)))
       (%slope 'derivative level (f (%dual level x 1)))))))

; Returns the partial derivative by argument number i, from 0.
(define (%partial who f xs i)
  (let ((level (%dual-level)))
    (%slope who level
      (apply f (let loop ((l xs) (k 0)) (if (= k i) (cons (%dual level (car l) 1) (cdr l)) (cons (car l) (loop (cdr l) (+ k 1)))))))))

(define (%need-variables who f xs)
  (%need-procedure who 'f f)
  (if (null? xs) (error who "takes a procedure and the numbers at which it is differentiated"))
  (for-each (lambda (x) (%need-variable who x)) xs))

(define (%partials who f xs) (map (lambda (i) (%partial who f xs i)) (iota (length xs))))

; Returns a gvector for a procedure of a point; for one of numbers, the list of its partial derivatives.
(define (gradient f . xs)
  (if (and (= (length xs) 1) (point? (car xs)))
      (let ((along (lambda (v)
                     (let* ((level (%dual-level)) (slope (%slope 'gradient level (f (%dual level (car xs) v)))))
                       (if (number? slope) slope (error 'gradient "f must give a number, got ~s" (f (car xs))))))))
        (%need-procedure 'gradient 'f f)
        (vxyz (along (vxyz 1 0 0)) (along (vxyz 0 1 0)) (along (vxyz 0 0 1))))
      (begin
        (%need-variables 'gradient f xs)
        (let ((slopes (%partials 'gradient f xs)))
          (if (not (number? (car slopes))) (error 'gradient "f must give a number, got ~s; jacobian takes what gives several" (apply f xs)))
          slopes))))

; Returns a list of rows, one for each number of f's value, with a column for each argument.
(define (jacobian f . xs)
  (define (numbers v)
    (cond ((number? v) (list v)) ((vector? v) (vector->list v)) ((list? v) v) (else (list (cx v) (cy v) (cz v)))))
  (%need-variables 'jacobian f xs)
  (apply map list (map numbers (%partials 'jacobian f xs))))

; Returns a list of rows of second derivatives.
(define (hessian f . xs)
  (%need-variables 'hessian f xs)
  (map (lambda (i)
         (map (lambda (j)
                (let ((d (%partial 'hessian (lambda ys (%partial 'hessian f ys i)) xs j)))
                  (if (number? d) d (error 'hessian "f must give a number, got ~s" (apply f xs)))))
              (iota (length xs))))
       (iota (length xs))))

; ---- define-function ----

(define (%need-range who name r)
  (if (not (and (list? r) (= (length r) 3) (every real? r)))
      (error who "the range of ~a must be (a b n): from a to b in n steps, got ~s" name r))
  (if (not (and (finite? (first r)) (finite? (second r)) (< (first r) (second r))))
      (error who "the range of ~a must go from a smaller number to a larger one, got ~s" name r))
  (if (not (and (exact-integer? (third r)) (positive? (third r))))
      (error who "the range of ~a must have one step or more, got ~s" name r))
  r)

(define-syntax define-function
  (er-macro-transformer
    (lambda (form rename compare)
      (define (refuse text . what) (cons* (rename 'syntax-error) (string-append "define-function: " text) what))
      (define usage "it is written (define-function (f x ...) expression), with ranges as in #:x (0 1 10)")
      (define (keyword x)
        (let ((text (and (identifier? x) (symbol->string (syntax->datum x)))))
          (and text (> (string-length text) 2) (string=? (substring text 0 2) "#:") (string->symbol (substring text 2)))))
      (define (is? x name) (and (identifier? x) (compare x (rename name))))
      (define free '()) ; identifiers, newest first
      (define locals 0)
      (define (free-number x)
        (let ((found (memq x free)))
          (if found
              (- (length found) 1)
              (begin (set! free (cons x free)) (- (length free) 1)))))
      (define operators
        '(+ - * / square sqr abs magnitude sqrt cube-root exp log sin cos tan asin acos atan sinh cosh tanh expt min max floor ceiling
          < <= = > >= zero? positive? negative? not and or hypot 1+ add1 -1+ sub1 sgn inexact exact->inexact
          xyz vxyz xy cx cy cz dot cross vlength distance unitize p+v p-v p-p p->q v+v v-v v*r v/r degrees->radians radians->degrees))
      ; returns the tree of x; `names` is an association list of identifiers and trees
      (define (tree x names)
        (define (trees l) (map (lambda (y) (tree y names)) l))
        (define (wrong) (bad x))
        (cond
          ((identifier? x)
           (let ((known (assq x names)))
             (if known (cdr known) (list 'free (free-number x)))))
          ((real? x) x)
          ((not (and (pair? x) (list? x))) (wrong))
          ((not (identifier? (car x))) (wrong))
          ((assq (car x) names) (wrong))
          ((is? (car x) 'if)
           (if (= (length x) 4) (cons 'if (trees (cdr x))) (bad x)))
          ((is? (car x) 'cond)
           (let loop ((clauses (cdr x)))
             (cond
               ((or (null? clauses) (not (list? (car clauses))) (not (= (length (car clauses)) 2))) (wrong))
               ((is? (caar clauses) 'else) (tree (cadar clauses) names))
               (else (list 'if (tree (caar clauses) names) (tree (cadar clauses) names) (loop (cdr clauses)))))))
          ((or (is? (car x) 'let) (is? (car x) 'let*))
           (if (and (= (length x) 3) (list? (cadr x))
                    (every (lambda (b) (and (list? b) (= (length b) 2) (identifier? (car b)))) (cadr x)))
               (let loop ((bindings (cadr x)) (inner names))
                 (if (null? bindings)
                     (tree (caddr x) inner)
                     (let ((number locals) (value (tree (cadar bindings) (if (is? (car x) 'let) names inner))))
                       (set! locals (+ locals 1))
                       (list 'let number value (loop (cdr bindings) (cons (cons (caar bindings) (list 'local number)) inner))))))
               (wrong)))
          ((find (lambda (name) (is? (car x) name)) operators) => (lambda (name) (cons name (trees (cdr x)))))
          (else (let ((number (free-number (car x)))) (cons* 'call number (trees (cdr x)))))))
      (define (parameter? p) (or (identifier? p) (and (list? p) (= (length p) 2) (identifier? (car p))))) ; x or [x predicate]
      (define trouble #f)
      (define (bad x) (if (not trouble) (set! trouble (list x))) 0)
      ; returns the expression and the ranges, from the forms after the head
      (define (parts forms)
        (let loop ((l forms) (expressions '()) (ranges '()))
          (cond
            ((null? l) (list (reverse expressions) (reverse ranges)))
            ((and (keyword (car l)) (pair? (cdr l))) (loop (cddr l) expressions (cons (cons (keyword (car l)) (cadr l)) ranges)))
            (else (loop (cdr l) (cons (car l) expressions) ranges)))))
      (if (not (and (list? form) (>= (length form) 3) (pair? (cadr form)) (list? (cadr form)) (identifier? (caadr form))
                    (every parameter? (cdadr form)) (not (any keyword (cadr form)))))
          (refuse usage)
          (let* ((name (caadr form)) (parameters (map (lambda (p) (if (pair? p) (car p) p)) (cdadr form))) (found (parts (cddr form))) (expressions (car found)) (ranges (cadr found))
                 (plain (map syntax->datum parameters)) (stray (find (lambda (r) (not (memq (car r) plain))) ranges)))
            (cond
              ((not (= (length expressions) 1)) (refuse (if (null? expressions) usage "its body is one expression; a function has no steps")))
              ((or (null? parameters) (> (length parameters) 16)) (refuse "a function has from 1 to 16 parameters"))
              (stray (refuse "this range is of no parameter:" (car stray)))
              ((find (lambda (r) (not (and (list? (cdr r)) (= (length (cdr r)) 3)))) ranges)
               => (lambda (r) (refuse "a range is written (a b n), from a to b in n steps, not" (cdr r))))
              (else
                (let* ((expression (car expressions))
                       (body (tree expression (map (lambda (p i) (cons p (list 'input i))) parameters (iota (length parameters))))))
                  (if trouble
                      (refuse "its expression is made of numbers, arithmetic, elementary functions, points, if, let and calls of other functions; this is something else:"
                        (car trouble))
                      `(,(rename 'define) ,name
                        (,(rename '%function)
                          (,(rename 'let) () (,(rename 'define) ,(cadr form) ,expression) ,name)
                          (,(rename 'vector) (,(rename 'quote) ,(syntax->datum name)) (,(rename 'quote) ,plain) (,(rename 'quote) ,body)
                            (,(rename 'lambda) () (,(rename 'list) ,@(reverse free)))
                            (,(rename 'list) ,@(map (lambda (r)
                                       `(,(rename 'cons) (,(rename 'quote) ,(car r))
                                          (,(rename '%need-range) 'define-function (,(rename 'quote) ,(car r)) (,(rename 'list) ,@(cdr r)))))
                                     ranges))
                            (,(rename 'quote) ,(syntax->datum expression)))))))))))))) 

(define (%note who f)
  (or (%function-note f)
      (error who (if (procedure? f)
                     "f must be a function that keeps its expression, made by define-function, got ~s"
                     "f must be a function made by define-function, got ~s")
        f)))
(define (%note-name note) (vector-ref note 0))
(define (%note-parameters note) (vector-ref note 1))

(define (function? x) (and (procedure? x) (%function-note x) #t))
(define (function-expression f) (vector-ref (%note 'function-expression f) 5))
(define (function-parameters f) (%note-parameters (%note 'function-parameters f)))
; Returns the ranges by parameter, as define-function got them.
(define (function-ranges f) (vector-ref (%note 'function-ranges f) 4))

; ---- from trees to tapes ----

; A point or gvector among steps is #(tag x y z); a number is the number of a step.
(define (%function-tape who f)
  (let* ((note (%note who f)) (t (%tape-new (length (%note-parameters note))))
         (result (%tape-call who t note (map (lambda (i) (%tape-input t i)) (iota (length (%note-parameters note)))) '())))
    (if (vector? result)
        (%tape-done t (vector-ref result 1) (vector-ref result 2) (vector-ref result 3))
        (%tape-done t result))))

(define (%tape-call who t note inputs around)
  (define name (%note-name note))
  (define locals (make-hash))
  (define values (list->vector ((vector-ref note 3))))
  (define (fail text . more) (apply error who (string-append "in the expression of ~a: " text) name more))
  (define (op name . of) (apply %tape-op t name of))
  (define (number v) (if (vector? v) (fail "a ~a stands where a number belongs" (vector-ref v 0)) v))
  (define (constant x) (%tape-constant t x))
  (define (three v what) (if (vector? v) v (fail "a number stands where ~a belongs" what)))
  (define (tagged tag f . vs)
    (vector tag (apply f (map (lambda (v) (vector-ref v 1)) vs)) (apply f (map (lambda (v) (vector-ref v 2)) vs))
      (apply f (map (lambda (v) (vector-ref v 3)) vs))))
  (define (add a b)
    (cond
      ((and (vector? a) (vector? b))
       (if (and (eq? (vector-ref a 0) 'point) (eq? (vector-ref b 0) 'point)) (fail "points do not add"))
       (tagged (if (or (eq? (vector-ref a 0) 'point) (eq? (vector-ref b 0) 'point)) 'point 'gvector) (lambda (x y) (op '+ x y)) a b))
      (else (op '+ (number a) (number b)))))
  (define (subtract a b)
    (cond
      ((and (vector? a) (vector? b))
       (tagged (if (and (eq? (vector-ref a 0) 'point) (eq? (vector-ref b 0) 'gvector)) 'point 'gvector) (lambda (x y) (op '- x y)) a b))
      (else (op '- (number a) (number b)))))
  (define (multiply a b)
    (cond
      ((vector? b) (tagged 'gvector (lambda (x) (op '* x (number a))) b))
      ((vector? a) (tagged 'gvector (lambda (x) (op '* x b)) a))
      (else (op '* a b))))
  (define (divide a b) (if (vector? a) (tagged 'gvector (lambda (x) (op '/ x (number b))) a) (op '/ a (number b))))
  (define (dot a b)
    (let ((a (three a "a gvector")) (b (three b "a gvector")))
      (op '+ (op '+ (op '* (vector-ref a 1) (vector-ref b 1)) (op '* (vector-ref a 2) (vector-ref b 2))) (op '* (vector-ref a 3) (vector-ref b 3)))))
  (define (long v) (op 'sqrt (dot v v)))
  (define (cross a b)
    (define (minor i j) (op '- (op '* (vector-ref a i) (vector-ref b j)) (op '* (vector-ref a j) (vector-ref b i))))
    (vector 'gvector (minor 2 3) (minor 3 1) (minor 1 2)))
  (define (fold-left f l) (let loop ((sum (car l)) (l (cdr l))) (if (null? l) sum (loop (f sum (car l)) (cdr l)))))
  ; the value of a test is 1 or 0
  (define (both a b) (op 'if a b (constant 0)))
  (define (chain f l) (if (null? (cdr l)) (constant 1) (let loop ((l l)) (let ((one (f (car l) (cadr l)))) (if (null? (cddr l)) one (both one (loop (cdr l))))))))
  (define (need n l head) (if (not (memv (length l) n)) (fail "~a takes ~a argument~a, got ~a" head (car n) (if (= (car n) 1) "" "s") (length l))))
  (define (apply-operator head l)
    (define (a) (car l))
    (define (b) (cadr l))
    (define (plain n) (need (list n) l head) (for-each number l))
    (case head
      ((+) (if (null? l) (constant 0) (fold-left add l)))
      ((*) (if (null? l) (constant 1) (fold-left multiply l)))
      ((-) (cond ((null? l) (need '(1) l head)) ((null? (cdr l)) (if (vector? (a)) (tagged 'gvector (lambda (x) (op '- x)) (a)) (op '- (a)))) (else (fold-left subtract l))))
      ((/) (cond ((null? l) (need '(1) l head)) ((null? (cdr l)) (op '/ (constant 1) (number (a)))) (else (fold-left divide l))))
      ((min max) (if (null? l) (need '(1) l head)) (for-each number l) (fold-left (lambda (x y) (op head x y)) l))
      ((< <= =) (if (null? l) (need '(2) l head)) (for-each number l) (chain (lambda (x y) (op head x y)) l))
      ((>) (if (null? l) (need '(2) l head)) (for-each number l) (chain (lambda (x y) (op '< y x)) l))
      ((>=) (if (null? l) (need '(2) l head)) (for-each number l) (chain (lambda (x y) (op '<= y x)) l))
      ((zero?) (plain 1) (op '= (a) (constant 0)))
      ((positive?) (plain 1) (op '< (constant 0) (a)))
      ((negative?) (plain 1) (op '< (a) (constant 0)))
      ((not) (plain 1) (op 'if (a) (constant 0) (constant 1)))
      ((and) (if (null? l) (constant 1) (let loop ((l l)) (if (null? (cdr l)) (car l) (both (number (car l)) (loop (cdr l)))))))
      ((or) (if (null? l) (constant 0) (let loop ((l l)) (if (null? (cdr l)) (car l) (op 'if (number (car l)) (constant 1) (loop (cdr l)))))))
      ((sqr) (plain 1) (op 'square (a)))
      ((magnitude) (plain 1) (op 'abs (a)))
      ((1+ add1) (plain 1) (op '+ (a) (constant 1)))
      ((-1+ sub1) (plain 1) (op '- (a) (constant 1)))
      ((inexact exact->inexact) (plain 1) (a))
      ((sgn) (plain 1) (op 'if (op '< (a) (constant 0)) (constant -1) (op 'if (op '< (constant 0) (a)) (constant 1) (constant 0))))
      ((hypot) (plain 2) (op 'sqrt (op '+ (op 'square (a)) (op 'square (b)))))
      ((degrees->radians) (plain 1) (op '* (a) (constant (/ pi 180))))
      ((radians->degrees) (plain 1) (op '* (a) (constant (/ 180 pi))))
      ((log) (need '(1 2) l head) (for-each number l) (if (null? (cdr l)) (op 'log (a)) (op '/ (op 'log (a)) (op 'log (b)))))
      ((atan) (need '(1 2) l head) (for-each number l) (apply op 'atan l))
      ((xyz) (plain 3) (apply vector 'point l))
      ((xy) (plain 2) (vector 'point (a) (b) (constant 0)))
      ((vxyz) (plain 3) (apply vector 'gvector l))
      ((cx) (need '(1) l head) (vector-ref (three (a) "a point") 1))
      ((cy) (need '(1) l head) (vector-ref (three (a) "a point") 2))
      ((cz) (need '(1) l head) (vector-ref (three (a) "a point") 3))
      ((dot) (need '(2) l head) (dot (a) (b)))
      ((cross) (need '(2) l head) (cross (three (a) "a gvector") (three (b) "a gvector")))
      ((vlength) (need '(1) l head) (long (three (a) "a gvector")))
      ((unitize) (need '(1) l head) (divide (three (a) "a gvector") (long (a))))
      ((distance) (need '(2) l head) (long (subtract (three (a) "a point") (three (b) "a point"))))
      ((p->q) (need '(2) l head) (subtract (three (b) "a point") (three (a) "a point")))
      ((p-p v-v p-v) (need '(2) l head) (subtract (three (a) "a point") (three (b) "a point")))
      ((p+v v+v) (need '(2) l head) (add (three (a) "a point") (three (b) "a gvector")))
      ((v*r) (need '(2) l head) (multiply (three (a) "a gvector") (number (b))))
      ((v/r) (need '(2) l head) (divide (three (a) "a gvector") (number (b))))
      (else (for-each number l) (or (apply op head l) (fail "~a does not take ~a argument~a" head (length l) (if (= (length l) 1) "" "s"))))))
  (define (choose test then other)
    (if (and (vector? then) (vector? other))
        (tagged (vector-ref then 0) (lambda (x y) (op 'if test x y)) then other)
        (op 'if test (number then) (number other))))
  (define (value-of v)
    (cond
      ((number? v) (constant v))
      ((or (point? v) (gvector? v)) (vector (if (point? v) 'point 'gvector) (constant (cx v)) (constant (cy v)) (constant (cz v))))
      (else (fail "a name stands for ~s, which is neither a number nor a point" v))))
  (define (walk x)
    (if (number? x)
        (constant x)
        (case (car x)
          ((input) (list-ref inputs (cadr x)))
          ((local) (hash-ref locals (cadr x)))
          ((free) (value-of (vector-ref values (cadr x))))
          ((let) (hash-set! locals (cadr x) (walk (caddr x))) (walk (cadddr x)))
          ((field) (apply %tape-field t (vector-ref values (cadr x)) (map walk (cddr x))))
          ((if) (choose (number (walk (cadr x))) (walk (caddr x)) (walk (cadddr x))))
          ((call)
           (let* ((f (vector-ref values (cadr x))) (inner (and (procedure? f) (%function-note f))) (arguments (map walk (cddr x))))
             (cond
               ((not inner) (fail "~s is called, which keeps no expression; define it by define-function too" f))
               ((or (eq? inner note) (memq inner around)) (fail "~a calls itself; an expression has an end" (%note-name inner)))
               ((not (= (length arguments) (length (%note-parameters inner))))
                (fail "~a takes ~a arguments, got ~a" (%note-name inner) (length (%note-parameters inner)) (length arguments)))
               (else (%tape-call who t inner arguments (cons note around))))))
          (else (apply-operator (car x) (map walk (cdr x)))))))
  (walk (vector-ref note 2)))

; ---- text for other programs ----

(define (function-text f language)
  (let ((number (list-index (lambda (l) (eq? l language)) '(povray openscad javascript))) (note (%note 'function-text f)))
    (if (not number) (error 'function-text "language must be one of 'povray, 'openscad, 'javascript, got ~s" language))
    (let* ((t (%function-tape 'function-text f))
           (text (lambda (i)
                   (or (%function-text t i number (map %plain-name (%note-parameters note)))
                       (error 'function-text "the expression of ~a has more than 100000 characters, or holds the distance from a solid" (%note-name note))))))
      (if (= (%tape-outputs t) 3) (map text '(0 1 2)) (text 0)))))

; Returns a parameter's name in the spelling of other languages.
(define (%plain-name name)
  (let ((text (string-map (lambda (c) (if (or (char<=? #\a c #\z) (char<=? #\A c #\Z) (char<=? #\0 c #\9)) c #\_)) (symbol->string name))))
    (string->symbol (if (char<=? #\0 (string-ref text 0) #\9) (string-append "_" text) text))))

; ---- values over ranges ----

(define %most-samples 10000000)

; Returns the ranges of f's parameters as lists (a b n): the given ones, otherwise those of its definition. n counts the
; values, both ends included.
(define (%ranges who f given)
  (let* ((note (%function-note f)) (own (if note (vector-ref note 4) '()))
         (ranges (cond
                   ((pair? given) given)
                   ((and note (pair? own))
                    (map (lambda (p)
                           (let ((found (assq p own)))
                             (if found (cdr found) (error who "~a has no range; give one for each parameter, as in '(0 1 10)" p))))
                      (%note-parameters note)))
                   (else (error who "f has no ranges; give one for each parameter, as in '(0 1 10)")))))
    (if (and note (not (= (length ranges) (length (%note-parameters note)))))
        (error who "~a has ~a parameters, got ~a ranges" (%note-name note) (length (%note-parameters note)) (length ranges)))
    (for-each (lambda (r i) (%need-range who (if note (list-ref (%note-parameters note) i) (+ i 1)) r)) ranges (iota (length ranges)))
    (let ((samples (apply * (map third ranges))))
      (if (> samples %most-samples)
          (error who "~a values are asked for, and at most ~a are given at a time" samples %most-samples)))
    ranges))

; Returns the numbers of a range.
(define (%range-values r) (if (= (third r) 1) (list (first r)) (division (first r) (second r) (- (third r) 1))))

; Returns a vector of the values of f at all points of the grid, the last parameter's range innermost.
(define (function-samples f . ranges)
  (%need-procedure 'function-samples 'f f)
  (let ((ranges (%ranges 'function-samples f ranges)))
    (if (%function-note f)
        (%tape-samples (%function-tape 'function-samples f) (list->vector (map list->vector ranges)))
        (list->vector
          (let loop ((ranges ranges) (given '()))
            (if (null? ranges)
                (list (apply f (reverse given)))
                (append-map (lambda (x) (loop (cdr ranges) (cons x given))) (%range-values (car ranges)))))))))

; Returns an interval that contains every value of f over these intervals and numbers.
(define (function-bounds f . intervals)
  (let ((note (%note 'function-bounds f)))
    (if (not (= (length intervals) (length (%note-parameters note))))
        (error 'function-bounds "~a has ~a parameters, got ~a intervals" (%note-name note) (length (%note-parameters note)) (length intervals)))
    (let ((t (%function-tape 'function-bounds f)))
      (if (= (%tape-outputs t) 3) (error 'function-bounds "~a gives points; bounds are of numbers" (%note-name note)))
      (%function-bounds t (list->vector intervals)))))

; Returns a number's text with at most six places.
(define (%six x)
  (let* ((scaled (exact (round (* (abs x) 1000000)))) (whole (quotient scaled 1000000)) (part (remainder scaled 1000000))
         (digits (substring (number->string (+ 1000000 part)) 1 7))
         (end (let loop ((n 6)) (if (and (> n 0) (char=? (string-ref digits (- n 1)) #\0)) (loop (- n 1)) n))))
    (string-append (if (and (< x 0) (> scaled 0)) "-" "") (number->string whole) (if (= end 0) "" ".") (substring digits 0 end))))

(define (%value-text who v)
  (define (number x) (if (and (real? x) (finite? x)) (%six x) (if (real? x) "no number" (error who "f must give a number or a point, got ~s" v))))
  (if (or (point? v) (gvector? v))
      (string-append "<" (number (cx v)) ", " (number (cy v)) ", " (number (cz v)) ">")
      (number v)))

; Prints the table of f's values: a line for each point of the grid, the last parameter's range innermost.
(define (tabulate f . ranges)
  (%need-procedure 'tabulate 'f f)
  (let* ((ranges (%ranges 'tabulate f ranges)) (note (%function-note f)) (name (if note (%note-name note) 'f)))
    (let loop ((ranges ranges) (given '()))
      (if (pair? ranges)
          (for-each (lambda (x) (loop (cdr ranges) (cons x given))) (%range-values (car ranges)))
          (printf "~a(~a) = ~a\n" name (string-join (map %six (reverse given)) ", ") (%value-text 'tabulate (apply f (reverse given))))))))

; ---- shapes ----

; Returns a function as a tape with these counts of inputs and outputs.
(define (%tape-for who f inputs outputs)
  (let ((note (%note who f)))
    (if (not (= (length (%note-parameters note)) inputs))
        (error who "f must be a function of ~a numbers, ~a has ~a" inputs (%note-name note) (length (%note-parameters note))))
    (let ((t (%function-tape who f)))
      (if (not (= (%tape-outputs t) outputs))
          (error who "~a must give ~a" (%note-name note) (if (= outputs 1) "a number" "a point")))
      t)))

; Returns the largest slope of f at places in the whole box and at points of the mesh. POV-Ray needs it for its steps
; along rays.
(define (%steepest f p q points)
  (define (slope x y z)
    (guard (c (#t 0))
      (let ((d (vlength (apply vxyz (gradient f x y z))))) (if (finite? d) d 0))))
  (define (axis take) (division (take p) (take q) 9))
  (let ((grid (apply max (append-map (lambda (x) (append-map (lambda (y) (map (lambda (z) (slope x y z)) (axis cz))) (axis cy))) (axis cx))))
        (step (max 1 (quotient (length points) 1500))))
    (let loop ((l points) (i 0) (most grid))
      (if (null? l) most (loop (cdr l) (+ i 1) (if (= 0 (remainder i step)) (max most (slope (cx (car l)) (cy (car l)) (cz (car l)))) most))))))

; Returns the mesh for all formats but POV-Ray, which gets the expression itself.
(define (%exact-isosurface f t p q mesh)
  (let ((text (%function-text t 0 0 '(x y z))))
    (if (not text)
        (error 'make-isosurface "#:exact is for functions that POV-Ray can work out; that of ~a is too long, or holds the distance from a solid"
          (vector-ref (%function-note f) 0))
        (let* ((points (first (object-arguments mesh))) (steep (* 1.25 (max 1e-6 (%steepest f p q points)))) (size (vlength (p->q p q))))
          (native 'povray
            (format "isosurface { function { ~a } contained_by { box { <~a, ~a, ~a>, <~a, ~a, ~a> } } accuracy ~a max_gradient ~a }" text
              (inexact (cx p)) (inexact (cy p)) (inexact (cz p)) (inexact (cx q)) (inexact (cy q)) (inexact (cz q)) (* 1e-6 size) steep)
            #:otherwise mesh)))))

(define (make-isosurface f p q #:level [level any? 0] #:tolerance [tolerance any? #f] #:cells [cells any? #f] #:exact [exact any? #f])
  (if (not (and (real? level) (finite? level))) (error 'make-isosurface "level must be a number, got ~s" level))
  (let* ((t (%tape-level (%tape-for 'make-isosurface f 3 1) level))
         (mesh (cond
                 (tolerance (%make-isosurface t p q #:tolerance tolerance))
                 (cells (%make-isosurface t p q #:cells cells))
                 (else (%make-isosurface t p q)))))
    (if exact (%exact-isosurface f t p q mesh) mesh)))

; ---- mathematics ----

(define-function (cot [x number?]) (/ 1 (tan x)))
(define-function (sec [x number?]) (/ 1 (cos x)))
(define-function (csc [x number?]) (/ 1 (sin x)))
(define-function (acot [x number?]) (- (/ pi 2) (atan x)))
(define-function (asec [x number?]) (acos (/ 1 x)))
(define-function (acsc [x number?]) (asin (/ 1 x)))
(define-function (asinh [x number?]) (log (+ x (sqrt (+ (square x) 1)))))
(define-function (log10 [x positive?]) (/ (log x) (log 10)))
(define-function (log2 [x positive?]) (/ (log x) (log 2)))
(define-function (root [x number?] [n number?]) (expt x (/ 1 n)))
(define-function (sawtooth [x number?]) (- x (floor x)))
(define-function (gauss [x number?]) (/ (exp (* -1/2 (square x))) (sqrt (* 2 pi))))
(define (%number>=1? x) (and (real? x) (>= x 1)))
(define (%number-within-1? x) (and (real? x) (< -1 x 1)))
(define-function (acosh [x %number>=1?]) (log (+ x (sqrt (- (square x) 1)))))
(define-function (atanh [x %number-within-1?]) (* 1/2 (log (/ (+ 1 x) (- 1 x)))))

(define (%need-natural who name n)
  (if (not (and (exact-integer? n) (<= 0 n 100000))) (error who "~a must be an exact integer from 0 to 100000, got ~s" name n)))
(define (%product low high) (let loop ((i low) (p 1)) (if (> i high) p (loop (+ i 1) (* p i)))))
(define (factorial n)
  (%need-natural 'factorial 'n n)
  (%product 1 n))
; The number of choices of k out of n things, with and without regard to their order.
(define (permutations n k)
  (%need-natural 'permutations 'n n)
  (%need-natural 'permutations 'k k)
  (if (> k n) 0 (%product (+ (- n k) 1) n)))
(define (combinations n k)
  (%need-natural 'combinations 'n n)
  (%need-natural 'combinations 'k k)
  (if (> k n) 0 (let ((k (min k (- n k)))) (/ (%product (+ (- n k) 1) n) (%product 1 k)))))

; Returns the Taylor polynomial of f about a, of degree n, as a procedure.
(define (taylor f a n)
  (%need-procedure 'taylor 'f f)
  (%need-variable 'taylor a)
  (if (not (and (exact-integer? n) (<= 0 n 12))) (error 'taylor "n must be an exact integer from 0 to 12, got ~s" n))
  (let ((terms (let loop ((i 0) (f f) (below 1))
                 (if (> i n) '() (cons (/ (f a) below) (loop (+ i 1) (derivative f) (* below (+ i 1))))))))
    (lambda (x) (fold-right (lambda (c sum) (+ c (* (- x a) sum))) 0 terms))))

; Returns a parameter's value at the place of the call: define-parameter without a name in the program.
(define (range-control name low high [default any? #f])
  (if (not (string? name)) (error 'range-control "name must be a string, got ~s" name))
  (if (not (and (real? low) (real? high) (finite? low) (finite? high) (< low high)))
      (error 'range-control "low and high must be numbers, low below high, got ~s and ~s" low high))
  (%define-parameter (string->symbol name) (or default (/ (+ low high) 2)) #:min low #:max high))
