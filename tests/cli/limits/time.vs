(define big (iota 3000000))
(display (length (sort (append big big big) <)))
