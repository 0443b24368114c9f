; SRFI 64, as it comes with the language
(import (scheme base) (scheme write) (srfi 64))
(test-begin "arithmetic")                ; expect: %%%% Starting test arithmetic
(test-equal "sum" 4 (+ 2 2))
(test-assert (< 1 2))
(test-error (car 5))
(test-approximate 1.0 1.01 0.1)
(test-group "inner" (test-eqv 'a 'a))
(test-expect-fail 1)
(test-equal "known" 5 (+ 2 2))
(test-equal "wrong" 5 (+ 2 2))           ; expect: FAIL wrong
(test-end "arithmetic")
; expect: # of expected passes      5
; expect: # of expected failures    1
; expect: # of unexpected failures  1
