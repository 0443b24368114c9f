; A geodesic dome's frame: bars of three lengths between balls, and the cut list of its bars.
; As the file of the cut list: vs examples/workshop/dome-frame.vs -D save=#t

(define-parameter frequency 3 #:min 1 #:max 8 #:label "triangles along an edge of the icosahedron")
(define-parameter radius 4 #:min 1 #:max 20 #:label "radius, m")
(define-parameter save #f #:label "write bars.csv")

(define panels (geodesic-panels frequency radius #:above -0.05))
(define net (panel-net panels))
(define nodes (length (first net)))
(define frame (frame-members net 0.03 #:node-radius 0.07))
(define balls (take frame nodes))
(define bars (drop frame nodes))

; equal bars share a row
(define cuts (cut-list (map (lambda (b) (with-material wood b)) bars) 'mark 'count 'length 'mass #:digits 3))
(for ([row cuts]) (displayln (string-join (map (lambda (c) (format "~a" c)) row) "   ")))
(when save (write-csv "bars.csv" cuts))

(draw (with-material steel balls) (with-material wood bars))
(ground (cz (first (bounding-box (unite balls)))))
(camera (xyz 9 -10 5) (xyz 0 0 1.4) #:lens 34)
