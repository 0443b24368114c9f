; An import of what VisualScheme does not have says what to use instead; (features) and cond-expand know what there is.
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(define (has? n) (and (memq (string->symbol (string-append "srfi-" (number->string n))) (features)) #t))
(show (filter has? (iota 160))) ; expect: (0 1 2 6 8 9 11 16 23 26 27 28 30 34 38 39 41 46 62 69 87 98 111 115 121 125 128 132 133 141 143 144 151 158)
(show (cond-expand ((library (srfi 19)) 'yes) (else 'no))) ; expect: no
(show (cond-expand ((and srfi-115 (library (srfi 115)) (library (match))) 'yes) (else 'no))) ; expect: yes
(show (cond-expand ((and (library (scheme vector)) (library (scheme hash-table)) (library (scheme flonum))) 'yes) (else 'no))) ; expect: yes
(show (cond-expand ((library (scheme charset)) 'yes) (else 'no))) ; expect: no
(show (cond-expand (fl-fast-fl+* 'yes) (else 'no))) ; expect: yes
(import (srfi 19)) ; expect error: (srfi 19) is not part of VisualScheme: current-second of (scheme time)
