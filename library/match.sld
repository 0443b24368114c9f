; Pattern matching by Alex Shinn, in the public domain: (match x (pattern body ...) ...).
(define-library (match)
  (export match match-lambda match-lambda* match-let match-letrec match-let*)
  (import (scheme base) (scheme cxr))
  (begin
    (define-syntax slot-ref (syntax-rules () ((_ type record n) (error "match: records are matched by (? predicate), not by" 'type))))
    (define-syntax slot-set! (syntax-rules () ((_ type record n value) (error "match: records are matched by (? predicate), not by" 'type))))
    (define-syntax is-a? (syntax-rules () ((_ record type) (error "match: records are matched by (? predicate), not by" 'type)))))
  (include "match.scm"))
