; The Sierpinski tetrahedron: four half as large, and so on.
(define-parameter depth 2 #:min 0 #:max 6)

(define (tetrahedron p q r apex)
  (make-irregular-pyramid (list p q r) apex))

(define (sierpinski p q r s n)
  (if (= n 0)
      (tetrahedron p q r s)
      (unite (sierpinski p (mid p q) (mid p r) (mid p s) (- n 1))
             (sierpinski (mid q p) q (mid q r) (mid q s) (- n 1))
             (sierpinski (mid r p) (mid r q) r (mid r s) (- n 1))
             (sierpinski (mid s p) (mid s q) (mid s r) s (- n 1)))))

(draw (sierpinski (xyz 0 0 0) (xyz 16 0 0) (xyz 8 14 0) (xyz 8 5 13) depth))
