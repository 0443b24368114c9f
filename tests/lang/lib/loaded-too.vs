(define loaded-y 2)
