; Back-ends that a program defines: (define-back-end name suffix procedure ...) makes -o file.suffix call the procedure
; with the drawing's objects and a port. After primitives.scm. A registered back-end runs when a drawing is handed over,
; in the run loop, like drawing functions.

(define %back-ends '()) ; #(name procedure kinds templates? binary?), newest first

; The name is a symbol, quoted or not.
(define-syntax define-back-end
  (er-macro-transformer
    (lambda (form rename compare)
      (if (and (list? form) (>= (length form) 4))
          `(,(rename '%define-back-end)
            ,(if (identifier? (cadr form)) (list (rename 'quote) (cadr form)) (cadr form))
            ,@(cddr form))
          (list (rename 'syntax-error) "define-back-end: it is written (define-back-end name suffix procedure #:doc #:kinds #:optimised #:templates #:binary)")))))

(define (%define-back-end name suffix procedure
                          #:doc [doc any? ""] #:kinds [kinds any? #f] #:optimised [optimised any? #f] #:templates [templates any? #f] #:binary [binary any? #f])
  (define (must what is got) (if (not is) (error 'define-back-end "~a, got ~s" what got)))
  (must "name must be a symbol" (symbol? name) name)
  (must "suffix must be a string of letters and digits, such as \"csv\"" (and (string? suffix) (%plain-suffix? suffix)) suffix)
  (must "procedure must be a procedure of the objects and a port" (procedure? procedure) procedure)
  (must "doc must be a string" (string? doc) doc)
  (must "kinds must be #f or a list of symbols, as object-kind gives them" (or (not kinds) (and (list? kinds) (every symbol? kinds))) kinds)
  (%back-end name suffix doc (and binary #t) (and optimised #t))
  (set! %back-ends
    (cons (vector name procedure kinds templates binary)
          (filter (lambda (b) (not (eq? (vector-ref b 0) name))) %back-ends)))
  (%host-set! 3 %write-back-end))

(define (%plain-suffix? text)
  (and (< 0 (string-length text) 17)
       (every (lambda (c) (or (char-alphabetic? c) (char-numeric? c))) (string->list text))))

; Returns the contents of the file: a string, or a bytevector of a binary back-end.
(define (%write-back-end name objects)
  (let* ((b (find (lambda (b) (eq? (vector-ref b 0) name)) %back-ends))
         (kinds (vector-ref b 2))
         (objects (if kinds (%only-kinds name kinds objects) objects))
         (binary (vector-ref b 4))
         (port (if binary (open-output-bytevector) (open-output-string)))
         (before #f))
    (dynamic-wind
      (lambda () (set! before (%handing! #t)))
      (lambda ()
        (if (vector-ref b 3)
            ((vector-ref b 1) objects port (%templates objects))
            ((vector-ref b 1) objects port)))
      (lambda () (%handing! before)))
    (if binary (get-output-bytevector port) (get-output-string port))))

; Lowers objects until they have only these kinds.
(define (%only-kinds name kinds objects)
  (define (known? o) (or (memq (object-kind o) kinds) (memq (object-kind o) '(empty-object))))
  (define (simpler o)
    (let ((made (lowered o)))
      (if (eq? (object-kind made) (object-kind o))
          (error name "this back-end knows neither ~a nor what it could be made of: its kinds are ~a" (object-kind o) kinds)
          made)))
  (%redraw objects (list (vector #f (lambda (o) (not (known? o))) simpler))))

; Returns the parts with several places, each after its own parts.
(define (%templates objects)
  (define seen (make-hash)) ; the node's number -> the number of its places
  (define order '())
  (define (visit o)
    (let* ((key (%node-number o)) (count (hash-ref seen key 0)))
      (hash-set! seen key (+ count 1))
      (if (= count 0)
          (begin
            (for-each visit (object-children o))
            (set! order (cons o order))))))
  (for-each visit objects)
  (reverse (filter (lambda (o) (> (hash-ref seen (%node-number o) 0) 1)) order)))
