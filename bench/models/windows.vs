; 556,629 windows by rules, as many instances as the largest scene of Krecklau, Pavic and Kobbelt (2010), table 1. Each window is an object in place
; of a rule; with -D each=#t it has a rule of its own.
(define-parameter each #f)
(define pane (make-box (xyz 0 0 0) (xyz 1 1 1)))
(define-rule (front [self box-scope?]) [(=> (scope-repeat 'x 1 column))])
(define-rule (column [self box-scope?]) [#:when each (=> (scope-repeat 'y 1 window))] [(=> (scope-repeat 'y 1 pane))])
(define-rule (window [self box-scope?]) [(=> (scope-place pane))])
(draw (front (make-box-scope origin 185543 3 0.2)))
