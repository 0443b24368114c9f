; Classes of IFC: the layers of files in .ifc, by which vs chooses IfcWall, IfcDoor and others, come from the words of a
; building. An object of several parts is one element.

; Returns the object as one body: of several objects, their intersection with a box around them.
(define (one-body o)
  (let ((b (and (not (empty-object? o)) (bounding-box o))))
    (if (or (not b) (= (object-count o) 1)) o (intersect o (make-box (+xyz (first b) -1 -1 -1) (+xyz (second b) 1 1 1))))))

(define (named-class class name) (if name (format "~a ~a" class name) class))

; A wall's opening is an element in the layer ifc-opening, which voids the wall before it; the window or door after it fills
; it. The body of a wall of one material has no holes: programs cut the openings out of it. Layers of several materials are
; open shells in the file, which programs cannot cut; their body has the holes already.
(register-drawing-function 'ifc wall?
  (lambda (w)
    (let* ((d (wall-object-data w)) (solid (unite (layer-solids d))) (cutters (map (lambda (h) (hole-cutter d h)) (walling-openings d)))
           (whole? (or (null? cutters) (null? (cdr (delete-duplicates (walling-materials d)))))))
      (unite (layer (named-class "wall" (walling-name d)) (one-body (if whole? solid (subtract solid cutters))))
        (append-map
          (lambda (h cutter)
            (let ((o (hole-filled d h)))
              (cons (layer "ifc-opening" cutter)
                (if o (list (layer (if (eq? (hole-kind h) 'door) "door" "window") (one-body o))) '()))))
          (walling-openings d) cutters)))))

(register-drawing-function 'ifc stair-object? (lambda (s) (layer "stair" (one-body (car (stair-object-made s))))))

(register-drawing-function 'ifc element? (lambda (e) (layer (element-class e) (one-body (element-body e)))))
