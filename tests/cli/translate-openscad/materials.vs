; Materials of the program's own: their colour goes over, and their pattern stays behind.
(define slabs (make-material #:name "slabs" #:color "#a3a3a1" #:pattern 'tiles #:pattern-size 4 #:pattern-color "#868684"))
(define (slab i) (with-material slabs (make-box (xyz (* 5 i) 0 0) 4 4 0.25)))
(draw (unite (map slab (iota 3))))
; Several in one colour, and colours by name.
(draw (color "Tomato" (make-box (xyz 0 10 0) 2 2 2) (do-mirror (make-wedge (xyz 4 9 0) (xyz 6 11 2)) 'yz)))
