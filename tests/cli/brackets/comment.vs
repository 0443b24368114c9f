(define a 1)
#| a comment that
never ends
(define b 2)
