; Files: meshes, drawings and tables of heights. A name is that of a file beside the program.

(define (ending name)
  (let loop ((l (reverse (string->list name))) (end '()))
    (cond ((null? l) "") ((char=? (car l) #\.) (string-downcase (list->string end))) (else (loop (cdr l) (cons (car l) end))))))
(define (first-text . l) (or (find string? l) #f))

(define (scad:m:import k file layer convexity origin scale width height filename layername center dpi)
  (let* ((name (first-text file filename)) (end (if name (ending name) "")))
    (cond ((not name) (warning "import: the name of a file is needed") '())
          ((member end '("stl" "off" "obj" "ply")) (attempt name (lambda () (load-mesh name #:repair #t))))
          ((member end '("3mf" "glb" "x3d")) (attempt name (lambda () (load-model name))))
          ((member end '("dxf" "svg")) (centred (imported-region name (first-text layer layername)) center))
          (else (warning "import: ~a: there is no reader for .~a" name end) '()))))
; Calls (load), and returns a list of the object; a file that cannot be read makes nothing, with a warning.
(define (attempt name load)
  (guard (e (#t (warning "import: ~a: ~a" name (condition-text e)) '())) (made (load))))
(define (condition-text e) (if (error-object? e) (error-object-message e) e))
(define (centred l center)
  (if (and (pair? l) (given center) (scad:true? center))
      (let* ((box (bounding-box (one l))) (m (mid (car box) (cadr box)))) (map (lambda (o) (do-move o (vxyz (- (cx m)) (- (cy m)) 0.0))) l))
      l))

; ---- drawings ----

(define (imported-region name layer)
  (guard (e (#t (warning "import: ~a: ~a" name (condition-text e)) '()))
    (let* ((layers (load-outline name)) (names (if (string? layer) (list layer) (hash-keys layers))) (objects (append-map (lambda (n) (hash-ref layers n '())) names))
           (regions (filter region? objects)) (curves (filter curve? objects)))
      (append regions (region-of (filter has-area? (map curve-points (append-map whole-curves curves))))))))
(define (whole-curves c) (list c))

; ---- tables of heights ----

; Returns a list of rows of numbers from the lines of a text file; # begins a comment.
(define (height-rows name)
  (call-with-input-file name
    (lambda (port)
      (let loop ((rows '()))
        (let ((line (read-line port)))
          (if (eof-object? line) (reverse rows)
              (let ((row (filter values (map string->number (words-of line))))) (loop (if (null? row) rows (cons (map exact->inexact row) rows))))))))))
(define (words-of line)
  (let loop ((l (string->list line)) (word '()) (all '()))
    (define (done) (if (null? word) all (cons (list->string (reverse word)) all)))
    (cond ((or (null? l) (char=? (car l) #\#)) (reverse (done)))
          ((char-whitespace? (car l)) (loop (cdr l) '() (done)))
          (else (loop (cdr l) (cons (car l) word) all)))))

; Each cell of the table has four triangles that meet in its middle.
(define (surface-mesh rows)
  (let* ((m (length rows)) (n (apply min (map length rows))) (v (list->vector (map list->vector (reverse rows)))) (low (- (apply min 0.0 (append-map (lambda (l) l) rows)) 1.0))
         (z (lambda (i j) (vector-ref (vector-ref v j) i))) (all (iota (* m n))) (column (lambda (a) (modulo a n))) (row (lambda (a) (quotient a n)))
         (point (lambda (a z) (xyz (exact->inexact (column a)) (exact->inexact (row a)) z)))
         (tops (map (lambda (a) (point a (z (column a) (row a)))) all)) (cells (filter (lambda (a) (and (< (column a) (- n 1)) (< (row a) (- m 1)))) all))
         (middles (map (lambda (a) (let ((i (column a)) (j (row a))) (xyz (+ i 0.5) (+ j 0.5) (/ (+ (z i j) (z (+ i 1) j) (z i (+ j 1)) (z (+ i 1) (+ j 1))) 4.0)))) cells))
         (rim (append (iota (- n 1)) (map (lambda (j) (+ (* j n) (- n 1))) (iota (- m 1))) (map (lambda (i) (- (* m n) 1 i)) (iota (- n 1))) (map (lambda (j) (* (- m 1 j) n)) (iota (- m 1)))))
         (first-middle (+ 1 (* m n))) (first-low (+ first-middle (length middles))) (next (append (cdr rim) (list (car rim)))) (lows (iota (length rim)))
         (roof (append-map (lambda (a k) (let ((c (+ first-middle k)) (p (+ a 1)) (q (+ a 2)) (r (+ a n 2)) (s (+ a n 1))) (list (list p q c) (list q r c) (list r s c) (list s p c)))) cells (iota (length cells))))
         (walls (append-map (lambda (a b k) (let ((p (+ first-low k)) (q (+ first-low (modulo (+ k 1) (length rim))))) (list (list p q (+ b 1)) (list p (+ b 1) (+ a 1))))) rim next lows)))
    (make-polyface-mesh (append tops middles (map (lambda (a) (point a low)) rim)) (append roof walls (list (reverse (map (lambda (k) (+ first-low k)) lows)))))))
(define (scad:m:surface k file center convexity invert)
  (cond ((not (string? file)) (warning "surface: the name of a file is needed") '())
        ((string=? (ending file) "png") (attempt file (lambda () (picture-surface file center))))
        (else
         (attempt file
           (lambda ()
             (let* ((rows (height-rows file)) (m (length rows)) (n (if (null? rows) 0 (apply min (map length rows)))))
               (if (or (< m 2) (< n 2)) (error 'surface "the table has fewer than two rows or columns"))
               (let ((o (surface-mesh rows)))
                 (if (and (given center) (scad:true? center)) (do-move o (vxyz (/ (- 1.0 n) 2.0) (/ (- 1.0 m) 2.0) 0.0)) o))))))))
(define (picture-surface file center) (make-height-field file origin (xyz 100.0 100.0 0.0) #:low -1.0 #:high 100.0))
