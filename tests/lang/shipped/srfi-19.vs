; SRFI 19, as it comes with the language
(import (scheme base) (scheme write) (srfi 19))
(define-syntax show (syntax-rules () ((_ e) (begin (write e) (newline)))))
(show (date->string (make-date 0 5 30 14 21 6 2026 0) "~Y-~m-~d ~H:~M:~S")) ; expect: "2026-06-21 14:30:05"
(show (date->string (make-date 0 0 0 0 1 1 2000 0) "~A, ~d ~B ~Y")) ; expect: "Saturday, 01 January 2000"
(show (date-year-day (make-date 0 0 0 0 1 3 2024 0))) ; expect: 61
(show (date-week-day (make-date 0 0 0 0 21 6 2026 0))) ; expect: 0
(show (time-second (date->time-utc (make-date 0 0 0 0 1 1 1970 0)))) ; expect: 0
(show (date-day (time-utc->date (make-time time-utc 0 86400) 0))) ; expect: 2
(show (let ((d (string->date "2026-03-14" "~Y-~m-~d"))) (list (date-year d) (date-month d) (date-day d)))) ; expect: (2026 3 14)
(show (time-second (time-difference (date->time-utc (make-date 0 0 0 0 2 1 2026 0)) (date->time-utc (make-date 0 0 0 0 1 1 2026 0))))) ; expect: 86400
(show (< 2020 (date-year (current-date)) 2200)) ; expect: #t
