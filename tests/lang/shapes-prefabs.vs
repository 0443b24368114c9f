; Prefabs: each is closed solids on the ground, follows its parameters, and says what it does not take; files of one's own.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (size o) (let ((b (bounding-box o))) (p->q (first b) (second b))))
(define (within? a b) (<= (abs (- a b)) (* 0.02 (abs b))))
(displayln (prefab-names)) ; expect: (car chair door person stair tree vase window)
(define foot (apply max (map (lambda (name) (abs (cz (first (bounding-box (prefab name)))))) '("car" "chair" "door" "person" "stair" "tree" "vase"))))
(displayln (< foot 0.05))                                              ; expect: #t
(displayln (within? (cz (size (prefab "person" #:height 1.5))) 1.5))   ; expect: #t
(displayln (within? (cz (size (prefab "vase" #:height 2))) 2))         ; expect: #t
(displayln (within? (cx (size (prefab "vase" #:width 1))) 1))          ; expect: #t
(displayln (within? (cz (size (prefab "tree" #:height 12 #:seed 7))) 12)) ; expect: #t
(displayln (within? (cy (size (prefab "car" #:length 5))) 5))          ; expect: #t
(displayln (within? (cz (size (prefab "chair" #:height 1.1))) 1.1))    ; expect: #t
(define stair (prefab "stair" #:height 3 #:rails "none"))
(displayln (near? (cz (size stair)) 3 0.02))                           ; expect: #t
(displayln (equal? (prefab "tree" #:seed 5) (prefab "tree" #:seed 5))) ; expect: #t
(displayln (equal? (prefab "tree" #:seed 5) (prefab "tree" #:seed 6))) ; expect: #f
; a door and a window keep within the sizes of their openings, but for casings, sills and handles
(displayln (< (cx (size (prefab "door" #:width 1.4))) 1.53))           ; expect: #t
(displayln (every (lambda (n) (< (cx (size (prefab "window" #:width 3 #:casements n))) 3.09)) '(1 2 3 5))) ; expect: #t
; they are ordinary objects
(displayln (solid? (do-move (prefab "chair" #:material "steel") (vxyz 1 0 0)))) ; expect: #t
; a file of one's own
(displayln (volume (prefab "lib/lamp.vs")))                            ; expect: 2.0
(displayln (volume (prefab "lib/lamp.vs" #:reach 3 #:lit #t)))         ; expect: 4.0
(displayln (prefab-parameters "lib/lamp.vs")) ; expect: ((reach 2.0 1 5) (lit #f #f #f) (shade round #f #f))
(fails (prefab "lib/lamp.vs" #:reach 9))      ; expect: prefab: reach of lib/lamp.vs must be from 1 to 5, got 9
(fails (prefab "lib/lamp.vs" #:reach 'far))   ; expect: prefab: reach of lib/lamp.vs must be a number, got far
(fails (prefab "lib/lamp.vs" #:lit 1))        ; expect: prefab: lit of lib/lamp.vs must be #t or #f, got 1
(fails (prefab "lib/lamp.vs" #:shade "oval")) ; expect: prefab: shade of lib/lamp.vs must be one of ("round" "square"), got "oval"
(fails (prefab "lib/lamp.vs" #:colour "red")) ; expect: prefab: lib/lamp.vs has no parameter colour; it has reach lit shade
(fails (prefab "chair" #:slats 2.5))          ; expect: prefab: slats of chair must be an exact integer, got 2.5
(fails (prefab "sofa"))                       ; expect: prefab: there is no prefab "sofa"; there are car chair door person stair tree vase window, and files of your own, as in (prefab "lamp.vs")
(fails (prefab 7))                            ; expect: prefab: name must be a string, got 7
(fails (prefab "lib/lost.vs"))                  ; expect: cannot open lib/lost.vs: no such file
