; Modes of frames: how a frame buckles under the axial forces of a case, and how it vibrates.

; value: factor of the loads, or frequency in Hz; shape: procedure that returns the frame, the number of segments of a member,
; and a vector of three numbers for each end of a segment
(define-record-type mode (make-mode value shape) mode? (value mode-value) (shape mode-shape))

(define (modes-of f parts found)
  (let* ((each (* 3 (+ parts 1) (member-count f))) (shapes (second found)))
    (map (lambda (v k)
           (let ((all (list f parts (vector-copy shapes (* k each) (* (+ k 1) each))))) (make-mode v (lambda () all))))
         (vector->list (first found)) (iota (vector-length (first found))))))

(define (need-modes who f modes segments)
  (if (pair? (plates-in f)) (error who "the frame has shells: modes are those of members"))
  (if (not (and (exact-integer? modes) (<= 1 modes 1000))) (error who "modes must be an exact integer from 1 to 1000, got ~s" modes))
  (if (not (and (exact-integer? segments) (<= 1 segments 64))) (error who "segments must be an exact integer from 1 to 64, got ~s" segments)))

(define (buckling-modes r #:case [case any? #f] #:modes [modes any? 1] #:segments [segments any? 8])
  (need-result 'buckling-modes r)
  (need-modes 'buckling-modes (result-frame r) modes segments)
  (let* ((f (result-frame r)) (m (member-count f)) (c (case-index 'buckling-modes r case)) (axial (make-vector (* 2 m) 0)))
    (do ((i 0 (+ i 1))) ((= i m))
      (let ((at (* 12 (+ (* c m) i))))
        (vector-set! axial (* 2 i) (- (vector-ref (result-ends r) at)))
        (vector-set! axial (+ 1 (* 2 i)) (vector-ref (result-ends r) (+ at 6)))))
    (if (every (lambda (n) (>= n 0)) (vector->list axial)) '()
        (modes-of f segments (core:buckling-modes (nodes-of f) (member-numbers (bars-in f)) (held-of f) axial #() segments modes)))))

(define (vibration-modes f #:masses [masses any? '()] #:modes [modes any? 1] #:segments [segments any? 8])
  (need-frame 'vibration-modes f)
  (need-modes 'vibration-modes f modes segments)
  (let* ((m (member-count f)) (all (make-vector (+ m (node-count f)) 0)))
    (for-each (lambda (b i) (vector-set! all i (* (section-area (bar-section b)) (bar-length b) (density-of (bar-material b))))) (bars-in f) (iota m))
    (if (not (and (list? masses) (every (lambda (x) (and (list? x) (= (length x) 2) (real? (second x)) (finite? (second x)) (>= (second x) 0))) masses)))
        (error 'vibration-modes "masses must be lists of a node and kilograms, got ~s" masses))
    (for-each (lambda (x)
                (need-node 'vibration-modes 'masses (first x) (node-count f))
                (let ((k (+ m (first x) -1))) (vector-set! all k (+ (second x) (vector-ref all k)))))
      masses)
    (if (every (lambda (x) (= x 0)) (vector->list all)) (error 'vibration-modes "the frame has no mass: its materials have no #:density"))
    (modes-of f segments (core:vibration-modes (nodes-of f) (member-numbers (bars-in f)) (held-of f) #() all segments modes))))

; Returns the members in the shape of a mode, whose greatest movement is `size`.
(define (mode-curves m #:size [size any? #f])
  (if (not (mode? m)) (error 'mode-curves "m must be a mode, got ~s" m))
  (if size (need-number 'mode-curves 'size size))
  (let* ((parts ((mode-shape m))) (f (first parts)) (n (second parts)) (shape (third parts)) (nodes (nodes-at f))
         (big (or size (* 1/10 (apply max (map bar-length (bars-in f)))))))
    (map (lambda (b i)
           (let* ((ends (bar-ends b nodes)) (p (first ends)) (q (second ends)))
             (curve-of (map (lambda (k) (p+v (intermediate-point p q (/ k n)) (v*r (three shape (* 3 (+ k (* i (+ n 1))))) big))) (iota (+ n 1))))))
      (bars-in f) (iota (member-count f)))))
