; Properties: types, one notification a change, chains that come to rest; the scene's events in their order.
(define (show . items) (for-each display items) (newline))
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (show (condition/report-string c)))) e (show "no error")))))
(define told '())
(define (tell . what) (set! told (cons what told)))
(define (told!) (let ((l (reverse told))) (set! told '()) l))
(define p (make-property 'p 1 #:type number?))
(define first-id (property-subscribe p (lambda (v) (tell 'first v))))
(define second-id (property-subscribe p (lambda (v) (tell 'second v))))
(property-set! p 2)
(show (told!))                                   ; expect: ((first 2) (second 2))
(property-set! p 2)
(property-set! p (+ 1 1))
(show (told!))                                   ; expect: ()
(property-emit p)
(show (told!))                                   ; expect: ((first 2) (second 2))
(property-unsubscribe p first-id)
(property-set! p 2.5)
(show (told!))                                   ; expect: ((second 2.5))
(fails (property-set! p "3"))                         ; expect: property-set!: p must satisfy number?, got "3"
(show (property-value p) (told!))                ; expect: 2.5()
(fails (property-unsubscribe p first-id))             ; expect: property-unsubscribe: 1 is no subscription of the property p
(fails (make-property "p" 1))                         ; expect: make-property: name must be a symbol, got "p"
(fails (make-property 'p -1 #:type positive?))        ; expect: make-property: p must satisfy positive?, got -1
(fails (property-value 3))                            ; expect: property-value: property must be a property, got 3

; the engine's parameters: a slider of the host and one of the model follow each other, and the model is updated once a change
(define updates 0)
(define cylinders (make-property 'cylinder 8 #:type integer?))
(define slider (make-property 'slider 8))
(property-subscribe slider (lambda (v) (property-set! cylinders v)))
(property-subscribe cylinders (lambda (v) (property-set! slider v)))
(property-subscribe cylinders (lambda (v) (set! updates (+ updates 1))))
(for ([i (in-range 1000)]) (property-set! slider (+ 9 i)))
(show (list updates (property-value cylinders) (property-value slider))) ; expect: (1000 1008 1008)
(for ([i (in-range 1000)]) (property-set! cylinders (+ 9 i)))
(show (list updates (property-value slider)))    ; expect: (2000 1008)

; changes within a change wait their turn: all hear of the first before any hears of the second
(define q (make-property 'q 0))
(property-subscribe q (lambda (v) (tell 'a v) (if (< v 3) (property-set! q (+ v 1)))))
(property-subscribe q (lambda (v) (tell 'b v)))
(property-set! q 1)
(show (told!))                                   ; expect: ((a 1) (b 1) (a 2) (b 2) (a 3) (b 3))
; subscribers that come and go while it is told
(define r (make-property 'r 0))
(define late #f)
(define never (property-subscribe r (lambda (v) (if (not late) (set! late (property-subscribe r (lambda (v) (tell 'late v))))) (tell 'early v))))
(property-set! r 1)
(property-set! r 2)
(show (told!))                                   ; expect: ((early 1) (early 2) (late 2))
(define s (make-property 's 0))
(define gone #f)
(property-subscribe s (lambda (v) (property-unsubscribe s gone)))
(set! gone (property-subscribe s (lambda (v) (tell 'gone v))))
(property-set! s 1)
(show (told!))                                   ; expect: ()
; two that never agree
(define x (make-property 'x 0))
(define y (make-property 'y 0))
(property-subscribe x (lambda (v) (property-set! y (+ v 1))))
(property-subscribe y (lambda (v) (property-set! x (+ v 1))))
(fails (property-set! x 1))                           ; expect: property-set!: x does not come to rest: its subscribers have changed it 1000 times in one round
; an error in a subscriber reaches who made the change; what waited is dropped, and the next change is told of as ever
(define t (make-property 't 0))
(property-subscribe t (lambda (v) (property-set! p v) (if (= v 1) (car v))))
(fails (property-set! t 1))                           ; expect: car: expected a pair, got 1
(show (told!))                                   ; expect: ()
(property-set! t 2)
(show (told!))                                   ; expect: ((second 2))

; groups
(define g (make-property-group))
(property-add! g p)
(fails (property-add! g (make-property 'p 3)))        ; expect: property-add!: the group has a property p already
(property-put! g 'size 4)
(property-put! g 'p 7)
(show (property-names g) (property-get g 'p) (told!)) ; expect: (p size)7((second 7))
(property-remove! g 'size)
(fails (property-get g 'size))                        ; expect: property-get: the group has no property size; it has (p)
(fails (property-put! g 'p "7"))                      ; expect: property-put!: p must satisfy number?, got "7"
(fails (property-names 3))                            ; expect: property-names: group must be a group of properties, a node or the controller, got 3

; a model's height drives another's
(define table (node-create))
(define chair (node-create #:parent table))
(property-put! table 'height 0.7)
(property-subscribe (property-ref table 'height) (lambda (h) (node-scale chair (/ h 0.7))))
(property-put! table 'height 1.4)
(show (node-getscale chair))                     ; expect: (vxyz 2 2 2)

; events
(for ([name '(Node.create Node.addChild Node.removeChild Node.removeChildren Node.begin Node.end Node.selected)])
  (property-subscribe (property-ref (node-controller) name) (lambda (node) (tell name (node-getname node)))))
(define parent (node-create #:name "parent"))
(define child (node-create #:name "child"))
(node-addchild parent child)
(node-addchild (node-getroot) parent)
(show (told!))                                   ; expect: ((Node.create parent) (Node.create child) (Node.addChild child) (Node.addChild parent))
(node-addchild (node-getroot) child)
(show (told!))                                   ; expect: ((Node.removeChild child) (Node.addChild child))
(node-removechild (node-getroot) child)
(node-removechildren child)
(node-removechildren (node-getroot))
(show (told!))                                   ; expect: ((Node.removeChild child) (Node.removeChildren root))
(with-node parent (node-begin child) (node-end))
(show (told!))                                   ; expect: ((Node.begin parent) (Node.begin child) (Node.end child) (Node.end parent))
(node-begin child)
(node-clear)
(show (told!))                                   ; expect: ((Node.begin child) (Node.end child))
; a subscriber may change the scene: its events follow
(define id (property-subscribe (property-ref (node-controller) 'Node.create)
  (lambda (node) (if (equal? (node-getname node) "house") (node-create #:name "door" #:parent node)))))
(define house (node-create #:name "house"))
(show (told!))                                   ; expect: ((Node.create house) (Node.create door) (Node.addChild door))
(show (length (node-getchildren house)))         ; expect: 1
(property-unsubscribe (property-ref (node-controller) 'Node.create) id)
; many events in one round are no chain that does not come to rest
(define (grow node) (if (equal? (node-getname node) "seed") (for ([i (in-range 3000)]) (node-create))))
(set! id (property-subscribe (property-ref (node-controller) 'Node.create) grow))
(node-create #:name "seed")
(show (length (told!)))                          ; expect: 3001
