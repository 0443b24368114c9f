; SRFI 115: regular expressions, in time that grows with the text's length times the expression's size, whatever they are.
(define-library (srfi 115)
  (export regexp regexp->sre regexp-extract regexp-fold regexp-match->list regexp-match-count regexp-match-submatch
          regexp-match-submatch-end regexp-match-submatch-start regexp-match? regexp-matches regexp-matches? regexp-partition
          regexp-replace regexp-replace-all regexp-search regexp-split regexp? rx valid-sre?)
  (import (visualscheme))
  (include "115/character_sets.scm")
  (include "115/compile.scm")
  (include "115/search.scm")
  (include "115/procedures.scm"))
