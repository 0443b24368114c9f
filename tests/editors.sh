#!/bin/sh
# Owns what editors make of the messages: vim's quickfix list, Emacs' flymake, the problems of VS Code's extension.
. tests/report.sh
wanted editors || exit 0
cat > "$work/house.vs" <<'END'
(define (wall length unused)
  (make-box (xyz 0 0 0) length 0.3 3))
(draw (wall 3 4 5))
END
PATH=$BUILD:$PATH
here=$PWD

# same NAME WANTED GOT
same() {
  if [ "$2" = "$3" ]; then echo "ok editors/$1"; else echo "not ok editors/$1"; printf 'wanted %s\ngot    %s\n' "$2" "$3" | sed 's/^/    /'; fi
}

if command -v vim > /dev/null && vim --version | grep -q '+quickfix' && vim --version | grep -q '+eval'; then
  list="call writefile(map(getqflist(), {_, q -> q.lnum . ':' . q.col . ' ' . q.text}), 'found')"
  (cd "$work" && vim -es -u NONE -i NONE --cmd 'set nocompatible' --cmd "set rtp^=$here/editors/vim" --cmd 'filetype plugin on' house.vs -c 'VsCheck' -c "$list" -c 'qa!') > "$work/said" 2>&1
  same "vim:VsCheck" "1:22 unused-parameter: wall does not use its parameter unused|3:7 arguments: wall takes 2 arguments and is given 3|" "$(tr '\n' '|' < "$work/found")"
  (cd "$work" && vim -es -u NONE -i NONE --cmd 'set nocompatible' --cmd "set rtp^=$here/editors/vim" --cmd 'filetype plugin on' house.vs -c 'silent make!' -c "$list" -c 'qa!') > "$work/said" 2>&1
  same "vim:make" "3:7 wall needs 2 arguments (length unused), got 3|" "$(head -n 1 "$work/found" | tr '\n' '|')"
else echo "skip editors/vim: no vim with its language"; fi

if command -v emacs > /dev/null; then
  emacs --batch -Q -L editors/emacs --eval '(setq byte-compile-error-on-warn t)' --eval "(setq byte-compile-dest-file-function (lambda (_) \"$work/compiled.elc\"))" \
    -f batch-byte-compile editors/emacs/visualscheme.el > "$work/said" 2>&1
  same "emacs:compiles" "0" "$?$(cat "$work/said")"
  emacs --batch -Q -L editors/emacs -l visualscheme --eval "(progn (find-file \"$work/house.vs\") (princ major-mode) (princ \" \")
    (let (done) (visualscheme-flymake (lambda (found) (dolist (d found) (princ (format \"%d %s|\" (line-number-at-pos (flymake-diagnostic-beg d)) (flymake-diagnostic-text d)))) (setq done t)))
      (while (not done) (accept-process-output nil 0.05))))" > "$work/said" 2> "$work/errors"
  same "emacs:flymake" "visualscheme-mode 1 unused-parameter: wall does not use its parameter unused|3 arguments: wall takes 2 arguments and is given 3|" "$(cat "$work/said")"
else echo "skip editors/emacs: not installed"; fi

# The extension's functions, with a stand-in for the editor's own module.
if command -v node > /dev/null; then
  mkdir -p "$work/node_modules/vscode"
  cat > "$work/node_modules/vscode/index.js" <<'END'
class Position { constructor(line, character) { this.line = line; this.character = character; } translate(l, c) { return new Position(this.line + l, this.character + c); } }
class Range { constructor(start, end) { this.start = start; this.end = end; } }
class Diagnostic { constructor(range, message, severity) { Object.assign(this, { range, message, severity }); } }
module.exports = { Position, Range, Diagnostic, DiagnosticSeverity: { Error: 0, Warning: 1, Information: 2 } };
END
  cp editors/vscode/extension.js "$work/"
  cat > "$work/try.js" <<'END'
const { problems, findings } = require("./extension.js"), { readFileSync } = require("fs");
for (const found of [findings(readFileSync("looks.json", "utf8"), "/models"), problems(readFileSync("said", "utf8"), "/models"), findings("no JSON", "/models")])
  for (const [file, list] of found)
    for (const d of list) console.log(file, d.range.start.line, d.range.start.character, d.range.end.character, d.severity, d.code || "-", d.message);
END
  (cd "$work" && vs check --json house.vs > looks.json; vs -q --check house.vs > said 2>&1; node try.js > tried 2>&1)
  same "vscode:problems" "/models/house.vs 0 21 27 1 unused-parameter wall does not use its parameter unused
/models/house.vs 2 6 18 1 arguments wall takes 2 arguments and is given 3
/models/house.vs 2 6 7 0 - wall needs 2 arguments (length unused), got 3" "$(head -n 3 "$work/tried")"
else echo "skip editors/vscode: no node"; fi
