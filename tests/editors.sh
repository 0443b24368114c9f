#!/bin/sh
# Tests messages in editors: vim's quickfix list, Emacs' flymake, the problems of VS Code's extension.
. tests/report.sh
wanted editors || exit 0
cat > "$work/house.vs" <<'END'
(define (wall length unused)
  (make-box (xyz 0 0 0) length 0.3 3))
(draw (wall 3 4 5))
END
PATH=$BUILD:$PATH
here=$PWD

cat > "$work/indented.vs" <<'END'
; a tower
(define-parameter floors 2 #:min 1 #:max 9
  #:label "how many")
(define (tower at n)
  (let ([top (+z at 3)]
        [side 4])
    ; one storey on the other
    (when (> n 0)
      (draw (make-box at
                      side side 3))
      (tower top (- n 1)))))
(tower (xyz 0 0 0) floors)
(draw (with-material 'concrete
        (layer "walls"
          (make-box (xyz 9 0 0) 1 1 1))))
(for/list ([i 3])
  (* i 2))
END
sed 's/^ *//' "$work/indented.vs" > "$work/tower.vs"
printf '#!/bin/sh\necho "$1" > "%s/address"\n' "$work" > "$work/browser" && chmod +x "$work/browser"

# same NAME WANTED GOT
same() {
  if [ "$2" = "$3" ]; then echo "ok editors/$1"; else echo "not ok editors/$1"; printf 'wanted %s\ngot    %s\n' "$2" "$3" | sed 's/^/    /'; fi
}

if command -v vim > /dev/null && vim --version | grep -q '+quickfix' && vim --version | grep -q '+eval'; then
  list="call writefile(map(getqflist(), {_, q -> q.lnum . ':' . q.col . ' ' . q.text}), 'found')"
  (cd "$work" && vim -es -u NONE -i NONE --cmd 'set nocompatible' --cmd "set rtp^=$here/editors/vim" --cmd 'filetype plugin on' house.vs -c 'VsCheck' -c "$list" -c 'qa!') > "$work/said" 2>&1
  same "vim:VsCheck" "1:22 unused-parameter: wall does not use its parameter unused|3:7 arguments: wall takes 2 arguments and is given 3: (wall length unused)|" "$(tr '\n' '|' < "$work/found")"
  (cd "$work" && vim -es -u NONE -i NONE --cmd 'set nocompatible' --cmd "set rtp^=$here/editors/vim" --cmd 'filetype plugin on' house.vs -c 'silent make!' -c "$list" -c 'qa!') > "$work/said" 2>&1
  same "vim:make" "3:7 wall needs 2 arguments (length unused), got 3|" "$(head -n 1 "$work/found" | tr '\n' '|')"
  tower() { cp "$work/tower.vs" "$work/try.vs"; (cd "$work" && BROWSER="$work/browser" timeout 60 vim -es -u NONE -i NONE --cmd 'set nocompatible' --cmd "set rtp^=$here/editors/vim" --cmd 'filetype plugin indent on' --cmd 'syntax on' try.vs "$@" -c 'qa!') > "$work/said" 2>&1; }
  tower -c 'normal gg=G' -c 'w'
  same "vim:indentation" "" "$(diff "$work/indented.vs" "$work/try.vs")"
  colour() { echo "add(g:seen, getline($1)[$2 - 1 : $2 + 2] . ' ' . synIDattr(synID($1, $2, 1), 'name'))"; }
  tower -c 'let g:seen = []' -c "call $(colour 1 3)" -c "call $(colour 2 2)" -c "call $(colour 2 28)" -c "call $(colour 3 10)" -c "call $(colour 9 8)" -c "call $(colour 9 2)" -c "call writefile(g:seen, 'colours')"
  same "vim:colours" "a to schemeComment|defi vsForm|#:mi vsKeyword|how  schemeString|make vsMake|draw vsOperation|" "$(tr '\n' '|' < "$work/colours")"
  tower -c 'silent VsWrite try.stl'
  same "vim:VsWrite" "84" "$(head -c 84 "$work/try.stl" 2> /dev/null | wc -c)"
  if [ -d node_modules/three ]; then
    rm -f "$work/address"
    tower -c 'VsView' -c 'sleep 2'
    same "vim:VsView" "1" "$(grep -c '^http://127.0.0.1:[0-9]*/#[0-9a-f]*$' "$work/address" 2> /dev/null)"
  fi
  if [ -d /usr/share/vim-ale ]; then
    cp tests/editors/slips.vs "$work/ale.vs"
    (cd "$work" && timeout 60 vim -es -u NONE -i NONE --cmd 'set nocompatible' --cmd 'set rtp^=/usr/share/vim-ale' --cmd "set rtp^=$here/editors/vim" --cmd 'filetype plugin on' --cmd 'runtime plugin/ale.vim' ale.vs \
      -c 'ALELint' -c 'let tries = 0' -c 'while len(ale#engine#GetLoclist(bufnr(""))) < 2 && tries < 200 | sleep 50m | let tries += 1 | endwhile' \
      -c "call writefile(map(copy(ale#engine#GetLoclist(bufnr(''))), {_, q -> q.lnum . ':' . q.col . ' ' . q.text}), 'found')" \
      -c 'call cursor(5, 8)' -c 'ALEGoToDefinition' -c 'let tries = 0' -c 'while line(".") == 5 && tries < 200 | sleep 50m | let tries += 1 | endwhile' -c "call writefile([line('.') . ':' . col('.')], 'at')" -c 'qa!') > "$work/said" 2>&1
    same "vim:ALE" "3:17 wall does not use its parameter unused|4:4 make-bx is not defined; did you mean make-box?|3:10|" "$(cat "$work/found" "$work/at" | tr '\n' '|')"
  else echo "skip editors/vim:ALE: no vim-ale"; fi
else echo "skip editors/vim: no vim with its language"; fi

if command -v emacs > /dev/null; then
  emacs --batch -Q -L editors/emacs --eval '(setq byte-compile-error-on-warn t)' --eval "(setq byte-compile-dest-file-function (lambda (_) \"$work/compiled.elc\"))" \
    -f batch-byte-compile editors/emacs/visualscheme.el > "$work/said" 2>&1
  same "emacs:compiles" "0" "$?$(cat "$work/said")"
  emacs --batch -Q -L editors/emacs -l visualscheme --eval "(progn (find-file \"$work/house.vs\") (princ major-mode) (princ \" \")
    (let (done) (visualscheme-flymake (lambda (found) (dolist (d found) (princ (format \"%d %s|\" (line-number-at-pos (flymake-diagnostic-beg d)) (flymake-diagnostic-text d)))) (setq done t)))
      (while (not done) (accept-process-output nil 0.05))))" > "$work/said" 2> "$work/errors"
  same "emacs:flymake" "visualscheme-mode 1 unused-parameter: wall does not use its parameter unused|3 arguments: wall takes 2 arguments and is given 3: (wall length unused)|" "$(cat "$work/said")"
  tower() { cp "$work/tower.vs" "$work/try.vs"; (cd "$work" && BROWSER="$work/browser" timeout 60 emacs --batch -Q -L "$here/editors/emacs" -l visualscheme --eval "(progn (find-file \"try.vs\") $1)") > "$work/said" 2> "$work/errors"; }
  tower '(indent-region (point-min) (point-max)) (save-buffer)'
  same "emacs:indentation" "" "$(diff "$work/indented.vs" "$work/try.vs")"
  tower '(font-lock-ensure) (dolist (word (list "a tower" "define-parameter" "floors" "#:min" "how many" "make-box" "draw")) (goto-char (point-min)) (search-forward word) (princ (format "%s %s|" word (get-text-property (match-beginning 0) (quote face)))))'
  same "emacs:colours" "a tower font-lock-comment-face|define-parameter font-lock-keyword-face|floors font-lock-function-name-face|#:min font-lock-constant-face|how many font-lock-string-face|make-box font-lock-builtin-face|draw font-lock-builtin-face|" "$(cat "$work/said")"
  wait='(while (process-live-p (get-buffer-process "*compilation*")) (accept-process-output nil 0.05))'
  tower '(visualscheme-write "try.obj") '"$wait"
  same "emacs:visualscheme-write" "yes" "$([ -s "$work/try.obj" ] && echo yes)"
  tower '(goto-char (point-max)) (insert "(tower 1)\n") (visualscheme-check) '"$wait"' (accept-process-output nil 0.3) (next-error) (princ (format "%s %d" (buffer-name) (line-number-at-pos)))'
  same "emacs:run, to the error" "try.vs 18" "$(cat "$work/said")"
  rm -f "$work/address"
  tower '(setq browse-url-browser-function (lambda (url &rest _) (with-temp-file "address" (insert url)))) (visualscheme-view) (let ((end (+ (float-time) 20))) (while (and (not (file-exists-p "address")) (< (float-time) end)) (accept-process-output nil 0.1)))'
  same "emacs:visualscheme-view" "1" "$(grep -c '^http://127.0.0.1:[0-9]*/#[0-9a-f]*$' "$work/address" 2> /dev/null)"
  if emacs --batch -q --eval "(require 'eglot)" > /dev/null 2>&1; then
    cp tests/editors/slips.vs "$work/session.vs"
    timeout 100 emacs --batch -q -L editors/emacs -l visualscheme -l tests/editors/eglot.el --eval "(session \"$work/session.vs\")" > "$work/said" 2> "$work/errors"
    same "emacs:eglot" "$(cat tests/editors/eglot.want)" "$(cat "$work/said")"
  else echo "skip editors/emacs:eglot: no elpa-eglot"; fi
else echo "skip editors/emacs: not installed"; fi

# An hour of editing: the server's text equals the editor's all along (tests/editors/hour.py).
steps=150
[ -z "${LONG:-}" ] || steps=2000
hour() { # EDITOR NEEDED: NEEDED says what lacks, or is empty
  if [ "$2" ]; then echo "skip editors/$1:hour: $2"; return; fi
  limited 6000 env PYTHONDONTWRITEBYTECODE=1 python3 tests/editors/hour.py "$BUILD/vs" "$work/hour-$1" "$1" "$steps" || echo "not ok editors/$1:hour: ended with $?"
}
if command -v python3 > /dev/null; then
  hour emacs "$(command -v emacs > /dev/null && emacs --batch -q --eval "(require 'eglot)" > /dev/null 2>&1 || echo no eglot)"
  hour vim "$(command -v vim > /dev/null && vim --version | grep -q '+eval' && [ -d /usr/share/vim-ale ] || echo no vim-ale)"
else echo "skip editors/hour: no python3"; fi

# Kate's files are well-formed, and its language server is that of the colours' name.
if command -v xmllint > /dev/null && command -v python3 > /dev/null; then
  xmllint --noout --nonet editors/kate/visualscheme.xml > "$work/said" 2>&1
  same "kate:colours" "0" "$?$(cat "$work/said")"
  same "kate:server" "vs lsp" "$(python3 -c 'import json, re, sys, xml.etree.ElementTree as t
server = json.load(open("editors/kate/lspclient.json"))["servers"]["visualscheme"]
name = t.parse("editors/kate/visualscheme.xml").getroot().get("name")
print(" ".join(server["command"]) if re.search(server["highlightingModeRegex"], name) else name)')"
else echo "skip editors/kate: no xmllint or no python3"; fi

# The extension's functions, with a replacement for the editor's module.
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
const { problems, findings, startServer } = require("./extension.js"), { readFileSync } = require("fs");
if (startServer()) throw new Error("a server without its client's package");
for (const found of [findings(readFileSync("looks.json", "utf8"), "/models"), problems(readFileSync("said", "utf8"), "/models"), findings("no JSON", "/models")])
  for (const [file, list] of found)
    for (const d of list) console.log(file, d.range.start.line, d.range.start.character, d.range.end.character, d.severity, d.code || "-", d.message);
END
  (cd "$work" && vs check --json house.vs > looks.json; vs -q --check house.vs > said 2>&1; node try.js > tried 2>&1)
  same "vscode:problems" "/models/house.vs 0 21 27 1 unused-parameter wall does not use its parameter unused
/models/house.vs 2 6 18 1 arguments wall takes 2 arguments and is given 3: (wall length unused)
/models/house.vs 2 6 7 0 - wall needs 2 arguments (length unused), got 3" "$(head -n 3 "$work/tried")"
  # A session of VS Code's own client with vs lsp; then of the extension as it is packed.
  session() { cp tests/editors/slips.vs "$work/code.vs"; VS=$(cd "$BUILD" && pwd)/vs VIEWER=$viewer timeout 100 node tests/editors/vscode_session.js "$1" "$work/code.vs" 2>&1; }
  viewer=; [ ! -d node_modules/three ] || viewer=1
  if [ -d tests/node_modules/vscode-languageclient ]; then
    want=$(if [ "$viewer" ]; then cat tests/editors/vscode.want; else grep -v '^panel: ' tests/editors/vscode.want; fi)
    same "vscode:session" "$want" "$(NODE_PATH=tests/node_modules; export NODE_PATH; session editors/vscode/extension.js)"
    if [ -d tests/node_modules/@vscode/vsce ] && [ -d node_modules/esbuild ] && command -v python3 > /dev/null; then
      sh scripts/vscode.sh "$work/packed" 0.1.0 > "$work/said" 2>&1
      same "vscode:packs" "$work/packed/visualscheme-0.1.0.vsix" "$(cat "$work/said")"
      (cd "$work/packed" && python3 -m zipfile -e visualscheme-0.1.0.vsix .)
      same "vscode:packed session" "$want" "$(session "$work/packed/extension/extension.js")"
      same "vscode:licences" "4" "$(grep -c '^---- vscode-' "$work/packed/extension/LICENSE.txt")"
    else echo "skip editors/vscode:packs: no vsce, esbuild or python3 (make check)"; fi
  else echo "skip editors/vscode:session: no vscode-languageclient"; fi
else echo "skip editors/vscode: no node"; fi
