; Lines of moments along members, and arrows of reactions.

; Returns for each member that bends the closed line of its moments: at each place it is as far from the member, on the side
; that the moment stretches, as the moment times the factor.
(define (moment-lines r #:factor [factor any? #f] #:case [case any? #f] #:about [about any? 'y])
  (need-result 'moment-lines r)
  (if factor (need-number 'moment-lines 'factor factor))
  (if (not (memq about '(y z))) (error 'moment-lines "about must be 'y or 'z, got ~s" about))
  (let* ((f (result-frame r)) (c (case-index 'moment-lines r case)) (at (nodes-at f)) (bars (bars-in f)) (parts (iota 17))
         (moment (lambda (i k) (list-ref (forces-at r i (/ k 16) c) (if (eq? about 'y) 4 5))))
         (all (map (lambda (b i) (map (lambda (k) (moment i k)) parts)) bars (iota (length bars) 1)))
         (greatest (apply max 0 (map abs (append-map values all)))) (longest (apply max 0 (map bar-length bars)))
         (scale (or factor (if (> greatest 0) (/ (* 1/4 longest) greatest) 0))))
    (filter-map
      (lambda (b moments)
        (and (any (lambda (m) (> (abs m) (* 1e-9 greatest))) moments)
             (let* ((ends (bar-ends b at)) (p (first ends)) (q (second ends)) (axes (member-axes p q (bar-roll b)))
                    (side (if (eq? about 'y) (v*r (third axes) -1) (v*r (second axes) -1))))
               (make-line (append (list p) (map (lambda (k m) (p+v (intermediate-point p q (/ k 16)) (v*r side (* m scale)))) parts moments) (list q p))))))
      bars all)))

; Returns arrows that end in the supports: forces as pipes with heads, each as long as its force times the factor.
(define (reaction-arrows r #:factor [factor any? #f] #:case [case any? #f])
  (need-result 'reaction-arrows r)
  (if factor (need-positive 'reaction-arrows 'factor factor))
  (let* ((f (result-frame r)) (c (case-index 'reaction-arrows r case)) (name (list-ref (result-cases r) c)) (nodes (nodes-of f))
         (forces (map (lambda (n) (reaction r n #:case name)) (iota (length nodes) 1))) (greatest (apply max (map vlength forces)))
         (low (bounding-box (hull nodes))) (size (if low (distance (first low) (second low)) 1)) (scale (or factor (if (> greatest 0) (/ (* 1/8 size) greatest) 0))))
    (filter-map
      (lambda (p v)
        (let ((long (* scale (vlength v))))
          (and (> (vlength v) (* 1e-9 greatest)) (> long 0)
               (let* ((d (unitize v)) (neck (p-v p (v*r d (* 0.3 long)))))
                 (unite (make-cylinder (p-v p (v*r d long)) neck (* 0.03 long)) (make-cone neck p (* 0.09 long)))))))
      nodes forces)))
