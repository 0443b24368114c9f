; imports a library and draws nothing: the advice speaks of the program's definitions, not of the library's
(import (scheme base) (towers spiral))
(define (tower n) (spiral n))
