(define thickness 0.05) ; of boards
(define-syntax-rule (twice a) (list a a))
(define (less? a b) (< a b))
(define |a<b| (twice "<&\""))
