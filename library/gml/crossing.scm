; The conversion of values and procedures between GML and Scheme. After nodes.scm.
;
; Data are copied: arrays become lists, dictionaries tables with symbols as keys. A procedure { ... } becomes a
; procedure of Scheme, which takes operands and returns the results. A procedure of Scheme becomes an operator that
; takes as many operands as it has parameters. In GML every integer is exact, also if Scheme has it as a double: all
; numbers of JavaScript are doubles, and GML counts and indexes with integers.

(define busy 0) ; the number of Scheme procedures that GML is executing

(define (operator? v) (and (procedure? v) (memq v (hash-values operators)) #t))

(opener!
  (lambda (v)
    (cond ((array? v) (array->list v))
          ((vec2? v) (xy (vec2-x v) (vec2-y v)))
          ((outside? v) (outside-procedure v))
          ((or (block? v) (operator? v)) (procedure-of v))
          (else unknown))))

; Pairs of a procedure { ... } or operator and its procedure of Scheme, in both directions, so that a value that returns
; is the same one again.
(define procedures (make-hasheq))
(define origins (make-hasheq))
(define (procedure-of v)
  (or (hash-ref procedures v #f)
      (let ((p (lambda values (run 'gml-call v values))))
        (hash-set! procedures v p)
        (hash-set! origins p v)
        p)))

(define (least-of procedure) (vector-ref (procedure-shape procedure) 0))

(define (to-gml v)
  (define (walk once)
    (define (convert v)
      (cond ((number? v) (if (and (flonum? v) (integer? v) (< (abs v) 9007199254740992.) (not (eqv? v -0.0))) (exact v) v))
            ((or (string? v) (symbol? v) (point? v) (array? v) (vec2? v) (block? v) (outside? v) (edge? v) (operator? v)) v)
            ((boolean? v) (flag v))
            ((gvector? v) (gvector->point v))
            ((or (null? v) (pair? v)) (if (list? v) (once v (lambda () (list->array (map convert v)))) (refuse-value v)))
            ((vector? v) (once v (lambda () (list->array (map convert (vector->list v))))))
            ((hash-table? v)
             (once v (lambda () (let ((d (make-hasheq))) (hash-for-each v (lambda (k x) (hash-set! d (name-of k) (convert x)))) d))))
            ((procedure? v) (or (hash-ref origins v #f) (make-outside v (least-of v))))
            ((eq? v (if #f #f)) (refuse-value v))
            (else (let ((o (opened v))) (if (eq? o unknown) v (once v (lambda () (convert o))))))))
    convert)
  ((walker 'to-gml walk) v))
(define (refuse-value v) (error 'to-gml "GML has no such value: ~s" v))
(define (name-of key)
  (cond ((or (symbol? key) (number? key)) key) ((string? key) (string->symbol key))
        (else (error 'to-gml "a key must be a symbol, a string or a number, got ~s" key))))

; Runs an operator that is a procedure of Scheme: it pushes each of its values; no value pushes nothing.
(set! run-outside
  (lambda (o)
    (let* ((count (outside-count o)) (who 'call))
      (need who count)
      (let ((values (let loop ((n count) (l '())) (if (= n 0) l (loop (- n 1) (cons (from-script (pop)) l))))))
        (set! busy (+ busy 1))
        (call-with-values (lambda () (apply (outside-procedure o) values))
          (lambda results
            (set! busy (- busy 1))
            (for-each (lambda (r) (if (not (eq? r (if #f #f))) (gml:push (to-gml r)))) results)))))))

; Executes v on the operands; returns the results: nothing, the value, or a list of several.
(define (run who v values)
  (let ((bottom depth) (begun dictionaries) (outer-leave leave) (outer-handler handler) (results '()) (calls busy))
    (define (work)
      (for-each (lambda (x) (gml:push (to-gml x))) values)
      (execute v)
      (if (< depth bottom) (error who "takes ~a operand~a more than were given" (- bottom depth) (if (= 1 (- bottom depth)) "" "s")))
      (let take-all () (if (> depth bottom) (begin (set! results (cons (from-script (pop)) results)) (take-all)))))
    (dynamic-wind
      (lambda () (set! leave #f) (set! busy 0))
      (lambda ()
        (let ((context (node-current)))
          (cond ((> calls 0) (work))
                ((eq? context (node-getroot)) (with-root-model work))
                (else (work) (keep-drawing context)))))
      (lambda ()
        (let drop () (if (> depth bottom) (begin (pop) (drop))))
        (set! dictionaries begun) (set! leave outer-leave) (set! handler outer-handler) (set! busy calls)))
    (cond ((null? results) (if #f #f)) ((null? (cdr results)) (car results)) (else results))))

(define (called name) (if (string? name) (string->symbol name) name))
(define (gml-ref name)
  (need-name 'gml-ref (called name))
  (from-script (lookup (called name))))
(define (gml-set! name value [count any? #f])
  (need-name 'gml-set! (called name))
  (let ((v (to-gml value)))
    (set-entry! (current-dictionary) (called name)
      (if (and count (outside? v))
          (let ((o (make-outside (outside-procedure v) (exact count)))) (hash-set! origins value o) o)
          v))))
(define (gml-call name . values)
  (need-name 'gml-call (called name))
  (run (called name) (lookup (called name)) values))

; Returns the object of an edge's shape.
(define (gml-object e)
  (need-edge 'gml-object e)
  (or (shell-object (shell-of (edge-face e) (make-hasheq))) (empty-object)))
