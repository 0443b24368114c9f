; SRFI 27: sources of random numbers. Each source has the state of a generator of its own, the one behind `random`; the default source is that of
; `random` itself.
(define-library (srfi 27)
  (export default-random-source make-random-source random-integer random-real random-source-make-integers random-source-make-reals
          random-source-pseudo-randomize! random-source-randomize! random-source-state-ref random-source-state-set! random-source?)
  (import (visualscheme) (visualscheme random))
  (begin
    ; The state is what random-state gives, a bytevector; #f: that of `random`.
    (define-record-type random-source (source state) random-source? (state source-state set-source-state!))
    (define default-random-source (source #f))
    (define (make-random-source)
      (let ((s (source (random-state)))) (random-source-pseudo-randomize! s 0 0) s))
    ; What (draw) gives when the source's generator stands behind `random`.
    (define (with-source s draw)
      (if (not (source-state s))
          (draw)
          (let ((outer (random-state)))
            (random-state! (source-state s))
            (let ((x (draw)))
              (set-source-state! s (random-state))
              (random-state! outer)
              x))))
    (define (random-source-state-ref [s random-source?]) (with-source s random-state))
    (define (random-source-state-set! [s random-source?] [state bytevector?])
      (if (source-state s) (set-source-state! s (bytevector-copy state)) (random-state! state)))
    (define (seed! s n) (with-source s (lambda () (random-seed! n))))
    (define (random-source-randomize! [s random-source?]) (seed! s (exact (floor (* 1000000 (current-second))))))
    (define (random-source-pseudo-randomize! [s random-source?] [i exact-integer?] [j exact-integer?])
      (let ((sum (+ i j))) (seed! s (+ (quotient (* sum (+ sum 1)) 2) j))))
    (define (random-source-make-integers [s random-source?])
      (lambda (n)
        (if (not (and (exact-integer? n) (> n 0))) (error "random-integer: n must be a positive exact integer, got" n))
        (with-source s (lambda () (random n)))))
    ; Between 0 and 1, both left out; with a unit, a multiple of a unit near it.
    (define (random-source-make-reals [s random-source?] [unit any? #f])
      (define count (and unit (exact (ceiling (/ 1 unit)))))
      (lambda ()
        (with-source s
          (lambda ()
            (if count
                (/ (+ 1 (random (max 1 (- count 1)))) (if (exact? unit) count (inexact count)))
                (let loop () (let ((x (random))) (if (> x 0) x (loop)))))))))
    (define random-integer (random-source-make-integers default-random-source))
    (define random-real (random-source-make-reals default-random-source))))
