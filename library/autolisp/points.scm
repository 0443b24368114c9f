; Points of AutoLISP are lists of two or three numbers; angles are in radians.

(define (numbers? l) (or (null? l) (and (pair? l) (number? (car l)) (numbers? (cdr l)))))
(define (point-list? v) (and (pair? v) (numbers? v) (<= 2 (length v) 3)))
(define (need-point who v)
  (if (point-list? v) (xyz (car v) (cadr v) (if (pair? (cddr v)) (caddr v) 0)) (refuse who "a point, a list of two or three numbers," v)))
(define (list-of p) (list (cx p) (cy p) (cz p)))

(define (:polar p a d)
  (need-point 'polar p)
  (let ((x (+ (car p) (* (need-number 'polar d) (cos (need-number 'polar a))))) (y (+ (cadr p) (* d (sin a)))))
    (cons (exact->inexact x) (cons (exact->inexact y) (map exact->inexact (cddr p))))))
(define (:angle p q)
  (need-point 'angle p)
  (need-point 'angle q)
  (let ((a (direction (- (cadr q) (cadr p)) (- (car q) (car p))))) (if (< a 0) (+ a 2pi) a)))
(define (:distance p q)
  (let ((d (p->q (need-point 'distance p) (need-point 'distance q))))
    (if (and (pair? (cddr p)) (pair? (cddr q))) (vlength d) (sqrt (+ (expt (cx d) 2) (expt (cy d) 2))))))
; Returns where the lines a b and c d meet, or nil; with two segments, only between their ends.
(define (:inters a b c d . lines)
  (let* ((a (need-point 'inters a)) (c (need-point 'inters c)) (u (p->q a (need-point 'inters b)))
         (v (p->q c (need-point 'inters d))) (w (p->q a c)) (n (cross u v)) (nn (dot n n)))
    (if (or (= nn 0) (> (abs (dot w n)) (* 1e-9 (+ 1 (vlength w)) (sqrt nn))))
        '()
        (let ((s (/ (dot (cross w v) n) nn)) (t (/ (dot (cross w u) n) nn)))
          (if (or (and (pair? lines) (null? (car lines))) (and (<= 0 s 1) (<= 0 t 1))) (list-of (p+v a (v*r u s))) '())))))

; ---- calls that matter only beside a screen ----

(define (:graphscr) '())
(define (:textscr) '())
(define (:redraw . l) '())
(define (:vl-load-com) '())

; ---- points in the way of the architects' courses: (xyz x y z), (+x p d), (+pol p rho phi) ... ----

(define-syntax point-words
  (syntax-rules ()
    ((_ (name who f argument ...) ...)
     (begin (define (name argument ...) (list-of (f (need-number 'who argument) ...))) ...))))
(define-syntax moved-words
  (syntax-rules ()
    ((_ (name who f argument ...) ...)
     (begin (define (name p argument ...) (list-of (f (need-point 'who p) (need-number 'who argument) ...))) ...))))
(point-words (:xyz xyz xyz x y z) (:xy xy xy x y) (:xz xz xz x z) (:yz yz yz y z) (:pol pol pol rho phi)
  (:cil cil cil rho phi z) (:cyl cyl cyl rho phi z) (:esf esf esf rho phi psi) (:sph sph sph rho phi psi))
(moved-words (:+xyz +xyz +xyz x y z) (:+xy +xy +xy x y) (:+xz +xz +xz x z) (:+yz +yz +yz y z) (:+x +x +x d) (:+y +y +y d)
  (:+z +z +z d) (:+pol +pol +pol rho phi) (:+cil +cil +cil rho phi z) (:+cyl +cyl +cyl rho phi z)
  (:+esf +esf +esf rho phi psi) (:+sph +sph +sph rho phi psi))
(define (:cx p) (cx (need-point 'cx p)))
(define (:cy p) (cy (need-point 'cy p)))
(define (:cz p) (cz (need-point 'cz p)))
