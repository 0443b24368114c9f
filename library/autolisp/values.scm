; The values of AutoLISP: numbers, strings, lists, and their texts.

; ---- texts of values ----

(define (digits n) (number->string n))
(define (zeros n) (make-string n #\0))

; Returns |x| with n decimals; halves are rounded away from zero.
(define (fixed x n)
  (let* ((scaled (floor (+ (* (abs (exact x)) (expt 10 n)) 1/2)))
         (text (digits scaled))
         (text (if (<= (string-length text) n) (string-append (zeros (- (+ n 1) (string-length text))) text) text))
         (point (- (string-length text) n)))
    (string-append (if (and (< x 0) (> scaled 0)) "-" "") (substring text 0 point)
                   (if (> n 0) (string-append "." (substring text point (string-length text))) ""))))

(define (without-zeros text)
  (let loop ((n (string-length text)))
    (case (string-ref text (- n 1))
      ((#\0) (loop (- n 1)))
      ((#\.) (substring text 0 (+ n 1)))
      (else (substring text 0 n)))))

(define (exponent-of x)
  (let loop ((e (exact (floor (/ (log (abs x)) (log 10))))))
    (cond ((>= (abs (exact x)) (expt 10 (+ e 1))) (loop (+ e 1)))
          ((< (abs (exact x)) (expt 10 e)) (loop (- e 1)))
          (else e))))

; Returns the exponent of x after it is rounded to n decimals of its mantissa.
(define (rounded-exponent x n)
  (let ((e (exponent-of x))) (if (>= (abs (/ (exact x) (expt 10 e))) (- 10 (/ 1/2 (expt 10 n)))) (+ e 1) e)))

; Returns x with n decimals and an exponent; n #f: up to five.
(define (scientific x n)
  (let* ((e (if (= x 0) 0 (rounded-exponent x (or n 5)))) (m (/ (exact x) (expt 10 e))) (m (if n (fixed m n) (without-zeros (fixed m 5)))) (e-text (digits (abs e))))
    (string-append m (if (< e 0) "e-" "e+") (if (< (abs e) 10) "0" "") e-text)))

(define (infinite-text x) (cond ((not (= x x)) "nan") ((> x 0) "inf") (else "-inf")))

; Returns a real number with six digits, without zeros at the end.
(define (real-text x)
  (cond ((not (finite? x)) (infinite-text x))
        ((= x 0) "0.0")
        ((= 5 (rounded-exponent x 5)) (string-append (fixed x 0) ".0"))
        ((< -5 (rounded-exponent x 5) 5) (without-zeros (fixed x (- 5 (rounded-exponent x 5)))))
        (else (scientific x #f))))

(define (symbol-text v) (let ((s (symbol->string v))) (string-upcase (if (char=? (string-ref s 0) #\:) (substring s 1) s))))

(define (text-of v string-text)
  (define (text v)
    (cond ((null? v) "nil")
          ((string? v) (string-text v))
          ((and (number? v) (exact? v)) (digits v))
          ((number? v) (real-text v))
          ((symbol? v) (symbol-text v))
          ((pair? v)
           (let loop ((l (cdr v)) (all (list (text (car v)) "(")))
             (cond ((pair? l) (loop (cdr l) (cons (text (car l)) (cons " " all))))
                   ((null? l) (apply string-append (reverse (cons ")" all))))
                   (else (apply string-append (reverse (cons* ")" (text l) " . " all)))))))
          ((entity? v) (string-append "<Entity name: " (digits (entity-number v)) ">"))
          ((selection? v) "<Selection set>")
          ((procedure? v) "#<USUBR>")
          (else (format "~a" v))))
  (text v))
(define (shown v) (text-of v (lambda (s) (format "~s" s))))
(define (plain v) (text-of v (lambda (s) s)))

(define (refuse who expected v) (error who "~a is needed, got ~a" expected (shown v)))

(define (:princ . v) (if (pair? v) (begin (display (plain (car v))) (car v)) '()))
(define (:prin1 . v) (if (pair? v) (begin (display (shown (car v))) (car v)) '()))
(define (:print . v) (newline) (if (pair? v) (begin (display (shown (car v))) (display " ") (car v)) '()))
(define (:prompt v) (display (need-string 'prompt v)) '())
(define (:alert v) (display (need-string 'alert v)) (newline) '())
(define (:terpri) (newline) '())

; ---- questions to the user: each answer is a line of standard input ----

(define (answer-line who prompt)
  (let ((line (read-line)))
    (if (eof-object? line)
        (error who "the program asks ~a, and standard input has no further line for the answer"
          (if (pair? prompt) (format "~s" (string-trim (plain (last prompt)))) "for a value"))
        (string-trim line))))
; An empty line answers nil.
(define (asked who expected convert)
  (lambda prompt
    (let* ((line (answer-line who prompt)) (v (if (string=? line "") '() (convert line))))
      (or v (refuse who expected line)))))
(define :getpoint (asked 'getpoint "a point such as 1,2,0" (lambda (s) (let ((p (as-point s))) (and p (list-of p))))))
(define :getcorner (asked 'getcorner "a point such as 1,2,0" (lambda (s) (let ((p (as-point s))) (and p (list-of p))))))
(define (real-answer s) (let ((n (as-number s))) (and n (exact->inexact n))))
(define :getreal (asked 'getreal "a number" real-answer))
(define :getdist (asked 'getdist "a distance" real-answer))
(define :getint (asked 'getint "a whole number" (lambda (s) (let ((n (as-number s))) (and n (exact-integer? n) n)))))
(define :getangle (asked 'getangle "an angle in degrees" (lambda (s) (let ((n (real-answer s))) (and n (degrees->radians n))))))
(define :getorient :getangle)
(define :getkword (asked 'getkword "a word" (lambda (s) s)))
(define (:getstring . prompt) (answer-line 'getstring prompt))
(define (:initget . l) '())

; ---- arguments ----

(define (need-number who v) (if (number? v) v (refuse who "a number" v)))
(define (need-whole who v) (if (exact-integer? v) v (refuse who "a whole number" v)))
(define (need-string who v) (if (string? v) v (refuse who "a string" v)))
(define (need-list who v) (if (list? v) v (refuse who "a list" v)))
(define (need-pair who v) (if (or (pair? v) (null? v)) v (refuse who "a list" v)))

; ---- arithmetic: whole numbers have 32 bits; a larger result, or a fraction, is real ----

(define (in-range n) (if (and (exact? n) (not (and (integer? n) (<= (abs n) 2147483647)))) (exact->inexact n) n))
(define (two who f) (lambda (a b) (in-range (f (need-number who a) (need-number who b)))))
(define (folded who f unit)
  (let ((f (two who f)))
    (lambda l (cond ((null? l) unit) ((null? (cdr l)) (need-number who (car l))) (else (fold (lambda (x sum) (f sum x)) (car l) (cdr l)))))))
(define (divided a b)
  (cond ((= b 0) (error '/ "division by zero")) ((and (exact? a) (exact? b)) (quotient a b)) (else (/ (exact->inexact a) b))))
(define :+ (folded '+ + 0))
(define :* (folded '* * 1))
(define minus (folded '- - 0))
(define (:- . l) (if (and (pair? l) (null? (cdr l))) (minus 0 (car l)) (apply minus l)))
(define :/ (folded '/ divided 1))
(define :max (folded 'max max 0))
(define :min (folded 'min min 0))
(define :rem (folded 'rem (lambda (a b) (if (= b 0) (error 'rem "division by zero") (- a (* b (truncate (/ a b)))))) 0))
(define :gcd (folded 'gcd (lambda (a b) (gcd (need-whole 'gcd a) (need-whole 'gcd b))) 0))
(define :logand (folded 'logand (lambda (a b) (bitwise-and (need-whole 'logand a) (need-whole 'logand b))) -1))
(define :logior (folded 'logior (lambda (a b) (bitwise-ior (need-whole 'logior a) (need-whole 'logior b))) 0))
(define (:~ n) (- -1 (need-whole '~ n)))
(define (:1+ n) (:+ n 1))
(define (:1- n) (:- n 1))
(define (:abs n) (abs (need-number 'abs n)))
(define (:fix n)
  (if (not (finite? (need-number 'fix n))) (refuse 'fix "a finite number" n))
  (in-range (exact (truncate n))))
(define (:float n) (exact->inexact (need-number 'float n)))
(define-syntax real-function
  (syntax-rules () ((_ (name who f) ...) (begin (define (name n) (exact->inexact (f (need-number 'who n)))) ...))))
(real-function (:sqrt sqrt sqrt) (:sin sin sin) (:cos cos cos) (:exp exp exp) (:log log log))
(define (direction y x) (if (and (= x 0) (= y 0)) 0.0 (exact->inexact (atan y x)))) ; an angle from -pi to pi
(define (:atan a . b) (direction (need-number 'atan a) (if (pair? b) (need-number 'atan (car b)) 1)))
(define (:expt a b) (in-range (expt (need-number 'expt a) (need-number 'expt b))))
(define :pi (acos -1.0))

(define (ordered who numbers strings)
  (lambda l
    (let loop ((l l))
      (cond ((or (null? l) (null? (cdr l))) t-value)
            ((and (string? (car l)) (string? (cadr l))) (if (strings (car l) (cadr l)) (loop (cdr l)) '()))
            ((numbers (need-number who (car l)) (need-number who (cadr l))) (loop (cdr l)))
            (else '())))))
(define (:= . l)
  (let loop ((l l))
    (cond ((or (null? l) (null? (cdr l))) t-value) ((same? (car l) (cadr l) 0) (loop (cdr l))) (else '()))))
(define (:/= . l) (truth (null? (apply := l))))
(define :< (ordered '< < string<?))
(define :> (ordered '> > string>?))
(define :<= (ordered '<= <= string<=?))
(define :>= (ordered '>= >= string>=?))

(define (same? a b fuzz)
  (cond ((and (number? a) (number? b)) (<= (abs (- a b)) fuzz))
        ((and (string? a) (string? b)) (string=? a b))
        ((and (pair? a) (pair? b)) (and (same? (car a) (car b) fuzz) (same? (cdr a) (cdr b) fuzz)))
        (else (eq? a b))))
(define (:equal a b . fuzz) (truth (same? a b (if (pair? fuzz) (need-number 'equal (car fuzz)) 0))))
(define (:eq a b) (truth (if (and (pair? a) (pair? b)) (eq? a b) (same? a b 0))))
(define (:not v) (truth (null? v)))
(define :null :not)
(define (:atom v) (truth (not (pair? v))))
(define (:listp v) (truth (or (null? v) (pair? v))))
(define (:numberp v) (truth (number? v)))
(define (:zerop v) (truth (= 0 (need-number 'zerop v))))
(define (:minusp v) (truth (< (need-number 'minusp v) 0)))
(define (:type v)
  (cond ((null? v) '()) ((string? v) ':str) ((pair? v) ':list) ((symbol? v) ':sym) ((procedure? v) ':usubr)
        ((entity? v) ':ename) ((selection? v) ':pickset) ((exact-integer? v) ':int) (else ':real)))

; ---- lists ----

(define (:car l) (if (null? (need-pair 'car l)) '() (car l)))
(define (:cdr l) (if (null? (need-pair 'cdr l)) '() (cdr l)))
(define-syntax selectors
  (syntax-rules () ((_ (name outer inner) ...) (begin (define (name l) (outer (inner l))) ...))))
(selectors (:caar :car :car) (:cadr :car :cdr) (:cdar :cdr :car) (:cddr :cdr :cdr)
  (:caaar :car :caar) (:caadr :car :cadr) (:cadar :car :cdar) (:caddr :car :cddr)
  (:cdaar :cdr :caar) (:cdadr :cdr :cadr) (:cddar :cdr :cdar) (:cdddr :cdr :cddr) (:cadddr :car :cdddr) (:cddddr :cdr :cdddr))
(define (:cons a b) (cons a b))
(define (:list . l) l)
(define (:append . lists) (apply append (map (lambda (l) (need-list 'append l)) lists)))
(define (:reverse l) (reverse (need-list 'reverse l)))
(define (:length l) (length (need-list 'length l)))
(define (:last l) (if (null? (need-list 'last l)) '() (last l)))
(define (:nth n l)
  (let loop ((n (need-whole 'nth n)) (l (need-list 'nth l))) (cond ((or (< n 0) (null? l)) '()) ((= n 0) (car l)) (else (loop (- n 1) (cdr l))))))
(define (:member v l) (let loop ((l (need-list 'member l))) (cond ((null? l) '()) ((same? v (car l) 0) l) (else (loop (cdr l))))))
(define (:assoc key l)
  (let loop ((l (need-list 'assoc l)))
    (cond ((null? l) '()) ((and (pair? (car l)) (same? key (caar l) 0)) (car l)) (else (loop (cdr l))))))
(define (:subst new old l) (map (lambda (v) (if (same? v old 0) new v)) (need-list 'subst l)))
(define (:vl-remove v l) (filter (lambda (x) (not (same? v x 0))) (need-list 'vl-remove l)))
(define (:vl-remove-if f l) (let ((f (function-of 'vl-remove-if f))) (filter (lambda (x) (null? (f x))) (need-list 'vl-remove-if l))))
(define (:vl-remove-if-not f l)
  (let ((f (function-of 'vl-remove-if-not f))) (filter (lambda (x) (not (null? (f x)))) (need-list 'vl-remove-if-not l))))
(define (:vl-sort l f) (let ((f (function-of 'vl-sort f))) (sort (need-list 'vl-sort l) (lambda (a b) (not (null? (f a b)))))))

; ---- strings ----

(define (:strcat . l) (apply string-append (map (lambda (s) (need-string 'strcat s)) l)))
(define (:strlen . l) (apply + (map (lambda (s) (string-length (need-string 'strlen s))) l)))
(define (:substr s start . count)
  (let* ((n (string-length (need-string 'substr s))) (from (min n (- (max 1 (need-whole 'substr start)) 1))))
    (substring s from (if (pair? count) (min n (+ from (max 0 (need-whole 'substr (car count))))) n))))
(define (:strcase s . lower)
  ((if (or (null? lower) (null? (car lower))) string-upcase string-downcase) (need-string (quote strcase) s)))
(define (:itoa n) (digits (need-whole 'itoa n)))
(define (:chr n) (string (integer->char (need-whole 'chr n))))
(define (:ascii s) (if (string=? (need-string 'ascii s) "") 0 (char->integer (string-ref s 0))))
; Returns true if the first n characters are those of decimal numbers alone: no fraction, base or name of Scheme.
(define (plain-number? s n)
  (let loop ((i 0)) (or (= i n) (and (string-index "0123456789+-.eE" (string-ref s i)) (loop (+ i 1))))))
; Returns the number that a text begins with, or 0.
(define (leading s)
  (let loop ((n (string-length s)))
    (if (= n 0) 0
        (let ((v (and (plain-number? s n) (string->number (substring s 0 n))))) (or v (loop (- n 1)))))))
(define (:atof s) (exact->inexact (leading (need-string 'atof s))))
(define (:atoi s) (in-range (exact (truncate (leading (need-string 'atoi s))))))
; Returns the number of decimals that follows a mode.
(define (places-in who how default)
  (let ((n (if (and (pair? how) (pair? (cdr how))) (need-whole who (cadr how)) default)))
    (if (<= 0 n 100) n (refuse who "a number of decimals from 0 to 100" n))))
(define (:rtos n . how)
  (let ((mode (if (pair? how) (car how) 2)) (places (places-in 'rtos how 4)))
    (case mode
      ((1) (if (finite? (need-number 'rtos n)) (scientific n places) (infinite-text n)))
      ((2) (if (finite? (need-number 'rtos n)) (fixed n places) (infinite-text n)))
      (else (error 'rtos "mode 1 (scientific) or 2 (decimal) is needed, got ~a" (shown mode))))))
(define (:angtos a . how) (let ((n (radians->degrees (need-number 'angtos a))) (places (places-in 'angtos how 0))) (if (finite? n) (fixed n places) (infinite-text n))))
