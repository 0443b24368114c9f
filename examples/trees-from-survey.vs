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

; The crown of an oak, a birch or a plum is one surface over all directions: as far out as the farthest of 140 tufts of leaves reaches there.
; The tufts sit round about on a ball, each turned on from the last one by the golden angle.
(define tufts
  (for/list ([i 140])
    (let ([up (- (/ (+ i 0.5) 70) 1)])
      (cons (sph (+ 0.62 (* 0.14 (sin (* 7.1 i)))) (* i 2.39996) (acos up)) (+ 0.19 (* 0.06 (cos (* 5.3 i))))))))
(define (reach d tuft)                    ; in the direction d, out of the ball's middle
  (let* ([c (car tuft)] [r (cdr tuft)] [along (+ (* (cx c) (cx d)) (* (cy c) (cy d)) (* (cz c) (cz d)))]
         [rest (+ (* r r) (* along along) (- (+ (* (cx c) (cx c)) (* (cy c) (cy c)) (* (cz c) (cz c)))))])
    (if (> rest 0) (+ along (sqrt rest)) 0.5)))
(define crown
  (make-surface (lambda (u v) (let ([d (sph 1 u v)]) (sph (apply max (map (lambda (tuft) (reach d tuft)) tufts)) u v))) 0 2pi 0 pi #:nu 76 #:nv 48))

; A fir is one surface too, tier over tier: each hangs out over the one below it, and its edge is ragged.
(define fir-form
  (make-surface
    (lambda (u v)
      (let* ([t (* 11 v)] [tier (floor t)] [in (- t tier)] [edge (+ 1 (* 0.13 (sin (+ (* 9 u) (* 2.4 tier)))) (* 0.07 (sin (+ (* 17 u) tier))))])
        (cyl (if (> v 0.995) 0 (* v (+ 0.5 (* 0.5 in)) (+ 1 (* in (- edge 1))))) u (- 1 (* 0.9 v) (* 0.04 in)))))
    0 2pi 0 1 #:nu 54 #:nv 88))

(define (looks tree)
  (make-material #:name (data-ref tree 'species) #:color (data-ref (kind-of tree) 'colour) #:roughness 1 #:pattern 'mottled #:pattern-size 0.09))
(define (trunk tree h) (color "#5f5044" (make-cut-cone (xyz 0 0 -1) (data-ref tree 'trunk) (xyz 0 0 h) (* 0.45 (data-ref tree 'trunk)))))
(define (fir tree)
  (let ([h (height-of tree)] [r (/ (data-ref tree 'crown) 2)])
    (unite (trunk tree (* 0.4 h)) (with-material (looks tree) (do-scale fir-form origin (list (* 1.25 r) (* 1.25 r) h))))))
(define (broad-leaved tree)
  (let ([h (height-of tree)] [r (/ (data-ref tree 'crown) 2)])
    (unite (trunk tree (* 0.6 h))
           (with-material (looks tree) (do-move (do-scale crown origin (list (* 1.1 r) (* 1.1 r) (* 0.37 h))) (vxyz 0 0 (* 0.64 h)))))))

(define (tree-object tree)
  (do-move (do-rotate (cond [(felled? tree) (trunk tree 0.4)]
                            [(equal? (data-ref (kind-of tree) 'form) "cone") (fir tree)]
                            [else (broad-leaved tree)])
                      'z (* 0.14 (data-ref tree 'id)))
           (p->q origin (foot tree))))

; the ground is lower and higher where the survey says so; a house to see the size of all this
(define ground-rows
  (for/list ([j 25])
    (for/list ([i 31])
      (let* ([x (* 2 (- i 15))] [y (* 2 (- j 12))] [bank (expt (max (abs (/ x 30)) (abs (/ y 24))) 8)])   ; to the level round about
        (+ (* (- 1 bank) (+ (* 0.4 (sin (/ x 9))) (* 0.3 (cos (/ y 7))))) (* bank -1.09))))))

(draw (with-material 'grass (make-height-field ground-rows (xyz -30 -24 0) (xyz 30 24 0) #:low -2)))
(draw (map tree-object trees))
(draw (with-material plaster (make-box (xyz -7 -5 -1) (xyz 7 5 4)))
      (color "#84503f" (make-irregular-pyramid (list (xyz -7.4 -5.4 4) (xyz 7.4 -5.4 4) (xyz 7.4 5.4 4) (xyz -7.4 5.4 4)) (xyz 0 0 7.2))))

; people in the garden
(draw (map (lambda (x y turn coat)
             (do-move (do-rotate (prefab "person" #:coat coat #:stride 0.15) 'z (degrees->radians turn)) (vxyz x y (+ (* 0.4 (sin (/ x 9))) (* 0.3 (cos (/ y 7)))))))
           '(-9.5 -8.6 12) '(-9 -9.4 -14) '(30 60 -70) '("#5a6470" "#8c4a3a" "#b3a484")))

(printf "~a trees of ~a, surveyed on ~a~%" (length trees) (data-ref survey 'survey 'site) (data-ref survey 'survey 'date))
(for ([kind (map car (data-ref survey 'species))])
  (let ([of-kind (filter (lambda (tree) (equal? (data-ref tree 'species) (symbol->string kind))) trees)])
    (printf "  ~8a ~3d, ~,1f m high on average~%" kind (length of-kind)
      (/ (apply + (map height-of of-kind)) (length of-kind)))))

(ground -1.1 #:material 'grass)
(sun #:azimuth 245 #:altitude 38)
(camera (xyz -27 -38 9) (xyz 0 0 3.6) #:lens 32)
