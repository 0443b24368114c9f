; A helper that only this needs is there.
(draw (do-extrude (make-regular-polygon (xy 0 0) 2 6) 5 #:twist pi/3))
