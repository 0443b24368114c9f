#!/bin/sh
# Owns keeping the manual honest: every ```scheme block of the tutorial runs without a word of error or warning; blocks may use what the
# blocks before them in the same step defined. What a prompt block shows is what the prompt answers.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
case manual in *"$ONLY"*) ;; *) exit ;; esac
awk -v work="$work" '
  /^## /         { step++; block = 0; text = ""; next }
  /^```scheme$/  { inside = 1; block++; next }
  /^```$/ && inside { inside = 0; name = sprintf("%s/step-%02d-%d.vs", work, step, block); printf "%s", text > name; close(name); next }
  inside         { text = text $0 "\n" }
  /^> [^,]/      { question = substr($0, 3); getline; print question > (work "/questions"); print $0 > (work "/answers") }' manual/tutorial.md
for program in "$work"/step-*.vs; do
  name=manual/tutorial:$(basename "$program" .vs)
  if "$BUILD/vs" --quiet "$program" -o "$work/out.stl" > "$work/said" 2>&1 && [ ! -s "$work/said" ]; then echo "ok $name"
  else echo "not ok $name"; sed 's/^/    /' "$work/said"; fi
done
"$BUILD/vs" < "$work/questions" > "$work/said" 2>&1
if diff "$work/answers" "$work/said" > "$work/diff"; then echo "ok manual/tutorial:prompt"; else echo "not ok manual/tutorial:prompt"; sed 's/^/    /' "$work/diff"; fi
