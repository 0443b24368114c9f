(define-record-type (point xyz point?) (fields (immutable x cx) (immutable y cy) (immutable z cz)))
(define-record-type (gvector vxyz gvector?) (fields (immutable x vx) (immutable y vy) (immutable z vz)))
