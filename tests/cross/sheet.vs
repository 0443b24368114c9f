; Runs the tasks of the table of shapes (shapes.vs) and the thesis' calling forms (appendix-a.vs): `vs sheet.vs -D task=... -D variant=... [-D one=N]`, all for tests/cross.sh.
;
;   task=measure   holds the program's own measures to the closed forms, in the words of tests/run.sh
;   task=table     prints a line a shape for tests/tools: what its cell of the sheet must hold
;   task=names     prints a line a shape: number, class, name
;   task=forms     prints a line a shape of shapes.vs: number, kind, name
;   task=kinds     prints the kinds of nodes that the table meets
;   task=tree      draws every shape as it is, in a layer of its name: written as .tree it is the golden shapes.tree
;   task=draw      draws the sheet; with one=N one shape, in its cell. standin=#t draws for what has no thickness something thin
;
; A sheet is a lattice in a plane across the view from 'iso, 18 cells a row; no shape reaches out of its cell, so one run of a worker serves
; all shapes. variant=mixed gives each shape the next of the variants in turn.

(define-parameter task "draw" #:choices '("measure" "table" "names" "forms" "kinds" "tree" "draw"))
(define-parameter variant "plain" #:choices '("plain" "rotated" "mirrored" "scaled" "cut" "hollow" "mixed"))
(define-parameter one -1)
(define-parameter standin #f)
(define-parameter samples 1500)

(define columns 18)
(define across (vxyz 9 9 0))      ; from a cell to the next of its row
(define upwards (vxyz -5 5 10))   ; from a row to the next
(define stretch '(1.5 0.75 1.25))

; ---- the table ----

(define row-name first)
(define row-object second)
(define row-forms third)
(define row-shown fourth) ; a thunk, or #f
(define row-alone fifth)
(define rows '())
; a shape that cannot be made is told of, and the others go on
(define-syntax shape
  (syntax-rules ()
    ((_ name object . options) (add-shape name (lambda () object) . options))))
(define (add-shape name make #:volume [volume any? #f] #:area [area any? #f] #:length [length any? #f] #:box [box any? #f] #:within [within any? 1e-9]
               #:facets [facets any? #f] #:shown [shown any? #f] #:alone [alone any? #f] #:also [also any? #f])
  (define object (guard (e ((error-object? e) (condition/report-string e))) (make)))
  (if (not (object? object))
      (if (string=? task "measure") (printf "not ok cross/made:~a\n    ~a\n" name object))
      (begin
        (if (assoc name rows) (printf "not ok cross/made:~a\n    two shapes have this name\n" name))
        (set! rows (cons (list name object (list volume area length box within facets also) shown alone) rows)))))

; A calling form of the thesis: its name is the entry's and its number among the entry's forms. also: a measure that the table has no column for.
(define-syntax entry
  (syntax-rules ()
    ((_ name form measure value) (add-entry name (lambda () form) 'measure measure value))))
(define (add-entry name make word measure value)
  (define full (format "~a/~a" name (+ 1 (length (filter (lambda (row) (string-contains? (row-name row) (string-append name "/"))) rows)))))
  (case word
    ((volume) (add-shape full make #:volume value #:within 1e-3))
    ((area) (add-shape full make #:area value #:within 1e-3))
    ((curve-length) (add-shape full make #:length value #:within 1e-3))
    (else (add-shape full make #:alone (eq? word 'object-kind) #:within 1e-3 #:also (list word measure value)))))
(load "shapes.vs")
(define shapes-count (length rows))
(load "appendix-a.vs")
(set! rows (reverse rows))

(define (form-of row k) (list-ref (row-forms row) k))
(define (volume-of row) (form-of row 0))
(define (area-of row) (form-of row 1))
(define (length-of row) (form-of row 2))
(define (corners-of row) (form-of row 3))
(define (within-of row) (form-of row 4))
(define (facets-of row) (form-of row 5))
(define (also-of row) (form-of row 6))

(define (class-of o)
  (cond ((solid? o) 'solid) ((region? o) 'region) ((surface? o) 'surface) ((curve? o) 'curve) (else 'mixed)))

; ---- variants ----

(define solid-variants '("plain" "rotated" "cut" "mirrored" "hollow" "scaled"))
(define thin-variants '("plain" "rotated" "mirrored" "scaled"))
(define (row-all-variants row) (if (and (solid? (row-object row)) (not (row-shown row))) solid-variants thin-variants))
; what cannot be cut (curves beside solids; what pictures show instead of the object) stands plain where the variant is none of its own
(define (variant-of index row)
  (let ((all (row-all-variants row)))
    (cond ((string=? variant "mixed") (list-ref all (modulo index (length all))))
          ((member variant all) variant)
          (else "plain"))))

; the box round o, a little larger to every side
(define (crate o)
  (let* ((b (bounding-box o)) (more (v*r (p->q (first b) (second b)) 1/16)))
    (make-box (p-v (first b) more) (p+v (second b) more))))
; the eighth of space round o that faces the view
(define (eighth o)
  (let* ((b (bounding-box o)) (p (first b)) (q (second b)) (c (mid p q)))
    (make-box (xyz (cx c) (- (cy p) 1) (cz c)) (xyz (+ (cx q) 1) (cy c) (+ (cz q) 1)))))

(define (vary o name)
  (cond ((string=? name "rotated") (do-rotate o origin (vxyz 1 2 3) 0.7))
        ((string=? name "mirrored") (do-mirror o (make-plane origin (vxyz 2 1 -1/2))))
        ((string=? name "scaled") (do-scale o stretch))
        ((string=? name "cut") (if (solid? o) (subtract o (eighth o)) o))
        ((string=? name "hollow") (if (solid? o) (subtract (crate o) o) o))
        (else o)))

; the closed form's value for a variant, or #f
(define (varied-volume v o name)
  (cond ((not v) #f)
        ((string=? name "scaled") (* v (apply * stretch)))
        ((string=? name "cut") #f)
        ((string=? name "hollow") (- (volume (crate o)) v))
        (else v)))
(define (varied-area a name) (and a (member name '("plain" "rotated" "mirrored")) a))

; ---- measuring ----

(define (report what row name good? . why)
  (printf "~a cross/~a:~a:~a\n" (if good? "ok" "not ok") what (row-name row) name)
  (if (not good?) (printf "    ~a\n" (string-join (map (lambda (x) (format "~a" x)) why) " "))))
(define (close? got wanted within) (<= (abs (- got wanted)) (* within (abs wanted))))
(define (compare what row name thunk wanted within)
  (if wanted
      (let ((got (guard (e ((error-object? e) (condition/report-string e))) (thunk))))
        (report what row name (and (real? got) (close? got wanted within)) "got" got "wanted" wanted "within" within))))

; Points of a low discrepancy: the fraction of a box that they find is right within a few in samples^(2/3), as the border of a solid is none of boxes.
(define (halton i base)
  (let loop ((i i) (f (/ 1. base)) (sum 0.)) (if (= i 0) sum (loop (quotient i base) (/ f base) (+ sum (* f (remainder i base)))))))
(define (chance-volume o)
  (let* ((b (bounding-box o)) (p (first b)) (d (p->q p (second b))))
    (let loop ((i 1) (inside 0))
      (if (> i samples)
          (* (/ inside samples 1.) (cx d) (cy d) (cz d))
          (loop (+ i 1) (if (contains? o (+xyz p (* (cx d) (halton i 2)) (* (cy d) (halton i 3)) (* (cz d) (halton i 5)))) (+ inside 1) inside))))))

(define (measure-variant row name)
  (let* ((whole (row-object row)) (o (vary whole name)) (within (within-of row)) (meshed (if (member name '("cut" "hollow")) (max within 0.01) within)))
    (compare "volume" row name (lambda () (volume o)) (varied-volume (volume-of row) whole name) meshed)
    (compare (if (curve? whole) "length" "area") row name (lambda () (if (curve? o) (curve-length o) (area o)))
             (if (curve? whole) (varied-area (length-of row) name) (varied-area (area-of row) name)) within)
    ; of a mesh, like the hollow: what asks for facets is cut as its facets
    (if (and (string=? name "cut") (solid? whole))
        (compare "cut and the rest" row name (lambda () (+ (volume o) (volume (intersect whole (eighth whole))))) (or (facets-of row) (volume-of row)) meshed))
    (if (and (solid? o) (not (string=? name "cut")) (varied-volume (volume-of row) whole name))
        (let* ((b (bounding-box o)) (d (p->q (first b) (second b))) (room (* (cx d) (cy d) (cz d))) (wanted (varied-volume (volume-of row) whole name)) ; of the round thing: points know no facets
               (got (chance-volume o)))
          (report "contains?" row name (< (abs (- got wanted)) (+ (* within wanted) (* room 2 (expt samples -2/3)))) "points say a volume of" got "wanted" wanted)))
    (if (and (string=? name "plain") (also-of row))
        (let ((got ((second (also-of row)) o)) (wanted (third (also-of row))))
          (report (first (also-of row)) row name (if (number? wanted) (close? got wanted within) (equal? got wanted)) "got" got "wanted" wanted)))
    (if (and (string=? name "plain") (corners-of row))
        (let ((got (bounding-box o)) (wanted (corners-of row)))
          (report "bounding-box" row name (and got (near? (first got) (first wanted)) (near? (second got) (second wanted))) "got" got "wanted" wanted)))))

; ---- the sheet ----

(define (cell index) (+ origin (+ (* (modulo index columns) across) (* (quotient index columns) upwards))))
(define (rounded x) (/ (round (* x 1000)) 1000))
; o moved as brings the middle of whole into the middle of the cell, by a step of three decimals
(define (place o index whole)
  (let* ((b (bounding-box whole)) (by (if b (p->q (mid (first b) (second b)) (cell index)))))
    (if b (do-move o (vxyz (rounded (cx by)) (rounded (cy by)) (rounded (cz by)))) o)))
; curves and solids side by side
(define (parts o) (if (eq? (class-of o) 'mixed) (append-map parts (object-children o)) (list o)))
(define (thin o)
  (case (class-of o)
    ((curve) (do-thicken o 0.05 #:segments 8))
    ((region surface) (do-thicken o 0.004))
    (else o)))

(define (print-row index row)
  (let* ((name (variant-of index row)) (o (let ((o (vary (row-object row) name))) (place o index o))) (b (bounding-box o))
         (v (varied-volume (or (facets-of row) (volume-of row)) (row-object row) name)))
    (printf "~a\t~a:~a\t~a\t~a\t~a\t~a\t~a\t~a\n" index (row-name row) name (class-of o) (if v (exact->inexact v) "-")
            (let ((a (and (solid? o) (not (facets-of row)) (varied-area (area-of row) name)))) (if a (exact->inexact a) "-"))
            (string-join (map (lambda (c) (format "~a ~a ~a" (cx c) (cy c) (cz c))) b) " ")
            (max 0.005 (* 1. (within-of row))) (if (facets-of row) 1 0.012))))

; the kinds in a tree
(define kinds (make-hash))
(define (meet-kinds o)
  (hash-set! kinds (object-kind o) #t)
  (for-each meet-kinds (object-children o)))

(define (each-row proc)
  (let loop ((left rows) (index 0))
    (if (pair? left)
        (begin
          (if (if (< one 0) (or (member task '("forms" "kinds" "tree")) (not (row-alone (car left)))) (= one index)) (proc index (car left)))
          (loop (cdr left) (+ index 1))))))

(define (row-variants index row)
  (if (string=? variant "mixed") (list "plain" (variant-of index row)) (list variant)))

(cond
  ((string=? task "measure")
   (parameterize ((current-segments 128))
     (each-row (lambda (index row)
                 (for-each (lambda (name) (if (member name (row-all-variants row)) (measure-variant row name)))
                           (delete-duplicates (row-variants index row)))))))
  ((string=? task "table")
   (printf "lattice ~a ~a ~a ~a ~a ~a ~a\n" columns (cx across) (cy across) (cz across) (cx upwards) (cy upwards) (cz upwards))
   (each-row print-row))
  ((string=? task "names")
   (each-row (lambda (index row) (printf "~a\t~a\t~a:~a\n" index (class-of (row-object row)) (row-name row) (variant-of index row)))))
  ((string=? task "forms")
   (each-row (lambda (index row) (if (< index shapes-count) (printf "~a\t~a\t~a\n" index (object-kind (row-object row)) (row-name row))))))
  ((string=? task "kinds")
   (each-row (lambda (index row) (meet-kinds (row-object row))))
   (hash-for-each kinds (lambda (kind found) (displayln kind))))
  ((string=? task "tree")
   (each-row (lambda (index row) (draw (layer (row-name row) (row-object row))))))
  (else
   (view-from 'iso)
   (each-row (lambda (index row)
               (let* ((name (variant-of index row)) (o (vary (row-object row) name)))
                 (draw (if standin
                           (map (lambda (part) (thin (place (vary part name) index o))) (parts (or (row-shown row) (row-object row))))
                           (place o index o))))))))
