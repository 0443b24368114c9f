; SRFI 132, sorting: Olin Shivers' reference implementation, free to use for whoever keeps its notices (132/*.scm).
(define-library (srfi 132)
  (export
    list-sorted? vector-sorted? list-merge vector-merge list-sort vector-sort
    list-stable-sort vector-stable-sort list-merge! vector-merge! list-sort!
    vector-sort! list-stable-sort! vector-stable-sort!
    list-delete-neighbor-dups vector-delete-neighbor-dups
    list-delete-neighbor-dups! vector-delete-neighbor-dups! vector-find-median
    vector-find-median!)
  (import (scheme base) (scheme case-lambda) (scheme cxr)
          (rename (only (srfi 133) vector-copy! vector-copy) (vector-copy! r7rs-vector-copy!) (vector-copy r7rs-vector-copy)))
  (include "132/delndups.scm")
  (include "132/lmsort.scm")
  (include "132/sortp.scm")
  (include "132/vector-util.scm")
  (include "132/vhsort.scm")
  (include "132/visort.scm")
  (include "132/vmsort.scm")
  (include "132/vqsort2.scm")
  (include "132/median.scm")
  (include "132/sort.scm"))
