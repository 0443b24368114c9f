; Numbers that are others upside down have a line below: of 1 to 99 those of 0, 1, 6, 8 and 9 that are not themselves.
(define (strokes text) (if (string=? text "") 0 (object-count (engrave text 5 #:underline #f))))
(define (marked? text) (< (strokes text) (object-count (engrave text 5))))
(displayln (filter (lambda (n) (marked? (number->string n))) (iota 99 1)))
; expect: (6 9 16 19 60 61 66 68 86 89 90 91 98 99)
(displayln (filter marked? '("666" "619" "906" "9X" "" "A6" "6.9")))
; expect: (666)

; the line lies below the digits, and is as long as they are
(define box (bounding-box (engrave "66" 8 #:at (xy 3 4))))
(displayln box)
; expect: ((xyz 3 2 0) (xyz 18 12 0))

; slices mark theirs: the digits 6 and 9 have one outline more than 5, and the line is another
(define (curves slice) (object-count slice))
(define s (slices (make-box origin (xyz 90 60 20)) 2))
(displayln (map (lambda (i) (- (curves (list-ref s i)) (curves (list-ref s 4)))) '(4 5 8)))
; expect: (0 2 2)

; densities are lists, as rates are, or pairs; the sun needs no longitude; a column has decimals or none
(define cube (with-material (make-material #:name "cork" #:color "tan") (make-box origin (xyz 2 1 1))))
(displayln (map (lambda (d) (schedule cube 'mass #:densities (list d))) '(("cork" 200) ("cork" . 200))))
; expect: (((mass) (400.0)) ((mass) (400.0)))

(sun #:latitude 38.7 #:date "2026-06-21" #:time "15:00")
(schedule cube 'mass #:densities '(("cork"))) ; expect error: densities must be a list of (material . density)
