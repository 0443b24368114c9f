(define (double text) (double (string-append text text)))
(double "abc")
