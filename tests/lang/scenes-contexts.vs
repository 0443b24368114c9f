; Contexts: programs of their own, what one reads of another, resources by global and local scope, and programs that know nothing of it.
(define (show . items) (for-each display items) (newline))
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (show (condition/report-string c)))) e (show "no error")))))
(define root (node-getroot))

; ---- a table's height drives its chairs: two programs, written apart ----
(define table (node-create #:name "table" #:parent root))
(define chairs (node-create #:name "chairs" #:parent root))
(node-eval table '(define height 0.75))
(node-eval table '(define (top) (make-box (xyz 0 0 (- height 0.05)) (xyz 2 1 height))))
(node-eval table '(draw (top)))
(node-eval chairs `(define height (* 0.6 ,(node-ref table 'height))))
(node-eval chairs '(define (chair i) (make-box (xyz i -1 0) (xyz (+ i 0.4) -0.6 height))))
(node-eval chairs '(draw (chair 0) (chair 1)))
(show (near? (cz (second (bounding-box (node-object chairs)))) 0.45)) ; expect: #t
(property-put! table 'height 0.75)
(property-subscribe (property-ref table 'height)
  (lambda (h)
    (node-eval table `(begin (set! height ,h) (erase-all) (draw (top))))
    (node-eval chairs `(begin (set! height (* 0.6 (node-ref ,table 'height))) (erase-all) (draw (chair 0) (chair 1))))))
(property-put! table 'height 1.0)
(show (near? (map (lambda (n) (cz (second (bounding-box (node-object n))))) (list table chairs)) '(1.0 0.6))) ; expect: #t
(show (node-ref table 'height) (node-ref chairs 'height)) ; expect: 1.00.6
(fails height)                           ; expect: height is not defined

; ---- resources: the node's own, else those of the nearest node above it, else the root's ----
(define deep (node-create #:parent chairs))
(define loose (node-create))
(property-put! root 'cloth 'red)
(define (cloth node) (let ((p (property-find node 'cloth))) (and p (property-value p))))
(show (map cloth (list root table chairs deep loose))) ; expect: (red red red red red)
(property-put! chairs 'cloth 'blue)
(show (map cloth (list root table chairs deep loose))) ; expect: (red red blue blue red)
(property-put! deep 'cloth 'green)
(node-addchild table deep)
(property-remove! deep 'cloth)
(show (cloth deep))                      ; expect: red
(show (eq? (property-find deep 'cloth) (property-ref root 'cloth)) (property-find deep 'silk)) ; expect: #t#f
; one that is shared tells all that follow it
(define heard 0)
(for ([n (list table deep loose)]) (property-subscribe (property-find n 'cloth) (lambda (v) (set! heard (+ heard 1)))))
(property-put! root 'cloth 'white)
(show heard)                             ; expect: 3
(fails (property-find 'table 'cloth))    ; expect: property-find: node must be a node, got table
(fails (property-find table "cloth"))    ; expect: property-find: name must be a symbol, got "cloth"

; ---- an old program draws in the root, whose focus it always has ----
(define before (length (node-getdrawing root)))
(draw (make-box (xyz 0 0 0) (xyz 1 1 1)))
(show (- (length (node-getdrawing root)) before) " " (eq? (node-current) root) " " (length (drawing))) ; expect: 1 #t 1

; ---- a drawing that takes another's place: what was drawn before is not said to be thrown away ----
(define (update n) (node-setdrawing root (map (lambda (i) (make-box (xyz i 0 0) (xyz (+ i 0.5) 1 n))) (iota n))) n)
(update 2)
(update 3)
(show (length (node-getdrawing root)))   ; expect: 3
