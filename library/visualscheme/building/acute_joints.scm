; Joints of curved walls that meet at small angles. Their faces can meet far away, cross each other twice, or never, so that
; no seam divides them. There the wall with the thinner core is the minor one: the other walls are joined as if it were not
; there, and the minor wall ends on their faces, with all layers.

(define acute 0.7)                              ; radians: seams divide curved walls that meet at more
(define (core-size b) (- (list-ref (branch-offsets b) (branch-core b)) (list-ref (branch-offsets b) (+ (branch-core b) 1))))

; Returns whether a branch bends before its faces leave those of a branch of this angle and size.
(define (bends-near? b angle other)
  (let ((points (piece-points (branch-piece b))))
    (and (pair? (cddr points))
         (let ((ends (if (branch-start? b) points (reverse points))))
           (< (distance (first ends) (second ends)) (/ (* 1.5 (+ (branch-size b) (branch-size other))) (sin (max angle 0.1))))))))

; Returns the minor branch of two neighbours that meet at a small angle and bend, or #f: of equal cores the later one in
; branches, so that two walls that meet twice have the same order at both joints.
(define (minor-branch branches sorted)
  (define (minor? a b) (or (< (core-size a) (- (core-size b) nearly)) (and (<= (core-size a) (+ (core-size b) nearly)) (memq a (memq b branches)))))
  (define (of-pair l r)
    (let ((angle (angle-between (branch-way l) (branch-way r))))
      (and (not (eq? l r)) (< angle acute) (or (bends-near? l angle r) (bends-near? r angle l))
           (if (minor? r l) r l))))
  (any of-pair sorted (append (cdr sorted) (list (car sorted)))))

; Returns the areas, lists of loops, of a region outside others. Slivers between coordinates that differ by rounding are omitted.
(define (areas-outside region others)
  (let* ((left-over (subtract region others))
         (loops (if (empty-object? left-over) '() (map (lambda (c) (car (object-arguments c))) (outline left-over)))))
    (filter-map
      (lambda (l) (and (> (turn l) 1e-9) (cons l (filter (lambda (h) (and (< (turn h) 0) (inside? (car h) l))) loops))))
      loops)))
; Returns a loop without its spikes, corners at which it turns back on itself: regions accept no loop that crosses itself.
(define (without-spikes loop)
  (define (spike? before p after) (or (< (distance before p) 1e-9) (< (angle-between (p->q p before) (p->q p after)) 0.01)))
  (let ((k (list-index spike? (cons (last loop) loop) loop (append (cdr loop) (list (car loop))))))
    (if k (without-spikes (append (take loop k) (drop loop (+ k 1)))) loop)))
(define (loop-region l) (make-region (make-polygon (without-spikes l))))
(define (area-region a) (apply make-region (map make-polygon a)))

; Returns the layers of a piece, lists of areas, outside the pieces that cut its ends off. Corners that would stand out on the
; far side of these pieces, at a tip of the wall, are omitted.
(define (layers-outside loops cutters tips size)
  (let* ((bodies (map (lambda (layers) (unite (map loop-region layers))) cutters))
         (parts (areas-outside (unite (map loop-region loops)) bodies))
         (main (and (pair? parts) (argmin (lambda (a) (- (turn (car a)))) parts)))
         (at-tip? (lambda (p reach) (any (lambda (tip) (< (distance p tip) reach)) tips)))
         (whole? (lambda (a) (every (lambda (tip) (any (lambda (p) (>= (distance p tip) size)) (car a))) tips)))
         (corner? (lambda (a) (if (eq? a main) (not (whole? a)) (any (lambda (p) (at-tip? p (* 1.5 size))) (car a)))))
         (corners (filter corner? parts)))
    (map (lambda (l) (areas-outside (loop-region l) (append bodies (map area-region corners)))) loops)))
