; Quantities: embodied carbon by a table of the program, and the share of glass.

; Returns the key of an object in a table: its material's or its layer's name.
(define (keys-of o)
  (append (let ((m (object-material o))) (if m (list (format "~a" (material-name m))) '())) (let ((l (object-layer o))) (if l (list l) '()))))

(define (quantity-of o unit density)
  (case unit
    ((volume) (if (solid? o) (volume o) 0))
    ((mass) (if (solid? o) (* density (volume o)) 0))
    ((area) (if (curve? o) 0 (area o)))
    ((length) (if (curve? o) (curve-length o) 0))
    (else 1)))

; Returns rows with a head and sums: name, quantity, and the emissions of each module of EN 15804. table: lists of a material or
; layer, a unit, and for each module a factor; a mass is a list of 'mass and a density.
(define (carbon objects table #:modules [modules any? '("A1-A3")])
  (if (not (and (list? modules) (pair? modules) (every string? modules))) (error 'carbon "modules must be names such as '(\"A1-A3\" \"C3\"), got ~s" modules))
  (for-each
    (lambda (row)
      (if (not (and (list? row) (= (length row) (+ 2 (length modules))) (or (memq (second row) '(volume area length count)) (and (list? (second row)) (= (length (second row)) 2) (eq? 'mass (car (second row))) (positive-number? (cadr (second row)))))
                    (every (lambda (x) (and (real? x) (finite? x))) (cddr row))))
          (error 'carbon "a row must be a name, 'volume, 'area, 'length, 'count or (list 'mass density), and ~a factors, got ~s" (length modules) row)))
    table)
  (let* ((all (if (list? objects) (flatten objects) (list objects))) (rows (map (lambda (row) (cons (format "~a" (first row)) (cdr row))) table))
         (amounts (map (lambda (row) (list row '())) rows)) (of (make-hash)))
    (for-each
      (lambda (o)
        (let ((row (find (lambda (r) (member (first r) (keys-of o))) rows)))
          (if (not row) (warn (format "carbon: the table has no row for an object of ~a" (let ((k (keys-of o))) (if (null? k) "no material and layer" (string-join k " on ")))))
              (let ((unit (if (pair? (second row)) 'mass (second row))))
                (hash-set! of (first row) (+ (hash-ref of (first row) 0) (quantity-of o unit (if (pair? (second row)) (cadr (second row)) 1))))))))
      all)
    (let ((body (filter-map (lambda (row) (let ((q (hash-ref of (first row) #f))) (and q (append (list (first row) q) (map (lambda (f) (* f q)) (cddr row)))))) rows)))
      (append (list (append '("name" "quantity") modules)) body
        (list (append '("" "") (map (lambda (k) (apply + (map (lambda (r) (list-ref r (+ k 2))) body))) (iota (length modules)))))))))

; Returns the share of glass in the area of a facade: of surfaces, and of panels, whose two sides count once.
(define (glass-share facade)
  (let* ((all (flatten (list facade))) (size (lambda (o) (if (solid? o) (/ (area o) 2) (area o)))) (glazed (filter (lambda (o) (member "glass" (keys-of o))) all)))
    (if (null? all) (error 'glass-share "the facade has no parts"))
    (for-each (lambda (o) (if (not (and (object? o) (not (curve? o)))) (error 'glass-share "a facade's parts must be surfaces or solids, got ~s" o))) all)
    (/ (apply + (map size glazed)) (apply + (map size all)))))
