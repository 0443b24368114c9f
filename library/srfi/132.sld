; SRFI 132: sorting, merging, neighbours that are equal, medians. On the language's own sort, which is stable: each procedure ...-stable-sort is
; the one without that word.
(define-library (srfi 132)
  (export list-delete-neighbor-dups (rename list-delete-neighbor-dups list-delete-neighbor-dups!)
          list-merge (rename list-merge list-merge!) list-sort (rename list-sort list-sort!) list-sorted?
          (rename list-sort list-stable-sort) (rename list-sort list-stable-sort!)
          vector-delete-neighbor-dups vector-delete-neighbor-dups! vector-find-median vector-find-median! vector-merge vector-merge!
          vector-select! vector-separate! vector-sort vector-sort! vector-sorted?
          (rename vector-sort vector-stable-sort) (rename vector-sort! vector-stable-sort!))
  (import (except (visualscheme) vector-sort!))
  (begin
    (define (part v start end) (vector-copy v start (or end (vector-length v))))

    ; Are the n items that (item i) gives in order?
    (define (in-order? less? item n)
      (let loop ((i 1)) (or (>= i n) (and (not (less? (item i) (item (- i 1)))) (loop (+ i 1))))))
    (define (list-sorted? [less? procedure?] [l list?])
      (or (null? l)
          (let loop ((a (car l)) (l (cdr l))) (or (null? l) (and (not (less? (car l) a)) (loop (car l) (cdr l)))))))
    (define (vector-sorted? [less? procedure?] [v vector?] [start any? 0] [end any? #f])
      (let ((v (part v start end))) (in-order? less? (lambda (i) (vector-ref v i)) (vector-length v))))

    (define (vector-sort [less? procedure?] [v vector?] [start any? 0] [end any? #f]) (sort (part v start end) less?))
    (define (vector-sort! [less? procedure?] [v vector?] [start any? 0] [end any? #f])
      (vector-copy! v start (vector-sort less? v start end)))

    ; Of two equal items, the first list's comes first.
    (define (list-merge [less? procedure?] [a list?] [b list?])
      (let loop ((a a) (b b) (merged '()))
        (cond ((null? a) (append-reverse merged b))
              ((null? b) (append-reverse merged a))
              ((less? (car b) (car a)) (loop a (cdr b) (cons (car b) merged)))
              (else (loop (cdr a) b (cons (car a) merged))))))
    (define (vector-merge [less? procedure?] [a vector?] [b vector?] [from-a any? 0] [to-a any? #f] [from-b any? 0] [to-b any? #f])
      (list->vector (list-merge less? (vector->list (part a from-a to-a)) (vector->list (part b from-b to-b)))))
    (define (vector-merge! [less? procedure?] [to vector?] [a vector?] [b vector?] [at any? 0] . ranges)
      (vector-copy! to at (apply vector-merge less? a b ranges)))

    ; The first of equal neighbours stays.
    (define (list-delete-neighbor-dups [same? procedure?] [l list?])
      (if (null? l)
          '()
          (let loop ((last (car l)) (l (cdr l)) (kept (list (car l))))
            (cond ((null? l) (reverse kept))
                  ((same? last (car l)) (loop last (cdr l) kept))
                  (else (loop (car l) (cdr l) (cons (car l) kept)))))))
    (define (vector-delete-neighbor-dups [same? procedure?] [v vector?] [start any? 0] [end any? #f])
      (list->vector (list-delete-neighbor-dups same? (vector->list (part v start end)))))
    ; Returns the index behind the items that stay.
    (define (vector-delete-neighbor-dups! [same? procedure?] [v vector?] [start any? 0] [end any? #f])
      (let ((kept (vector-delete-neighbor-dups same? v start end)))
        (vector-copy! v start kept)
        (+ start (vector-length kept))))

    ; The middle item; of an even number, the mean of the two in the middle, the smaller given first; of none, what `nothing` is.
    (define (vector-find-median! [less? procedure?] [v vector?] nothing [mean procedure? (lambda (a b) (/ (+ a b) 2))])
      (vector-sort! less? v)
      (let* ((n (vector-length v)) (middle (quotient n 2)))
        (cond ((= n 0) nothing)
              ((odd? n) (vector-ref v middle))
              (else (mean (vector-ref v (- middle 1)) (vector-ref v middle))))))
    (define (vector-find-median less? v nothing . mean) (apply vector-find-median! less? (vector-copy v) nothing mean))

    ; Returns the item with k smaller ones in order before it.
    (define (vector-select! [less? procedure?] [v vector?] k [start any? 0] [end any? #f])
      (vector-sort! less? v start end)
      (vector-ref v (+ start k)))
    ; Puts the k smallest first.
    (define (vector-separate! [less? procedure?] [v vector?] k [start any? 0] [end any? #f]) (vector-sort! less? v start end))))
