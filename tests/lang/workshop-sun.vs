; the sun in the language: directions, paths and hours against what is known of them, and against rays of another way
(define (sun lat date time) (sun-direction #:latitude lat #:date date #:time time))
(define (degrees a) (radians->degrees a))

; length 1; at the equinox the noon sun is as high as the latitude leaves, at the solstices 23.44 degrees beside that
(define (height v) (degrees (asin (cz v))))
(displayln (every (lambda (h) (near? (vlength (sun 52 "2026-05-04" (format "~a:~a" h "00"))) 1)) '("00" "06" "12" "18")))
; expect: #t
(displayln (map (lambda (lat) (map (lambda (d) (round (height (sun lat d "12:00")))) '("2026-03-20" "2026-06-21" "2026-12-21"))) '(0 23 52)))
; expect: ((88.0 67.0 67.0) (67.0 89.0 44.0) (38.0 61.0 15.0))
; a zone and a longitude move the clock: noon at 15 degrees east is 12:00+01:00
(displayln (near? (sun-direction #:latitude 52 #:longitude 15 #:date "2026-06-21" #:time "12:00+01:00")
                  (sun-direction #:latitude 52 #:longitude 15 #:date "2026-06-21" #:time "12:00") 1e-9))
; expect: #t
; in the morning in the east, in the evening in the west; south of the equator noon is in the north
(displayln (list (> (cx (sun 52 "2026-06-21" "07:00")) 0) (< (cx (sun 52 "2026-06-21" "18:00")) 0) (> (cy (sun -35 "2026-06-21" "12:00")) 0)))
; expect: (#t #t #t)

; the path lies on its sphere, begins and ends at the horizon, and passes the directions of the day
(define (path lat date . center) (sun-path #:latitude lat #:longitude 13 #:date date #:radius 8 #:center (if (pair? center) (car center) origin)))
(define (on-sphere? c) (every (lambda (p) (and (<= (distance p origin) (+ 8 1e-9)) (> (distance p origin) (* 8 0.9997)))) (curve-division c 50)))
(define dates '("2026-03-20" "2026-06-21" "2026-09-23" "2026-12-21"))
(displayln (every (lambda (lat) (every (lambda (d) (on-sphere? (path lat d))) dates)) '(-52 -20 0 20 52 65)))
; expect: #t
(displayln (every (lambda (d) (let ((c (path 52 d))) (and (near? (cz (curve-point c 0)) 0 1e-6) (near? (cz (curve-point c (curve-length c))) 0 1e-6)
                                                         (> (cx (curve-point c 0)) 0 (cx (curve-point c (curve-length c)))))))
                 dates))
; expect: #t
(displayln (every (lambda (h) (< (distance (closest-point (path 52 "2026-06-21") (p+v origin (v*r (sun-direction #:latitude 52 #:longitude 13 #:date "2026-06-21" #:time h) 8)))
                                           (p+v origin (v*r (sun-direction #:latitude 52 #:longitude 13 #:date "2026-06-21" #:time h) 8))) 0.01))
                 '("06:00" "09:17" "12:00" "17:43")))
; expect: #t
(displayln (near? (curve-point (path 52 "2026-06-21" (xyz 1 2 3)) 0) (p+v (curve-point (path 52 "2026-06-21") 0) (vxyz 1 2 3))))
; expect: #t
; the polar day is a closed curve, the polar night nothing with a warning
(displayln (list (near? (curve-point (path 80 "2026-06-21") 0) (let ((c (path 80 "2026-06-21"))) (curve-point c (curve-length c))))
                 (empty-object? (path 80 "2026-12-21")))) ; expect warning: sun-path: the sun does not rise on that day
; expect: (#t #t)

; hours: a plane of the ground, walls of four sides at the equinox, a roof beneath
(define (hours normal date . among) (first (solar-hours origin normal #:latitude 50 #:date date #:among among)))
(displayln (map (lambda (n) (near? (hours n "2026-03-20") 12 0.4)) (list uz (vxyz 0 -1 0))))
; expect: (#t #t)
(displayln (map (lambda (n) (near? (hours n "2026-03-20") 6 0.4)) (list ux (vxyz -1 0 0))))
; expect: (#t #t)
(displayln (list (hours (vxyz 0 0 -1) "2026-06-21") (hours uy "2026-12-21") (hours uz "2026-06-21" (make-box (xyz -900 -900 1) (xyz 900 900 2)))))
; expect: (0.0 0.0 0.0)
; among solids, surfaces and lists of both: the hours that rays of project-point count
(define things (list (make-box (xyz 2 -5 0) (xyz 4 5 8)) (make-sphere (xyz -4 -6 5) 2) (make-3dface (xyz -9 -9 0) (xyz -3 -9 0) (xyz -3 -9 7) (xyz -9 -9 7))))
(define places (list origin (xyz 1 -3 0) (xyz -5 -4 0) (xyz 3 0 8)))
(define (blocked? p v) (any (lambda (o) (project-point o (p+v p (v*r uz 1e-4)) v)) things))
(define (counted p)
  (apply + (map (lambda (i)
                  (let* ((minutes (+ (* 120 i) 60))
                         (two (lambda (n) (if (< n 10) (format "0~a" n) (number->string n))))
                         (v (sun-direction #:latitude 40 #:date "2026-05-01" #:time (format "~a:~a" (two (quotient minutes 60)) (two (remainder minutes 60))))))
                    (if (and (> (cz v) 0) (not (blocked? p v))) 2 0)))
                (iota 12))))
(displayln (near? (solar-hours places uz #:latitude 40 #:date "2026-05-01" #:among things #:step 2) (map counted places) 1e-9))
; expect: #t
(displayln (near? (solar-hours places (map (lambda (p) uz) places) #:latitude 40 #:date "2026-05-01" #:among (list (unite (first things) (second things)) '()) #:step 1/3 #:from 6 #:to 12)
                  (solar-hours places uz #:latitude 40 #:date "2026-05-01" #:among (list (first things) (second things)) #:step 1/3 #:from 6 #:to 12)))
; expect: #t

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (c (#t (condition/report-string c))) e "no error")))))
(fails (sun-direction #:latitude 91 #:date "2026-06-21" #:time "12:00")) ; expect: sun-direction: latitude must be from -90 to 90, got 91
(fails (sun-direction #:latitude 1 #:longitude 200 #:date "2026-06-21" #:time "12:00")) ; expect: sun-direction: longitude must be from -180 to 180, got 200
(fails (sun-direction #:latitude 1 #:date "2026-06-31" #:time "12:00")) ; expect: sun-direction: date must be a day such as "2026-06-21", got "2026-06-31"
(fails (sun-direction #:latitude 1 #:date "2026-06-21" #:time "noon")) ; expect: sun-direction: time must be a time such as "15:00+01:00", got "noon"
(fails (sun-direction #:latitude 1 #:date "2026-06-21")) ; expect: sun-direction: needs #:latitude, #:date and #:time; #:longitude is optional
(fails (sun-path #:latitude 1 #:date "today")) ; expect: sun-path: date must be a day such as "2026-06-21", got "today"
(fails (sun-path #:latitude 1 #:date "2026-06-21" #:radius 0)) ; expect: sun-path: radius must be a positive number, got 0
(displayln (solar-hours '() uz #:latitude 1 #:date "2026-06-21")) ; expect: ()
(fails (solar-hours '(1) uz #:latitude 1 #:date "2026-06-21")) ; expect: solar-hours: points must be a list of points of finite coordinates, got (1)
(fails (solar-hours (list origin origin) (list uz) #:latitude 1 #:date "2026-06-21")) ; expect: solar-hours: normals must be 2 gvectors, one for each point, got 1
(fails (solar-hours origin uz #:latitude 1 #:date "2026-06-21" #:from 9 #:to 8)) ; expect: solar-hours: from and to must be hours from 0 to 24, from the earlier, got 9 and 8
(fails (solar-hours origin uz #:latitude 1 #:date "2026-06-21" #:among (make-circle origin 1))) ; expect: solar-hours: among must be a list of finite solids and surfaces, got (make-circle (xyz 0 0 0) 1)
