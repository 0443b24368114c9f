; Reading looks: the material, layer and place of an object.
(define s (make-sphere origin 1))
(define b (make-box (xyz 5 0 0) (xyz 6 1 1)))
(define oak (make-material #:name "oak" #:color "#804020" #:roughness 0.7 #:transparency 0.25))
(displayln (object-material s))                                              ; expect: #f
(displayln (object-layer s))                                                 ; expect: #f
(displayln (object-material (with-material oak s)))                          ; expect: (make-material #:name "oak" #:color "#804020" #:roughness 0.7 #:transparency 0.25)
(displayln (material-name (object-material (with-material oak s))))          ; expect: oak
(displayln (material-color oak))                                             ; expect: (0.5019607843137255 0.25098039215686274 0.12549019607843137)
(displayln (map (lambda (f) (f oak)) (list material-roughness material-transparency))) ; expect: (0.7 0.25)
(displayln (material-name "red"))                                            ; expect: red
(displayln (material-name (make-material)))                                  ; expect:
; the innermost counts, through placements and layers
(displayln (object-material (with-material steel (do-move (layer "a" (with-material oak s)) (vxyz 1 2 3))))) ; expect: (make-material #:name "oak" #:color "#804020" #:roughness 0.7 #:transparency 0.25)
(displayln (object-layer (layer "a" (do-scale (layer "b" (color "red" s)) 2)))) ; expect: b
; a union has a look if all parts agree
(displayln (object-material (unite (with-material steel s) (with-material steel b)))) ; expect: steel
(displayln (object-material (unite (with-material steel s) (with-material brick b)))) ; expect: #f
(displayln (object-material (unite (with-material steel s) b)))              ; expect: #f
(displayln (object-material (with-material steel (unite (with-material steel s) b)))) ; expect: steel
(displayln (object-material (with-material brick (unite (with-material steel s) b)))) ; expect: #f
(displayln (object-layer (unite (layer "x" s) (layer "x" b))))               ; expect: x
(displayln (object-layer (unite (layer "x" s) (layer "y" b))))               ; expect: #f
; a subtraction has the look of its first operand
(displayln (object-material (subtract (with-material steel s) (with-material brick b)))) ; expect: steel
(displayln (object-material (intersect (with-material steel s) (with-material steel b)))) ; expect: steel
(displayln (object-material (empty-object)))                                 ; expect: #f
(displayln (object-layer (list (layer "x" s) (layer "x" b))))                ; expect: x
; a part that is used 2^60 times is looked at once
(define (double o n) (if (= n 0) o (double (unite o (do-move o (vxyz n 0 0))) (- n 1))))
(displayln (object-material (double (with-material steel s) 60)))            ; expect: steel
; a chain of 100,000 placements
(define (nest o n) (if (= n 0) o (nest (do-move o (vxyz 0 0 n)) (- n 1))))
(displayln (object-layer (layer "deep" (nest s 100000))))                    ; expect: deep
; places
(displayln (cdr (object-origin (make-sphere origin 2))))                     ; expect: (36 32)
(define (post) (make-cylinder origin 1 2))
(displayln (cdr (object-origin (post))))                                     ; expect: (37 16)
(displayln (string-suffix? (car (object-origin s)) "geometry-looks.vs"))     ; expect: #t
(displayln (guard (e (#t (string-contains? (error-object-message e) "o must be an object"))) (object-material 5))) ; expect: #t
(material-color "unobtainium")                                               ; expect error: m must be a material, or the name of one
