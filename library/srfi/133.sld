; SRFI 133, vectors: the reference implementation (Taylor Campbell, John Cowan), under SRFI 133's MIT licence.
(define-library (srfi 133)
  (export 
    ;;; * Constructors
    vector-unfold vector-unfold-right (rename base:vector-copy vector-copy) vector-reverse-copy
    (rename base:vector-append vector-append) vector-concatenate vector-append-subvectors

    ;;; * Predicates
    vector-empty? vector=

    ;;; * Iteration
    vector-fold vector-fold-right (rename base:vector-map vector-map) vector-map! (rename base:vector-for-each vector-for-each)
    vector-count vector-cumulate

    ;;; * Searching
    vector-index vector-skip vector-index-right vector-skip-right
    vector-binary-search vector-any vector-every vector-partition

    ;;; * Mutators
    vector-swap! (rename base:vector-fill! vector-fill!) vector-reverse! (rename base:vector-copy! vector-copy!) vector-reverse-copy!
    vector-unfold! vector-unfold-right!

    ;;; * Conversion
    (rename base:vector->list vector->list) reverse-vector->list (rename base:list->vector list->vector) reverse-list->vector
    (rename base:vector->string vector->string) (rename base:string->vector string->vector))
  (import (prefix (only (scheme base) vector-copy vector-append vector-map vector-for-each vector-fill! vector-copy! vector->list list->vector vector->string string->vector) base:)
          (scheme case-lambda) (rename (scheme base) (vector-fill! rnrs:vector-fill!) (vector->list rnrs:vector->list) (list->vector rnrs:list->vector))
          (scheme cxr) (srfi 8))
  (begin (define div floor-quotient) (define fx+ +))
  (include "133/vectors-impl.scm"))
