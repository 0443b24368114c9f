; The trees of a survey, as a JSON file brings them: data/trees.json. Objects of the file are association lists here, its arrays vectors, and data-ref
; asks for what lies within: (data-ref survey 'trees 0 'height) is the height of the first tree.

(define survey (load-json "data/trees.json"))
(define trees (vector->list (data-ref survey 'trees)))

(define (kind-of tree) (data-ref survey 'species (data-ref tree 'species)))

; where the survey left the height out, the kind's usual one
(define (height-of tree)
  (let ([h (data-ref tree 'height)])
    (if (eq? h 'null) (data-ref (kind-of tree) "usual height") h)))

; not every tree has every entry
(define (felled? tree) (cond [(assq 'felled tree) => cdr] [else #f]))

(define (foot tree)
  (let ([at (data-ref tree 'at)])
    (xyz (vector-ref at 0) (vector-ref at 1) (vector-ref at 2))))

(define (trunk tree h) (color "#6b5443" (make-cut-cone (+z (foot tree) -1) (data-ref tree 'trunk) (+z (foot tree) h) (* 0.5 (data-ref tree 'trunk)))))

; A fir has tiers that become shorter; other trees have clumps of leaves round about, each turned on from the last one by the golden angle, in the
; room of an egg.
(define (crown tree)
  (let ([p (foot tree)] [h (height-of tree)] [r (/ (data-ref tree 'crown) 2)] [kind (kind-of tree)])
    (define (tier i)
      (let ([z (* h (+ 0.14 (* 0.11 i)))])
        (make-cone (+z p z) (+z p (+ z (* h 0.2))) (* r (- 1 (* 0.13 i))))))
    (define (clump i)
      (let* ([up (- (/ (+ i 0.5) 9) 1)] [out (sqrt (- 1 (* up up)))] [angle (+ (cx p) (* 2.39996 i))]
             [q (+xyz p (* 0.6 r out (cos angle)) (* 0.6 r out (sin angle)) (* h (+ 0.65 (* 0.23 up))))])
        (do-scale (make-sphere q (* 0.46 r)) q (list 1 1 (max 0.8 (/ (* 0.15 h) (* 0.46 r)))))))
    (with-material (make-material #:name (data-ref tree 'species) #:color (data-ref kind 'colour) #:roughness 1)
      (if (equal? (data-ref kind 'form) "cone") (for/list ([i 7]) (tier i)) (for/list ([i 18]) (clump i))))))

(define (tree-object tree)
  (if (felled? tree)
      (trunk tree 0.4)
      (unite (trunk tree (* 0.6 (height-of tree))) (crown tree))))

; the ground is lower and higher where the survey says so; a house to see the size of all this
(define ground-rows
  (for/list ([j 25]) (for/list ([i 31]) (let ([x (* 2 (- i 15))] [y (* 2 (- j 12))]) (+ (* 0.4 (sin (/ x 9))) (* 0.3 (cos (/ y 7))))))))

(draw (with-material 'grass (make-height-field ground-rows (xyz -30 -24 0) (xyz 30 24 0) #:low -2)))
(draw (map tree-object trees))
(draw (with-material plaster (make-box (xyz -7 -5 -1) (xyz 7 5 4)))
      (color "#a4553f" (make-irregular-pyramid (list (xyz -7.4 -5.4 4) (xyz 7.4 -5.4 4) (xyz 7.4 5.4 4) (xyz -7.4 5.4 4)) (xyz 0 0 7.2))))

(printf "~a trees of ~a, surveyed on ~a~%" (length trees) (data-ref survey 'survey 'site) (data-ref survey 'survey 'date))
(for ([kind (map car (data-ref survey 'species))])
  (let ([of-kind (filter (lambda (tree) (equal? (data-ref tree 'species) (symbol->string kind))) trees)])
    (printf "  ~8a ~3d, ~,1f m high on average~%" kind (length of-kind)
      (/ (apply + (map height-of of-kind)) (length of-kind)))))

(ground -1.1 #:material 'grass)
(sun #:azimuth 245 #:altitude 38)
(camera (xyz -27 -38 9) (xyz 0 0 3.6) #:lens 32)
