(define (roof w) {
  (make-box (xyz 0 0 0) (xyz w 1 1));
}
(roof 3)
