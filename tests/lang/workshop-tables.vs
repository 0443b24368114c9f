; schedules: groups, sums, rates, densities; files of rows that load-csv reads again
(define (wall x) (make-box origin (xyz x 0.5 3)))
(define walls (layer "walls" (with-material brick (wall 5)) (with-material brick (wall 4)) (wall 4)))
(define slab (layer "slab" (with-material concrete (make-box origin (xyz 5 4 0.25)))))
(define column (unite (make-box origin (xyz 1 1 1)) (make-box (xyz 0 0 1) (xyz 1 1 4)))) ; one object of two boxes
(define all (list walls (list slab (do-move column ux)) (make-line origin (xy 3 4)) (make-region (make-rectangle origin (xy 2 3))) (empty-object)))
(define (show rows) (for-each displayln rows))
(show (schedule all 'layer 'count 'length 'area 'volume))
; expect: (layer count length area volume)
; expect: (walls 3 0 100.0 19.5)
; expect: (slab 1 0 44.5 5.0)
; expect: ( 3 5.0 24.0 4.0)
(show (schedule all 'layer 'material 'name 'count))
; expect: (layer material name count)
; expect: (walls brick box 2)
; expect: (walls  box 1)
; expect: (slab concrete box 1)
; expect: (  unite 1)
; expect: (  line 1)
; expect: (  region 1)
; the order of the first of each; a union with layers inside, nested looks, kinds of programs
(define-primitive post height)
(register-drawing-function post? (lambda (p) (make-box origin (xyz 1 1 (post-height p)))))
(show (schedule (list (unite (layer "b" (wall 1)) (with-material 'oak (layer "a" (wall 2) (wall 2)))) (make-post 3) (make-post 4)) 'layer 'material 'name 'count 'volume))
; expect: (layer material name count volume)
; expect: (b  box 1 1.5)
; expect: (a oak box 2 6.0)
; expect: (  post 2 7.0)
; rates by layer, material and kind, in this order; masses of ready materials and of others, in the units of the model
(show (schedule (list walls slab) 'material 'cost #:rates '(("walls" count 100) (concrete volume 180) (box area 1))))
; expect: (material cost)
; expect: (brick 200)
; expect: ( 100)
; expect: (concrete 900.0)
(displayln (schedule slab 'mass))                          ; expect: ((mass) (12000.0))
(units 'cm)
(displayln (schedule slab 'mass #:digits 4))               ; expect: ((mass) (0.012))
(units 'm)
(displayln (schedule (with-material 'oak (wall 2)) 'mass #:densities '((oak . 700)))) ; expect: ((mass) (2100.0))
(displayln (schedule (make-sphere origin 1) 'volume #:digits 2))   ; expect: ((volume) (4.19))
(show (schedule (list walls slab) 'layer 'material 'count 'volume #:total #t))
; expect: (layer material count volume)
; expect: (walls brick 2 13.5)
; expect: (walls  1 6.0)
; expect: (slab concrete 1 5.0)
; expect: (total  4 24.5)
; procedures group by their values
(show (schedule walls (cons 'side (lambda (o) (cx (second (bounding-box o))))) 'count))
; expect: (side count)
; expect: (5.0 1)
; expect: (4.0 2)
(displayln (schedule '() 'layer 'count))                   ; expect: ((layer count))
(displayln (schedule (slices (make-box origin (xyz 4 4 2)) 1) 'layer 'area)) ; expect: ((layer area) (cut 32.0) (engrave 0))

; files
(define rows '(("name" "count" "share") ("a,b" 1 1/4) ("say \"no\"" 2 0.5) ("two\nlines" 3 #f) ("" -4 1e20)))
(define file (format "/tmp/vs-tables-~a.csv" (current-jiffy)))
(write-csv file rows)
(displayln (map (lambda (row) (list (data-ref row 'name) (data-ref row 'count) (data-ref row 'share))) (load-csv file)))
; expect: ((a,b 1 0.25) (say "no" 2 0.5) (two
; expect: lines 3 #f) ( -4 100000000000000000000.0))
(write-csv file '((a b) (1 "x;y")) #:separator #\;)
(displayln (file->string file))
; expect: a;b
; expect: 1;"x;y"
; expect:
(write-csv file (schedule (list walls slab) 'layer 'count 'volume))
(displayln (map (lambda (row) (data-ref row 'volume)) (load-csv file))) ; expect: (19.5 5.0)
(delete-file file)

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (c (#t (condition/report-string c))) e "no error")))))
(fails (schedule walls))                                   ; expect: schedule: takes one column or more, such as 'layer 'count 'volume
(fails (schedule walls 'colour))                           ; expect: schedule: a column is one of (name part layer material count length area volume mass cost), a procedure of an object, or a pair of a name and a procedure, got colour
(fails (schedule (list walls 3) 'count))                   ; expect: schedule: objects must be a list of objects, got 3
(fails (schedule (with-material 'oak (wall 1)) 'mass))     ; expect: schedule: there is no density of "oak": #:densities '(("oak" . 700)) gives one
(fails (schedule (wall 1) 'mass))                          ; expect: schedule: there is no mass without a material: (with-material 'oak box) gives one
(fails (schedule walls 'cost #:rates '((brick 3))))        ; expect: schedule: rates must be a list of (name measure rate), such as ("concrete" volume 180), got ((brick 3))
(fails (schedule walls 'count #:digits -1))                ; expect: schedule: digits must be an exact integer from 0 to 15, got -1
(fails (cut-list walls 'mark 'cost))                        ; expect: cut-list: a column is one of (mark count length width thickness name layer material area volume mass), a procedure of an object, or a pair of a name and a procedure, got cost
(fails (write-csv 3 '()))                                  ; expect: write-csv: expected a string, got 3
(fails (write-csv "a.csv" '(1)))                           ; expect: write-csv: rows must be a list of lists, got (1)
(fails (write-csv "/nowhere/at/all.csv" '((1))))           ; expect: open-output-file: cannot open /nowhere/at/all.csv: no such file
(fails (write-csv "a.xlsx" '((1))))                        ; expect: write-csv: write-xlsx writes a.xlsx

; workbooks: tests/workers/cutting.sh reads their cells
(define book (format "/tmp/vs-tables-~a.xlsx" (current-jiffy)))
(write-xlsx book rows (cons "walls" (schedule walls 'layer 'count)))
(define first-bytes (call-with-port (open-binary-input-file book) (lambda (p) (read-bytevector 1000000 p))))
(displayln (utf8->string first-bytes 0 2))                 ; expect: PK
(write-xlsx book rows (cons "walls" (schedule walls 'layer 'count)))
(displayln (equal? first-bytes (call-with-port (open-binary-input-file book) (lambda (p) (read-bytevector 1000000 p))))) ; expect: #t
(delete-file book)
(fails (write-xlsx "a.xlsx"))                              ; expect: write-xlsx: takes rows, such as those of schedule, or pairs of a name and rows
(fails (write-xlsx "a.xlsx" '(1)))                         ; expect: write-xlsx: rows must be a list of lists, got (1)
(fails (write-xlsx "a.xlsx" (cons "a/b" '((1)))))          ; expect: write-xlsx: the name of a sheet has 1 to 31 characters without [ ] : * ? / \, got "a/b"
(fails (write-xlsx "a.xlsx" (cons "it's'" '((1)))))        ; expect: write-xlsx: the name of a sheet has 1 to 31 characters without [ ] : * ? / \, got "it's'"
(fails (write-xlsx "a.xlsx" (cons "a" '((1))) (cons "A" '((1))))) ; expect: write-xlsx: two sheets have the name "A"
(fails (write-xlsx 3 '((1))))                              ; expect: write-xlsx: expected a string, got 3
(fails (write-xlsx "a.xlsx" '((1)) #:digits 1.5))          ; expect: write-xlsx: digits must be an exact integer from 0 to 15, got 1.5
(fails (write-xlsx "a.xlsx" (list (list (make-string 40000 #\a))))) ; expect: write-xlsx: a cell has at most 32767 characters, got 40000
(fails (write-xlsx "/nowhere/at/all.xlsx" '((1))))         ; expect: write-xlsx: cannot open /nowhere/at/all.xlsx: no such file
