; Changes a file at random places, and reads the result: cuts, doubles, swaps, and other characters and numbers.
(define-parameter count 60 #:min 1 #:max 100000)
(define state 20)
(define (random-below n) (set! state (modulo (+ (* state 1103515245) 12345) 2147483648)) (modulo (quotient state 1024) n))
(define (part s a b) (substring s (min a (string-length s)) (min b (string-length s))))
(define pieces '("9" "-" "1e300" "-1" "0" "x" "\"" "<" ">" "&" "\n" "EOF" "SECTION" "ENDSEC" "99999999" "é" "/>" "</svg:g>" "A" "," "#" "0\nINSERT\n2\nTABLE\n"))
(define (changed s)
  (let* ((n (string-length s)) (a (random-below n)) (b (+ a 1 (random-below 40))))
    (case (random-below 6)
      [(0) (string-append (part s 0 a) (part s b n))]
      [(1) (string-append (part s 0 b) (part s a n))]
      [(2) (part s 0 a)]
      [(3) (let ([c (random-below n)]) (string-append (part s 0 a) (part s c (+ c (random-below 200))) (part s b n)))]
      [else (string-append (part s 0 a) (list-ref pieces (random-below (length pieces))) (part s (+ a (random-below 3)) n))])))
(define (several s) (if (= 0 (random-below 3)) (changed (changed s)) (changed s)))
(define (right? text name)
  (and (string-prefix? text "load-outline: ")
       (string-contains? text (string-append name ":"))
       (not (string-contains? text "\n"))))
(define (try ending)
  (let ([whole (file->string (string-append "whole." ending))] [name (string-append "broken." ending)] [read 0] [refused 0])
    (for ([i count])
      (call-with-output-file name (lambda (port) (write-string (several whole) port)))
      (let ([why (guard (e [#t (condition/report-string e)]) (load-outline name) #f)])
        (cond [(not why) (set! read (+ read 1))]
              [(right? why name) (set! refused (+ refused 1))]
              [else (displayln (list ending i why))])))
    (displayln (list ending (= count (+ read refused)) (and (> read 0) (> refused 0))))))
(try "dxf")
(try "svg")
