; Generators. They return `end` after their last value.

(define end (eof-object))
(define end? eof-object?)

; Returns a generator with a state: (step state) returns the value and the next state, or only `end`, after which it is
; not called again.
(define (stepping state step)
  (let ((over #f))
    (lambda ()
      (if over
          end
          (call-with-values (lambda () (step state))
            (case-lambda
              ((value) (set! over #t) (set! state #f) value)
              ((value next) (set! state next) value)))))))

; (let-next ((x generator) ...) then): binds the next value of each generator; returns `end` as soon as one has ended.
(define-syntax let-next
  (syntax-rules ()
    ((_ () . body) (let () . body))
    ((_ ((x g) . more) . body) (let ((x (g))) (if (end? x) end (let-next more . body))))))
; Returns the next value of each, or #f as soon as one has ended.
(define (next-of-all generators)
  (let loop ((left generators) (found '()))
    (if (null? left)
        (reverse found)
        (let ((x ((car left)))) (and (not (end? x)) (loop (cdr left) (cons x found)))))))

; ---- constructors ----

(define (list->generator [items list?])
  (stepping items (lambda (l) (if (null? l) end (values (car l) (cdr l))))))
(define (generator . items) (list->generator items))
(define (circular-generator first . more)
  (let ((all (cons first more))) (stepping all (lambda (l) (let ((l (if (null? l) all l))) (values (car l) (cdr l)))))))
(define (make-iota-generator count [start any? 0] [by any? 1])
  (stepping 0 (lambda (i) (if (< i count) (values (+ start (* i by)) (+ i 1)) end))))
(define (make-range-generator start [stop any? #f] [by any? 1])
  (stepping start (lambda (x) (if (or (not stop) (< x stop)) (values x (+ x by)) end))))

(define (indexed item from to)
  (let ((by (if (<= from to) 1 -1)))
    (stepping from (lambda (i) (if (= i to) end (values (item i) (+ i by)))))))
(define (vector->generator [v vector?] [start any? 0] [stop any? (vector-length v)]) (indexed (lambda (i) (vector-ref v i)) start (max start stop)))
(define (reverse-vector->generator [v vector?] [start any? 0] [stop any? (vector-length v)])
  (indexed (lambda (i) (vector-ref v (- i 1))) (max start stop) start))
(define (string->generator [s string?] [start any? 0] [stop any? (string-length s)]) (indexed (lambda (i) (string-ref s i)) start (max start stop)))
(define (bytevector->generator [b bytevector?] [start any? 0] [stop any? (bytevector-length b)])
  (indexed (lambda (i) (bytevector-u8-ref b i)) start (max start stop)))
; Generates the bits of an integer as booleans, the lowest first.
(define (make-bits-generator n)
  (stepping n (lambda (n) (if (= n 0) end (values (odd? n) (quotient n 2))))))

; The procedure runs to its next `yield`, and continues at the next call of the generator.
(define (make-coroutine-generator [f procedure?])
  (define give #f)
  (define (yield x) (call/cc (lambda (k) (set! resume (lambda () (k #t))) (give x))))
  (define resume
    (lambda ()
      (f yield)
      (set! resume (lambda () (give end)))
      (give end)))
  (lambda () (call/cc (lambda (k) (set! give k) (resume)))))
(define (make-for-each-generator [walk procedure?])
  (lambda (collection) (make-coroutine-generator (lambda (yield) (walk yield collection)))))
(define (make-unfold-generator [stop? procedure?] [value procedure?] [next procedure?] seed)
  (stepping seed (lambda (seed) (if (stop? seed) end (values (value seed) (next seed))))))

; ---- from generators ----

(define (gcons* . parts)
  (let ((g (last parts)))
    (gappend (list->generator (drop-right parts 1)) g)))
(define (gappend . generators)
  (lambda ()
    (let loop ()
      (if (null? generators)
          end
          (let ((x ((car generators))))
            (if (end? x)
                (begin (set! generators (cdr generators)) (loop))
                x))))))
; Runs the generators of a generator one after the other.
(define (gflatten [g procedure?])
  (let ((now (lambda () end)))
    (lambda ()
      (let loop ()
        (let ((x (now)))
          (cond ((not (end? x)) x)
                ((end? now) end)
                (else (set! now (g)) (if (end? now) (begin (set! now (lambda () end)) end) (loop)))))))))
; Generates lists of n values; the last may be shorter, unless padding fills it.
(define (ggroup [g procedure?] n . padding)
  (lambda ()
    (let loop ((i 0) (group '()))
      (let ((x (if (< i n) (g) end)))
        (cond ((not (end? x)) (loop (+ i 1) (cons x group)))
              ((= i 0) end)
              ((and (< i n) (pair? padding)) (append (reverse group) (make-list (- n i) (car padding))))
              (else (reverse group)))))))
; Generates the smallest of the next values of ordered generators; of equal ones the first generator's.
(define (gmerge [less? procedure?] . generators)
  (define (ahead g) (let ((x (g))) (if (end? x) '() (list (cons x g)))))
  (define heads #f)
  (lambda ()
    (if (not heads) (set! heads (append-map ahead generators)))
    (if (null? heads)
        end
        (let ((least (fold (lambda (h best) (if (less? (car h) (car best)) h best)) (car heads) (cdr heads))))
          (set! heads (append-map (lambda (h) (if (eq? h least) (ahead (cdr h)) (list h))) heads))
          (car least)))))
(define (gmap [f procedure?] . generators)
  (lambda () (let ((found (next-of-all generators))) (if found (apply f found) end))))
; (f value ... state) returns a value and the next state.
(define (gcombine [f procedure?] seed . generators)
  (lambda ()
    (let ((found (next-of-all generators)))
      (if found
          (call-with-values (lambda () (apply f (append found (list seed)))) (lambda (x next) (set! seed next) x))
          end))))
(define (gfilter [good? procedure?] [g procedure?])
  (lambda () (let loop () (let-next ((x g)) (if (good? x) x (loop))))))
(define (gremove [bad? procedure?] g) (gfilter (lambda (x) (not (bad? x))) g))
; The first result of (f value state) decides whether the value is kept.
(define (gstate-filter [f procedure?] seed [g procedure?])
  (gfilter (lambda (x) (call-with-values (lambda () (f x seed)) (lambda (good next) (set! seed next) good))) g))
(define (gtake [g procedure?] n [padding any? end])
  (stepping 0 (lambda (i) (if (< i n) (let ((x (g))) (values (if (end? x) padding x) (+ i 1))) end))))
(define (gdrop [g procedure?] n)
  (lambda ()
    (let loop ()
      (if (> n 0) (begin (set! n (- n 1)) (if (end? (g)) (begin (set! n 0) end) (loop))) (g)))))
(define (gtake-while [good? procedure?] [g procedure?])
  (stepping #t (lambda (state) (let ((x (g))) (if (and (not (end? x)) (good? x)) (values x #t) end)))))
(define (gdrop-while [bad? procedure?] [g procedure?])
  (let ((begun #f))
    (gfilter (lambda (x) (or begun (and (not (bad? x)) (begin (set! begun #t) #t)))) g)))
(define (gdelete item g [same? procedure? equal?]) (gremove (lambda (x) (same? item x)) g))
(define (gdelete-neighbor-dups g [same? procedure? equal?])
  (let ((before (list)))
    (gfilter (lambda (x) (let ((new (or (null? before) (not (same? (car before) x))))) (set! before (list x)) new)) g)))
; Generates the values at the places from another generator, which must grow.
(define (gindex [values-of procedure?] [places procedure?])
  (let ((at 0))
    (lambda ()
      (let-next ((place places))
        (if (not (and (exact-integer? place) (>= place at))) (error "gindex: the indices must grow, got" place))
        (let loop () (let-next ((x values-of)) (set! at (+ at 1)) (if (> at place) x (loop))))))))
(define (gselect [values-of procedure?] [truths procedure?])
  (lambda () (let loop () (let-next ((x values-of) (keep truths)) (if keep x (loop))))))

; ---- consumers ----

(define (generator-fold [f procedure?] seed . generators)
  (let loop ((state seed))
    (let ((found (next-of-all generators))) (if found (loop (apply f (append found (list state)))) state))))
(define (generator-for-each [f procedure?] . generators)
  (let loop ()
    (let ((found (next-of-all generators))) (if found (begin (apply f found) (loop))))))
(define (generator-map->list [f procedure?] . generators) (generator->list (apply gmap f generators)))
(define (generator->reverse-list g . most) (generator-fold cons '() (if (null? most) g (gtake g (car most)))))
(define (generator->list g . most) (reverse (apply generator->reverse-list g most)))
(define (generator->vector g . most) (list->vector (apply generator->list g most)))
; Fills the vector from a place on; returns the number of values.
(define (generator->vector! [v vector?] at [g procedure?])
  (let loop ((i at))
    (let ((x (if (< i (vector-length v)) (g) end)))
      (if (end? x)
          (- i at)
          (begin (vector-set! v i x) (loop (+ i 1)))))))
(define (generator->string g . most) (list->string (apply generator->list g most)))
(define (generator-find [good? procedure?] [g procedure?]) (let ((x ((gfilter good? g)))) (if (end? x) #f x)))
(define (generator-count [good? procedure?] [g procedure?]) (generator-fold (lambda (x n) (if (good? x) (+ n 1) n)) 0 g))
(define (generator-any [f procedure?] [g procedure?])
  (let loop () (let ((x (g))) (and (not (end? x)) (or (f x) (loop))))))
(define (generator-every [f procedure?] [g procedure?])
  (let loop ((last #t)) (let ((x (g))) (if (end? x) last (let ((found (f x))) (and found (loop found)))))))
(define (generator-unfold [g procedure?] [unfold procedure?] . more)
  (apply unfold end? (lambda (x) x) (lambda (x) (g)) (g) more))
