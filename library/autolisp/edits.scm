; The commands that move, copy and turn objects, and those that set layers and colours.

(define (changed! l f) (for-each (lambda (e) (set-entity-object! e (f (entity-object e)))) l) #f)
(define (copies! l f) (for-each (lambda (e) (copied! e (f (entity-object e)))) l) #f)
(define (moves v) (lambda (o) (do-move o v)))
(define (turns p v a) (lambda (o) (do-rotate o p v a)))
(define vertical (vxyz 0 0 1))

; Asks for a base point and a second one; next gets the vector between them.
(define (asks-vector next)
  (define (from-origin p) (p->q (xyz 0 0 0) p))
  (asks "a base point" as-point
    (lambda (p) (asks "a second point" as-point (lambda (q) (next p (p->q p q))) (option "" (next p (from-origin p)))))
    (option "Displacement" (asks "a displacement" as-point (lambda (p) (next p (from-origin p)))))))
(define-command '("MOVE" "M") (asks-objects (lambda (l) (asks-vector (lambda (p v) (changed! l (moves v)))))))
(define-command '("COPY" "CO" "CP")
  (asks-objects
    (lambda (l)
      (define (more p)
        (asks "a further point" as-point (lambda (q) (copies! l (moves (p->q p q))) (more p))
          (option "" #f) (option "Exit" #f) (cons 'end #f)))
      (define (start) (asks-vector (lambda (p v) (copies! l (moves v)) (more p))))
      (let ((q (start)))
        (make-question (question-what q)
          (append (question-options q) (list (option "Multiple" (start)) (option "mOde" (asks "a mode" as-text (lambda (m) (start))))))
          (question-convert q) (question-next q))))))
(define-command '("ERASE" "E") (asks-objects (lambda (l) (for-each erased! l) #f)))

; Asks for an angle about the vector v through p, and turns the objects.
(define (asks-turn l p v)
  (define (angle turn!)
    (asks "an angle" (as-degrees-from p) (lambda (a) (turn! l (turns p v a)))
      (option "Copy" (angle copies!))
      (option "Reference"
        (asks "the angle of reference" (as-degrees-from p)
          (lambda (from) (asks "the new angle" (as-degrees-from p) (lambda (to) (turn! l (turns p v (- to from))))))))))
  (angle changed!))
(define-command '("ROTATE" "RO") (asks-objects (lambda (l) (asks "a base point" as-point (lambda (p) (asks-turn l p vertical))))))
(define-command '("ROTATE3D" "3DROTATE")
  (asks-objects
    (lambda (l)
      (define (along v) (option-asks-point (lambda (p) (asks-turn l p v))))
      (define (two-points)
        (asks "a point of the axis" as-point (lambda (p) (asks "a second point of the axis" as-point (lambda (q) (asks-turn l p (p->q p q)))))
          (option "Xaxis" (along (vxyz 1 0 0))) (option "Yaxis" (along (vxyz 0 1 0))) (option "Zaxis" (along vertical))
          (option "2points" (two-points))))
      (two-points))))
(define (option-asks-point next) (asks "a point" as-point next (option "" (next (xyz 0 0 0)))))

; Asks whether the originals go, and mirrors the objects in the plane.
(define (asks-deletion l plane)
  (define (mirrored o) (do-mirror o plane))
  (asks "Yes or No" (lambda (v) #f) (lambda (v) #f)
    (option "Yes" (changed! l mirrored)) (option "No" (copies! l mirrored)) (option "" (copies! l mirrored))))
(define-command '("MIRROR" "MI")
  (asks-objects (lambda (l) (asks "a point" as-point (lambda (p) (asks "a point" as-point
    (lambda (q) (asks-deletion l (make-plane p (cross (p->q p q) vertical))))))))))
(define-command '("MIRROR3D" "3DMIRROR")
  (asks-objects
    (lambda (l)
      (define (across v) (option-asks-point (lambda (p) (asks-deletion l (make-plane p v)))))
      (define (three)
        (asks "a point of the plane" as-point
          (lambda (p) (asks "a second point" as-point (lambda (q) (asks "a third point" as-point
            (lambda (r) (asks-deletion l (make-plane p q r)))))))
          (option "XY" (across vertical)) (option "YZ" (across (vxyz 1 0 0))) (option "ZX" (across (vxyz 0 1 0)))
          (option "3points" (three)) (option "" (three))))
      (three))))
(define-command '("SCALE" "SC")
  (asks-objects
    (lambda (l)
      (asks "a base point" as-point
        (lambda (p)
          (define (factor scale!)
            (define (scaled k)
              (if (> k 0) (scale! l (lambda (o) (do-scale o p k))) (error 'command "SCALE needs a factor above 0, got ~a" (shown k))))
            (asks "a factor" (as-length-from p) scaled
              (option "Copy" (factor copies!))
              (option "Reference"
                (asks "the length of reference" (as-length-from p)
                  (lambda (from) (asks "the new length" (as-length-from p) (lambda (to) (scaled (/ to (if (= from 0) 1 from))))))))))
          (factor changed!))))))

; ---- arrays ----

(define (grid! l rows columns levels dy dx dz)
  (do ((k 0 (+ k 1))) ((= k levels) #f)
    (do ((i 0 (+ i 1))) ((= i rows))
      (do ((j 0 (+ j 1))) ((= j columns))
        (if (not (= 0 i j k)) (copies! l (moves (vxyz (* j dx) (* i dy) (* k dz)))))))))
; Copies the objects around the axis, so that there are n of each. In a full turn, the first and the last do not coincide.
; turned? #f: the copies keep their direction.
(define (ring! l p v n angle turned?)
  (let ((step (if (< (abs (- (abs angle) 2pi)) 1e-9) (/ angle n) (/ angle (max 1 (- n 1))))))
    (do ((i 1 (+ i 1))) ((= i n) #f)
      (let ((turn (turns p v (* i step))))
        (for-each
          (lambda (e)
            (let* ((o (entity-object e)) (c (or (and (bounding-box o) (apply mid (bounding-box o))) p)))
              (copied! e (if turned? (turn o) (do-rotate (turn o) (centre-turned c p v (* i step)) v (- (* i step)))))))
          l)))))
; Returns c, turned about the axis.
(define (centre-turned c p v a)
  (let* ((u (unitize v)) (d (p->q p c)) (up (v*r u (dot u d))) (x (v-v d up)) (y (cross u x)))
    (p+v p (v+v up (v+v (v*r x (cos a)) (v*r y (sin a)))))))
(define (asks-distance when what next) (if when (asks what as-number next) (next 0)))
(define (asks-full-turn next) (asks "an angle" as-degrees (lambda (a) (next (if (= a 0) 2pi a))) (option "" (next 2pi))))
(define (asks-turned next)
  (asks "Yes or No" (lambda (v) #f) (lambda (v) #f) (option "Yes" (next #t)) (option "No" (next #f)) (option "" (next #t))))
(define-command '("ARRAY" "AR")
  (asks-objects
    (lambda (l)
      (define (rectangular)
        (asks "the number of rows" as-count (lambda (rows) (asks "the number of columns" as-count (lambda (columns)
          (asks-distance (> rows 1) "the distance of rows" (lambda (dy)
            (asks-distance (> columns 1) "the distance of columns" (lambda (dx) (grid! l rows columns 1 dy dx 0))))))))))
      (define (polar)
        (asks "a centre" as-point (lambda (p) (asks "the number of objects" as-count (lambda (n)
          (asks-full-turn (lambda (a) (asks-turned (lambda (turned?) (ring! l p vertical n a turned?)))))))))) 
      (asks "Rectangular or Polar" (lambda (v) #f) (lambda (v) #f)
        (option "Rectangular" (rectangular)) (option "Polar" (polar)) (option "" (rectangular))))))
(define-command '("3DARRAY" "3A")
  (asks-objects
    (lambda (l)
      (define (rectangular)
        (asks "the number of rows" as-count (lambda (rows) (asks "the number of columns" as-count (lambda (columns)
          (asks "the number of levels" as-count (lambda (levels)
            (asks-distance (> rows 1) "the distance of rows" (lambda (dy)
              (asks-distance (> columns 1) "the distance of columns" (lambda (dx)
                (asks-distance (> levels 1) "the distance of levels" (lambda (dz)
                  (grid! l rows columns levels dy dx dz))))))))))))))
      (define (polar)
        (asks "the number of objects" as-count (lambda (n) (asks-full-turn (lambda (a) (asks-turned (lambda (turned?)
          (asks "a centre" as-point (lambda (p) (asks "a second point of the axis" as-point (lambda (q)
            (ring! l p (p->q p q) n a turned?))))))))))))
      (asks "Rectangular or Polar" (lambda (v) #f) (lambda (v) #f)
        (option "Rectangular" (rectangular)) (option "Polar" (polar)) (option "" (rectangular))))))

; ---- entities from lists of pairs (code . value), as DXF has them ----

(define (:entmake data)
  (define all (need-list 'entmake data))
  (define (field code)
    (let ((f (find (lambda (f) (and (pair? f) (eqv? (car f) code))) all)))
      (if f (cdr f) (error 'entmake "the entity has no group ~a" code))))
  (define (given code other) (if (find (lambda (f) (and (pair? f) (eqv? (car f) code))) all) (field code) other))
  (define (point code) (need-point 'entmake (field code)))
  (define (real code) (need-number 'entmake (field code)))
  (define vertices
    (map (lambda (f) (need-point 'entmake (cdr f))) (filter (lambda (f) (and (pair? f) (eqv? (car f) 10))) all)))
  ; The groups 93, count, and 90, an item each, are the faces of a mesh: the count of corners, then their numbers from 0.
  (define (faces)
    (define (refuse-face) (error 'entmake "a face of a mesh needs at least 3 corners"))
    (define (face l left corners made)
      (cond ((= left 0) (all-faces l (cons (reverse corners) made)))
            ((null? l) (refuse-face))
            (else (face (cdr l) (- left 1) (cons (+ 1 (need-whole 'entmake (car l))) corners) made))))
    (define (all-faces l made)
      (cond ((null? l) (reverse made))
            ((and (exact-integer? (car l)) (>= (car l) 3)) (face (cdr l) (car l) '() made))
            (else (refuse-face))))
    (all-faces (map cdr (take-at-most (need-whole 'entmake (field 93)) (groups 90))) '()))
  (define (groups code) (filter (lambda (f) (and (pair? f) (eqv? (car f) code))) all))
  (define (take-at-most n l) (take l (max 0 (min n (length l)))))
  (define object
    (case (string->symbol (string-upcase (need-string 'entmake (field 0))))
      ((LINE) (make-line (point 10) (point 11)))
      ((CIRCLE) (make-circle (point 10) (real 40)))
      ((ARC) (let ((a (real 50)) (b (real 51))) (make-arc (point 10) (real 40) a (if (<= b a) (+ b 2pi) b))))
      ((3DFACE) (make-3dface (point 10) (point 11) (point 12) (need-point 'entmake (given 13 (field 12)))))
      ((LWPOLYLINE) (path vertices (odd? (need-whole 'entmake (given 70 0)))))
      ((MESH) (make-polyface-mesh vertices (faces)))
      (else (error 'entmake "LINE, CIRCLE, ARC, 3DFACE, LWPOLYLINE or MESH is needed, got ~a" (shown (field 0))))))
  (let ((before current-layer))
    (set! current-layer (need-string 'entmake (given 8 current-layer)))
    (made! object)
    (set! current-layer before)
    all))

; ---- layers and colours: names, or numbers from 1 to 7 ----

(define color-names '("red" "yellow" "green" "cyan" "blue" "magenta" "white"))
(define (as-color v)
  (let ((n (as-number v)))
    (cond ((and n (exact-integer? n) (<= 1 n 7)) (list-ref color-names (- n 1)))
          ((and (string? v) (member (string-downcase v) color-names)) (string-downcase v))
          (else #f))))
(define (asks-layer)
  (define (named next) (asks "a layer's name" as-text (lambda (n) (next n) (asks-layer))))
  (asks "an option" (lambda (v) #f) (lambda (v) #f)
    (option "Make" (named (lambda (n) (set! current-layer n))))
    (option "Set" (named (lambda (n) (set! current-layer n))))
    (option "New" (named (lambda (n) n)))
    (option "Color"
      (asks "a colour, a name or a number from 1 to 7" as-color
        (lambda (c)
          (define (paint n) (for-each (lambda (n) (hash-set! layer-colors n c)) (string-split n ",")) (asks-layer))
          (asks "a layer's name" as-text (lambda (n) (paint (if (string=? n "") current-layer n)))))))
    (option "ON" (named (lambda (n) n))) (option "OFF" (named (lambda (n) n)))
    (option "Thaw" (named (lambda (n) n))) (option "Freeze" (named (lambda (n) n)))
    (option "LOck" (named (lambda (n) n))) (option "Unlock" (named (lambda (n) n)))
    (option "Ltype" (asks "a line type" as-text (lambda (t) (named (lambda (n) n)))))
    (option "" #f)))
(define-command '("LAYER" "LA") (asks-layer))
(define-command '("COLOR" "COLOUR" "COL")
  (asks "a colour, a name or a number from 1 to 7" as-color (lambda (c) (set! current-color c) #f)
    (option "BYLayer" (set! current-color #f) #f)))

; ---- properties of objects, and conversions ----

; Returns the colour of a text "red,green,blue", whose numbers are 0 to 255, or #f.
(define (as-true-color v)
  (define (byte? n) (and (exact-integer? n) (<= 0 n 255)))
  (define (hex n) (string-append (if (< n 16) "0" "") (number->string n 16)))
  (let ((parts (if (string? v) (map string->number (string-split v ",")) '())))
    (and (= (length parts) 3) (every byte? parts) (apply string-append "#" (map hex parts)))))
(define-command '("CHPROP")
  (asks-objects
    (lambda (l)
      (define (each set! v) (for-each (lambda (e) (set! e v)) l) (property))
      (define (paint c) (each set-entity-color! c))
      (define (property)
        (asks "a property" (lambda (v) #f) (lambda (v) #f)
          (option "Color"
            (asks "a colour, a name or a number from 1 to 7" as-color paint
              (option "Truecolor" (asks "three numbers, red,green,blue" as-true-color paint))
              (option "BYLayer" (paint #f))))
          (option "LAyer" (asks "a layer's name" as-text (lambda (n) (each set-entity-layer! n))))
          (option "" #f)))
      (property))))
; Meshes are solids here if they are closed.
(define-command '("CONVTOSOLID")
  (asks-objects
    (lambda (l)
      (for-each (lambda (e) (if (not (solid? (entity-object e))) (error 'command "CONVTOSOLID needs closed meshes"))) l)
      #f)))
; The coordinates of the user stay those of the world.
(define-command '("UCS")
  (asks "World or Previous" (lambda (v) #f) (lambda (v) #f) (option "World" #f) (option "Previous" #f) (option "" #f)))

; ---- commands that change only the view: their answers, up to the end of the call, are ignored ----

(define (ignoring) (asks "anything" (lambda (v) #t) (lambda (v) (ignoring)) (cons 'end #f) (option "" (ignoring))))
(define-command '("ZOOM" "Z" "PAN" "VPOINT" "VIEW" "SHADEMODE" "VSCURRENT" "HIDE" "REGEN" "REGENALL" "REDRAW" "UNDO" "OSNAP"
                 "GRID" "SNAP" "ORTHO" "PLAN" "SHADE" "RENDER" "UCSICON" "OSMODE" "CMDECHO")
  (ignoring))
