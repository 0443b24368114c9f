; Weather: the hours of a year in an EPW file, and the sun's radiation on planes. Layout of EPW: EnergyPlus, Auxiliary
; Programs, "EnergyPlus Weather File (EPW) Data Dictionary".

; place: list of name, latitude, longitude, time zone and height in m; moments: list of lists of year, month, day and hour from
; 1; columns: list of a name and a list of numbers, one an hour
(define-record-type weather (make-weather file place moments columns) weather? (file weather-file) (place weather-place) (moments weather-moments) (columns weather-columns))

; Name, position of the field in a row, number from which a value is missing (#f: it is never), and whether it keeps the value before.
(define epw-fields '((temperature 6 99.9 #t) (humidity 8 999 #t) (global 13 9999 #f) (direct 14 9999 #f) (diffuse 15 9999 #f) (wind 21 999 #t)))

(define (all-lines file)
  (let ((port (open-input-file file)))
    (let loop ((l '()))
      (let ((line (read-line port)))
        (if (eof-object? line) (begin (close-port port) (reverse l)) (loop (cons line l)))))))
(define (without-return line)
  (let ((n (string-length line))) (if (and (> n 0) (char=? (string-ref line (- n 1)) #\return)) (substring line 0 (- n 1)) line)))

; Returns the fields of a row that must be numbers, as a vector; other fields are #f.
(define (row-numbers file number line)
  (let* ((cells (string-split line ",")) (count (length cells)))
    (if (< count 22) (error 'load-epw "~a:~a: a row has ~a fields; 22 or more are expected" file number count))
    (list->vector
      (map (lambda (cell i)
             (cond ((= i 5) #f) ((string->number (string-trim cell)) => (lambda (x) x))
               (else (error 'load-epw "~a:~a: field ~a must be a number, got ~s" file number (+ i 1) cell))))
        (take cells 22) (iota 22)))))

; Returns the values of a field; those that are missing are the value before, or 0, and a warning has their number.
(define (field-values file rows field)
  (let loop ((rows rows) (before (if (eq? (first field) 'humidity) 50 0)) (missing 0) (out '()))
    (if (null? rows)
        (begin
          (if (> missing 0) (warn (format "load-epw: ~a: ~a is missing in ~a h; ~a" file (first field) missing (if (fourth field) "the value before is used" "0 is used"))))
          (reverse out))
        (let* ((x (vector-ref (car rows) (second field))) (bad (>= x (third field))) (value (if bad (if (fourth field) before 0) x)))
          (loop (cdr rows) value (if bad (+ missing 1) missing) (cons value out))))))

(define (load-epw file)
  (if (not (string? file)) (error 'load-epw "file must be a string, got ~s" file))
  (let* ((lines (map without-return (all-lines file))) (head (if (pair? lines) (string-split (car lines) ",") '())))
    (if (not (and (>= (length head) 10) (string=? (car head) "LOCATION") (>= (length lines) 8)))
        (error 'load-epw "~a: no EPW file: the first line must be LOCATION with ten fields, and eight lines precede the hours" file))
    (let* ((place (map (lambda (cell) (or (string->number (string-trim cell)) (error 'load-epw "~a:1: a place must be four numbers, got ~s" file cell))) (take (drop head 6) 4)))
           (texts (filter (lambda (t) (> (string-length (string-trim t)) 0)) (drop lines 8)))
           (rows (map (lambda (line number) (row-numbers file number line)) texts (iota (length texts) 9))))
      (if (not (memv (length rows) '(8760 8784))) (error 'load-epw "~a: a year of 8760 or 8784 hours is expected, got ~a" file (length rows)))
      (make-weather file (cons (second head) place)
        (map (lambda (r) (map (lambda (i) (vector-ref r i)) '(0 1 2 3))) rows)
        (map (lambda (f) (list (first f) (field-values file rows f))) epw-fields)))))

(define (need-weather who w) (if (not (weather? w)) (error who "w must be weather of load-epw, got ~s" w)))
(define (weather-hours w what)
  (need-weather 'weather-hours w)
  (let ((column (assq what (weather-columns w))))
    (if column (second column) (error 'weather-hours "what must be one of ~a, got ~s" (map first epw-fields) what))))

(define (need-hours who name w l)
  (if (not (and (list? l) (= (length l) (length (weather-moments w))) (every (lambda (x) (and (real? x) (finite? x))) l)))
      (error who "~a must be a list of ~a numbers, one for each hour" name (length (weather-moments w)))))

; Returns the sums of the values of each month.
(define (monthly-sums w values)
  (need-weather 'monthly-sums w)
  (need-hours 'monthly-sums 'values w values)
  (let ((sums (make-vector 12 0)))
    (for-each (lambda (m x) (let ((k (- (second m) 1))) (vector-set! sums k (+ (vector-ref sums k) x)))) (weather-moments w) values)
    (vector->list sums)))
(define (monthly-means w values) (map / (monthly-sums w values) (monthly-sums w (map (lambda (m) 1) (weather-moments w)))))

; ---- radiation ----

(define (two-digits n) (if (< n 10) (format "0~a" n) (format "~a" n)))
; Returns the direction to the sun in the middle of each hour; EPW counts hours in the time of the zone.
(define (sun-directions w)
  (let* ((place (weather-place w)) (zone (fourth place)) (minutes (exact (round (* 60 (abs zone)))))
         (ending (format ":30~a~a:~a" (if (< zone 0) "-" "+") (two-digits (quotient minutes 60)) (two-digits (remainder minutes 60)))))
    (map (lambda (m)
           (sun-direction #:latitude (second place) #:longitude (third place)
             #:date (format "~a-~a-~a" (first m) (two-digits (second m)) (two-digits (third m)))
             #:time (string-append (two-digits (- (fourth m) 1)) ending)))
      (weather-moments w))))

; Returns n directions to the half of a sky of equal radiance above a plane, each with an equal part of the plane's light.
(define (plane-directions normal n)
  (let* ((z (unitize normal)) (x (unitize (cross z (if (< (abs (cx z)) 0.9) (vxyz 1 0 0) (vxyz 0 1 0))))) (y (cross z x)) (golden (* pi (- 3 (sqrt 5)))))
    (map (lambda (k) ; the parts of the unit disc are equal: the light counts by the cosine to the plane
           (let* ((part (/ (+ k 0.5) n)) (s (sqrt part)) (v (v+v (v+v (v*r x (* s (cos (* k golden)))) (v*r y (* s (sin (* k golden))))) (v*r z (sqrt (- 1 part))))))
             (p+v origin v)))
      (iota n))))

; Returns the part of its directions in which a plane at a place sees the sky, and for each sun whether it is seen: 1 or 0.
(define (seen-sky at normal among rays)
  (let ((up (filter (lambda (d) (> (cz d) 0)) (plane-directions normal rays))))
    (if (null? up) 0 (car (core:lit (list at) (list (p+v origin normal)) up (/ 1. rays) among)))))
(define (seen-suns at normal among suns) (core:suns-seen (list at) (list (p+v origin normal)) (map (lambda (v) (p+v origin v)) suns) 1 among))

; Returns the radiation on a plane in each hour, in W/m2: the sun's, that of a sky of equal radiance (Liu and Jordan, 1963),
; and that which the ground reflects. Objects of `among` hide the sun and parts of the sky.
(define (irradiance w normal #:albedo [albedo any? 0.2] #:at [at any? #f] #:among [among any? '()] #:rays [rays any? 4096])
  (need-weather 'irradiance w)
  (if (not (and (gvector? normal) (> (vlength normal) 0))) (error 'irradiance "normal must be a gvector with a length, got ~s" normal))
  (if (not (and (real? albedo) (<= 0 albedo 1))) (error 'irradiance "albedo must be a number from 0 to 1, got ~s" albedo))
  (let* ((n (v/r normal (vlength normal))) (sky (/ (+ 1 (cz n)) 2)) (objects (if (list? among) among (list among))) (hidden (pair? objects)) (suns (sun-directions w)))
    (if (and hidden (not (point? at))) (error 'irradiance "#:among needs #:at, the point of the plane that objects may shade, got ~s" at))
    (if (not (and (exact-integer? rays) (<= 16 rays 1000000))) (error 'irradiance "rays must be an exact integer from 16 to 1000000, got ~s" rays))
    (map (lambda (sun seen open direct diffuse global)
           (+ (if (> (cz sun) 0) (* direct seen (max 0 (dot sun n))) 0) (* diffuse open) (* albedo global (- 1 sky))))
      suns (if hidden (seen-suns at n objects suns) (map (lambda (sun) 1) suns))
      (make-list (length suns) (if hidden (seen-sky at n objects rays) sky)) (weather-hours w 'direct) (weather-hours w 'diffuse) (weather-hours w 'global))))
