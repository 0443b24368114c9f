; A primitive's fields are a list
(define-primitive tower . 5) ; expect error: define-primitive: a field is a name or [name predicate]
