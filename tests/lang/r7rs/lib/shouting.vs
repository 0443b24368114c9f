(DEFINE (QUIET-SUM A B) (+ a b))
(define Quiet-Word (QUOTE LOUD))
(define Said "As It Is")
