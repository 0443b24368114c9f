; Classes of IFC: the layers of files in .ifc, by which vs chooses IfcWall, IfcDoor and others, come from the words of a
; building. An object of several parts is one element.

; Returns the object as one body: its intersection with a box around it.
(define (one-body o)
  (let ((b (and (not (empty-object? o)) (bounding-box o))))
    (if (not b) o (intersect o (make-box (+xyz (first b) -1 -1 -1) (+xyz (second b) 1 1 1))))))

(define (named-class class name) (if name (format "~a ~a" class name) class))

(register-drawing-function 'ifc wall?
  (lambda (w)
    (let* ((d (wall-object-data w)) (solid (unite (layer-solids d))) (holes (walling-openings d)))
      (unite (layer (named-class "wall" (walling-name d)) (one-body (if (null? holes) solid (subtract solid (map (lambda (h) (hole-cutter d h)) holes)))))
             (filter-map (lambda (h) (let ((o (hole-filled d h))) (and o (layer (if (eq? (hole-kind h) 'door) "door" "window") (one-body o))))) holes)))))

(register-drawing-function 'ifc stair-object? (lambda (s) (layer "stair" (one-body (car (stair-object-made s))))))

(register-drawing-function 'ifc element? (lambda (e) (layer (element-class e) (one-body (element-body e)))))
