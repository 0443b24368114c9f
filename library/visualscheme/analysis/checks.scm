; The check of members by EN 1993-1-1, for round, hollow and rectangular sections of steel: stresses by 6.2.1(7), shear by 6.2.6, flexural buckling by 6.3.1, bending and compression by 6.3.3 with the elastic
; factors of table B.1. The factors for equal moments, Cm, are 1, which is safe for all others.

(define imperfection-a 0.21) ; table 6.1: curve a, for hot-finished hollow sections, and curve c, for all others here
(define imperfection-c 0.49)

; Returns the reduction of 6.3.1.2 for a slenderness.
(define (buckling-reduction alpha slenderness)
  (if (<= slenderness 0.2) 1
      (let ((phi (* 1/2 (+ 1 (* alpha (- slenderness 0.2)) (square slenderness)))))
        (min 1 (/ 1 (+ phi (sqrt (- (square phi) (square slenderness)))))))))

; Returns the shear area along z; that along y is the one of the turned section.
(define (shear-area s upright)
  (let ((a (section-area s)) (b (if upright (section-width s) (section-height s))) (h (if upright (section-height s) (section-width s))))
    (case (section-kind s)
      ((tube) (/ (* 2 a) pi))
      ((box) (/ (* a h) (+ b h)))
      (else a))))

; Returns the greatest sizes of the six forces along a member, with the axial force's sign: the compression if there is any.
(define (extreme-forces r i case)
  (let ((all (map (lambda (k) (forces-at r i (/ k 8) case)) (iota 9))))
    (cons (let ((n (map first all))) (if (< (apply min n) 0) (cons (apply min n) (apply max n)) (cons 0 (apply max n))))
      (map (lambda (k) (apply max (map (lambda (f) (abs (list-ref f k))) all))) '(1 2 3 4 5)))))

; Returns the share of each strength that a member's forces take, the greatest counts.
(define (member-shares b f alpha lengths factor)
  (let* ((s (bar-section b)) (m (bar-material b)) (fy (/ (strength-of m) factor)) (a (section-area s)) (compression (- (car (first f)))) (tension (cdr (first f)))
         (my (fifth f)) (mz (sixth f)) (npl (* a fy))
         (bends (> (section-iy s) 0))
         (round? (memq (section-kind s) '(round tube)))
         (ry (if bends (/ my (* fy (section-wy s))) 0)) (rz (if bends (/ mz (* fy (section-wz s))) 0))
         (bending (if round? (sqrt (+ (square ry) (square rz))) (+ ry rz)))
         (shear (lambda (v area) (/ (* v (sqrt 3)) (* area fy)))))
    (apply max (+ (/ (max tension compression) npl) bending)
      (shear (second f) (shear-area s #f)) (shear (third f) (shear-area s #t))
      (if (and bends (> compression 0))
          (let* ((slender (lambda (i length) (/ (* length (sqrt (/ (* a (strength-of m)) (* (modulus-of m) i)))) pi)))
                 (ly (slender (section-iy s) (car lengths))) (lz (slender (section-iz s) (cdr lengths)))
                 (ny (/ compression (* (buckling-reduction alpha ly) npl))) (nz (/ compression (* (buckling-reduction alpha lz) npl)))
                 (ky (+ 1 (* 0.6 (min 1 ly) ny))) (kz (+ 1 (* 0.6 (min 1 lz) nz))))
            (list (+ ny (* ky ry) (* kz rz)) (+ nz (* 0.8 ky ry) (* kz rz))))
          '()))))

(define (need-checkable b i)
  (let ((s (bar-section b)) (m (bar-material b)))
    (if (eq? (material-kind m) 'c25/30) (error 'utilisation "member ~a is of c25/30, and the checks are those of steel and timber (EN 1993-1-1, EN 1995-1-1)" i))
    (if (and (assq (material-kind m) timbers) (not (memq (section-kind s) '(rectangle round))))
        (error 'utilisation "member ~a is of timber, and its section is a ~a: the check is that of rectangles and circles" i (section-kind s)))
    (if (not (strength-of m)) (error 'utilisation "member ~a is of a material without a #:strength" i))
    (if (and (> (section-iy s) 0) (not (and (section-wy s) (section-wz s)))) (error 'utilisation "the section of member ~a has no #:wy and #:wz" i))))

; Warns of sections of class 4 (table 5.2), whose walls buckle before they yield.
(define (check-wall b)
  (let* ((s (bar-section b)) (e2 (/ 235e6 (strength-of (bar-material b)))) (t (section-wall s)))
    (cond
      ((not t))
      ((and (eq? (section-kind s) 'tube) (> (/ (section-width s) t) (* 90 e2)))
       (warn (format "utilisation: the wall of a tube ~a x ~a may buckle: d/t is above ~a (class 4)" (section-width s) t (* 90 e2))))
      ((and (eq? (section-kind s) 'box) (> (/ (- (max (section-width s) (section-height s)) (* 3 t)) t) (* 42 (sqrt e2))))
       (warn (format "utilisation: the wall of a box ~a x ~a x ~a may buckle (class 4)" (section-width s) (section-height s) t))))))

(define (utilisation r i #:case [case any? #f] #:buckling-length [long any? 1] #:forming [forming any? 'cold] #:partial-factor [factor any? #f]
                     #:duration [duration any? 'medium] #:service-class [service any? 1])
  (need-result 'utilisation r)
  (let ((chosen (if (or case (null? (cdr (result-cases r)))) (list (case-index 'utilisation r case)) (iota (length (result-cases r))))))
    (member-index 'utilisation r i (list-ref (result-cases r) (car chosen)) 12)
    (if (not (or (positive-number? long) (and (list? long) (= (length long) 2) (every positive-number? long))))
        (error 'utilisation "buckling-length must be a part of the length, or two, about y and z, got ~s" long))
    (if (not (memq forming '(cold hot))) (error 'utilisation "forming must be 'cold or 'hot, got ~s" forming))
    (if factor (need-positive 'utilisation 'partial-factor factor))
    (let* ((b (vector-ref (bars-at (result-frame r)) (- i 1))) (parts (if (list? long) long (list long long)))
           (lengths (cons (* (first parts) (bar-length b)) (* (second parts) (bar-length b))))
           (modification (timber-factor duration service)) (timber (assq (material-kind (bar-material b)) timbers))
           (alpha (if (and (eq? forming 'hot) (memq (section-kind (bar-section b)) '(tube box))) imperfection-a imperfection-c)))
      (need-checkable b i)
      (if (not timber) (check-wall b))
      (let ((forces (map (lambda (c) (extreme-forces r i c)) chosen)))
        (if (and (= 0 (section-iy (bar-section b))) (any (lambda (f) (< (car (first f)) -1e-9)) forces))
            (warn "utilisation: a bar is pressed, and its section is an area alone: buckling is not checked"))
        (apply max (map (lambda (f) (if timber (timber-shares b f lengths (bar-length b) modification factor) (member-shares b f alpha lengths (or factor 1)))) forces))))))
