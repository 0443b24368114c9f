; Lists of numbers and points.
(define heights (append '(10 20) (reverse (list 50 40 30)) `(15 ,(+ 1 2))))
(define corners (list (xyz 0 0 0) (xyz 100 0 0) (xyz 100 60 0) (xyz 0 60 0)))
(define (bar p h) (make-prism p 8 6 (+z p h)))
(draw (map bar corners (filter even? heights)))
(draw (make-pyramid (intermediate-point (car corners) (caddr corners) 0.25) (length heights) 5
                    (+xyz (list-ref corners 0) 25 15 (apply max heights))))
(draw (do-extrude (make-polygon (cons (xy 0 100) (cdr (map (lambda (p) (+y p 100)) corners)))) (vxyz 10 0 30)))
(draw (do-revolve (make-polygon (xz 210 0) (xz 230 0) (xz 220 25)) 'z))
