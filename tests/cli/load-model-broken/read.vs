(define-parameter count 60 #:min 1 #:max 100000)
(define (right? text name)
  (and (string-prefix? text "load-model: ") (string-contains? text name) (not (string-contains? text "\n"))))
(define (try ending)
  (let ([read 0] [refused 0])
    (for ([i count])
      (let* ([name (format "~a.~a" i ending)] [why (guard (e [#t (condition/report-string e)]) (load-model name) #f)])
        (cond [(not why) (set! read (+ read 1))]
              [(right? why name) (set! refused (+ refused 1))]
              [else (displayln (list name why))])))
    (displayln (list ending (= count (+ read refused)) (and (> read 0) (> refused 0))))))
(for-each try '("glb" "3mf" "x3d"))
