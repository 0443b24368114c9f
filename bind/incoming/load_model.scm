; Models of other programs: load-model, and what load_glb.scm, load_3mf.scm and load_x3d.scm share. After load_outline.scm.
; Names that begin with % are hidden from programs. Compiled into the binary when it is built.
;
; A reader collects placed objects (%model-add!). load-model unites them, each layer in a layer of its own. Points and faces
; stay in bytevectors of doubles, which %loaded-faces takes.

; Greatest number of placed objects of one file. Parts within parts could multiply without end.
(define %model-most 1000000)

(define (%model-fail file text) (error 'load-model "~a: ~a" file text))

; ---- matrices ----

; Returns the matrix of twelve numbers, row by row.
(define (%matrix-of-rows numbers) (apply make-matrix (append numbers '(0 0 0 1))))
(define (%matrix-to x y z) (translation-matrix (vxyz x y z)))
(define (%matrix-of-scales x y z) (%matrix-of-rows (list x 0 0 0 0 y 0 0 0 0 z 0))) ; mirrors, too, unlike scaling-matrix

; Returns the matrix of a rotation by a quaternion. Numbers that the file rounded to almost a whole one become whole, so
; that a quarter turn and its reverse make nothing.
(define (%quaternion-matrix x y z w)
  (let ((n (sqrt (+ (* x x) (* y y) (* z z) (* w w)))))
    (if (= n 0)
        %identity-matrix
        (let ((x (/ x n)) (y (/ y n)) (z (/ z n)) (w (/ w n)))
          (define (whole v) (let ((r (round v))) (if (< (abs (- v r)) 1e-12) r v)))
          (define (one a b) (whole (- 1 (* 2 (+ (* a a) (* b b))))))
          (define (sum a b c d) (whole (* 2 (+ (* a b) (* c d)))))
          (%matrix-of-rows
            (list (one y z) (sum x y (- z) w) (sum x z y w) 0
                  (sum x y z w) (one x z) (sum y z (- x) w) 0
                  (sum x z (- y) w) (sum y z x w) (one x y) 0))))))

(define (%turn-matrix x y z angle)
  (let ((n (sqrt (+ (* x x) (* y y) (* z z)))))
    (if (= n 0)
        %identity-matrix
        (let ((s (/ (sin (/ angle 2)) n))) (%quaternion-matrix (* s x) (* s y) (* s z) (cos (/ angle 2)))))))

; Returns the matrix from a scene whose Y axis is up, in a unit of so many metres.
(define (%upright-matrix metres)
  (let ((k (/ metres (%model-metres)))) (%matrix-of-rows (list k 0 0 0 0 0 (- k) 0 0 k 0 0))))

; ---- what a reader collects ----

; #(path placed count notes): placed is a list of (layer . object), newest first; notes a table of texts that were said.
(define (%new-model path) (vector path '() 0 (make-hash)))
(define (%model-path made) (vector-ref made 0))

; layer-name, part-name: a string, or #f for none
(define (%model-add! made layer-name part-name o)
  (if (not (empty-object? o))
      (let ((o (if part-name (part part-name o) o)) (count (+ (vector-ref made 2) 1)))
        (if (> count %model-most)
            (%model-fail (%model-path made) (format "it places more than ~a parts" %model-most)))
        (vector-set! made 2 count)
        (vector-set! made 1 (cons (cons layer-name o) (vector-ref made 1))))))

; Warns once for each text.
(define (%model-note made text)
  (let ((said (vector-ref made 3)))
    (if (not (hash-has-key? said text))
        (begin (hash-set! said text #t) (%warn (format "load-model: ~a: ~a" (%model-path made) text))))))

(define (%model-paint material o) (if material (with-material material o) o))

; Returns the objects of a mesh, a list. pieces: a list of (material points corners form), as %loaded-faces takes them.
(define (%model-objects made pieces)
  (let ((materials (list->vector (map car pieces))))
    (map (lambda (part)
           (if (caddr part)
               (%model-note made "a solid has faces in several materials; it gets that of the largest area"))
           (%model-paint (vector-ref materials (car part)) (cadr part)))
         (reverse (%loaded-faces (map (lambda (p) (list->vector (cdr p))) pieces))))))

; Returns the points of a bytevector of numbers, a list.
(define (%model-points numbers)
  (let loop ((l (%numbers->list numbers)) (points '()))
    (if (and (pair? l) (pair? (cdr l)) (pair? (cddr l)))
        (loop (cdddr l) (cons (xyz (car l) (cadr l) (caddr l)) points))
        (reverse points))))

; Returns the curve through points, or #f if they are all one.
(define (%model-curve points closed?)
  (let ((distinct (let loop ((l points) (kept '()))
                    (cond ((null? l) (reverse kept))
                          ((and (pair? kept) (equal? (car l) (car kept))) (loop (cdr l) kept))
                          (else (loop (cdr l) (cons (car l) kept)))))))
    (define (all-but-last l) (reverse (cdr (reverse l))))
    (cond ((or (null? distinct) (null? (cdr distinct))) #f)
          ((and (pair? (cddr distinct)) (equal? (car distinct) (last distinct)))
           (if (pair? (cdddr distinct)) (make-polygon (all-but-last distinct)) (make-line (all-but-last distinct))))
          ((and closed? (pair? (cddr distinct))) (make-polygon distinct))
          (else (make-line distinct)))))

; Returns the colour #(r g b a) of "#rrggbb" or "#rrggbbaa", or #f.
(define (%model-color text)
  (let* ((n (string-length text)) (digits (and (memv n '(7 9)) (char=? (string-ref text 0) #\#) (substring text 1 n)))
         (value (and digits (every (lambda (c) (string-index "0123456789abcdefABCDEF" c)) (string->list digits))
                     (string->number (if (= n 7) (string-append digits "ff") digits) 16))))
    (and value (vector-map (lambda (shift) (/ (modulo (quotient value shift) 256) 255.)) '#(16777216 65536 256 1)))))

; Returns x as near as a file of 32 bits states it, between 0 and 1.
(define (%model-share x) (max 0. (min 1. (/ (round (* 1e9 x)) 1e9))))

; ---- load-model ----

(define (%model-united made)
  (let ((names '()) (table (make-hash)))
    (for-each (lambda (placed)
                (if (not (hash-has-key? table (car placed))) (set! names (cons (car placed) names)))
                (hash-set! table (car placed) (cons (cdr placed) (hash-ref table (car placed) '()))))
              (reverse (vector-ref made 1)))
    (let ((layers (map (lambda (name)
                         (let ((all (reverse (hash-ref table name)))) (if name (list (apply layer name all)) all)))
                       (reverse names))))
      (cond ((null? layers) (%model-note made "there is nothing in it") (empty-object))
            ((and (null? (cdr layers)) (null? (cdar layers))) (caar layers))
            (else (apply unite (apply append layers)))))))

; Calls read; its errors get the file's name, except those that have one and those of memory and limits.
(define (%model-at path read)
  (guard (e ((and (error-object? e) (memq (error-object-kind e) '(error type range arity))
                  (not (string-prefix? (error-object-message e) "load-model: ")))
             (let* ((text (condition/report-string e)) (own "loaded-faces: ") (n (string-length own)))
               (%model-fail path (if (string-prefix? text own) (substring text n (string-length text)) text)))))
    (read)))

; Returns the object in a file: its parts, with their layers and materials, united.
(define (load-model file)
  (%need-string 'load-model file)
  (let* ((path (%data-path file)) (small (string-downcase path)) (made (%new-model path))
         (read (cond ((string-suffix? small ".glb") %load-glb)
                     ((string-suffix? small ".3mf") %load-3mf)
                     ((string-suffix? small ".x3d") %load-x3d)
                     (else (error 'load-model "file must be a name that ends in .glb, .3mf or .x3d, got ~s" file)))))
    (%model-at path (lambda () (read path made) (%model-united made)))))
