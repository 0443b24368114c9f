(define times-loaded (+ 1 (guard (e (#t 0)) times-loaded)))
(provide times-loaded)
