; Solids whose faces are moved: do-shell, do-offset-solid, do-draft. After fillets.scm. Names that begin with % are hidden
; from programs. Compiled into the binary when it is built.

; Returns the solid with its faces moved: (move face part) is a distance outwards, or a list of a point and a normal, of a
; part of the whole move, from 0 to 1. size and what: the argument that a message says is too large.
(define (%moved who o size what move)
  (let* ((faces (car (%faces-and-edges o))) (try (lambda (part) (%move-faces o (map (lambda (f) (move f part)) faces)))) (made (try 1)))
    (define (largest low high n) ; by bisection
      (let ((middle (/ (+ low high) 2.)))
        (if (= n 0) low (if (object? (try middle)) (largest middle high (- n 1)) (largest low middle (- n 1))))))
    (cond
      ((object? made) made)
      ((second made)
       (error who "~a ~a is too large at ~s: the largest that fits there is ~a" what size (first made) (%number-text (abs (* size (largest 0 1 24))))))
      (else (error who "the faces that meet at ~s do not meet in one point when they are moved" (first made))))))

(define (%need-nonzero who name x)
  (%need-number who name x)
  (if (= x 0) (error who "~a must not be 0" name)))

; t > 0 is the thickness inwards, t < 0 outwards. Open faces have no wall: there the cavity reaches out of the solid.
(define (do-shell o t #:open [open any? #f])
  (%need-nonzero 'do-shell 't t)
  (let* ((o (%solid-given 'do-shell 'o o)) (open? (if open (%selector 'do-shell 'open open) (lambda (f) #f))) (past (abs t)))
    (if (empty-object? o)
        o
        (begin
          (if (and open (null? (filter open? (car (%faces-and-edges o))))) (error 'do-shell "open selects no face of o"))
          (if (> t 0)
              (subtract o (%moved 'do-shell o t 't (lambda (f k) (* k (if (open? f) past (- t))))))
              (subtract (%moved 'do-shell o t 't (lambda (f k) (if (open? f) 0 (* k (- t)))))
                        (if open (%moved 'do-shell o t 't (lambda (f k) (if (open? f) (* k past) 0))) o)))))))

; Round: outwards the sum with a ball, inwards what no ball around a point of the boundary covers.
(define (do-offset-solid o d #:join [join any? 'round])
  (let ((o (%solid-given 'do-offset-solid 'o o)))
    (%need-number 'do-offset-solid 'd d)
    (if (not (memq join '(round sharp))) (error 'do-offset-solid "join must be 'round or 'sharp, got ~s" join))
    (cond
      ((or (= d 0) (empty-object? o)) o)
      ((eq? join 'sharp) (%moved 'do-offset-solid o d 'd (lambda (f k) (* k d))))
      ((> d 0) (minkowski o (make-sphere origin d)))
      (else (subtract o (%do-offset-solid o (make-sphere origin (- d))))))))

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
      (%moved 'do-draft o angle 'angle (lambda (f k) (if (chosen? f) (turned f k) 0))))))
