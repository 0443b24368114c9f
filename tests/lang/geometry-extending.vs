; Kinds of the program's own, drawing functions, native text, and the dresses.
(define (say . all) (for-each display all) (newline))
(define (fails thunk) (guard (e (#t (say (condition/report-string e)))) (thunk)))

; with a body: the object is what the body gives, and remembers
(define-primitive (slab [w positive?] [t positive? 0.5])
  (define corner (xyz w w t))
  (make-box origin corner))
(define s (slab 4))
(say (slab? s) (slab? (make-box origin (xyz 1 1 1))) (slab? 5) " " (slab-w s) " " (slab-t s)) ; expect: #t#f#f 4 0.5
(say (volume s) " " (solid? s) " " (bounding-box s)) ; expect: 8.0 #t ((xyz 0 0 0) (xyz 4 4 0.5))
(say s " " (object-kind s) " " (object-arguments s) " " (object-children s)) ; expect: (slab 4 0.5) slab (4 0.5) ((make-box (xyz 0 0 0) (xyz 4 4 0.5)))
(say (equal? s (slab 4 0.5)) (equal? s (slab 4 1)) (equal? s (make-box origin (xyz 4 4 0.5)))) ; expect: #t#f#f
(say (volume (subtract s (do-move s (vxyz 2 0 0)))) " " (contains? s (xyz 1 1 0.1))) ; expect: 4.0 #t
(fails (lambda () (slab -1))) ; expect: slab: w must be positive?, got -1
(fails (lambda () (slab))) ; expect: slab needs 1 to 2 arguments (w [t]), got 0
(fails (lambda () (slab-w (make-box origin (xyz 1 1 1))))) ; expect: slab-w: o must be an object of the kind slab, got (make-box (xyz 0 0 0) (xyz 1 1 1))

; a body may give a list, use its own kind, take keywords; what it gives must be objects
(define-primitive (stack n #:step [step positive? 1])
  (if (= n 0) '() (list (make-box origin (xyz 1 1 0.5)) (do-move (stack (- n 1) #:step step) (vxyz 0 0 step)))))
(say (volume (stack 4)) " " (stack-step (stack 2 #:step 3)) " " (bounding-box (stack 3 #:step 2))) ; expect: 2.0 3 ((xyz 0 0 0) (xyz 1 1 4.5))
(define-primitive (wrong x) x)
(fails (lambda () (wrong 5))) ; expect: wrong: its body must give an object or a list of objects, got 5

; with fields: any values; a drawing function says what it is
(define-primitive spiral f start stop?)
(define sp (make-spiral (lambda (x) (make-box (xyz x 0 0) (xyz (+ x 1) 1 1))) 0 (lambda (x) (> x 4))))
(say (spiral? sp) (procedure? (spiral-f sp)) (spiral-start sp) " " (object-kind sp) (object? sp)) ; expect: #t#t0 spiral#t
(fails (lambda () (volume sp))) ; expect: volume: spiral has no drawing function: (register-drawing-function spiral? ...) gives it one
(fails (lambda () (bounding-box (unite s (do-move sp ux))))) ; expect: bounding-box: spiral has no drawing function: (register-drawing-function spiral? ...) gives it one
(register-drawing-function spiral?
  (lambda (o) (let loop ([x (spiral-start o)] [made '()]) (if ((spiral-stop? o) x) made (loop (+ x 2) (cons ((spiral-f o) x) made))))))
(say (volume sp) " " (object-count sp) " " (bounding-box (do-move sp (vxyz 0 0 5)))) ; expect: 3.0 3 ((xyz 0 0 5) (xyz 5 1 6))
(say (volume (subtract (make-box origin (xyz 5 1 1)) sp))) ; expect: 2.0
(say (contains? sp (xyz 0.5 0.5 0.5)) (contains? sp (xyz 1.5 0.5 0.5))) ; expect: #t#f

; two kinds of one name are two
(define old-slab? slab?)
(define-primitive (slab w) (make-sphere origin w))
(say (slab? (slab 1)) (slab? s) (old-slab? s)) ; expect: #t#f#t

; the newest function first; what it gives is gone through in turn, but the object itself stays in there
(define-primitive twig depth)
(register-drawing-function twig?
  (lambda (o) (let ([d (twig-depth o)] [b (make-box origin (xyz 1 1 1))]) (if (= d 0) b (unite b (do-move (make-twig (- d 1)) (vxyz 2 0 0)))))))
(say (volume (make-twig 9)) " " (object-count (make-twig 9))) ; expect: 10.0 10
(register-drawing-function (lambda (o) (and (twig? o) (= (twig-depth o) 0))) (lambda (o) (make-box origin (xyz 1 1 5))))
(say (volume (make-twig 9))) ; expect: 14.0
(define-primitive thing name)
(register-drawing-function thing? (lambda (o) (color "red" o)))
(fails (lambda () (volume (make-thing "a")))) ; expect: volume: thing has no drawing function: (register-drawing-function thing? ...) gives it one
(register-drawing-function thing? (lambda (o) 'nothing))
(fails (lambda () (volume (make-thing "a")))) ; expect: the drawing function of thing: it must give an object or a list of objects, got nothing
(fails (lambda () (register-drawing-function 5 5))) ; expect: register-drawing-function: pred must be a procedure of one argument, got 5
(fails (lambda () (register-drawing-function "povray" thing? list))) ; expect: register-drawing-function: back-end must be the name of a format, such as 'povray, 'openscad or 'stl, got "povray"

; what a sum of a hundred thousand of them leaves behind is little, and theirs is found again
(define-primitive pin x)
(define kept (make-pin 7))
(do ((i 0 (+ i 1))) ((= i 30000)) (make-pin (list i i)))
(say (pin-x kept) (equal? kept (make-pin 7))) ; expect: 7#t

; native text
(define n (native 'povray "sphere { 0, 1 }" #:otherwise (make-box origin (xyz 1 1 1))))
(say n " " (volume n) (solid? n)) ; expect: (native 'povray "sphere { 0, 1 }" #:otherwise (make-box (xyz 0 0 0) (xyz 1 1 1))) 1.0#t
(say (object-kind n) (object-arguments n) (length (object-children n)) (equal? n (native 'povray "sphere { 0, 2 }" #:otherwise (make-box origin (xyz 1 1 1))))) ; expect: native(povray sphere { 0, 1 })1#f
(define (tries target text) (fails (lambda () (native target text) (say "taken"))))
(tries 'povray "sphere { 0, 1 /* } */ } // }\n")  ; expect: taken
(tries 'povray "text { ttf \"a}b.ttf\" \"}\\\"}\" 1, 0 }")  ; expect: taken
(tries 'povray "#if (1) sphere { 0, 1 } #else box { 0, 1 } #end")  ; expect: taken
(tries 'openscad "cube([1, 2, 3]);")  ; expect: taken
(tries 'povray "sphere { 0, 1 }}")  ; expect: native: text must be text for povray whose brackets match, got "sphere { 0, 1 }}"
(tries 'povray "sphere { (0, 1 } )")  ; expect: native: text must be text for povray whose brackets match, got "sphere { (0, 1 } )"
(tries 'povray "#while (1) sphere { 0, 1 }")  ; expect: native: text must be text for povray whose #if and #end match, got "#while (1) sphere { 0, 1 }"
(tries 'povray "#end")  ; expect: native: text must be text for povray whose #if and #end match, got "#end"
(tries 'povray "box { 0, 1 } /* ")  ; expect: native: text must be text for povray whose comments end, got "box { 0, 1 } /* "
(tries 'povray "box { 0, 1 } */")  ; expect: native: text must be text for povray whose comments begin, got "box { 0, 1 } */"
(tries 'povray "text { \"a }")  ; expect: native: text must be text for povray whose strings end, got "text { \"a }"
(tries 'openscad "cube(1); // all")  ; expect: native: text must be text for openscad whose last line is no comment, got "cube(1); // all"
(tries 'stl "solid")  ; expect: native: target must be one of 'povray 'openscad, got stl
(fails (lambda () (native 'povray "" #:otherwise 5))) ; expect: native: otherwise must be an object or a list of objects, got 5

; dresses
(define box (make-box origin (xyz 2 2 2)))
(say (volume (highlight box)) (volume (only box)) (volume (ghost box)) " " (area (only box)) " " (object-count (ghost box))) ; expect: 8.08.00.0 24.0 0
(say (volume (subtract box (ghost (make-box origin (xyz 1 1 1))))) (volume (subtract box (highlight (make-box origin (xyz 1 1 1)))))) ; expect: 8.07.0
(say (curve? (highlight (make-circle origin 1))) (volume (do-extrude (only (make-rectangle (xy 0 0) (xy 1 2))) 3))) ; expect: #t6.0
(say (highlight box (ghost box)) (object-kind (only box))) ; expect: (highlight (unite (make-box (xyz 0 0 0) (xyz 2 2 2)) (ghost (make-box (xyz 0 0 0) (xyz 2 2 2)))))only
