; A grid of about the given number of boxes, of which each touches its 26 neighbours, or overlaps the next one in X:
; milliseconds to find all clashes. `build/vs --quiet bench/clashes.vs -D parts=10000 -D overlap=0.1`
(import (visualscheme) (visualscheme building))
(define-parameter parts 10000)
(define-parameter overlap 0. #:min 0 #:max 1)
(define-parameter size 1. #:min 0 #:max 1)
(define n (exact (ceiling (expt parts 1/3))))
(define boxes
  (append-map
    (lambda (x)
      (append-map
        (lambda (y) (map (lambda (z) (make-box (xyz x y z) (+xyz (xyz x y z) (+ size overlap) size size))) (iota n)))
        (iota n)))
    (iota n)))
(define start (current-milliseconds))
(define found (clashes boxes))
(printf "~a parts, ~a clashes, ~a ms~%" (length boxes) (length found) (- (current-milliseconds) start))
