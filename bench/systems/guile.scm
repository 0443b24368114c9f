(use-modules (srfi srfi-9))
(define-record-type point (xyz x y z) point? (x cx) (y cy) (z cz))
(define-record-type gvector (vxyz x y z) gvector? (x vx) (y vy) (z vz))
