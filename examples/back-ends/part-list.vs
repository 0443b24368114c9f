; A back-end: the parts of a drawing as a table. Load it, or name it before a model:
;
;   vs part-list.vs model.vs -o parts.csv
;
; What it teaches: a back-end is a procedure of the drawn objects and a port. This one goes through unions, placements and materials down to the
; parts, and counts equal ones: kind, material, how many, the volume of each.

; A part is a list: kind, material, volume.
(define (parts o outer)
  (let ([material (or (object-material o) outer)])
    (case (object-kind o)
      [(unite layer with-material) (append-map (lambda (child) (parts child material)) (object-children o))]
      [(transform)                          ; what is placed keeps its shape: only its volume may be another
       (let ([inside (parts (first (object-children o)) material)])
         (if (= (length inside) 1)
             (list (list (first (first inside)) (second (first inside)) (volume o)))
             inside))]
      [else (if (solid? o) (list (list (object-kind o) (if material (material-name material) "") (volume o))) '())])))

(define (rounded x) (/ (round (* 1000 x)) 1000))

(define (tally rows)
  (let ([counts (make-hash)])
    (for-each
     (lambda (row)
       (let ([key (list (first row) (second row) (rounded (third row)))])
         (hash-set! counts key (+ 1 (hash-ref counts key 0)))))
     rows)
    counts))

(define-back-end part-list "csv"
  (lambda (objects port)
    (let ([counts (tally (append-map (lambda (o) (parts o #f)) objects))])
      (display "kind,material,count,volume\n" port)
      (hash-for-each counts
        (lambda (key count)
          (fprintf port "~a,~a,~a,~a\n" (first key) (second key) count (third key))))))
  #:doc "the parts: kind, material, count, volume of each")
