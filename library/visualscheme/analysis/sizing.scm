; Sizing: members take the next sections of a catalogue until none uses more than it may.

; Returns a frame with other sections: one for each member.
(define (with-sections f sections)
  (make-frame (nodes-of f)
    (map (lambda (b s) (make-bar (bar-from b) (bar-to b) (bar-joints b) s (bar-material b) (bar-length b))) (bars-in f) sections)
    (plates-in f) (held-of f) (cases-of f)))

(define (member-section r i)
  (member-index 'member-section r i (car (result-cases r)) 12)
  (bar-section (vector-ref (bars-at (result-frame r)) (- i 1))))

(define (need-groups groups count)
  (if (not (and (list? groups) (every (lambda (g) (and (list? g) (every (lambda (i) (and (exact-integer? i) (<= 1 i count))) g))) groups)))
      (error 'size-frame "groups must be lists of members from 1 to ~a, got ~s" count groups))
  (let ((all (apply append groups)))
    (if (not (= (length all) (length (delete-duplicates all)))) (error 'size-frame "groups: a member is in two groups in ~s" groups))))

; Returns the next section after k that may be enough. A share falls at most by the square of the area (bending of thin walls).
(define (next-size catalogue k share limit)
  (let ((last (- (vector-length catalogue) 1)) (need (* (section-area (vector-ref catalogue k)) (sqrt (/ share limit)))))
    (let loop ((j (min last (+ k 1)))) (if (or (= j last) (>= (section-area (vector-ref catalogue j)) need)) j (loop (+ j 1))))))

; Returns the result of f after sizing, combined by `combine`. Sizes only grow, so that the rounds end.
(define (size-frame f sections #:limit [limit any? 1] #:combine [combine any? values] #:share [share any? utilisation] #:groups [groups any? '()])
  (need-frame 'size-frame f)
  (need-positive 'size-frame 'limit limit)
  (if (not (and (pair? sections) (list? sections))) (error 'size-frame "sections must be a list of sections from the lightest, got ~s" sections))
  (for-each (lambda (name p) (if (not (procedure? p)) (error 'size-frame "~a must be a procedure, got ~s" name p))) '(combine share) (list combine share))
  (need-groups groups (member-count f))
  (let* ((catalogue (list->vector (map section-for sections))) (last (- (vector-length catalogue) 1)) (n (member-count f)) (size (make-vector (+ n 1) 0))
         (grouped (make-vector (+ n 1) #f)))
    (for-each (lambda (g) (for-each (lambda (i) (vector-set! grouped i #t)) g)) groups)
    (let ((all (append (filter pair? groups) (filter-map (lambda (i) (and (not (vector-ref grouped i)) (list i))) (iota n 1)))))
      (let loop ()
        (let* ((r (combine (frame-solve (with-sections f (map (lambda (i) (vector-ref catalogue (vector-ref size i))) (iota n 1))))))
               (shares (map (lambda (g) (apply max (map (lambda (i) (share r i)) g))) all)) (grew #f))
          (for-each
            (lambda (g u)
              (let ((k (vector-ref size (car g))))
                (if (and (> u limit) (< k last)) (let ((j (next-size catalogue k u limit))) (set! grew #t) (for-each (lambda (i) (vector-set! size i j)) g)))))
            all shares)
          (if grew (loop)
              (begin
                (for-each (lambda (g u) (if (> u limit) (warn (format "size-frame: member ~a uses ~a of its strength with the last section of the list" (car g) (/ (round (* 100. u)) 100))))) all shares)
                r)))))))
