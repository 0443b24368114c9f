; The words of OpenSCAD: built-in functions and modules, and the procedures of (openscad) that are them.

; ---- built-in functions: a procedure takes any number of values; the name is that of scad:f:name ----

(define builtin-functions (make-hasheq))
(for-each (lambda (f) (hash-set! builtin-functions f (string->symbol (string-append "scad:f:" (symbol->string f)))))
  '(abs sign sin cos tan asin acos atan atan2 floor ceil round sqrt exp ln log pow min max len str chr ord concat lookup search
    norm cross rands version version_num is_undef is_num is_bool is_string is_list is_function parent_module))

; ---- built-in modules: parameters in the order of unnamed arguments; the name is that of scad:m:name ----

(define builtin-modules (make-hasheq))
(for-each (lambda (l) (hash-set! builtin-modules (car l) (cons (string->symbol (string-append "scad:m:" (symbol->string (car l)))) (cdr l))))
  '((cube size center) (sphere r d) (cylinder h r1 r2 center r d d1 d2) (polyhedron points faces convexity triangles)
    (translate v) (rotate a v) (scale v) (mirror v) (multmatrix m) (color c alpha)
    (union) (difference) (intersection) (hull) (render convexity) (group)
    (square size center) (circle r d) (polygon points paths convexity) (offset r delta chamfer)
    (text text size font halign valign spacing direction language script)
    (linear_extrude file layer height origin scale center twist slices convexity) (rotate_extrude file layer origin scale angle convexity)
    (projection cut) (minkowski convexity) (resize newsize auto convexity)
    (import file layer convexity origin scale width height filename layername center dpi) (surface file center convexity invert)))
