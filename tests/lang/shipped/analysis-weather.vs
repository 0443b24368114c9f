; (visualscheme analysis): weather of a file that the test writes, the sun on planes, and heat by the hour beside closed forms
(import (visualscheme) (visualscheme analysis))
(define (same? a b) (<= (abs (- a b)) (* 1e-9 (max 1 (abs a) (abs b)))))
(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(define days '(31 28 31 30 31 30 31 31 30 31 30 31))
(define (write-epw file temperature shine? tail)
  (let ((port (open-output-file file)) (k -1))
    (display "LOCATION,Nowhere,-,-,test,0,38.7,-9.1,0.0,100.0\n" port)
    (for-each (lambda (name) (display name port) (newline port)) '("DESIGN CONDITIONS,0" "TYPICAL/EXTREME PERIODS,0" "GROUND TEMPERATURES,0" "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0" "COMMENTS 1" "COMMENTS 2" "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31"))
    (for-each
      (lambda (month count)
        (for-each
          (lambda (day)
            (for-each
              (lambda (hour)
                (set! k (+ k 1))
                (let ((sun (if (and shine? (<= 10 hour 15)) 1 0)))
                  (fprintf port "2025,~a,~a,~a,60,flags,~a,5,70,101300,0,0,300,~a,~a,~a,0,0,0,0,180,3~a~%" month day hour (temperature k) (* 400 sun) (* 500 sun) (* 100 sun) (tail k))))
              (iota 24 1)))
          (iota count 1)))
      (iota 12 1) days)
    (close-port port)))
(define (none k) ",0,0")
(define (still celsius) (write-epw "w.epw" (lambda (k) celsius) #f none) (load-epw "w.epw"))

; five degrees all year: the heating is the loss of the network of conductances, from air through surfaces and mass
(define cold (still 5))
(displayln (list (weather-place cold) (length (weather-hours cold 'temperature))))
; expect: ((Nowhere 38.7 -9.1 0.0 100.0) 8760)
(define walls '((200 0.3) (100 0.4 0.5)))
(define panes (list (list 20 1.1 0.6 (vxyz 0 -1 0))))
(define steady (hourly-heat cold #:floor-area 100 #:surfaces walls #:windows panes #:volume 300))
(define network (+ 50 (/ 1 (+ (/ 1 (* 3.45 4.5 100)) (/ 1 (+ 80 22))))))
(displayln (every (lambda (h) (same? (first h) (* 15 network))) (list (first steady) (last steady))))
; expect: #t
; the monthly balance has no resistance between air and surfaces: it loses a little more
(define month (first (heat-balance #:surfaces (cons '(20 1.1) walls) #:volume 300 #:outside (make-list 12 5))))
(define january (/ (first (monthly-sums cold (map first steady))) 1000))
(displayln (list (< 0.94 (/ january (sixth month)) 1) (same? january (* 0.744 15 network))))
; expect: (#t #t)

; a house without heating cools as one capacity through one resistance, when half a year of 20 degrees ends
(write-epw "w.epw" (lambda (k) (if (< k 4380) 20 0)) #f none)
(define falling (hourly-heat (load-epw "w.epw") #:floor-area 100 #:surfaces walls #:volume 300 #:inside '(-100 100)))
(define out (let ((h1 (/ 1 (+ 1/50 (/ 1 1552.5))))) (+ (/ 1 (+ (/ 1 h1) (/ 1 2275))) (/ 1 (- 1/80 (/ 1 2275))))))
(displayln (every (lambda (n) (near? (fourth (list-ref falling (+ 4379 n))) (* 20 (exp (/ (* -3600 n out) 165000 100))) 1e-3)) '(0 1 24 100 400)))
; expect: #t

; the sun: level planes get all, the ground reflects to walls, and a plane that turns with the sun gets the direct radiation
(write-epw "w.epw" (lambda (k) 10) #t none)
(define sunny (load-epw "w.epw"))
(define up (irradiance sunny (vxyz 0 0 2)))
(define noon (+ (* 24 171) 11)) ; 21 June, 11 to 12 h
(define sun (sun-direction #:latitude 38.7 #:longitude -9.1 #:date "2025-06-21" #:time "11:30+00:00"))
(displayln (list (same? (list-ref up noon) (+ 100 (* 500 (cz sun)))) (same? (list-ref (irradiance sunny (vxyz 0 1 0) #:albedo 0) noon) (+ 50 (* 500 (max 0 (cy sun)))))
  (same? (list-ref (irradiance sunny sun #:albedo 0) noon) (+ 500 (* 50 (+ 1 (cz sun))))) (list-ref up 2)))
; expect: (#t #t #t 0.0)
; objects in the way: a wall hides sun and sky behind it; a roof hides all the sky of a level place
(define there (xyz 0 0 0))
(define screen (make-box (xyz -1e5 -1 -1) (xyz 1e5 -0.9 1e5)))
(define shaded (irradiance sunny (vxyz 0 0 1) #:at there #:among screen))
(displayln (list (near? (list-ref shaded noon) (+ 50 (* 500 (if (< (cy sun) 0) 0 (cz sun)))) 0.5) (list-ref shaded 2))) ; expect: (#t 0.0)
(displayln (every (lambda (a b) (near? a b 0.1)) (irradiance sunny sun #:at there #:among (make-box (xyz 0 0 -9) (xyz 1 1 -8))) (irradiance sunny sun))) ; expect: #t
(displayln (every (lambda (x) (= x 0)) (irradiance sunny (vxyz 0 0 1) #:at there #:among (make-box (xyz -1 -1 -1) (xyz 1 1 1))))) ; expect: #t
(fails (irradiance sunny (vxyz 0 0 1) #:among screen)) ; expect: irradiance: #:among needs #:at, the point of the plane that objects may shade, got #f
(fails (irradiance sunny (vxyz 0 0 1) #:rays 3)) ; expect: irradiance: rays must be an exact integer from 16 to 1000000, got 3
(define south (monthly-sums sunny (irradiance sunny (vxyz 0 -1 0))))
(displayln (list (> (first south) (first (monthly-sums sunny (irradiance sunny (vxyz 0 1 0))))) (same? (apply + south) (apply + (irradiance sunny (vxyz 0 -1 0)))) (every (lambda (m) (same? m 10)) (monthly-means sunny (weather-hours sunny 'temperature)))))
; expect: (#t #t #t)
; heating and cooling hold the air at 20 degrees, and never work in one hour
(define held (hourly-heat sunny #:floor-area 100 #:surfaces walls #:windows panes #:volume 300 #:inside '(20 20) #:internal 300))
(displayln (every (lambda (h) (and (same? (third h) 20) (or (= 0 (first h)) (= 0 (second h))))) held))
; expect: #t

(fails (load-epw 5))                      ; expect: load-epw: file must be a string, got 5
(write-epw "w.epw" (lambda (k) (if (= k 3) "warm" 1)) #f none)
(fails (load-epw "w.epw"))                ; expect: load-epw: w.epw:12: field 7 must be a number, got "warm"
(write-epw "w.epw" (lambda (k) (if (= k 3) 99.9 1)) #f none)
(define gap (load-epw "w.epw"))           ; expect warning: load-epw: w.epw: temperature is missing in 1 h; the value before is used
(displayln (list-ref (weather-hours gap 'temperature) 3)) ; expect: 1
(fails (weather-hours cold 'rain))        ; expect: weather-hours: what must be one of (temperature humidity global direct diffuse wind), got rain
(fails (irradiance cold (vxyz 0 0 0)))    ; expect: irradiance: normal must be a gvector with a length, got (vxyz 0 0 0)
(fails (hourly-heat cold))                ; expect: hourly-heat: floor-area must be positive, got #f
(fails (hourly-heat cold #:floor-area 100 #:inside 20)) ; expect: hourly-heat: inside must be (list least greatest) in °C, got 20
(fails (hourly-heat cold #:floor-area 1 #:surfaces walls)) ; expect: hourly-heat: surfaces lose 80.0 W/K, as much as the mass takes up: give a larger #:mass-area
(let ((port (open-output-file "w.epw"))) (display "solid\n" port) (close-port port))
(fails (load-epw "w.epw"))                ; expect: load-epw: w.epw: no EPW file: the first line must be LOCATION with ten fields, and eight lines precede the hours
(delete-file "w.epw")
; expect no other warnings
