; The machine of GML: values, the operand stack, the stack of dictionaries, and the execution of values.
;
; Numbers, strings and points (vectors of three) are the language's own. A literal name is a symbol. A dictionary is a
; table, a node of the scene, or the controller. A procedure { ... } is a closure that the reader compiled, with its
; tokens.

; A procedure of Scheme that a program gave to GML is an outside: crossing.scm. Names of record types and fields begin
; with %, so that the printer shows no fields.

(define-record-type |%procedure of GML| (make-block %tokens %thunk) block? (%tokens block-tokens) (%thunk block-thunk))
(define-record-type |%array of GML| (make-array %items %count) array? (%items array-items set-array-items!)
  (%count array-count set-array-count!))
(define-record-type |%vector of GML| (make-vec2 x y) vec2? (x vec2-x) (y vec2-y))
(define-record-type |%mark of GML| (make-marker) marker?)
(define-record-type |%outside of GML| (make-outside %procedure %count) outside? (%procedure outside-procedure) (%count outside-count))
(define run-outside (lambda (v) v))

(define gml:unset (list 'unset))
(define mark (make-marker))

(define (gml:procedure tokens thunk) (make-block tokens thunk))
(define (gml:point x y z) (xyz x y z))
(define gml:vector2 make-vec2)

; ---- the operand stack ----

(define operands (make-vector 256 #f))
(define depth 0)

(define (gml:push v)
  (if (= depth (vector-length operands))
      (let ((larger (make-vector (* 2 depth) #f)))
        (do ((i 0 (+ i 1))) ((= i depth)) (vector-set! larger i (vector-ref operands i)))
        (set! operands larger)))
  (vector-set! operands depth v)
  (set! depth (+ depth 1)))

(define (gml:push-all list) (for-each gml:push list))

(define (need who n)
  (if (< depth n)
      (error who "~a operand~a needed, and the stack holds ~a" n (if (= n 1) " is" "s are") depth)))

(define (pop)
  (set! depth (- depth 1))
  (let ((v (vector-ref operands depth)))
    (vector-set! operands depth #f)
    v))

(define (gml:pop who) (need who 1) (pop))

; Returns the stack's elements, the top last.
(define (gml:operands)
  (let loop ((i (- depth 1)) (l '())) (if (< i 0) l (loop (- i 1) (cons (vector-ref operands i) l)))))

(define (gml:operators) (hash-keys operators))

; Pops the operands down to the innermost mark, and the mark; returns them in order.
(define (pop-to-mark who)
  (let loop ((l '()))
    (if (= depth 0) (error who "there is no [ on the stack"))
    (let ((v (pop))) (if (marker? v) l (loop (cons v l))))))

; ---- the text of values ----

(define (show v)
  (cond
    ((symbol? v) (string-append "/" (symbol->string v)))
    ((string? v) (format "~s" v))
    ((point? v) (format "(~a,~a,~a)" (cx v) (cy v) (cz v)))
    ((vec2? v) (format "(~a,~a)" (vec2-x v) (vec2-y v)))
    ((marker? v) "[")
    ((block? v) "{ ... }")
    ((array? v)
     (let ((n (array-count v)))
       (let loop ((i 0) (t "["))
         (cond ((= i n) (string-append t " ]"))
               ((= i 8) (string-append t " ... ]"))
               (else (loop (+ i 1) (string-append t " " (let ((e (vector-ref (array-items v) i)))
                                                          (if (array? e) "[ ... ]" (show e))))))))))
    ((hash-table? v) "a dictionary")
    ((or (procedure? v) (outside? v)) "an operator")
    ((edge? v) "an edge")
    ((eq? v (node-controller)) "the controller")
    (else (format "~a" v))))

(define (refuse who expected v) (error who (string-append expected ", got " (show v))))

; ---- dictionaries ----

(define user-dictionary (make-hasheq))
(define dictionaries (list user-dictionary)) ; the innermost first
(define operators (make-hasheq))

(define (dictionary? v) (or (hash-table? v) (property-group? v)))

(define (entry d name)
  (cond
    ((hash-table? d) (hash-ref d name gml:unset))
    ((memq name (property-names d)) (property-get d name))
    (else gml:unset)))

; A procedure that is stored in the controller becomes one that hosts may call.
(define (set-entry! d name v)
  (cond ((hash-table? d) (hash-set! d name v))
        ((and (block? v) (eq? d (node-controller))) (property-put! d name (in-place v)))
        (else (property-put! d name v))))

(define (like name)
  (let ((wanted (string-downcase (symbol->string name))))
    (let loop ((all (hash-keys operators)))
      (cond ((null? all) "")
            ((string=? wanted (string-downcase (symbol->string (car all))))
             (string-append "; there is " (symbol->string (car all))))
            (else (loop (cdr all)))))))

(define (lookup name)
  (let loop ((d dictionaries))
    (if (null? d)
        (or (hash-ref operators name #f) (error (string-append (symbol->string name) " is not defined" (like name))))
        (let ((v (entry (car d) name)))
          (if (eq? v gml:unset) (loop (cdr d)) v)))))

; ---- the procedures of the reader's forms ----

(define (execute v)
  (cond ((block? v) ((block-thunk v)))
        ((procedure? v) (v))
        ((outside? v) (run-outside v))
        (else (gml:push v))))

(define (gml:call name) (execute (lookup name)))

(define (member-of v names)
  (for-each
    (lambda (name)
      (if (not (dictionary? v)) (error (string-append "." (symbol->string name) " is looked for in " (show v)
                                         ", which is no dictionary")))
      (set! v (entry v name))
      (if (eq? v gml:unset) (error (string-append "the dictionary has no " (symbol->string name)))))
    names)
  v)

(define (gml:path names) (execute (member-of (lookup (car names)) (cdr names))))
(define (gml:member names) (execute (member-of (gml:pop (car names)) names)))

(define (gml:value v name)
  (if (eq? v gml:unset) (error (string-append "the register " (substring (symbol->string name) 1) " was never set")))
  (gml:push v))

(define (gml:register v name) (if (or (block? v) (procedure? v) (outside? v)) (execute v) (gml:value v name)))

; ---- the definition of operators ----

; (operator (name a b ...) body ...): pops the operands, the last from the top, and pushes the value. operator! pushes
; nothing.
(define-syntax operator
  (syntax-rules () ((_ (name . operands) body ...) (operator! (name . operands) (gml:push (let () body ...))))))

(define-syntax operator!
  (syntax-rules ()
    ((_ (name) body ...) (hash-set! operators 'name (lambda () body ...)))
    ((_ (name a) body ...) (hash-set! operators 'name (lambda () (need 'name 1) (let ((a (pop))) body ...))))
    ((_ (name a b) body ...)
     (hash-set! operators 'name (lambda () (need 'name 2) (let* ((b (pop)) (a (pop))) body ...))))
    ((_ (name a b c) body ...)
     (hash-set! operators 'name (lambda () (need 'name 3) (let* ((c (pop)) (b (pop)) (a (pop))) body ...))))
    ((_ (name a b c d) body ...)
     (hash-set! operators 'name (lambda () (need 'name 4) (let* ((d (pop)) (c (pop)) (b (pop)) (a (pop))) body ...))))))

(define (need-number who v) (if (not (number? v)) (refuse who "an operand must be a number" v)))
(define (need-count who v)
  (if (not (and (exact-integer? v) (>= v 0))) (refuse who "an operand must be a whole number from 0" v)))
(define (need-vector who v) (if (not (point? v)) (refuse who "an operand must be a vector (x,y,z)" v)))
(define (need-name who v) (if (not (symbol? v)) (refuse who "a name is needed, written /name" v)))
(define (true? v) (not (or (not v) (and (number? v) (= v 0)))))
(define (flag b) (if b 1 0))
