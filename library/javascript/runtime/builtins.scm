; The global objects of every script: Object, Array, String, Number, Boolean, Function, Math, the errors, and the global
; functions.

; A function of a script: omitted arguments are undefined, `this` goes by keyword, and further arguments are ignored.
(define-syntax fn
  (syntax-rules () ((_ this (name ...) body ...) (lambda ((name any? undefined) ... #:this (this any? undefined) . more) body ...))))
; The same with the further values in a list, after the named ones.
(define-syntax fn-rest
  (syntax-rules () ((_ this (name ...) values body ...) (lambda ((name any? undefined) ... #:this (this any? undefined) . values) body ...))))

(define (hide! o) (set-object-hidden! o (object-count o)))

(define-syntax methods!
  (syntax-rules ()
    ((_ o (name function) ...) (begin (own-put! o 'name function) ... (hide! o)))))

; ---- Object ----

(define (to-object v)
  (cond ((compound? v) v)
        ((string? v) (new-object 'String string-prototype v))
        ((flonum? v) (new-object 'Number number-prototype v))
        ((boolean? v) (new-object 'Boolean boolean-prototype v))
        ((nothing? v) (new-object 'Object object-prototype #f))
        (else v)))

(define Object (fn this (v) (to-object v)))
(hash-set! constructors Object (lambda more (to-object (if (pair? more) (car more) undefined))))

(define (class-name v)
  (cond ((array? v) (if (array-extra v) (symbol->string (object-kind (array-extra v))) "Array"))
        ((object? v) (symbol->string (object-kind v)))
        ((procedure? v) "Function") ((string? v) "String") ((flonum? v) "Number") ((boolean? v) "Boolean")
        ((eq? v undefined) "Undefined") ((eq? v null) "Null") (else "Object")))

(methods! object-prototype
  (constructor Object)
  (toString (fn this () (string-append "[object " (class-name this) "]")))
  (toLocaleString (fn this () (to-string this)))
  (valueOf (fn this () (to-object this)))
  (hasOwnProperty (fn this (k) (own? this (to-key k))))
  (isPrototypeOf
   (fn this (v) (let loop ((o (if (compound? v) (proto-of v) null))) (cond ((eq? o null) #f) ((eq? o this) #t) (else (loop (proto-of o)))))))
  (propertyIsEnumerable (fn this (k) (if (memq (to-key k) (seen-keys this)) #t #f))))

(define (constructor! f proto maker)
  (own-put! (function-object f) 'prototype proto)
  (hide! (function-object f))
  (if maker (hash-set! constructors f maker)))

(constructor! Object object-prototype #f)

; ---- Function ----

(define Function (fn this () (type-error "Function is not part of this language: a program cannot make code while it runs")))
(constructor! Function function-prototype (lambda more (Function undefined)))
(define (argument-list v)
  (cond ((array? v) (array->list v)) ((nothing? v) '())
        ((sequence? v) (map seen (native-elements v)))
        ((object? v)
         (let ((n (exact (to-integer (js-length v)))))
           (let loop ((i (- n 1)) (list '())) (if (< i 0) list (loop (- i 1) (cons (get v (index-key i)) list))))))
        (else (type-error "CreateListFromArrayLike called on non-object"))))
(methods! function-prototype
  (constructor Function)
  (apply (fn this (self list) (apply-self this (argument-list list) self)))
  (toString (fn this () "function () { [native code] }"))
  (call (fn-rest this (self) rest (apply-self this rest self))))

; ---- Error ----

(define-syntax define-error
  (syntax-rules ()
    ((_ name proto)
     (begin
       (define (maker [text any? undefined] . more)
         (if (eq? text undefined) (new-object 'Error proto #f) (make-error proto (to-string text))))
       (define name (fn this (text) (maker text)))
       (constructor! name proto maker)
       (own-put! proto 'constructor name)
       (own-put! proto (string->symbol "name") (symbol->string 'name))
       (own-put! proto 'message "")
       (hide! proto)))))
(define-error Error error-prototype)
(define-error TypeError type-error-prototype)
(define-error RangeError range-error-prototype)
(define-error ReferenceError reference-error-prototype)
(define-error SyntaxError syntax-error-prototype)
(define-error EvalError eval-error-prototype)
(define-error URIError uri-error-prototype)
(methods! error-prototype (toString (fn this () (error-text this))))

; ---- Array ----

(define (make-array-of . values)
  (if (and (pair? values) (null? (cdr values)) (flonum? (car values)))
      (let ((a (make-array no-names 0. #f))) (set-length! a (car values)) a)
      (list->array values)))
(define Array (fn-rest this () values (apply make-array-of values)))
(constructor! Array array-prototype make-array-of)

(define (element a i) (at a (inexact i)))
(define (count-of a) (let ((n (to-integer (js-length a)))) (if (or (nan? n) (< n 0.)) 0 (exact n))))

(define (joined items separator)
  (let* ((a (viewed items)) (n (count-of a)))
    (call-with-output-string
     (lambda (port)
       (let loop ((i 0))
         (if (< i n)
             (let ((v (element a i)))
               (if (> i 0) (display separator port))
               (if (not (nothing? v)) (display (to-string v) port))
               (loop (+ i 1)))))))))

(define (clamp v n)   ; a place among n elements; a negative one counts from the end
  (let ((i (to-integer v))) (exact (if (< i 0.) (max 0. (+ n i)) (min i (inexact n))))))

(define (slice a from to)
  (let ((items (array-items a)))
    (make-array (vector-copy items from (max from to)) (inexact (max 0 (- to from))) #f)))

(define (as-array this) (if (array? this) this (list->array (argument-list this))))

(define (order f)
  (if (procedure? f)
      (lambda (a b) (and (not (eq? a undefined)) (or (eq? b undefined) (< (to-number (f a b)) 0.))))
      (lambda (a b) (and (not (eq? a undefined)) (or (eq? b undefined) (string<? (to-string a) (to-string b)))))))

(define (merge-sort list less?)   ; stable; calls the script's function with two elements
  (let ((n (length list)))
    (if (< n 2)
        list
        (let split ((i (quotient n 2)) (front '()) (rest list))
          (if (> i 0)
              (split (- i 1) (cons (car rest) front) (cdr rest))
              (let merge ((a (merge-sort (reverse front) less?)) (b (merge-sort rest less?)) (out '()))
                (cond ((null? a) (append-reverse out b))
                      ((null? b) (append-reverse out a))
                      ((less? (car b) (car a)) (merge a (cdr b) (cons (car b) out)))
                      (else (merge (cdr a) b (cons (car a) out))))))))))
(define (append-reverse a b) (if (pair? a) (append-reverse (cdr a) (cons (car a) b)) b))

(define (replace! a list)   ; replaces a's elements
  (let ((v (list->vector list)))
    (set-array-items! a v)
    (set-array-length! a (inexact (vector-length v)))))

(define (drop list n) (if (eq? n 0) list (drop (cdr list) (- n 1))))
(define (take list n) (if (eq? n 0) '() (let loop ((l list) (n n) (out '())) (if (eq? n 0) (reverse out) (loop (cdr l) (- n 1) (cons (car l) out))))))

; Calls (f element index array) for each element that is set, until (done? value) is true.
(define (each items f self visit)
  (if (not (procedure? f)) (type-error (to-string f) " is not a function"))
  (let loop ((i 0) (a (viewed items)) (f (callback f)))
    (if (< i (count-of a))
        (let ((key (index-key i)))
          (if (eq? (lookup a key) absent)
              (loop (+ i 1) a f)
              (let ((x (element a i))) (if (visit (f x (inexact i) a #:this self) x i) (loop (+ i 1) a f))))))))

(define (fold items f start from to step given)
  (if (not (procedure? f)) (type-error (to-string f) " is not a function"))
  (let loop ((a (viewed items)) (f (callback f)) (i from) (v start) (given given))
    (if (= i to)
        (if given v (type-error "Reduce of empty array with no initial value"))
        (if (eq? (lookup a (index-key i)) absent)
            (loop a f (+ i step) v given)
            (if given
                (loop a f (+ i step) (f v (element a i) (inexact i) a) #t)
                (loop a f (+ i step) (element a i) #t))))))

(methods! array-prototype
  (constructor Array)
  (toString (fn this () (if (or (array? this) (sequence? this)) (joined this ",") (string-append "[object " (class-name this) "]"))))
  (toLocaleString (fn this () (joined this ",")))
  (join (fn this (separator) (joined this (if (eq? separator undefined) "," (to-string separator)))))
  (push (fn-rest this () values (changing this) (for-each (lambda (v) (if (array? this) (push! this v)
    (let ((n (count-of this))) (put! this (index-key n) v) (put! this 'length (inexact (+ n 1)))))) values) (js-length this)))
  (pop (fn this ()
    (let ((n (count-of (changing this))))
      (if (eq? n 0)
          undefined
          (let ((v (element this (- n 1)))) (put! this 'length (inexact (- n 1))) v)))))
  (shift (fn this ()
    (let ((n (count-of (changing this))))
      (if (eq? n 0)
          undefined
          (let ((v (element this 0)) (items (array-items this)))
            (vector-copy! items 0 items 1 n)
            (set-length! this (inexact (- n 1)))
            v)))))
  (unshift (fn-rest this () values
    (let ((n (count-of (changing this))) (m (length values)))
      (array-room! this (+ n m))
      (vector-copy! (array-items this) m (array-items this) 0 n)
      (let loop ((l values) (i 0)) (if (pair? l) (begin (vector-set! (array-items this) i (car l)) (loop (cdr l) (+ i 1)))))
      (set-array-length! this (inexact (+ n m)))
      (array-length this))))
  (concat (fn-rest this () values
    (list->array
     (let loop ((l (map viewed (cons this values))))
       (if (pair? l)
           (append (if (array? (car l)) (vector->list (vector-copy (array-items (car l)) 0 (count-of (car l)))) (list (car l))) (loop (cdr l)))
           '())))))
  (slice (fn this (from to)
    (let* ((a (as-array this)) (n (count-of a))) (slice a (clamp from n) (if (eq? to undefined) n (clamp to n))))))
  (splice (fn-rest this () given
    (let* ((n (count-of (changing this))) (from (if (pair? given) (clamp (car given) n) n))
           (count (cond ((null? given) 0) ((null? (cdr given)) (- n from)) (else (exact (max 0. (min (to-integer (cadr given)) (inexact (- n from))))))))
           (all (vector->list (vector-copy (array-items this) 0 n))) (rest (drop all from)))
      (replace! this (append (take all from) (if (and (pair? given) (pair? (cdr given))) (cddr given) '()) (drop rest count)))
      (list->array (take rest count)))))
  (reverse (fn this () (replace! this (reverse (vector->list (vector-copy (array-items (changing this)) 0 (count-of this))))) this))
  (sort (fn this (f) (replace! this (merge-sort (array->list (changing this)) (order (callback f)))) this))
  (indexOf (fn this (v from)
    (let* ((this (viewed this)) (n (count-of this)))
      (let loop ((i (if (eq? from undefined) 0 (clamp from n))))
        (cond ((>= i n) -1.) ((and (not (eq? (lookup this (index-key i)) absent)) (same (element this i) v)) (inexact i)) (else (loop (+ i 1))))))))
  (lastIndexOf (fn this (v)
    (let loop ((this (viewed this)) (i (- (count-of this) 1))) (cond ((< i 0) -1.) ((same (element this i) v) (inexact i)) (else (loop (- i 1)))))))
  (forEach (fn this (f self) (each this f self (lambda (r x i) #t)) undefined))
  (map (fn this (f self)
    (let ((out (make-array no-names 0. #f)))
      (set-length! out (inexact (count-of this)))
      (each this f self (lambda (r x i) (array-set! out i r) #t))
      out)))
  (filter (fn this (f self) (let ((out (array))) (each this f self (lambda (r x i) (if (true? r) (push! out x)) #t)) out)))
  (every (fn this (f self) (let ((all #t)) (each this f self (lambda (r x i) (set! all (true? r)) all)) all)))
  (some (fn this (f self) (let ((one #f)) (each this f self (lambda (r x i) (set! one (true? r)) (not one))) one)))
  (reduce (fn-rest this (f) start
    (fold this f (if (pair? start) (car start) undefined) 0 (count-of this) 1 (pair? start))))
  (reduceRight (fn-rest this (f) start
    (fold this f (if (pair? start) (car start) undefined) (- (count-of this) 1) -1 -1 (pair? start)))))

; ---- String ----

(define String (fn-rest this () values (if (pair? values) (to-string (car values)) "")))
(constructor! String string-prototype
  (lambda values
    (let* ((s (if (pair? values) (to-string (car values)) "")) (o (new-object 'String string-prototype s)))
      (own-put! o 'length (inexact (string-length s)))
      (hide! o)
      o)))
(own-put! (function-object String) 'fromCharCode
  (fn-rest this () codes
    (list->string (map (lambda (c)
      (let ((n (modulo (to-unsigned c) 65536)))
        (if (and (>= n #xD800) (< n #xE000)) (range-error "String.fromCharCode: half of a surrogate pair is no character") (integer->char n)))) codes))))
(hide! (function-object String))

(define (own-text this)
  (cond ((string? this) this)
        ((and (object? this) (eq? (object-kind this) 'String)) (object-datum this))
        ((nothing? this) (type-error "String.prototype method called on null or undefined"))
        (else (to-string this))))

(define (find-text s part from)
  (let ((n (string-length s)) (m (string-length part)))
    (let loop ((i from))
      (cond ((> (+ i m) n) #f)
            ((let same ((k 0)) (or (= k m) (and (char=? (string-ref s (+ i k)) (string-ref part k)) (same (+ k 1))))) i)
            (else (loop (+ i 1)))))))

(define (between v n) (exact (max 0. (min (inexact n) (to-integer v)))))   ; negative is 0

(define (character-at s v) (let ((i (to-integer v))) (and (>= i 0.) (< i (string-length s)) (string-ref s (exact i)))))

(methods! string-prototype
  (constructor String)
  (toString (fn this () (own-text this)))
  (valueOf (fn this () (own-text this)))
  (charAt (fn this (i) (let ((c (character-at (own-text this) i))) (if c (string c) ""))))
  (charCodeAt (fn this (i) (let ((c (character-at (own-text this) i))) (if c (inexact (char->integer c)) nan))))
  (concat (fn-rest this () values (apply string-append (own-text this) (map to-string values))))
  (indexOf (fn this (part from)
    (let* ((s (own-text this)) (i (find-text s (to-string part) (between from (string-length s))))) (if i (inexact i) -1.))))
  (lastIndexOf (fn this (part from)
    (let* ((s (own-text this)) (part (to-string part)) (x (to-number from)) (most (- (string-length s) (string-length part))))
      (let loop ((i (if (nan? x) most (min most (between from (string-length s))))))
        (cond ((< i 0) -1.) ((eq? (find-text (substring s i (+ i (string-length part))) part 0) 0) (inexact i)) (else (loop (- i 1))))))))
  (slice (fn this (from to)
    (let* ((s (own-text this)) (n (string-length s)) (a (clamp from n)) (b (if (eq? to undefined) n (clamp to n)))) (substring s a (max a b)))))
  (substring (fn this (from to)
    (let* ((s (own-text this)) (n (string-length s)) (a (between from n)) (b (if (eq? to undefined) n (between to n)))) (substring s (min a b) (max a b)))))
  (substr (fn this (from count)
    (let* ((s (own-text this)) (n (string-length s)) (a (clamp from n)) (c (if (eq? count undefined) (- n a) (between count (- n a))))) (substring s a (+ a c)))))
  (toLowerCase (fn this () (string-downcase (own-text this))))
  (toUpperCase (fn this () (string-upcase (own-text this))))
  (localeCompare (fn this (other) (let ((a (own-text this)) (b (to-string other))) (cond ((string<? a b) -1.) ((string=? a b) 0.) (else 1.)))))
  (trim (fn this () (trimmed (own-text this))))
  (split (fn this (separator most)
    (let* ((s (own-text this)) (most (if (eq? most undefined) 4294967295 (to-unsigned most))) (n (string-length s))
           (parts
            (cond ((eq? separator undefined) (list s))
                  ((string=? (to-string separator) "") (map string (string->list s)))
                  (else
                   (let* ((part (to-string separator)) (m (string-length part)))
                     (let loop ((from 0) (out '()))
                       (let ((i (find-text s part from)))
                         (if i (loop (+ i m) (cons (substring s from i) out)) (reverse (cons (substring s from n) out))))))))))
      (list->array (if (> (length parts) most) (take parts most) parts)))))
  (replace (fn this (part by)
    (let* ((s (own-text this)) (part (to-string part)) (i (find-text s part 0)))
      (if i
          (string-append (substring s 0 i) (if (procedure? by) (to-string (by part (inexact i) s)) (to-string by))
                         (substring s (+ i (string-length part)) (string-length s)))
          s)))))

; ---- Number and Boolean ----

(define Number (fn-rest this () values (if (pair? values) (to-number (car values)) 0.)))
(constructor! Number number-prototype
  (lambda values (new-object 'Number number-prototype (if (pair? values) (to-number (car values)) 0.))))
(methods! (function-object Number)
  (MAX_VALUE 1.7976931348623157e308) (MIN_VALUE 5e-324) (NaN nan) (POSITIVE_INFINITY infinity) (NEGATIVE_INFINITY (- infinity)))

(define (own-number this)
  (cond ((flonum? this) this)
        ((number? this) (inexact this))
        ((and (object? this) (eq? (object-kind this) 'Number)) (object-datum this))
        (else (type-error "Number.prototype.valueOf requires that 'this' be a Number"))))

(define (rounded x places)   ; |x| * 10^places, rounded to an integer, halves up
  (floor (+ (* (exact (abs x)) (expt 10 places)) 1/2)))

(define (fixed x places)
  (let* ((digits (number->string (rounded x places)))
         (digits (if (<= (string-length digits) places) (string-append (make-string (- (+ places 1) (string-length digits)) #\0) digits) digits))
         (n (- (string-length digits) places)))
    (string-append (if (or (< x 0.)) "-" "") (substring digits 0 n) (if (eq? places 0) "" (string-append "." (substring digits n (string-length digits)))))))

(define (magnitude-of x)   ; returns e with 10^e <= x < 10^(e + 1)
  (let ((x (exact x)))
    (let loop ((e (digits-of (inexact x) (lambda (d n) (- n 1)))))
      (cond ((< x (expt 10 e)) (loop (- e 1))) ((>= x (expt 10 (+ e 1))) (loop (+ e 1))) (else e)))))

(define (scientific x places)   ; returns the digits, places + 1 of them, and the exponent
  (if (= x 0.)
      (values (make-string (+ places 1) #\0) 0)
      (let* ((e (magnitude-of (abs x))) (n (rounded x (- places e))) (s (number->string n)))
        (if (> (string-length s) (+ places 1)) (values (substring s 0 (+ places 1)) (+ e 1)) (values s e)))))

(define (exponent-text digits e sign)
  (string-append sign (substring digits 0 1) (if (> (string-length digits) 1) (string-append "." (substring digits 1 (string-length digits))) "")
                 (if (< e 0) "e-" "e+") (number->string (abs e))))

(define (in-range v least most name)
  (let ((n (to-integer v)))
    (if (or (< n least) (> n most)) (range-error name " argument must be between " (number->string least) " and " (number->string most)))
    (exact n)))

(define (text-in-radix x radix)
  (cond ((nan? x) "NaN") ((= x infinity) "Infinity") ((= x (- infinity)) "-Infinity")
        ((= radix 10) (number-text x))
        ((< x 0.) (string-append "-" (text-in-radix (- x) radix)))
        (else
         (let* ((whole (floor x)) (head (number->string (exact whole) radix)))
           (if (= x whole)
               head
               (let loop ((rest (- x whole)) (out '()) (left 52))
                 (if (or (= rest 0.) (eq? left 0))
                     (string-append head "." (list->string (reverse out)))
                     (let* ((y (* rest radix)) (d (floor y)))
                       (loop (- y d) (cons (string-ref "0123456789abcdefghijklmnopqrstuvwxyz" (exact d)) out) (- left 1))))))))))

(methods! number-prototype
  (constructor Number)
  (valueOf (fn this () (own-number this)))
  (toString (fn this (radix) (text-in-radix (own-number this) (if (eq? radix undefined) 10 (in-range radix 2 36 "toString() radix")))))
  (toLocaleString (fn this () (number-text (own-number this))))
  (toFixed (fn this (places)
    (let ((x (own-number this)) (n (in-range places 0 100 "toFixed() digits")))
      (if (or (nan? x) (>= (abs x) 1e21)) (number-text x) (fixed x n)))))
  (toExponential (fn this (places)
    (let ((x (own-number this)))
      (cond ((or (nan? x) (= (abs x) infinity)) (number-text x))
            ((eq? places undefined)
             (if (= x 0.) "0e+0" (digits-of (abs x) (lambda (d n) (exponent-text d (- n 1) (if (< x 0.) "-" ""))))))
            (else
             (let-values (((d e) (scientific x (in-range places 0 100 "toExponential()")))) (exponent-text d e (if (< x 0.) "-" ""))))))))
  (toPrecision (fn this (places)
    (let ((x (own-number this)))
      (if (or (eq? places undefined) (nan? x) (= (abs x) infinity))
          (number-text x)
          (let ((p (in-range places 1 100 "toPrecision()")))
            (let-values (((d e) (scientific x (- p 1))))
              (let ((sign (if (< x 0.) "-" "")))
                (cond ((or (< e -6) (>= e p)) (exponent-text d e sign))
                      ((= e (- p 1)) (string-append sign d))
                      ((>= e 0) (string-append sign (substring d 0 (+ e 1)) "." (substring d (+ e 1) p)))
                      (else (string-append sign "0." (make-string (- (- e) 1) #\0) d)))))))))))

(define Boolean (fn this (v) (true? v)))
(constructor! Boolean boolean-prototype (lambda values (new-object 'Boolean boolean-prototype (and (pair? values) (true? (car values))))))
(define (own-boolean this) (if (boolean? this) this (object-datum this)))
(methods! boolean-prototype
  (constructor Boolean)
  (valueOf (fn this () (own-boolean this)))
  (toString (fn this () (to-string (own-boolean this)))))

; ---- Math ----

(define (power a b)
  (cond ((nan? b) nan) ((= b 0.) 1.) ((nan? a) nan)
        ((= (abs b) infinity)
         (let ((m (abs a))) (cond ((= m 1.) nan) ((eq? (> m 1.) (> b 0.)) infinity) (else 0.))))
        ((and (< a 0.) (not (= b (floor b)))) (if (= a (- infinity)) (if (> b 0.) infinity 0.) nan))
        ((= a 0.)
         (let ((odd (and (= b (floor b)) (< (abs b) 9e15) (odd? (exact b)) (< (/ 1. a) 0.))))
           (if (> b 0.) (if odd -0. 0.) (if odd (- infinity) infinity))))
        (else (inexact (expt a b)))))

(define (js-round x)
  (cond ((or (nan? x) (= x (floor x))) x)
        ((and (< x 0.) (>= x -.5)) -0.)
        (else (let ((f (floor x))) (if (>= (- x f) .5) (+ f 1.) f)))))

(define seed 88172645463325252)
(define (random-number)   ; xorshift: a script makes the same model in every run
  (let* ((mask 18446744073709551615)
         (x (bitwise-xor seed (bitwise-and mask (* seed 8192)))) (x (bitwise-xor x (quotient x 128))) (x (bitwise-xor x (bitwise-and mask (* x 131072)))))
    (set! seed x)
    (/ (inexact (quotient x 2048)) 9007199254740992.)))

(define-syntax numeric (syntax-rules () ((_ x body) (fn this (v) (let ((x (to-number v))) body)))))
(define-syntax numeric2 (syntax-rules () ((_ (x y) body) (fn this (v w) (let* ((x (to-number v)) (y (to-number w))) body)))))

(define (extreme start better?)
  (fn-rest this () values
    (let loop ((l (map to-number values)) (v start))
      (cond ((null? l) v)
            ((or (nan? v) (nan? (car l))) (loop (cdr l) nan))
            ((or (better? (car l) v) (and (= (car l) v 0.) (better? (/ 1. (car l)) (/ 1. v)))) (loop (cdr l) (car l)))
            (else (loop (cdr l) v))))))

(define Math (new-object 'Math object-prototype #f))
(methods! Math
  (E 2.718281828459045) (LN10 2.302585092994046) (LN2 .6931471805599453) (LOG2E 1.4426950408889634) (LOG10E .4342944819032518)
  (PI 3.141592653589793) (SQRT1_2 .7071067811865476) (SQRT2 1.4142135623730951)
  (abs (numeric x (if (< x 0.) (- x) (if (= x 0.) 0. x))))
  (acos (numeric x (if (<= -1. x 1.) (inexact (acos x)) nan)))
  (asin (numeric x (if (= x 0.) x (if (<= -1. x 1.) (inexact (asin x)) nan))))
  (atan (numeric x (if (= x 0.) x (inexact (atan x)))))
  (atan2 (numeric2 (y x) (if (or (nan? x) (nan? y)) nan (inexact (atan y x)))))
  (ceil (numeric x (let ((c (ceiling x))) (if (and (= c 0.) (< x 0.)) -0. c))))
  (cos (numeric x (if (< (abs x) infinity) (inexact (cos x)) nan)))
  (exp (numeric x (inexact (exp x))))
  (floor (numeric x (floor x)))
  (log (numeric x (cond ((nan? x) nan) ((< x 0.) nan) ((= x 0.) (- infinity)) (else (inexact (log x))))))
  (max (extreme (- infinity) (lambda (a b) (> a b))))
  (min (extreme infinity (lambda (a b) (< a b))))
  (pow (numeric2 (a b) (power a b)))
  (random (fn this () (random-number)))
  (round (numeric x (js-round x)))
  (sin (numeric x (if (= x 0.) x (if (< (abs x) infinity) (inexact (sin x)) nan))))
  (sqrt (numeric x (if (< x 0.) nan (if (= x 0.) x (sqrt x)))))
  (tan (numeric x (if (= x 0.) x (if (< (abs x) infinity) (inexact (tan x)) nan)))))

; ---- global functions ----

(define NaN nan)
(define Infinity infinity)
(define isNaN (fn this (v) (nan? (to-number v))))
(define isFinite (fn this (v) (let ((x (to-number v))) (and (not (nan? x)) (< (abs x) infinity)))))

(define parseFloat
  (fn this (v)
    (let* ((s (trimmed (to-string v))) (signed (or (at? s 0 #\+) (at? s 0 #\-))) (from (if signed 1 0)) (end (decimal-end s from))
           (x (cond (end (read-decimal (substring s from end)))
                    ((eq? (find-text (substring s from (string-length s)) "Infinity" 0) 0) infinity)
                    (else nan))))
      (if (at? s 0 #\-) (- x) x))))

(define parseInt
  (fn this (v radix)
    (let* ((s (trimmed (to-string v))) (from (if (or (at? s 0 #\+) (at? s 0 #\-)) 1 0)) (r (exact (signed (to-unsigned radix))))
           (hex (and (memv r '(0 16)) (at? s from #\0) (or (at? s (+ from 1) #\x) (at? s (+ from 1) #\X))))
           (from (if hex (+ from 2) from)) (r (cond (hex 16) ((eq? r 0) 10) (else r))))
      (if (or (< r 2) (> r 36))
          nan
          (let loop ((i from) (n 0))
            (let ((d (and (< i (string-length s)) (radix-digit (string-ref s i)))))
              (if (and d (< d r))
                  (loop (+ i 1) (+ (* n r) d))
                  (if (= i from) nan (let ((x (inexact n))) (if (at? s 0 #\-) (- x) x))))))))))

(define (print-line values)
  (let loop ((l values) (first #t))
    (if (pair? l)
        (begin
          (if (not first) (display " "))
          (display (to-string (car l)))
          (loop (cdr l) #f))))
  (newline)
  undefined)
(define print (fn-rest this () values (print-line values)))
(define console (object 'log print))
