(defun shaft (p height base-r top-r)
  (cut-cone p base-r top-r height))

(defun capital (p height base-r top-r)
  (cut-cone p base-r top-r height))

(defun abacus (p height length)
  (box2 (+xyz p (/ length -2.0) (/ length -2.0) 0)
        (+xyz p (/ length 2.0) (/ length 2.0) height)))

(defun doric-column (p
  shaft-h shaft-base-r
  capital-h capital-base-r
  abacus-h abacus-l)
  (shaft p shaft-h shaft-base-r capital-base-r)
  (capital (+z p shaft-h) capital-h capital-base-r (/ abacus-l 2.0))
  (abacus (+z p (+ shaft-h capital-h)) abacus-h abacus-l))
(erase-all)

(doric-column (xyz 0 0 0) 9 0.5 0.4 0.3 0.3 1.0)
(doric-column (xyz 3 0 0) 7 0.5 0.4 0.6 0.6 1.6)
(doric-column (xyz 6 0 0) 9 0.7 0.5 0.3 0.2 1.2)
(doric-column (xyz 9 0 0) 8 0.4 0.3 0.2 0.3 1.0)
(doric-column (xyz 12 0 0) 5 0.5 0.4 0.3 0.1 1.0)
(doric-column (xyz 15 0 0) 6 0.8 0.3 0.2 0.4 1.4)

(zoom-extents)
