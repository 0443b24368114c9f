; The search: it follows all possible matches at the same time, character by character. A way is #(state start saved): a
; state that takes a character, the start of the match, and the ends of submatches as a list of (place . position), the
; latest first. Ways are in order of preference, earlier starts first; when several reach a state, the first stays.
; Therefore a step costs at most one way for each state.

; A match: the text and, for each submatch, a pair of positions or #f.
(define-record-type match-type (make-match regexp text ends) regexp-match?
  (regexp match-regexp)
  (text match-text)
  (ends match-ends))

(define (ends-of re saved)
  (let ((ends (make-vector (+ (regexp-count re) 1) #f)))
    (for-each (lambda (number)
                (let ((begun (assv (* 2 number) saved)) (ended (assv (+ (* 2 number) 1) saved)))
                  (if (and begun ended (<= (cdr begun) (cdr ended)))
                      (vector-set! ends number (cons (cdr begun) (cdr ended))))))
              (iota (+ (regexp-count re) 1)))
    ends))

; Searches the text for a match that begins at `from` or later; `anchored?`: at `from` only; `whole?`: it must end at
; `to`. Tests of a position see the part from `first` to `to`. Returns a match or #f.
(define (find-match re text first from to anchored? whole?)
  (define lazy? (and (regexp-lazy? re) (not whole?)))
  (define best #f)                           ; #(state start saved) of the best match so far; its state is `found`
  (define ways '())                          ; the ways of the next step, the latest first
  (define (better? start) (or (not best) (= start (vector-ref best 1))))
  ; Follows a state to those that take a character. Returns #t if the later ways no longer count.
  (define (follow state start saved i step)
    (if (= (vector-ref state 0) step)
        #f
        (begin
          (vector-set! state 0 step)
          (case (vector-ref state 1)
            ((take) (set! ways (cons (vector state start saved) ways)) #f)
            ((fork) (or (follow (vector-ref state 2) start saved i step) (follow (vector-ref state 3) start saved i step)))
            ((save) (follow (vector-ref state 3) start (cons (cons (vector-ref state 2) i) saved) i step))
            ((test) (and ((vector-ref state 2) text first to i) (follow (vector-ref state 3) start saved i step)))
            (else
             (if (and (better? start) (or (not whole?) (= i to)))
                 (set! best (vector state start saved)))
             lazy?)))))
  (define (advance left c i step)
    (if (pair? left)
        (let* ((way (car left)) (state (vector-ref way 0)))
          (if (not (and (better? (vector-ref way 1))
                        ((vector-ref state 2) c)
                        (follow (vector-ref state 3) (vector-ref way 1) (vector-ref way 2) i step)))
              (advance (cdr left) c i step)))))
  (let loop ((i from) (now '()) (step (+ (regexp-step re) 1)))
    (set! ways '())
    (set-regexp-step! re step)
    (if (pair? now) (advance now (string-ref text (- i 1)) i step))
    (if (and (not best) (or (= i from) (not anchored?)))
        (follow (regexp-start re) i '() i step))
    (if (or (= i to) (and (null? ways) (or best anchored?)))
        (and best (make-match re text (ends-of re (vector-ref best 2))))
        (loop (+ i 1) (reverse ways) (+ step 1)))))
