(define (hoard kept) (hoard (cons 1.5 kept)))
(hoard '())
