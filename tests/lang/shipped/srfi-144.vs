; SRFI 144: each name, by values of the C standard, identities and what is refused
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(define-syntax several (syntax-rules () ((_ e) (call-with-values (lambda () e) list))))
(define-syntax refused (syntax-rules () ((_ e) (guard (c (#t (display (error-object-message c)) (for-each (lambda (x) (display " ") (write x)) (error-object-irritants c)) (newline))) e))))
(import (srfi 144))
; Constants: those of each group fulfil an equation, to the last digits.
(define (close? a b) (<= (abs (- a b)) (* 4 fl-epsilon (abs b))))
(show (list (close? fl-e (exp 1)) (close? (* fl-e fl-1/e) 1.0) (close? fl-e-2 (* fl-e fl-e)) (close? (log fl-e-pi/4) fl-pi/4))) ; expect: (#t #t #t #t)
(show (list (close? (* fl-log2-e fl-log-2) 1.0) (close? (* fl-log10-e fl-log-10) 1.0) (= fl-1/log-2 fl-log2-e) (= fl-1/log-10 fl-log10-e))) ; expect: (#t #t #t #t)
(show (list (close? (exp fl-log-3) 3.0) (close? (exp fl-log-pi) fl-pi) (close? (exp fl-log-10) 10.0))) ; expect: (#t #t #t)
(show (list (close? fl-pi (* 4 (atan 1.0))) (close? (* fl-1/pi fl-pi) 1.0) (= fl-2pi (* 2 fl-pi)) (= fl-pi/2 (/ fl-pi 2)) (close? fl-pi-squared (* fl-pi fl-pi)))) ; expect: (#t #t #t #t #t)
(show (list (close? (* 180 fl-degree) fl-pi) (close? (* fl-2/pi fl-pi) 2.0) (close? (square fl-2/sqrt-pi) (/ 4 fl-pi)))) ; expect: (#t #t #t)
(show (list (close? (square fl-sqrt-2) 2.0) (close? (square fl-sqrt-3) 3.0) (close? (square fl-sqrt-5) 5.0) (close? (square fl-sqrt-10) 10.0) (close? (* fl-sqrt-2 fl-1/sqrt-2) 1.0))) ; expect: (#t #t #t #t #t)
(show (list (close? (expt fl-cbrt-2 3) 2.0) (close? (expt fl-cbrt-3 3) 3.0) (close? (expt fl-4thrt-2 4) 2.0))) ; expect: (#t #t #t)
(show (list (close? (square fl-phi) (+ fl-phi 1)) (close? (exp fl-log-phi) fl-phi) (close? (* fl-log-phi fl-1/log-phi) 1.0))) ; expect: (#t #t #t)
(show (list (close? (log fl-e-euler) fl-euler) (close? (- fl-euler) (/ (- (flgamma 1.00001) (flgamma 0.99999)) 2e-5)) (= fl-sin-1 (sin 1.0)) (= fl-cos-1 (cos 1.0)))) ; expect: (#t #f #t #t)
(show (< (abs (+ fl-euler (/ (- (flgamma 1.00001) (flgamma 0.99999)) 2e-5))) 1e-9)) ; expect: #t
(show (list (close? fl-gamma-1/2 (flgamma 0.5)) (close? fl-gamma-1/3 (flgamma (/ 1.0 3))) (close? fl-gamma-2/3 (flgamma (/ 2.0 3))))) ; expect: (#t #t #t)
(show (list (= fl-greatest (fladjacent +inf.0 0.0)) (= fl-least (fladjacent 0.0 1.0)) (= fl-epsilon (- (fladjacent 1.0 2.0) 1.0)) fl-fast-fl+*)) ; expect: (#t #t #t #t)
(show (list (= fl-integer-exponent-zero (flinteger-exponent 0.0)) (= fl-integer-exponent-nan (flinteger-exponent +nan.0)))) ; expect: (#t #t)
; Constructors and parts
(show (list (flonum 1) (flonum 1/4) (flonum 2.5) (flonum -0.0) (flonum +nan.0))) ; expect: (1.0 0.25 2.5 -0.0 +nan.0)
(show (list (fladjacent 1.0 1.0) (flcopysign 3.0 -0.0) (make-flonum 3.0 4) (make-flonum 1.0 -1074) (make-flonum 1.0 (expt 10 30)) (make-flonum 1.0 (- (expt 10 30))))) ; expect: (1.0 -3.0 48.0 5e-324 +inf.0 0.0)
(show (list (several (flinteger-fraction -2.75)) (flexponent 48.0) (flinteger-exponent 48.0) (several (flnormalized-fraction-exponent 48.0)) (several (flnormalized-fraction-exponent -0.0)))) ; expect: ((-2.0 -0.75) 5.0 5 (0.75 6) (-0.0 0))
(show (map flsign-bit '(1.0 -1.0 0.0 -0.0))) ; expect: (0 1 0 1)
; Predicates
(show (map flonum? (list 1.0 +nan.0 1 1/2 'a))) ; expect: (#t #t #f #f #f)
(show (list (fl=? 1.0 1.0 1.0) (fl<? 1.0 2.0 3.0) (fl<? 1.0 3.0 2.0) (fl>? 2.0 1.0) (fl<=? 1.0 1.0 2.0) (fl>=? 1.0 2.0) (fl=? +nan.0 +nan.0) (fl<? -0.0 0.0))) ; expect: (#t #t #f #t #t #f #f #f)
(show (list (flunordered? 1.0 +nan.0) (flunordered? 1.0 2.0) (flinteger? 2.0) (flinteger? 2.5) (flinteger? +inf.0) (flzero? -0.0) (flpositive? 0.0) (flnegative? -0.0) (flnegative? -1.0))) ; expect: (#t #f #t #f #f #t #f #f #t)
(show (list (flodd? 3.0) (fleven? 3.0) (fleven? -4.0) (flfinite? 1.0) (flfinite? -inf.0) (flinfinite? -inf.0) (flnan? +nan.0) (flnan? 1.0))) ; expect: (#t #f #t #t #f #t #t #f)
(show (list (flnormalized? 1.0) (flnormalized? fl-least) (fldenormalized? fl-least) (flsubnormal? fl-least) (fldenormalized? 0.0))) ; expect: (#t #f #t #t #f)
; Arithmetic
(show (list (flmax) (flmin) (flmax 1.0 3.0 2.0) (flmin 1.0 -3.0) (flmax 1.0 +nan.0))) ; expect: (-inf.0 +inf.0 3.0 -3.0 1.0)
(show (list (fl+) (fl+ -0.0) (fl+ 1.0 2.0 3.0) (fl*) (fl* 2.0 3.0) (fl- 5.0) (fl- 5.0 1.0 1.0) (fl/ 4.0) (fl/ 8.0 2.0 2.0) (fl/ 1.0 0.0))) ; expect: (-0.0 -0.0 6.0 1.0 6.0 -5.0 3.0 0.25 2.0 +inf.0)
(show (list (fl+* 2.0 3.0 4.0) (fl+* (+ 1.0 fl-epsilon) (- 1.0 fl-epsilon) -1.0))) ; expect: (10.0 -4.930380657631324e-32)
(show (list (flabs -2.0) (flabsdiff 1.0 3.0) (flposdiff 1.0 3.0) (flposdiff 3.0 1.0) (flsgn -0.0) (flsgn 5.0))) ; expect: (2.0 2.0 0.0 2.0 -1.0 1.0)
(show (list (flnumerator -2.25) (fldenominator -2.25) (flnumerator -0.0) (fldenominator 0.0) (flnumerator -inf.0) (fldenominator +inf.0) (flnumerator +nan.0) (fldenominator +nan.0))) ; expect: (-9.0 4.0 -0.0 1.0 -inf.0 1.0 +nan.0 +nan.0)
(show (list (flfloor -1.5) (flceiling -1.5) (flround 0.5) (flround 1.5) (flround -2.5) (fltruncate -1.5))) ; expect: (-2.0 -1.0 0.0 2.0 -2.0 -1.0)
; Functions: at 1e-10 the accurate ones keep all digits.
(show (list (flexp 0.0) (flexp2 10.0) (close? (flexp-1 1e-10) 1.00000000005e-10) (close? (fllog1+ 1e-10) 9.9999999995e-11))) ; expect: (1.0 1024.0 #t #t)
(show (list (flsquare 3.0) (flsqrt 9.0) (flsqrt -0.0) (flsqrt -1.0) (flcbrt -27.0) (flhypot 3.0 4.0) (flexpt 2.0 10.0) (flexpt 0.0 2.0) (flexpt -8.0 0.5))) ; expect: (9.0 3.0 -0.0 +nan.0 -3.0 5.0 1024.0 0.0 +nan.0)
(show (list (fllog 1.0) (fllog -1.0) (fllog2 1024.0) (fllog10 1000.0) ((make-fllog-base 2.0) 8.0) ((make-fllog-base 10.0) 100.0) (close? ((make-fllog-base 3.0) 81.0) 4.0))) ; expect: (0.0 +nan.0 10.0 3.0 3.0 2.0 #t)
(show (list (flsin 0.0) (flcos 0.0) (fltan 0.0) (flasin 2.0) (close? (flasin 1.0) fl-pi/2) (close? (flacos -1.0) fl-pi))) ; expect: (0.0 1.0 0.0 +nan.0 #t #t)
(show (list (close? (flatan 1.0) fl-pi/4) (close? (flatan 1.0 -1.0) (* 3 fl-pi/4)) (close? (flatan 0.0 -1.0) fl-pi))) ; expect: (#t #t #t)
(show (list (close? (flsinh 1.0) (sinh 1.0)) (close? (flcosh 1.0) (cosh 1.0)) (close? (fltanh 1.0) (tanh 1.0)) (close? (flsinh (flasinh 2.0)) 2.0) (close? (flcosh (flacosh 2.0)) 2.0) (close? (fltanh (flatanh 0.5)) 0.5))) ; expect: (#t #t #t #t #t #t)
(show (list (flquotient -7.5 2.0) (flremainder -7.5 2.0) (flquotient 1e300 3e-10) (flquotient 1.0 0.1) (several (flremquo 10.0 3.0)) (several (flremquo -11.0 3.0)))) ; expect: (-3.0 -1.5 +inf.0 9.0 (1.0 3) (1.0 -4))
(show (list (flgamma 5.0) (several (flloggamma 1.0)) (cadr (several (flloggamma -0.5))) (cadr (several (flloggamma -1.5))) (cadr (several (flloggamma -0.0))))) ; expect: (24.0 (0.0 1.0) -1.0 1.0 -1.0)
(show (list (close? (flfirst-bessel 0 1.0) 0.7651976865579666) (close? (flfirst-bessel 2 1.0) 0.1149034849319005) (close? (flsecond-bessel 0 1.0) 0.08825696421567697))) ; expect: (#t #t #t)
(show (list (close? (flerf 1.0) 0.8427007929497149) (close? (+ (flerf 0.3) (flerfc 0.3)) 1.0) (flerfc +inf.0))) ; expect: (#t #t 0.0)
(refused (fl+ 1.0 2)) ; expect: fl+: argument 2 must be a flonum such as 2.0, got 2
(refused (flsin 1)) ; expect: flsin: x must be a flonum such as 2.0, got 1
(refused (flatan 1.0 1/2)) ; expect: flatan: x must be a flonum such as 2.0, got 1/2
(refused (make-flonum 1.0 2.0)) ; expect: make-flonum: power must be an exact integer, got 2.0
(refused (flfirst-bessel 1.0 1.0)) ; expect: flfirst-bessel: order must be an exact integer, got 1.0
(refused (flodd? 2.5)) ; expect: flodd?: x must be flinteger?, got 2.5
(flonum 'a) ; expect error: flonum: x must be real?, got a
