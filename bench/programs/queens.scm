; Lists and tests: every way to place ten queens.
(define (safe? row distance placed)
  (or (null? placed)
      (and (not (= (car placed) (+ row distance)))
           (not (= (car placed) (- row distance)))
           (not (= (car placed) row))
           (safe? row (+ distance 1) (cdr placed)))))
(define (queens n k placed)
  (if (= k 0)
      1
      (let loop ((row 1) (found 0))
        (if (> row n)
            found
            (loop (+ row 1)
                  (if (safe? row 1 placed) (+ found (queens n (- k 1) (cons row placed))) found))))))
(write (queens 10 10 '()))
