; Children of modules, and the list of objects that a statement makes: the last object is first.

; count: number of children; procedure: takes the index of a child, returns a list of objects
(define-record-type kids (scad:kids count procedure) kids? (count kids-number) (procedure kids-procedure))
(define scad:no-kids (scad:kids 0 (lambda (i) '())))
(define (scad:kids-count k) (exact->inexact (kids-number k)))
(define (scad:join l all) (append l all))

(define (child k i) ((kids-procedure k) i))
; Returns a list with the list of objects of each child.
(define (each-child k) (map (lambda (i) (child k i)) (iota (kids-number k))))
(define (all-children k) (fold (lambda (l all) (append l all)) '() (each-child k)))
(define (scad:children k which all)
  (cond ((eq? which scad:absent) (append (all-children k) all))
        ((eq? which undef) all)
        ((number? which)
         (let ((i (index-of which (kids-number k))))
           (if i (append (child k i) all) (begin (warning "child ~a does not exist: there are ~a" (text-of which) (kids-number k)) all))))
        (else (scad:fold (lambda (i all) (scad:children k i all)) all which))))

(define (one l) (let ((l (alike l))) (if (null? (cdr l)) (car l) (unite (reverse l)))))
(define (made o) (if (empty-object? o) '() (list o)))
(define (each-object f k) (map f (all-children k)))

(define (scad:m:union k) (let ((l (all-children k))) (if (null? l) '() (list (one l)))))
(define (scad:m:group k) (scad:m:union k))
(define (scad:m:render k convexity) (scad:m:union k))
(define (scad:m:difference k)
  (let ((l (each-child k)))
    (if (or (null? l) (null? (car l))) '()
        (let* ((o (one (car l))) (cutters (keep (append-map (lambda (x) x) (cdr l)) (lambda (c) (eq? (region? c) (region? o))) "difference" "objects of another dimension"))) (if (null? cutters) (car l) (made (subtract o cutters)))))))
(define (intersection l)
  (cond ((or (null? l) (any null? l)) '()) ((null? (cdr l)) (car l))
        (else
         (let* ((parts (map one l)) (flat? (region? (car parts))))
           (made (apply intersect (keep parts (lambda (o) (eq? flat? (region? o))) "intersection" "objects of another dimension")))))))
(define (scad:m:intersection k) (intersection (each-child k)))
(define (scad:intersection-for l all) (append (intersection (reverse l)) all))
(define (scad:m:hull k) (let ((l (alike (all-children k)))) (if (null? l) '() (list (hull (reverse l))))))

(define (scad:mark mark l all)
  (case (string-ref mark 0) ((#\#) (append (map highlight l) all)) ((#\!) (append (map only l) all)) ((#\%) (append (map ghost l) all)) (else all)))
(define (scad:missing name) (warning "the file ~a does not exist" name))
(define (scad:draw l) (for-each draw (reverse l)))
(define (scad:finish) #f)
