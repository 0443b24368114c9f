; Prefabs: model files as parts, with their parameters as keywords. After panels.scm. Names that begin with % are hidden
; from programs. Compiled into the binary when it is built.
;
; A prefab's file is an ordinary model. It runs in its own environment. There define-parameter takes the caller's
; values, draw collects objects, and the procedures for cameras and lights have no effect.

; The state of a run of a prefab's file: #(given parameters drawn). `given` is an association list of names and values,
; `parameters` lists (name default min max), newest first, and `drawn` objects, newest first.
(define (%prefab-parameter who name-of state)
  (lambda (name default #:min [low any? #f] #:max [high any? #f] #:step [step any? #f] #:choices [choices any? #f]
                #:label [label any? #f] #:group [group any? #f] #:unit [unit any? #f])
    (let* ((given (assq name (vector-ref state 0))) (v (if given (cdr given) default)))
      (vector-set! state 1 (cons (list name default low high) (vector-ref state 1)))
      (cond
        ((and (number? default) (not (and (real? v) (finite? v)))) (error who "~a of ~a must be a number, got ~s" name name-of v))
        ((and (exact-integer? default) (not (exact-integer? v)))
         (error who "~a of ~a must be an exact integer, got ~s" name name-of v))
        ((and (boolean? default) (not (boolean? v))) (error who "~a of ~a must be #t or #f, got ~s" name name-of v))
        ((and (string? default) (not (string? v))) (error who "~a of ~a must be a string, got ~s" name name-of v))
        ((and choices (not (member v choices))) (error who "~a of ~a must be one of ~s, got ~s" name name-of choices v))
        ((and (number? default) (or (and low (< v low)) (and high (> v high))))
         (error who "~a of ~a must be ~a, got ~a" name name-of
           (cond ((not high) (format "at least ~a" low)) ((not low) (format "at most ~a" high)) (else (format "from ~a to ~a" low high)))
           v)))
      v)))

(define (%prefab-ends-in-vs? name)
  (let ((n (string-length name))) (and (> n 3) (string=? (substring name (- n 3) n) ".vs"))))

; Runs the file; returns its state, with the object at 3.
(define (%prefab-run who name given)
  (if (not (string? name)) (error who "name must be a string, got ~s" name))
  (if (not (or (%prefab-ends-in-vs? name) (member name (prefab-names))))
      (error who "there is no prefab ~s; there are ~a, and files of your own, as in (prefab \"lamp.vs\")" name
        (string-join (prefab-names) " ")))
  (let ((state (vector given '() '() #f)) (place (environment '(visualscheme))))
    (define (put name value) (eval (list 'define name (list 'quote value)) place))
    (define (nothing . any) (if #f #f))
    (define (draw . objects)
      (vector-set! state 2 (cons (if (and (pair? objects) (null? (cdr objects))) (car objects) objects) (vector-ref state 2)))
      (car (vector-ref state 2)))
    (put 'draw draw)
    (put 'prefab-parameter (%prefab-parameter who name state))
    (for-each (lambda (name) (put name nothing)) '(ground units zoom-extents erase-all))
    (put 'camera (lambda (eye target #:lens [lens any? #f]) (if #f #f)))
    (put 'view-from (lambda (way) (if #f #f)))
    (put 'ground (lambda ([z any? 0] #:material [material any? #f]) (if #f #f)))
    (put 'sky (lambda (#:color [color any? #f] #:image [image any? #f]) (if #f #f)))
    (put 'sun
      (lambda (#:azimuth [azimuth any? #f] #:altitude [altitude any? #f] #:latitude [latitude any? #f] #:longitude [longitude any? #f]
               #:date [date any? #f] #:time [time any? #f])
        (if #f #f)))
    (eval '(define-syntax define-parameter
             (syntax-rules () ((_ name default . options) (define name (prefab-parameter 'name default . options)))))
      place)
    (let* ((value (eval (list 'include (if (%prefab-ends-in-vs? name) name (string-append "prefabs/" name ".vs"))) place))
           (drawn (reverse (vector-ref state 2))) (names (map car (reverse (vector-ref state 1))))
           (stray (find (lambda (g) (not (memq (car g) names))) given)))
      (if stray
          (error who "~a has no parameter ~a; it has ~a" name (car stray)
            (if (null? names) "none" (string-join (map symbol->string names) " "))))
      (vector-set! state 3
        (cond ((pair? drawn) (unite drawn)) ((object? value) value) ((and (pair? value) (list? value)) (unite value))
              (else (error who "~a draws nothing, and its last expression gives no object" name))))
      state)))

; The results of the language's own prefabs, by name and given values: they never change while a program runs.
(define %prefabs-made '())

(define (%prefab name given)
  (if (and (string? name) (not (%prefab-ends-in-vs? name)))
      (let* ((key (cons name given)) (found (assoc key %prefabs-made)))
        (if found
            (cdr found)
            (let ((o (vector-ref (%prefab-run 'prefab name given) 3)))
              (set! %prefabs-made (cons (cons key o) (if (> (length %prefabs-made) 64) (take %prefabs-made 32) %prefabs-made)))
              o)))
      (vector-ref (%prefab-run 'prefab name given) 3)))

(define-syntax prefab
  (er-macro-transformer
    (lambda (form rename compare)
      (define (keyword x)
        (let ((text (and (identifier? x) (symbol->string (syntax->datum x)))))
          (and text (> (string-length text) 2) (string=? (substring text 0 2) "#:") (string->symbol (substring text 2)))))
      (define (given l)
        (cond
          ((null? l) '())
          ((and (keyword (car l)) (pair? (cdr l)))
           (let ((rest (given (cddr l))))
             (and rest (cons `(,(rename 'cons) (,(rename 'quote) ,(keyword (car l))) ,(cadr l)) rest))))
          (else #f)))
      (let ((pairs (and (list? form) (pair? (cdr form)) (given (cddr form)))))
        (if pairs
            `(,(rename '%prefab) ,(cadr form) (,(rename 'list) ,@pairs))
            `(,(rename 'syntax-error) "prefab: it is written (prefab \"name\" #:parameter value ...)"))))))

; Returns the parameters as lists (name default min max), #f for a bound that is not given.
(define (prefab-parameters name) (reverse (vector-ref (%prefab-run 'prefab-parameters name '()) 1)))
