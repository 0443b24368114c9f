; The values of a script. Numbers are doubles, strings are strings, true and false are booleans, functions are
; procedures that get `this` by keyword; undefined is the unspecific value. Null, objects and arrays are records. Lists,
; vectors, points and tables of Scheme are read like arrays and objects (native.scm). A property's key is a symbol, so
; keys are compared by eq?.

(define undefined (if #f #f))
(define-record-type |%null of JavaScript| (make-null) any-null?)
(define null (make-null))
(define hole (list 'hole))      ; an element of an array that was never set
(define unset (list 'unset))    ; an undeclared variable before its first assignment
(define absent (list 'absent))  ; the result for a missing property

; Names of record types and fields begin with %, so that the printer shows none of them. names and values are parallel;
; for-in skips the first `hidden` of them; a deleted name is #f. index: a table from name to place for large objects.
; datum: the value of a Number, String or Boolean.
(define-record-type |%object of JavaScript|
  (make-object %kind %proto %names %values %count %hidden %index %datum)
  object?
  (%kind object-kind)
  (%proto object-proto set-object-proto!)
  (%names object-names set-object-names!)
  (%values object-values set-object-values!)
  (%count object-count set-object-count!)
  (%hidden object-hidden set-object-hidden!)
  (%index object-index set-object-index!)
  (%datum object-datum set-object-datum!))

; length: a double. extra: an object for properties that are no elements, or #f.
(define-record-type |%array of JavaScript|
  (make-array %items %length %extra)
  array?
  (%items array-items set-array-items!)
  (%length array-length set-array-length!)
  (%extra array-extra set-array-extra!))

(define few 8)
(define no-names (vector))

(define (new-object kind proto datum) (make-object kind proto no-names no-names 0 0 #f datum))

(define (slot o key)
  (let ((index (object-index o)))
    (if index
        (hash-get index key #f)
        (let ((names (object-names o)) (n (object-count o)))
          (let loop ((i 0))
            (if (< i n)
                (if (eq? (vector-ref names i) key) i (loop (+ i 1)))
                #f))))))

; Doubles the room, and removes deleted names.
(define (grow! o)
  (let* ((names (object-names o)) (values (object-values o)) (n (object-count o))
         (room (max 4 (* 2 n))) (fresh-names (make-vector room #f)) (fresh-values (make-vector room #f)) (hidden (object-hidden o)))
    (let loop ((i 0) (to 0))
      (if (= i hidden) (set-object-hidden! o to))
      (if (< i n)
          (if (vector-ref names i)
              (begin
                (vector-set! fresh-names to (vector-ref names i))
                (vector-set! fresh-values to (vector-ref values i))
                (loop (+ i 1) (+ to 1)))
              (loop (+ i 1) to))
          (begin
            (set-object-names! o fresh-names)
            (set-object-values! o fresh-values)
            (set-object-count! o to)
            (if (> to few)
                (let ((table (make-hasheqv)))
                  (let again ((i 0))
                    (if (< i to) (begin (hash-set! table (vector-ref fresh-names i) i) (again (+ i 1)))))
                  (set-object-index! o table))))))))

(define (own-put! o key value)
  (let ((i (slot o key)))
    (if i
        (vector-set! (object-values o) i value)
        (begin
          (if (= (object-count o) (vector-length (object-names o))) (grow! o))
          (let ((n (object-count o)) (index (object-index o)))
            (vector-set! (object-names o) n key)
            (vector-set! (object-values o) n value)
            (set-object-count! o (+ n 1))
            (if index (hash-set! index key n)))))))

(define (own-delete! o key)
  (let ((i (slot o key)))
    (if i
        (begin
          (vector-set! (object-names o) i #f)
          (vector-set! (object-values o) i #f)
          (if (object-index o) (hash-remove! (object-index o) key))))))

; ---- prototypes ----

(define object-prototype (new-object 'Object null #f))
(define function-prototype (new-object 'Object object-prototype #f))
(define array-prototype (new-object 'Object object-prototype #f))
(define string-prototype (new-object 'Object object-prototype #f))
(define number-prototype (new-object 'Object object-prototype #f))
(define boolean-prototype (new-object 'Object object-prototype #f))
(define error-prototype (new-object 'Object object-prototype #f))
(define (new-error-prototype) (new-object 'Object error-prototype #f))
(define type-error-prototype (new-error-prototype))
(define range-error-prototype (new-error-prototype))
(define reference-error-prototype (new-error-prototype))
(define syntax-error-prototype (new-error-prototype))
(define eval-error-prototype (new-error-prototype))
(define uri-error-prototype (new-error-prototype))

; ---- errors ----

(define-record-type <thrown> (make-thrown value) thrown? (value thrown-value))

(define handlers 0)   ; the number of try statements that are running

(define (uncaught v)
  (string-append "uncaught: " (if (and (object? v) (eq? (object-kind v) 'Error)) (error-text v) (to-string v))))

(define (throw v) (if (eq? handlers 0) (error (uncaught v)) (raise (make-thrown v))))

(define (make-error proto text)
  (let ((e (new-object 'Error proto #f)))
    (own-put! e 'message text)
    (set-object-hidden! e 1)
    e))

(define (type-error . texts) (throw (make-error type-error-prototype (apply string-append texts))))
(define (range-error . texts) (throw (make-error range-error-prototype (apply string-append texts))))
(define (reference-error . texts) (throw (make-error reference-error-prototype (apply string-append texts))))

(define (error-text e)
  (let ((name (get e 'name)) (text (get e 'message)))
    (let ((name (if (eq? name undefined) "Error" (to-string name))) (text (if (eq? text undefined) "" (to-string text))))
      (cond ((string=? name "") text) ((string=? text "") name) (else (string-append name ": " text))))))

; Returns the handler's value for an error of the language itself.
(define (condition->value e)
  (cond ((thrown? e) (thrown-value e))
        ((error-object? e)
         (let ((text (condition-text e)))
           (make-error (if (ends-in? text " is not defined") reference-error-prototype type-error-prototype) text)))
        (else e)))

(define (condition-text e)
  (let loop ((text (error-object-message e)) (rest (error-object-irritants e)))
    (if (pair? rest)
        (loop (string-append text " " (call-with-output-string (lambda (port) (write (car rest) port)))) (cdr rest))
        text)))

(define (ends-in? text end)
  (let ((n (string-length text)) (m (string-length end))) (and (>= n m) (string=? (substring text (- n m) n) end))))

(define-record-type <caught> (make-caught condition) caught? (condition caught-condition))

; Returns the value of body, or a caught.
(define (attempt body)
  (let ((before handlers))
    (set! handlers (+ handlers 1))
    (let ((r (call-with-current-continuation
              (lambda (leave) (with-exception-handler (lambda (e) (leave (make-caught e))) body)))))
      (set! handlers before)
      r)))

(define (catch body handler)
  (let ((r (attempt body))) (if (caught? r) (handler (condition->value (caught-condition r))) r)))

(define (protect body) (attempt body))
(define (throw-again c)
  (let ((e (caught-condition c))) (if (thrown? e) (throw (thrown-value e)) (raise e))))

; ---- properties ----

(define (lookup o key)
  (let loop ((o o))
    (cond ((object? o)
           (let ((i (slot o key))) (if i (vector-ref (object-values o) i) (loop (object-proto o)))))
          ((array? o) (let ((v (array-own o key))) (if (eq? v absent) (loop (array-proto o)) v)))
          ((procedure? o) (let ((v (function-own o key))) (if (eq? v absent) (loop function-prototype) v)))
          ((native? o) (let ((v (native-own o key))) (if (eq? v absent) (loop (proto-of o)) v)))
          (else absent))))

(define (found v) (if (eq? v absent) undefined v))

(define (array-proto a) (let ((x (array-extra a))) (if x (object-proto x) array-prototype)))

; Returns the integer of a key, or #f.
(define (key-index key)
  (let* ((s (symbol->string key)) (n (string-length s)))
    (and (> n 0) (< n 11)
         (let loop ((i 0) (v 0))
           (if (< i n)
               (let ((c (string-ref s i)))
                 (and (char<=? #\0 c) (char<=? c #\9) (or (> i 0) (= n 1) (not (char=? c #\0)))
                      (loop (+ i 1) (+ (* v 10) (- (char->integer c) 48)))))
               (and (< v 4294967295) v))))))

(define (array-own a key)
  (let ((i (key-index key)))
    (cond (i (array-element a i))
          ((eq? key 'length) (array-length a))
          ((array-extra a) (let ((s (slot (array-extra a) key))) (if s (vector-ref (object-values (array-extra a)) s) absent)))
          (else absent))))

(define (array-element a i)
  (if (< i (array-length a)) (let ((v (vector-ref (array-items a) i))) (if (eq? v hole) absent v)) absent))

; A function's own properties are kept in a table, from the first access on.
(define function-objects (make-hasheqv))

(define (function-object f)
  (or (hash-get function-objects f #f)
      (let ((o (new-object 'Function function-prototype #f)))
        (hash-set! function-objects f o)
        o)))

(define (function-own f key)
  (let* ((o (if (eq? key 'prototype) (function-object f) (hash-get function-objects f #f))) (i (and o (slot o key))))
    (cond (i (vector-ref (object-values o) i))
          ((eq? key 'prototype)
           (let ((p (new-object 'Object object-prototype #f)))
             (own-put! p 'constructor f)
             (set-object-hidden! p 1)
             (own-put! o 'prototype p)
             (set-object-hidden! o (object-count o))
             p))
          (else absent))))

(define (key-name key) (symbol->string key))

(define (get v key)
  (cond ((object? v) (found (lookup v key)))
        ((array? v) (found (lookup v key)))
        ((string? v)
         (if (eq? key 'length)
             (inexact (string-length v))
             (let ((i (key-index key)))
               (if (and i (< i (string-length v))) (string (string-ref v i)) (found (lookup string-prototype key))))))
        ((flonum? v) (found (lookup number-prototype key)))
        ((procedure? v) (found (lookup v key)))
        ((boolean? v) (found (lookup boolean-prototype key)))
        ((eq? v undefined) (type-error "Cannot read properties of undefined (reading '" (key-name key) "')"))
        ((eq? v null) (type-error "Cannot read properties of null (reading '" (key-name key) "')"))
        ((number? v) (found (lookup number-prototype key)))
        ((symbol? v) (get (symbol->string v) key))
        (else (found (lookup v key)))))

(define (js-length v)
  (cond ((array? v) (array-length v)) ((string? v) (inexact (string-length v))) (else (get v 'length))))

(define (to-key k)
  (cond ((symbol? k) k)
        ((string? k) (string->symbol k))
        (else (string->symbol (to-string k)))))

(define (at v k)
  (cond ((array? v)
         (if (flonum? k)
             (if (and (>= k 0.) (< k (array-length v)))
                 (let ((i (exact k)))
                   (if (exact-integer? i)
                       (let ((x (vector-ref (array-items v) i))) (if (eq? x hole) (get v (to-key k)) x))
                       (get v (to-key k))))
                 (get v (to-key k)))
             (get v (to-key k))))
        ((string? v)
         (if (and (flonum? k) (>= k 0.) (< k (string-length v)) (exact-integer? (exact k)))
             (string (string-ref v (exact k)))
             (get v (to-key k))))
        ((and (vector? v) (flonum? k) (>= k 0.) (< k (vector-length v)) (exact-integer? (exact k)))
         (from-native (vector-ref v (exact k))))
        (else (get v (if (nothing? v) (to-key (to-string k)) (to-key k))))))

(define most-gap 10000000)

(define (array-room! a n)
  (let* ((items (array-items a)) (room (vector-length items)))
    (if (> n room)
        (begin
          (if (> n (+ most-gap (* 2 room))) (range-error "an array of " (number->string n) " elements, of which nearly all are empty"))
          (let ((fresh (make-vector (max n 4 (* 2 room)) hole)))
            (vector-copy! fresh 0 items 0 (exact (array-length a)))
            (set-array-items! a fresh))))))

(define (array-set! a i value)
  (if (>= i (array-length a))
      (begin
        (array-room! a (+ i 1))
        (set-array-length! a (inexact (+ i 1)))))
  (vector-set! (array-items a) i value))

(define (set-length! a v)
  (let ((n (to-number v)))
    (if (or (not (= n (floor n))) (< n 0.) (> n 4294967295.)) (range-error "Invalid array length"))
    (let ((n (exact n)) (old (exact (array-length a))))
      (if (> n old)
          (array-room! a n)
          (let loop ((i n)) (if (< i old) (begin (vector-set! (array-items a) i hole) (loop (+ i 1))))))
      (set-array-length! a (inexact n)))))

(define (extra! a)
  (or (array-extra a)
      (let ((x (new-object 'Object array-prototype #f))) (set-array-extra! a x) x)))

(define (put! v key value)
  (cond ((object? v) (own-put! v key value))
        ((array? v)
         (let ((i (key-index key)))
           (cond (i (array-set! v i value))
                 ((eq? key 'length) (set-length! v value))
                 (else (own-put! (extra! v) key value)))))
        ((procedure? v)
         (own-put! (function-object v) key value)
         (if (eq? key 'prototype)
             (let ((o (function-object v)))
               (if (= (object-count o) 1) (set-object-hidden! o 1)))))
        ((native? v) (native-put! v key value))
        ((eq? v undefined) (type-error "Cannot set properties of undefined (setting '" (key-name key) "')"))
        ((eq? v null) (type-error "Cannot set properties of null (setting '" (key-name key) "')")))
  value)

(define (at-put! v k value)
  (if (and (array? v) (flonum? k) (>= k 0.) (< k 4294967295.))
      (let ((i (exact k)))
        (if (exact-integer? i)
            (if (< k (array-length v)) (vector-set! (array-items v) i value) (array-set! v i value))
            (put! v (to-key k) value))
        value)
      (put! v (if (nothing? v) (to-key (to-string k)) (to-key k)) value)))

(define (delete! v k)
  (let ((key (to-key k)))
    (cond ((object? v) (own-delete! v key))
          ((array? v)
           (let ((i (key-index key)))
             (cond (i (if (< i (array-length v)) (vector-set! (array-items v) i hole)))
                   ((array-extra v) (own-delete! (array-extra v) key)))))
          ((procedure? v) (own-delete! (function-object v) key))
          ((native? v) (native-delete! v key))
          ((eq? v undefined) (type-error "Cannot convert undefined or null to object"))
          ((eq? v null) (type-error "Cannot convert undefined or null to object")))
    #t))

(define (own? v key)
  (cond ((object? v) (if (slot v key) #t #f))
        ((array? v) (not (eq? (array-own v key) absent)))
        ((procedure? v) (not (eq? (function-own v key) absent)))
        ((string? v) (or (eq? key 'length) (let ((i (key-index key))) (and i (< i (string-length v))))))
        ((native? v) (not (eq? (native-own v key) absent)))
        (else #f)))

(define (compound? v) (or (object? v) (array? v) (procedure? v)))

(define (has k v)
  (if (not (or (compound? v) (native? v))) (type-error "Cannot use 'in' operator to search for '" (to-string k) "' in " (to-string v)))
  (not (eq? (lookup v (to-key k)) absent)))

; ---- for-in ----

; Returns the names of o's own visible properties: numbers first, in ascending order, then the others in the order of
; their first assignment.
(define (own-keys o)
  (let loop ((i (- (object-count o) 1)) (numbers '()) (names '()))
    (if (>= i (object-hidden o))
        (let ((name (vector-ref (object-names o) i)))
          (cond ((not name) (loop (- i 1) numbers names))
                ((key-index name) (loop (- i 1) (cons name numbers) names))
                (else (loop (- i 1) numbers (cons name names)))))
        (append (sort numbers (lambda (a b) (< (key-index a) (key-index b)))) names))))

(define (index-key i) (string->symbol (number->string i)))

(define (element-keys items n)
  (let loop ((i (- n 1)) (keys '()))
    (if (< i 0) keys (loop (- i 1) (if (eq? (vector-ref items i) hole) keys (cons (index-key i) keys))))))

(define (seen-keys v)
  (cond ((object? v)
         (if (and (eq? (object-kind v) 'String) (string? (object-datum v)))
             (append (seen-keys (object-datum v)) (own-keys v))
             (own-keys v)))
        ((array? v)
         (append (element-keys (array-items v) (exact (array-length v))) (if (array-extra v) (own-keys (array-extra v)) '())))
        ((procedure? v) (let ((o (hash-get function-objects v #f))) (if o (own-keys o) '())))
        ((string? v) (let loop ((i (- (string-length v) 1)) (keys '())) (if (< i 0) keys (loop (- i 1) (cons (index-key i) keys)))))
        ((native? v) (native-keys v))
        (else '())))

(define (proto-of v)
  (cond ((object? v) (object-proto v)) ((array? v) (array-proto v)) ((procedure? v) function-prototype)
        ((string? v) string-prototype) ((flonum? v) number-prototype) ((boolean? v) boolean-prototype)
        ((hash-table? v) object-prototype) ((native? v) array-prototype) (else null)))

(define (keys v)
  (let loop ((p (proto-of v)) (all (seen-keys v)))
    (if (eq? p null)
        all
        (let ((more (seen-keys p)))
          (loop (proto-of p) (if (null? more) all (append all (remove-known more all))))))))

(define (remove-known keys known)
  (let loop ((keys keys) (kept '()))
    (if (pair? keys) (loop (cdr keys) (if (memq (car keys) known) kept (cons (car keys) kept))) (reverse kept))))

; Returns the rest of the keys, from the first one that still exists.
(define (keys-left v keys)
  (if (pair? keys)
      (if (or (string? v) (not (eq? (lookup v (car keys)) absent))) keys (keys-left v (cdr keys)))
      keys))

(define (key-text keys) (symbol->string (car keys)))

; ---- functions ----

(define (not-callable f name)
  (lambda all (type-error (or name (if (compound? f) "the value" (to-string f))) " is not a function")))

(define (nth list n) (cond ((null? list) undefined) ((eq? n 0) (car list)) (else (nth (cdr list) (- n 1)))))

(define (arguments-object list)
  (let ((a (list->array list)))
    (set-array-extra! a (new-object 'Arguments object-prototype #f))
    a))

(define (list->array list)
  (let ((items (list->vector list))) (make-array items (inexact (vector-length items)) #f)))

(define (array->list a)
  (let loop ((i (- (exact (array-length a)) 1)) (list '()))
    (if (< i 0) list (loop (- i 1) (cons (let ((x (vector-ref (array-items a) i))) (if (eq? x hole) undefined x)) list)))))

(define (array . items) (list->array items))

(define (push! a . items)
  (for-each (lambda (x) (array-set! a (exact (array-length a)) x)) items)
  (array-length a))

(define (object . parts)
  (let ((o (new-object 'Object object-prototype #f)))
    (let loop ((l parts)) (if (pair? l) (begin (own-put! o (car l) (cadr l)) (loop (cddr l)))))
    o))

(define (new f . arguments)
  (if (not (procedure? f)) (type-error (if (compound? f) "the value" (to-string f)) " is not a constructor"))
  (let ((maker (hash-get constructors f #f)))
    (if maker
        (apply maker arguments)
        (let* ((p (get f 'prototype)) (o (new-object 'Object (if (compound? p) p object-prototype) #f)) (r (apply-self f arguments o)))
          (if (compound? r) r o)))))

; The effect of `new` on the global functions: a table from the function to a procedure without `this`.
(define constructors (make-hasheqv))

(define (instance-of v f)
  (if (not (procedure? f)) (type-error "Right-hand side of 'instanceof' is not callable"))
  (let ((p (get f 'prototype)))
    (and (compound? v)
         (let loop ((o (proto-of v))) (cond ((eq? o null) #f) ((eq? o p) #t) (else (loop (proto-of o))))))))
