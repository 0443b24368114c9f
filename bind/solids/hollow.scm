; Solids whose faces are moved: do-shell, do-offset-solid, do-draft. After fillets.scm. Names that begin with % are hidden
; from programs. Compiled into the binary when it is built.

; Returns the solid with its faces moved: (move face part) is a distance outwards, or a list of a point and a normal, of a
; part of the whole move, from 0 to 1. size and what: the argument that a message says is too large. inwards: whether faces
; move into the solid, in which none can move farther than the solid is large.
(define (%moved who o size what inwards move)
  (let* ((faces (car (%faces-and-edges o))) (try (lambda (part) (%move-faces o (map (lambda (f) (move f part)) faces))))
         (most (if inwards (min 1 (/ (* 2 (%size-of o)) (abs size))) 1)) (made (try most)))
    (define (fits? part) (guard (c ((error-object? c) #f)) (object? (try part)))) ; flat solids are errors
    (define (largest low high n) ; by bisection
      (let ((middle (/ (+ low high) 2.)))
        (if (= n 0) low (if (fits? middle) (largest middle high (- n 1)) (largest low middle (- n 1))))))
    (cond
      ((object? made) made)
      ((second made)
       (error who "~a ~a is too large at ~s: the largest that fits there is ~a" what size (first made) (%number-text (abs (* size (largest 0 most 28))))))
      (else (error who "the faces that meet at ~s do not meet in one point when they are moved" (first made))))))

(define (%need-nonzero who name x)
  (%need-length who name x)
  (if (= x 0) (error who "~a must not be 0" name)))

; t > 0 is the thickness inwards, t < 0 outwards. Open faces have no wall: there the cavity reaches out of the solid.
(define (do-shell o t #:open [open any? #f])
  (%need-nonzero 'do-shell 't t)
  (let* ((o (%solid-given 'do-shell 'o o)) (open? (if open (%selector 'do-shell 'open open) (lambda (f) #f))) (past (abs t)))
    (if (empty-object? o)
        o
        (begin
          (if (> t 0) (%need-visible 'do-shell 't t o) (%need-similar 'do-shell 't t o))
          (if (and open (null? (filter open? (car (%faces-and-edges o))))) (error 'do-shell "open selects no face of o"))
          (if (> t 0)
              (subtract o (%moved 'do-shell o t 't #t (lambda (f k) (* k (if (open? f) past (- t))))))
              (subtract (%moved 'do-shell o t 't #f (lambda (f k) (if (open? f) 0 (* k (- t)))))
                        (if open (%moved 'do-shell o t 't #f (lambda (f k) (if (open? f) (* k past) 0))) o)))))))

; Round: outwards the sum with a ball, inwards what no ball around a point of the boundary covers.
(define (do-offset-solid o d #:join [join any? 'round])
  (let ((o (%solid-given 'do-offset-solid 'o o)))
    (define (moved) (%moved 'do-offset-solid o d 'd (< d 0) (lambda (f k) (* k d))))
    (%need-length 'do-offset-solid 'd d)
    (if (not (memq join '(round sharp))) (error 'do-offset-solid "join must be 'round or 'sharp, got ~s" join))
    (cond
      ((or (= d 0) (empty-object? o)) o)
      ((< d 0)
       (%need-visible 'do-offset-solid 'd d o)
       (let ((made (if (eq? join 'sharp) (moved) (%shrunk o (- d)))))
         (if (> (volume made) 0) made (%nothing-remains (- d)))))
      (else
       (%need-similar 'do-offset-solid 'd d o)
       (if (eq? join 'sharp) (moved) (minkowski o (make-sphere origin d)))))))

; Returns the points of o farther than d from its boundary: if there are none, an object without volume. Those of a
; convex solid are between its moved faces.
(define (%shrunk o d)
  (let* ((all (%faces-and-edges o)) (b (bounding-box o)) (v (p->q (first b) (second b)))
         (sharp (and (every %face-plane? (car all)) (every %edge-convex? (cdr all)) (%move-faces o (map (lambda (f) (- d)) (car all))))))
    (cond
      ((<= (min (cx v) (cy v) (cz v)) (* 2 d)) (empty-object))
      ((object? sharp) sharp)
      (else (subtract o (%do-offset-solid o (make-sphere origin d)))))))

(define (%nothing-remains d)
  (%warn (format "do-offset-solid: nothing of o remains inside of the distance ~a (the empty object)" d))
  (empty-object))

; The faces turn about the lines where they meet the plane, so that they lean inwards on the side of its normal.
(define (do-draft o angle plane #:faces [select any? #f])
  (let* ((o (%solid-given 'do-draft 'o o)) (up (%do-draft plane)) (p (car up)) (z (cadr up)))
    (define (wall? f) (and (%face-plane? f) (< (abs (dot z (%face-direction f))) 0.99)))
    (define (turned f part) ; the line's point nearest to the plane's, and the normal, turned
      (let* ((n (%face-direction f)) (h (unitize (v-v n (v*r z (dot n z))))) (lean (atan (dot n z) (dot n h))) (a (+ lean (* part angle)))
             (q (p+v p (v*r h (/ (dot n (p->q p (%face-point f))) (dot n h))))))
        (list q (v+v (v*r h (cos a)) (v*r z (sin a))))))
    (%need-number 'do-draft 'angle angle)
    (if (>= (abs angle) pi/2) (error 'do-draft "angle must be between -pi/2 and pi/2, got ~a" angle))
    (let* ((chosen? (if select (%selector 'do-draft 'faces select) wall?)) (faces (car (%faces-and-edges o))) (chosen (filter chosen? faces)))
      (if (null? chosen) (error 'do-draft "faces selects no face of o"))
      (for-each (lambda (f) (if (not (wall? f)) (error 'do-draft "the face at ~s is curved, or parallel to the plane, and cannot be drafted" (%face-point f)))) chosen)
      (%moved 'do-draft o angle 'angle #f (lambda (f k) (if (chosen? f) (turned f k) 0))))))
