; Clashes of parts: pairs that overlap, touch, or are nearer than a clearance.

(define-record-type clash (make-clash kind parts names place volume area gap) clash?
  (kind clash-kind) (parts clash-parts) (names clash-names) (place clash-place) (volume clash-volume) (area clash-area) (gap clash-gap))

; Returns the parts of a model: the elements of a list, or the members of a union.
(define (parts-of who parts)
  (define (fault x) (error who "parts must be a list of solids, got ~s" x))
  (let ((all (cond ((list? parts) parts)
                   ((not (object? parts)) (fault parts))
                   ((eq? (object-kind parts) 'unite) (object-children parts))
                   (else (list parts)))))
    (for-each
      (lambda (p) (if (not (and (object? p) (or (solid? p) (empty-object? p)))) (fault p)))
      (flatten all))
    (map (lambda (p) (if (list? p) (unite p) p)) all)))

; Returns the title of part number i: its name, else its layer, else i.
(define (part-title o i) (or (object-part o) (object-layer o) i))

(define clash-kinds '#(overlap touch near))         ; the order of vs_clash_kind

(define (clashes parts #:clearance [clearance any? 0])
  (if (not (and (real? clearance) (finite? clearance) (>= clearance 0)))
      (error 'clashes "clearance must be a number of 0 or more, got ~s" clearance))
  (let* ((all (list->vector (parts-of 'clashes parts)))
         (titles (vector-map part-title all (list->vector (iota (vector-length all) 1))))
         (found (core:clashes (map core:drawn (vector->list all)) clearance))
         (pair-of (lambda (v c) (list (vector-ref v (second c)) (vector-ref v (third c))))))
    (map (lambda (c)
           (make-clash (vector-ref clash-kinds (first c)) (pair-of all c) (pair-of titles c) (fourth c) (fifth c) (list-ref c 5) (list-ref c 6)))
      found)))
