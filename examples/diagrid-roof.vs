; A diagrid of steel tubes over a hall of 24 by 42 metres, under its weight and snow on one half. Each tube is checked by
; EN 1993 and takes the next larger one of a catalogue while it uses more than its strength. Colours show the share used.
;
; What it teaches: (frame nodes members ...) and frame-solve compute a net of the model itself, combine-cases adds up load
; cases, utilisation checks a member, frame-picture and color-legend show the result.
(import (visualscheme) (visualscheme analysis))

(define-parameter span 24 #:min 10 #:max 40)
(define-parameter long 42 #:min 12 #:max 80)
(define-parameter rise 5.5 #:min 2 #:max 12)
(define-parameter snow 1.2 #:min 0 #:max 4) ; kN/m2
(define-parameter across 8 #:min 3 #:max 20)  ; diamonds across, and along
(define-parameter along 14 #:min 4 #:max 30)
(define height 4.5)                          ; of the edge beams

; The vault's points lie on half diamonds: i + j is even. It swells towards its middle.
(define (point i j)
  (let* ((u (/ i 2 across)) (v (/ j 2 along)) (arch (* 4 u (- 1 u))) (swell (+ 0.75 (* 0.5 (sin (* pi v))))))
    (xyz (* span (- u 1/2)) (* long (- v 1/2)) (+ height (* rise swell arch)))))
(define places
  (append-map (lambda (j) (filter-map (lambda (i) (and (even? (+ i j)) (list i j))) (iota (+ 1 (* 2 across))))) (iota (+ 1 (* 2 along)))))
(define numbers (make-hash))
(for-each (lambda (p k) (hash-set! numbers p k)) places (iota (length places) 1))
(define (number i j) (hash-ref numbers (list i j) #f))
(define (joined i j di dj) (let ((to (number (+ i di) (+ j dj)))) (if to (list (list (number i j) to)) '())))
(define diagonals (append-map (lambda (p) (append (joined (first p) (second p) 1 1) (joined (first p) (second p) -1 1))) places))
(define edges
  (append-map (lambda (p)
                (let ((i (first p)) (j (second p)))
                  (append (if (memv i (list 0 (* 2 across))) (joined i j 0 2) '()) (if (memv j (list 0 (* 2 along))) (joined i j 2 0) '()))))
              places))
(define nodes (map (lambda (p) (apply point p)) places))
(define members (append diagonals edges))

; Snow lies on the half x > 0; each node carries a diamond. The edge beams rest on columns.
(define cell (/ (* span long) 2 across along))
(define loads
  (list (cons "dead" (list 'weight (list (iota (length nodes) 1) (vxyz 0 0 (* -0.4e3 cell)))))
        (list "snow" (list (filter-map (lambda (p k) (and (> (cx p) 0) k)) nodes (iota (length nodes) 1)) (vxyz 0 0 (* -1e3 snow cell))))))
(define supports (filter-map (lambda (p k) (and (memv (first p) (list 0 (* 2 across))) (list k 'pinned))) places (iota (length places) 1)))

(define (solved sections)
  (combine-cases (frame-solve (frame nodes members #:supports supports #:loads loads #:sections sections #:materials 's355))
    '("uls" (1.35 "dead") (1.5 "snow"))))
(define (worst r) (map (lambda (k) (utilisation r k #:buckling-length 1 #:forming 'hot)) (iota (length members) 1)))

; The tubes of the catalogue, from light to heavy.
(define catalogue (list->vector (map (lambda (d) (tube-section (first d) (second d))) '((0.0889 0.004) (0.1143 0.005) (0.1397 0.006) (0.1683 0.008) (0.2191 0.01) (0.273 0.0125)))))
(define (section k) (vector-ref catalogue k))
(define (size sizes turns)
  (let* ((r (solved (map section sizes))) (shares (worst r)))
    (if (or (= turns 0) (every (lambda (u) (<= u 0.95)) shares))
        (list r shares sizes)
        (size (map (lambda (k u) (if (> u 0.95) (min 5 (+ k 1)) k)) sizes shares) (- turns 1)))))
(define sized (size (make-list (length members) 0) 12))
(define r (first sized))
(define steel (apply + (map (lambda (m k) (* 7850 (section-area (section k)) (distance (list-ref nodes (- (first m) 1)) (list-ref nodes (- (second m) 1))))) members (third sized))))
(printf "~a members, ~a kg/m2 of steel, greatest share ~a~%" (length members) (/ (round (* 10 (/ steel span long))) 10) (/ (round (* 100 (apply max (second sized)))) 100))

(define column (lambda (s) (let ((p (list-ref nodes (- (car s) 1)))) (make-cylinder (xyz (cx p) (cy p) 0) p 0.12))))
(camera (xyz -42 -50 29) (xyz -1.5 -1.5 2.2) #:lens 43)
(draw
  (frame-picture r #:case "uls")
  (color '(0.93 0.92 0.9) (map (lambda (k) (make-sphere (list-ref nodes k) 0.13)) (iota (length nodes))))
  (color '(0.55 0.56 0.58) (map column supports))
  (color '(0.83 0.81 0.77) (make-box (xyz (- (/ span -2) 140) (- (/ long -2) 140) -0.3) (xyz (+ (/ span 2) 140) (+ (/ long 2) 140) 0)))
  (do-move (do-rotate (color-legend 0 1 #:size 1.5 #:format (lambda (v) (format "~a %" (exact (round (* 100 v)))))) 'z -0.5) (vxyz (- (/ span -2) 12) (/ long 6) 0)))
