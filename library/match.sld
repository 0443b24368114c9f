; (match): a value is compared with patterns, one after the other. library/match/patterns.scm has the kinds of patterns.
(define-library (match)
  (export match match-lambda match-lambda* match-let match-let* match-letrec)
  (import (visualscheme))
  (include "match/patterns.scm")
  (include "match/forms.scm"))
