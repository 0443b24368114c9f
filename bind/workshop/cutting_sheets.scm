; Flat parts on sheets: packed, with kerf and micro-joints, in the order in which a laser cuts. After tables.scm. Names
; that begin with % are hidden from programs. Compiled into the binary when it is built.

; Returns the object with f applied to each of its regions, and g to each other curve or text; layers, materials and
; placements are kept. f and g return an object or a list.
(define (%map-flat o f g)
  (case (object-kind o)
    ((layer with-material transform unite) (%object-with o (map (lambda (c) (%map-flat c f g)) (object-children o))))
    (else (if (region? o) (f o) (g o)))))

; Returns the regions of a part where they are; of a part without regions, its closed curves as regions.
(define (%part-regions o)
  (define (of o closed?)
    (case (object-kind o)
      ((layer with-material) (of (car (object-children o)) closed?))
      ((transform) (map (lambda (r) (do-transform r (car (object-arguments o)))) (of (car (object-children o)) closed?)))
      ((unite) (append-map (lambda (c) (of c closed?)) (object-children o)))
      (else
        (cond ((region? o) (list o))
              ((and closed? (curve? o) (%closed-curve? o)) (list (make-region o)))
              (else '())))))
  (let ((regions (of o #f)))
    (if (null? regions) (of o #t) regions)))

(define (%closed-curve? c)
  (let ((ends (curve-division c 2)))
    (<= (distance (first ends) (last ends)) (* 1e-9 (curve-length c)))))

; Returns the part's outline as one region, or refuses the part. noun: the caller's parameter.
(define (%part-region who noun part)
  (let ((regions (and (object? part) (not (solid? part)) (%part-regions part))))
    (if (or (not regions) (null? regions))
        (error who "~a regions, closed curves, or unions with them, got ~s~a" noun part
          (if (and (object? part) (solid? part)) "; do-section cuts a solid, unfold lays it flat" "")))
    (let ((whole (if (null? (cdr regions)) (car regions) (unite regions))))
      (if (not (region? whole)) (error who "the regions of a part must lie in one plane, got ~s" part))
      whole)))

; Returns the region of a slice, a rib or a net, without the curves on it.
(define (part-region part) (%part-region 'part-region "part must have" part))

; Returns a closed curve as n open ones, with gaps of this width between them.
(define (%with-joints curve n width)
  (let* ((l (curve-length curve)) (pitch (/ l n)))
    (if (<= pitch (* 2 width))
        (list curve)
        (map (lambda (i) (%curve-stretch curve (+ (* i pitch) (/ width 2)) (- (* (+ i 1) pitch) (/ width 2)))) (iota n)))))

; Returns the part of a curve from one length to another, as a line with its corners.
(define (%curve-stretch curve from to) (make-line (%curve-points curve from to)))
(define (%curve-points curve from to)
  (let* ((corners (%curve-corners curve))
         (inner (filter (lambda (c) (< (+ from 1e-9) (cdr c) (- to 1e-9))) corners)))
    (append (list (curve-point curve from)) (map car inner) (list (curve-point curve to)))))

; Returns the corners of a curve, with their lengths from its start.
(define (%curve-corners curve)
  (let* ((line (lowered curve))
         (points (if (eq? (object-kind line) 'line) (car (object-arguments line)) (curve-division curve 128))))
    (let loop ((l points) (at 0) (made '()))
      (if (null? l)
          (reverse made)
          (loop (cdr l) (+ at (if (null? (cdr l)) 0 (distance (car l) (cadr l)))) (cons (cons (car l) at) made))))))

; Returns the parts in a list and in the lists within it, down to n levels. Deeper lists stay, and no caller takes them:
; a list that contains itself is deeper than any n.
(define (%parts-within l n)
  (append-map (lambda (x) (if (and (list? x) (> n 0)) (%parts-within x (- n 1)) (list x))) l))

; Returns the curves of a part, or of a list of parts, in the order in which a laser cuts: what is engraved, then for each
; part inner borders, then outer borders.
(define (cut-lines part #:kerf [kerf any? 0] #:tabs [tabs any? #f])
  (if (not (or (object? part) (and (list? part) (every object? (%parts-within part 8)))))
      (error 'cut-lines "part must be an object or a list of objects, got ~s" part))
  (%need-kerf 'cut-lines kerf)
  (%need-tabs 'cut-lines tabs)
  (let ((made (map (lambda (p) (%cut-lines p kerf tabs)) (if (list? part) (%parts-within part 8) (list part)))))
    (append (append-map car made) (append-map cdr made))))

; Returns a pair of lists: the curves of a part that are engraved, and the borders, inner ones first.
(define (%cut-lines part kerf tabs)
  (let ((engraved '()) (inner '()) (outer '()))
    (define (within wrap o)
      (case (object-kind o)
        ((layer) (let ((name (car (object-arguments o)))) (within (lambda (x) (wrap (layer name x))) (car (object-children o)))))
        ((with-material) (let ((m (car (object-arguments o)))) (within (lambda (x) (wrap (with-material m x))) (car (object-children o)))))
        ((transform) (let ((m (car (object-arguments o)))) (within (lambda (x) (wrap (do-transform x m))) (car (object-children o)))))
        ((unite) (if (region? o) (cut wrap o) (for-each (lambda (c) (within wrap c)) (object-children o))))
        (else (if (region? o) (cut wrap o) (set! engraved (cons (wrap o) engraved))))))
    (define (cut wrap o)
      (let ((curves (outline (if (= kerf 0) o (do-offset o (/ kerf 2))))))
        (for-each
          (lambda (c)
            (if (%hole-of? c curves)
                (set! inner (cons (wrap c) inner))
                (for-each (lambda (x) (set! outer (cons (wrap x) outer)))
                  (if tabs (%with-joints c (first tabs) (second tabs)) (list c)))))
          curves)))
    (within values part)
    (cons (reverse engraved) (append (reverse inner) (reverse outer)))))

; Returns true if a curve of an outline bounds a hole: an odd number of the other curves surround it.
(define (%hole-of? c curves)
  (let ((p (curve-point c 0)))
    (odd? (length (filter (lambda (d) (and (not (eq? c d)) (contains? (make-region d) p))) curves)))))

(define (%need-kerf who kerf)
  (if (not (and (real? kerf) (finite? kerf) (>= kerf 0))) (error who "kerf must be a number of 0 or more, got ~s" kerf)))
(define (%need-tabs who tabs)
  (if (not (or (not tabs)
               (and (list? tabs) (= (length tabs) 2) (exact-integer? (first tabs)) (> (first tabs) 0)
                    (real? (second tabs)) (finite? (second tabs)) (> (second tabs) 0))))
      (error who "tabs must be (list number width), such as (list 4 0.5), got ~s" tabs)))

; Returns the turns that are allowed, as a list of angles; the empty list leaves the choice to the search.
(define (%pack-angles turn)
  (cond ((eq? turn 'any) '())
        ((eq? turn 'none) '(0))
        ((and (list? turn) (pair? turn) (every (lambda (a) (and (real? a) (finite? a))) turn) (<= (length turn) 360)) turn)
        (else (error 'pack-parts "turn must be 'any, 'none or a list of angles, got ~s" turn))))

(define (%pack-copies parts count)
  (let ((counts (if (list? count) count (map (lambda (p) count) parts))))
    (if (not (and (= (length counts) (length parts)) (every (lambda (n) (and (exact-integer? n) (<= 0 n 10000))) counts)))
        (error 'pack-parts "count must be an exact integer from 0 to 10000, or a list of them, one for each part, got ~s" count))
    (append-map (lambda (p n) (make-list n p)) parts counts)))

(define (%short x) (let ((r (/ (round (* 1000. x)) 1000))) (if (= r (round r)) (exact (round r)) r)))

; Returns the part moved by `move`, which its layers and unions pass down, so that their boxes stay tight.
(define (%placed o move)
  (case (object-kind o)
    ((layer with-material) (%object-with o (list (%placed (car (object-children o)) move))))
    ((transform) (%placed (car (object-children o)) (let ((m (car (object-arguments o)))) (lambda (x) (move (do-transform x m))))))
    ((unite) (if (region? o) (move o) (%object-with o (map (lambda (c) (%placed c move)) (object-children o)))))
    (else (move o))))

; Returns sheets, each a list of the parts that are placed on it, with all that lies on them.
(define (pack-parts parts #:sheet sheet #:gap [gap any? 0] #:margin [margin any? 0] #:turn [turn any? 'any]
                    #:count [count any? 1] #:kerf [kerf any? 0] #:tabs [tabs any? #f] #:effort [effort any? 1])
  (let ((parts (cond ((object? parts) (list parts)) ((list? parts) (%parts-within parts 8)) (else parts))))
    (if (not (list? parts)) (error 'pack-parts "parts must be a list of objects, got ~s" parts))
    (if (not (and (list? sheet) (= (length sheet) 2) (every (lambda (x) (and (real? x) (finite? x) (> x 0))) sheet)))
        (error 'pack-parts "sheet must be (list width height), two positive numbers, got ~s" sheet))
    (for-each (lambda (name x) (if (not (and (real? x) (finite? x) (>= x 0))) (error 'pack-parts "~a must be a number of 0 or more, got ~s" name x)))
      '(gap margin) (list gap margin))
    (%need-kerf 'pack-parts kerf)
    (%need-tabs 'pack-parts tabs)
    (if (not (and (real? effort) (<= 0 effort 1000))) (error 'pack-parts "effort must be a number from 0 to 1000, got ~s" effort))
    (let* ((angles (%pack-angles turn))
           (given (if (= kerf 0) parts (map (lambda (p) (if (object? p) (%map-flat p (lambda (r) (do-offset r (/ kerf 2))) values) p)) parts)))
           (regions (map (lambda (p) (%part-region 'pack-parts "parts must be" p)) given))
           (all (%pack-copies given count))
           (found (%pack-parts (%pack-copies regions count) (list (first sheet) (second sheet) gap margin effort) angles)))
      (if (integer? found) (%refuse-part (list-ref (%pack-copies regions count) found) sheet margin angles))
      (let ((placed (map (lambda (p f) (cons (car f) (%placed p (lambda (x) (do-transform x (cdr f)))))) all found)))
        (map (lambda (i)
               (%packed-sheet (filter-map (lambda (p) (and (= (car p) i) (cdr p))) placed) tabs))
             (iota (if (null? placed) 0 (+ 1 (apply max (map car placed))))))))))

; Returns the parts of a sheet, small ones first, so that a part in the hole of another is cut before it.
(define (%packed-sheet parts tabs)
  (define (size p) (let ((b (bounding-box p))) (* (- (cx (second b)) (cx (first b))) (- (cy (second b)) (cy (first b))))))
  (let ((sorted (map cdr (list-sort (lambda (a b) (< (car a) (car b))) (map (lambda (p) (cons (size p) p)) parts)))))
    (if tabs (map (lambda (p) (unite (cut-lines p #:tabs tabs))) sorted) sorted)))

(define (%refuse-part region sheet margin angles)
  (let ((b (bounding-box region)))
    (error 'pack-parts "a part of ~a by ~a is larger than the sheet of ~a by ~a~a~a"
      (%short (- (cx (second b)) (cx (first b)))) (%short (- (cy (second b)) (cy (first b))))
      (%short (first sheet)) (%short (second sheet))
      (if (> margin 0) (format " with its margin of ~a" (%short margin)) "")
      (if (equal? angles '(0)) "; #:turn 'any lets it turn" ""))))
