; OpenSCAD: the forms that vm/openscad/openscad_reader.c makes of a .scad file, and the procedures of the programs that
; the library (openscad compiler) makes of them.
(define-library (openscad)
  (export scad:program scad:parameter
          (rename begin begin) (rename define define) (rename if if) (rename lambda lambda) (rename let let) (rename let* let*) (rename letrec letrec) (rename quote quote)
          (rename set! set!) (rename eq? eq?) (rename not not) (rename flonum? flonum?) (rename vector vector) (rename cons cons) (rename list list)
          scad:absent scad:add scad:call scad:children scad:divide scad:draw scad:each scad:each-of scad:echo scad:equal?
          scad:f:abs scad:f:acos scad:f:asin scad:f:atan scad:f:atan2 scad:f:ceil scad:f:chr scad:f:concat scad:f:cos
          scad:f:cross scad:f:exp scad:f:floor scad:f:is_bool scad:f:is_function scad:f:is_list scad:f:is_num scad:f:is_string
          scad:f:is_undef scad:f:len scad:f:ln scad:f:log scad:f:lookup scad:f:max scad:f:min scad:f:norm scad:f:ord
          scad:f:parent_module scad:f:pow scad:f:rands scad:f:round scad:f:search scad:f:sign scad:f:sin scad:f:sqrt scad:f:str
          scad:f:tan scad:f:version scad:f:version_num scad:failed scad:finish scad:fold scad:function scad:function?
          scad:in-module scad:index scad:intersection-for scad:join scad:kids scad:kids-count scad:less scad:less-equal
          scad:m:color scad:m:cylinder scad:m:difference scad:m:group scad:m:hull scad:m:intersection scad:m:mirror
          scad:m:multmatrix scad:m:polyhedron scad:m:render scad:m:rotate scad:m:scale scad:m:sphere scad:m:translate
          scad:m:union scad:mark scad:member scad:missing scad:modulo scad:more scad:more-equal scad:multiply scad:parent-modules scad:negate
          scad:no-kids scad:power scad:range scad:range-by scad:real scad:set-special! scad:special scad:special-value scad:start scad:subtract
          scad:too-many scad:true? scad:unknown scad:unknown-argument scad:vector-of scad:with-special
          scad:m:cube scad:m:square scad:m:circle scad:m:polygon scad:m:offset scad:m:text scad:m:linear_extrude scad:m:rotate_extrude
          scad:m:projection scad:m:minkowski scad:m:resize scad:m:import scad:m:surface)
  (import (visualscheme) (only (analysis core) warn) (openscad compiler))
  (begin
    (define-syntax scad:program
      (er-macro-transformer (lambda (form rename compare) (scad-program form rename))))
    ; A parameter that a user may set; a number of the command line becomes a real one.
    (define-syntax scad:parameter
      (syntax-rules ()
        ((_ name value . keywords) (begin (define-parameter name value . keywords) (set! name (scad:real name)))))))
  (include "openscad/values.scm" "openscad/texts.scm" "openscad/functions.scm" "openscad/random.scm" "openscad/modules.scm" "openscad/solids.scm"
           "openscad/plane.scm" "openscad/extrusions.scm" "openscad/files.scm"))
