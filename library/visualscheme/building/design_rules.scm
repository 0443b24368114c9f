; Rules of a design. A broken rule causes a warning at its place, a row in the list of the sheet, and red marks.

; Tests a condition. Comparisons of numbers report these, and how far they are from their bounds. The calls are no tail calls:
; their place is that of the warning.
(define-syntax require-that
  (syntax-rules (>= <= > < =)
    ((_ name (>= a ...) . where) (not (breaks-comparison? name '(>= a ...) >= (lambda () (list a ...)) . where)))
    ((_ name (<= a ...) . where) (not (breaks-comparison? name '(<= a ...) <= (lambda () (list a ...)) . where)))
    ((_ name (> a ...) . where) (not (breaks-comparison? name '(> a ...) > (lambda () (list a ...)) . where)))
    ((_ name (< a ...) . where) (not (breaks-comparison? name '(< a ...) < (lambda () (list a ...)) . where)))
    ((_ name (= a ...) . where) (not (breaks-comparison? name '(= a ...) = (lambda () (list a ...)) . where)))
    ((_ name condition . where) (not (breaks-condition? name 'condition (lambda () condition) . where)))))

; The rooms and walls that a condition has asked: a box with a list, or #f while no condition is tested.
(define asked (make-parameter #f))
(define (note-asked x)
  (let ((found (asked))) (if (and found (not (memq x (unbox found)))) (set-box! found (cons x (unbox found)))))
  x)
(define (call-asking thunk)
  (let ((found (box '()))) (let ((value (parameterize ((asked found)) (thunk)))) (cons value (unbox found)))))

(define (breaks-comparison? name form compare values-of #:at [at any? #f])
  (let* ((answer (call-asking values-of)) (values (car answer)) (met (apply compare values)))
    (record-rule name form (if met "" (values-told (cdr form) values)) (if met 0 (shortfall-of compare values)) (or at (cdr answer)))))

(define (breaks-condition? name form holds? #:at [at any? #f])
  (let ((answer (call-asking holds?))) (record-rule name form "" (if (car answer) 0 1) (or at (cdr answer)))))

; Returns "(room-area bath) is 3.2" for each expression that is no number.
(define (values-told forms values)
  (string-join (filter-map (lambda (f v) (and (not (number? f)) (format "~s is ~a" f (if (exact-integer? v) v (shown v))))) forms values) ", "))

; Returns the greatest distance of two neighbours that break the comparison, as a part of the larger.
(define (shortfall-of compare values)
  (apply max
    (map
      (lambda (a b)
        (cond ((compare a b) 0)
              ((not (and (finite? a) (finite? b))) 1)
              (else (max 1e-12 (min 1 (/ (abs (- a b)) (max 1e-300 (abs a) (abs b))))))))
      values (cdr values))))

; Returns true if the rule is broken.
(define (record-rule name form found shortfall at)
  (if (not (string? name)) (error 'require-that "name must be a string, got ~s" name))
  (core:design-rule name (format "~s" form) found (inexact shortfall) (if (= shortfall 0) '() (marks-of at)))
  (> shortfall 0))

(define mark-radius 0.2) ; of the ball at a point, in metres

; Returns the objects that show a fault: the air of a room, a ball at a point, others themselves.
(define (marks-of at)
  (append-map
    (lambda (x)
      (cond ((space? x) (list (do-scale (room-solid x) (centroid (room-solid x)) 0.99)))
            ((point? x) (list (make-sphere x (/ mark-radius (core:model-metres)))))
            ((object? x) (list (core:drawn x)))
            (else (error 'require-that "at must be rooms, objects or points, got ~s" x))))
    (flatten (list at))))
