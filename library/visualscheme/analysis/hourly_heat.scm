; Heat in each hour of a year: the simple hourly method of EN ISO 13790, annex C. A building is a node of air, a node of its
; inner surfaces and a node of its mass, between five conductances, with one capacity. Names are those of the standard.

; conductances in W/K, parts of gains, and capacity in J/K
(define-record-type zone (make-zone ve w is ms em h1 h2 h3 air mass surface capacity) zone?
  (ve zone-ve) (w zone-w) (is zone-is) (ms zone-ms) (em zone-em) (h1 zone-h1) (h2 zone-h2) (h3 zone-h3)
  (air zone-air) (mass zone-mass) (surface zone-surface) (capacity zone-capacity))

; Returns the zone: 3.45 W/m2K from air to surfaces, 9.1 W/m2K from surfaces to mass, 4.5 m2 of surfaces for each m2 of floor.
(define (zone-of ve w op floor-area mass-area capacity)
  (let* ((total (* 4.5 floor-area)) (is (* 3.45 total)) (ms (* 9.1 mass-area))
         (em (if (> op 0) (/ 1 (- (/ 1 op) (/ 1 ms))) 0)) (h1 (/ (* ve is) (+ ve is))) (h2 (+ h1 w)) (share (/ mass-area total)))
    (if (>= op ms) (error 'hourly-heat "surfaces lose ~a W/K, as much as the mass takes up: give a larger #:mass-area" op))
    (make-zone ve w is ms em h1 h2 (if (> h2 0) (/ 1 (+ (/ 1 h2) (/ 1 ms))) 0) 1/2 share (- 1 share (/ w 9.1 total)) capacity)))

; Returns the temperatures of air, and of the mass at the end of an hour. before: that of the mass; power: W of heating or, if
; negative, of cooling.
(define (zone-hour z before outside internal sun power)
  (let* ((gains (+ (/ internal 2) sun)) (on-air (+ (* (zone-air z) internal) power)) (on-mass (* (zone-mass z) gains)) (on-surface (* (zone-surface z) gains))
         (ve (zone-ve z)) (is (zone-is z)) (ms (zone-ms z)) (c (/ (zone-capacity z) 3600)) (half (/ (+ (zone-h3 z) (zone-em z)) 2))
         (inward (+ on-surface (* (zone-w z) outside) (/ (* is (+ on-air (* ve outside))) (+ ve is))))
         (total (+ on-mass (* (zone-em z) outside) (* (/ ms (+ ms (zone-h2 z))) inward)))
         (after (/ (+ (* before (- c half)) total) (+ c half)))
         (surface (/ (+ (* ms (/ (+ before after) 2)) inward) (+ ms (zone-h2 z)))))
    (list (/ (+ (* is surface) (* ve outside) on-air) (+ is ve)) after)))

; Returns an hour as a list of heating and cooling in W and the temperatures of air and mass. The air's temperature is linear
; in the power, so two powers give that which holds it.
(define (zone-step z before outside internal sun low high)
  (let* ((free (zone-hour z before outside internal sun 0)) (air (first free)) (goal (cond ((< air low) low) ((> air high) high) (else #f))))
    (if (not goal) (list 0 0 air (second free))
        (let* ((probe (* 100 (zone-is z))) (power (/ (* probe (- goal air)) (- (first (zone-hour z before outside internal sun probe)) air))))
          (list (max 0 power) (max 0 (- power)) goal (second (zone-hour z before outside internal sun power)))))))

(define (need-window l)
  (if (not (and (list? l) (= (length l) 4) (positive-number? (first l)) (positive-number? (second l)) (real? (third l)) (<= 0 (third l) 1) (or (gvector? (fourth l)) (list? (fourth l)))))
      (error 'hourly-heat "a window must be (list area u-value g normal) or (list area u-value g irradiances), got ~s" l)))

; Returns the power of the sun through all windows in each hour, in W.
(define (window-gains w windows)
  (fold (lambda (l sums)
          (let ((shine (if (gvector? (fourth l)) (irradiance w (fourth l)) (begin (need-hours 'hourly-heat "a window's irradiance" w (fourth l)) (fourth l)))))
            (map (lambda (sum i) (+ sum (* (first l) (third l) i))) sums shine)))
    (map (lambda (m) 0) (weather-moments w)) windows))

(define (hourly-heat w #:floor-area [floor-area any? #f] #:surfaces [surfaces any? '()] #:windows [windows any? '()] #:volume [volume any? 0] #:air-changes [changes any? 0.5]
                     #:inside [inside any? '(20 26)] #:internal [internal any? 0] #:capacity [capacity any? #f] #:mass-area [mass-area any? #f])
  (need-weather 'hourly-heat w)
  (need-positive 'hourly-heat 'floor-area floor-area)
  (for-each (lambda (name x) (if x (need-positive 'hourly-heat name x))) '(capacity mass-area) (list capacity mass-area))
  (for-each (lambda (name x) (if (not (and (real? x) (finite? x) (>= x 0))) (error 'hourly-heat "~a must be a number of 0 or more, got ~s" name x)))
    '(volume air-changes internal) (list volume changes internal))
  (if (not (and (list? inside) (= (length inside) 2) (every real? inside) (<= (first inside) (second inside)))) (error 'hourly-heat "inside must be (list least greatest) in °C, got ~s" inside))
  (for-each (lambda (name l) (if (not (list? l)) (error 'hourly-heat "~a must be a list, got ~s" name l))) '(surfaces windows) (list surfaces windows))
  (for-each (lambda (s) (need-surface 'hourly-heat s)) surfaces)
  (for-each need-window windows)
  (let* ((z (zone-of (/ (* 1200 volume changes) 3600) (fold (lambda (l sum) (+ sum (* (first l) (second l)))) 0 windows) (transmission-of surfaces)
              floor-area (or mass-area (* 2.5 floor-area)) (or capacity (* 165000 floor-area))))
         (outside (weather-hours w 'temperature)) (sun (window-gains w windows)))
    (define (year start)
      (let loop ((t outside) (s sun) (mass start) (out '()))
        (if (null? t) (reverse out)
            (let ((hour (zone-step z mass (car t) internal (car s) (first inside) (second inside)))) (loop (cdr t) (cdr s) (fourth hour) (cons hour out))))))
    (year (fourth (last (year (first inside)))))))
