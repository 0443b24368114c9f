; Listing 2.1 of the VisualScheme thesis: Doric columns, there in AutoLISP.
;
; Transcribed: defun is define, with the name and its parameters in one pair of parentheses; cut-cone and box2, which the thesis built from AutoCAD's
; commands, are make-cut-cone and make-box. Nothing else is changed.

(define (cut-cone p base-r top-r height)      ; the thesis' own, there by (command "_.cone" ...)
  (make-cut-cone p base-r (+z p height) top-r))

(define (box2 p q)                            ; likewise
  (make-box p q))

; (a) AutoLISP definitions

(define (shaft p height base-r top-r)
  (cut-cone p base-r top-r height))

(define (capital p height base-r top-r)
  (cut-cone p base-r top-r height))

(define (abacus p height length)
  (box2 (+xyz p (/ length -2.0) (/ length -2.0) 0)
        (+xyz p (/ length 2.0) (/ length 2.0) height)))

(define (doric-column p
                      shaft-h shaft-base-r
                      capital-h capital-base-r
                      abacus-h abacus-l)
  (draw (shaft p shaft-h shaft-base-r capital-base-r)                         ; AutoLISP draws what it makes,
        (capital (+z p shaft-h) capital-h capital-base-r (/ abacus-l 2.0))    ; here draw does
        (abacus (+z p (+ shaft-h capital-h)) abacus-h abacus-l)))

; (b) AutoLISP main program

(erase-all)

(doric-column (xyz 0 0 0) 9 0.5 0.4 0.3 0.3 1.0)
(doric-column (xyz 3 0 0) 7 0.5 0.4 0.6 0.6 1.6)
(doric-column (xyz 6 0 0) 9 0.7 0.5 0.3 0.2 1.2)
(doric-column (xyz 9 0 0) 8 0.4 0.3 0.2 0.3 1.0)
(doric-column (xyz 12 0 0) 5 0.5 0.4 0.3 0.1 1.0)
(doric-column (xyz 15 0 0) 6 0.8 0.3 0.2 0.4 1.4)

(zoom-extents)
