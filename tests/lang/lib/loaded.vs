(define loaded-x 1)
(load "loaded-too.vs")
