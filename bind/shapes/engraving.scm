; Letters of single lines, for engraving and plotting. After probes.scm. Names that begin with % are hidden from
; programs. Compiled into the binary when it is built.
;
; A row is a character, its width and its strokes. A stroke is a run of points, each of two hexadecimal digits, x and y.
; The baseline is y = 4; capitals are 8 high, small letters 5.

(define %stroke-rows
  '((#\space 4 "") (#\! 0 "0506 080c") (#\" 2 "0a0c 2a2c") (#\# 8 "242c 646c 0787 0989")
    (#\% 8 "048c 0c2c2a0a0c 6484866664") (#\& 8 "842a2b3c4b4a07051424466477") (#\' 0 "0a0c") (#\( 2 "2d0b0522")
    (#\) 2 "0d2b2502") (#\* 6 "353b 0669 0966") (#\+ 6 "353b 0868") (#\, 1 "1503") (#\- 4 "0848") (#\. 0 "0405")
    (#\/ 6 "046c") (#\0 6 "2c0a062444666a4c2c") (#\1 2 "0a2c24") (#\2 6 "0a2c4c6a690464")
    (#\3 6 "0a2c4c6a694828 486766442406") (#\4 6 "544c0666") (#\5 6 "6c0c08486766442406")
    (#\6 6 "4c2c0a0624446667482807") (#\7 6 "0c6c24") (#\8 6 "2848696a4c2c0a0928 2807062444666748")
    (#\9 6 "2444666a4c2c0a09284869") (#\: 0 "0506 090a") (#\; 1 "1503 191a") (#\< 5 "5b0855") (#\= 5 "0757 0a5a")
    (#\> 5 "0b5805") (#\? 6 "0a2c4c6a693736 3435") (#\[ 2 "2d0d0222") (#\] 2 "0d2d2202") (#\_ 6 "0363")
    (#\° 2 "0b1c2b1a0b") (#\× 5 "0a55 055a") (#\A 8 "044c84 1676") (#\B 8 "040c6c8a896808 6887866404")
    (#\C 8 "8a6c2c0a06246486") (#\D 8 "040c5c89875404") (#\E 7 "7c0c0474 0868") (#\F 7 "7c0c04 0868")
    (#\G 8 "8a6c2c0a062464886848") (#\H 8 "040c 848c 0888") (#\I 0 "040c") (#\J 6 "6c66442406") (#\K 8 "040c 8c0884")
    (#\L 7 "0c0474") (#\M 8 "040c488c84") (#\N 8 "040c848c") (#\O 8 "2c0a062464868a6c2c") (#\P 8 "040c6c8a896808")
    (#\Q 8 "2c0a062464868a6c2c 5784") (#\R 8 "040c6c8a896808 4884") (#\S 8 "8a6c2c0a0928688786642406")
    (#\T 8 "4c44 0c8c") (#\U 8 "0c062464868c") (#\V 8 "0c448c") (#\W 8 "0c2448648c") (#\X 8 "048c 0c84")
    (#\Y 8 "0c488c 4844") (#\Z 8 "0c8c0484") (#\a 6 "6964 6749290706244466") (#\b 6 "0c04 0729496766442406")
    (#\c 6 "6749290706244466") (#\d 6 "6c64 6749290706244466") (#\e 6 "06666749290706244465") (#\f 4 "4c2c1b14 0939")
    (#\g 6 "6963412102 6749290706244466") (#\h 6 "0c04 0729496764") (#\i 0 "0904 0b0c") (#\j 2 "29221101 2b2c")
    (#\k 5 "0c04 590654") (#\l 1 "0c0514") (#\m 8 "0904 0719394744 4759798784") (#\n 6 "0904 0729496764")
    (#\o 6 "290706244466674929") (#\p 6 "0901 0729496766442406") (#\q 6 "6961 6749290706244466")
    (#\r 4 "0904 07193948") (#\s 5 "58491908174655441405") (#\t 4 "1c152434 0939") (#\u 6 "0906244466 6964")
    (#\v 6 "093469") (#\w 8 "0924476489") (#\x 5 "0954 0459") (#\y 6 "0934 6911") (#\z 5 "09590454")))

; Returns the points of a stroke, as pairs of numbers from the baseline on.
(define (%stroke-points text)
  (define (digit i) (string->number (substring text i (+ i 1)) 16))
  (map (lambda (i) (cons (digit (* 2 i)) (- (digit (+ (* 2 i) 1)) 4))) (iota (quotient (string-length text) 2))))

(define %stroke-table
  (let ((table (make-hash)))
    (for-each (lambda (row)
                (hash-set! table (first row)
                  (cons (second row) (map %stroke-points (remove (lambda (s) (string=? s "")) (string-split (third row) " "))))))
              %stroke-rows)
    table))
(define (%stroke-glyph c)
  (or (hash-ref %stroke-table c #f)
      (error 'engrave "text has the character ~s, for which the stroke font has no letter; make-text has all letters of a font" c)))

(define (%stroke-width text)
  (let ((n (string-length text)))
    (if (= n 0) 0 (+ (* 3 (- n 1)) (apply + (map (lambda (c) (car (%stroke-glyph c))) (string->list text)))))))

; Returns true if the text is a number that is another one upside down, such as 6, 68 and 99, but not 69.
(define (%turns-over? text)
  (define pairs '((#\0 . #\0) (#\1 . #\1) (#\6 . #\9) (#\8 . #\8) (#\9 . #\6)))
  (let* ((digits (string->list text)) (turned (map (lambda (c) (assv c pairs)) (reverse digits))))
    (and (every values turned) (or (memv #\6 digits) (memv #\9 digits)) (not (equal? digits (map cdr turned))))))

; Returns the strokes of the text as polylines, `size` high. at: the lower left corner, middle or right, by align; the
; text runs at `angle`. A number that is another one upside down gets a line below, unless `underline` is #f.
(define (engrave text size #:at [at any? origin] #:angle [angle any? 0] #:align [align any? 'left] #:underline [underline any? #t])
  (if (not (string? text)) (error 'engrave "text must be a string, got ~s" text))
  (%need-positive 'engrave 'size size)
  (%need-point 'engrave 'at at)
  (%need-number 'engrave 'angle angle)
  (if (not (memq align '(left centre right))) (error 'engrave "align must be one of 'left 'centre 'right, got ~s" align))
  (let* ((k (/ size 8)) (c (cos angle)) (s (sin angle))
         (width (%stroke-width text))
         (start (* -1 width (case align ((left) 0) ((centre) 1/2) (else 1)))))
    (define (place x y) (let ((x (* k x)) (y (* k y))) (+xy at (- (* c x) (* s y)) (+ (* s x) (* c y)))))
    (unite
      (let loop ((l (string->list text)) (x start) (lines '()))
        (if (null? l)
            (reverse (if (and underline (%turns-over? text)) (cons (make-line (place start -2) (place (+ start width) -2)) lines) lines))
            (let ((glyph (%stroke-glyph (car l))))
              (loop (cdr l) (+ x (car glyph) 3)
                (append (map (lambda (stroke) (make-line (map (lambda (p) (place (+ x (car p)) (cdr p))) stroke))) (reverse (cdr glyph)))
                        lines))))))))
