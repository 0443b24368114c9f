; Data files of programs: texts, folders, tables (CSV), JSON. Relative names begin at the program's own file;
; bind/data.c finds and reads the files. Names that begin with % are hidden from programs. Compiled into the binary when
; it is built.

; ---- texts and folders ----

(define (file->string file) (%need-string 'file->string file) (%file->string (%data-path file)))

(define (%lines text)
  (let ((n (string-length text)))
    (let loop ((start 0) (i 0) (lines '()))
      (cond ((= i n) (reverse (if (= start n) lines (cons (substring text start n) lines))))
            ((char=? (string-ref text i) #\newline) (loop (+ i 1) (+ i 1) (cons (substring text start i) lines)))
            ((char=? (string-ref text i) #\return)
             (let ((next (if (and (< (+ i 1) n) (char=? (string-ref text (+ i 1)) #\newline)) (+ i 2) (+ i 1))))
               (loop next next (cons (substring text start i) lines))))
            (else (loop start (+ i 1) lines))))))

(define (file->lines file) (%need-string 'file->lines file) (%lines (%file->lines (%data-path file))))

(define (directory-files [folder any? "."] [ending any? ""])
  (%need-string 'directory-files folder)
  (%need-string 'directory-files ending)
  (sort (filter (lambda (name) (string-suffix? name ending)) (%directory-files (%data-path folder))) string<?))

; ---- rows, objects, arrays ----

(define (%keys data) (map car (filter pair? data)))
(define (%same-key? a b) (if (symbol? a) (eq? a b) (equal? a b)))

(define (data-ref data key . more)
  (let ((value
         (cond ((and (or (symbol? key) (string? key)) (or (null? data) (and (list? data) (pair? (car data)))))
                (let ((found (assoc (if (string? key) (string->symbol key) key) data %same-key?)))
                  (if found (cdr found) (error 'data-ref "there is no ~s; there are ~s" key (%keys data)))))
               ((and (exact-integer? key) (vector? data))
                (if (and (<= 0 key) (< key (vector-length data)))
                    (vector-ref data key)
                    (error 'data-ref "there is no element ~s, the array has ~s" key (vector-length data))))
               ((and (exact-integer? key) (list? data))
                (if (and (<= 0 key) (< key (length data)))
                    (list-ref data key)
                    (error 'data-ref "there is no element ~s, the list has ~s" key (length data))))
               ((hash? data) (hash-ref data key (lambda () (error 'data-ref "there is no ~s in the table" key))))
               ((or (symbol? key) (string? key)) (error 'data-ref "~s asks a row or an object, got ~s" key data))
               (else (error 'data-ref "~s asks an array or a list, got ~s" key data)))))
    (if (null? more) value (apply data-ref value more))))

; ---- tables ----

(define (%csv-fail file line text) (error 'load-csv (string-append (string-replace file "~" "~~") ":" (number->string line) ": " (string-replace text "~" "~~"))))

; Returns the separator that occurs most often in the first line.
(define (%csv-separator text)
  (let loop ((i 0) (quoted #f) (commas 0) (semicolons 0) (tabs 0))
    (let ((c (if (< i (string-length text)) (string-ref text i) #\newline)))
      (cond ((char=? c #\") (loop (+ i 1) (not quoted) commas semicolons tabs))
            ((and quoted (< i (string-length text))) (loop (+ i 1) quoted commas semicolons tabs))
            ((or (char=? c #\newline) (char=? c #\return))
             (cond ((and (>= semicolons commas) (>= semicolons tabs) (> semicolons 0)) #\;)
                   ((> tabs commas) #\tab)
                   (else #\,)))
            (else (loop (+ i 1) quoted (if (char=? c #\,) (+ commas 1) commas) (if (char=? c #\;) (+ semicolons 1) semicolons) (if (char=? c #\tab) (+ tabs 1) tabs)))))))

; Returns rows as (line cell ...), with cells as strings. It skips blank lines.
(define (%csv-rows file text separator)
  (define n (string-length text))
  (define (line-end? c) (or (char=? c #\newline) (char=? c #\return)))
  (define (past-line-end i)
    (if (and (char=? (string-ref text i) #\return) (< (+ i 1) n) (char=? (string-ref text (+ i 1)) #\newline)) (+ i 2) (+ i 1)))
  ; reads a quoted cell from i on; calls (k text lines) with the place after it
  (define (quoted i line)
    (let scan ((k i) (from i) (parts '()) (lines 0))
      (cond ((>= k n) (%csv-fail file line "a \" is missing: this cell is never closed"))
            ((not (char=? (string-ref text k) #\")) (scan (+ k 1) from parts (if (char=? (string-ref text k) #\newline) (+ lines 1) lines)))
            ((and (< (+ k 1) n) (char=? (string-ref text (+ k 1)) #\")) (scan (+ k 2) (+ k 2) (cons (substring text from (+ k 1)) parts) lines))
            (else (list (+ k 1) (apply string-append (reverse (cons (substring text from k) parts))) lines)))))
  (define (skip-blanks i) (if (and (< i n) (memv (string-ref text i) '(#\space #\tab)) (not (char=? (string-ref text i) separator))) (skip-blanks (+ i 1)) i))
  (let row ((i 0) (line 1) (rows '()))
    (if (>= i n)
        (reverse rows)
        (let cell ((i (skip-blanks i)) (now line) (cells '()))
          (define (behind k text now)
            (cond ((>= k n) (row k now (finish (cons text cells))))
                  ((char=? (string-ref text-of k) separator) (cell (skip-blanks (+ k 1)) now (cons text cells)))
                  (else (row (past-line-end k) (+ now 1) (finish (cons text cells))))))
          (define text-of text)
          (define (finish cells) (if (equal? cells '("")) rows (cons (cons line (reverse cells)) rows)))
          (if (and (< i n) (char=? (string-ref text i) #\"))
              (let* ((found (quoted (+ i 1) now)) (k (skip-blanks (car found))))
                (if (or (>= k n) (char=? (string-ref text k) separator) (line-end? (string-ref text k)))
                    (behind k (cadr found) (+ now (caddr found)))
                    (%csv-fail file now "behind the \" that closes a cell stands more text")))
              (let scan ((k i))
                (if (or (>= k n) (char=? (string-ref text k) separator) (line-end? (string-ref text k)))
                    (behind k (string-trim-right (substring text i k)) now)
                    (scan (+ k 1)))))))))

; Returns the number in a cell, or #f. Tables with semicolons write decimals with a comma.
(define (%csv-number cell comma?)
  (let loop ((i 0) (digit #f))
    (if (< i (string-length cell))
        (let ((c (string-ref cell i)))
          (cond ((char<=? #\0 c #\9) (loop (+ i 1) #t))
                ((or (memv c '(#\+ #\- #\. #\e #\E)) (and comma? (char=? c #\,))) (loop (+ i 1) digit))
                (else #f)))
        (and digit (string->number (if comma? (string-replace cell "," ".") cell))))))

(define (%csv-column file name type cells lines comma?)
  (define (number cell) (and (not (string=? cell "")) (%csv-number cell comma?)))
  (define (all-numbers?) (let loop ((l cells) (some #f)) (cond ((null? l) some) ((string=? (car l) "") (loop (cdr l) some)) (else (and (number (car l)) (loop (cdr l) #t))))))
  (case type
    ((number)
     (map (lambda (cell line)
            (cond ((string=? cell "") #f)
                  ((number cell))
                  (else (%csv-fail file line (format "column ~a: expected a number, got ~s" name cell)))))
          cells lines))
    ((symbol) (map string->symbol cells))
    ((text) cells)
    ((#f) (if (all-numbers?) (map number cells) cells))
    (else (error 'load-csv "a type is number, text or symbol, got ~s" type))))

(define (load-csv file #:header [header any? #t] #:separator [separator any? #f] #:types [types any? '()])
  (%need-string 'load-csv file)
  (if (not (or (not separator) (char? separator))) (error 'load-csv "#:separator is a character, got ~s" separator))
  (if (not (and (list? types) (every pair? types))) (error 'load-csv "#:types is a list of (column . type), got ~s" types))
  (let* ((path (%data-path file))
         (text (%load-csv path))
         (by (or separator (%csv-separator text)))
         (rows (%csv-rows path text by)))
    (if (null? rows)
        '()
        (let* ((names (if header
                          (map (lambda (name i) (string->symbol (if (string=? name "") (format "column~a" i) name))) (cdar rows) (iota (length (cdar rows)) 1))
                          (iota (length (cdar rows)))))
               (body (if header (cdr rows) rows))
               (lines (map car body))
               (types-of (make-hasheqv)) ; name -> type, or #f
               (count (length names)))
          (for-each (lambda (name)
                      (if (hash-has-key? types-of name) (%csv-fail path (caar rows) (format "two columns are called ~a" name)))
                      (hash-set! types-of name #f))
                    names)
          (for-each (lambda (type)
                      (if (not (hash-has-key? types-of (car type))) (error 'load-csv "#:types: there is no column ~s; there are ~s" (car type) names))
                      (hash-set! types-of (car type) (cdr type)))
                    (reverse types)) ; the first of a name counts
          (for-each (lambda (row)
                      (if (not (= (length (cdr row)) count))
                          (%csv-fail path (car row) (format "this row has ~a cells, the first ~a" (length (cdr row)) count))))
                    body)
          (let* ((columns (if (null? body) (map (lambda (name) '()) names) (apply map list (map cdr body))))
                 (typed (map (lambda (name cells) (%csv-column path name (hash-ref types-of name) cells lines (char=? by #\;))) names columns)))
            (cond ((null? body) '())
                  (header (apply map (lambda row (map cons names row)) typed))
                  (else (apply map list typed))))))))

; ---- JSON ----

(define (%json-string text port)
  (write-char #\" port)
  (string-for-each
   (lambda (c)
     (case c
       ((#\") (write-string "\\\"" port))
       ((#\\) (write-string "\\\\" port))
       ((#\newline) (write-string "\\n" port))
       ((#\return) (write-string "\\r" port))
       ((#\tab) (write-string "\\t" port))
       (else (if (char<? c #\space)
                 (write-string (string-append "\\u" (string-pad-left (number->string (char->integer c) 16) 4 #\0)) port)
                 (write-char c port)))))
   text)
  (write-char #\" port))

(define (%json-object? data) (and (list? data) (every (lambda (p) (and (pair? p) (or (symbol? (car p)) (string? (car p))))) data)))

(define (%json-write who data indent port)
  (define (line depth) (if indent (begin (newline port) (write-string (make-string (* indent depth) #\space) port))))
  (define (items open close l write-one depth)
    (write-char open port)
    (let loop ((l l) (first #t))
      (if (pair? l)
          (begin (if (not first) (write-string (if indent "," ", ") port))
                 (line (+ depth 1))
                 (write-one (car l))
                 (loop (cdr l) #f))
          (if (not first) (line depth))))
    (write-char close port))
  (define (object members depth)
    (items #\{ #\} members
           (lambda (p)
             (%json-string (if (symbol? (car p)) (symbol->string (car p)) (car p)) port)
             (write-string ": " port)
             (value (cdr p) (+ depth 1)))
           depth))
  (define (array l depth) (items #\[ #\] l (lambda (x) (value x (+ depth 1))) depth))
  (define (value data depth)
    (cond ((> depth 1000) (error who "the data is nested too deeply, or in a circle"))
          ((eq? data #t) (write-string "true" port))
          ((eq? data #f) (write-string "false" port))
          ((eq? data 'null) (write-string "null" port))
          ((string? data) (%json-string data port))
          ((symbol? data) (%json-string (symbol->string data) port))
          ((exact-integer? data) (write data port))
          ((and (real? data) (finite? data)) (write (inexact data) port))
          ((vector? data) (array (vector->list data) depth))
          ((%json-object? data) (object data depth))
          ((list? data) (array data depth))
          ((or (point? data) (gvector? data)) (array (list (cx data) (cy data) (cz data)) depth))
          ((hash? data)
           (let ((members (hash->list data)))
             (if (not (every (lambda (p) (or (symbol? (car p)) (string? (car p)))) members)) (error who "the keys of an object are symbols or strings, got ~s" (map car members)))
             (object (sort (map (lambda (p) (cons (if (symbol? (car p)) (symbol->string (car p)) (car p)) (cdr p))) members) (lambda (a b) (string<? (car a) (car b)))) depth)))
          (else (error who "JSON has no form for ~s" data))))
  (value data 0))

(define (%json-text who data indent)
  (if (not (or (not indent) (and (exact-integer? indent) (<= 0 indent 40)))) (error who "#:indent is a number of blanks or #f, got ~s" indent))
  (let ((port (open-output-string)))
    (%json-write who data indent port)
    (get-output-string port)))
(define (json->string data #:indent [indent any? #f]) (%json-text 'json->string data indent))

; to: a port, the name of a file, or #f for the program's output
(define (write-json data [to any? #f] #:indent [indent any? 2])
  (if (not (or (not to) (string? to) (output-port? to))) (error 'write-json "to is a port or the name of a file, got ~s" to))
  (let ((text (%json-text 'write-json data indent))) ; all text exists before the file is opened
    (if (string? to)
        (call-with-port (%write-json to) (lambda (port) (write-string text port) (newline port)))
        (let ((port (or to (current-output-port)))) (write-string text port) (newline port)))))

; ---- materials of Wavefront's .mtl files ----

(define (%mtl-fail file line text) (error 'load-mtl "~a:~a: ~a" file line text))

; Returns the words between blanks and tabs.
(define (%words text) (filter (lambda (w) (not (string=? w ""))) (string-split (string-replace text "\t" " ") " ")))

(define (%mtl-numbers file line words least most)
  (map (lambda (word)
         (let ((x (%csv-number word #f)))
           (if (not (and x (finite? x))) (%mtl-fail file line (format "expected a number, got ~s" word)))
           (if (not (<= least x most))
               (%mtl-fail file line (format "expected a number ~a, got ~a"
                                      (if (= most +inf.0) (format "of ~a or more" least) (format "from ~a to ~a" least most)) word)))
           x))
       words))

; Makes a material of the lines below its name. The format writes a metal as a black Kd and a Ks. Ns becomes roughness
; by the inverse of our own .obj files (backends/mesh/mesh_formats.c); Pr and Pm are roughness and metallic themselves.
(define (%mtl-material name said)
  (define (one key default) (let ((x (hash-ref said key #f))) (if x (car x) default)))
  (define kd (hash-ref said 'Kd '(0.8 0.8 0.8)))
  (define ks (hash-ref said 'Ks '(0 0 0)))
  (define metal? (and (every zero? kd) (not (every zero? ks)) (not (= (one 'illum 2) 1))))
  (define shine (max 0 (min 1 (/ (- (one 'Ns 51.5) 2) 198))))
  (define picture (%mtl-found name (hash-ref said 'map_Kd #f)))
  (define roughness (one 'Pr (if (< (one 'illum 2) 2) 1 (- 1 (sqrt shine)))))
  (define metallic (one 'Pm (if metal? 1 0)))
  (define transparency (one 'Tr (- 1 (one 'd 1))))
  (define ior (if (>= (one 'Ni 1.5) 1) (one 'Ni 1.5) 1.5))
  (if picture
      (make-material #:name name #:roughness roughness #:metallic metallic #:transparency transparency #:ior ior
        #:image (car picture) #:pattern-size (cdr picture))
      (make-material #:name name #:roughness roughness #:metallic metallic #:transparency transparency #:ior ior
        #:color (if metal? ks kd))))

; A palette often comes without its pictures: a missing one gives a warning, and the material has its plain colour. A
; broken picture is an error, as for any material.
(define (%mtl-found name picture)
  (cond ((not picture) #f)
        ((file-exists? (car picture)) picture)
        (else (%warn (format "load-mtl: no such picture: ~a; ~a has its plain colour" (car picture) name)) #f)))

; Reads a line `map_Kd -s 2 2 1 wall.jpg`: returns the picture's file, in the folder of the materials, and its width in
; metres. The format counts in parts of a surface, which is taken as a metre wide; -s repeats the picture on it. Other
; options do not change the size.
(define (%mtl-picture file line words)
  (let next ((words words) (repeats 1))
    (define (number i) (and (> (length words) i) (%csv-number (list-ref words i) #f)))
    (cond ((null? words) (%mtl-fail file line "map_Kd names no file"))
          ((and (pair? (cdr words)) (char=? (string-ref (car words) 0) #\-))
           (let ((values (let count ((i 1)) (if (and (< i 4) (number i)) (count (+ i 1)) (- i 1)))))
             (next (list-tail words (+ 1 (if (= values 0) 1 values)))
                   (if (and (string=? (car words) "-s") (> values 0))
                       (if (positive? (number 1)) (number 1) (%mtl-fail file line "-s repeats a picture a positive number of times"))
                       repeats))))
          (else (let ((name (string-join words " ")))
                  (cons (string-append (%folder-of file) name) (/ 1 repeats)))))))

(define (%folder-of file)
  (let at ((i (string-length file)))
    (cond ((= i 0) "") ((char=? (string-ref file (- i 1)) #\/) (substring file 0 i)) (else (at (- i 1))))))

; The keys of a material that are read: the key, the count of numbers, their least and greatest value. All other lines
; are skipped.
(define %mtl-keys
  '((Kd 3 0 1) (Ks 3 0 1) (Ns 1 0 +inf.0) (d 1 0 1) (Tr 1 0 1) (Ni 1 0 +inf.0) (illum 1 0 10) (Pr 1 0 1) (Pm 1 0 1)))

(define (load-mtl file)
  (%need-string 'load-mtl file)
  (let ((path (%data-path file)) (materials (make-hash)))
    (define (put name said) (if name (hash-set! materials name (%mtl-material name said))))
    (let next ((lines (%lines (%load-mtl path))) (line 1) (name #f) (said #f))
      (if (null? lines)
          (put name said)
          (let* ((text (string-trim (car lines))) (words (%words text))
                 (key (and (pair? words) (assq (string->symbol (car words)) %mtl-keys))))
            (cond
              ((and (pair? words) (string=? (car words) "newmtl"))
               (let ((new (string-trim (substring text 6 (string-length text)))))
                 (put name said)
                 (if (string=? new "") (%mtl-fail path line "a name is missing after newmtl"))
                 (if (hash-ref materials new #f) (%mtl-fail path line (format "the material ~s is there already" new)))
                 (next (cdr lines) (+ line 1) new (make-hasheq))))
              ((and name (pair? words) (string=? (car words) "map_Kd"))
               (hash-set! said 'map_Kd (%mtl-picture path line (cdr words)))
               (next (cdr lines) (+ line 1) name said))
              ((not key) (next (cdr lines) (+ line 1) name said))
              ((not name) (%mtl-fail path line (format "~a comes before the first newmtl" (car words))))
              ((not (= (length (cdr words)) (cadr key)))
               (%mtl-fail path line (format "~a takes ~a number~a, got ~s" (car words) (cadr key)
                                      (if (= (cadr key) 1) "" "s") (string-trim (substring text (string-length (car words)) (string-length text))))))
              (else
                (hash-set! said (car key) (%mtl-numbers path line (cdr words) (caddr key) (cadddr key)))
                (next (cdr lines) (+ line 1) name said))))))
    (if (= (hash-count materials) 0) (error 'load-mtl "~a holds no material: no line begins with newmtl" path))
    materials))
