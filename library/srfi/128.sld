; SRFI 128: comparators. Each contains a test of type, an equality, an order and a hash function for some values.
(define-library (srfi 128)
  (export <=? <? =? >=? >? boolean-hash char-ci-hash char-hash comparator-check-type comparator-equality-predicate comparator-hash
          comparator-hash-function comparator-hashable? comparator-if<=> comparator-ordered? comparator-ordering-predicate
          comparator-register-default! comparator-test-type comparator-type-test-predicate comparator? default-hash hash-bound hash-salt
          make-comparator make-default-comparator make-eq-comparator make-equal-comparator make-eqv-comparator make-list-comparator
          make-pair-comparator make-vector-comparator number-hash string-ci-hash string-hash symbol-hash)
  (import (visualscheme))
  (include "128/comparators.scm" "128/default_comparator.scm"))
