; SRFI 121: the generators of SRFI 158 that it had first.
(define-library (srfi 121)
  (export bytevector->generator gappend gcombine gcons* gdelete gdelete-neighbor-dups gdrop gdrop-while generator generator->list
          generator->reverse-list generator->string generator->vector generator->vector! generator-any generator-count generator-every
          generator-find generator-fold generator-for-each generator-unfold gfilter gindex gremove gselect gtake gtake-while list->generator
          make-coroutine-generator make-for-each-generator make-iota-generator make-range-generator make-unfold-generator
          reverse-vector->generator string->generator vector->generator)
  (import (srfi 158)))
