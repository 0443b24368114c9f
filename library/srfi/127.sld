; SRFI 127, lazy sequences: John Cowan's reference implementation, under SRFI 127's MIT licence.
; Copyright (C) John Cowan (2015). All Rights Reserved.
;
; Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
; documentation files (the "Software"), to deal in the Software without restriction, including without limitation the
; rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit
; persons to whom the Software is furnished to do so, subject to the following conditions:
;
; The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
; Software.
;
; THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE
; WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR
; COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
; OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
(define-library (srfi 127)
  (export generator->lseq lseq? lseq=?

          lseq-car lseq-first lseq-cdr lseq-rest lseq-ref lseq-take lseq-drop

          lseq-realize lseq->generator lseq-length lseq-append lseq-zip

          lseq-map lseq-for-each lseq-filter lseq-remove

          lseq-find lseq-find-tail lseq-take-while lseq-drop-while

          lseq-any lseq-every lseq-index lseq-member lseq-memq lseq-memv)
  (import (scheme base) (scheme case-lambda))
  (include "127/lseqs-impl.scm"))
