; Sets of integers as sorted ranges, of Scheme 48, under the BSD licence in srfi-14.scm: for SRFI 14 alone.
(define-library (srfi 14 inversion-list)
  (export
    inversion-list?
    make-empty-inversion-list
    number->inversion-list
    numbers->inversion-list
    range->inversion-list
    ranges->inversion-list

    inversion-list=?
    inversion-list-adjoin
    inversion-list-complement
    inversion-list-copy
    inversion-list-difference
    inversion-list-fold/done?
    inversion-list-hash
    inversion-list-intersection
    inversion-list-member?
    inversion-list-remove
    inversion-list-size
    inversion-list-union

    inversion-list-cursor
    inversion-list-cursor?
    inversion-list-cursor-ref
    inversion-list-cursor-next
    inversion-list-cursor-at-end?)

  (import (rename (scheme base) (define-record-type define-plain-record-type)))
  (begin
    (define (assertion-violation who message . irritants) (apply error message irritants))
    (define-syntax define-record-discloser (syntax-rules () ((_ type discloser) (define unused #f))))
    (define-syntax define-record-type (syntax-rules () ((_ tag type . more) (define-plain-record-type type . more)))))
  (include "inversion-list-impl.scm"))
