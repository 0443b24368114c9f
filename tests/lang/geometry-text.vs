; Text: letters as regions of exact size, set by the font's own widths and kerning.
(define (say . all) (for-each display all) (newline))
(define (corner o k) ((if (= k 0) car cadr) (bounding-box o)))
(define H (make-text (xy 0 0) 1 "H"))

; size is the height of a capital
(say (cy (corner H 0)) " " (cy (corner H 1))) ; expect: 0.0 1.0
(say (cy (corner (make-text (xy 0 0) 2.5 "H") 1)) " " (cz (corner (make-text (xyz 0 0 7) 1 "H") 1))) ; expect: 2.5 7.0
(say (region? H) (curve? H) (primitive? H) (object-kind H)) ; expect: #t#f#ttext

; the H of DejaVu Sans: two stems and a bar, in units of 1493 a capital
(define (units n) (/ n 1493.0))
(say (near? (area H) (+ (* 2 (units 202) 1) (* (units (- 1339 201 202 202)) (units 170))) 1e-2)) ; expect: #t

; an o is a ring: its area is that of what bounds it
(say (< 0.1 (area (make-text (xy 0 0) 1 "o")) 0.5)) ; expect: #t
(say (near? (area (make-text (xy 0 0) 2 "o")) (* 4 (area (make-text (xy 0 0) 1 "o"))) 1e-6)) ; expect: #t

; twice the text is twice the ink, widths add but for kerning
(say (near? (area (make-text (xy 0 0) 1 "oo")) (* 2 (area (make-text (xy 0 0) 1 "o"))) 1e-6)) ; expect: #t
(say (near? (text-width 1 "oooo") (* 4 (text-width 1 "o")))) ; expect: #t
(say (near? (text-width 3 "Paulo") (* 3 (text-width 1 "Paulo")))) ; expect: #t
(say (< (text-width 1 "AV") (+ (text-width 1 "A") (text-width 1 "V")))) ; expect: #t
(say (near? (text-width 1 "oo" #:spacing 2) (* 2 (text-width 1 "oo")))) ; expect: #t
(say (near? (text-width 1 "a\tb") (+ (text-width 1 "a") (text-width 1 "    ") (text-width 1 "b")))) ; expect: #t

; lines
(define two (make-text (xy 0 0) 1 "H\nH"))
(say (near? (area two) (* 2 (area H))) (< (cy (corner two 0)) -1) (= (cy (corner two 1)) 1)) ; expect: #t#t#t
(say (near? (text-width 1 "ab\nabcd\nc") (text-width 1 "abcd"))) ; expect: #t

; where p is
(define (mid-x o) (cx (mid (corner o 0) (corner o 1))))
(say (near? (mid-x (make-text (xy 5 0) 1 "H" #:align 'center)) 5 1e-9)) ; expect: #t
(say (near? (mid-x (make-text (xy 5 0) 1 "H\nH" #:align 'centre)) 5 1e-9)) ; expect: #t
(say (near? (+ (mid-x (make-text (xy 0 0) 1 "H")) (mid-x (make-text (xy 0 0) 1 "H" #:align 'right))) 0 1e-9)) ; expect: #t
(say (cy (corner (make-text (xy 0 0) 1 "H" #:valign 'top) 1))) ; expect: 0.0
(say (cy (corner (make-text (xy 0 0) 1 "H" #:valign 'center) 1))) ; expect: 0.5
(say (< 0 (cy (corner (make-text (xy 0 0) 1 "p" #:valign 'bottom) 0)) 0.1)) ; expect: #t

; accents: one character, or a letter and its mark
(say (near? (area (make-text (xy 0 0) 1 "\xE3;")) (area (make-text (xy 0 0) 1 "a\x303;")))) ; expect: #t
(say (< (area (make-text (xy 0 0) 1 "a")) (area (make-text (xy 0 0) 1 "\xE3;")))) ; expect: #t
(say (region? (make-text (xy 0 0) 1 "São Paulo — Αθήνα Привет"))) ; expect: #t

; letters that overlap are one area: what both cover counts once
(define close (make-text (xy 0 0) 1 "oooo" #:spacing 0.7))
(say (< (* 2 (area (make-text (xy 0 0) 1 "o"))) (area close) (* 4 (area (make-text (xy 0 0) 1 "o"))))) ; expect: #t
(say (near? (area (make-text (xy 0 0) 1 "HH" #:spacing 1e-9)) (area H) 1e-6)) ; expect: #t
(say (near? (volume (do-extrude close 2)) (* 2 (area close)) 1e-2)) ; expect: #t

; solids of it
(define solid (do-extrude (make-text (xy 0 0) 1 "o8B") 2))
(say (near? (volume solid) (* 2 (area (make-text (xy 0 0) 1 "o8B"))) 1e-2)) ; expect: #t
(say (contains? (do-extrude H 1) (xyz 0.2 0.5 0.5)) (contains? (do-extrude H 1) (xyz 0.5 0.1 0.5))) ; expect: #t#f
(say (near? (area (do-rotate H 'x 1)) (area H) 1e-9) (near? (area (do-mirror H 'yz)) (area H) 1e-9)) ; expect: #t#t

; values
(say (equal? H (make-text (xy 0 0) 1 "H")) (equal? H (make-text (xy 0 0) 1 "I"))) ; expect: #t#f
(say (make-text (xy 0 0) 1 "a \"b\"" #:align 'right)) ; expect: (make-text (xyz 0 0 0) 1 "a \"b\"" #:align 'right)
(say (list-tail (object-arguments H) 2)) ; expect: (H  left baseline 1.0)

; what is wrong
(define (fails thunk) (guard (e (#t (say (condition/report-string e)))) (thunk)))
(fails (lambda () (make-text (xy 0 0) -1 "a"))) ; expect: make-text: size must be positive, got -1
(fails (lambda () (make-text (xy 0 0) +inf.0 "a"))) ; expect: make-text: size must be finite, got +inf.0
(fails (lambda () (make-text 5 1 "a"))) ; expect: make-text: p must be a point, got 5
(fails (lambda () (make-text (xy 0 0) 1 'a))) ; expect: make-text: string must be a string ("a"?), got a
(fails (lambda () (make-text (xy 0 0) 1 "a" #:spacing 0))) ; expect: make-text: spacing must be positive, got 0
(fails (lambda () (make-text (xy 0 0) 1 "a" #:valign 'upper))) ; expect: make-text: valign must be one of 'baseline 'top 'center 'bottom, got upper
(fails (lambda () (make-text (xy 0 0) 1 "a" #:font "no-such.ttf"))) ; expect: make-text: cannot open tests/lang/no-such.ttf: no such file
(fails (lambda () (make-text (xy 0 0) 1 "a" #:font "geometry-text.vs.ttf"))) ; expect: make-text: cannot open tests/lang/geometry-text.vs.ttf: no such file
(fails (lambda () (make-text (xy 0 0) 1 "a" #:font "./geometry-text.vs"))) ; expect: make-text: "tests/lang/geometry-text.vs" is no font with outlines
(fails (lambda () (text-width -1 "a"))) ; expect: text-width: size must be positive, got -1
(say (empty-object? (make-text (xy 0 0) 0 "a"))) ; expect: #t
; expect warning 75: make-text: the size is 0
(say (empty-object? (make-text (xy 0 0) 1 " \n "))) ; expect: #t
; expect warning 77: make-text: the text has no letters
(say (region? (make-text (xy 0 0) 1 "漢"))) ; expect: #t
; expect warning 79: make-text: the font has no letter 漢 (U+6F22)
