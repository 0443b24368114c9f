; (scheme division): the integer divisions of SRFI 141 beside those of (scheme base), each as quotient, remainder and both.
(define-library (scheme division)
  (export floor/ floor-quotient floor-remainder truncate/ truncate-quotient truncate-remainder
          ceiling/ ceiling-quotient ceiling-remainder round/ round-quotient round-remainder
          euclidean/ euclidean-quotient euclidean-remainder balanced/ balanced-quotient balanced-remainder)
  (import (scheme base))
  (begin
    ; Each division is its quotient; the remainder is what is left.
    (define-syntax define-division
      (syntax-rules ()
        ((_ both quotient remainder (n d) body)
         (begin
           (define (quotient n d) body)
           (define (remainder n d) (- n (* d (quotient n d))))
           (define (both n d) (let ((q (quotient n d))) (values q (- n (* d q)))))))))
    (define-division ceiling/ ceiling-quotient ceiling-remainder (n d) (- (floor-quotient (- n) d)))
    (define-division euclidean/ euclidean-quotient euclidean-remainder (n d) (if (> d 0) (floor-quotient n d) (- (floor-quotient n (- d)))))
    ; to the nearest, to the even one of two
    (define-division round/ round-quotient round-remainder (n d)
      (let* ((q (floor-quotient n d)) (left (* 2 (abs (- n (* d q))))) (size (abs d)))
        (cond ((< left size) q) ((> left size) (+ q 1)) ((even? q) q) (else (+ q 1)))))
    ; remainders from -|d/2| up to, and without, |d/2|
    (define-division balanced/ balanced-quotient balanced-remainder (n d)
      (let* ((q (euclidean-quotient n d)) (left (* 2 (- n (* d q)))))
        (if (< left (abs d)) q (if (> d 0) (+ q 1) (- q 1)))))))
