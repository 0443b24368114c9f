; Actions on structures: snow and wind by EN 1991, combinations by EN 1990. Factors are the recommended ones; a National Annex
; may have others.

; ---- snow and wind ----

; Returns the force of snow on each m2 of plan, in N: EN 1991-1-3, 5.2 and table 5.2, for roofs from which snow may slide.
(define (snow-load ground #:slope [slope any? 0] #:exposure [exposure any? 1] #:thermal [thermal any? 1])
  (need-number 'snow-load 'slope slope)
  (for-each (lambda (name x) (need-positive 'snow-load name x)) '(ground exposure thermal) (list ground exposure thermal))
  (if (< ground 50) (warn (format "snow-load: ~a N/m2 of snow is less than a handful: newtons are expected, 1 kN is 1000 N" ground)))
  (let ((degrees (abs (radians->degrees slope))))
    (* ground exposure thermal (cond ((<= degrees 30) 0.8) ((< degrees 60) (/ (* 0.8 (- 60 degrees)) 30)) (else 0)))))

; Roughness lengths and least heights in m: EN 1991-1-4, table 4.1.
(define terrains '((0 0.003 1) (I 0.01 1) (II 0.05 2) (III 0.3 5) (IV 1 10)))

; Returns the peak velocity pressure at a height in Pa: EN 1991-1-4, 4.3 to 4.5, on flat land.
(define (wind-pressure velocity height #:terrain [terrain any? 'II])
  (for-each (lambda (name x) (need-positive 'wind-pressure name x)) '(velocity height) (list velocity height))
  (let ((kind (or (assv terrain terrains) (error 'wind-pressure "terrain must be one of ~s, got ~s" (map car terrains) terrain))))
    (if (> velocity 90) (warn (format "wind-pressure: a wind of ~a m/s is a tornado's: m/s are expected, 1 km/h is 0.278 m/s" velocity)))
    (if (> height 200) (error 'wind-pressure "height must be at most 200 m, got ~a" height))
    (let* ((z0 (second kind)) (z (max height (third kind))) (steep (log (/ z z0))) (mean (* velocity 0.19 (expt (/ z0 0.05) 0.07) steep)))
      (* (+ 1 (/ 7 steep)) 1/2 1.25 mean mean))))

; ---- combinations ----

; Factors psi 0, 1 and 2: EN 1990, table A1.1.
(define action-factors
  '((a 0.7 0.5 0.3) (b 0.7 0.5 0.3) (c 0.7 0.7 0.6) (d 0.7 0.7 0.6) (e 1 0.9 0.8) (f 0.7 0.7 0.6) (g 0.7 0.5 0.3) (h 0 0 0)
    (snow 0.5 0.2 0) (high-snow 0.7 0.5 0.2) (wind 0.6 0.2 0) (temperature 0.6 0.5 0)))

(define (factors-of v)
  (let ((kind (second v)))
    (cond
      ((assq kind action-factors) => cdr)
      ((and (list? kind) (= (length kind) 3) (every (lambda (x) (and (real? x) (<= 0 x 1))) kind)) kind)
      (else (error 'design-cases "an action must be one of ~s, or a list of psi 0, 1 and 2, got ~s" (map car action-factors) kind)))))

; Returns a combination with a name that shows its sum.
(define (named-sum parts)
  (let ((all (remove (lambda (p) (= 0 (first p))) parts)))
    (cons (string-join (map (lambda (p) (if (= 1 (first p)) (second p) (format "~a ~a" (/ (round (* 1000. (first p))) 1000) (second p)))) all) " + ") all)))

; Returns the sums of a limit state: for each variable action that leads, with and without the others.
(define (sums-of limit permanent variable)
  (let ((all (lambda (g q lead other)
               (if (null? variable) (list (map (lambda (p) (list g p)) permanent))
                   (append-map
                     (lambda (v)
                       (let* ((others (remove (lambda (o) (eq? o v)) variable)) (head (append (map (lambda (p) (list g p)) permanent) (list (list (* q (lead v)) (first v))))))
                         (cons (append head (map (lambda (o) (list (* q (other o)) (first o))) others)) (if (null? others) '() (list head)))))
                     variable))))
        (psi (lambda (k) (lambda (v) (list-ref (factors-of v) k)))) (one (lambda (v) 1)))
    (case limit
      ((uls) (append (map (lambda (g) (map (lambda (p) (list g p)) permanent)) '(1.35 1)) (all 1.35 1.5 one (psi 0)) (all 1 1.5 one (psi 0))))
      ((characteristic) (all 1 1 one (psi 0)))
      ((frequent) (all 1 1 (psi 1) (psi 2)))
      ((quasi-permanent) (list (append (map (lambda (p) (list 1 p)) permanent) (map (lambda (v) (list ((psi 2) v) (first v))) variable)))))))

; Returns a result whose cases are the combinations of EN 1990: (6.10) with table A1.2(B), or (6.14b) to (6.16b).
(define (design-cases r #:permanent [permanent any? '()] #:variable [variable any? '()] #:limit [limit any? 'uls])
  (need-result 'design-cases r)
  (let ((permanent (if (string? permanent) (list permanent) permanent)))
    (if (not (memq limit '(uls characteristic frequent quasi-permanent))) (error 'design-cases "limit must be 'uls, 'characteristic, 'frequent or 'quasi-permanent, got ~s" limit))
    (if (not (and (list? permanent) (every string? permanent))) (error 'design-cases "permanent must be names of cases, got ~s" permanent))
    (if (not (and (list? variable) (every (lambda (v) (and (list? v) (= (length v) 2) (string? (first v)))) variable)))
        (error 'design-cases "variable must be lists of a case and its kind, such as '((\"snow\" snow)), got ~s" variable))
    (for-each factors-of variable)
    (if (and (null? permanent) (null? variable)) (error 'design-cases "give #:permanent, #:variable, or both"))
    (let ((named (map named-sum (sums-of limit permanent variable))))
      (apply combine-cases r (delete-duplicates (filter (lambda (c) (pair? (cdr c))) named) (lambda (a b) (equal? (car a) (car b))))))))
