; A back-end: the plan of a drawing, the outlines of its solids seen from above, as a picture of lines, which any
; program that reads SVG shows.
;
;   vs plan.vs model.vs -o model.plan
;
; What it teaches: a back-end may ask the geometry. do-project gives the shadow of a solid, lowered makes lines of its borders, and what is left
; is text.

(define (outlines o)
  (append-map object-children (regions (lowered (do-project o 'xy)))))

(define (regions o)                       ; a shadow may be several regions
  (if (eq? (object-kind o) 'unite) (append-map regions (object-children o)) (list o)))

(define (number x) (number->string (/ (round (* 1000 (inexact x))) 1000)))

; A closed path; Y grows downwards in SVG.
(define (path points port)
  (display "<path d=\"" port)
  (for-each
   (lambda (p letter) (fprintf port "~a~a ~a " letter (number (cx p)) (number (- (cy p)))))
   points
   (cons "M" (map (lambda (p) "L") (rest points))))
  (display "Z\"/>\n" port))

(define-back-end outlined "plan"
  (lambda (objects port)
    (let* ([solids (filter solid? objects)]
           [corners (append-map (lambda (o) (or (bounding-box o) '())) solids)]
           [low (lambda (c) (apply min (map c corners)))]
           [high (lambda (c) (apply max (map c corners)))]
           [margin (* 0.05 (max (- (high cx) (low cx)) (- (high cy) (low cy))))])
      (fprintf port "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"~a ~a ~a ~a\">\n"
               (number (- (low cx) margin)) (number (- (+ (high cy) margin)))
               (number (+ (- (high cx) (low cx)) (* 2 margin))) (number (+ (- (high cy) (low cy)) (* 2 margin))))
      (fprintf port "<g fill=\"none\" stroke=\"black\" stroke-width=\"~a\" stroke-linejoin=\"round\">\n" (number (/ margin 12)))
      (for-each
       (lambda (o) (for-each (lambda (line) (path (first (object-arguments line)) port)) (outlines o)))
       solids)
      (display "</g>\n</svg>\n" port)))
  #:doc "the outlines of the solids, from above")
