; A lamp of paper: its net with folds, glue tabs and the numbers of edges, for a plotter or a laser:
; vs examples/workshop/paper-net.vs -D flat=#t -o net.svg

(define-parameter sides 4 #:min 3 #:max 9 #:label "sides")
(define-parameter size 60 #:min 20 #:max 100 #:label "size, mm")
(define-parameter flat #f #:label "the net")

(units 'mm)
; rings of corners, each turned by half a side
(define (ring r z turn) (map (lambda (i) (+z (pol r (* (+ i turn) (/ 2pi sides))) z)) (iota sides)))
(define lamp
  (hull (ring (* 0.6 size) 0 0) (ring size (* 0.7 size) 1/2) (ring (* 0.9 size) (* 1.3 size) 0) (ring (* 0.5 size) (* 2 size) 1/2)))
(define net (unfold lamp #:tabs (* 0.08 size)))
(printf "~a part, ~a square centimetres of ~a~%" (length net) (round (/ (apply + (map area net)) 100)) (round (/ (area lamp) 100)))

(if flat
    (begin
      (for ([p net]) (draw p))
      (layer "mountain" (empty-object) #:color "red" #:line 0.13)
      (view "net" 'top #:sheet 'none))
    (begin
      (draw (with-material plaster lamp))
      (ground 0)
      (camera (xyz 200 -230 150) (xyz 0 0 55) #:lens 40)))
