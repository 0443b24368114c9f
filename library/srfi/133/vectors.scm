; The procedures of SRFI 133 that (scheme base) lacks. With several vectors, the shortest ends the walk.

(define (shortest v more) (fold (lambda (w n) (min n (vector-length w))) (vector-length v) more))
(define (items v more i) (cons (vector-ref v i) (map (lambda (w) (vector-ref w i)) more)))

; ---- constructors ----

; (f i state ...) returns the item i and the states for the next one.
(define (unfold-into! f v start end step states)
  (let loop ((i (if (> step 0) start (- end 1))) (states states))
    (if (and (<= start i) (< i end))
        (call-with-values (lambda () (apply f i states))
          (lambda (item . states)
            (vector-set! v i item)
            (loop (+ i step) states))))))
(define (vector-unfold! [f procedure?] [v vector?] start end . states) (unfold-into! f v start end 1 states))
(define (vector-unfold-right! [f procedure?] [v vector?] start end . states) (unfold-into! f v start end -1 states))
(define (vector-unfold [f procedure?] n . states)
  (let ((v (make-vector n))) (unfold-into! f v 0 n 1 states) v))
(define (vector-unfold-right [f procedure?] n . states)
  (let ((v (make-vector n))) (unfold-into! f v 0 n -1 states) v))

(define (vector-reverse-copy! [to vector?] at [from vector?] [start any? 0] [end any? (vector-length from)])
  (let ((part (vector-copy from start end)))
    (vector-copy! to at part)
    (vector-reverse! to at (+ at (vector-length part)))))
(define (vector-reverse-copy [v vector?] [start any? 0] [end any? (vector-length v)])
  (let ((copy (vector-copy v start end))) (vector-reverse! copy) copy))
(define (vector-concatenate vectors) (apply vector-append vectors))
; (vector-append-subvectors v start end ...)
(define (vector-append-subvectors . parts)
  (let loop ((left parts) (copies '()))
    (if (null? left)
        (vector-concatenate (reverse copies))
        (loop (cdddr* left) (cons (vector-copy (car left) (cadr left) (caddr* left)) copies)))))
(define (caddr* l) (car (cddr l)))
(define (cdddr* l) (cdr (cddr l)))

; ---- predicates ----

(define (vector-empty? [v vector?]) (= (vector-length v) 0))
(define (vector= [same? procedure?] . [vectors (list-of vector?)])
  (define (alike? a b)
    (let ((n (vector-length a)))
      (and (= n (vector-length b))
           (let loop ((i 0)) (or (= i n) (and (same? (vector-ref a i) (vector-ref b i)) (loop (+ i 1))))))))
  (or (null? vectors)
      (let loop ((a (car vectors)) (left (cdr vectors)))
        (or (null? left) (and (alike? a (car left)) (loop (car left) (cdr left)))))))

; Returns the first place, from either end, with items for which `good?` is true.
(define (place good? v more step)
  (let ((n (shortest v more)))
    (let loop ((i (if (> step 0) 0 (- n 1))))
      (cond ((not (< -1 i n)) #f)
            ((apply good? (items v more i)) i)
            (else (loop (+ i step)))))))
(define (same-lengths who v more)
  (if (any (lambda (w) (not (= (vector-length w) (vector-length v)))) more)
      (error (string-append who ": from the right, the vectors must be of one length, got") (map vector-length (cons v more)))))
(define (none-of good?) (lambda items (not (apply good? items))))
(define (vector-index [good? procedure?] [v vector?] . [more (list-of vector?)]) (place good? v more 1))
(define (vector-skip [good? procedure?] [v vector?] . [more (list-of vector?)]) (place (none-of good?) v more 1))
(define (vector-index-right [good? procedure?] [v vector?] . [more (list-of vector?)])
  (same-lengths "vector-index-right" v more)
  (place good? v more -1))
(define (vector-skip-right [good? procedure?] [v vector?] . [more (list-of vector?)])
  (same-lengths "vector-skip-right" v more)
  (place (none-of good?) v more -1))

; (compare item key) is negative if the item comes before the key.
(define (vector-binary-search [v vector?] key [compare procedure?])
  (let loop ((low 0) (high (vector-length v)))
    (and (< low high)
         (let* ((middle (quotient (+ low high) 2)) (side (compare (vector-ref v middle) key)))
           (cond ((= side 0) middle)
                 ((< side 0) (loop (+ middle 1) high))
                 (else (loop low middle)))))))
(define (vector-any [f procedure?] [v vector?] . [more (list-of vector?)])
  (let ((n (shortest v more)))
    (let loop ((i 0)) (and (< i n) (or (apply f (items v more i)) (loop (+ i 1)))))))
(define (vector-every [f procedure?] [v vector?] . [more (list-of vector?)])
  (let ((n (shortest v more)))
    (let loop ((i 0) (last #t)) (if (= i n) last (let ((x (apply f (items v more i)))) (and x (loop (+ i 1) x)))))))
(define (vector-count [good? procedure?] [v vector?] . [more (list-of vector?)])
  (let ((n (shortest v more)))
    (let loop ((i 0) (count 0)) (if (= i n) count (loop (+ i 1) (if (apply good? (items v more i)) (+ count 1) count))))))

; ---- iteration ----

(define (vector-fold [f procedure?] first [v vector?] . [more (list-of vector?)])
  (let ((n (shortest v more)))
    (let loop ((i 0) (state first)) (if (= i n) state (loop (+ i 1) (apply f state (items v more i)))))))
(define (vector-fold-right [f procedure?] last [v vector?] . [more (list-of vector?)])
  (let loop ((i (- (shortest v more) 1)) (state last))
    (if (< i 0) state (loop (- i 1) (apply f state (items v more i))))))
(define (vector-map! [f procedure?] [v vector?] . [more (list-of vector?)])
  (let ((n (shortest v more)))
    (let loop ((i 0))
      (if (< i n)
          (begin (vector-set! v i (apply f (items v more i))) (loop (+ i 1)))))))
; Returns the states of a fold, one after each item.
(define (vector-cumulate [f procedure?] first [v vector?])
  (vector-unfold (lambda (i state) (let ((next (f state (vector-ref v i)))) (values next next))) (vector-length v) first))
; Returns a vector with the good items first, each kind in its order, and the number of good ones.
(define (vector-partition [good? procedure?] [v vector?])
  (let loop ((i (- (vector-length v) 1)) (good '()) (others '()) (count 0))
    (cond ((< i 0) (values (list->vector (append good others)) count))
          ((good? (vector-ref v i)) (loop (- i 1) (cons (vector-ref v i) good) others (+ count 1)))
          (else (loop (- i 1) good (cons (vector-ref v i) others) count)))))

; ---- mutation ----

(define (vector-swap! [v vector?] i j)
  (let ((kept (vector-ref v i)))
    (vector-set! v i (vector-ref v j))
    (vector-set! v j kept)))
(define (vector-reverse! [v vector?] [start any? 0] [end any? (vector-length v)])
  (let loop ((i start) (j (- end 1)))
    (if (< i j)
        (begin (vector-swap! v i j) (loop (+ i 1) (- j 1))))))

; ---- conversion ----

(define (reverse-vector->list [v vector?] [start any? 0] [end any? (vector-length v)]) (reverse (vector->list v start end)))
(define (reverse-list->vector [l list?]) (list->vector (reverse l)))
