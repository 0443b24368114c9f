; A wall of height 10 that runs east and west, so long that its ends do not matter. At an equinox the sun's path is a circle
; round the earth's axis: seen along the wall it stands 90 - latitude above the horizon all day, and the shadow on the
; north side is 10 tan(latitude) wide from morning to evening: 8.39 at 40 degrees.
(draw (make-box (xyz -3000 0 0) (xyz 3000 0.1 10)))
(draw (make-box (xyz -1 8.1 -0.1) (xyz 1 8.2 0)) (make-box (xyz -1 8.6 -0.1) (xyz 1 8.7 0)))
