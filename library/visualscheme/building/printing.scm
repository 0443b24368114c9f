; Checks of solids that are to be printed: thin walls, overhangs, voids, loose pieces, narrow gaps.

(define-record-type print-fault (make-print-fault kind place value area) print-fault?
  (kind print-fault-kind) (place print-fault-place) (value print-fault-value) (area print-fault-area))

(define print-kinds '#(wall overhang void piece gap))   ; the order of vs_print_kind

; Returns the solid to check: the object, or the union of a list.
(define (solid-to-print who o)
  (let ((one (if (and (list? o) (every object? (flatten o))) (unite o) o)))
    (if (not (and (object? one) (or (solid? one) (empty-object? one)))) (error who "o must be a solid, got ~s" o))
    (core:drawn one)))

(define (faults-of solid wall overhang gap)
  (map (lambda (f) (make-print-fault (vector-ref print-kinds (first f)) (second f) (third f) (fourth f)))
    (core:check-print solid wall overhang gap)))

; The defaults are 0.8 mm, 45 degrees and 0.3 mm.
(define (check-print o #:wall [wall any? (/ 0.0008 (core:model-metres))] #:overhang [overhang any? pi/4]
                       #:gap [gap any? (/ 0.0003 (core:model-metres))])
  (define (length-of name x)
    (if (not (or (not x) (and (real? x) (finite? x) (>= x 0)))) (error 'check-print "~a must be a number of 0 or more, or #f, got ~s" name x))
    (or x 0))
  (let ((wall (length-of "wall" wall)) (gap (length-of "gap" gap)))
    (if (not (or (not overhang) (and (real? overhang) (<= 0 overhang pi/2))))
        (error 'check-print "overhang must be radians from 0 to pi/2, or #f, got ~s; (degrees->radians 45) is 45 degrees" overhang))
    (faults-of (solid-to-print 'check-print o) wall (or overhang 4) gap)))

; Returns the wall with the least thickness, or #f. The limit grows until there is a wall below.
(define (thinnest-wall o)
  (let ((solid (solid-to-print 'thinnest-wall o)))
    (and (not (empty-object? solid))
         (let* ((size (apply distance (bounding-box solid)))
                (found (lambda (limit) (filter (lambda (f) (eq? (print-fault-kind f) 'wall)) (faults-of solid limit 4 0)))))
           (let grow ((limit (/ size 1024)))
             (let ((walls (found limit)))
               (cond ((pair? walls) (car walls)) ((> limit size) #f) (else (grow (* 4 limit))))))))))
