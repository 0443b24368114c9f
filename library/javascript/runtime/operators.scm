; Conversions, and operators for operands that are not both numbers.

(define nan (- (/ 0. 0.)))
(define infinity (/ 1. 0.))
(define (nan? x) (not (= x x)))

(define (true? v)
  (cond ((boolean? v) v)
        ((flonum? v) (not (or (= v 0.) (nan? v))))
        ((string? v) (not (eq? (string-length v) 0)))
        ((number? v) (not (= v 0)))
        (else (not (nothing? v)))))

(define (nothing? v) (or (eq? v undefined) (eq? v null)))

(define (type-of v)
  (cond ((flonum? v) "number") ((string? v) "string") ((boolean? v) "boolean") ((eq? v undefined) "undefined")
        ((procedure? v) "function") ((number? v) "number") ((symbol? v) "string") (else "object")))

(define (type-of-unknown thunk)
  (type-of (catch thunk (lambda (e) undefined))))

(define (to-primitive v first second)
  (let ((try (lambda (name next)
               (let ((f (get v name)))
                 (if (procedure? f)
                     (let ((r (f #:this v))) (if (compound? r) (next) r))
                     (next))))))
    (try first (lambda () (try second (lambda () (type-error "Cannot convert object to primitive value")))))))

(define (primitive v) (cond ((compound? v) (to-primitive v 'valueOf 'toString)) ((native? v) (to-string v)) (else v)))

(define (to-string v)
  (cond ((string? v) v)
        ((flonum? v) (number-text v))
        ((boolean? v) (if v "true" "false"))
        ((eq? v undefined) "undefined")
        ((eq? v null) "null")
        ((number? v) (number-text (inexact v)))
        ((symbol? v) (symbol->string v))
        ((compound? v) (to-string (to-primitive v 'toString 'valueOf)))
        ((hash-table? v) "[object Object]")
        ((native? v) (joined (native->array v) ","))
        (else (native-text v))))

(define (to-number v)
  (cond ((flonum? v) v)
        ((string? v) (text-number v))
        ((boolean? v) (if v 1. 0.))
        ((eq? v undefined) nan)
        ((eq? v null) 0.)
        ((number? v) (inexact v))
        ((or (compound? v) (native? v)) (to-number (primitive v)))
        (else nan)))

; ---- numbers as text ----

; Returns the digits of a positive number and the place of the point: 123 and -2 for 0.00123.
(define (digits-of x take)
  (let* ((s (number->string x)) (n (string-length s)))
    (let loop ((i 0) (digits '()) (point #f) (count 0))
      (cond ((or (= i n) (char=? (string-ref s i) #\e))
             (let* ((e (if (< i n) (string->number (substring s (+ i 1) n)) 0)) (place (+ (or point count) e)))
               (let strip ((d (reverse digits)) (place place))
                 (if (and (pair? d) (char=? (car d) #\0))
                     (strip (cdr d) (- place 1))
                     (let ((d (let back ((r (reverse d))) (if (and (pair? r) (char=? (car r) #\0)) (back (cdr r)) (reverse r)))))
                       (take (list->string d) place))))))
            ((char=? (string-ref s i) #\.) (loop (+ i 1) digits count count))
            (else (loop (+ i 1) (cons (string-ref s i) digits) point (+ count 1)))))))

(define (number-text x)
  (cond ((nan? x) "NaN")
        ((= x 0.) "0")
        ((< x 0.) (string-append "-" (number-text (- x))))
        ((= x infinity) "Infinity")
        ((and (< x 1e15) (= x (floor x))) (number->string (exact x)))
        (else
         (digits-of x
           (lambda (d n)
             (let ((k (string-length d)))
               (cond ((and (<= k n) (<= n 21)) (string-append d (make-string (- n k) #\0)))
                     ((and (< 0 n) (<= n 21)) (string-append (substring d 0 n) "." (substring d n k)))
                     ((and (< -6 n) (<= n 0)) (string-append "0." (make-string (- n) #\0) d))
                     (else
                      (let* ((e (- n 1)) (sign (if (< e 0) "e-" "e+")) (e (number->string (abs e))))
                        (string-append (substring d 0 1) (if (= k 1) "" (string-append "." (substring d 1 k))) sign e))))))))))

(define (blank? c) (or (char-whitespace? c) (memv (char->integer c) '(#xFEFF #xA0 #x2028 #x2029))))

(define (trimmed s)
  (let* ((n (string-length s))
         (from (let loop ((i 0)) (if (and (< i n) (blank? (string-ref s i))) (loop (+ i 1)) i)))
         (to (let loop ((i n)) (if (and (> i from) (blank? (string-ref s (- i 1)))) (loop (- i 1)) i))))
    (substring s from to)))

(define (digit-end s i)
  (if (and (< i (string-length s)) (char<=? #\0 (string-ref s i)) (char<=? (string-ref s i) #\9)) (digit-end s (+ i 1)) i))

(define (at? s i c) (and (< i (string-length s)) (char=? (string-ref s i) c)))

; Returns the end of the longest decimal number from i on, or #f.
(define (decimal-end s i)
  (let* ((whole (digit-end s i))
         (all (if (at? s whole #\.) (digit-end s (+ whole 1)) whole)))
    (and (> (- all i) (if (at? s whole #\.) 1 0))
         (if (or (at? s all #\e) (at? s all #\E))
             (let* ((sign (if (or (at? s (+ all 1) #\+) (at? s (+ all 1) #\-)) 1 0)) (end (digit-end s (+ all 1 sign))))
               (if (> end (+ all 1 sign)) end all))
             all))))

(define (read-decimal s)   ; with digits, a point and an exponent
  (let ((s (if (char=? (string-ref s 0) #\.) (string-append "0" s) s)))
    (let* ((point (let loop ((i 0)) (cond ((= i (string-length s)) #f) ((char=? (string-ref s i) #\.) i) (else (loop (+ i 1))))))
           (s (if (and point (= (digit-end s (+ point 1)) (+ point 1)))
                  (string-append (substring s 0 (+ point 1)) "0" (substring s (+ point 1) (string-length s)))
                  s)))
      (inexact (string->number s 10)))))

(define (radix-number s from radix)   ; nan if a character is no digit
  (let ((n (string-length s)))
    (if (= from n)
        nan
        (let loop ((i from) (v 0))
          (if (= i n)
              (inexact v)
              (let ((d (radix-digit (string-ref s i)))) (if (and d (< d radix)) (loop (+ i 1) (+ (* v radix) d)) nan)))))))

(define (radix-digit c)
  (cond ((and (char<=? #\0 c) (char<=? c #\9)) (- (char->integer c) 48))
        ((and (char<=? #\a c) (char<=? c #\z)) (- (char->integer c) 87))
        ((and (char<=? #\A c) (char<=? c #\Z)) (- (char->integer c) 55))
        (else #f)))

(define (text-number text)
  (let* ((s (trimmed text)) (n (string-length s)))
    (if (= n 0)
        0.
        (let* ((signed (or (at? s 0 #\+) (at? s 0 #\-))) (from (if signed 1 0)) (end (decimal-end s from)))
          (cond ((and (at? s 0 #\0) (or (at? s 1 #\x) (at? s 1 #\X))) (radix-number s 2 16))
                ((string=? (substring s from n) "Infinity") (if (at? s 0 #\-) (- infinity) infinity))
                ((and end (= end n))
                 (let ((v (read-decimal (substring s from n)))) (if (at? s 0 #\-) (- v) v)))
                (else nan))))))

; ---- arithmetic ----

(define (add a b)
  (let ((a (primitive a)) (b (primitive b)))
    (if (or (string? a) (string? b))
        (string-append (to-string a) (to-string b))
        (+ (to-number a) (to-number b)))))
(define (js-subtract a b) (let* ((a (to-number a)) (b (to-number b))) (- a b)))
(define (multiply a b) (let* ((a (to-number a)) (b (to-number b))) (* a b)))
(define (divide a b) (let* ((a (to-number a)) (b (to-number b))) (/ a b)))
(define (negate a) (* -1. (to-number a)))

(define (js-remainder a b)
  (let* ((a (to-number a)) (b (to-number b)))
    (cond ((or (nan? a) (nan? b) (= b 0.) (= (abs a) infinity)) nan)
          ((or (= a 0.) (= (abs b) infinity)) a)
          ((and (= a (floor a)) (= b (floor b)) (< (abs a) 9e15) (< (abs b) 9e15))
           (let ((r (inexact (remainder (exact a) (exact b))))) (if (and (= r 0.) (< a 0.)) -0. r)))
          (else
           (let* ((x (exact (abs a))) (y (exact (abs b))) (r (inexact (- x (* y (floor (/ x y)))))))
             (if (< a 0.) (- r) r))))))

(define (to-integer v)
  (let ((x (to-number v))) (cond ((nan? x) 0.) ((= (abs x) infinity) x) (else (truncate x)))))

(define two-32 4294967296)
(define (to-unsigned v)   ; an exact number from 0 to 2^32 - 1
  (let ((x (to-number v)))
    (if (and (>= x 0.) (< x 4294967296.))
        (exact (floor x))
        (if (or (nan? x) (= (abs x) infinity)) 0 (modulo (exact (truncate x)) two-32)))))
(define (signed n) (inexact (if (>= n 2147483648) (- n two-32) n)))

(define (bit-or a b) (let* ((a (to-unsigned a)) (b (to-unsigned b))) (signed (bitwise-or a b))))
(define (bit-and a b) (let* ((a (to-unsigned a)) (b (to-unsigned b))) (signed (bitwise-and a b))))
(define (bit-xor a b) (let* ((a (to-unsigned a)) (b (to-unsigned b))) (signed (bitwise-xor a b))))
(define (bit-not a) (signed (- 4294967295 (to-unsigned a))))
(define (shift-left a b) (let* ((a (to-unsigned a)) (n (modulo (to-unsigned b) 32))) (signed (modulo (* a (expt 2 n)) two-32))))
(define (shift-right a b)
  (let* ((a (exact (signed (to-unsigned a)))) (n (modulo (to-unsigned b) 32))) (inexact (floor (/ a (expt 2 n))))))
(define (shift-unsigned a b) (let* ((a (to-unsigned a)) (n (modulo (to-unsigned b) 32))) (inexact (quotient a (expt 2 n)))))

; ---- comparisons ----

(define (compare a b text? number?)
  (let* ((a (if (compound? a) (primitive a) a)) (b (if (compound? b) (primitive b) b)))
    (if (and (string? a) (string? b)) (text? a b) (let* ((a (to-number a)) (b (to-number b))) (number? a b)))))
(define (less a b) (compare a b string<? (lambda (a b) (< a b))))
(define (more a b) (compare a b string>? (lambda (a b) (> a b))))
(define (less-equal a b) (compare a b string<=? (lambda (a b) (<= a b))))
(define (more-equal a b) (compare a b string>=? (lambda (a b) (>= a b))))

; Exact numbers and symbols come from the language's own procedures.
(define (same a b)
  (cond ((flonum? a) (and (number? b) (= a b)))
        ((string? a) (and (or (string? b) (symbol? b)) (string=? a (to-string b))))
        ((symbol? a) (same (symbol->string a) b))
        ((number? a) (and (number? b) (= a b)))
        (else (eq? a b))))

(define (equal a b)
  (cond ((and (flonum? a) (flonum? b)) (= a b))
        ((and (string? a) (string? b)) (string=? a b))
        ((or (nothing? a) (nothing? b)) (and (nothing? a) (nothing? b)))
        ((symbol? a) (equal (symbol->string a) b))
        ((symbol? b) (equal a (symbol->string b)))
        ((and (boolean? a) (boolean? b)) (eq? a b))
        ((boolean? a) (equal (to-number a) b))
        ((boolean? b) (equal a (to-number b)))
        ((and (flonum? a) (string? b)) (= a (text-number b)))
        ((and (string? a) (flonum? b)) (= (text-number a) b))
        ((and (or (flonum? a) (string? a)) (compound? b)) (equal a (primitive b)))
        ((and (compound? a) (or (flonum? b) (string? b))) (equal (primitive a) b))
        ((and (number? a) (not (flonum? a))) (equal (inexact a) b))
        ((and (number? b) (not (flonum? b))) (equal a (inexact b)))
        (else (eq? a b))))
