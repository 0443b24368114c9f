(define (area sizes scale) (* scale (car sizes) (cadr sizes)))
(define (total walls [scale number? 2]) (apply + (map (lambda (w) (area w scale)) walls)))
(total '((3 4) (5)))
