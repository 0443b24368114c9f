; The customizer: the comments beside the first assignments of a file describe parameters that a user may set.
;
;   // The width of the plate        the description, in the line before
;   width = 30; // [10:5:60]         the least, the step and the greatest value; [60] is the greatest alone
;   head = "hex"; // [hex, round:Round head]      the choices, some with a label
;   /* [Screws] */                   the group of those that follow; those of [Hidden] stay constants

(define (trim s)
  (let* ((l (string->list s)) (cut (lambda (l) (let loop ((l l)) (if (and (pair? l) (char-whitespace? (car l))) (loop (cdr l)) l))))) (list->string (reverse (cut (reverse (cut l)))))))
(define (pieces s mark)
  (let loop ((l (string->list s)) (piece '()) (all '()))
    (cond ((null? l) (map trim (reverse (cons (list->string (reverse piece)) all))))
          ((char=? (car l) mark) (loop (cdr l) '() (cons (list->string (reverse piece)) all)))
          (else (loop (cdr l) (cons (car l) piece) all)))))
(define (inside s) (let ((n (string-length s))) (and (> n 1) (char=? (string-ref s 0) #\[) (char=? (string-ref s (- n 1)) #\]) (substring s 1 (- n 1)))))
(define (as-number s) (let ((x (string->number s))) (and x (real? x) (exact->inexact x))))
(define (bare s) (let ((n (string-length s))) (if (and (> n 1) (char=? (string-ref s 0) #\") (char=? (string-ref s (- n 1)) #\")) (substring s 1 (- n 1)) s)))

; Returns the keywords with the range or the choices of a comment, or an empty list.
(define (allowed value comment)
  (let* ((text (and comment (inside (trim comment)))) (numbers (and text (map as-number (pieces text #\:)))))
    (cond ((not text) '())
          ((and (number? value) (<= (length numbers) 3) (every values numbers)) (range-keywords value numbers))
          ((or (number? value) (string? value)) (choice-keywords value (map (lambda (c) (car (pieces c #\:))) (pieces text #\,))))
          (else '()))))
(define (range-keywords value l)
  (let* ((low (if (pair? (cdr l)) (car l) 0.0)) (high (car (reverse l))) (step (if (= (length l) 3) (cadr l) #f)))
    (if (and (< low high) (<= low value high)) (append (list (quote #:min) low (quote #:max) high) (if (and step (> step 0.0)) (list (quote #:step) step) '())) '())))
(define (choice-keywords value l)
  (let ((l (if (number? value) (map as-number l) (map bare l))))
    (if (and (every values l) (pair? (cdr l)) (member value l)) (list (quote #:choices) (list 'quote l)) '())))

; Returns the number, string or truth value of an expression, as a list of one, or #f.
(define (constant-value e)
  (cond ((constant? e) (list e)) ((and (pair? e) (eq? (car e) 'negate) (number? (cadr e))) (list (- (cadr e)))) (else #f)))
(define (parameter? t) (and (pair? (cdddr t)) (constant-value (caddr t)) (not (special? (cadr t))) (not (equal? (list-ref t 5) "Hidden"))))
; Returns (scad:parameter symbol value keyword ...) for the assignment of a parameter, or #f.
(define (parameter-form t s)
  (and (parameter? t)
       (let* ((value (car (constant-value (caddr t)))) (comment (list-ref t 3)) (label (list-ref t 4)) (group (list-ref t 5)) (text (lambda (x) (and x (not (string=? (trim x) "")) (trim x)))))
         (append (list (word s 'scad:parameter) (own-name (cadr t)) value) (allowed value comment)
           (if (text label) (list (quote #:label) (text label)) '()) (if (and (text group) (not (equal? (text group) "Global"))) (list (quote #:group) (text group)) '())))))
