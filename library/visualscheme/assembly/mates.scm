; Mates and joints. A place is a point and directions on an object; its frame is the matrix from the world's axes to it.

(define (check-number who name x) (if (not (real? x)) (error who "~a must be a number, got ~s" name x)))

(define (matrix-of-frame p x y z)
  (make-matrix (cx x) (cx y) (cx z) (cx p) (cy x) (cy y) (cy z) (cy p) (cz x) (cz y) (cz z) (cz p) 0 0 0 1))

; Returns the direction x that is nearest to the given one and perpendicular to z; #f if there is none.
(define (across z x)
  (let ((v (v-v x (v-project x z)))) (and (> (vlength v) (* 1e-9 (vlength x))) (unitize v))))

(define (frame-of p normal x)
  (let* ((z (unitize normal)) (x (or (across z x) (across z (if (> (abs (cx z)) 0.5) uy ux))))) (matrix-of-frame p x (cross z x) z)))

; Returns the object, or the union of a list of objects.
(define (whole-of who o)
  (cond ((object? o) o)
        ((and (list? o) (every object? o)) (apply unite o))
        (else (error who "o must be an object or a list of objects, got ~s" o))))

(define (direction? v) (and (gvector? v) (> (vlength v) 0)))

; Returns the frame of a place: a matrix, a point, a list of a point, a normal and perhaps the direction of X, or a face.
(define (place-frame place) (frame-at 'place-frame "place" place))

(define (frame-at who name place)
  (define (refuse) (error who "~a must be a point, a matrix, a face or a list of a point, its normal and perhaps its X direction, got ~s" name place))
  (cond ((matrix? place) place)
        ((point? place) (frame-of place uz ux))
        ((and (pair? place) (list? place) (<= 2 (length place) 3) (point? (car place)) (every direction? (cdr place)))
         (let ((x (if (null? (cddr place)) ux (caddr place))))
           (if (and (pair? (cddr place)) (not (across (unitize (cadr place)) x)))
               (error who "~a: its X direction must not be along its normal, got ~s" name x))
           (frame-of (car place) (cadr place) x)))
        ((and (region? place) (not (empty-object? place)))
         (let* ((c (centroid place)) (boundary (curve-division (car (outline place)) 7)) (u (p->q (car boundary) (cadr boundary)))
                (w (let loop ((l (cddr boundary))) (cond ((null? l) (refuse)) ((across (unitize u) (p->q (car boundary) (car l))) => values) (else (loop (cdr l)))))))
           (frame-of c (cross u w) ux)))
        (else (refuse))))

; Returns the object, moved so that one of its places meets a target, normal against normal. The offset is a gap along the
; target's normal, the angle turns the object about that normal. flip: #f to let both normals point the same way.
(define (mate o place target #:offset [offset any? 0] #:angle [angle any? 0] #:flip [flip any? #t])
  (check-number 'mate "offset" offset)
  (check-number 'mate "angle" angle)
  (do-transform (whole-of 'mate o)
    (matrix* (frame-at 'mate "target" target)
             (translation-matrix (vxyz 0 0 offset))
             (rotation-matrix 'z angle)
             (if flip (rotation-matrix 'x pi) (rotation-matrix 'x 0))
             (matrix-inverse (frame-at 'mate "place" place)))))

(define (range-of kind range)
  (define (interval? r) (and (list? r) (= (length r) 2) (every real? r) (<= (car r) (cadr r))))
  (cond ((not range) (list #f #f))
        ((and (eq? kind 'cylindrical) (list? range) (= (length range) 2) (every interval? range)) range)
        ((and (not (eq? kind 'cylindrical)) (interval? range)) (list range range))
        (else (error 'joint "range must be a list of the least and the greatest value~a, got ~s" (if (eq? kind 'cylindrical) ", one for the angle and one for the distance" "") range))))

(define (check-within name x range)
  (check-number 'joint name x)
  (if (and range (not (<= (car range) x (cadr range))))
      (error 'joint "~a must be from ~a to ~a, got ~a" name (car range) (cadr range) x)))

; Returns the object at a value of its joint: turned about the axis of the place, moved along it, or both.
(define (joint o kind place value #:range [range any? #f])
  (if (not (memq kind '(revolute prismatic cylindrical))) (error 'joint "kind must be 'revolute, 'prismatic or 'cylindrical, got ~s" kind))
  (let* ((ranges (range-of kind range)) (both? (eq? kind 'cylindrical)) (frame (frame-at 'joint "place" place)))
    (if (and both? (not (and (list? value) (= (length value) 2)))) (error 'joint "value must be a list of an angle and a distance, got ~s" value))
    (let ((angle (cond (both? (car value)) ((eq? kind 'revolute) value) (else 0)))
          (way (cond (both? (cadr value)) ((eq? kind 'prismatic) value) (else 0))))
      (if (not (eq? kind 'prismatic)) (check-within (if both? "angle" "value") angle (car ranges)))
      (if (not (eq? kind 'revolute)) (check-within (if both? "distance" "value") way (cadr ranges)))
      (do-transform (whole-of 'joint o) (matrix* frame (translation-matrix (vxyz 0 0 way)) (rotation-matrix 'z angle) (matrix-inverse frame))))))
