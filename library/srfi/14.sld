; SRFI 14, character sets: the implementation of Scheme 48 with Unicode's categories, under the BSD licence in 14/srfi-14.scm.
(define-library (srfi 14)
  (export
    ; Predicates & comparison
    char-set? char-set= char-set<= char-set-hash
    ; Iterating over character sets
    char-set-cursor char-set-ref char-set-cursor-next end-of-char-set?
    char-set-fold char-set-unfold char-set-unfold!
    char-set-for-each char-set-map
    ; Creating character sets
    char-set-copy char-set
    list->char-set  string->char-set
    list->char-set! string->char-set!
    char-set-filter  ucs-range->char-set
    char-set-filter! ucs-range->char-set!
    (rename x->char-set ->char-set)
    ; Querying character sets
    char-set->list char-set->string
    char-set-size char-set-count char-set-contains?
    char-set-every char-set-any
    ; Character-set algebra
    char-set-adjoin  char-set-delete
    char-set-adjoin! char-set-delete!
    char-set-complement  char-set-union  char-set-intersection
    char-set-complement! char-set-union! char-set-intersection!
    char-set-difference  char-set-xor  char-set-diff+intersection
    char-set-difference! char-set-xor! char-set-diff+intersection!
    ; Standard character sets
    char-set:lower-case  char-set:upper-case  char-set:title-case
    char-set:letter      char-set:digit       char-set:letter+digit
    char-set:graphic     char-set:printing    char-set:whitespace
    char-set:iso-control char-set:punctuation char-set:symbol
    char-set:hex-digit   char-set:blank       char-set:ascii
    char-set:empty       char-set:full)
  (import (scheme base) (scheme cxr)
          (rename (only (srfi 1) partition) (partition partition-list))
          (srfi 14 inversion-list) (srfi optionals))
  (begin
    (define-syntax define-record-discloser (syntax-rules () ((_ type discloser) (define unused #f))))
    (define (assertion-violation who message . irritants) (apply error message irritants))
    (define (make-immutable! obj) #f)
    (define char->scalar-value char->integer)
    (define scalar-value->char integer->char)
    (define make-byte-vector make-bytevector)
    (define byte-vector-ref bytevector-u8-ref)
    (define byte-vector-set! bytevector-u8-set!)
    (define byte-vector=? equal?)
    (define (copy-bytes! from from-index to to-index count) (bytevector-copy! to to-index from from-index (+ from-index count)))
    (define byte-vector-length bytevector-length)
    (define (unspecific) (if #f #f))
    (define-syntax opt-lambda (syntax-rules () ((_ args body ...) (%opt-lambda args () body ...))))
    (define-syntax %opt-lambda
      (syntax-rules ()
        ((_ () (fixed ...) body ...) (lambda (fixed ...) body ...))
        ((_ ((name . default) . more) (fixed ...) body ...) (lambda (fixed ... . rest) (let-optionals* rest ((name . default) . more) body ...)))
        ((_ (name . more) (fixed ...) body ...) (%opt-lambda more (fixed ... name) body ...)))))
  (include "14/srfi-14.scm")
  (include "14/srfi-14-base-char-sets.scm")
  (include "14/srfi-14-char-sets.scm"))
