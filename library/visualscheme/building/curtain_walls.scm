; Curtain walls: a grid of mullions and transoms with a panel in each cell.

; Returns the points between which the columns of panels lie: each side of a path in equal parts of at most a width.
(define (grid-stations who path width)
  (call-with-values (lambda () (path-points who path))
    (lambda (points closed z)
      (let* ((curved? (and (curve? path) (not (eq? (object-kind path) 'line))))
             (parts (lambda (l) (max 1 (exact (ceiling (- (/ l width) 1e-9))))))
             (few (lambda (l) (if (> (/ l width) most-parts) (error who "a grid of ~a makes more than ~a columns" width most-parts)))))
        (few (points-length points))
        (if curved? (let ((total (points-length points)))
                      (map (lambda (s) (call-with-values (lambda () (place-along points s)) (lambda (p v) (+z p z)))) (division 0 total (parts total))))
            (cons (+z (car points) z)
                  (append-map (lambda (a b) (map (lambda (p) (+z p z)) (cdr (line-sequence a b (+ 1 (parts (distance a b))))))) points (cdr points))))))))

; Returns a bar with a square section upright at p, or between two points of one height.
(define (upright-bar p v height size) (do-move (do-rotate (make-box (xyz (/ size -2) (/ size -2) 0) (xyz (/ size 2) (/ size 2) height)) 'z (pol-phi v)) (p->q origin p)))
(define (level-bar p v length size) (do-move (do-rotate (make-box (xyz 0 (/ size -2) (/ size -2)) (xyz length (/ size 2) (/ size 2))) 'z (pol-phi v)) (p->q origin p)))

; A panel is an object with its lower left corner at the origin, X along the wall.
(define (glass-pane w h) (with-material 'glass (make-box (xyz 0 -0.012 0) (xyz w 0.012 h))))

(define (curtain-wall path #:height [height any? 3] #:base [base any? 0] #:grid [grid any? '(1.2 1.5)] #:frame [frame any? 0.06] #:material [material any? 'steel]
                           #:panel [panel any? glass-pane])
  (for-each (lambda (n x) (check-positive 'curtain-wall n x)) '("height" "frame") (list height frame))
  (check-number 'curtain-wall "base" base)
  (if (not (and (list? grid) (= (length grid) 2) (every positive-number? grid)))
      (error 'curtain-wall "grid must be the greatest width and height of its cells, got ~s" grid))
  (if (not (or (not panel) (procedure? panel))) (error 'curtain-wall "panel must be a procedure of width and height, or #f, got ~s" panel))
  (let* ((at (map (lambda (p) (+z p base)) (grid-stations 'curtain-wall path (first grid)))) (closed (meet? (first at) (last at)))
         (n (max 1 (exact (ceiling (- (/ (- height frame) (second grid)) 1e-9))))) (step (/ (- height frame) n))
         (ways (map way at (cdr at)))
         (before (cons (if closed (last ways) (car ways)) ways)) (after (append ways (list (last ways))))
         (posts (if closed (drop-right at 1) at)) (rows (iota (+ n 1))))
    (if (> n most-parts) (error 'curtain-wall "a grid of ~a makes more than ~a rows" (second grid) most-parts))
    (for-each (lambda (p q) (if (<= (distance p q) (* 1.001 frame)) (error 'curtain-wall "a cell at ~s is narrower than the frame of ~a" p frame))) at (cdr at))
    (element "curtain wall" (unite
      (in-material material
        (unite (map (lambda (p a b) (upright-bar p (v+v a b) height frame)) posts before after)
               (append-map (lambda (p q v)
                             (map (lambda (i) (level-bar (+z (p+v p (v*r v (/ frame 2))) (+ (/ frame 2) (* i step))) v (- (distance p q) frame) frame)) rows))
                 at (cdr at) ways)))
      (if (not panel) '()
          (append-map (lambda (p q v)
                        (let ((w (- (distance p q) frame)) (h (- step frame)))
                          (map (lambda (i) (do-move (do-rotate (panel w h) 'z (pol-phi v)) (p->q origin (+z (p+v p (v*r v (/ frame 2))) (+ frame (* i step)))))) (iota n))))
            at (cdr at) ways))))))
