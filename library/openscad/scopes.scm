; Scopes of names while a program is translated. A scope has tables from names to symbols of the program.

; A definition of a function or a module. kids: the symbol of a module's children; unit: the file that contains it.
(define-record-type definition (make-definition symbol tree scope wanted)
  definition? (symbol definition-symbol) (tree definition-tree) (scope definition-scope) (wanted definition-wanted? set-definition-wanted!))

; variables: list of (name . symbol). functions, modules: hash from name to definition. kids: the symbol of the children
; of the module around, or #f. up: the scope around, or #f. used: the scopes of the files that `use` names.
(define-record-type scope (make-scope variables functions modules kids up used whole)
  scope? (variables scope-variables set-scope-variables!) (functions scope-functions) (modules scope-modules)
  (kids scope-kids) (up scope-up) (used scope-used set-scope-used!) (whole scope-whole))

; What holds for the whole program: the procedure that renames words of (openscad), definitions still to translate, the
; number of symbols made, special variables, whether the program asks for the modules that are active.
(define-record-type whole (make-whole rename waiting made specials tracks-modules?)
  whole? (tracks-modules? whole-tracks-modules?) (rename whole-rename) (waiting whole-waiting set-whole-waiting!) (made whole-made set-whole-made!)
  (specials whole-specials set-whole-specials!))

(define no-names (make-hasheq))
(define (inner-scope up variables) (make-scope variables no-names no-names (scope-kids up) up '() (scope-whole up)))
(define (word s name) ((whole-rename (scope-whole s)) name))

(define (special? name) (char=? (string-ref (symbol->string name) 0) #\$))

(define (fresh s name)
  (let* ((w (scope-whole s)) (n (+ (whole-made w) 1)))
    (set-whole-made! w n)
    (string->symbol (string-append (symbol->string name) ":" (number->string n)))))

; Returns the symbol of the variable, or #f.
(define (find-variable s name)
  (let loop ((s s))
    (and s (let ((found (assq name (scope-variables s)))) (if found (cdr found) (loop (scope-up s)))))))

; Returns a symbol for a new variable: its name, unless that would hide another variable.
(define (new-symbol s name) (if (find-variable s name) (fresh s name) (own-name name)))
; The words of Scheme that a translated program contains are no names of variables.
(define (own-name name)
  (if (memq name '(begin define if lambda let letrec quote vector cons list not import)) (string->symbol (string-append (symbol->string name) "_")) name))

; Returns the definition of a function or module, or #f. table: scope-functions or scope-modules.
(define (find-definition s table name)
  (let loop ((s s))
    (cond ((not s) #f)
          ((hash-ref (table s) name #f) => (lambda (d) (want! s d) d))
          ((in-used (scope-used s) table name))
          (else (loop (scope-up s))))))
(define (in-used used table name)
  (and (pair? used)
       (or (let ((d (hash-ref (table (car used)) name #f))) (and d (want! (car used) d) d))
           (in-used (cdr used) table name))))

; Notes that the program needs the definition: those of files are translated only then.
(define (want! s d)
  (if (not (definition-wanted? d))
      (let ((w (scope-whole s)))
        (set-definition-wanted! d #t)
        (set-whole-waiting! w (cons d (whole-waiting w)))))
  #t)

; Returns the symbol for the cell of a special variable.
(define (special-cell s name)
  (let ((w (scope-whole s)))
    (if (not (memq name (whole-specials w))) (set-whole-specials! w (cons name (whole-specials w))))
    name))

; Makes the pair `tree` the form (head . rest), at the same place in the source.
(define (becomes! tree head . rest)
  (set-car! tree head)
  (set-cdr! tree rest)
  tree)
(define (becomes-form! tree form)
  (if (pair? form) (begin (set-car! tree (car form)) (set-cdr! tree (cdr form)) tree) form))
