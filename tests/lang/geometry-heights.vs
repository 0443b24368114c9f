; height fields: from rows of numbers, from PNG and EXR pictures
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (display (error-object-message c)) (display " ") (displayln (error-object-irritants c)))) e (displayln "no error")))))
(define (heights o) (map cz (car (object-arguments o))))
(define hill (make-height-field '((0 1 0) (1 2 1) (0 1 0)) (xyz 4 0 1) (xyz 0 4 1) #:low -1))
(displayln hill)                                     ; expect: (make-height-field '((1 2 1) (2 3 2) (1 2 1)) (xyz 0 0 0) (xyz 4 4 0) #:low 0)
(displayln (list (object-kind hill) (solid? hill) (volume hill) (bounding-box hill))) ; expect: (height-field #t 32.0 ((xyz 0 0 0) (xyz 4 4 3)))
(displayln (map (lambda (z) (contains? hill (xyz 2 2 z))) '(2.9 3.1 0 -0.1))) ; expect: (#t #f #t #f)
(displayln (equal? hill (make-height-field '((1 2 1) (2 3 2) (1 2 1)) origin (xyz 4 4 0)))) ; expect: #t
(displayln (volume (unite hill hill)))               ; expect: 32.0
(displayln (volume (subtract hill (make-box (xyz 0 0 -1) (xyz 2 4 9))))) ; expect: 16.0
(displayln (volume (make-height-field '((0 0 0) (0 3 0) (0 0 0)) origin (xyz 2 2 0)))) ; expect: 3.0
(define island (make-height-field '((0 0 0) (0 3 0) (0 0 0)) origin (xyz 2 2 0)))
(displayln (near? (+ (volume (unite island hill)) (volume (intersect island hill))) 35)) ; expect: #t
(displayln (heights (make-height-field '((0 1) (1 0)) origin (xyz 1 1 0) #:low 5 #:high 6))) ; expect: (5.0 6.0 6.0 5.0)
(displayln (map (lambda (z) (* 255 z)) (heights (make-height-field "lib/pictures/grey8.png" origin (xyz 2 1 0))))) ; expect: (10.0 20.0 30.0 0.0 128.0 255.0)
(displayln (map (lambda (z) (* 65535 z)) (heights (make-height-field "lib/pictures/grey16.png" origin (xyz 2 1 0))))) ; expect: (1.0 2.0 3.0 0.0 32768.0 65535.0)
(displayln (heights (make-height-field "lib/pictures/colour.png" origin (xyz 2 1 0)))) ; expect: (0.0722 1.0 0.2126 0.7152)
(displayln (heights (make-height-field "lib/pictures/palette.png" origin (xyz 2 1 0) #:low -1 #:high 3))) ; expect: (3.0 -1.0 -1.0 3.0)
(define ramp (heights (make-height-field "lib/pictures/ramp.exr" origin (xyz 2 1 0))))
(displayln (list (length ramp) (apply < (take ramp 8)))) ; expect: (48 #t)
; EXR pictures of other kinds: an alpha channel, numbers of other widths in one picture, no compression, tiles, a corner that is not (0 0)
(define (hues file) (heights (make-height-field (string-append "lib/pictures/" file ".exr") origin (xyz 3 2 0) #:low -1)))
(define grey (hues "rgba-none"))
(displayln (map (lambda (h) (/ (round (* 1e4 h)) 1e4)) (take grey 5))) ; expect: (0.7513 1.0013 1.2513 1.5013 0.2513)
(displayln (list (equal? grey (hues "rgba-float")) (equal? grey (hues "offset")) (length (hues "mixed")))) ; expect: (#t #t 12)
(displayln (list (length (hues "rgba-zip")) (length (hues "tiles")) (apply max (hues "tiles")))) ; expect: (400 360 13.001299999999999)
(displayln (take (hues "ycc") 3))                           ; expect: (2.5 2.75 3.0)
(fails (hues "lie-wide"))                            ; expect: make-height-field: lie-wide.exr: the EXR picture cannot be read: EXR_ERR_CORRUPT_CHUNK ()
(fails (hues "lie-big"))                             ; expect: make-height-field: lie-big.exr: the picture has 60001 x 60001 pixels; up to 67108864 are read ()
(fails (hues "cut430"))                              ; expect: make-height-field: cut430.exr: the EXR picture cannot be read: EXR_ERR_BAD_CHUNK_LEADER ()
(fails (make-height-field "lib/pictures/huge.png" origin (xyz 1 1 0))) ; expect: make-height-field: huge.png: the picture has 3000000 x 3000000 pixels; up to 67108864 are read ()
(fails (make-height-field "lib/pictures/cut.png" origin (xyz 1 1 0))) ; expect: make-height-field: cut.png: the PNG file is cut off or broken ()
(fails (make-height-field "lib/meshes/cube.off" origin (xyz 1 1 0))) ; expect: make-height-field: cube.off: this is neither a PNG nor an EXR picture ()
(fails (make-height-field '((0 1 0) (1 2)) origin (xyz 1 1 0))) ; expect: make-height-field: source must have rows of one length: row 2 has 2 numbers, the first 3 ()
(fails (make-height-field '((0 1 0) (1 2 a)) origin (xyz 1 1 0))) ; expect: make-height-field: source must be rows of numbers, got (a)
(fails (make-height-field '((0 1 0) (1 2 -3)) origin (xyz 1 1 0))) ; expect: make-height-field: the height in row 2, column 3, must be at least #:low, got -3 ()
(fails (make-height-field (list '(0 1) (list 1 (/ 0. 0.))) origin (xyz 1 1 0))) ; expect: make-height-field: the height in row 2, column 2, must be finite, got +nan.0 ()
(fails (make-height-field '() origin (xyz 1 1 0)))   ; expect: make-height-field: source must have two or more rows of two or more numbers, got 0 of 0 ()
(fails (make-height-field 7 origin (xyz 1 1 0)))     ; expect: make-height-field: source must be the name of a PNG or EXR file, or a list of rows, each a list of numbers, got (7)
(fails (make-height-field '((0 1) (1 0)) origin (xyz 1 1 2))) ; expect: make-height-field: q must be as high as p: the two are corners of a level rectangle, got ((xyz 1 1 2))
(fails (make-height-field '((0 1) (1 0)) origin (xyz 1 1 0) #:low 2 #:high 1)) ; expect: make-height-field: high must be #:low or more, got (1)
(displayln (make-height-field '((1 1) (1 1)) origin (xyz 0 5 0))) ; expect: (empty-object)
(make-height-field '((1 1) (1 1)) origin (xyz 5 5 0) #:low 1) ; expect warning: no height is above #:low

; the bare floor round an island is no part of it, nor of its box
(define islet (make-height-field '((0 0 0 0) (0 0 2 0) (0 0 0 0) (0 0 0 0)) (xy 0 0) (xy 3 3)))
(displayln (bounding-box islet)) ; expect: ((xyz 1 0 0) (xyz 3 2 2))
