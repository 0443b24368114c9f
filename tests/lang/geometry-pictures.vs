; pictures on surfaces: when materials with them are equal, and what is wrong with pictures
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (display (error-object-message c)) (display " ") (displayln (error-object-irritants c)))) e (displayln "no error")))))
(define p (make-material #:image "lib/pictures/halves.png" #:pattern-size 2 #:pattern-angle 45))
(displayln (material? p))                                        ; expect: #t
(displayln (equal? (with-material p (make-sphere origin 1)) (with-material p (make-sphere origin 1)))) ; expect: #t
(displayln (with-material "lib/pictures/halves.jpg" (make-sphere origin 1))) ; expect: (with-material "halves.jpg" (make-sphere (xyz 0 0 0) 1))
(define same (make-material #:image "lib/pictures/halves.png" #:pattern-size 2 #:pattern-angle 45))
(displayln (equal? (with-material p (make-sphere origin 1)) (with-material same (make-sphere origin 1)))) ; expect: #t
(displayln (equal? (with-material p (make-sphere origin 1)) (with-material (make-material #:image "lib/pictures/halves.jpg" #:pattern-size 2 #:pattern-angle 45) (make-sphere origin 1)))) ; expect: #f
(fails (make-material #:image "lib/pictures/cut.png"))           ; expect: make-material: cut.png: the PNG file is cut off or broken ()
(fails (make-material #:image "lib/pictures/huge.png"))          ; expect: make-material: huge.png: the picture has 3000000 x 3000000 pixels; up to 67108864 are read ()
(fails (make-material #:image "lib/pictures/cut.jpg"))           ; expect: make-material: cut.jpg: the JPEG file is cut off or broken: Premature end of JPEG file ()
(fails (make-material #:image "lib/pictures/lie.jpg"))           ; expect: make-material: lie.jpg: the JPEG file is too short for a picture of 8000 x 8000 pixels ()
(fails (make-material #:image "lib/pictures/ramp.exr"))          ; expect: make-material: ramp.exr: this is neither a PNG nor a JPEG picture ()
(fails (make-material #:image "lib/pictures/grey8.png" #:pattern 'bricks)) ; expect: make-material: takes #:image or #:pattern and #:pattern-color, not both ()
(fails (make-material #:image 7))                                ; expect: make-material: image must be a string, got (7)
(with-material "lib/pictures/none.jpeg" (make-sphere origin 1))  ; expect error: none.jpeg: no such file
