; The check of timber members by EN 1995-1-1: tension and compression (6.1.2, 6.1.4), bending (6.1.6), shear (6.1.7), both
; together (6.2.3, 6.2.4), columns (6.3.2), and beams that turn over (6.3.3). Factors for small sizes (3.2, 3.3) are 1, which is safe.

; Characteristic strengths in Pa of bending, tension, compression and shear along the grain, the fifth percentile of the modulus,
; the partial factor of table 2.3, and the straightness factor of 6.3.2: EN 338 and EN 14080.
(define timbers
  '((c16 16e6 8.5e6 17e6 3.2e6 5.4e9 1.3 0.2) (c24 24e6 14.5e6 21e6 4e6 7.4e9 1.3 0.2) (c30 30e6 19e6 24e6 4e6 8e9 1.3 0.2)
    (gl24h 24e6 19.2e6 24e6 3.5e6 9.6e9 1.25 0.1) (gl28h 28e6 22.3e6 28e6 3.5e6 10.5e9 1.25 0.1) (gl32h 32e6 25.6e6 32e6 3.5e6 11.8e9 1.25 0.1)))

; Factors k-mod of table 3.1 for service classes 1 and 2, then for 3.
(define durations '((permanent 0.6 0.5) (long 0.7 0.55) (medium 0.8 0.65) (short 0.9 0.7) (instantaneous 1.1 0.9)))

(define (timber-factor duration service)
  (let ((row (or (assq duration durations) (error 'utilisation "duration must be one of ~s, got ~s" (map car durations) duration))))
    (if (not (memv service '(1 2 3))) (error 'utilisation "service-class must be 1, 2 or 3, got ~s" service))
    (if (= service 3) (third row) (second row))))

; Returns the factor k-c of 6.3.2 for a length, and a second moment and area of the section; 1 for stocky columns.
(define (column-factor t length inertia area)
  (let* ((slender (/ (* length (sqrt (/ area inertia))) pi)) (relative (* slender (sqrt (/ (fourth t) (sixth t))))))
    (if (<= relative 0.3) 1
        (let ((k (* 1/2 (+ 1 (* (eighth-of t) (- relative 0.3)) (square relative))))) (/ 1 (+ k (sqrt (- (square k) (square relative)))))))))
(define (eighth-of t) (list-ref t 7))

; Returns the factor k-crit of 6.3.3 for bending about y of a rectangle of softwood that is held at its ends.
(define (beam-factor t s length)
  (if (not (and (eq? (section-kind s) 'rectangle) (> (section-height s) (section-width s)))) 1
      (let ((relative (sqrt (/ (second t) (/ (* 0.78 (square (section-width s)) (sixth t)) (* (section-height s) length))))))
        (cond ((<= relative 0.75) 1) ((<= relative 1.4) (- 1.56 (* 0.75 relative))) (else (/ 1 (square relative)))))))

; Returns the share of its strength that the forces of a case take. f: as extreme-forces returns them; lengths: for buckling
; about y and z; whole: the length between places that hold the beam from turning over.
(define (timber-shares b f lengths whole modification factor)
  (let* ((s (bar-section b)) (t (assq (material-kind (bar-material b)) timbers)) (a (section-area s))
         (by (/ modification (or factor (seventh t)))) (fm (* by (second t))) (ft (* by (third t))) (fc (* by (fourth t))) (fv (* by (fifth t)))
         (tension (/ (cdr (car f)) a ft)) (compression (/ (- (car (car f))) a fc))
         (bends (> (section-iy s) 0)) (my (if bends (/ (fifth f) (section-wy s) fm) 0)) (mz (if bends (/ (sixth f) (section-wz s) fm) 0))
         (km (if (eq? (section-kind s) 'rectangle) 0.7 1)) (both (lambda (y z) (list (+ my y (* km mz)) (+ (* km my) z mz))))
         (stress (if (eq? (section-kind s) 'rectangle) 1.5 4/3)) (shear (/ (* stress (sqrt (+ (square (second f)) (square (third f))))) (* 0.67 a) fv)))
    (apply max shear
      (append
        (both tension tension)
        (if (not bends) (list compression)
            (let ((ky (column-factor t (car lengths) (section-iy s) a)) (kz (column-factor t (cdr lengths) (section-iz s) a)) (kcrit (beam-factor t s whole)))
              (append
                (if (and (= ky 1) (= kz 1)) (both (square compression) (square compression)) (both (/ compression ky) (/ compression kz)))
                (list (/ my kcrit) (if (> compression 0) (+ (square (/ my kcrit)) (/ compression kz)) 0)))))))))
