# Tests the pictures in the pages of `vs doc`: the procedures with a picture, and that it shows the first
# object that the program made with them.
. tests/report.sh

wanted documents || exit 0
command -v povray > /dev/null || { echo "skip documents: no povray (package povray)"; exit 0; }
cd "$work" || exit 1

cat > parts.vs <<'EOF'
(define (peg at) (let ([r 0.4]) (make-cylinder at 3 r)))
EOF
cat > model.vs <<'EOF'
; A board; draw it with
;
;   vs model.vs -o model.png
;   vs model.vs -o `model`.stl
;
; `board` makes it, and a ` alone is none.
(load "parts.vs")
(define (ball paint size) (color paint (make-sphere (xyz 0 0 0) size)))
(define (row n) (if (= n 0) '() (cons (do-move (ball (if (= n 3) "red" "blue") (/ 1 n)) (vxyz n 0 0)) (row (- n 1)))))
(define (count-down n) (if (= n 0) 'done (count-down (- n 1))))
(define (both) (values (make-box (xyz 0 0 0) 1 1 1) 2))
(define (keyed #:size [size any? 1]) (make-box (xyz 0 0 0) size size size))
(define (named #:size size) (make-box (xyz 0 0 0) size size size))
(define (set x) x) (set! set (lambda (x) x))
(define (|a b| x) (make-sphere (xyz x 0 0) 1))
(define (nobody x) (make-sphere (xyz x 0 0) 1))
(define (board) (let ([n 3]) (unite (row n) (peg (xyz n 3 0)) (|a b| n))))
(draw (board) (set (peg (xyz 0 0 n-pegs))))
(call-with-values both (lambda (a b) (draw a)))
(let ([side 2]) (draw (named #:size side)))
(display (count-down 100000))
EOF
sed -i '/(load/a (define n-pegs 4)' model.vs
"$vs" doc model.vs -o site > said 2>&1
# shellcheck disable=SC2094
shown() { sed -n 's/.*pictures\/\(s[0-9]*\).png" alt="what \(.*\) makes".*/\2/p' "$1/functions.html" | sort | tr '\n' ' '; }
got=$(shown site)
[ "$got" = "a b ball board both keyed peg row set " ] || echo "pictures of: $got" >> said
picture() { sed -n "s/.*\(pictures\/s[0-9]*.png\)\" alt=\"what $2 makes\".*/$1\/\1/p" "$1/functions.html"; }
grep -q '<pre>vs model.vs -o model.png' site/index.html || echo "lines further in do not stand as they are" >> said
grep -q 'vs model.vs -o `model`.stl</pre>' site/index.html || echo "their marks are changed" >> said
grep -q '<p><code>board</code> makes it, and a ` alone is none.</p>' site/index.html || echo "names in comments" >> said
result documents said
# the first ball is red, and a third of a metre
echo '(define (ball paint size) (color paint (make-sphere (xyz 0 0 0) size))) (draw (ball "red" 1/3))' > red.vs
"$vs" doc red.vs -o red > said 2>&1
share=$("$tools/pngstat" "$(picture site ball)" "$(picture red ball)" 2>&1)
[ "$share" = 0 ] || echo "another picture: $share" >> said
result documents-first said
# a program that this wrapping would break runs unchanged
echo '(import (only (scheme base) define quote) (only (visualscheme) draw make-sphere xyz)) (define (ball x) (make-sphere (xyz x 0 0) 1)) (draw (ball 1))' > narrow.vs
"$vs" doc narrow.vs -o narrow > said 2>&1
got=$(shown narrow)
[ "$got" = "ball " ] || echo "pictures of: $got" >> said
[ -f narrow/pictures/model.png ] || echo "no picture of the model" >> said
result documents-narrow said
