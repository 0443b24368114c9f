; Listings 4.4 and 4.5 of the VisualScheme thesis: a new primitive, the loft of shapes that a procedure unfolds, and how it is drawn.
;
; The listing hands the sections to AutoCAD's command _.loft and asks for the last entity; here do-loft makes the object. All else is as printed. The
; draw in draw-loft is the back-end's: while a drawing is handed over it gives its object and adds nothing to the drawing.

; Listing 4.4

(define-primitive loft
  f start step stop?)

(define (draw-loft loft)
  (let* ([f (loft-f loft)]
         [start (loft-start loft)]
         [step (loft-step loft)]
         [stop? (loft-stop? loft)]
         [surfs (unfold stop? f step start)]
         [drawn-surfs (map draw surfs)])
    (do-loft drawn-surfs)))               ; printed: (apply prim:command* "_.loft" (append drawn-surfs (list "" "" ""))) (entlast)

(register-drawing-function loft? draw-loft)

; Listing 4.5

(define (loft-objects . objects)
  (make-loft first
             objects
             rest
             null?))

; A chimney whose radius a procedure gives for every height ...
(draw (make-loft (lambda (z) (make-circle (xyz 0 0 z) (+ 1 (* 1/50 (- z 6) (- z 6)))))
                 0
                 (lambda (z) (+ z 2))
                 (lambda (z) (> z 12))))

; ... and one through shapes that are there already: from a square to a round mouth.
(draw (loft-objects (make-rectangle (xy 4 -1) (xy 6 1))
                    (make-rectangle (xyz 4 -1 1) (xyz 6 1 1))
                    (make-circle (xyz 5 0 4) 1)
                    (make-circle (xyz 5 0 5) 1)))
