#!/bin/sh
# Tests what a terminal shows while a line is typed, by tmux: colours, the call below the line, indentation,
# and the menu. The columns of the tables, with tabs between them: `colours` class of cli/prompt/syntax.def, text,
# characters of that class; `hints` text, parameter in bold type or -; `screens` name, keys, beginning or part of a line.
. tests/report.sh
if ! command -v tmux > /dev/null; then echo "skip prompt:keys: no tmux here"; exit; fi
export HOME="$work" LSAN_OPTIONS=detect_leaks=0
tables=$PWD/tests/prompt tab=$(printf '\t')
mkdir "$work/models"
touch "$work/model.vs"
terminals=0 # a socket for each: a server that is ending may still answer on its own
pane() { tmux -S "$work/tmux.$terminals" "$@"; }
trap 'pane kill-server 2> /dev/null; rm -rf "$work"' EXIT

start() { # VARIABLE=VALUE ...: starts a prompt in a terminal of 60 x 20, with an empty history
  [ "$terminals" = 0 ] || pane kill-server
  terminals=$((terminals + 1))
  rm -rf "$work/state"
  (cd "$work" && TMUX='' pane -f /dev/null new-session -d -s vs -x 60 -y 20 "env XDG_STATE_HOME=$work/state $* $BUILD/vs -q; sleep 60")
  soon is_empty || echo "not ok prompt:keys: the prompt does not start with $*"
}
typed() { pane send-keys -t vs -l -- "$1"; }
typed_slowly() { # in the escapes of printf; waits after each line
  rest=$1
  while [ -n "$rest" ]; do
    case $rest in *'\r'*) line=${rest%%'\r'*}'\r' rest=${rest#*'\r'} ;; *) line=$rest rest='' ;; esac
    typed "$(printf '%b' "$line")"
    sleep 0.3
  done
}
is_empty() { # the cursor is behind an empty prompt, and the lines below are empty
  pane capture-pane -p -t vs | sed '/^$/d' > "$work/shown"
  tail -n 1 "$work/shown" | grep -qx '> *' && [ "$(pane display -p -t vs '#{cursor_x},#{cursor_y}')" = "2,$(($(wc -l < "$work/shown") - 1))" ]
}
soon() { for try in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do "$@" && return; sleep 0.15; done; return 1; }
clear_line() { # ends the line and what is open, then clears the screen
  is_empty || { pane send-keys -t vs C-c; soon is_empty; }
  pane send-keys -t vs C-l
  soon eval '[ "$(pane display -p -t vs "#{cursor_y}")" = 0 ]'
}
# Prints the screen as a line `numbers of the colour|characters` for each piece of one colour.
pieces() {
  pane capture-pane -e -p -t vs | awk '
    function flush() { gsub(/^ +| +$/, "", piece); if (piece != "") print state "|" piece; piece = "" }
    { n = split($0, part, "\033\\["); piece = part[1]
      for (i = 2; i <= n; i++) {
        end = index(part[i], "m"); flush(); count = split(substr(part[i], 1, end - 1), code, ";")
        for (k = 1; k <= count; k++) {
          if (code[k] == "0") state = ""
          else if (code[k] == "39") gsub(/;?3[0-7]/, "", state)
          else if (code[k] != "49") state = state (state == "" ? "" : ";") code[k]
        }
        sub(/^;/, "", state)
        piece = substr(part[i], end + 1)
      }
      flush() }'
}
has_piece() { pieces > "$work/shown"; grep -qxF -- "$1" "$work/shown"; }
has_line() { pane capture-pane -p -t vs | sed 's/ *$//' > "$work/shown"; grep -qF -- "$1" "$work/shown"; }
is_plain() { pieces > "$work/shown"; grep -q "^|.*$1" "$work/shown"; }
no_bold() { pieces > "$work/shown"; [ -s "$work/shown" ] && ! grep '^1|' "$work/shown"; }
no_escapes() { pane capture-pane -e -p -t vs > "$work/shown"; grep -q . "$work/shown" && ! grep -q "$(printf '\033')" "$work/shown"; }
row() { # NAME COMMAND ...: the command succeeds within 3 seconds
  name=$1
  shift
  if soon "$@"; then echo "ok prompt:$name"; return; fi
  echo "not ok prompt:$name: $*"
  sed '/^$/d; s/^/    /' "$work/shown"
}

sample() { if [ -n "$LONG" ]; then cat; else head -n "$1"; fi; } # with LONG=1 all rows

start TERM=screen
sed -n 's/^SYNTAX(\([A-Z]*\), "\([0-9;]*\)",.*/\1\t\2/p' cli/prompt/syntax.def > "$work/classes"
[ -s "$work/classes" ] || echo "not ok prompt:colours: cli/prompt/syntax.def has no classes"
while IFS=$tab read -r class colour; do
  grep "^$class$tab" "$tables/colours" | sample 1 > "$work/rows"
  [ -s "$work/rows" ] || echo "not ok prompt:colours: tests/prompt/colours has no row of $class"
  while IFS=$tab read -r _ text wanted; do
    clear_line
    typed "$text"
    if [ "$class" = PLAIN ]; then row "colours: $text" is_plain "$wanted"; else row "colours: $text" has_piece "$colour|$wanted"; fi
  done < "$work/rows"
done < "$work/classes"

sample 5 < "$tables/hints" > "$work/rows"
while IFS=$tab read -r text wanted; do
  clear_line
  typed "$text"
  if [ "$wanted" = - ]; then sleep 0.3; row "hint: $text" no_bold; else row "hint: $text" has_piece "1|$wanted"; fi
done < "$work/rows"

while IFS=$tab read -r name keys wanted; do
  clear_line
  typed_slowly "$keys"
  row "$name" has_line "$wanted"
done < "$tables/screens"

# a line that has ended keeps its colours, without a marked bracket; nothing below it remains
clear_line
typed "$(printf '%b' '(list (list 1) 2)\r')"
row "an ended line: its colours" has_piece '34|list'
row "an ended line: no marked bracket" is_plain ' 2)$'

start TERM=screen NO_COLOR=1
for keys in '(make-box 1 ; a' '(make-tr\t\t' '(list (list 1) "a")'; do
  clear_line
  typed "$(printf '%b' "$keys")"
  sleep 0.4
  row "NO_COLOR: $keys" no_escapes
done
clear_line
typed "$(printf '%b' '(make-tr\t\t')"
row "NO_COLOR: the chosen name" has_line '[make-triangle-scope]'
row "NO_COLOR: its call" has_line '  (make-triangle-scope p q r)'
