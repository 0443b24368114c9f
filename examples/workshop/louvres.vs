; Louvres before a window that shade it from the summer sun and let the winter sun in: they lie along the rays of noon
; in winter, and solar-hours counts what reaches the glass.

(define-parameter latitude 48 #:min -60 #:max 60 #:label "latitude")
(define-parameter count 12 #:min 3 #:max 40 #:label "louvres")
(define-parameter depth 0.22 #:min 0.05 #:max 0.5 #:label "depth of a louvre, m")

(define (sun-at date time) (sun-direction #:latitude latitude #:date date #:time time))
(define noon (sun-at "2026-12-21" "12:00"))

; the window faces south; a louvre's depth lies along the rays
(define wide 3.)
(define high 2.4)
(define pitch (/ high count))
(define slope (atan (cz noon) (- (cy noon))))
(define louvre (do-rotate (make-box (xyz 0 (/ depth -2) -0.01) (xyz wide (/ depth 2) 0.01)) 'x (- slope)))
(define louvres
  (for/list ([i count]) (do-move louvre (vxyz 0 -0.3 (* pitch (+ i 1/2))))))

; hours of sun on the glass, with and without louvres
(define places (for*/list ([x '(0.5 1.5 2.5)] [z '(0.4 1.2 2.0)]) (xyz x 0 z)))
(define (mean l) (/ (apply + l) (length l)))
(define (hours date among)
  (mean (solar-hours places (vxyz 0 -1 0) #:latitude latitude #:date date #:among among)))
(for ([day '("2026-06-21" "2026-12-21")])
  (printf "~a: ~a hours of sun, behind louvres ~a~%" day (/ (round (* 10 (hours day '()))) 10)
          (/ (round (* 10 (hours day louvres))) 10)))

(define wall
  (subtract (make-box (xyz -1 0.02 -0.8) (xyz (+ wide 1) 0.3 (+ high 0.8))) (make-box (xyz 0 -1 0) (xyz wide 1 high))))
(draw (with-material plaster wall)
      (with-material glass (make-box (xyz 0 0.1 0) (xyz wide 0.12 high)))
      (with-material wood louvres))
(sun #:latitude latitude #:longitude 0 #:date "2026-06-21" #:time "12:00")
(camera (xyz 7 -7 3) (xyz 1.5 0 1.1) #:lens 40)
