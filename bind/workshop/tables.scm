; Tables of quantities, and their files. After workshop.scm. Names that begin with % are hidden from programs. Compiled
; into the binary when it is built.

; kilograms in a cubic metre of the ready materials
(define %densities
  '(("concrete" . 2400) ("plaster" . 1200) ("steel" . 7850) ("copper" . 8960) ("gold" . 19300) ("glass" . 2500) ("wood" . 500)
    ("brick" . 1800) ("stone" . 2600) ("water" . 1000) ("asphalt" . 2300)))

(define %schedule-keys '(name part layer material))
(define %schedule-sums '(count length area volume mass cost))

(define (%schedule-text x) (if (symbol? x) (symbol->string x) x))

; Returns the objects of a list of lists as those that a table counts: what (layer "a" x y) and (with-material m x y)
; unite is counted one by one.
(define (%schedule-objects o)
  (cond
    ((null? o) '())
    ((pair? o) (append (%schedule-objects (car o)) (%schedule-objects (cdr o))))
    ((not (object? o)) (error 'schedule "objects must be a list of objects, got ~s" o))
    ((empty-object? o) '())
    (else
      (let ((kind (object-kind o)) (children (object-children o)))
        (define (looks? c) (memq (object-kind c) '(layer with-material part)))
        (define (within c) ; what a layer or a material holds
          (cond ((looks? c) (%schedule-objects c))
                ((eq? (object-kind c) 'unite) (append-map %schedule-objects (object-children c)))
                (else (list c))))
        (cond
          ((looks? o)
           (let ((look (car (object-arguments o))))
             (map (lambda (c) (case kind ((layer) (layer look c)) ((part) (part look c)) (else (with-material look c)))) (within (car children)))))
          ((and (eq? kind 'unite) (any looks? children)) (append-map %schedule-objects children))
          (else (list o)))))))

; Returns the rate of the first of an object's names that the table has, or #f.
(define (%schedule-find table names)
  (let loop ((names names))
    (and (pair? names)
         (or (assoc (car names) table (lambda (a b) (equal? (%schedule-text a) (%schedule-text b)))) (loop (cdr names))))))

(define (%schedule-column? c)
  (or (memq c %schedule-keys) (memq c %schedule-sums) (procedure? c)
      (and (pair? c) (or (string? (car c)) (symbol? (car c))) (procedure? (cdr c)))))

(define (%column-head c) (cond ((pair? c) (car c)) ((procedure? c) 'value) (else c)))

(define (%need-digits who digits)
  (if (not (and (exact-integer? digits) (<= 0 digits 15))) (error who "digits must be an exact integer from 0 to 15, got ~s" digits)))

; Returns a real number rounded to so many decimals; exact integers, other values, and without digits all, unchanged.
(define (%rounded x digits)
  (if (and digits (real? x) (not (exact-integer? x))) (let ((power (expt 10. digits))) (/ (round (* x power)) power)) x))

(define (%need-rates rates)
  (if (not (and (list? rates)
                (every (lambda (r) (and (list? r) (= (length r) 3) (or (string? (car r)) (symbol? (car r)))
                                        (memq (cadr r) '(count length area volume mass)) (real? (caddr r))))
                       rates)))
      (error 'schedule "rates must be a list of (name measure rate), such as (\"concrete\" volume 180), got ~s" rates)))

; Returns rows: a head with the columns' names, then a row for each set of objects that agree in all columns that are no
; measures; the measures are sums.
(define (schedule objects #:rates [rates any? '()] #:densities [densities any? '()] #:digits [digits any? #f]
                  #:total [total any? #f] . columns)
  (if (null? columns) (error 'schedule "takes one column or more, such as 'layer 'count 'volume"))
  (for-each (lambda (c)
              (if (not (%schedule-column? c))
                  (error 'schedule "a column is one of ~s, a procedure of an object, or a pair of a name and a procedure, got ~s" (append %schedule-keys %schedule-sums) c)))
            columns)
  (%need-rates rates)
  (define (density d) (if (and (list? d) (= (length d) 2)) (second d) (cdr d)))
  (if (not (and (list? densities) (every (lambda (d) (and (pair? d) (real? (density d)))) densities)))
      (error 'schedule "densities must be a list of (material . density), such as (\"oak\" . 700), got ~s" densities))
  (if digits (%need-digits 'schedule digits))
  (define (sum? c) (memq c %schedule-sums))
  (define (mass o looks)
    (let* ((name (caddr looks)) (own (assoc name densities (lambda (a b) (equal? a (%schedule-text b))))) (known (assoc name %densities)))
      (cond
        ((not (solid? o)) 0)
        (own (* (volume o) (density own)))
        (known (* (volume o) (expt (cadddr looks) 3) (cdr known)))
        ((equal? name "") (error 'schedule "there is no mass without a material: (with-material 'oak ~a) gives one" (car looks)))
        (else (error 'schedule "there is no density of ~s: #:densities '((~s . 700)) gives one" name name)))))
  (define (measure o looks c)
    (case c
      ((count) 1)
      ((length) (if (curve? o) (curve-length o) 0))
      ((area) (if (curve? o) 0 (area o)))
      ((volume) (if (solid? o) (volume o) 0))
      ((mass) (mass o looks))
      (else
        (let ((rate (%schedule-find rates (list (cadr looks) (caddr looks) (car looks)))))
          (if rate (* (caddr rate) (measure o looks (cadr rate))) 0)))))
  (define (cell o looks c)
    (case c
      ((name) (car looks))
      ((part) (or (object-part o) ""))
      ((layer) (cadr looks))
      ((material) (caddr looks))
      (else (cond ((procedure? c) (c o)) ((pair? c) ((cdr c) o)) (else (measure o looks c))))))
  (let* ((rows (make-hash)) (keys? (map (lambda (c) (not (sum? c))) columns)))
    (for-each
      (lambda (o)
        (let* ((looks (%schedule-looks o)) (cells (map (lambda (c) (cell o looks c)) columns))
               (key (filter-map (lambda (x key?) (and key? (list x))) cells keys?)) (old (hash-ref rows key #f)))
          (hash-set! rows key (if old (map (lambda (x y key?) (if key? x (+ x y))) old cells keys?) cells))))
      (%schedule-objects objects))
    (let* ((made (map cdr (hash->list rows))) (head (map %column-head columns)))
      (define (total-of i) (apply + (map (lambda (row) (list-ref row i)) made)))
      (append
        (list head)
        (map (lambda (row) (map (lambda (x) (%rounded x digits)) row)) made)
        (if total
            (list (map (lambda (i key?) (if key? (if (= i 0) "total" "") (%rounded (total-of i) digits))) (iota (length columns)) keys?))
            '())))))

; ---- parts and their numbers ----

; Returns the parts in a list of objects, or of lists of objects. An object of the list, such as a slice with its number,
; is one part; but a layer or a material of solids has its solids as parts, as in schedule. In place of a list, a layer or
; a material has its objects as parts, of any kind.
(define (%flat-parts who parts)
  (define (refuse) (error who "parts must be a list of objects, got ~s" parts))
  (define (look? o) (memq (object-kind o) '(layer with-material)))
  (define (part o)
    (cond ((not (object? o)) (refuse)) ((empty-object? o) '()) ((and (look? o) (solid? o)) (%schedule-objects o)) (else (list o))))
  (cond
    ((list? parts) (append-map (lambda (p) (if (list? p) (append-map part p) (part p))) parts))
    ((and (object? parts) (look? parts)) (%schedule-objects parts))
    (else (part parts))))

; Returns a list of lists: the parts that are equal, up to place and turn, in the order of their first parts. Equal parts
; may differ by a share of their size or by a length, whichever is more.
(define (%groups-of who parts tolerance length)
  (let ((parts (%flat-parts who parts)) (groups (make-hash)))
    (for-each (lambda (part first) (hash-set! groups first (cons part (hash-ref groups first '())))) parts (%part-groups (map %drawn parts) tolerance length))
    (map (lambda (group) (reverse (cdr group))) (hash->list groups))))
(define (%need-part-tolerance who tolerance)
  (if (not (and (real? tolerance) (< 0 tolerance 1))) (error who "#:tolerance must be a number between 0 and 1, got ~s" tolerance)))
(define (part-groups parts #:tolerance [tolerance any? 1e-6])
  (%need-part-tolerance 'part-groups tolerance)
  (%groups-of 'part-groups parts tolerance 0))

; Returns the lengths of the smallest box around a part, the largest first.
(define (part-size o)
  (if (not (object? o)) (error 'part-size "o must be an object, got ~s" o))
  (let* ((found (if (empty-object? o) #f (%part-size (%drawn o)))) (box (and found (bounding-box (do-transform o (car found))))))
    (if box
        (let ((d (p-p (cadr box) (car box))))
          (sort (map (lambda (exact meshed) (if (< exact (* 1.01 meshed)) exact meshed)) (list (cx d) (cy d) (cz d)) (cdr found)) >))
        '(0. 0. 0.))))

; Returns the mark of part number i: A to Z, then AA, AB and so on.
(define (%part-mark i)
  (let ((letter (string (integer->char (+ 65 (modulo i 26))))))
    (if (< i 26) letter (string-append (%part-mark (- (quotient i 26) 1)) letter))))

(define %cut-sizes '(length width thickness))

; Returns the part's size, to be rounded; lengths in the middle of two rounded numbers, such as 0.115, all come out on the upper side.
(define (%clean-size p digits) (map (lambda (x) (if digits (* x (+ 1 1e-12)) x)) (part-size p)))

; Returns a list of lists: the parts of a group whose rounded sizes are equal, in the order of their first parts.
(define (%groups-of-size parts digits)
  (let ((groups (make-hash)))
    (for-each (lambda (p)
                (let ((key (map (lambda (x) (%rounded x digits)) (%clean-size p digits))))
                  (hash-set! groups key (cons p (hash-ref groups key '())))))
              parts)
    (map (lambda (group) (reverse (cdr group))) (hash->list groups))))

; Returns rows: a head, then a row for each set of equal parts: their mark, their number, and the other columns. Rounded
; lengths make parts equal that differ by less than half of the last digit; a tolerance replaces this rule.
(define (cut-list parts #:digits [digits any? #f] #:tolerance [tolerance any? #f] #:densities [densities any? '()] . columns)
  (if digits (%need-digits 'cut-list digits))
  (if tolerance (%need-part-tolerance 'cut-list tolerance))
  (for-each (lambda (c)
              (if (not (or (memq c '(mark count)) (memq c %cut-sizes) (and (not (eq? c 'cost)) (%schedule-column? c))))
                  (error 'cut-list "a column is one of ~s, a procedure of an object, or a pair of a name and a procedure, got ~s"
                         (append '(mark count) %cut-sizes '(name layer material area volume mass)) c)))
            columns)
  (let ((columns (if (null? columns) '(mark count length width thickness) columns))
        (groups (if (and digits (not tolerance))
                    (append-map (lambda (g) (%groups-of-size g digits)) (%groups-of 'cut-list parts 0 (/ (expt 10. (- digits)) 2)))
                    (%groups-of 'cut-list parts (or tolerance 1e-6) 0))))
    (define (cell c group number size)
      (cond
        ((eq? c 'mark) (%part-mark number))
        ((eq? c 'count) (length group))
        ((memq c %cut-sizes) => (lambda (rest) (list-ref size (- 3 (length rest)))))
        (else
          (let ((cells (map car (cdr (schedule (car group) c #:densities densities)))))
            (if (memq c %schedule-sums) (apply + cells) (car cells))))))
    (cons (map %column-head columns)
          (let loop ((groups groups) (number 0))
            (if (null? groups)
                '()
                (let ((size (%clean-size (caar groups) digits)))
                  (cons (map (lambda (c) (%rounded (cell c (car groups) number size) digits)) columns)
                        (loop (cdr groups) (+ number 1)))))))))

; ---- rooms ----

; Returns the point of a region that is furthest from its border.
(define (region-middle o)
  (if (not (region? o)) (error 'region-middle "o must be a region, got ~s" o))
  (let ((middle (%largest-circle o))) (if middle (car middle) (error 'region-middle "o has no area"))))

; Writes the name of a room and its area in square metres into drawings, where the room is widest.
(define (room-label region name #:digits [digits any? 2] #:view [view any? #f])
  (if (not (region? region)) (error 'room-label "region must be a region, got ~s" region))
  (if (not (string? name)) (error 'room-label "name must be a string, got ~s" name))
  (%need-digits 'room-label digits)
  (let ((text (string-append name "\n" (%fixed-text (* (area region) (expt (cadddr (%schedule-looks region)) 2)) digits) " m²")))
    (if view (label (region-middle region) text #:view view) (label (region-middle region) text))))

; ---- tables on the sheet ----

; Returns a real number with exactly this many decimals.
(define (%fixed-text x digits)
  (let* ((whole (number->string (exact (round (* (abs (exact x)) (expt 10 digits))))))
         (padded (if (> (string-length whole) digits) whole (string-append (make-string (- (+ digits 1) (string-length whole)) #\0) whole)))
         (point (- (string-length padded) digits)) (sign (if (and (negative? x) (string-index padded (lambda (c) (not (char=? c #\0))))) "-" "")))
    (string-append sign (substring padded 0 point) (if (= digits 0) "" ".") (substring padded point))))

(define (%table-text x digits)
  (let ((text (cond
                ((string? x) x)
                ((not x) "")
                ((exact-integer? x) (number->string x))
                ((and (real? x) (finite? x)) (%fixed-text x digits))
                (else (call-with-output-string (lambda (port) (display x port)))))))
    (string-map (lambda (c) (if (char<? c #\space) #\space c)) text)))

; Puts rows, lists of cells, as a table onto the sheet of drawings. The first row is the head.
(define (sheet-table rows #:title [title any? ""] #:digits [digits any? 2])
  (if (not (and (list? rows) (pair? rows) (every list? rows) (pair? (car rows))))
      (error 'sheet-table "rows must be a list of lists, such as those of schedule, got ~s" rows))
  (if (not (string? title)) (error 'sheet-table "#:title must be a string, got ~s" title))
  (%need-digits 'sheet-table digits)
  (let ((columns (apply max (map length rows))))
    (define (padded row) (append row (make-list (- columns (length row)) "")))
    (define decimal? (apply map (lambda cells (any (lambda (x) (and (real? x) (not (exact-integer? x)))) cells)) (map padded rows)))
    (define (even row) (map (lambda (x d) (if (and d (exact-integer? x)) (exact->inexact x) x)) (padded row) decimal?))
    (%sheet-table (string-join (map (lambda (x) (%table-text x digits)) (append-map even rows)) (string #\x1f)) columns
                  (%table-text title 0))))

; ---- files ----

(define (%csv-cell x separator)
  (let ((text (cond
                ((string? x) x)
                ((not x) "")
                ((and (rational? x) (exact? x) (not (integer? x))) (number->string (inexact x)))
                (else (call-with-output-string (lambda (port) (display x port)))))))
    (if (or (string-contains? text (string separator)) (string-contains? text "\"") (string-contains? text "\n") (string-contains? text "\r"))
        (string-append "\"" (string-replace text "\"" "\"\"") "\"")
        text)))

; Writes rows, lists of cells, as a file of comma-separated values.
(define (write-csv file rows #:separator [separator any? #\,])
  (%need-string 'write-csv file)
  (if (string-suffix? file ".xlsx") (error 'write-csv "write-xlsx writes ~a" file))
  (if (not (and (list? rows) (every list? rows))) (error 'write-csv "rows must be a list of lists, got ~s" rows))
  (if (not (char? separator)) (error 'write-csv "#:separator must be a character, got ~s" separator))
  (let ((lines (map (lambda (row) (string-append (string-join (map (lambda (x) (%csv-cell x separator)) row) (string separator)) "\n")) rows)))
    (call-with-output-file file (lambda (port) (for-each (lambda (l) (write-string l port)) lines)))))

; The marks before each sheet's name, row and cell in the text of %write-xlsx.
(define %sheet-mark (string #\x1d))
(define %row-mark (string #\x1e))
(define %cell-mark (string #\x1f))

; Returns a letter for the kind of a cell, then its value.
(define (%xlsx-cell x)
  (define (text s)
    (if (> (string-length s) 32767) (error 'write-xlsx "a cell has at most 32767 characters, got ~s" (string-length s)))
    (string-append "s" (string-map (lambda (c) (if (or (and (char<? c #\space) (not (memv c '(#\newline #\tab)))) (memv c '(#\xfffe #\xffff))) #\space c)) s)))
  (cond
    ((string? x) (text x))
    ((not x) "")
    ((eq? x #t) "b")
    ((and (real? x) (finite? (inexact x))) (string-append (if (exact-integer? x) "i" "r") (number->string (inexact x))))
    (else (text (call-with-output-string (lambda (port) (display x port)))))))

(define (%need-sheet-name name others)
  (cond
    ((or (string=? name "") (> (string-length name) 31) (string-index name (lambda (c) (or (char<? c #\space) (memv c (string->list "[]:*?/\\")))))
         (string-prefix? name "'") (string-suffix? name "'"))
     (error 'write-xlsx "the name of a sheet has 1 to 31 characters without [ ] : * ? / \\, got ~s" name))
    ((member name others string-ci=?) (error 'write-xlsx "two sheets have the name ~s" name))))

; Writes sheets, each rows or a pair of a name and rows, as a workbook of Excel. The first row of a sheet is the head.
(define (write-xlsx file #:digits [digits any? #f] . sheets)
  (%need-string 'write-xlsx file)
  (if digits (%need-digits 'write-xlsx digits))
  (if (null? sheets) (error 'write-xlsx "takes rows, such as those of schedule, or pairs of a name and rows"))
  (define (named? sheet) (and (pair? sheet) (string? (car sheet))))
  (define names (map (lambda (sheet i) (if (named? sheet) (car sheet) (format "Sheet~a" i))) sheets (iota (length sheets) 1)))
  (define (rows-of sheet)
    (let ((rows (if (named? sheet) (cdr sheet) sheet)))
      (if (not (and (list? rows) (every list? rows))) (error 'write-xlsx "rows must be a list of lists, got ~s" rows))
      (if (or (> (length rows) 1048576) (any (lambda (row) (> (length row) 16384)) rows))
          (error 'write-xlsx "a sheet has at most 1048576 rows of 16384 cells"))
      rows))
  (define (row-text row) (string-append %row-mark (string-join (map (lambda (x) (string-append %cell-mark (%xlsx-cell x))) row) "")))
  (let check ((names names) (others '()))
    (when (pair? names) (%need-sheet-name (car names) others) (check (cdr names) (cons (car names) others))))
  (%write-xlsx file
               (string-join (append-map (lambda (name sheet) (cons (string-append %sheet-mark name) (map row-text (rows-of sheet)))) names sheets) "")
               (or digits -1)))
