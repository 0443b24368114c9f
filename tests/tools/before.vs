; Catches the objects that a model draws, for tests/tools/volume.vs: a program may redefine any name.
(define-parameter samples 20000)
(define drawn-objects '())
(define (draw . objects)
  (set! drawn-objects (append drawn-objects objects))
  (first objects))
