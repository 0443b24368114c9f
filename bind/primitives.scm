; The language extended by programs: define-primitive, drawing functions, and the measures that look through them.
; After geometry.scm. An object of a user's kind is a node that holds a number; what it was made with stays here, under that number, until C says that
; no node holds it any more (%custom-gone). Equal arguments are one number, so that equal objects are equal.

; ---- what objects of users' kinds were made with ----

(define %custom-values (make-hash)) ; number -> (type . values)
(define %custom-numbers (make-hash)) ; (type . values) -> number
(define %custom-next 0)
(define %custom-types 0)

; a type: its name, that of its maker, and a number of its own, for two may be of one name
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

; the expression that makes it, as far as that is short
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

; (define-primitive name field ...) and (define-primitive (name parameter ...) body ...). Fields and parameters are those of any procedure, with contracts.
(define-syntax define-primitive
  (er-macro-transformer
    (lambda (form rename compare)
      (define (symbol . parts) (string->symbol (apply string-append (map (lambda (p) (if (string? p) p (symbol->string p))) parts))))
      (define (refuse text) (list (rename 'syntax-error) (string-append "define-primitive: " text)))
      (define (keyword? x) (let ((text (symbol->string x))) (and (> (string-length text) 2) (string=? (substring text 0 2) "#:"))))
      ; the variables of a parameter list; a contract of the rest, (list-of ...), is none
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

; ---- drawing functions: what becomes of objects when the drawing is handed on ----

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

; The objects as they are handed to a format, which goes by several names: '(png povray), or by none, for measures.
; To ask for the name * is to take functions for one format where there is none for all.
(define (%hand-on objects names)
  (let ((functions (append (filter (lambda (f) (or (not (vector-ref f 0)) (memq (vector-ref f 0) names))) %drawing-functions)
                           (if (memq '* names) (filter (lambda (f) (vector-ref f 0)) %drawing-functions) '()))))
    (if (null? functions)
        objects
        (let ((before #f)) ; a drawing function may call draw, as the thesis' do: that adds nothing then
          (dynamic-wind
            (lambda () (set! before (%handing! #t)))
            (lambda () (%redraw objects functions))
            (lambda () (%handing! before)))))))

; Every object is replaced by what the newest function for it gives, and that is gone through in turn; but within what a function gives for an
; object, that object itself stays as it is: so a function may put what it was given into something else. Shared parts are done once. A replacement that
; was found within the replacement of an object that is still under way is not remembered: elsewhere it may become something else.
(define (%redraw objects functions)
  (define done (make-hash)) ; number of the node -> (object . result), or (object) with depth while under way
  (define lowest +inf.0)    ; depth of the outermost object under way that was met
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

; ---- what C knows of nodes, through users' kinds ----

; who asks much asks about one object: what was drawn last is kept, until there are other functions
(define %drawn-last (vector #f #f #f)) ; object, functions, what they gave
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
