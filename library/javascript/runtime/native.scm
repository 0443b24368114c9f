; Values of Scheme in a script. Lists, vectors, points and gvectors are read as arrays, tables as objects. Each access
; reads the value itself; an element that is an exact number becomes a double, a symbol becomes a string. to-javascript
; and from-script make copies.

(define (place? v) (or (point? v) (gvector? v)))
(define (sequence? v) (or (pair? v) (null? v) (vector? v) (place? v)))
(define (native? v) (or (sequence? v) (hash-table? v)))

(define (seen v)
  (cond ((flonum? v) v) ((number? v) (inexact v)) ((symbol? v) (symbol->string v)) (else v)))

(define (native-elements v)
  (cond ((vector? v) (vector->list v))
        ((place? v) (list (cx v) (cy v) (cz v)))
        (else (let loop ((l v) (out '())) (if (pair? l) (loop (cdr l) (cons (car l) out)) (reverse out))))))
(define (native->array v) (list->array (map seen (native-elements v))))
(define (viewed v) (if (sequence? v) (native->array v) v))

(define (native-count v)
  (cond ((vector? v) (vector-length v)) ((place? v) 3) (else (let loop ((l v) (n 0)) (if (pair? l) (loop (cdr l) (+ n 1)) n)))))
(define (native-element v i)
  (cond ((vector? v) (if (< i (vector-length v)) (seen (vector-ref v i)) absent))
        ((place? v) (case i ((0) (seen (cx v))) ((1) (seen (cy v))) ((2) (seen (cz v))) (else absent)))
        (else (let loop ((l v) (i i)) (cond ((not (pair? l)) absent) ((eq? i 0) (seen (car l))) (else (loop (cdr l) (- i 1))))))))

; Returns a table's key for a property's name: a symbol, a string or an integer; absent if there is none.
(define (table-key t key)
  (define (there k) (if (eq? (hash-get t k absent) absent) absent k))
  (let ((k (there key)))
    (if (eq? k absent)
        (let ((k (there (symbol->string key))) (i (key-index key)))
          (if (and i (eq? k absent)) (there i) k))
        k)))
(define (key-of k) (cond ((symbol? k) k) ((string? k) (string->symbol k)) ((number? k) (string->symbol (number->string k))) (else #f)))

(define (native-own v key)
  (if (hash-table? v)
      (let ((k (table-key v key))) (if (eq? k absent) absent (seen (hash-get v k absent))))
      (let ((i (key-index key)))
        (cond (i (native-element v i)) ((eq? key 'length) (inexact (native-count v))) (else absent)))))

(define (refuse-change v)
  (type-error (cond ((vector? v) "a vector of the language keeps its length") ((place? v) "a point of the language is not changed")
                    (else "a list of the language is not changed"))
              ": utl_copy(value) makes an array of it"))
(define (changing v) (if (sequence? v) (refuse-change v) v))

(define (native-put! v key value)
  (if (hash-table? v)
      (let ((k (table-key v key))) (hash-set! v (if (eq? k absent) key k) value))
      (let ((i (key-index key)))
        (if (and (vector? v) i (< i (vector-length v))) (vector-set! v i value) (refuse-change v)))))

(define (native-delete! v key)
  (if (hash-table? v)
      (let ((k (table-key v key))) (if (not (eq? k absent)) (hash-remove! v k)))
      (refuse-change v)))

(define (native-keys v)
  (if (hash-table? v)
      (filter (lambda (k) k) (map key-of (hash-keys v)))
      (let loop ((i (- (native-count v) 1)) (keys '())) (if (< i 0) keys (loop (- i 1) (cons (index-key i) keys))))))

(define (native-text v) (call-with-output-string (lambda (port) (display v port))))

; Returns the value of native text as a script's value.
(define (from-native v)
  (cond ((or (null? v) (and (pair? v) (list? v)) (vector? v)) (list->array (map from-native (native-elements v))))
        (else (seen v))))

; ---- functions ----

(define (script-function? f) (and (procedure? f) (vector-ref (procedure-shape f) 2)))
(define (at-most n values) (if (and n (> (length values) n)) (take values n) values))

; A native procedure that a script passes as a callback gets at most as many values as it takes, since a script's
; functions ignore further ones.
(define (callback f)
  (if (or (not (procedure? f)) (script-function? f))
      f
      (let ((most (vector-ref (procedure-shape f) 1))) (fn-rest this () values (apply f (at-most most values))))))

; ---- copies ----

(opener!
  (lambda (v)
    (cond ((array? v) (array->list v))
          ((object? v)
           (if (eq? (object-datum v) #f)
               (let ((t (make-hasheq))) (for-each (lambda (k) (hash-set! t k (get v k))) (own-keys v)) t)
               (object-datum v)))
          ((eq? v null) #f)
          ((script-function? v) (lambda values (from-script (apply v values))))
          (else unknown))))

(define (to-javascript v)
  (define (walk once)
    (define (convert v)
      (cond ((or (flonum? v) (string? v) (boolean? v) (object? v) (array? v) (nothing? v) (script-function? v)) v)
            ((or (number? v) (symbol? v)) (seen v))
            ((sequence? v) (once v (lambda () (list->array (map convert (native-elements v))))))
            ((hash-table? v)
             (once v (lambda () (let ((o (object))) (hash-for-each v (lambda (k x) (own-put! o (to-key (key-of k)) (convert x)))) o))))
            ((procedure? v)
             (let ((most (vector-ref (procedure-shape v) 1)))
               (fn-rest this () values (to-javascript (apply v (map from-script (at-most most values)))))))
            (else (let ((o (opened v))) (if (eq? o unknown) v (convert o))))))
    convert)
  ((walker 'to-javascript walk) v))
