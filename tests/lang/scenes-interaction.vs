; Gizmos, input events, what is called each frame, viewers; and tools that people build of them.
(define (show . items) (for-each display items) (newline))
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (show (condition/report-string c)))) e (show "no error")))))
(define root (node-getroot))
(define down (vxyz 0 0 -1))
(define (handle gizmo [i any? 0]) (list-ref (data-ref (gizmo-data gizmo) 'handles) i))
(define (mouse kind at) (node-input kind 'left (+z at 50) down))
(define (click gizmo) (mouse 'press (handle gizmo)) (mouse 'release (handle gizmo)))
(define (value gizmo) (property-get gizmo 'value))

; ---- a slider: dragged along its line, in steps, between its ends; one notification a change ----
(define told '())
(define s (make-slider origin (xyz 10 0 0) 0 20 #:value 8 #:step 1 #:parent root))
(property-subscribe (property-ref s 'value) (lambda (v) (set! told (cons v told))))
(show (handle s))                        ; expect: (xyz 4 0 0)
(mouse 'press (handle s))
(mouse 'drag (xyz 4.9 0.05 0))
(mouse 'drag (xyz 4.95 0 0))
(show (value s) " " told)                ; expect: 10 (10)
(mouse 'drag (xyz 99 0 0))
(show (value s))                         ; expect: 20
(mouse 'release (xyz 99 0 0))
(mouse 'drag (xyz 1 0 0))
(show (value s))                         ; expect: 20
(fails (property-set! (property-ref s 'value) 21)) ; expect: property-set!: value must be from 0 to 20 by steps of 1, got 21
(fails (property-set! (property-ref s 'value) 3.5)) ; expect: property-set!: value must be from 0 to 20 by steps of 1, got 3.5
(node-translate s (vxyz 0 5 0))
(show (handle s))                        ; expect: (xyz 10 5 0)

; ---- an arrow, and a tripod whose drags have an end ----
(define a (make-arrow (xyz 30 0 0) ux -2 2 #:parent root))
(mouse 'press (handle a)) (mouse 'drag (+x (handle a) 1.5)) (mouse 'release (handle a))
(show (value a))                         ; expect: 1.5
(mouse 'press (handle a)) (mouse 'drag (+x (handle a) 5)) (mouse 'release (handle a))
(show (value a))                         ; expect: 2
(define t (make-tripod (xyz 0 30 0) (vxyz 3 3 0) #:parent root))
(show (length (data-ref (gizmo-data t) 'handles))) ; expect: 2
(mouse 'press (handle t)) (mouse 'drag (+x (handle t) -99)) (mouse 'release (handle t))
(mouse 'press (handle t 1)) (mouse 'drag (+y (handle t 1) 1)) (mouse 'release (handle t 1))
(show (value t))                         ; expect: (vxyz -3 1 0)
(mouse 'press (handle t)) (mouse 'drag (+x (handle t) -2)) (mouse 'release (handle t))
(show (value t))                         ; expect: (vxyz -5 1 0)

; ---- state is kept and brought back ----
(define kept (gizmo-values))
(show kept)                              ; expect: (20 2 (vxyz -5 1 0))
(property-set! (property-ref s 'value) 3)
(gizmo-values! kept)
(show (value s))                         ; expect: 20
(fails (gizmo-values! '(1)))             ; expect: gizmo-values!: there are 3 gizmos, got 1 values

; ---- the model hides what is behind it; a press selects, a key goes up from there ----
(define picked '())
(define wall (on-pick (make-box (xyz -20 -20 1) (xyz -10 20 2)) (lambda (node hit) (set! picked (cons (cz (data-ref hit 'point)) picked)))))
(define behind (make-trigger (xyz -15 0 0) (lambda (g) (set! picked (cons 'clicked picked))) #:parent root))
(click behind)
(show picked " " (value behind))         ; expect: (2.0) 0
(node-input 'press 'left (xyz -15 0 -9) (vxyz 0 0 1)) (node-input 'release 'left (xyz -15 0 -9) (vxyz 0 0 1))
(show picked " " (value behind))         ; expect: (clicked 2.0) 1
(node-on root 'key (lambda (node key) (set! picked (list key (node-getname node)))))
(node-input 'key 'none #f #f #\a)
(show picked)                            ; expect: (a root)
(node-on wall 'key (lambda (node key) (set! picked (list 'wall key))))
(node-input 'key 'none #f #f #\b)
(show picked)                            ; expect: (wall b)
(node-on wall 'drag (lambda (node from way) (set! picked (list 'dragged (cx from)))))
(mouse 'press (xyz -15 10 0)) (mouse 'drag (xyz -12 10 0)) (mouse 'release (xyz -12 10 0))
(show picked)                            ; expect: (dragged -12.0)
(define heard '())
(define ear (node-create #:parent root))
(node-on ear 'input (lambda (node kind button from way key) (set! heard (cons (list kind button) heard))))
(node-input 'move 'none) (node-input 'press 'right (xyz 500 0 9) down)
(show heard)                             ; expect: ((press right) (move none))
; the nine words of Grimaldo's events: three buttons or none; pressed, released or dragged; a key or none
(set! heard '())
(node-on ear 'input (lambda (node kind button from way key) (set! heard (cons (list kind button key) heard))))
(define up (vxyz 0 0 1))
(for ([button '(left middle right)]) (for ([kind '(press drag release)]) (node-input kind button (xyz 500 0 9) up)))
(node-input 'move 'none (xyz 500 0 9) up)
(node-input 'key 'none #f #f "F1")
(show (reverse heard)) ; expect: ((press left #f) (drag left #f) (release left #f) (press middle #f) (drag middle #f) (release middle #f) (press right #f) (drag right #f) (release right #f) (move none #f) (key none F1))
(fails (node-input 'press 'thumb (xyz 0 0 9) up)) ; expect: node-input: button must be one of (left middle right none), got thumb
(fails (node-input 'wink))               ; expect: node-input: kind must be one of (press drag release move key), got wink
(fails (node-input 'press))              ; expect: node-input: from must be a point of finite coordinates, got #f
(fails (on-pick 5 show))                 ; expect: on-pick: object must be an object or a node, got 5

; ---- each frame; viewers: one is active ----
(define seconds 0)
(define clock (every-frame (lambda (dt) (set! seconds (+ seconds dt)))))
(define seen '())
(define (sees what) (lambda rest (set! seen (cons what seen))))
(register-viewer 'plain #:show (sees 'show) #:hide (sees 'hide) #:prepare (sees 'prepare) #:draw (sees 'draw) #:finish (sees 'finish))
(register-viewer 'other #:show (sees 'other))
(viewer-activate 'plain)
(node-frame 0.25)
(viewer-activate 'other)
(node-frame 0.5)
(node-removechild root clock)
(node-frame 9)
(show seconds " " (reverse seen) " " (viewer-current)) ; expect: 0.75 (show prepare draw finish hide other) other
(fails (viewer-activate 'third))         ; expect: viewer-activate: name must be one of (plain other), got third

; ---- the desk of eight: chairs of one parametrised model, a ninth is an error; clear takes them away ----
(node-clear)
(define (chair height width) (unite (make-box (xyz 0 0 (- height 0.05)) (xyz width width height)) (make-box origin (xyz 0.05 width (* 2 height)))))
(define desk (node-create #:name "desk" #:parent root))
(define shelf (node-create #:name "shelf" #:parent root #:translate (vxyz -5 0 4)))
(define places (map (lambda (i) (vpol 3 (* i pi/4))) (iota 8)))
(property-put! desk 'next 0)
(define height-slider (make-slider (xyz 0 -2 0) (xyz 2 -2 0) 0.3 0.9 #:value 0.45 #:parent shelf))
(define (model-chair h) (node-setdrawing shelf (chair h 0.5)))
(model-chair 0.45)
(property-subscribe (property-ref height-slider 'value) model-chair)
(define (put-on-desk node)
  (define i (property-get desk 'next))
  (if (>= i (length places)) (error 'put-on-desk "the desk has ~a places, and all are taken" (length places)))
  (node-addchild desk node)
  (node-translate node (list-ref places i))
  (property-put! desk 'next (+ i 1)))
(define place-trigger (make-trigger (xyz 0 -4 0) (lambda (g) (put-on-desk (node-create #:drawing (node-getdrawing shelf)))) #:parent shelf))
(for ([i (in-range 4)]) (click place-trigger))
(mouse 'press (handle height-slider)) (mouse 'drag (+x (handle height-slider) 1)) (mouse 'release (handle height-slider))
(show (near? (value height-slider) 0.75)) ; expect: #t
(for ([i (in-range 4)]) (click place-trigger))
(show (length (node-getchildren desk)) " " (length (delete-duplicates (map node-getdrawing (node-getchildren desk))))) ; expect: 8 2
(fails (click place-trigger))            ; expect: put-on-desk: the desk has 8 places, and all are taken
(show (length (node-getchildren desk)))  ; expect: 8
(define clear-trigger (make-trigger (xyz 0 9 0) (lambda (g) (node-removechildren desk) (property-put! desk 'next 0)) #:parent root))
(click clear-trigger) (click place-trigger)
(show (length (node-getchildren desk)))  ; expect: 1

; ---- arrangements: three lamps on three manipulators, stored on three shelves in turn ----
(node-clear)
(define lamps (map (lambda (h) (unite (make-cylinder origin h 0.05) (make-sphere (xyz 0 0 h) 0.2))) '(1 1.5 2)))
(define table (node-create #:parent root))
(define storage (map (lambda (i) (node-create #:name (format "storage ~a" i) #:parent root #:translate (vxyz 20 (* 5 i) 0))) (iota 3)))
(define stored 0)
(define manipulators
  (map (lambda (i)
         (define m (make-tripod (xyz (* 3 i) 0 0) (vxyz 10 10 0) #:parent table))
         (define trans (node-create #:parent table #:translate (vxyz (* 3 i) 0 0)))
         (property-subscribe (property-ref m 'value) (lambda (v) (node-translate trans (v+v v (vxyz (* 3 i) 0 0)))))
         (list m trans))
       (iota 3)))
(define (place lamp) (for-each (lambda (m) (node-create #:drawing lamp #:parent (second m))) manipulators))
(define (store)
  (if (>= stored 3) (error 'store "all shelves are full"))
  (for-each
    (lambda (m)
      (define lamp (node-getchild (second m) 0))
      (node-translate lamp (node-gettranslate (second m)))
      (node-addchild (list-ref storage stored) lamp))
    manipulators)
  (set! stored (+ stored 1)))
(for ([lamp lamps])
  (place lamp)
  (mouse 'press (handle (first (first manipulators)) 1))
  (mouse 'drag (+y (handle (first (first manipulators)) 1) 1))
  (mouse 'release (handle (first (first manipulators)) 1))
  (store))
(show (map (lambda (s) (length (node-getchildren s))) storage)) ; expect: (3 3 3)
(show (map (lambda (s) (cy (node-gettranslate (node-getchild s 0)))) storage) " " (length (node-getchildren (second (first manipulators))))) ; expect: (1.0 2.0 3.0) 0
(show (near? (volume (node-object (second storage))) (* 3 (volume (second lamps))) 1e-2)) ; expect: #t
(fails (store))                          ; expect: store: all shelves are full

; ---- the engine: a model update a change; a host's slider and the model's parameter follow each other for 1,000 moves ----
(node-clear)
(define engine (node-create #:name "engine" #:parent root))
(property-put! engine 'cylinders 8)
(property-put! engine 'angle 45)
(define updates 0)
(define (model-update . ignored)
  (set! updates (+ updates 1))
  (define n (property-get engine 'cylinders))
  (node-setdrawing engine
    (map (lambda (i) (do-rotate (make-cylinder (xyz 0 (* 1.2 (quotient i 2)) 1) 1 0.5) 'y (degrees->radians (if (even? i) (property-get engine 'angle) (- (property-get engine 'angle))))))
         (iota n))))
(for ([name '(cylinders angle)]) (property-subscribe (property-ref engine name) model-update))
(define knob (make-slider (xyz 0 -9 0) (xyz 10 -9 0) 1 2000 #:value 45 #:parent root))
(property-subscribe (property-ref knob 'value) (lambda (v) (property-put! engine 'angle v)))
(property-subscribe (property-ref engine 'angle) (lambda (v) (property-set! (property-ref knob 'value) v)))
(for ([i (in-range 1000)]) (property-set! (property-ref knob 'value) (+ 46 i)))
(show updates " " (property-get engine 'angle)) ; expect: 1000 1045
(property-put! engine 'angle 45)
(show updates " " (value knob) " " (length (node-getdrawing engine))) ; expect: 1001 45 8
(property-put! engine 'cylinders 12)
(show updates " " (length (node-getdrawing engine))) ; expect: 1002 12
