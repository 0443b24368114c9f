; part-groups, part-size, cut-list: each row of tests/cross/shapes.vs, moved and turned, is equal to itself
(define rows '())
(define (shape name o #:volume [volume any? #f] #:area [area any? #f] #:length [length any? #f] #:box [box any? #f]
               #:within [within any? 0] #:facets [facets any? #f] #:shown [shown any? #f] #:alone [alone any? #f])
  (if (and (not alone) (not (memq (object-kind o) '(with-material layer))) (or (solid? o) (region? o) (surface? o))) (set! rows (cons (cons name o) rows))))
(load "../cross/shapes.vs")
(define (placed o) (do-move (do-rotate o (make-axis (xyz 1 2 3) (vxyz 3 -1 2)) 0.7) (vxyz 20 -30 11)))
(define (room-of size) (apply * (map (lambda (x) (max x (* 1e-3 (first size)))) size))) ; round parts have several smallest boxes
(define (count . parts) (length (part-groups parts)))
(for ([row rows])
  (let ((o (cdr row)))
    (if (not (= (count o) (count o (placed o)))) (printf "~a: ~a groups~%" (car row) (count o (placed o))))
    (let ((a (part-size o)) (b (part-size (placed o))))
      (if (not (< (abs (- (room-of a) (room-of b))) (* 1e-2 (room-of a)))) (printf "~a: sizes ~a and ~a~%" (car row) a b)))))
(displayln (> (length rows) 150)) ; expect: #t
; a user's kind counts as the drawing of its drawing function
(define-primitive stone wide)
(register-drawing-function stone? (lambda (s) (make-box origin (xyz (stone-wide s) 1 5))))
(define drawn (make-box origin (xyz 2 1 5)))
(define (agree f) (equal? (f (make-stone 2)) (f drawn)))
(for ([f (list (lambda (o) (map area (slices o 1))) (lambda (o) (map length (contours o #:step 1)))
               (lambda (o) (call-with-values (lambda () (ribs o #:x 2 #:y 1 #:thickness 1/10)) (lambda (a b) (list (length a) (length b)))))
               (lambda (o) (map area (unfold o))) (lambda (o) (count o drawn)) part-size (lambda (o) (closest-point o (xyz 9 9 9)))
               (lambda (o) (cut-list o #:digits 6)) (lambda (o) (area (do-section o 'xz))) do-edges lowered
               (lambda (o) (volume (minkowski o o))) (lambda (o) (object-count (simplify o 1/10))) (lambda (o) (volume (refine o 1)))
               (lambda (o) (volume (do-smooth o #:sharp 1))) (lambda (o) (map face-area (solid-faces o)))
               (lambda (o) (map volume (split o (make-plane (xyz 0 0 1) uz)))) (lambda (o) (volume (do-shell o 1/10)))
               (lambda (o) (volume (do-fillet o 1/10)))
               (lambda (o) (solar-hours (xyz 1 -1 0) uz #:latitude 50 #:date "2026-06-21" #:among o)))]
      [i (in-naturals)])
  (if (not (agree f)) (printf "measure ~a differs: ~s ~s~%" i (f (make-stone 2)) (f drawn))))
; mirror images differ unless a turn makes them equal; curves; the empty object; engraved lines do not count
(define plank (make-box origin (xyz 9 4 1)))
(define left (subtract plank (make-box origin (xyz 3 2 1/2))))
(displayln (map length (part-groups (list plank left (do-mirror left 'xy) (do-mirror plank 'yz) (do-rotate left 'z 3))))) ; expect: (2 2 1)
(displayln (count (make-line origin (xy 3 4)) (make-line (xyz 1 1 1) (xyz 1 1 6)) (make-line origin (xy 3 5)) (make-circle origin 2)
                  (make-circle (xyz 5 5 5) 2 #:plane 'xz))) ; expect: 3
(displayln (part-size (empty-object)))                   ; expect: (0.0 0.0 0.0)
(displayln (part-size (make-line origin (xy 3 4))))      ; expect: (4.0 3.0 0.0)
(displayln (map length (part-groups (slices (make-box origin (xyz 4 4 4)) 1)))) ; expect: (4)
; slender mirror images, where moments hardly differ: bars with mitred ends in different planes
(define (mitred a) (intersect (make-box (xyz -500 -1 -1) (xyz 500 1 1)) (do-rotate (make-box (xyz -900 -90 -90) (xyz 0 90 90)) 'z 0.6)
                              (do-rotate (do-rotate (make-box (xyz -9 -900 -900) (xyz 900 900 900)) 'y a) 'x 0.3)))
(displayln (count (mitred 0.5) (do-mirror (mitred 0.5) 'xz) (do-rotate (mitred 0.5) (vxyz 1 2 3) 2))) ; expect: 2
(displayln (cut-list (list left left plank) 'mark 'count 'name (cons 'top (lambda (o) (cz (second (bounding-box o))))) #:digits 2)) ; expect: ((mark count name top) (A 2 subtract 1.0) (B 1 box 1.0))
(displayln (map car (cut-list (map (lambda (i) (make-box origin (xyz i 1 1))) (iota 53 2)) 'mark)))
; expect: (mark A B C D E F G H I J K L M N O P Q R S T U V W X Y Z AA AB AC AD AE AF AG AH AI AJ AK AL AM AN AO AP AQ AR AS AT AU AV AW AX AY AZ BA)
; the middle of a room lies within it, also where the centroid does not
(define angle (subtract (make-region (make-rectangle origin (xy 10 10))) (make-region (make-rectangle (xy 2 2) (xy 10 10)))))
(displayln (list (contains? angle (centroid angle)) (contains? angle (region-middle angle)))) ; expect: (#f #t)
; the box of a turned set is as tight as that of its parts: each region of shapes.vs beside a dot
(define (box-size . l)
  (let ((b (map bounding-box l)))
    (define (reach pick f) (map (lambda (c) (apply f (map (lambda (b) (c (pick b))) b))) (list cx cy cz)))
    (distance (apply xyz (reach first min)) (apply xyz (reach second max)))))
(define dot (make-circle origin 1e-3))
(for ([row rows] #:when (region? (cdr row)))
  (let ((alone (box-size (placed dot) (placed (cdr row)))) (both (box-size (placed (unite dot (cdr row))))))
    (if (> both (* 1.0001 alone)) (printf "~a: a box of ~a, not ~a~%" (car row) both alone))))
; the region of slices, ribs and nets; heights in contours
(define cone (make-cone origin (xyz 0 0 9) 6))
(displayln (map (lambda (s) (= (area s) (area (part-region s)))) (append (slices cone 3) (unfold (make-box origin (xyz 1 2 3)) #:tabs 0.1)))) ; expect: (#t #t #t #t)
(define level-lines (contours cone #:from 0.5 #:step 1/2))
(define labelled (label-contours level-lines 0.5 #:every 4))
(displayln (map length (take labelled 9)))               ; expect: (1 1 1 2 1 1 1 2 1)
(displayln (map (lambda (c) (cz (first (bounding-box c)))) (list-ref labelled 3)))  ; expect: (2.0 2.0)
(displayln (< (curve-length (first (list-ref labelled 3))) (- (curve-length (first (list-ref level-lines 3))) 0.5))) ; expect: #t
(displayln (label-contours '() 1))                       ; expect: ()
(define refused (guard (c (#t (condition/report-string c))) (do-thicken (first (slices cone 3)) 1)))
(displayln (string-contains? refused "do-thicken: s must be a curve, a region or a flat surface, got (layer")) ; expect: #t
; contours without one height, and digits that coordinates cannot show
(define (refusal f) (guard (c (#t (condition/report-string c))) (f)))
(define upright (refusal (lambda () (label-contours (contours cone #:plane 'xz #:step 1) 0.5))))
(displayln (string-contains? upright "label-contours: each curve of lines must have one height, got (make-polygon")) ; expect: #t
(displayln (refusal (lambda () (label-contours (list (list (make-line (xy 0 0) (xy 8 0)))) 1e-300)))) ; expect: label-contours: size 1e-300 is too small for a curve 8.0 long
; the balls of a frame: moved copies need no search for turns
(displayln (map length (part-groups (for/list ([i 120]) (make-sphere (xyz i (* 1/3 i i) 0) (if (< (modulo i 3) 2) 0.08 0.09)))))) ; expect: (80 40)

; a layer or a material in a list has its solids as parts, as schedule counts them; a slice stays one part
(define (post i) (make-box (xyz (* 4 i) 0 0) (xyz (+ 1 (* 4 i)) 1 9)))
(define frame-parts (list (layer "posts" (post 0) (post 1) (post 2)) (with-material wood (layer "rails" (list (post 3) (make-box (xyz 0 5 0) (xyz 9 6 2)))))))
(displayln (cut-list frame-parts 'mark 'count 'layer)) ; expect: ((mark count layer) (A 4 posts) (B 1 rails))
(displayln (map cadr (cdr (schedule frame-parts 'layer 'count)))) ; expect: (3 2)
(displayln (length (part-groups (slices (make-cylinder origin (xyz 0 0 4) 5) 1)))) ; expect: 1
