; SRFI 134, immutable deques: the reference implementation of Shiro Kawai and Wolfgang Corcoran-Mathe, under the MIT licence in
; 134/ideques.scm.
(define-library (srfi 134)
  (export ideque ideque-tabulate ideque-unfold ideque-unfold-right ideque? ideque-empty? ideque= ideque-any ideque-every
          ideque-front ideque-add-front ideque-remove-front ideque-back ideque-add-back ideque-remove-back ideque-ref
          ideque-take ideque-take-right ideque-drop ideque-drop-right ideque-split-at ideque-length ideque-append ideque-reverse
          ideque-count ideque-zip ideque-map ideque-filter-map ideque-for-each ideque-for-each-right ideque-fold ideque-fold-right
          ideque-append-map ideque-filter ideque-remove ideque-partition ideque-find ideque-find-right
          ideque-take-while ideque-take-while-right ideque-drop-while ideque-drop-while-right ideque-span ideque-break
          list->ideque ideque->list generator->ideque ideque->generator)
  (import (scheme base) (scheme case-lambda) (only (scheme r5rs) quotient)
          (only (srfi 1) fold-right unfold list= concatenate zip append-map) (srfi 41) (only (srfi 158) generator->list))
  (include "134/ideques.scm"))
