; SRFI 143: fixnums, the exact integers of 48 bits. A result that needs more bits is an error.
(define-library (srfi 143)
  (export fixnum? fx* fx*/carry fx+ fx+/carry fx- fx-/carry fx-greatest fx-least fx-width fx<=? fx<? fx=? fx>=? fx>? fxabs fxand
          fxarithmetic-shift fxarithmetic-shift-left fxarithmetic-shift-right fxbit-count fxbit-field fxbit-field-reverse
          fxbit-field-rotate fxbit-set? fxcopy-bit fxeven? fxfirst-set-bit fxif fxior fxlength fxmax fxmin fxneg fxnegative? fxnot
          fxodd? fxpositive? fxquotient fxremainder fxsqrt fxsquare fxxor fxzero?)
  (import (visualscheme) (fixnum core) (srfi 151) (scheme division))
  (begin
    (define fx-width 48)
    (define fx-greatest (- (expt 2 47) 1))
    (define fx-least (- (expt 2 47)))
    ; The number of a bit, and the end of a field.
    (define (from-0-to-47? i) (and (natural? i) (< i fx-width)))
    (define (from-0-to-48? i) (and (natural? i) (<= i fx-width)))
    ; Returns i, or refuses it.
    (define (checked who i)
      (if (fixnum? i) i (error (string-append who ": the result has more than 48 bits:") i)))

    (define (fxsqrt [i fixnum?]) (exact-integer-sqrt i))
    ; Returns the lowest 48 bits of n, as a fixnum, and the rest.
    (define (with-carry n) (call-with-values (lambda () (balanced/ n (expt 2 fx-width))) (lambda (carry low) (values low carry))))
    (define (fx+/carry [i fixnum?] [j fixnum?] [k fixnum?]) (with-carry (+ i j k)))
    (define (fx-/carry [i fixnum?] [j fixnum?] [k fixnum?]) (with-carry (- i j k)))
    (define (fx*/carry [i fixnum?] [j fixnum?] [k fixnum?]) (with-carry (+ (* i j) k)))

    (define (fxif mask i j) (fxior (fxand mask i) (fxand (fxnot mask) j)))
    (define (fxbit-set? [index from-0-to-47?] [i fixnum?]) (bit-set? index i))
    (define (fxcopy-bit [index from-0-to-47?] [i fixnum?] [bit boolean?]) (checked "fxcopy-bit" (copy-bit index i bit)))
    (define (fxfirst-set-bit [i fixnum?]) (first-set-bit i))
    (define (fxbit-field [i fixnum?] [start from-0-to-48?] [end from-0-to-48?]) (checked "fxbit-field" (bit-field i start end)))
    (define (fxbit-field-rotate [i fixnum?] [count fixnum?] [start from-0-to-48?] [end from-0-to-48?])
      (checked "fxbit-field-rotate" (bit-field-rotate i count start end)))
    (define (fxbit-field-reverse [i fixnum?] [start from-0-to-48?] [end from-0-to-48?])
      (checked "fxbit-field-reverse" (bit-field-reverse i start end)))))
