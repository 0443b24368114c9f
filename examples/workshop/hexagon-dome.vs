; A dome of flat hexagons and pentagons: each panel touches the sphere in its middle. Its panels, flat, on sheets:
; vs examples/workshop/hexagon-dome.vs -D flat=#t -o panels.svg

(define-parameter frequency 5 #:min 2 #:max 10 #:label "triangles along an edge of the icosahedron")
(define-parameter gap 0.03 #:min 0.01 #:max 0.2 #:label "gap between panels, m")
(define-parameter flat #f #:label "panels on sheets")

(define cells (geodesic-panels frequency 4 #:above 0.02 #:cells 'hexagons))
(printf "~a panels, ~a of them pentagons~%" (length cells) (length (filter (lambda (c) (= (length c) 5)) cells)))

(define (panel corners) (panel-plate corners 0.08 #:gap gap))
(define (bare corners) (layer "cut" (make-region (make-polygon corners))))

(if flat
    (let ((sheets (pack-parts (map bare cells) #:sheet '(3 1.5) #:gap 0.02 #:effort 0.2)))
      (for ([s sheets] [i (in-naturals)])
        (define up (vxyz 0 (* -1.7 i) 0))
        (draw (layer "sheet" (do-move (make-rectangle origin (xy 3 1.5)) up)) (do-move s up)))
      (view "panels" 'top #:sheet 'none #:scale 10))
    (begin
      (draw (with-material copper (map panel cells)))
      (ground 0)
      (camera (xyz 9 -10 4) (xyz 0 0 1.5) #:lens 40)))
