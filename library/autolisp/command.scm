; (command ...): a command asks for one answer after the other, and may get them from several calls.
;
; A question is the state of the command between two answers: what it asks for, its options, the conversion of an
; answer, and a procedure that gets the converted answer and returns the next question, or #f at the end.

(define-record-type |%question| (make-question what options convert next) question?
  (what question-what) (options question-options) (convert question-convert) (next question-next))
(define command-name #f)
(define question #f)
(define last-point (xyz 0 0 0))
(define commands (make-hash))

; (asks "a radius" convert next option ...); an option is (word . thunk), as in ("Top radius" . ...). "" is Enter.
(define (asks what convert next . options) (make-question what options convert next))
(define-syntax option (syntax-rules () ((_ word body ...) (cons word (lambda () body ...)))))

; (define-command '("NAME" "ALIAS" ...) question): the question is made anew for each use of the command.
(define-syntax define-command
  (syntax-rules (quote) ((_ (quote (name ...)) body ...) (let ((start (lambda () body ...))) (hash-set! commands name start) ...))))

; Returns a text without the marks that AutoCAD permits before names: _ . -
(define (name-of s)
  (let loop ((i 0)) (if (and (< i (string-length s)) (memv (string-ref s i) '(#\_ #\. #\- #\'))) (loop (+ i 1)) (substring s i))))

(define (capitals word)
  (let loop ((i 0))
    (if (and (< i (string-length word)) (let ((c (string-ref word i))) (or (char-upper-case? c) (char-numeric? c)))) (loop (+ i 1)) (substring word 0 i))))
; Returns true if the answer is the option's name, or a part of it that contains the capital letters at its start.
(define (names-option? answer word)
  (let ((a (string-upcase (name-of answer))) (w (string-upcase word)))
    (if (or (string=? answer "") (string=? word ""))
        (string=? answer word)
        (and (>= (string-length a) (string-length (capitals word))) (<= (string-length a) (string-length w))
             (string=? a (substring w 0 (string-length a)))))))

(define (answered q answer)
  (let ((chosen (and (string? answer) (find (lambda (o) (and (string? (car o)) (names-option? answer (car o)))) (question-options q)))))
    (if chosen
        ((cdr chosen))
        (let ((v ((question-convert q) answer)))
          (if v
              ((question-next q) v)
              (error 'command "~a asks for ~a, got ~a" command-name (question-what q) (shown answer)))))))

(define (started word)
  (let* ((name (if (string? word) (string-upcase (name-of word)) (refuse 'command "the name of a command" word)))
         (start (hash-ref commands name #f)))
    (cond ((string=? word "") #f)
          (start (set! command-name name) (start))
          (else (error 'command "~a is not a command of this language" name)))))

(define (:command . answers)
  (if (null? answers) (set! question #f))
  (for-each (lambda (a) (set! question (if question (answered question a) (started a)))) answers)
  (if (and question (assoc 'end (question-options question))) (set! question #f))
  '())
(define (:vl-cmdf . answers) (apply :command answers) t-value)

; At the end of the program: Enter, where the command accepts it.
(define (finish-command!)
  (if question
      (if (assoc "" (question-options question))
          (set! question (answered question ""))
          (let ((q question)) (set! question #f) (error 'command "~a still asks for ~a" command-name (question-what q))))))

; ---- conversions: #f refuses an answer ----

(define (as-number v) (cond ((number? v) v) ((string? v) (let ((n (string->number v))) (and n (real? n) n))) (else #f)))
(define (as-count v) (let ((n (as-number v))) (and n (exact-integer? n) (> n 0) n)))
(define (as-text v) (and (string? v) v))

; A text of a point: "1,2,3", "@1,0" from the last point, "@2<45" by distance and degrees.
(define (point-of-text s)
  (let* ((from-last (and (> (string-length s) 0) (char=? (string-ref s 0) #\@))) (s (if from-last (substring s 1) s))
         (polar (string-split s "<")) (parts (map string->number (string-split s ",")))
         (p (cond ((and from-last (string=? s "")) (xyz 0 0 0))
                  ((and (= (length polar) 2) (string->number (car polar)) (string->number (cadr polar)))
                   (pol (string->number (car polar)) (degrees->radians (string->number (cadr polar)))))
                  ((and (<= 2 (length parts) 3) (every number? parts)) (need-point 'command parts))
                  (else #f))))
    (and p (if from-last (p+v last-point (p->q (xyz 0 0 0) p)) p))))
(define (as-point v)
  (let ((p (cond ((point-list? v) (need-point 'command v)) ((string? v) (point-of-text v)) (else #f))))
    (if p (set! last-point p))
    p))
(define (as-length-from p) (lambda (v) (or (as-number v) (let ((q (as-point v))) (and q (distance p q))))))
(define (as-degrees v) (let ((n (as-number v))) (and n (degrees->radians n))))
(define (as-degrees-from p)
  (lambda (v) (or (as-degrees v) (let ((q (as-point v))) (and q (atan (- (cy q) (cy p)) (- (cx q) (cx p))))))))

; Asks for objects up to Enter; the next question gets their list.
(define (asks-objects next)
  (define (chosen l)
    (define (add items) (chosen (append l (filter (lambda (e) (and (entity-live? e) (not (memq e l)))) items))))
    (asks "objects, and Enter (\"\") at their end" as-items add
      (option "" (if (null? l) (error 'command "~a has no objects" command-name)) (set! previous l) (next l))
      (option "Last" (add (if (newest) (list (newest)) '())))
      (option "Previous" (add previous))
      (option "ALL" (add (live-entities)))))
  (chosen '()))
(define (as-items v)
  (cond ((entity? v) (list v)) ((selection? v) (selection-items v))
        ((and (pair? v) (entity? (car v))) (list (car v))) (else #f)))
(define (as-item v) (let ((l (as-items v))) (and l (= (length l) 1) (car l))))
(define (asks-object what next)
  (asks what as-item next (option "Last" (next (or (newest) (error 'command "~a has no objects" command-name))))))
