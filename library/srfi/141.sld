; SRFI 141, integer division: (scheme division).
(define-library (srfi 141)
  (export floor/ floor-quotient floor-remainder truncate/ truncate-quotient truncate-remainder
          ceiling/ ceiling-quotient ceiling-remainder round/ round-quotient round-remainder
          euclidean/ euclidean-quotient euclidean-remainder balanced/ balanced-quotient balanced-remainder)
  (import (scheme division)))
