; where something is drawn, what is made beside it and not drawn is told
(define s (make-sphere origin 1))
(draw s)
s
(make-box origin (xyz 1 1 1))     ; expect warning: this object is made and not used
(do-move s ux)                    ; expect warning: this object is made and not used
(define b (make-box origin (xyz 2 2 2)))
(list 1 2)
