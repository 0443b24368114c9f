; Results of frame-solve: what moves, and the forces in the members, for each case.

; cases: names; numbers: procedure that returns the frame and three vectors, so that a printed result is short. moved,
; reactions: 6 numbers a node; ends: 12 numbers a member, forces and moments on its ends, on its own axes. Each vector has
; all this for one case after another.
(define-record-type frame-result (make-frame-result cases numbers) result? (cases result-cases) (numbers result-numbers))
(define (make-result frame cases moved ends reactions plates) (let ((all (list frame moved ends reactions plates))) (make-frame-result cases (lambda () all))))
(define (result-frame r) (first ((result-numbers r))))
(define (result-moved r) (second ((result-numbers r))))
(define (result-ends r) (third ((result-numbers r))))
(define (result-reactions r) (fourth ((result-numbers r))))
(define (result-plates r) (fifth ((result-numbers r)))) ; 6 numbers a shell

(define (need-result who r) (if (not (result? r)) (error who "r must be a result of frame-solve, got ~s" r)))

(define (case-names r) (need-result 'case-names r) (result-cases r))

; Returns the index of the case: of its name, or of the only one.
(define (case-index who r name)
  (let ((names (result-cases r)))
    (cond
      ((and (not name) (null? (cdr names))) 0)
      ((and name (list-index (lambda (n) (equal? n name)) names)))
      (else (error who "case must be one of ~s, got ~s" names name)))))

; Returns three numbers from index i on as a gvector.
(define (three v i) (vxyz (vector-ref v i) (vector-ref v (+ i 1)) (vector-ref v (+ i 2))))

(define (at-node who r node case numbers skip)
  (need-result who r)
  (let ((count (node-count (result-frame r))))
    (need-node who 'node node count)
    (three (numbers r) (+ (* 6 count (case-index who r case)) (* 6 (- node 1)) skip))))

(define (displacement r node #:case [case any? #f]) (at-node 'displacement r node case result-moved 0))
(define (rotation r node #:case [case any? #f]) (at-node 'rotation r node case result-moved 3))
(define (reaction r node #:case [case any? #f]) (at-node 'reaction r node case result-reactions 0))
(define (reaction-moment r node #:case [case any? #f]) (at-node 'reaction-moment r node case result-reactions 3))

; Returns the index of the member's first number of `each`, in the given case.
(define (member-index who r i case each)
  (need-result who r)
  (let ((count (member-count (result-frame r))))
    (if (not (and (exact-integer? i) (<= 1 i count))) (error who "i must be a member from 1 to ~a, got ~s" count i))
    (* each (+ (* count (case-index who r case)) (- i 1)))))

(define (larger a b) (if (>= (abs a) (abs b)) a b))

(define (member-force r i #:case [case any? #f])
  (let ((at (member-index 'member-force r i case 12)) (ends (result-ends r)))
    (larger (- 0 (vector-ref ends at)) (vector-ref ends (+ at 6)))))

; Returns the six internal forces and moments at the part t of the member's length. The end forces and the load along the
; member are in equilibrium; so the load follows from them.
(define (forces-at r i t case-number)
  (let* ((bars (bars-at (result-frame r))) (b (vector-ref bars (- i 1))) (count (vector-length bars)) (ends (result-ends r))
         (at (* 12 (+ (* count case-number) (- i 1)))) (e (lambda (k) (vector-ref ends (+ at k)))) (x (* t (bar-length b)))
         (q (lambda (k) (/ (+ (e k) (e (+ k 6))) (- (bar-length b))))))
    (list (- 0 (e 0) (* (q 0) x)) (+ (e 1) (* (q 1) x)) (+ (e 2) (* (q 2) x)) (- 0 (e 3))
      (+ (e 4) (* x (e 2)) (* 1/2 (q 2) x x)) (+ (- 0 (e 5)) (* x (e 1)) (* 1/2 (q 1) x x)))))

(define (member-forces r i t #:case [case any? #f])
  (member-index 'member-forces r i case 12)
  (need-part 'member-forces t)
  (forces-at r i t (case-index 'member-forces r case)))

; ---- combinations ----

; Returns a result whose cases are sums of r's: each a list of a name and of lists of a factor and a case.
(define (combine-cases r . combinations)
  (need-result 'combine-cases r)
  (for-each
    (lambda (c)
      (if (not (and (case? c) (list? c) (pair? (cdr c)) (every (lambda (p) (and (list? p) (= (length p) 2) (real? (car p)))) (cdr c))))
          (error 'combine-cases "a combination is a list such as (list \"uls\" '(1.35 \"dead\") '(1.5 \"wind\")), got ~s" c)))
    combinations)
  (if (null? combinations) (error 'combine-cases "give one combination or more"))
  (let ((n (length (result-cases r))))
    (define (sums v)
      (let* ((each (quotient (vector-length v) n)) (out (make-vector (* each (length combinations)) 0)))
        (for-each
          (lambda (c k)
            (for-each
              (lambda (part)
                (let ((from (* each (case-index 'combine-cases r (second part)))) (to (* each k)))
                  (do ((i 0 (+ i 1))) ((= i each))
                    (vector-set! out (+ to i) (+ (vector-ref out (+ to i)) (* (first part) (vector-ref v (+ from i))))))))
              (cdr c)))
          combinations (iota (length combinations)))
        out))
    (make-result (result-frame r) (map car combinations) (sums (result-moved r)) (sums (result-ends r)) (sums (result-reactions r)) (sums (result-plates r)))))

; ---- shells ----

(define (shell-count r) (need-result 'shell-count r) (length (plates-in (result-frame r))))

; Returns the six forces in the middle of a shell's triangle.
(define (shell-forces r i #:case [case any? #f])
  (need-result 'shell-forces r)
  (let ((count (shell-count r)))
    (if (not (and (exact-integer? i) (<= 1 i count))) (error 'shell-forces "i must be a shell from 1 to ~a, got ~s" count i))
    (let ((at (* 6 (+ (* count (case-index 'shell-forces r case)) (- i 1))))) (map (lambda (k) (vector-ref (result-plates r) (+ at k))) (iota 6)))))

; Returns the greater of the stresses of both sides that count for yielding (von Mises).
(define (shell-stress r i #:case [case any? #f])
  (let* ((f (shell-forces r i #:case case)) (t (fourth (list-ref (plates-in (result-frame r)) (- i 1)))))
    (apply max
      (map (lambda (side)
             (let ((s (map (lambda (n m) (+ (/ n t) (* side (/ (* 6 m) t t)))) (take f 3) (drop f 3))))
               (sqrt (+ (square (first s)) (square (second s)) (- 0 (* (first s) (second s))) (* 3 (square (third s)))))))
        '(1 -1)))))
