; Drawings of other programs: load-outline, and what load_dxf.scm and load_svg.scm share. Names that begin with % are hidden from
; programs. Compiled into the binary when it is built.

; Greatest number of objects of one file. Blocks within blocks could multiply without end.
(define %outline-most 1000000)

(define (%outline-fail file line text) (error 'load-outline "~a:~a: ~a" file line text))

; Calls make; its errors get the place in the file, except those that have one and those of memory and limits.
(define (%outline-at file line what make)
  (guard (e ((and (error-object? e) (memq (error-object-kind e) '(error type range arity))
                  (not (string-prefix? (error-object-message e) "load-outline: ")))
             (%outline-fail file line (string-append what ": " (condition/report-string e)))))
    (make)))

(define %identity-matrix (make-matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1))
(define (%by-matrix m o) (if (equal? m %identity-matrix) o (do-transform o m)))

; Returns "#rrggbb" of a number of 24 bits.
(define (%hex-color n) (string-append "#" (string-pad-left (number->string n 16) 6 #\0)))

; Returns the curve through a list of steps, each (line point) or (curve c end). Straight pieces in a row become one
; line. #f if the path is a single point.
(define (%joined-steps start steps closed?)
  (define (line points) (make-line (reverse points)))
  (let loop ((steps steps) (points (list start)) (curves '()))
    (define (flushed) (if (pair? (cdr points)) (cons (line points) curves) curves))
    (cond
      ((null? steps)
       (cond ((pair? curves)
              (let* ((all (reverse (if (and closed? (not (%near? (car points) start))) (begin (set! points (cons start points)) (flushed)) (flushed)))))
                (if (null? (cdr all)) (car all) (apply join-curves all))))
             ((null? (cdr points)) #f)
             (closed?
              (let ((corners (if (%near? (car points) start) (cdr points) points)))
                (cond ((null? (cdr corners)) #f)
                      ((null? (cddr corners)) (line corners))
                      (else (make-polygon (reverse corners))))))
             (else (line points))))
      ((eq? (caar steps) 'line)
       (loop (cdr steps) (if (equal? (cadar steps) (car points)) points (cons (cadar steps) points)) curves))
      (else (loop (cdr steps) (list (caddar steps)) (cons (cadar steps) (flushed)))))))

; Returns the region within closed curves, or the curves if they bound none.
(define (%region-or-curves curves)
  (let ((region (guard (e ((error-object? e) #f))
                  (let ((r (make-region curves))) (and (> (area r) 0) r)))))
    (if region (list region) curves)))

; A collection of objects by layer: the hash, the number of objects, the path of the file.
(define (%new-outlines path) (vector (make-hash) 0 path))
(define (%outlines-add! to name object)
  (if (not (empty-object? object)) (%outlines-count! to name object)))
(define (%outlines-count! to name object)
  (let ((table (vector-ref to 0)) (count (+ (vector-ref to 1) 1)))
    (if (> count %outline-most) (%outline-fail (vector-ref to 2) 1 (format "the file makes more than ~a objects: its blocks hold each other too often" %outline-most)))
    (vector-set! to 1 count)
    (hash-set! table name (cons object (hash-ref table name '())))))

(define (%outline-layers layers table path)
  (define (wanted name)
    (if (not (hash-has-key? table name))
        (error 'load-outline "~a has no layer ~s; it has ~s" path name (sort (hash-keys table) string<?)))
    (cons name (reverse (hash-ref table name))))
  (let ((names (cond ((not layers) (hash-keys table)) ((string? layers) (list layers)) (else layers))) (made (make-hash)))
    (for-each (lambda (name) (let ((entry (wanted name))) (hash-set! made (car entry) (cdr entry)))) names)
    made))

; Returns a hash from layer to the list of its curves, regions and texts.
(define (load-outline file #:layer [layer any? #f])
  (%need-string 'load-outline file)
  (if (not (or (not layer) (string? layer) (and (list? layer) (every string? layer))))
      (error 'load-outline "#:layer is a string or a list of strings, got ~s" layer))
  (let* ((path (%data-path file)) (small (string-downcase path)) (made (%new-outlines path)))
    (cond ((string-suffix? small ".dxf") (%load-dxf path made))
          ((string-suffix? small ".svg") (%load-svg path made))
          (else (error 'load-outline "file must be a name that ends in .dxf or .svg, got ~s" file)))
    (%outline-layers layer (vector-ref made 0) path)))
