#!/bin/sh
# Tests the command in the shell: its completion in bash, zsh and fish, and its page for man.
. tests/report.sh
wanted shell || exit 0
for shell in bash zsh fish; do sh scripts/completions.sh $shell > "$work/vs.$shell" || echo "not ok shell/$shell: is not made"; done

# Prints the words that bash offers after a line: offered "vs --qual" answers --quality.
cat > "$work/ask.bash" <<'END'
source "$1"
COMP_LINE=$2 COMP_POINT=${#2}
read -r -a COMP_WORDS <<< "${2//=/ = }"
[[ $2 != *' ' ]] || COMP_WORDS+=('')
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_vs 2> /dev/null
printf '%s\n' "${COMPREPLY[@]}" | sort | tr '\n' ' '
END
touch "$work/house.vs" "$work/house.stl"; mkdir "$work/shelf"
asked() { # NAME LINE WANTED
  said=$(cd "$work" && bash ask.bash vs.bash "$2" 2> errors)
  if [ "$said" = "$3 " ] && [ ! -s "$work/errors" ]; then echo "ok shell/bash:$1"
  else echo "not ok shell/bash:$1"; echo "    $2 gives $said, and $3 is wanted"; sed 's/^/    /' "$work/errors"; fi
}
if command -v bash > /dev/null; then
  asked option 'vs --qual' '--quality'
  asked options 'vs --limit-t' '--limit-time --limit-triangles'
  asked choice 'vs house.vs --quality d' 'draft'
  asked choices 'vs house.vs --quality ' 'draft final good'
  asked optional 'vs house.vs --stats=' 'json'
  asked command 'vs vi' 'view'
  asked page 'vs help tut' 'tutorial'
  asked model 'vs ho' 'house.vs'
  asked output 'vs house.vs -o ho' 'house.stl house.vs'
  asked folder 'vs -L s' 'shelf'
  asked number 'vs --size 3' ''
fi
for shell in bash zsh fish; do
  if ! command -v $shell > /dev/null; then echo "skip shell/$shell:syntax: no $shell"
  elif $shell -n "$work/vs.$shell" 2> "$work/errors" && [ ! -s "$work/errors" ]; then echo "ok shell/$shell:syntax"
  else echo "not ok shell/$shell:syntax"; sed 's/^/    /' "$work/errors"; fi
done
# Every option and command occurs in each completion and in the page.
sh scripts/man.sh 0 > "$work/vs.1"
sed 's/\\-/-/g; s/\\f[BIR]//g' "$work/vs.1" > "$work/vs.man"
missing=$({ sed -n 's/^OPTION([^"]*"\([^"][^"]*\)".*/\1/p' cli/options.def; sed -n 's/^COMMAND(\([a-z]*\),.*/\1/p' cli/commands.def; } |
  while read -r word; do for file in bash zsh fish man; do grep -q -- "$word" "$work/vs.$file" || echo "$word in $file"; done; done)
if [ -z "$missing" ]; then echo "ok shell/all"; else echo "not ok shell/all: missing:"; echo "$missing" | sed 's/^/    /'; fi
# Each has a description.
{ awk '/^\.TP/ { at = NR } at && NR == at + 2 && !/./ { print "man: " last } { last = $0 }' "$work/vs.man"; grep -n "':'$\|:'$\|-d ''" "$work/vs.zsh" "$work/vs.fish"; } > "$work/errors"
if [ ! -s "$work/errors" ]; then echo "ok shell/meanings"; else echo "not ok shell/meanings: rows without one:"; sed 's/^/    /' "$work/errors"; fi
# Every exit code occurs, also those of visualscheme.h in the page; a negative outcome is not an exit code.
codes=$(sed -n 's/^ *VS_OUTCOME_[A-Z]* = \([0-9][0-9]*\).*/\1/p' visualscheme.h | tr '\n' ' ')
told=$(sed -n '/^\.SH "EXIT CODES"/,/^\.SH/p' "$work/vs.man" | grep -o '^[0-9][0-9]*' | tr '\n' ' ')
if [ -n "$codes" ] && [ "$codes" = "$told" ]; then echo "ok shell/exit codes"
else echo "not ok shell/exit codes: the header has $codes, the page $told"; fi
if command -v mandoc > /dev/null; then mandoc -T lint -W warning "$work/vs.1" > "$work/errors" 2>&1
elif command -v man > /dev/null && command -v groff > /dev/null; then man --warnings=all -l "$work/vs.1" 2> "$work/errors" > /dev/null
elif command -v groff > /dev/null; then groff -man -ww -z "$work/vs.1" 2> "$work/errors"
else echo "skip shell/man: no mandoc, man or groff"; exit; fi
if [ ! -s "$work/errors" ] && [ "$(wc -l < "$work/vs.1")" -gt 150 ]; then echo "ok shell/man"; else echo "not ok shell/man"; head -n 20 "$work/errors" | sed 's/^/    /'; fi

# The runner itself: in a build that contains only vs it names the missing programs, and it reports the progress of a
# long suite.
mkdir "$work/plain" && ln -s "$BUILD/vs" "$work/plain/vs"
said=$(ONLY= SUITES="unit cross" sh tests/run.sh "$work/plain" 2>&1); status=$?
if [ $status = 2 ] && echo "$said" | grep -q '^not built in .*: tools/.* \.\.\. ([0-9]*)$' && echo "$said" | grep -q '^make .*all units tools'; then echo "ok shell/runner:not built"
else echo "not ok shell/runner:not built"; echo "    ended with $status: $said"; fi
said=$(TICK=0.02 ONLY=lang/r5rs SUITES=lang sh tests/run.sh "$BUILD" 2>&1)
if echo "$said" | grep -q '^  lang: [0-9]* s, [0-9]* passed, 0 failed$' && echo "$said" | tail -n 1 | grep -q '^[0-9]* passed, 0 failed'; then echo "ok shell/runner:how far a suite is"
else echo "not ok shell/runner:how far a suite is"; echo "    $said"; fi
