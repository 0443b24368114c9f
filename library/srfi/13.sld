; SRFI 13, string libraries: Olin Shivers' reference implementation, under the licences at the end of 13/srfi-13.scm.
(define-library (srfi 13)
  (export
    string-map string-map!
    string-fold       string-unfold
    string-fold-right string-unfold-right
    string-tabulate string-for-each string-for-each-index
    string-every string-any
    string-hash string-hash-ci
    string-compare string-compare-ci
    string=    string<    string>    string<=    string>=    string<>
    string-ci= string-ci< string-ci> string-ci<= string-ci>= string-ci<>
    string-downcase  string-upcase  string-titlecase
    string-downcase! string-upcase! string-titlecase!
    string-take string-take-right
    string-drop string-drop-right
    string-pad string-pad-right
    string-trim string-trim-right string-trim-both
    string-filter string-delete
    string-index string-index-right
    string-skip  string-skip-right
    string-count
    string-prefix-length string-prefix-length-ci
    string-suffix-length string-suffix-length-ci
    string-prefix? string-prefix-ci?
    string-suffix? string-suffix-ci?
    string-contains string-contains-ci
    (rename base:string-copy! string-copy!) substring/shared
    string-reverse string-reverse! reverse-list->string
    string-concatenate string-concatenate/shared string-concatenate-reverse
    string-concatenate-reverse/shared
    string-append/shared
    xsubstring string-xcopy!
    string-null?
    string-join
    string-tokenize
    string-replace
    (rename base:string->list string->list) (rename base:string-copy string-copy) (rename base:string-fill! string-fill!)
    string? make-string string-length string-ref string-set!
    string string-append list->string)
  (import (prefix (only (scheme base) string-copy! string->list string-copy string-fill!) base:)
          (except (scheme base) string-copy string-for-each string->list string-map string-fill! string-copy!)
          (except (scheme char) string-upcase string-downcase)
          (scheme cxr)
          (srfi 8) (srfi 14) (srfi optionals))
  (begin
    (define (char-titlecase c) (char-upcase c))
    (define (char-cased? c) (char-upper-case? (char-upcase c))))
  (include "13/srfi-13.scm"))
