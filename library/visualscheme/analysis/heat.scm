; Heat: thermal transmittance of layers (EN ISO 6946), and the monthly balance of a heated building (EN ISO 13790 and
; EN ISO 52016-1, monthly method).

; Returns the thermal resistance of a layer: of thickness in m and conductivity in W/mK, or a resistance in m2K/W itself.
(define (layer-resistance l)
  (cond
    ((positive-number? l) l)
    ((and (list? l) (= (length l) 2) (every positive-number? l))
     (if (> (first l) 3) (warn (format "u-value: a layer is ~a m thick: metres are expected, 1 mm is 0.001 m" (first l))))
     (if (> (second l) 500) (warn (format "u-value: a conductivity of ~a W/mK is higher than copper's: W/mK are expected" (second l))))
     (/ (first l) (second l)))
    (else (error 'u-value "a layer must be (list thickness conductivity) in m and W/mK, or a resistance in m2K/W, got ~s" l))))

(define (u-value layers #:inner [inner any? 0.13] #:outer [outer any? 0.04])
  (if (not (and (list? layers) (pair? layers))) (error 'u-value "layers must be a list of lists of a thickness and a conductivity, got ~s" layers))
  (for-each (lambda (name x) (if (not (and (real? x) (finite? x) (>= x 0))) (error 'u-value "~a must be a resistance of 0 or more, got ~s" name x))) '(inner outer) (list inner outer))
  (/ 1 (fold (lambda (l sum) (+ sum (layer-resistance l))) (+ inner outer) layers)))

; ---- the monthly balance ----

(define month-days '(31 28 31 30 31 30 31 31 30 31 30 31))

(define (need-numbers who name l n)
  (if (not (and (list? l) (or (not n) (= (length l) n)) (every (lambda (x) (and (real? x) (finite? x))) l)))
      (error who "~a must be a list of ~a numbers, got ~s" name (or n "") l)))

; Returns the part of the gains that replaces heating: of the ratio of gains to losses, and of the building's inertia.
(define (gain-use ratio a)
  (cond ((<= ratio 0) 1) ((near? ratio 1 1e-9) (/ a (+ a 1))) (else (/ (- 1 (expt ratio a)) (- 1 (expt ratio (+ a 1)))))))

(define (need-surface who s)
  (if (not (and (list? s) (<= 2 (length s) 3) (every (lambda (x) (and (real? x) (>= x 0))) s)))
      (error who "a surface must be (list area u-value) or (list area u-value factor), got ~s" s)))
; Returns the loss through surfaces in W/K.
(define (transmission-of surfaces) (fold (lambda (s sum) (+ sum (* (first s) (second s) (if (pair? (cddr s)) (third s) 1)))) 0 surfaces))

; surfaces: lists of area, U and, for an unheated side, a factor; windows: lists of area, g and the irradiation on their plane
; in each month, in kWh/m2
(define (heat-balance #:surfaces [surfaces any? '()] #:windows [windows any? '()] #:volume [volume any? 0] #:air-changes [changes any? 0.5] #:outside [outside any? #f]
                      #:inside [inside any? 20] #:internal [internal any? 0] #:capacity [capacity any? 0])
  (need-numbers 'heat-balance 'outside outside 12)
  (for-each (lambda (name x) (need-number 'heat-balance name x)) '(inside) (list inside))
  (for-each (lambda (name x) (if (not (and (real? x) (finite? x) (>= x 0))) (error 'heat-balance "~a must be a number of 0 or more, got ~s" name x)))
    '(volume air-changes internal capacity) (list volume changes internal capacity))
  (for-each (lambda (name l) (if (not (list? l)) (error 'heat-balance "~a must be a list, got ~s" name l))) '(surfaces windows) (list surfaces windows))
  (for-each (lambda (s) (need-surface 'heat-balance s)) surfaces)
  (for-each (lambda (w)
              (if (not (and (list? w) (= (length w) 3) (positive-number? (first w)) (real? (second w)) (<= 0 (second w) 1))) (error 'heat-balance "a window must be (list area g irradiations), got ~s" w))
              (need-numbers 'heat-balance "a window's irradiation" (third w) 12))
    windows)
  (let* ((transmission (transmission-of surfaces))
         (ventilation (/ (* 1200 volume changes) 3600)) ; 1200 J/m3K is the heat capacity of air
         (a (if (> (+ transmission ventilation) 0) (+ 1 (/ capacity 3600 (+ transmission ventilation) 15)) 1)))
    (map (lambda (days cold k)
           (let* ((hours (* days 24)) (drop (- inside cold)) (loss (lambda (w) (/ (* w drop hours) 1000)))
                  (sun (fold (lambda (w sum) (+ sum (* (first w) (second w) (list-ref (third w) k)))) 0 windows))
                  (gains (+ sun (/ (* internal hours) 1000))) (losses (+ (loss transmission) (loss ventilation)))
                  (use (if (> losses 0) (gain-use (/ gains losses) a) 0)))
             (list (loss transmission) (loss ventilation) (/ (* internal hours) 1000) sun use (max 0 (- losses (* use gains))))))
         month-days outside (iota 12))))
