; Holes that models of the workshop met at the first try.

; clauses of cond and case are bodies: definitions are local to the clause
(define (kind n)
  (cond [(< n 0) (define a (- n)) (define b (* 2 a)) (list 'negative b)]
        [(assv n '((1 one) (2 two))) => cadr]
        [else (define (square x) (* x x)) (square n)]))
(displayln (map kind '(-3 1 2 5)))
; expect: ((negative 6) one two 25)
(define (size o)
  (case o
    [(a b) (define x 1) (+ x 1)]
    [else (define y 10) (* y y)]))
(displayln (map size '(a b c)))
; expect: (2 2 100)

; a flat region in space is unrolled into the plane XY, in any direction, with its looks and its own curves
(define (flat? o) (let ((b (bounding-box o))) (and (near? (cz (first b)) 0 1e-9) (near? (cz (second b)) 0 1e-9))))
(define plate (layer "plates" (subtract (make-region (make-rectangle (xy 0 0) (xy 4 3))) (make-region (make-circle (xy 1 1) 0.5)))))
(define normals (for*/list ([x '(-1 0 1)] [y '(-1 0 1)] [z '(-1 0 1)] #:unless (= 0 x y z)) (vxyz x y z)))
(define turned (map (lambda (n) (do-move (do-rotate plate (v+v n (vxyz 0.1 0.2 0.3)) 2) n)) normals))
(define laid (map unroll turned))
(displayln (list (length laid) (every region? laid) (every flat? laid) (every (lambda (o) (near? (area o) (area plate) 1e-4)) laid)
                 (every (lambda (o) (equal? (object-layer o) "plates")) laid)))
; expect: (26 #t #t #t #t)
(displayln (every (lambda (o) (every near? (map curve-length (outline o)) (list 14 pi) '(1e-9 1e-2))) laid))
; expect: #t
(displayln (map (lambda (p) (let ((r (unroll (make-region (make-rectangle origin (xy 2 1) #:plane p))))) (list (flat? r) (area r)))) '(xy xz yz)))
; expect: ((#t 2.0) (#t 2.0) (#t 2.0))

; a list of parts is cut part by part, after all that is engraved
(define (washer x) (unite (layer "cut" (make-region (make-circle (xy x 0) 2) (make-circle (xy x 0) 1))) (layer "engrave" (engrave "7" 0.5 #:at (xy x 1.2)))))
(displayln (map object-layer (cut-lines (list (washer 0) (washer 9)))))
; expect: (engrave engrave cut cut cut cut)
(displayln (map (lambda (c) (round (curve-length c))) (drop (cut-lines (list (washer 0) (washer 9))) 2)))
; expect: (6.0 13.0 6.0 13.0)

; parts are lists of lists, too, such as both lists of ribs
(define-values (across along) (ribs (make-sphere (xyz 0 0 0) 9) #:x 3 #:y 2 #:thickness 0.5))
(displayln (list (apply + (map length (pack-parts (list across along) #:sheet '(60 60) #:effort 0))) (map object-layer (take-right (cut-lines (list across (list along))) 5))))
; expect: (5 (cut cut cut cut cut))

; a layer without objects sets its pen, without a warning
(displayln (empty-object? (layer "cut" #:color "red" #:line 0.1)))
; expect: #t
(layer "walls") ; expect warning: layer has no object here

; rounded lengths make bricks of a curved wall equal that differ by less than half of the last digit
(define bricks (brick-wall (make-spline (map (lambda (x) (xy x (* 0.8 (sin x)))) (division 0 6 24))) #:height 0.2))
(define (marks . more) (- (length (apply cut-list bricks more)) 1))
(define rows (cut-list bricks #:digits 3 'mark 'count 'length))
(displayln (list (> (marks) 20) (= (length bricks) (apply + (map second (cdr rows)))) (<= (- (length rows) 1) 4)))
; expect: (#t #t #t)
(displayln (= (length (delete-duplicates (map third (cdr rows)))) (- (length rows) 1)))
; expect: #t
(define planks (map (lambda (x) (make-box origin (xyz x 10 2))) '(100 100.3 100.6 103)))
(displayln (map second (cdr (cut-list planks #:digits 0 'mark 'count))))
; expect: (2 1 1)
(displayln (map second (cdr (cut-list planks #:digits 0 #:tolerance 1e-6 'mark 'count))))
; expect: (1 1 1 1)

; expect no other warnings
(map sphere? planks) ; expect error: sphere? is not defined; object-kind is the name here: (eq? (object-kind o) 'sphere)
