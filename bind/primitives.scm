; The extension of the language by programs: define-primitive, drawing functions, and the measures that apply them.
; After geometry.scm. An object of a user's kind is a node that holds a number. Its arguments are kept here under that
; number, until no node holds it any more, which C reports (%custom-gone). Equal arguments have one number, so equal
; objects are equal.

; ---- the arguments of objects of users' kinds ----

(define %custom-values (make-hash)) ; number -> (type . values)
(define %custom-numbers (make-hash)) ; (type . values) -> number
(define %custom-next 0)
(define %custom-types 0)

; a type: its name, that of its maker, and a unique number, since two types may have one name
(define (%custom-type name maker)
  (set! %custom-types (+ %custom-types 1))
  (vector name maker %custom-types))

(define (%custom-sweep)
  (let ((gone (%custom-gone)))
    (if gone
        (let ((known (hash-ref %custom-values gone #f)))
          (if known
              (begin
                (hash-remove! %custom-numbers known)
                (hash-remove! %custom-values gone)))
          (%custom-sweep)))))

(define (%custom type values child)
  (%custom-sweep)
  (let* ((key (cons type values))
         (known (hash-ref %custom-numbers key #f))
         (number (or known %custom-next)))
    (if (not known)
        (begin
          (set! %custom-next (+ %custom-next 1))
          (hash-set! %custom-numbers key number)
          (hash-set! %custom-values number key)))
    (%custom-new (vector-ref type 0) (%custom-made type values) number child)))

; Returns the expression that makes the object, with long arguments abbreviated.
(define (%custom-made type values)
  (let ((port (open-output-string)))
    (write-char #\( port)
    (display (vector-ref type 1) port)
    (for-each
      (lambda (v)
        (write-char #\space port)
        (cond
          ((object? v) (display "#<" port) (display (object-kind v) port) (display ">" port))
          ((pair? v) (display "(...)" port))
          ((vector? v) (display "#(...)" port))
          (else (write v port))))
      values)
    (write-char #\) port)
    (get-output-string port)))

(define (%custom-entry o) ; (type . values), or #f
  (let ((number (%custom-number o)))
    (and number (hash-ref %custom-values number #f))))

(define (%custom-is? type o)
  (let ((entry (%custom-entry o)))
    (and entry (eq? (car entry) type))))

(define (%custom-field type o index who)
  (let ((entry (%custom-entry o)))
    (if (and entry (eq? (car entry) type))
        (list-ref (cdr entry) index)
        (error who "o must be an object of the kind ~a, got ~s" (vector-ref type 0) o))))

(define (%custom-body who made)
  (cond
    ((object? made) made)
    ((and (list? made) (every object? made)) (unite made))
    (else (error who "its body must give an object or a list of objects, got ~s" made))))

; (define-primitive name field ...) and (define-primitive (name parameter ...) body ...). Fields and parameters are
; those of any procedure, with contracts.
(define-syntax define-primitive
  (er-macro-transformer
    (lambda (form rename compare)
      (define (symbol . parts) (string->symbol (apply string-append (map (lambda (p) (if (string? p) p (symbol->string p))) parts))))
      (define (refuse text) (list (rename 'syntax-error) (string-append "define-primitive: " text)))
      (define (keyword? x) (let ((text (symbol->string x))) (and (> (string-length text) 2) (string=? (substring text 0 2) "#:"))))
      ; the variables of a parameter list; a contract of the rest, (list-of ...), is no variable
      (define (variables spec)
        (cond
          ((null? spec) '())
          ((identifier? spec) (list spec))
          ((not (pair? spec)) (list #f))
          ((identifier? (car spec)) (if (keyword? (syntax->datum (car spec))) (variables (cdr spec)) (cons (car spec) (variables (cdr spec)))))
          ((and (pair? (car spec)) (identifier? (caar spec)))
           (if (memq (syntax->datum (caar spec)) '(list-of and or not)) (variables (cdr spec)) (cons (caar spec) (variables (cdr spec)))))
          (else (list #f))))
      (define (expand name maker spec child)
        (let* ((plain (syntax->datum name)) (fields (variables spec))
               (type (rename 'type)) (o (rename 'o)) (is (symbol plain "?"))
               (getters (map (lambda (f) (symbol plain "-" (syntax->datum f))) fields)))
          `(,(rename 'define-values) (,maker ,is ,@getters)
             (,(rename 'let) ()
               (,(rename 'define) ,type (,(rename '%custom-type) (,(rename 'quote) ,plain) (,(rename 'quote) ,maker)))
               (,(rename 'define) (,maker . ,spec)
                 (,(rename '%custom) ,type (,(rename 'list) ,@fields) ,child))
               (,(rename 'define) (,is ,o) (,(rename '%custom-is?) ,type ,o))
               ,@(map (lambda (g i) `(,(rename 'define) (,g ,o) (,(rename '%custom-field) ,type ,o ,i (,(rename 'quote) ,g)))) getters (iota (length getters)))
               (,(rename 'values) ,maker ,is ,@getters)))))
      (cond
        ((and (pair? (cdr form)) (identifier? (cadr form)))
         (if (memq #f (variables (cddr form)))
             (refuse "a field is a name or [name predicate]")
             (expand (cadr form) (symbol "make-" (syntax->datum (cadr form))) (cddr form) #f)))
        ((and (pair? (cdr form)) (pair? (cadr form)) (identifier? (caadr form)) (pair? (cddr form)))
         (let ((name (caadr form)))
           (if (memq #f (variables (cdadr form)))
               (refuse "a parameter is a name or [name predicate]")
               (expand name (syntax->datum name) (cdadr form)
             `(,(rename '%custom-body) (,(rename 'quote) ,(syntax->datum name)) (,(rename 'let) () ,@(cddr form)))))))
        (else (refuse "it is written (define-primitive name field ...) or (define-primitive (name parameter ...) body ...)"))))))

; ---- drawing functions: they replace objects when the drawing is handed over ----

(define %drawing-functions '()) ; #(format-or-#f pred proc), newest first

(define register-drawing-function
  (case-lambda
    ((pred proc) (%register-drawing-function #f pred proc))
    ((back-end pred proc)
     (if (not (and (symbol? back-end) (%format? back-end)))
         (error 'register-drawing-function "back-end must be the name of a format, such as 'povray, 'openscad or 'stl, got ~s" back-end))
     (%register-drawing-function back-end pred proc))))

(define (%register-drawing-function back-end pred proc)
  (if (not (procedure? pred)) (error 'register-drawing-function "pred must be a procedure of one argument, got ~s" pred))
  (if (not (procedure? proc)) (error 'register-drawing-function "proc must be a procedure of one argument, got ~s" proc))
  (set! %drawing-functions (cons (vector back-end pred proc) %drawing-functions))
  (%host-set! 2 %hand-on))

; Returns the objects for a format with several names, such as '(png povray), or with none, for measures. The name *
; selects the functions for single formats if none is for all formats.
(define (%hand-on objects names)
  (let ((functions (append (filter (lambda (f) (or (not (vector-ref f 0)) (memq (vector-ref f 0) names))) %drawing-functions)
                           (if (memq '* names) (filter (lambda (f) (vector-ref f 0)) %drawing-functions) '()))))
    (if (null? functions)
        objects
        (let ((before #f)) ; a drawing function may call draw, as those of the thesis do; draw then adds nothing
          (dynamic-wind
            (lambda () (set! before (%handing! #t)))
            (lambda () (%redraw objects functions))
            (lambda () (%handing! before)))))))

; Replaces every object by the value of the newest function for it, and visits that value in turn. Within the value for
; an object, the object itself is not replaced, so a function may put its argument into another object. Shared parts are
; replaced once. A replacement found within the replacement of an unfinished object is not kept: elsewhere the result
; may differ.
(define (%redraw objects functions)
  (define done (make-hash)) ; the node's number -> (object . result), or #(object depth) until it is finished
  (define lowest +inf.0)    ; the depth of the outermost unfinished object that was met
  (define (function-for o)
    (let loop ((l functions))
      (cond ((null? l) #f) (((vector-ref (car l) 1) o) (vector-ref (car l) 2)) (else (loop (cdr l))))))
  (define (drawn o given)
    (cond
      ((object? given) given)
      ((and (list? given) (every object? given)) (unite given))
      (else (error (string->symbol (string-append "the drawing function of " (symbol->string (object-kind o)))) "it must give an object or a list of objects, got ~s" given))))
  (define (parts o depth)
    (let* ((old (object-children o)) (new (map (lambda (c) (visit c depth)) old)))
      (if (every (lambda (a b) (= (%node-number a) (%node-number b))) old new) o (%object-with o new))))
  (define (visit o depth)
    (let* ((key (%node-number o)) (seen (hash-ref done key #f)))
      (cond
        ((and seen (vector? seen))
         (set! lowest (min lowest (vector-ref seen 1)))
         (parts o (+ depth 1)))
        (seen (cdr seen))
        (else
          (let ((proc (function-for o)) (outer lowest))
            (if (and (not proc) (null? (object-children o)))
                o
                (begin
                  (if proc (hash-set! done key (vector o depth)))
                  (set! lowest +inf.0)
                  (let ((result (if proc (visit (drawn o (proc o)) (+ depth 1)) (parts o (+ depth 1)))))
                    (if (< lowest depth)
                        (hash-remove! done key)
                        (begin (hash-set! done key (cons o result)) (set! lowest +inf.0)))
                    (set! lowest (min lowest outer))
                    result))))))))
  (map (lambda (o) (visit o 0)) objects))

; ---- the procedures of C that read nodes, applied to users' kinds ----

; Many questions concern the same object: the last result is kept until a function is registered.
(define %drawn-last (vector #f #f #f)) ; the object, the functions, their result
(define (%drawn o)
  (cond
    ((not (%custom-open? o)) o)
    ((and (eq? o (vector-ref %drawn-last 0)) (eq? %drawing-functions (vector-ref %drawn-last 1))) (vector-ref %drawn-last 2))
    (else
      (set! %drawn-last (vector o %drawing-functions (car (%hand-on (list o) '()))))
      (vector-ref %drawn-last 2))))

(define (object-arguments o)
  (let ((entry (and (object? o) (%custom-entry o)))) (if entry (cdr entry) (%object-arguments o))))
(define (object-count o) (%object-count (%drawn o)))
(define (bounding-box o) (%bounding-box (%drawn o)))
(define (contains? o p) (%contains? (%drawn o) p))
(define (volume o) (%volume (%drawn o)))
(define (area o) (%area (%drawn o)))
(define (curve-length c) (%curve-length (%drawn c)))
(define (centroid o) (%centroid (%drawn o)))
(define (lowered o) (%lowered (%drawn o)))
(define (do-section o plane) (%do-section (%drawn o) plane))
(define (do-edges o) (%do-edges (%drawn o)))
(define (minkowski a b) (%minkowski (%drawn a) (%drawn b)))
(define (simplify o tolerance) (%simplify (%drawn o) tolerance))
(define (refine o length) (%refine (%drawn o) length))
(define (do-smooth o #:sharp [sharp any? #f])
  (if sharp (%do-smooth (%drawn o) #:sharp sharp) (%do-smooth (%drawn o))))
