; What scripts share with the language: values that cross over, and the libraries GEO, GUI, IO, MATH and UTL.

(define (not-defined name) (reference-error name " is not defined"))

; What native text gives, as a value of the script.
(define (from-native v)
  (cond ((and (number? v) (not (flonum? v))) (inexact v))
        ((and (pair? v) (list? v)) (list->array (map from-native v)))
        ((vector? v) (list->array (map from-native (vector->list v))))
        (else v)))

(define (native-property v key) undefined)
(define (native-text v) (call-with-output-string (lambda (port) (display v port))))
