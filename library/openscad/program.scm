; Whole programs: the main file, and the files that `use` names.

(define (mentions? t name) (cond ((pair? t) (or (mentions? (car t) name) (mentions? (cdr t) name))) (else (eq? t name))))

; A file: its statements, its scope for functions and modules, its symbols of variables.
(define-record-type file (make-file statements scope symbols) file? (statements file-statements) (scope file-scope) (symbols file-symbols))

(define (open-file statements k whole)
  (let* ((tail (if (= k 0) "" (string-append "/" (number->string k))))
         (assigned (filter (lambda (t) (not (special? (cadr t)))) (last-assignments statements)))
         (symbols (map (lambda (t) (cons (cadr t) (symbol-with "" (own-name (cadr t)) tail))) assigned))
         (table (lambda (kind before after)
                  (table-of statements kind (lambda (n) (symbol-with before n (string-append after tail))) (lambda () #f)))))
    (make-file statements (make-scope symbols (table 'function "f:" "") (table 'module "" ":") #f #f '() whole) symbols)))

; The scope of a file knows the files that it uses: the last one first.
(define (link-file! f files)
  (set-scope-used! (file-scope f)
    (map (lambda (t) (file-scope (list-ref files (cadr t)))) (reverse (filter (lambda (t) (eq? (car t) 'use)) (file-statements f))))))

; Returns the forms that give the variables of a file their values, in order. A file that is used needs only its
; variables.
(define (variable-forms f main?)
  (let* ((s (file-scope f)))
    (let loop ((l (last-assignments (file-statements f))) (known '()) (forms '()))
      (if (null? l) (reverse forms)
          (let* ((t (car l)) (name (cadr t))
                 (start (make-scope known (scope-functions s) (scope-modules s) #f #f (scope-used s) (scope-whole s))))
            (if (special? name)
                (loop (cdr l) known (cons (list (word s 'scad:set-special!) (special-cell s name) (expression (caddr t) start)) forms))
                (let ((symbol (cdr (assq name (file-symbols f)))))
                  (loop (cdr l) (cons (cons name symbol) known)
                    (cons (or (and main? (parameter-form t s)) (list (word s 'set!) symbol (expression (caddr t) (if (function-tree? (caddr t)) s start)))) forms)))))))))

; Translates all definitions that are wanted, and those that these want. Returns their forms.
(define (wanted-forms whole files)
  (let loop ((forms '()))
    (let ((waiting (whole-waiting whole)))
      (set-whole-waiting! whole '())
      (if (null? waiting) (reverse forms)
          (loop (append (map (lambda (d) (list ((whole-rename whole) 'define) (definition-symbol d) (definition-form d (scope-of d files)))) waiting) forms))))))
(define (scope-of d files)
  (let* ((t (definition-tree d)) (table (if (eq? (car t) 'function) scope-functions scope-modules)))
    (let loop ((l files)) (if (eq? d (hash-ref (table (file-scope (car l))) (cadr t) #f)) (file-scope (car l)) (loop (cdr l))))))

; Returns the program for (scad:program file ...), or an empty one if the program is only translated.
(define (scad-program form rename)
  (if only-translates? (begin (print-translation (cdr (program-form form (lambda (name) name)))) (list (rename 'begin)))
      (program-form form rename)))
(define (program-form form rename)
  (let* ((cache (make-hasheq))
         (renamed (lambda (name) (or (hash-ref cache name #f) (let ((r (rename name))) (hash-set! cache name r) r))))
         (whole (make-whole renamed '() 0 '() (or (mentions? (cdr form) 'parent_module) (mentions? (cdr form) '$parent_modules))))
         (files (let loop ((l (cdr form)) (k 0)) (if (null? l) '() (cons (open-file (car l) k whole) (loop (cdr l) (+ k 1)))))))
    (for-each (lambda (f) (link-file! f files)) files)
    (let* ((main (car files)) (s (file-scope main))
           (values (append (append-map (lambda (f) (variable-forms f #f)) (reverse (cdr files))) (variable-forms main #t)))
           (drawn (map (lambda (t) (list (renamed 'scad:draw) (statement t s (nothing s)))) (filter makes-objects? (file-statements main))))
           (procedures (wanted-forms whole files))
           (variables (append-map (lambda (f) (map (lambda (b) (list (renamed 'define) (cdr b) (list (renamed 'quote) 'undef))) (file-symbols f))) files))
           (cells (map (lambda (name) (list (renamed 'define) name (list (renamed 'scad:special) (list (renamed 'quote) name)))) (whole-specials whole))))
      (append (list (renamed 'begin) (list (renamed 'scad:start))) cells variables procedures values drawn (list (list (renamed 'scad:finish)))))))
