; Arrangements of lamps, after Grimaldo: three lamps stand on the table, each with a tripod that moves it. A click on the trigger stores how they
; stand on the next of three shelves, and lays out the next kind of lamp.

(define root (node-getroot))
(define kinds
  (map (lambda (h)
         (unite (with-material 'steel (make-cylinder origin 0.06 0.3))
                (with-material 'steel (make-cylinder origin h 0.05))
                (with-material 'gold (make-sphere (xyz 0 0 h) 0.3))))
       '(1 1.5 2)))
(define (plank x y)
  (with-material 'oak (make-box (xyz x (- y 1.5) -0.2) (xyz (+ x 8) (+ y 1.5) 0))))
(draw (plank -1 0) (plank 10 -4) (plank 10 0) (plank 10 4))

(define table (node-create #:name "table" #:parent root))
(define shelves
  (map (lambda (i) (node-create #:name (format "shelf ~a" (+ i 1)) #:parent root #:translate (vxyz 11 (* 4 (- i 1)) 0))) (iota 3)))
(define laid-out 0) ; how many kinds have been on the table

; A place on the table: its tripod, and the node that follows it and holds the lamp.
(define places
  (map (lambda (i)
         (define start (vxyz (* 3 i) 0 0))
         (define tripod (make-tripod (+x origin (* 3 i)) (vxyz 1 1 0) #:size 1.5 #:parent table))
         (define holder (node-create #:parent table #:translate start))
         (property-subscribe (property-ref tripod 'value) (lambda (v) (node-translate holder (v+v v start))))
         (list tripod holder))
       (iota 3)))

(define (lay-out)
  (if (< laid-out 3)
      (for ([place places]) (node-create #:parent (second place) #:drawing (list-ref kinds laid-out))))
  (set! laid-out (+ laid-out 1)))

(define (store . ignored)
  (define shelf (find (lambda (s) (null? (node-getchildren s))) shelves))
  (if (not shelf) (error 'store "all shelves are full"))
  (for ([place places])
    (define lamp (node-getchild (second place) 0))
    (node-translate lamp (node-gettranslate (second place)))
    (node-addchild shelf lamp))
  (lay-out))

(make-trigger (xyz -1.6 -2 0) store #:size 0.5 #:name "store" #:parent root)
(lay-out)
