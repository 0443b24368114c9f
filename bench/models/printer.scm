; No model at all: the text of separate.vs' scene, printed.
(define count (string->number (cadr (command-line))))
(do ((j 0 (+ j 1))) ((= j count))
  (do ((i 0 (+ i 1))) ((= i count))
    (let ((x (number->string (* 3 i))) (y (number->string (* 3 j))))
      (for-each display (list "cylinder { <" x ", " y ", 0>, <" x ", " y ", 2>, 1 }\n")))))
