; (visualscheme analysis): ways to exits on plans by hand, to 1e-9; random plans; views; each message
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max 1 (abs a) (abs b)))))
(define (say . l) (displayln l))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(define (rect a b c d) (make-region (make-rectangle (xy a b) (xy c d))))
(define (over . points) (apply + (map distance points (cdr points))))

(define hall (list (xy 0 0) (xy 10 0) (xy 10 6) (xy 0 6)))
(define ell (list (xy 0 0) (xy 10 0) (xy 10 4) (xy 4 4) (xy 4 10) (xy 0 10)))
(define u-plan (list (xy 0 0) (xy 9 0) (xy 9 9) (xy 6 9) (xy 6 3) (xy 3 3) (xy 3 9) (xy 0 9)))
(define pillar (subtract (rect 0 0 10 6) (rect 4 1 6 5)))
(define pillars (subtract (rect 0 0 20 6) (rect 4 1 6 5) (rect 9 0 11 4) (rect 14 2 16 6)))
; 1 one room; 2 two exits; 3 an L; 4 a U; 5 a pillar; 6 pillars in turn
(say (same? (egress-distance (egress hall (xy 10 3)) (xy 2 1)) (over (xy 2 1) (xy 10 3)))
     (same? (egress-distance (egress hall (list (xy 10 3) (xy 0 5))) (xy 2 1)) (over (xy 2 1) (xy 0 5)))
     (same? (egress-distance (egress ell (xy 10 2)) (xy 0 10)) (over (xy 0 10) (xy 4 4) (xy 10 2)))
     (same? (egress-distance (egress u-plan (xy 7 9)) (xy 1 9)) (over (xy 1 9) (xy 3 3) (xy 6 3) (xy 7 9)))
     (same? (egress-distance (egress pillar (xy 10 3)) (xy 0 3)) (over (xy 0 3) (xy 4 5) (xy 6 5) (xy 10 3)))
     (same? (egress-distance (egress pillars (xy 20 1)) (xy 0 1)) (over (xy 0 1) (xy 6 1) (xy 9 4) (xy 11 4) (xy 14 2) (xy 20 1))))
; expect: (#t #t #t #t #t #t)
; 7 rooms with doors; 8 the same as one area; 9 two ways through three rooms; 10 a door as a line
(define left (rect 0 0 5 4)) (define right (rect 5 0 10 4)) (define top (rect 0 4 10 8))
(say (same? (egress-distance (egress (list left right) (xy 10 1) #:doors (list (xy 5 3.5))) (xy 1 1)) (over (xy 1 1) (xy 5 3.5) (xy 10 1)))
     (same? (egress-distance (egress (list left right) (xy 10 1)) (xy 1 1)) 9)
     (same? (egress-distance (egress (list left right top) (xy 10 1) #:doors (list (xy 5 0.5) (xy 1 4) (xy 9 4))) (xy 1 3)) (over (xy 1 3) (xy 5 0.5) (xy 10 1)))
     (same? (egress-distance (egress (list left right top) (xy 10 1) #:doors (list (xy 1 4) (xy 9 4))) (xy 1 3)) (over (xy 1 3) (xy 1 4) (xy 9 4) (xy 10 1)))
     (same? (egress-distance (egress (list left right) (make-line (xy 10 0.5) (xy 10 1.5)) #:doors (list (make-line (xy 5 3) (xy 5 4)))) (xy 1 1)) (over (xy 1 1) (xy 5 3.5) (xy 10 1))))
; expect: (#t #t #t #t #t)
; walls with thickness: the doors are areas; a round pillar; a room without a door; a point in a wall
(define walls (list (rect 0 0 5 4) (rect 5.2 0 10 4) (rect 5 1 5.2 2)))
(say (same? (egress-distance (egress walls (xy 10 4)) (xy 0 4)) (over (xy 0 4) (xy 5 2) (xy 5.2 2) (xy 10 4)))
     (near? (egress-distance (egress (subtract (rect 0 0 10 4) (make-region (make-circle (xy 5 2) 1))) (xy 10 2)) (xy 0 2))
            (* 2 (+ (sqrt 24) (- (/ pi 2) (acos 1/5)))) 1e-3)
     (egress-distance (egress (list left right) (xy 10 1) #:doors '()) (xy 1 1)) (egress-distance (egress walls (xy 10 4)) (xy 5.1 3)) (egress-path (egress walls (xy 10 4)) (xy 5.1 3)))
; expect: (#t #t #f #f #f)
(say (egress-path (egress ell (xy 10 2)) (xy 0 10)) (map (lambda (x) (if (point? x) x (same? x (over (xy 0 10) (xy 4 4) (xy 10 2))))) (longest-egress (egress ell (xy 10 2)))))
; expect: ((make-line (list (xyz 0 10 0) (xyz 4 4 0) (xyz 10 2 0))) ((xyz 0 10 0) #t))

; views: all of a room, an L with a shadow, a pillar's shadow
(say (same? (area (isovist hall (xy 3 3))) 60) (same? (area (isovist ell (xy 2 8))) 44)
     (same? (area (isovist (subtract (rect 0 0 10 6) (rect 4 2 6 4)) (xy 2 3))) (- 60 16 12))) ; the shadow widens from 2 at x = 4 to 6 at x = 8
; expect: (#t #t #t)

; random plans of blocks in a hall: a way is as long as its path, stays in the room, is no shorter than straight, and
; shortens by no more than a step
(random-seed! 7)
(define (random-plan) (apply subtract (rect 0 0 20 20) (map (lambda (k) (let ((x (random-range 1.0 17.0)) (y (random-range 1.0 17.0))) (rect x y (+ x (random-range 0.5 4.0)) (+ y (random-range 0.5 4.0))))) (iota 8))))
(define (sound? k)
  (let* ((plan (random-plan)) (exits (list (xy 20 (random-range 0.0 20.0)) (xy (random-range 0.0 20.0) 0))) (r (egress plan exits)) (p (xy (random-range 0.0 20.0) (random-range 0.0 20.0)))
         (far (egress-distance r p)))
    (or (not far)
        (let* ((path (egress-path r p)) (stays (every (lambda (s) (let ((q (curve-point path (* s (curve-length path))))) (egress-distance r q))) '(0.13 0.37 0.5 0.71 0.93)))
               (step (+xy p 0.01 0.02)) (near (egress-distance r step)))
          (and stays (same? (curve-length path) far) (>= (+ far 1e-9) (apply min (map (lambda (e) (distance p e)) exits)))
               (or (not near) (<= (abs (- near far)) (+ 1e-9 (distance p step)))
                   (> (abs (- near far)) 0.5)) ; a wall is between them
               (let ((view (isovist plan p))) (and (<= (area view) (+ 1e-9 (area plan))) (> (area view) 0))))))))
(say (count sound? (iota 60))) ; expect: (60)

(fails (egress '() (xy 0 0)))             ; expect: egress: rooms must be one room or more, got ()
(fails (egress hall '()))                 ; expect: egress: exits must be one point or line or more, got ()
(fails (egress (list 3) (xy 0 0)))        ; expect: egress: a room must be a region, a closed curve or a list of points, got 3
(fails (egress hall (list 3)))            ; expect: egress: exits must be points or lines, got 3
(fails (egress-distance 3 (xy 0 0)))      ; expect: egress-distance: r must be a result of egress, got 3
(fails (egress-distance (egress hall (xy 0 0)) 3)) ; expect: egress-distance: point must be a point, got 3
(fails (isovist hall (xy 20 0)))          ; expect: isovist: the point (xyz 20 0 0) is in no room
(fails (longest-egress (egress hall (xy 0 0)) #:step 0.001)) ; expect: longest-egress: step 0.001 is too fine for a plan of 10.0
