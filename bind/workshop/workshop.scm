; From the model to the workshop: the sun, contours, slices, ribs, terrain and tables. After probes.scm. Names that begin
; with % are hidden from programs. Compiled into the binary when it is built.

; ---- the sun ----

; Returns the hour between from and to at which (rise? hour) changes.
(define (%change-of rise? from to)
  (let ((first? (rise? from)))
    (let loop ((low from) (high to))
      (let ((middle (/ (+ low high) 2)))
        (cond ((< (- high low) 1e-9) middle)
              ((eq? (rise? middle) first?) (loop middle high))
              (else (loop low middle)))))))

; Returns the sun's way over the sky of one day, on a sphere about `center`: from sunrise to sunset, or a closed curve.
(define (sun-path #:latitude latitude #:longitude [longitude any? 0] #:date date
                  #:center [center any? origin] #:radius [radius any? 1])
  (%need-point 'sun-path 'center center)
  (%need-positive 'sun-path 'radius radius)
  (define (at hour) (%sun-path hour #:latitude latitude #:longitude longitude #:date date))
  (define (up? hour) (>= (cz (at hour)) 0))
  (define (place hour) (p+v center (v*r (at hour) radius)))
  (let* ((hours (map (lambda (i) (/ i 6)) (iota 145)))
         (lit (filter up? hours)))
    (cond
      ((null? lit)
       (%warn "sun-path: the sun does not rise on that day at that place: nothing is made (the empty object)")
       (empty-object))
      ((= (length lit) 145) (make-polygon (map place (iota 144 0 1/6))))
      (else
        ; the day may span midnight of mean local time: it begins after the last dark hour that a lit one follows
        (let* ((begin (or (find (lambda (h) (and (not (up? h)) (up? (+ h 1/6)))) hours) 0))
               (rise (%change-of up? begin (+ begin 1/6)))
               (end (or (find (lambda (h) (not (up? h))) (map (lambda (i) (+ begin (/ i 6))) (iota 144 2))) (+ begin 24)))
               (set (%change-of up? (- end 1/6) end))
               (middle (filter (lambda (h) (< (+ rise 1/60) h (- set 1/60))) (map (lambda (i) (+ begin (/ i 6))) (iota 144 1)))))
          (make-line (map place (append (list rise) middle (list set)))))))))

; Returns the hours of sun of a day at each of the points, by the sun in the middle of each step.
(define (solar-hours points normals #:latitude latitude #:longitude [longitude any? 0] #:date date
                     #:among [among any? '()] #:step [step any? 1/6] #:from [from any? 0] #:to [to any? 24])
  (%need-points 'solar-hours 'points (if (point? points) (list points) points) 0)
  (%need-positive 'solar-hours 'step step)
  (if (not (and (real? from) (real? to) (<= 0 from to 24) (< from to)))
      (error 'solar-hours "from and to must be hours from 0 to 24, from the earlier, got ~s and ~s" from to))
  (if (> (/ (- to from) step) 10000) (error 'solar-hours "step must be at least ~a hours, got ~s" (/ (- to from) 10000.) step))
  (let* ((places (if (point? points) (list points) points))
         (given (if (gvector? normals) (map (lambda (p) normals) places) normals)))
    (if (not (and (list? given) (every (lambda (v) (and (gvector? v) (> (vlength v) 0) (finite? (vlength v)))) given)))
        (error 'solar-hours "normals must be a gvector longer than 0 or a list of them, got ~s" normals))
    (if (not (= (length given) (length places)))
        (error 'solar-hours "normals must be ~a gvectors, one for each point, got ~a" (length places) (length given)))
    (let* ((n (max 1 (exact (ceiling (- (/ (- to from) step) 1e-9)))))
           (hours (/ (- to from) n))
           (suns (filter (lambda (v) (> (cz v) 0))
                         (map (lambda (i) (%solar-hours-at (+ from (* hours (+ i 1/2))) #:latitude latitude #:longitude longitude #:date date))
                              (iota n)))))
      (if (null? suns)
          (map (lambda (p) 0.0) places)
          (%solar-hours places (map (lambda (v) (p+v origin v)) given) (map (lambda (v) (p+v origin v)) suns) hours
                        among)))))
