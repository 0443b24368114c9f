; Listing 4.2 of the VisualScheme thesis: a back-end that draws every object once and copies it from then on.
;
;   vs 4.2-caching.vs -o grid.commands
;
; The back-end writes the commands that a program such as AutoCAD would be sent, one a line, each with the number of the thing it makes; the last
; line counts them. The drawing is the thesis' test (4.4.3): a row of cylinders, copied and moved, and rows of it. The built-in formats do
; as much with the pass share.

(define-parameter side 50 #:min 2 #:max 200 #:label "cylinders along a side")

(define cache #f)
(define made 0)
(define out #f)

(define (command . words)
  (set! made (+ made 1))
  (fprintf out "~a:" made)
  (for-each (lambda (w) (fprintf out " ~a" w)) words)
  (newline out)
  made)

(define (copy-entity obj) (command 'copy obj))
(define (clean-cache) (hash-for-each cache (lambda (object obj) (command 'erase obj))))

(define (draw-primitive object) (apply command (object-kind object) (object-arguments object)))
(define (apply-csg object) (apply command (object-kind object) (map memoized-draw (object-children object))))
(define (apply-operation object)
  (apply command (object-kind object) (memoized-draw (first (object-children object))) (object-arguments object)))

; As printed, but for the name of the dispatcher, which the text calls draw*: draw is the program's own word here.

(define (draw-top-level object)
  (set! cache (make-hash))
  (let ([result (memoized-draw object)])
    (clean-cache) ;; Erases all the template objects in the cache
    result))

(define (memoized-draw object)
  (let ([obj (hash-ref cache object #f)])
    (if obj
        (copy-entity obj)
        (let ([obj (draw* object)])
          (hash-set! cache
                     object
                     (copy-entity obj))
          obj))))

(define (draw* object)
  (case* object
    ;; [predicate? => function-to-apply]
    [primitive? => draw-primitive]
    [csg? => apply-csg]
    [operation? => apply-operation]
    [else (error "no such object:" object)]))

(define-back-end commands "commands"
  (lambda (objects port)
    (set! made 0)
    (set! out port)
    (for-each draw-top-level objects)
    (fprintf port "; ~a commands\n" made))
  #:doc "the commands that a drawing program would be sent")

; ---- the thesis' test ----

(define (row o v)
  (unite o (map (lambda (i) (do-move o (v*r v i))) (range 1 side))))

(draw (row (row (make-cylinder origin 4 1) (vxyz 3 0 0)) (vxyz 0 3 0)))
