; The geometry's library in Scheme: procedures that take procedures, or have forms that C natives cannot take;
; constants; syntax. Names that begin with % are hidden from programs. Compiled into the binary when it is built, after
; prelude.scm.

; ---- numbers ----

(define pi 3.141592653589793)
(define 2pi (* 2 pi))
(define 2*pi 2pi)
(define 3pi/2 (* 3/2 pi))
(define pi/2 (/ pi 2))
(define pi/3 (/ pi 3))
(define pi/4 (/ pi 4))
(define pi/5 (/ pi 5))
(define pi/6 (/ pi 6))
(define pi/8 (/ pi 8))
(define pi/12 (/ pi 12))
(define -pi (- pi))
(define -2pi (- 2pi))
(define -2*pi -2pi)
(define -3pi/2 (- 3pi/2))
(define -pi/2 (- pi/2))
(define -pi/3 (- pi/3))
(define -pi/4 (- pi/4))
(define -pi/5 (- pi/5))
(define -pi/6 (- pi/6))
(define -pi/8 (- pi/8))
(define -pi/12 (- pi/12))

; ---- points and vectors ----

(define origin (xyz 0 0 0))
(define u0 origin)
(define ux (vxyz 1 0 0))
(define uy (vxyz 0 1 0))
(define uz (vxyz 0 0 1))

; Compares lists, too: bounding boxes, sequences of points.
(define (near? a b [tolerance any? 1e-9])
  (let near ((a a) (b b) (depth 0))
    (if (and (list? a) (list? b) (< depth 100)) ; circular lists are no lists, or end here
        (let loop ((p a) (q b))
          (if (or (null? p) (null? q))
              (and (null? p) (null? q))
              (and (near (car p) (car q) (+ depth 1)) (loop (cdr p) (cdr q)))))
        (%near? a b tolerance))))

; Compares the two values of a check. Returns #f if they differ in more than objects; otherwise the list of the pairs of
; objects that are not equal?. Numbers are equal by =, or within the tolerance.
(define (%check-differences a b tolerance)
  (define (measured? x) (or (point? x) (gvector? x) (axis? x) (plane? x) (matrix? x)))
  (define (leaf a b found)
    (cond ((equal? a b) found)
          ((and (object? a) (object? b)) (cons (cons a b) found))
          ((and (number? a) (number? b)) (and (or (= a b) (and tolerance (<= (abs (- a b)) tolerance))) found))
          ((and tolerance (measured? a) (measured? b)) (and (near? a b tolerance) found))
          (else #f)))
  (if (and tolerance (not (and (real? tolerance) (>= tolerance 0))))
      (error "check-within: the tolerance must be a number from 0 on, got" tolerance))
  (let same ((a a) (b b) (depth 0) (found '())) ; circular lists are no lists, or end here
    (cond ((and (vector? a) (vector? b) (= (vector-length a) (vector-length b)) (< depth 100))
           (same (vector->list a) (vector->list b) (+ depth 1) found))
          ((and (pair? a) (list? a) (list? b) (< depth 100))
           (let loop ((p a) (q b) (found found))
             (cond ((not found) #f)
                   ((or (null? p) (null? q)) (and (null? p) (null? q) found))
                   (else (loop (cdr p) (cdr q) (same (car p) (car q) (+ depth 1) found))))))
          (else (leaf a b found)))))

; Returns the value as an expression that makes it: (list 1 'a) for (1 a). A long list is cut, since a message shows one
; line.
(define (%check-shown v)
  (let shown ((v v) (depth 0))
    (cond ((> depth 100) v)
          ((or (null? v) (symbol? v)) (list 'quote v))
          ((and (vector? v) (< 0 (vector-length v) 1000)) (cons 'vector (cdr (shown (vector->list v) (+ depth 1)))))
          ((list? v) ; a circular one is no list
           (let loop ((l v) (count 0) (made '(list)))
             (if (or (null? l) (= count 1000))
                 (reverse made)
                 (loop (cdr l) (+ count 1) (cons (shown (car l) (+ depth 1)) made)))))
          ((and (pair? v) (not (pair? (cdr v)))) (list 'cons (shown (car v) (+ depth 1)) (shown (cdr v) (+ depth 1))))
          (else v))))

; ---- sequences ----

(define map-division
  (case-lambda
    ((f a b n) (map-division f a b n #t))
    ((f a b n last?)
     (%need-procedure 'map-division 'f f)
     (%need-division 'map-division a b n)
     (map f (division a b n last?)))
    ((f u0 u1 nu v0 v1 nv)
     (%need-procedure 'map-division 'f f)
     (%need-division 'map-division u0 u1 nu)
     (%need-division 'map-division v0 v1 nv)
     (let ((vs (division v0 v1 nv)))
       (map (lambda (u) (map (lambda (v) (f u v)) vs)) (division u0 u1 nu))))))

(define (%need-division who a b n)
  (if (not (and (number? a) (number? b))) (error who "a range goes from a number to a number, got ~s" (if (number? a) b a)))
  (if (not (and (exact-integer? n) (>= n 1))) (error who "a count of steps must be an exact integer from 1 on, got ~s" n)))

; The cell with corners p and q is the first of nx by ny by nz; f makes the object around each centre.
(define (distribute-in-space f p q nx ny nz)
  (let* ((size (p->q p q)) (centre (mid p q)))
    (define (at i j k)
      (f (+xyz centre (* i (cx size)) (* j (cy size)) (* k (cz size)))))
    (%check-count 'distribute-in-space 'nx nx)
    (%check-count 'distribute-in-space 'ny ny)
    (%check-count 'distribute-in-space 'nz nz)
    (let loop ((i 0) (j 0) (k 0) (made '()))
      (cond
        ((= k nz) (apply unite (reverse made)))
        ((= j ny) (loop 0 0 (+ k 1) made))
        ((= i nx) (loop 0 (+ j 1) k made))
        (else (loop (+ i 1) j k (cons (at i j k) made)))))))

(define (%check-count who name n)
  (if (not (and (exact-integer? n) (>= n 0)))
      (error who "~a must be an exact integer from 0 on, got ~s" name n)))

; ---- curves ----

(define (make-spline #:segments [segments any? #f] #:plane [plane any? #f] . arguments)
  (define curve
    (cond
      ((and (pair? arguments) (or (pair? (car arguments)) (null? (car arguments))))
       (case (length arguments)
         ((1) (%make-spline (car arguments) #f #f segments))
         ((3) (%make-spline (car arguments) (cadr arguments) (caddr arguments) segments))
         (else (error 'make-spline "takes a list of points, alone or with a start and an end tangent"))))
      (else (%make-spline arguments #f #f segments))))
  (if plane (%stand curve plane) curve))

; ---- surfaces ----

; Returns the distance of p from the segment between a and b.
(define (%from-chord p a b)
  (let* ((way (p->q a b)) (square (dot way way)))
    (distance p (if (> square 0) (p+v a (v*r way (max 0 (min 1 (/ (dot (p->q a p) way) square))))) a))))

; Returns the distance of p from the nearer plane of the two triangles that the diagonal a c cuts the quad a b c d into.
(define (%from-halves p a b c d)
  (define (from-plane b)
    (let* ((normal (cross (p->q a b) (p->q a c))) (long (vlength normal)))
      (if (> long 0) (abs (/ (dot (p->q a p) normal) long)) (%from-chord p a c))))
  (min (from-plane b) (from-plane d)))

; Returns rows of points of f: a row for each of us, with a point for each of vs. It adds lines until the net of
; triangles is within the tolerance of the surface at the middle of every edge and every cell. A line runs through the
; whole net, so no corner lies on an edge, and borders that meet have equal points. Lines closer than a millionth of the
; range are not divided further: f jumps there.
(define (%rows-within f us vs tolerance)
  (define (point u v)
    (let ((p (f u v)))
      (if (%finite-point? p)
          p
          (error 'make-surface "f must give points of finite coordinates; at (u, v) = (~a, ~a) it gave ~s" u v p))))
  (define (transposed rows)
    (let loop ((rows rows) (columns '()))
      (if (null? (car rows)) (reverse columns) (loop (map cdr rows) (cons (map car rows) columns)))))
  (define (strays? middle row next)
    (and (pair? middle)
         (or (> (%from-chord (car middle) (car row) (car next)) tolerance)
             (strays? (cdr middle) (cdr row) (cdr next)))))
  (define (middle a b) (/ (+ a b) 2))
  ; Calls (add? i u next-u row next-row) between any two rows, and inserts a row (line u) between those for which it is
  ; true.
  (define (parted us rows line add?)
    (define least (* 1e-6 (abs (- (last us) (car us)))))
    (let loop ((i 0) (us us) (rows rows) (new-us '()) (new-rows '()))
      (if (> i 10000)
          (error 'make-surface "a tolerance of ~a takes more than 10000 lines one way; a larger one takes fewer" tolerance))
      (cond
        ((null? (cdr us)) (values (reverse (cons (car us) new-us)) (reverse (cons (car rows) new-rows))))
        ((and (> (abs (- (cadr us) (car us))) least) (add? i (car us) (cadr us) (car rows) (cadr rows)))
         (let ((m (middle (car us) (cadr us))))
           (loop (+ i 1) (cdr us) (cdr rows) (cons m (cons (car us) new-us)) (cons (line m) (cons (car rows) new-rows)))))
        (else (loop (+ i 1) (cdr us) (cdr rows) (cons (car us) new-us) (cons (car rows) new-rows))))))
  ; A wave may cross its chord at the middle; therefore the first pass tests each step at two places.
  (define (bent line first?)
    (lambda (i u next-u row next)
      (or (strays? (line (middle u next-u)) row next)
          (and first? (strays? (line (+ u (* 0.3 (- next-u u)))) row next)))))
  ; Returns two vectors: the steps of u and of v with a cell whose middle is too far from its triangles. The longer side
  ; of the cell decides between u and v.
  (define (warped us vs rows)
    (let ((of-u (make-vector (length us) #f)) (of-v (make-vector (length vs) #f)))
      (let row-loop ((i 0) (us us) (rows rows))
        (if (pair? (cdr us))
            (let loop ((j 0) (vs vs) (row (car rows)) (next (cadr rows)))
              (if (pair? (cdr vs))
                  (let ((a (car row)) (b (cadr row)) (c (cadr next)) (d (car next))
                        (p (point (middle (car us) (cadr us)) (middle (car vs) (cadr vs)))))
                    (if (> (max (%from-halves p a b c d) (%from-halves p b c d a)) tolerance)
                        (if (> (+ (distance a d) (distance b c)) (+ (distance a b) (distance d c)))
                            (vector-set! of-u i #t)
                            (vector-set! of-v j #t)))
                    (loop (+ j 1) (cdr vs) (cdr row) (cdr next)))
                  (row-loop (+ i 1) (cdr us) (cdr rows))))))
      (values of-u of-v)))
  (define (along-v vs) (lambda (u) (map (lambda (v) (point u v)) vs)))
  (define (along-u us) (lambda (v) (map (lambda (u) (point u v)) us)))
  (let refine ((us us) (vs vs) (rows (map (along-v vs) us)) (first? #t))
    (let*-values
      (((new-us rows) (parted us rows (along-v vs) (bent (along-v vs) first?)))
       ((new-vs columns) (parted vs (transposed rows) (along-u new-us) (bent (along-u new-us) first?))))
      (if (> (* (length new-us) (length new-vs)) 50000000)
          (error 'make-surface "a tolerance of ~a takes more than 50 million points; a larger one takes fewer" tolerance))
      (if (and (= (length us) (length new-us)) (= (length vs) (length new-vs)))
          (let*-values
            (((of-u of-v) (warped us vs rows))
             ((new-us rows) (parted us rows (along-v vs) (lambda (i . rest) (vector-ref of-u i))))
             ((new-vs columns) (parted vs (transposed rows) (along-u new-us) (lambda (j . rest) (vector-ref of-v j)))))
            (if (and (= (length us) (length new-us)) (= (length vs) (length new-vs)))
                rows
                (refine new-us new-vs (transposed columns) #f)))
          (refine new-us new-vs (transposed columns) #f)))))

; Calls f at nu+1 by nv+1 places; C checks that the values are points, and names the place of a wrong one. With a
; tolerance, nu and nv are the first steps.
(define (make-surface f #:nu [nu any? #f] #:nv [nv any? #f] #:tolerance [tolerance any? #f]
                        #:closed-u [closed-u any? #f] #:closed-v [closed-v any? #f] . more)
  (define (count name n)
    (cond
      ((not n) (if tolerance 8 (or (current-segments) 64)))
      ((and (exact-integer? n) (<= 1 n 10000)) n)
      (else (error 'make-surface "~a must be an exact integer from 1 to 10000, got ~s" name n))))
  (define (range name x)
    (if (and (real? x) (finite? x)) x (error 'make-surface "~a must be a number and finite, got ~s" name x)))
  (define (sample f u0 u1 v0 v1)
    (if (> (* (+ 1 (count 'nu nu)) (+ 1 (count 'nv nv))) 50000000)
        (error 'make-surface "nu and nv must make at most 50 million points"))
    (if (not (or (not tolerance) (and (real? tolerance) (finite? tolerance) (> tolerance 0))))
        (error 'make-surface "the tolerance must be a positive number, got ~s" tolerance))
    (let ((us (division u0 u1 (count 'nu nu))) (vs (division v0 v1 (count 'nv nv))))
      (if tolerance
          (%make-surface (%rows-within f us vs tolerance) #f #f #f #f #:closed-u closed-u #:closed-v closed-v)
          (%make-surface (map (lambda (u) (map (lambda (v) (f u v)) vs)) us) u0 u1 v0 v1 #:closed-u closed-u #:closed-v closed-v))))
  (define (over f ranges)
    (case (length ranges)
      ((0) (sample f 0 1 0 1))
      ((4) (sample f (range 'u0 (first ranges)) (range 'u1 (second ranges)) (range 'v0 (third ranges)) (range 'v1 (fourth ranges))))
      (else (error 'make-surface "takes (make-surface f [u0 u1 v0 v1]) or (make-surface fx fy fz [u0 u1 v0 v1])"))))
  (define (coordinate name f u v)
    (let ((x (f u v)))
      (if (and (real? x) (finite? x)) x (error (quote make-surface) "~a must give a finite number at (u, v) = (~a, ~a), got ~s" name u v x))))
  (cond
    ((and (procedure? f) (pair? more) (procedure? (car more)))
     (if (or (null? (cdr more)) (not (procedure? (cadr more))))
         (error 'make-surface "fz must be a procedure of u and v, like fx and fy"))
     (let ((fy (car more)) (fz (cadr more)))
       (over (lambda (u v) (xyz (coordinate 'fx f u v) (coordinate 'fy fy u v) (coordinate 'fz fz u v))) (cddr more))))
    ((procedure? f) (over f more))
    ((and (pair? f) (null? more) tolerance)
     (error 'make-surface "a tolerance needs a procedure of u and v: rows of points are taken as they are"))
    ((and (pair? f) (null? more)) (%make-surface f #f #f #f #f #:closed-u closed-u #:closed-v closed-v))
    (else (error 'make-surface "f must be a procedure of u and v, three of them, or a list of rows of points, got ~s" f))))

; ---- lofts ----

; The loft of the thesis: sections (f x), (f (step x)) ... until (stop? x).
(define (make-loft f . rest)
  (if (not (= (length rest) 3))
      (error 'make-loft "takes (make-loft f start step stop?), got ~a argument~a; through sections that are there already: (do-loft (list section ...))" (+ 1 (length rest)) (if (null? rest) "" "s")))
  (%make-loft-of f (first rest) (second rest) (third rest)))
(define (%make-loft-of f start step stop?)
  (%need-procedure 'make-loft 'f f)
  (%need-procedure 'make-loft 'step step)
  (%need-procedure 'make-loft 'stop? stop?)
  (let loop ((x start) (sections '()) (n 0))
    (cond
      ((stop? x) (%make-loft (reverse sections)))
      ((> n 100000) (error 'make-loft "stop? must become true: there are more than 100000 sections, and x is ~s" x))
      (else (loop (step x) (cons (f x) sections) (+ n 1))))))

; ---- operations ----

; Without cutters: returns a procedure that takes them. An empty list of cutters cuts nothing.
(define (subtract a . cutters)
  (if (null? cutters)
      (lambda later (apply %subtract a later))
      (apply %subtract a cutters)))

; ---- drawing ----

(define current-segments
  (make-parameter #f
    (lambda (n)
      (if (or (not n) (and (exact-integer? n) (<= 3 n 100000)))
          n
          (error 'current-segments "n must be an exact integer from 3 to 100000, or #f, got ~s" n)))))
(define current-tolerance
  (make-parameter #f
    (lambda (d)
      (if (or (not d) (and (real? d) (positive? d)))
          d
          (error 'current-tolerance "d must be a positive number, or #f, got ~s" d)))))
(%host-set! 0 (%renamed current-segments 'current-segments))
(%host-set! 1 (%renamed current-tolerance 'current-tolerance))

; the ready materials: their names mean them in every call
(define white 'white)
(define black 'black)
(define concrete 'concrete)
(define plaster 'plaster)
(define steel 'steel)
(define copper 'copper)
(define gold 'gold)
(define glass 'glass)
(define wood 'wood)
(define brick 'brick)
(define stone 'stone)
(define water 'water)
(define grass 'grass)
(define asphalt 'asphalt)

(define-syntax define-parameter
  (syntax-rules ()
    ((_ name default . options) (define name (%define-parameter 'name default . options)))))

; ---- watching a program ----

(define %traced '()) ; (wrapper . procedure) of each traced procedure
(define %trace-depth 0)

(define (%trace name f)
  (define (indent) (display (make-string (* 2 (min %trace-depth 30)) #\space)))
  (define (watched . arguments)
    (indent) (write (cons name arguments)) (newline)
    (let ((result
           (dynamic-wind
             (lambda () (set! %trace-depth (+ %trace-depth 1)))
             (lambda () (apply f arguments))
             (lambda () (set! %trace-depth (- %trace-depth 1))))))
      (indent) (display "=> ") (write result) (newline)
      result))
  (if (not (procedure? f)) (error 'trace "name must be that of a procedure, got ~s" f))
  (if (assq f %traced)
      f
      (begin (set! %traced (cons (cons watched f) %traced)) watched)))

(define (%untrace f) (let ((known (assq f %traced))) (if known (cdr known) f)))

(define-syntax trace (syntax-rules () ((_ name) (define name (%trace 'name name)))))
(define-syntax untrace (syntax-rules () ((_ name) (define name (%untrace name)))))

(define (describe x)
  (define (line . parts) (for-each display parts) (newline))
  (define (size box) (let ((p (first box)) (q (second box))) (list (- (cx q) (cx p)) (- (cy q) (cy p)) (- (cz q) (cz p)))))
  (cond
    ((object? x)
     (line "an object: " (object-kind x) ", of " (object-count x) (if (= (object-count x) 1) " object" " objects"))
     (let ((box (bounding-box x)))
       (if box (begin (line "from " (first box) " to " (second box)) (line "size " (size box)))))
     (if (solid? x) (line "volume " (volume x)))
     (if (or (solid? x) (region? x)) (line "area " (area x)))
     (if (curve? x) (line "length " (curve-length x))))
    ((exact-integer? x) (line "an exact integer: " x))
    ((and (number? x) (exact? x)) (line "an exact fraction: " x ", about " (inexact x)))
    ((real? x) (line "a number: " x))
    ((string? x) (line "a text of " (string-length x) " characters"))
    ((list? x) (line "a list of " (length x) (if (and (pair? x) (every object? x)) " objects" " elements")))
    ((vector? x) (line "a vector of " (vector-length x) " elements"))
    ((point? x) (line "a point: " x))
    ((gvector? x) (line "a gvector: " x ", of length " (vlength x)))
    ((procedure? x) (line "a procedure: " x))
    (else (write x) (newline))))
