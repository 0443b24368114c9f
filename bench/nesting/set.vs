; Packs the parts of a published set on sheets: bench/nesting/run.sh. With -D task=peer, prints the set for peer.cc.
(define-parameter set "shapes0.json")
(define-parameter task "pack" #:choices '("pack" "peer"))
(define-parameter effort 1.0 #:min 0 #:max 100)

(define data (load-json set))
(define items (vector->list (data-ref data 'items)))
(define (corners item)
  (define l (map (lambda (p) (xy (vector-ref p 0) (vector-ref p 1))) (vector->list (data-ref item 'shape 'data))))
  (if (near? (first l) (last l)) (rest l) l))
(define regions (map (lambda (i) (make-region (make-polygon (corners i)))) items))
(define counts (map (lambda (i) (data-ref i 'demand)) items))
(define turns (vector->list (data-ref (first items) 'allowed_orientations)))
(define (total l) (apply + l))
(define whole (total (map * counts (map area regions))))

; Sheets as high as the set's strip. The parts have the area of 1.2 sheets.
(define height (data-ref data 'strip_height))
(define (extent o) (let ((b (bounding-box o))) (- (cx (second b)) (cx (first b)))))
(define width (max (/ whole height 1.2) (* 1.001 (apply max (map extent regions)))))

(define (for-peer)
  (printf "~a ~a ~a ~a~%" width height (length turns) (string-join (map number->string turns) " "))
  (printf "~a~%" (length items))
  (for ([i items] [n counts])
    (define l (corners i))
    (printf "~a ~a ~a~%" n (length l) (string-join (map (lambda (p) (format "~a ~a" (cx p) (cy p))) l) " "))))

; The area that parts of a sheet share, by the kernel.
(define (shared sheet)
  (- (total (map area sheet)) (area (apply unite sheet))))

(define (pack)
  (define start (current-milliseconds))
  (define sheets (pack-parts regions #:sheet (list width height) #:count counts #:turn (map degrees->radians turns) #:effort effort))
  (define seconds (/ (- (current-milliseconds) start) 1000.0))
  (define box (bounding-box (last sheets)))
  (define-values (low high) (values (first box) (second box)))
  (define filled (min (* height (- (cx high) (cx low))) (* width (- (cy high) (cy low)))))
  (define (tenths x) (/ (round (* 10 x)) 10))
  (printf "pack-parts\t~a\t~a\t~a\t~a~%" (length sheets)
          (tenths (/ (* 100 whole) (+ (* (- (length sheets) 1) width height) filled)))
          (/ (round (* 1e6 (/ (total (map shared sheets)) whole))) 1e4) (tenths seconds)))

(if (equal? task "peer") (for-peer) (pack))
