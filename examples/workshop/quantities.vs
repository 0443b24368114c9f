; Quantities and costs of a pavilion, and a cut list of its rafters: on the plan (vs quantities.vs -o plan.pdf), and
; with -D save=#t also as files for the office: quantities.csv, rafters.csv, and both as pavilion.xlsx

(define-parameter bays 5 #:min 2 #:max 12 #:label "bays")
(define-parameter save #f #:label "write .csv and .xlsx")

(define bay 3.6)
(define long (* bays bay))
(define slab (layer "slab" (with-material concrete (make-box (xyz -0.3 -0.3 -0.25) (xyz (+ long 0.3) 6.3 0)))))
(define posts
  (layer "posts"
    (with-material steel (for*/list ([i (+ bays 1)] [y '(0 6)]) (make-cylinder (xyz (* i bay) y 0) 3 0.06)))))
(define (rafter x) ; its ends are cut upright, and every second one is longer
  (define out (if (odd? x) 0.9 0.5))
  (make-box (xyz (- (* x bay) 0.04) (- out) 3) (xyz (+ (* x bay) 0.04) (+ 6 out) 3.24)))
(define rafters (layer "rafters" (with-material wood (map rafter (iota (+ bays 1))))))
(define roof (layer "roof" (with-material glass (make-box (xyz -0.3 -0.5 3.24) (xyz (+ long 0.3) 6.5 3.26)))))
(define all (list slab posts rafters roof))
(draw all)

(define rates '(("slab" volume 210) ("posts" mass 3.2) ("rafters" volume 640) ("roof" area 95)))
(define quantities (schedule all 'layer 'material 'count 'volume 'mass 'cost #:rates rates #:digits 2 #:total #t))
(for ([row quantities]) (displayln (string-join (map (lambda (c) (format "~a" c)) row) "   ")))

; equal rafters share a row
(define cuts (cut-list rafters #:digits 3))
(for ([row cuts]) (displayln (string-join (map (lambda (c) (format "~a" c)) row) "   ")))

(sheet-table quantities #:title "Quantities")
(sheet-table cuts #:title "Rafters" #:digits 3)

(when save
  (write-csv "quantities.csv" quantities)
  (write-csv "rafters.csv" cuts)
  (write-xlsx "pavilion.xlsx" (cons "Quantities" quantities) (cons "Rafters" cuts)))
