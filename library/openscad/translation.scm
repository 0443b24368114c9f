; The text of the Scheme program that an OpenSCAD program becomes, for vs translate.

(define only-translates? #f)
; Makes scad:program print the next program that it gets, instead of running it.
(define (scad-translate!) (set! only-translates? #t))

; (define name (lambda (parameters) body)) is written as (define (name . parameters) body).
(define (written form)
  (if (and (pair? form) (eq? (car form) 'define) (pair? (caddr form)) (eq? (car (caddr form)) 'lambda))
      (append (list 'define (cons (cadr form) (cadr (caddr form)))) (map plain (cddr (caddr form))))
      (plain form)))
(define (nested-lets form bindings)
  (if (and (pair? form) (eq? (car form) 'let) (pair? (cadr form)) (null? (cdr (cadr form))) (null? (cdddr form)))
      (nested-lets (caddr form) (cons (list (caar (cadr form)) (plain (cadar (cadr form)))) bindings))
      (list (reverse bindings) form)))
; Returns the form with rows of let as one let*, and with (begin a (begin b c)) as (begin a b c).
(define (plain form)
  (cond ((not (pair? form)) form)
        ((eq? (car form) 'quote) form)
        ((and (eq? (car form) 'let) (pair? (cadr form)))
         (let ((found (nested-lets form '())))
           (if (and (pair? (car found)) (pair? (cdar found))) (append (list 'let* (car found)) (body-forms (cadr found)))
               (append (list 'let (map (lambda (b) (list (car b) (plain (cadr b)))) (cadr form))) (append-map body-forms (cddr form))))))
        ((eq? (car form) 'begin) (cons 'begin (append-map body-forms (cdr form))))
        ((eq? (car form) 'lambda) (append (list 'lambda (cadr form)) (append-map body-forms (cddr form))))
        (else (map plain form))))
(define (body-forms form) (if (and (pair? form) (eq? (car form) 'begin)) (append-map body-forms (cdr form)) (list (plain form))))

; Variables are defined as undef, and get their values later. Returns the forms with such a definition at the place of
; the value, unless a procedure of the program may need the variable before.
(define (calls-own? form) (cond ((pair? form) (or (calls-own? (car form)) (calls-own? (cdr form)))) ((symbol? form) (let ((s (symbol->string form))) (and (> (string-length s) 2) (string=? (substring s 0 2) "f:")))) (else #f)))
(define (starts? form word) (and (pair? form) (eq? (car form) word)))
(define (early? form) (and (starts? form 'define) (equal? (caddr form) ''undef)))
(define (merged forms)
  (let ((values (filter (lambda (f) (or (starts? f 'set!) (starts? f 'scad:parameter))) forms)))
    (let loop ((l values) (late '()))
      (if (or (null? l) (and (starts? (car l) 'set!) (calls-own? (caddr (car l)))))
          (filter (lambda (x) x) (map (lambda (f) (cond ((and (early? f) (memq (cadr f) late)) #f) ((and (starts? f 'set!) (memq (cadr f) late)) (list 'define (cadr f) (caddr f))) (else f))) forms))
          (loop (cdr l) (cons (cadr (car l)) late))))))

(define (print-translation forms)
  (set! only-translates? #f)
  (write '(import (openscad)))
  (newline)
  (let loop ((l (merged forms)) (before #f))
    (if (pair? l)
        (let ((kind (caar l)))
          (if (not (and (eq? kind before) (memq kind '(scad:parameter define)) (not (pair? (caddr (car l)))))) (newline))
          (write (written (car l)))
          (newline)
          (loop (cdr l) kind)))))
