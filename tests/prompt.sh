#!/bin/sh
# Tests the prompt on a terminal: editing, history, completion, ctrl-C, errors that do not end it, the progress of
# a mesh.
. tests/report.sh
export HOME="$work" XDG_STATE_HOME="$work/state" TERM=xterm LSAN_OPTIONS=detect_leaks=0 # libedit keeps its prompt and its tables
wanted prompt || exit 0

type_keys() { "$BUILD/tools/typist" "$BUILD/vs" "$@" > "$work/screen"; echo $? > "$work/code"; }
check() { # name, what the screen must show
  if grep -qF -- "$2" "$work/screen"; then echo "ok prompt:$1"; else echo "not ok prompt:$1: the screen does not show $2"; sed 's/^/    /' "$work/screen"; fi
}

type_keys <<'END'
(* 6\n 7)\n
(car 5)\n
(make-sph\t (xyz 0 0 0) 1)\n
(define secret 123\x03
(+ 1 secre\x03
(define (spin n) (spin n))\n(spin 1)\n
\x03
"after the interrupt"\n
(display "no line's end")\n
(values)\n
  ,drawing\n
(define (late x) (car x))\n
(late 'pair)\n
(+ 40 3)\n
,quit\n
END
if [ "$(cat "$work/code")" = 77 ]; then echo "skip prompt: no pseudo-terminal here"; exit; fi
check "continuation line" "42"
check "error" "prompt:3:1: car: "
check "completion" "(make-sphere (xyz 0 0 0) 1)"
check "goes on after an interrupt" '"after the interrupt"'
check "goes on after errors" "43"
check "the prompt begins a line" "> (values)"
check "a command after blanks" "drawing: 1 object"
check "the line of an earlier error" "| (define (late x) (car x))"
if [ "$(cat "$work/code")" = 0 ]; then echo "ok prompt:ends with 0"; else echo "not ok prompt:ends with $(cat "$work/code")"; fi

# Each feature of the prompt: its name, the keys, and the expected text on the screen. Rows without a name lead to the
# next.
cat > "$work/features" <<'END'
the depth and the line that is open|(define (square x)\n|1 open, from line 1>
|(* x\n|2 open, from line 2>
a command within an expression|,drawing\n|; the expression above is still open, 2 deep
|x))\n|
|\e[A\n|
a result's number|(square 7)\n|$1 = 49
the number in an expression|(+ $1 1)\n|$2 = 50
an empty line gives up|(list 1\n|
|\n|; given up: the parenthesis of line 1, column 1 is not closed
a parenthesis that is missing by the indentation|(define (unclosed x)\n|
|  (* x 2\n|
|(define later 1)\n|
|\n|; given up: a ) is missing, probably at the end of line 2
a paste of lines with tabs|\e[200~(define\tpasted 40)\n(define (twice\tx)\n\t(* 2 x))\n(twice pasted)\n\e[201~|$3 = 80
the keys of words, xterm's|(+ 1000 5)\e[1;5D2\n|$4 = 1025
the keys of words, the console's|(+ 2000 5)\eOd3\n|$5 = 2035
the keys of words, with Alt|(+ 3000 5)\eb4\n|$6 = 3045
a name completed, with its signature|(volu\t|  (volume o)
|(make-box origin (xyz 1 2 3)))\n|$7 = 6.0
a keyword completed|(object? (make-sphere origin 1 #:seg\t 12))\n|(make-sphere origin 1 #:segments  12)
a file's name completed|(load "mod\t")\n|the model is loaded
the quote closed behind a file's name|(load "mod\t)\n|(load "model.vs")
ctrl-C in an open expression|(define (never x)\n|
|  (* x\x03|
|(+ 600 7)\n| = 607
a command completed|,draw\t\n|> ,drawing
the signature on request|(make-cylinder \e?|  (make-cylinder c h r)
|origin 1 1)\n|(make-cylinder (xyz 0 0 0) (xyz 0 0 1) 1) ; 2 x 2 x 1 m
an object in a line|(define many (unite (map (lambda (i) (make-sphere (xy (* 3 i) 0) 1)) (iota 50))))\n|
|many\n|#<unite of 50 objects>
,help of a name of the language|,help make-box\n|Returns the box between two opposite corners
,help without an argument|,help\n|,disassemble NAME
,apropos|,apropos torus\n|make-torus               (make-torus c r tube-r)
,describe|,describe many\n|volume
,undo|(define undone 5)\n|
|,undo\n|; taken back: (define undone 5)
|undone\n|undone is not defined
,redo|,redo\n|; done again: (define undone 5)
a drawing|(draw (make-sphere origin 1))\n|; 2 x 2 x 2 m
,show|,show 20x6\n|▀
(erase o)|(draw (make-sphere (xyz 5 5 5) 1))\n|(make-sphere (xyz 5 5 5) 1) ; 2 x 2 x 2 m
|(erase (make-sphere (xyz 5 5 5) 1))\n|
|,drawing\n|drawing: 2 objects
,save|,save saved.vs\n|saved.vs
,time|,time (square 12)\n| ms
,profile|,profile (let loop ((i 0)) (if (< i 3000000) (loop (+ i 1)) 'counted))\n|counted
,trace|,trace square\n|
|(square 11)\n|(square 11)
,untrace|,untrace square\n|
,expand|(define-syntax twofold (syntax-rules () ((_ x) (list x x))))\n|
|,expand (twofold (f))\n|(list (f) (f))
,disassemble|,disassemble square\n|MUL        r1 r0 r0
an error's calls|(define (low y) (car y))\n|
|(define (high z) (+ 1 (low (* z 2))))\n|
|(high 4)\n|car:
,backtrace|,backtrace\n|low
,locals|,locals 1\n|y
,step|(define (area w h) (* w h))\n|
|(define (wall n) (+ 1 (area n 2)))\n|
|,step (wall 3)\n|^^^^^^^^  (wall 3)
|,step\n|next, in wall: n = 3
an empty line steps again|\n|next, in area: w = 3, h = 2
the prompt of a stopped program|(* 1000 w)\n|step> (* 1000 w)
the variables where it is stopped|(* 2000 h)\n| = 4000
,locals where it is stopped|,locals\n|  w = 3
,backtrace where it is stopped|,backtrace\n|  2  wall,
,out|,out\n|  (area n 2) => 6
,over|,over\n|  (wall 3) => 7
(break)|(define (leg h) (break) (* 10 h))\n|
|(leg 5)\n|stopped, in leg: h = 5
|h\n|break> h
,continue|,continue\n| = 50
,quit gives up what is stopped|(leg 6)\n|stopped, in leg: h = 6
|,quit\n|; the stopped program has been ended; ,quit once more ends the prompt
ctrl-D gives up what is stopped|(leg 7)\n|stopped, in leg: h = 7
|\x04| given up
|,continue\n|; no program is stopped
,load and ,reload|,load model.vs\n|the model is loaded
|,reload\n|the model is loaded
,render|,render out.png\n\w|; wrote out.png
,view|,view\n\w|; the page follows the drawing
,write|,write out.stl\n|; wrote out.stl
,write with quotes round the name|,write "quoted.stl"\n|; wrote quoted.stl
,run of a name with a slip|,run modle.vs\n|modle.vs: no such file; perhaps model.vs
END
cat > "$work/model.vs" <<'END'
(displayln "the model is loaded")
(draw (make-box origin (xyz 1 1 1)))
END
cut -d'|' -f2 "$work/features" > "$work/keys"
(cd "$work" && BROWSER=echo TMPDIR="$work" type_keys --size 16x12 --quality draft < keys)
named=
while IFS='|' read -r name keys shows; do
  [ -z "$name" ] || named=$name
  [ -z "$shows" ] || check "$named" "$shows"
done < "$work/features" > "$work/checked"
# a feature of several rows is one test, and its first failure shows the screen
awk '/^ok /{ if (!seen[$0]++) print; next } /^not ok /{ print; bad++; next } bad < 2' "$work/checked"
if [ "$(grep -c '> (define (square x)' "$work/screen")" = 2 ]; then echo "ok prompt:a whole expression again"; else echo "not ok prompt:a whole expression again"; fi

# 200 lines pasted at once, tabs among them
{
  printf '%s' '\e[200~(define total (+\n'
  for i in $(seq 198); do printf '%s' '\t1\t\n'; done
  printf '%s\n' '))\n\e[201~' '(list "the sum" total)\n' ',quit\n'
} > "$work/keys"
type_keys < "$work/keys"
check "a paste of 200 lines" '("the sum" 198)'

# the terminal's control sequences: the cursor moves to the matching parenthesis and back, and colours
printf '%s\n' '(values)\n' '(+ 1 2' ')' '\n' '(draw (make-box origin 1 1 1))\n' ',show 12x4\n' ',quit\n' > "$work/keys"
type_escapes() { "$BUILD/tools/typist" --escapes "$BUILD/vs" > "$work/screen" < "$work/keys"; }
type_escapes
check "the parenthesis that is closed is marked" '\e[0;1;7m(\e[0;34m+\e[0m'
check "colours" '\e[2m$1 =\e[0m 3'
NO_COLOR=1 type_escapes
check "NO_COLOR" '$1 = 3'
check "NO_COLOR: the cursor shows the parenthesis that is closed" ')\e[3G\e[10G'
if grep -q 'e\[[0-9;]*m' "$work/screen"; then echo "not ok prompt:NO_COLOR sets colours"; else echo "ok prompt:NO_COLOR sets none"; fi
for term in dumb ''; do
  printf '%s\n' '(make-tr\t\t' '\x03' '(list (list 1\n' '2) "a")\n' '\e[A\n' '\e[200~(+ 40 2)\n\e[201~' '(car 5)\n' '(draw (make-box origin 1 1 1))\n' ',show 12x4\n' ',help box\n' ',quit\n' > "$work/keys"
  TERM=$term type_escapes
  check "TERM=$term: names" "make-triangle-scope"
  check "TERM=$term: values" '((1 2) "a")'
  if grep -q '\\e' "$work/screen"; then echo "not ok prompt:TERM=$term gets escape sequences"; grep '\\e' "$work/screen" | sed 's/^/    /'
  else echo "ok prompt:TERM=$term gets no escape sequences"; fi
done
printf '%s\n' '(+ 1 2)' '(draw (make-box origin 1 1 1))' ',show 12x4' ',help make-box' '(car 5)' ',backtrace' |
  "$BUILD/vs" > "$work/screen" 2>&1
check "a pipe" "car: expected a pair"
if grep -q "$(printf '\033')" "$work/screen"; then echo "not ok prompt:a pipe gets escape sequences"; else echo "ok prompt:a pipe gets no escape sequences"; fi

# The final screen of a terminal, which the escape sequences alone do not show: matching parentheses that are marked for
# a moment leave no trace, nor does an entry of several lines that is ended from its first.
if command -v tmux > /dev/null; then
  pane() { tmux -S "$work/tmux" "$@"; }
  keys() { for key in "$@"; do pane send-keys -t vs -l -- "$key"; sleep 0.4; pane send-keys -t vs Enter; sleep 0.2; done; }
  shows() { # name; the screen on standard input
    cat > "$work/wanted"
    for try in 1 2 3 4 5 6 7 8; do
      pane capture-pane -p -t vs | sed '/^$/d' > "$work/screen"
      cmp -s "$work/wanted" "$work/screen" && { echo "ok prompt:$1"; return; }
      sleep 0.5
    done
    echo "not ok prompt:$1: the screen differs"; diff "$work/wanted" "$work/screen" | sed 's/^/    /'
  }
  rm -rf "$work/state"
  TMUX= pane -f /dev/null new-session -d -s vs -x 60 -y 24 "$BUILD/vs; sleep 60"
  for try in 1 2 3 4 5 6 7 8 9 10; do pane capture-pane -p -t vs | grep -q '^>' && break; sleep 0.5; done
  keys '(define (square x)' '(* x x))' '(list (square 2) 3)'
  shows "closed parentheses leave nothing" <<'END'
VisualScheme 0.1.0. ,help lists commands, ,quit ends.
> (define (square x)
1 open, from line 1>   (* x x))
> (list (square 2) 3)
$1 = (4 3)
>
END
  pane send-keys -t vs Up Up
  sleep 0.4
  pane send-keys -t vs Home
  keys '(list 5) '
  shows "an entry of several lines is ended from its first" <<'END'
VisualScheme 0.1.0. ,help lists commands, ,quit ends.
> (define (square x)
1 open, from line 1>   (* x x))
> (list (square 2) 3)
$1 = (4 3)
> (list 5) (define (square x)
  (* x x))
$2 = (5)
>
END
  pane send-keys -t vs C-l
  pane send-keys -t vs -l '(list 1 '
  pane set-buffer '2
3)
4'
  pane paste-buffer -p -t vs
  shows "a paste of lines stands there as it is, and what is left of it can be edited" <<'END'
> (list 1 2
3)
$3 = (1 2 3)
> 4
END
  pane kill-server
else
  echo "skip prompt:screen: no tmux here"
fi

rm -rf "$work/state"
type_keys <<'END'
(+ 40 3)\n
,quit\n
END
printf '%s\n' '\e[A\e[A\n' ',quit\n' > "$work/keys"
type_keys < "$work/keys"
check "history of the last session" "43"

# ctrl-C drops a line any number of times
printf '%s\n' '(a\x03' '(b\x03' '(c\x03' '(d\x03' '(e\x03' '(f\x03' '"still here"\n' ',quit\n' > "$work/keys"
type_keys < "$work/keys"
check "many interrupts" '$1 = "still here"'

# the progress of a mesh is one line; ctrl-C ends it, and leaves no file
mkdir "$work/out"
cat > "$work/keys" <<KEYS
(draw (subtract (make-sphere (xyz 0 0 0) 10 #:segments 1200) (make-torus (xyz 0 0 3) 8 3 #:segments 1200)))\n
,write $work/out/mesh.off\n
\x03\w
(string-append "after" " the mesh")\n
,quit\n
KEYS
type_keys < "$work/keys"
check "progress of a mesh" "out/mesh.off: meshing 0%"
check "a mesh is interrupted" "interrupted"
check "goes on after a mesh" '"after the mesh"'
left=$(ls -A "$work/out")
if [ -z "$left" ]; then echo "ok prompt:a stopped mesh leaves nothing"; else echo "not ok prompt:a stopped mesh leaves $left"; fi
