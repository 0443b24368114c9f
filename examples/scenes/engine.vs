; A host for the engine of engine.gml, as in Grimaldo's listing 5.13: the GML program registers its parameters and its procedure model-update at
; the controller; this one gives each parameter a slider. A change of either is one update of the model.
(load "engine.gml")

(define parameters (property-get (node-controller) 'parameters))
(define updates 0)
(define (model-update)
  (set! updates (+ updates 1))
  ((property-get (node-controller) 'model-update)))
(define (parameter-slider name from to low high step)
  (define slider
    (make-slider from to low high #:value (hash-ref parameters name) #:step step #:size 0.3 #:name (symbol->string name)
                 #:parent (node-getroot)))
  (property-subscribe (property-ref slider 'value)
    (lambda (v)
      (hash-set! parameters name v)
      (model-update)))
  slider)
(define angle (parameter-slider 'angle (xyz -3 -4 0) (xyz 3 -4 0) 0 90 #f))
(define cylinders (parameter-slider 'cylinder (xyz -3 -5 0) (xyz 3 -5 0) 2 16 2))
