; Properties: typed, named values that notify their subscribers of changes, alone or in groups. After bind/. Names that
; begin with % are hidden from programs. Compiled into the binary when it is built.
;
; Changes are delivered one after the other: a change by a subscriber waits until all subscribers have got the one
; before. A value equal to the present one is no change, so two properties that follow each other come to rest.

(define (%need-symbol who what x) (if (not (symbol? x)) (error who "~a must be a symbol, got ~s" what x)))

(define-record-type %property (%make-property name value %type %wanted %subscribers) property?
  (name %property-name)
  (value %property-value %set-property-value!)
  (%type %property-type)
  (%wanted %property-wanted) ; the words for the type that messages use, or #f
  (%subscribers %property-subscribers)) ; a table from the number of a subscription to its procedure, in order

(define (%need-property who x) (if (not (property? x)) (error who "property must be a property, got ~s" x)))

; who: the procedure with the value as its argument
(define (%check-property who p value)
  (let ((fits? (%property-type p)))
    (if (and fits? (not (fits? value)))
        (error who "~a must ~a, got ~s" (%property-name p)
          (or (%property-wanted p) (string-append "satisfy " (%predicate-name fits?))) value))))

; Returns the text for messages: positive?, not #<procedure positive?>.
(define (%predicate-name f)
  (let* ((text (format "~a" f)) (n (string-length text)) (head (string-length "#<procedure ")))
    (if (and (> n head) (string-prefix? text "#<procedure ")) (substring text head (- n 1)) text)))

(define (make-property name value #:type [type any? #f])
  (%need-symbol 'make-property 'name name)
  (if type (%need-procedure 'make-property 'type type))
  (%typed-property 'make-property name value type #f))

; wanted: the words for the type in messages, or #f for its name
(define (%typed-property who name value type wanted)
  (let ((p (%make-property name value type wanted (make-hasheqv))))
    (%check-property who p value)
    p))

(define (property-name property) (%need-property 'property-name property) (%property-name property))
(define (property-value property) (%need-property 'property-value property) (%property-value property))

(define (property-set! property value)
  (%need-property 'property-set! property)
  (%change! 'property-set! property value))

(define (%change! who p value)
  (if (not (equal? value (%property-value p)))
      (begin
        (%check-property who p value)
        (%set-property-value! p value)
        (%notify p))))

(define (property-emit property) (%need-property 'property-emit property) (%notify property))

; ---- subscriptions ----

(define %subscriptions 0) ; the number of subscriptions so far

(define (property-subscribe property procedure)
  (%need-property 'property-subscribe property)
  (%need-procedure 'property-subscribe 'procedure procedure)
  (set! %subscriptions (+ %subscriptions 1))
  (hash-set! (%property-subscribers property) %subscriptions procedure)
  %subscriptions)

(define (property-unsubscribe property id)
  (%need-property 'property-unsubscribe property)
  (if (not (hash-ref (%property-subscribers property) id #f))
      (error 'property-unsubscribe "~s is no subscription of the property ~a" id (%property-name property)))
  (hash-remove! (%property-subscribers property) id))

; ---- delivery ----

(define %changes-newest '()) ; (property . value) of the changes that wait: new ones are added here,
(define %changes-oldest '()) ; and taken from here
(define %delivering #f)
(define %most-changes 1000)

(define (%notify p)
  (if (> (hash-count (%property-subscribers p)) 0)
      (begin
        (set! %changes-newest (cons (cons p (%property-value p)) %changes-newest))
        (if (not %delivering) (%deliver)))))

(define (%next-change)
  (if (null? %changes-oldest)
      (begin (set! %changes-oldest (reverse %changes-newest)) (set! %changes-newest '())))
  (and (pair? %changes-oldest)
       (let ((change (car %changes-oldest))) (set! %changes-oldest (cdr %changes-oldest)) change)))

; An error in a subscriber ends the round: it is raised at the first change, and the waiting changes are dropped.
(define (%deliver)
  (define turns (make-hasheq)) ; the number of changes of each property in this round
  (define (count! p)
    (let ((n (+ 1 (hash-ref turns p 0))))
      (if (and (> n %most-changes) (not (%event? p)))
          (error 'property-set! "~a does not come to rest: its subscribers have changed it ~a times in one round" (%property-name p) %most-changes))
      (hash-set! turns p n)))
  (dynamic-wind
    (lambda () (set! %delivering #t))
    (lambda ()
      (let loop ((change (%next-change)))
        (if change
            (let* ((p (car change)) (subscribers (%property-subscribers p)))
              (count! p)
              (for-each
                (lambda (id) ; its subscription may have ended meanwhile
                  (let ((f (hash-ref subscribers id #f))) (if f (f (cdr change)))))
                (hash-keys subscribers))
              (loop (%next-change))))))
    (lambda ()
      (set! %delivering #f)
      (set! %changes-newest '())
      (set! %changes-oldest '()))))

; ---- groups: tables from a name to its property ----

(define-record-type %property-group (%make-property-group %properties) %property-group?
  (%properties %group-properties))

(define (make-property-group) (%make-property-group (make-hasheq)))
(define (property-group? x) (or (%property-group? x) (node? x) (%controller? x)))

(define (%properties-of who group)
  (cond
    ((node? group) (%node-table group))
    ((%controller? group) (%controller-properties group))
    ((%property-group? group) (%group-properties group))
    (else (error who "group must be a group of properties, a node or the controller, got ~s" group))))

(define (property-add! group property)
  (let ((table (%properties-of 'property-add! group)))
    (%need-property 'property-add! property)
    (if (hash-ref table (%property-name property) #f)
        (error 'property-add! "the group has a property ~a already" (%property-name property)))
    (hash-set! table (%property-name property) property)))

(define (property-remove! group name)
  (let ((table (%properties-of 'property-remove! group)))
    (%find-property 'property-remove! group name)
    (hash-remove! table name)))

(define (%find-property who group name)
  (let ((table (%properties-of who group)))
    (%need-symbol who 'name name)
    (or (hash-ref table name #f)
        (error who "the group has no property ~a; it has ~s" name (hash-keys table)))))

(define (property-names group) (hash-keys (%properties-of 'property-names group)))
(define (property-ref group name) (%find-property 'property-ref group name))
(define (property-get group name) (%property-value (%find-property 'property-get group name)))

; Sets the property of this name, or makes it if there is none.
(define (property-put! group name value)
  (let ((table (%properties-of 'property-put! group)))
    (%need-symbol 'property-put! 'name name)
    (let ((p (hash-ref table name #f)))
      (if p
          (%change! 'property-put! p value)
          (hash-set! table name (make-property name value))))))
