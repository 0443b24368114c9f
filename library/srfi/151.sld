; SRFI 151: the bits of exact integers, numbered from 0 for the lowest. A negative integer has endlessly many bits that are 1.
(define-library (srfi 151)
  (export any-bit-set? arithmetic-shift bit-count bit-field bit-field-any? bit-field-clear bit-field-every? bit-field-replace
          bit-field-replace-same bit-field-reverse bit-field-rotate bit-field-set bit-set? bit-swap bits bits->list bits->vector
          bitwise-and bitwise-andc1 bitwise-andc2 bitwise-eqv bitwise-fold bitwise-for-each bitwise-if bitwise-ior bitwise-nand
          bitwise-nor bitwise-not bitwise-orc1 bitwise-orc2 bitwise-unfold bitwise-xor copy-bit every-bit-set? first-set-bit
          integer-length list->bits make-bitwise-generator vector->bits)
  (import (visualscheme) (fixnum core))
  (begin
    ; ---- two integers, bit by bit ----
    (define (bitwise-eqv . integers)
      (if (odd? (length integers)) (apply bitwise-xor integers) (bitwise-not (apply bitwise-xor integers))))
    (define (bitwise-nand i j) (bitwise-not (bitwise-and i j)))
    (define (bitwise-nor i j) (bitwise-not (bitwise-ior i j)))
    (define (bitwise-andc1 i j) (bitwise-and (bitwise-not i) j))
    (define (bitwise-andc2 i j) (bitwise-and i (bitwise-not j)))
    (define (bitwise-orc1 i j) (bitwise-ior (bitwise-not i) j))
    (define (bitwise-orc2 i j) (bitwise-ior i (bitwise-not j)))
    (define (bitwise-if mask i j) (bitwise-ior (bitwise-and mask i) (bitwise-andc1 mask j)))

    ; Returns the integer whose n lowest bits are 1.
    (define (ones n) (- (arithmetic-shift 1 n) 1))
    ; Counts the bits of n, which has at most `length` of them, in parts that are fixnums.
    (define (count-ones n length)
      (if (< length 48)
          (fxbit-count n)
          (let ((half (quotient length 2)))
            (+ (count-ones (bitwise-and n (ones half)) half) (count-ones (arithmetic-shift n (- half)) (- length half))))))
    ; Returns the number of bits that differ from the sign.
    (define (bit-count [i exact-integer?])
      (count-ones (if (< i 0) (bitwise-not i) i) (integer-length i)))

    ; ---- single bits ----
    (define (bit-set? [index natural?] [i exact-integer?])
      (if (< index (integer-length i)) (odd? (arithmetic-shift i (- index))) (< i 0)))
    (define (copy-bit [index natural?] [i exact-integer?] [bit boolean?])
      (let ((mask (arithmetic-shift 1 index))) (if bit (bitwise-ior i mask) (bitwise-andc2 i mask))))
    (define (bit-swap [index1 natural?] [index2 natural?] [i exact-integer?])
      (copy-bit index1 (copy-bit index2 i (bit-set? index1 i)) (bit-set? index2 i)))
    (define (any-bit-set? mask i) (not (= 0 (bitwise-and mask i))))
    (define (every-bit-set? mask i) (= mask (bitwise-and mask i)))
    (define (first-set-bit [i exact-integer?]) (- (integer-length (bitwise-and i (- i))) 1))

    ; ---- fields: the bits from start to end, without end ----
    ; Returns the mask of a field.
    (define (field who start end)
      (if (not (<= start end)) (error (string-append who ": the field must not end before it starts, got") start end))
      (arithmetic-shift (ones (- end start)) start))
    (define (bit-field [i exact-integer?] [start natural?] [end natural?])
      (arithmetic-shift (bitwise-and i (field "bit-field" start end)) (- start)))
    (define (bit-field-any? [i exact-integer?] [start natural?] [end natural?])
      (any-bit-set? (field "bit-field-any?" start end) i))
    (define (bit-field-every? [i exact-integer?] [start natural?] [end natural?])
      (every-bit-set? (field "bit-field-every?" start end) i))
    (define (bit-field-clear [i exact-integer?] [start natural?] [end natural?])
      (bitwise-andc2 i (field "bit-field-clear" start end)))
    (define (bit-field-set [i exact-integer?] [start natural?] [end natural?])
      (bitwise-ior i (field "bit-field-set" start end)))
    (define (bit-field-replace [to exact-integer?] [from exact-integer?] [start natural?] [end natural?])
      (bitwise-if (field "bit-field-replace" start end) (arithmetic-shift from start) to))
    (define (bit-field-replace-same [to exact-integer?] [from exact-integer?] [start natural?] [end natural?])
      (bitwise-if (field "bit-field-replace-same" start end) from to))
    (define (bit-field-rotate [i exact-integer?] [count exact-integer?] [start natural?] [end natural?])
      (field "bit-field-rotate" start end)
      (let* ((size (- end start)) (up (if (= size 0) 0 (modulo count size))) (bits (bit-field i start end)))
        (bit-field-replace i (bitwise-ior (arithmetic-shift bits up) (arithmetic-shift bits (- up size))) start end)))
    (define (bit-field-reverse [i exact-integer?] [start natural?] [end natural?])
      (field "bit-field-reverse" start end)
      (bit-field-replace i (list->bits (reverse (bits->list (bit-field i start end) (- end start)))) start end))

    ; ---- bits as booleans, the lowest first ----
    ; Returns the bits below (integer-length i).
    (define (significant-bits i)
      (let ((text (number->string (if (< i 0) (bitwise-not i) i) 2)) (one (if (< i 0) #\0 #\1)))
        (take (reverse (map (lambda (digit) (char=? digit one)) (string->list text))) (integer-length i))))
    (define (bits->list [i natural?] [count natural? (integer-length i)])
      (let ((bits (significant-bits i)) (length (integer-length i)))
        (if (<= count length) (take bits count) (append bits (make-list (- count length) #f)))))
    (define (bits->vector [i natural?] [count natural? (integer-length i)]) (list->vector (bits->list i count)))
    (define (list->bits [booleans (list-of boolean?)])
      (if (null? booleans) 0 (string->number (list->string (reverse (map (lambda (b) (if b #\1 #\0)) booleans))) 2)))
    (define (vector->bits [booleans vector?]) (list->bits (vector->list booleans)))
    (define (bits . booleans) (list->bits booleans))

    (define (bitwise-fold [f procedure?] seed [i exact-integer?]) (fold f seed (significant-bits i)))
    (define (bitwise-for-each [f procedure?] [i exact-integer?]) (for-each f (significant-bits i)))
    (define (bitwise-unfold [stop? procedure?] [mapper procedure?] [successor procedure?] seed)
      (let loop ((state seed) (bits '()))
        (if (stop? state)
            (list->bits (reverse bits))
            (loop (successor state) (cons (and (mapper state) #t) bits)))))
    ; Returns a procedure that returns another bit at each call, without end.
    (define (make-bitwise-generator [i exact-integer?] [start natural? 0])
      (lambda ()
        (let ((bit (bit-set? start i)))
          (set! start (+ start 1))
          bit)))))
