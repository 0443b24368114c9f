; Joints of walls in plan. Around the middle of a joint, a seam separates each wall from the next one: it begins where
; their faces meet, goes on where equal layers and the cores meet, and ends in the middle. Seams lie in separate sectors,
; thus the parts of all walls cover a joint without gaps and overlaps.
;
; A piece is a part of a wall between two joints: its points, and the offsets of its layers' faces, ascending from the
; right. A branch is an end of a piece, seen from the joint: its lines are the faces of the layers, from left to right.

(define-record-type piece (make-piece owner points offsets materials core lines) piece?
  (owner piece-owner) (points piece-points) (offsets piece-offsets) (materials piece-materials) (core piece-core) (lines piece-lines))
(define-record-type branch (make-branch piece start? node way offsets materials core lines) branch?
  (piece branch-piece) (start? branch-start?) (node branch-node) (way branch-way) (offsets branch-offsets)
  (materials branch-materials) (core branch-core) (lines branch-lines))
; A stop is a corner of a seam. For each of the branches on its left and right it has the number of the line that ends
; there, or #f, and how many points of this line the seam cuts off.
(define-record-type stop (make-stop point line-l cut-l line-r cut-r) stop?
  (point stop-point) (line-l stop-line-l) (cut-l stop-cut-l) (line-r stop-line-r) (cut-r stop-cut-r))

(define (piece-of who owner points offsets materials core)
  (make-piece owner points offsets materials core (map (lambda (o) (points-aside who points #f o)) offsets)))

; Returns one end of a piece as a branch. Its lines are longer than the piece by far, to meet others beyond the joint.
(define (branch-of p start?)
  (let* ((points (if start? (piece-points p) (reverse (piece-points p)))) (v (way (car points) (cadr points)))
         (far (* 40 (apply max 1e-3 (map abs (piece-offsets p)))))
         (longer (lambda (line)
                   (let ((line (if start? line (reverse line)))) (cons (p+v (car line) (v*r v (- far))) (cdr line)))))
         (m (length (piece-materials p))) (turned (lambda (l) (if start? (reverse l) l))))
    (make-branch p start? (car points) v (turned (map (lambda (o) (if start? o (- o))) (piece-offsets p)))
      (turned (piece-materials p)) (if start? (- m 1 (piece-core p)) (piece-core p)) (map longer (turned (piece-lines p))))))

(define (branch-size b) (- (first (branch-offsets b)) (last (branch-offsets b))))
(define (offset-in b p) (cross-2d (branch-way b) (p->q (branch-node b) p)))
(define (line-of b i) (list-ref (branch-lines b) i))

; Returns where a line meets a segment: a list of the share of the segment, the point, and the points cut off; or #f.
(define (line-meets line p q)
  (let loop ((l line) (i 1))
    (and (pair? (cdr l))
         (let ((x (segments-cross (car l) (cadr l) p q 1e-9)))
           (if x (list (second x) (third x) i) (loop (cdr l) (+ i 1)))))))

; Returns the stop where line i of l and line j of r meet, nearest to the middle, or #f.
(define (lines-meet l i r j middle)
  (define (nearer a b) (if (or (not a) (< (distance (stop-point b) middle) (distance (stop-point a) middle))) b a))
  (let each ((s (line-of r j)) (n 1) (best #f))
    (if (null? (cdr s)) best
        (let ((x (line-meets (line-of l i) (car s) (cadr s))))
          (each (cdr s) (+ n 1) (if x (nearer best (make-stop (second x) i (third x) j n)) best))))))

; Returns the pairs of lines of l and r that meet in their sector, from the faces to the cores. Layers of one material,
; from the faces on, are continued.
(define (matched-lines l r)
  (let* ((ml (list->vector (branch-materials l))) (mr (list->vector (branch-materials r))) (core-r (+ (branch-core r) 1)))
    (let loop ((i 0) (j (vector-length mr)))
      (cons (cons i j)
            (cond ((and (< i (branch-core l)) (> j core-r) (equal? (vector-ref ml i) (vector-ref mr (- j 1)))) (loop (+ i 1) (- j 1)))
                  ((and (= i (branch-core l)) (= j core-r)) '())
                  (else (list (cons (branch-core l) core-r))))))))

; Returns the numbers of the branch's lines on one side of the middle, from the face on; slack adds those through the middle.
(define (lines-beside b middle left? slack)
  (let ((at (offset-in b middle)) (numbers (iota (length (branch-offsets b)))))
    (if left? (filter (lambda (i) (> (list-ref (branch-offsets b) i) (- at slack))) numbers)
        (filter (lambda (i) (< (list-ref (branch-offsets b) i) (+ at slack))) (reverse numbers)))))

; Returns the seam between the branch l and the next one counter-clockwise, r: stops from the faces to the middle, which is
; the last. Faces that meet nowhere near, or only where they have bent, as those of unequal walls in one line, end on the line that
; halves the sector, which begins at the node: the step between the walls is there, even if the middle of the joint is elsewhere.
(define (seam l r middle)
  (let* ((angle (sector-angle l r)) (sides (lambda (slack) (cons (lines-beside l middle #t slack) (lines-beside r middle #f slack))))
         (beside (sides -1e-9)) (touching (sides 1e-9))
         (pairs (filter (lambda (p) (and (memv (car p) (car touching)) (memv (cdr p) (cdr touching)))) (matched-lines l r)))
         (stops (map (lambda (p) (lines-meet l (car p) r (cdr p) middle)) pairs))
         (flat? (< (abs (- angle pi)) 0.8)) (reach (* 1.5 (+ (branch-size l) (branch-size r))))
         (good? (and (pair? stops) (every values stops)
                     (every (lambda (s) (or (not flat?) (and (<= (max (stop-cut-l s) (stop-cut-r s)) 1) (< (distance (stop-point s) middle) reach)))) stops)))
         (v (vpol 1 (+ (pol-phi (branch-way l)) (/ angle 2)))) (far (* 40 (+ reach 1)))
         (step (step-corner l r middle v angle))
         (end (make-stop middle #f 0 #f 0))
         (base (cond (good? (append stops (list end)))
                     (step (list (make-stop (p+v step (v*r v far)) #f 0 #f 0) (make-stop step #f 0 #f 0) end))
                     (else (list (make-stop (p+v middle (v*r v far)) #f 0 #f 0) end))))
         (free (lambda (all get) (remove (lambda (i) (any (lambda (s) (eqv? (get s) i)) base)) all))))
    (with-crossings base l (free (car beside) stop-line-l) r (free (cdr beside) stop-line-r))))

; Returns the point of the line from the node in the direction v, which halves the sector, up to which both walls cover the
; line; or #f if this point does not lie in the sector as seen from the middle.
(define (step-corner l r middle v angle)
  (let* ((p (p+v (branch-node l) (v*r v (/ (min (first (branch-offsets l)) (- (last (branch-offsets r)))) (sin (/ angle 2))))))
         (way (p->q middle p)))
    (and (> (vlength way) nearly)
         (let ((turn (- (pol-phi way) (pol-phi (branch-way l)))))
           (< 1e-6 (if (< turn 0) (+ turn 2pi) turn) (- angle 1e-6)))
         p)))

(define (sector-angle l r)
  (let ((a (- (pol-phi (branch-way r)) (pol-phi (branch-way l))))) (if (<= a 1e-9) (+ a 2pi) a)))

; Returns the seam with a stop for each line that ends on it between its corners.
(define (with-crossings base l lines-l r lines-r)
  (define (on p q b lines make)
    (filter-map (lambda (i) (let ((x (line-meets (line-of b i) p q))) (and x (cons (car x) (make (second x) i (third x)))))) lines))
  (define (merged all)
    (cond ((or (null? all) (null? (cdr all))) (map cdr all))
          ((meet? (stop-point (cdar all)) (stop-point (cdadr all)))
           (let ((a (cdar all)) (b (cdadr all)))
             (merged (cons (cons (caar all)
                                 (make-stop (stop-point a) (or (stop-line-l a) (stop-line-l b)) (max (stop-cut-l a) (stop-cut-l b))
                                   (or (stop-line-r a) (stop-line-r b)) (max (stop-cut-r a) (stop-cut-r b))))
                           (cddr all)))))
          (else (cons (cdar all) (merged (cdr all))))))
  (if (null? (cdr base)) base
      (let* ((p (stop-point (car base))) (q (stop-point (cadr base)))
             (found-l (on p q l lines-l (lambda (x i cut) (make-stop x i cut #f 0))))
             (found-r (on p q r lines-r (lambda (x i cut) (make-stop x #f 0 i cut))))
             (left-over (lambda (lines found get) (remove (lambda (i) (any (lambda (f) (eqv? (get (cdr f)) i)) found)) lines))))
        (cons (car base)
              (append (merged (sort (append found-l found-r) < #:key car))
                      (with-crossings (cdr base) l (left-over lines-l found-l stop-line-l) r (left-over lines-r found-r stop-line-r)))))))

; Returns the middle of a joint: the point nearest to the middles of all cores, if it lies in all walls and near the node.
(define (joint-middle branches)
  (define node (branch-node (car branches)))
  (define (centre b) (/ (+ (list-ref (branch-offsets b) (branch-core b)) (list-ref (branch-offsets b) (+ (branch-core b) 1))) 2))
  (define (in-all? p)
    (every (lambda (b) (<= (- (last (branch-offsets b)) 1e-9) (offset-in b p) (+ (first (branch-offsets b)) 1e-9))) branches))
  (let* ((sum (lambda (f) (apply + (map (lambda (b) (f (left (branch-way b)) (centre b))) branches))))
         (xx (sum (lambda (n c) (* (cx n) (cx n))))) (xy* (sum (lambda (n c) (* (cx n) (cy n))))) (yy (sum (lambda (n c) (* (cy n) (cy n)))))
         (x (sum (lambda (n c) (* (cx n) c)))) (y (sum (lambda (n c) (* (cy n) c)))) (k (- (* xx yy) (* xy* xy*)))
         (n0 (left (branch-way (car branches))))
         (meeting (and (> k 1e-6) (+xy node (/ (- (* x yy) (* y xy*)) k) (/ (- (* y xx) (* x xy*)) k))))
         (mean (p+v node (v*r n0 (/ (sum (lambda (n c) (* c (dot n n0)))) (length branches)))))
         (near-node? (lambda (p) (<= (distance p node) (apply max (map branch-size branches))))))
    (cond ((every (lambda (b) (< (abs (centre b)) 1e-9)) branches) node)
          ((and meeting (near-node? meeting) (in-all? meeting)) meeting)
          ((in-all? mean) mean)
          ((in-all? node) node)
          (else (error 'join-walls "the walls that meet at ~s lie beside each other: move their paths together" node)))))

; Returns true if b goes on where a ends: the same layers in one line.
(define (continues? a b)
  (define (all-near? l m) (and (= (length l) (length m)) (every (lambda (x y) (near? x y)) l m)))
  (and (near? (sector-angle a b) pi 1e-6) (equal? (branch-materials b) (reverse (branch-materials a)))
       (all-near? (branch-offsets b) (map - (reverse (branch-offsets a)))) (= (+ (branch-core a) (branch-core b) 1) (length (branch-materials a)))))

; Returns the middle of a joint where a wall ends on one that goes straight on: between the corners of their cores, so that
; its end is straight; #f at other joints.
(define (middle-of-stem sorted middle)
  (define (corner l r) (let ((found (reverse (seam l r middle)))) (and (pair? (cdr found)) (stop-point (cadr found)))))
  (define (with-stem s a b) (and (continues? a b) (let ((p (corner s a)) (q (corner b s))) (and p q (mid p q)))))
  (and (= (length sorted) 3)
       (let ((a (first sorted)) (b (second sorted)) (c (third sorted))) (or (with-stem a b c) (with-stem b c a) (with-stem c a b)))))

; Returns for each branch of a joint a list: the branch, its end, and the pieces that cut it off. An end is a list of (point
; line cut) from its left face to its right face.
(define (joint-ends branches)
  (let* ((sorted (sort branches < #:key (lambda (b) (pol-phi (branch-way b))))) (minor (minor-branch branches sorted)) (others (remove (lambda (b) (eq? b minor)) branches)))
    (cond ((null? (cdr branches)) (list (list (car branches) (free-end (car branches)) '())))
          (minor (cons (list minor (free-end minor) (map branch-piece others)) (joint-ends others)))
          (else (seamed-ends sorted)))))
(define (seamed-ends sorted)
  (let* ((middle (joint-middle sorted)) (middle (or (middle-of-stem sorted middle) middle)) (next (append (cdr sorted) (list (car sorted)))))
    (for-each (lambda (l r)
                (if (< (sector-angle l r) 0.1)
                    (error 'join-walls "two walls meet at ~a degrees at ~s: 6 is the least" (exact (round (radians->degrees (sector-angle l r))))
                      (branch-node l))))
      (if (null? (cddr sorted)) (list (car sorted) (cadr sorted)) sorted) next)
    (let ((seams (map (lambda (l r) (seam l r middle)) sorted next)))
      (map (lambda (b own before) (list b (end-between b own before middle) '())) sorted seams (cons (last seams) seams)))))

(define (free-end b)
  (map (lambda (o i) (list (aside (branch-node b) (branch-way b) o) i 1)) (branch-offsets b) (iota (length (branch-offsets b)))))

; Returns the end of b between the seam on its left and the seam on its right.
(define (end-between b on-left on-right middle)
  (let* ((at (offset-in b middle))
         (from-face (lambda (l) (or (find-tail second l) '())))
         (lefts (from-face (map (lambda (s) (list (stop-point s) (stop-line-l s) (stop-cut-l s))) (drop-right on-left 1))))
         (rights (from-face (map (lambda (s) (list (stop-point s) (stop-line-r s) (stop-cut-r s))) (drop-right on-right 1))))
         (sides (append lefts rights))
         (through (list-index (lambda (o i) (and (<= (abs (- o at)) 1e-9) (not (find (lambda (e) (eqv? (second e) i)) sides))))
                    (branch-offsets b) (iota (length (branch-offsets b)))))
         (end (append lefts (list (list middle through 1)) (reverse rights))))
    (if (not (every (lambda (i) (any (lambda (e) (eqv? (second e) i)) end)) (iota (length (branch-offsets b)))))
        (too-short (branch-piece b)))
    end))

(define (too-short p)
  (error 'join-walls "the wall from ~s to ~s is too short for its joints" (first (piece-points p)) (last (piece-points p))))

; Returns the loops of a piece's layers, from the right, between its ends.
(define (layer-loops p at-start at-end)
  (let* ((m (length (piece-materials p)))
         (entry (lambda (end i) (find (lambda (e) (eqv? (second e) i)) end)))
         (slice (lambda (end i j)
                  (let* ((tail (find-tail (lambda (e) (eqv? (second e) i)) end)))
                    (let loop ((l tail)) (cons (first (car l)) (if (eqv? (second (car l)) j) '() (loop (cdr l))))))))
         (inner (lambda (k)
                  (let* ((line (list-ref (piece-lines p) k)) (a (entry at-start (- m k))) (b (entry at-end k))
                         (rest (- (length line) (third a) (third b))))
                    (if (< rest 0) (too-short p))
                    (let* ((between (take (drop line (third a)) rest)) (all (append (list (first a)) between (list (first b))))
                           (v (way (first (piece-points p)) (second (piece-points p))))
                           (w (apply way (take-right (piece-points p) 2))))
                      (if (or (< (dot v (p->q (first all) (second all))) -1e-9) (< (dot w (apply p->q (take-right all 2))) -1e-9)) (too-short p))
                      between))))
         (inners (map inner (iota (+ m 1)))))
    (map (lambda (k)
           (without-near (append (list-ref inners k) (slice at-end k (+ k 1)) (reverse (list-ref inners (+ k 1))) (slice at-start (- m k 1) (- m k)))))
      (iota m))))

(define (without-near l) (filter-map (lambda (a b) (if (< (distance a b) 1e-9) #f a)) l (append (cdr l) (list (car l)))))
