; SRFI 144: flonums, the inexact numbers, which have 64 bits. Every argument must be a flonum; a result that is no real number is +nan.0.
(define-library (srfi 144)
  (export
          fl* fl+ fl+* fl- fl-1/e fl-1/log-10 fl-1/log-2 fl-1/log-phi fl-1/pi fl-1/sqrt-2 fl-2/pi fl-2/sqrt-pi fl-2pi
          fl-4thrt-2 fl-cbrt-2 fl-cbrt-3 fl-cos-1 fl-degree fl-e fl-e-2 fl-e-euler fl-e-pi/4 fl-epsilon fl-euler
          fl-fast-fl+* fl-gamma-1/2 fl-gamma-1/3 fl-gamma-2/3 fl-greatest fl-integer-exponent-nan
          fl-integer-exponent-zero fl-least fl-log-10 fl-log-2 fl-log-3 fl-log-phi fl-log-pi fl-log10-e fl-log2-e
          fl-phi fl-pi fl-pi-squared fl-pi/2 fl-pi/4 fl-sin-1 fl-sqrt-10 fl-sqrt-2 fl-sqrt-3 fl-sqrt-5 fl/ fl<=? fl<?
          fl=? fl>=? fl>? flabs flabsdiff flacos flacosh fladjacent flasin flasinh flatan flatanh flcbrt flceiling
          flcopysign flcos flcosh fldenominator fldenormalized? flerf flerfc fleven? flexp flexp-1 flexp2 flexponent
          flexpt flfinite? flfirst-bessel flfloor flgamma flhypot flinfinite? flinteger-exponent flinteger-fraction
          flinteger? fllog fllog1+ fllog10 fllog2 flloggamma flmax flmin flnan? flnegative?
          flnormalized-fraction-exponent flnormalized? flnumerator flodd? flonum flonum? flposdiff flpositive?
          flquotient flremainder flremquo flround flsecond-bessel flsgn flsign-bit flsin flsinh flsqrt flsquare
          flsubnormal? fltan fltanh fltruncate flunordered? flzero? make-fllog-base make-flonum)
  (import (visualscheme) (flonum core))
  (begin
    ; ---- constants ----
    (define fl-e 2.7182818284590452354)
    (define fl-1/e 0.3678794411714423216)
    (define fl-e-2 7.3890560989306502272)
    (define fl-e-pi/4 2.1932800507380154566)
    (define fl-log2-e 1.4426950408889634074)
    (define fl-log10-e 0.43429448190325182765)
    (define fl-log-2 0.69314718055994530942)
    (define fl-1/log-2 1.4426950408889634074)
    (define fl-log-3 1.0986122886681096914)
    (define fl-log-pi 1.1447298858494001741)
    (define fl-log-10 2.302585092994045684)
    (define fl-1/log-10 0.43429448190325182765)
    (define fl-pi 3.1415926535897932385)
    (define fl-1/pi 0.31830988618379067154)
    (define fl-2pi 6.2831853071795864769)
    (define fl-pi/2 1.5707963267948966192)
    (define fl-pi/4 0.78539816339744830962)
    (define fl-pi-squared 9.8696044010893586188)
    (define fl-degree 0.017453292519943295769)
    (define fl-2/pi 0.63661977236758134308)
    (define fl-2/sqrt-pi 1.1283791670955125739)
    (define fl-sqrt-2 1.4142135623730950488)
    (define fl-sqrt-3 1.7320508075688772935)
    (define fl-sqrt-5 2.2360679774997896964)
    (define fl-sqrt-10 3.162277660168379332)
    (define fl-1/sqrt-2 0.7071067811865475244)
    (define fl-cbrt-2 1.2599210498948731648)
    (define fl-cbrt-3 1.4422495703074083823)
    (define fl-4thrt-2 1.1892071150027210667)
    (define fl-phi 1.6180339887498948482)
    (define fl-log-phi 0.4812118250596034475)
    (define fl-1/log-phi 2.0780869212350275376)
    (define fl-euler 0.57721566490153286061)
    (define fl-e-euler 1.7810724179901979852)
    (define fl-sin-1 0.84147098480789650665)
    (define fl-cos-1 0.5403023058681397174)
    (define fl-gamma-1/2 1.7724538509055160273)
    (define fl-gamma-1/3 2.6789385347077476337)
    (define fl-gamma-2/3 1.3541179394264004169)

    (define fl-greatest 1.7976931348623157e308)
    (define fl-least 4.9406564584124654e-324)
    (define fl-epsilon 2.220446049250313e-16)
    (define fl-fast-fl+* #t)
    (define fl-integer-exponent-zero (flinteger-exponent 0.0))
    (define fl-integer-exponent-nan (flinteger-exponent +nan.0))

    ; ---- predicates ----
    (define (flonum [x real?]) (inexact x))
    (define (flunordered? [x flonum?] [y flonum?]) (or (nan? x) (nan? y)))
    (define (flinteger? [x flonum?]) (integer? x))
    (define (flzero? [x flonum?]) (zero? x))
    (define (flpositive? [x flonum?]) (positive? x))
    (define (flnegative? [x flonum?]) (negative? x))
    (define (flodd? [x flinteger?]) (odd? x))
    (define (fleven? [x flinteger?]) (even? x))
    (define (flfinite? [x flonum?]) (finite? x))
    (define (flinfinite? [x flonum?]) (infinite? x))
    (define (flnan? [x flonum?]) (nan? x))
    (define flsubnormal? fldenormalized?)

    ; ---- fractions and logarithms ----
    (define (flnumerator [x flonum?]) (if (or (zero? x) (not (finite? x))) x (numerator x)))
    (define (fldenominator [x flonum?]) (cond ((nan? x) x) ((infinite? x) 1.0) (else (denominator x))))
    (define (above-1? x) (and (flonum? x) (> x 1.0)))
    (define (make-fllog-base [base above-1?])
      (cond ((= base 2.0) fllog2)
            ((= base 10.0) fllog10)
            (else (let ((scale (fllog base))) (lambda (x) (fl/ (fllog x) scale))))))))
