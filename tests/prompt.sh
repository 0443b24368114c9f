#!/bin/sh
# Owns the prompt's test on a terminal: editing, history, completion, ctrl-C, errors that do not end it, how far a mesh is.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
export HOME="$work" XDG_STATE_HOME="$work/state" TERM=xterm LSAN_OPTIONS=detect_leaks=0 # libedit keeps its prompt and its tables
case prompt in *"$ONLY"*) ;; *) exit ;; esac

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

printf '%s\n' '\e[A\e[A\n' ',quit\n' > "$work/keys"
type_keys < "$work/keys"
check "history of the last session" "43"

# how far a mesh is stands in one line; ctrl-C ends it, and leaves no file
mkdir "$work/out"
cat > "$work/keys" <<KEYS
(draw (subtract (make-sphere (xyz 0 0 0) 10 #:segments 1200) (make-torus (xyz 0 0 3) 8 3 #:segments 1200)))\n
,write $work/out/mesh.off\n
\x03
(string-append "after" " the mesh")\n
,quit\n
KEYS
type_keys < "$work/keys"
check "progress of a mesh" "out/mesh.off: meshing 0%"
check "a mesh is interrupted" "interrupted"
check "goes on after a mesh" '"after the mesh"'
left=$(ls -A "$work/out")
if [ -z "$left" ]; then echo "ok prompt:a stopped mesh leaves nothing"; else echo "not ok prompt:a stopped mesh leaves $left"; fi
