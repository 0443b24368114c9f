; Three instances of one context: the column is modelled once, and stands in three places. A click names the nearest that the mouse meets, and sets the
; golden mark upon it.

(define root (node-getroot))
(define column
  (with-material 'plaster
    (unite (make-box (xyz -0.7 -0.7 0) (xyz 0.7 0.7 0.3))
           (make-cut-cone (xyz 0 0 0.3) 0.5 (xyz 0 0 4) 0.4)
           (make-box (xyz -0.6 -0.6 4) (xyz 0.6 0.6 4.3)))))
(define mark (node-create #:name "mark" #:drawing (with-material 'gold (make-sphere (xyz 0 0 4.8) 0.4))))
(draw (with-material 'concrete (make-box (xyz -1.5 -1.5 -0.2) (xyz 7.5 5.5 0))))

(define (choose node hit)
  (displayln (node-getname node))
  (node-addchild node mark))
(define (instance name place)
  (on-pick (node-create #:name name #:parent root #:drawing column #:translate place) choose))
(instance "left" (vxyz 0 0 0))
(instance "middle" (vxyz 3 2 0))
(instance "right" (vxyz 6 4 0))
