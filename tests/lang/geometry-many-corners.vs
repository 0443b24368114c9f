; outlines of thousands of corners and sheets of thousands of holes are cut into triangles in little time, whatever their form
(define (meshed profile) (area (do-section (do-extrude profile 1) (make-plane (xyz 0 0 0.5) uz)))) ; by way of the mesh
(define (shoelace points)
  (/ (apply + (map (lambda (p q) (- (* (cx p) (cy q)) (* (cx q) (cy p)))) points (append (cdr points) (list (car points))))) 2))
(define (arm width) (map (lambda (a) (pol (+ 10 width a) (* 20 a))) (division 0 2pi 8000)))
(define spiral (append (arm 0) (reverse (arm 0.1))))
(displayln (near? (/ (meshed (make-region (make-polygon spiral))) (abs (shoelace spiral))) 1 1e-5))  ; expect: #t
(define straight (append (map (lambda (i) (xy i 0)) (iota 6000)) (map (lambda (i) (xy (- 6000 i) 6000)) (iota 6000)))) ; corners in the middle of sides
(displayln (near? (/ (meshed (make-polygon straight)) (shoelace straight)) 1 1e-9))              ; expect: #t
(define holes (for*/list ([i 40] [j 40]) (make-rectangle (xy i j) (xy (+ i 0.5) (+ j 0.5)))))
(displayln (near? (meshed (make-region (make-rectangle (xy -1 -1) (xy 40 40)) holes)) (- 1681 400) 1e-6)) ; expect: #t
