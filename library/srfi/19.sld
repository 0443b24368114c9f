; SRFI 19, times and dates: the reference implementation, under the MIT licence in 19/srfi-19.scm. Its clock is the language's, and its local zone is UTC.
(define-library (srfi 19)
  (export time-duration time-monotonic time-process time-tai time-thread time-utc
          current-date current-julian-day current-modified-julian-day current-time time-resolution
          make-time time? time-type time-nanosecond time-second set-time-type! set-time-nanosecond! set-time-second! copy-time
          time<=? time<? time=? time>=? time>? time-difference time-difference! add-duration add-duration! subtract-duration subtract-duration!
          make-date date? date-nanosecond date-second date-minute date-hour date-day date-month date-year date-zone-offset
          date-year-day date-week-day date-week-number
          date->julian-day date->modified-julian-day date->time-monotonic date->time-tai date->time-utc
          julian-day->date julian-day->time-monotonic julian-day->time-tai julian-day->time-utc
          modified-julian-day->date modified-julian-day->time-monotonic modified-julian-day->time-tai modified-julian-day->time-utc
          time-monotonic->date time-monotonic->julian-day time-monotonic->modified-julian-day
          time-monotonic->time-tai time-monotonic->time-tai! time-monotonic->time-utc time-monotonic->time-utc!
          time-tai->date time-tai->julian-day time-tai->modified-julian-day
          time-tai->time-monotonic time-tai->time-monotonic! time-tai->time-utc time-tai->time-utc!
          time-utc->date time-utc->julian-day time-utc->modified-julian-day
          time-utc->time-monotonic time-utc->time-monotonic! time-utc->time-tai time-utc->time-tai!
          date->string string->date)
  (import (scheme base) (scheme char) (scheme cxr) (scheme file) (scheme read) (scheme write) (scheme time) (scheme inexact) (scheme r5rs)
          (only (visualscheme) define-struct))
  (begin
    (define (make-inspector) #f)
    (define eof (eof-object)))
  (include "19/srfi-19.scm")
  (begin
    ; in place of the original's, which asked the clocks of one implementation and took milliseconds for hundredths
    (define (tm:now type leap)
      (let* ((now (exact (floor (* 1000000 (current-second))))) (seconds (floor-quotient now 1000000)))
        (make-time type (* 1000 (floor-remainder now 1000000)) (+ seconds (leap seconds)))))
    (define (tm:none seconds) 0)
    (define (tm:elapsed type)
      (let ((jiffies (current-jiffy)))
        (make-time type (* 1000 (floor-remainder jiffies 1000000)) (floor-quotient jiffies 1000000))))
    (define (tm:current-time-utc) (tm:now time-utc tm:none))
    (define (tm:current-time-tai) (tm:now time-tai tm:leap-second-delta))
    (define (tm:current-time-monotonic) (tm:now time-monotonic tm:leap-second-delta))
    (define (tm:current-time-thread) (tm:elapsed time-thread))
    (define (tm:current-time-process) (tm:elapsed time-process))
    (define (tm:current-time-gc) (tm:elapsed time-gc))
    (define (tm:local-tz-offset) 0)
    (define (time-resolution . clock-type) 1000)))
