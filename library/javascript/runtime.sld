; What a script in JavaScript runs on: the words of its translation (js:...), what every script finds, and the libraries GEO, GUI, IO, MATH and UTL.
(define-library (javascript runtime)
  (export
    ; words of the language
    (rename begin js:begin) (rename define js:define) (rename if js:if) (rename lambda js:lambda) (rename let js:let) (rename letrec js:letrec)
    (rename let-registers js:let-registers) (rename quote js:quote) (rename set! js:set!) (rename any? js:any?)
    (rename + js:+) (rename - js:-) (rename * js:*) (rename / js:/) (rename < js:<) (rename > js:>) (rename <= js:<=) (rename >= js:>=) (rename = js:=)
    (rename eq? js:eq?) (rename not js:not) (rename pair? js:pair?) (rename cdr js:cdr) (rename procedure? js:procedure?) (rename flonum? js:flonum?)
    (rename true js:true) (rename false js:false)
    ; words of the run-time library
    (rename undefined js:undefined) (rename null js:null) (rename hole js:hole) (rename unset js:unset)
    (rename add js:add) (rename js-subtract js:subtract) (rename multiply js:multiply) (rename divide js:divide) (rename js-remainder js:remainder)
    (rename negate js:negate) (rename less js:less) (rename more js:more) (rename less-equal js:less-equal) (rename more-equal js:more-equal)
    (rename same js:same) (rename equal js:equal) (rename bit-or js:bit-or) (rename bit-xor js:bit-xor) (rename bit-and js:bit-and)
    (rename bit-not js:bit-not) (rename shift-left js:shift-left) (rename shift-right js:shift-right) (rename shift-unsigned js:shift-unsigned)
    (rename instance-of js:instance-of) (rename has js:has) (rename nothing? js:nothing?) (rename true? js:true?) (rename to-number js:number)
    (rename to-key js:key) (rename type-of js:type-of) (rename type-of-unknown js:type-of-unknown) (rename get js:get) (rename at js:at)
    (rename js-length js:length) (rename put! js:put!) (rename at-put! js:at-put!) (rename delete! js:delete!) (rename new js:new)
    (rename array js:array) (rename object js:object) (rename push! js:push!) (rename keys js:keys) (rename keys-left js:keys-left)
    (rename key-text js:key-text) (rename not-callable js:not-callable) (rename not-defined js:not-defined) (rename nth js:nth)
    (rename arguments-object js:arguments) (rename throw js:throw) (rename catch js:catch) (rename protect js:protect)
    (rename caught? js:thrown?) (rename throw-again js:throw-again) (rename from-native js:from-native)
    ; what scripts find
    undefined NaN Infinity Object Function Array String Number Boolean Math Error TypeError RangeError ReferenceError SyntaxError EvalError URIError
    isNaN isFinite parseInt parseFloat print console
    geo_box geo_sphere geo_cylinder geo_cone geo_torus geo_hull geo_tetrahedron geo_mesh geo_polygon geo_extrude geo_union geo_intersection
    geo_difference geo_move geo_rotate geo_scale geo_color geo_layer geo_volume geo_area geo_centroid geo_draw
    gui_number gui_choice gui_text (rename gui-number js:gui-number) (rename gui-choice js:gui-choice) (rename gui-text js:gui-text)
    io_stdout_write io_stdout_writeln io_stderr_write
    math_add math_subtract math_scale math_mix math_dot math_length math_normalize math_cross math_radians math_degrees
    utl_range utl_fill utl_is_array utl_copy utl_assert
    ; what the language finds beside them
    from-script to-javascript)
  (import (visualscheme) (javascript core) (scripts))
  (begin (define true #t) (define false #f))
  (include "runtime/values.scm" "runtime/operators.scm" "runtime/builtins.scm" "runtime/native.scm" "runtime/modelling.scm"))
