; what checks draw and set is not the program's; the last value is the model, checks behind it or not
(make-box origin (xyz 1 1 1))
(check-expect (begin (draw (make-box (xyz 9 9 9) (xyz 10 10 10))) (erase-all) (view-from 'top) 1) 1)
(check-expect (begin (draw (make-sphere origin 5)) 1) 2)
(define (thrown) (make-sphere origin 1) (make-sphere origin 2) 3)
(check-expect (thrown) 3)
