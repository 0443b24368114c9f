#!/bin/sh
# Tests embedding: installs into a private folder, and builds and runs host programs against it; the shared
# library exports the names that the header declares and nothing else.
. tests/report.sh
wanted embed || exit 0

# make takes no target with a blank in its name: the build folder is given relative to this one
if ! MAKEFLAGS= make -s BUILD="${BUILD#"$PWD"/}" DESTDIR="$work" PREFIX=/usr install > "$work/log" 2>&1; then
  echo "not ok embed:install"; tail -n 10 "$work/log" | sed 's/^/    /'; exit
fi
echo "ok embed:install"
for file in man/man1/vs.1 bash-completion/completions/vs zsh/site-functions/_vs fish/vendor_completions.d/vs.fish; do
  [ -s "$work/usr/share/$file" ] || echo "not ok embed:install: share/$file is not there"
done

sed -n 's/^VS_API .*[ *]\(vs_[a-z_]*\)(.*/\1/p' visualscheme.h | sort -u > "$work/declared"
nm -D --defined-only "$work/usr/lib/libvisualscheme.so" | awk '$2 ~ /[TDBRV]/ { print $3 }' | grep -v '^VISUALSCHEME_' | sed 's/@.*//' | sort -u > "$work/exported"
if diff "$work/declared" "$work/exported" > "$work/diff"; then echo "ok embed:exports"; else echo "not ok embed:exports differ from visualscheme.h"; sed 's/^/    /' "$work/diff"; fi

# Each function has a manual page, made from the header: one page for each topic, to which the other names link.
while read -r name; do
  page=$work/usr/share/man/man3/$name.3
  [ -s "$page" ] && { ! grep -q '^\.so ' "$page" || [ -s "$work/usr/share/man/$(sed 's/^\.so //' "$page")" ]; } || echo "$name"
done < "$work/declared" > "$work/diff"
if [ ! -s "$work/diff" ] && grep -q 'vs_pick' "$work/usr/share/man/man3/vs_action_apply.3"; then echo "ok embed:man pages"
else echo "not ok embed:man pages are missing"; sed 's/^/    /' "$work/diff"; fi
if command -v mandoc > /dev/null; then
  # shellcheck disable=SC2046
  if mandoc -T lint -W warning $(grep -L '^\.so ' "$work"/usr/share/man/man3/*.3) > "$work/diff" 2>&1; then echo "ok embed:man lint"
  else echo "not ok embed:man lint"; head -n 5 "$work/diff" | sed 's/^/    /'; fi
fi

for program in host format scene meshes pictures fit; do
  if ! ${CC:-cc} -std=c11 -Wall -Wextra -Werror -I"$work/usr/include" tests/embed/$program.c -o "$work/$program" -L"$work/usr/lib" -lvisualscheme -lm > "$work/log" 2>&1; then
    echo "not ok embed:compile $program"; sed 's/^/    /' "$work/log"; continue
  fi
  LD_LIBRARY_PATH=$work/usr/lib timeout 60 "$work/$program" $([ $program = pictures ] && echo "$work") > "$work/out" 2>&1
  code=$?
  cat "$work/out"
  [ $code -le 1 ] || echo "not ok embed:$program ended with $code"
done

# A package with a dependency, added by vs, and imported by a host in C and one in Python (below).
mkdir -p "$work/shelf/towers" "$work/shelf/bricks" "$work/project"
echo '(define-library (towers spire) (export spire) (import (visualscheme) (bricks brick)) (begin (define (spire n) (brick (* 3 n)))))' > "$work/shelf/towers/spire.sld"
echo '(define-library (bricks brick) (export brick) (import (visualscheme)) (begin (define (brick h) (make-box origin 1 1 h))))' > "$work/shelf/bricks/brick.sld"
echo '{"name": "towers", "needs": {"bricks": "../bricks"}}' > "$work/shelf/towers/vs-package.json"
if ! (cd "$work/project" && "$work/usr/bin/vs" add ../shelf/towers > "$work/log" 2>&1); then
  echo "not ok embed:packages: vs add"; sed 's/^/    /' "$work/log"
elif ! ${CC:-cc} -std=c11 -Wall -Wextra -Werror -I"$work/usr/include" tests/embed/packages.c -o "$work/packages" -L"$work/usr/lib" -lvisualscheme > "$work/log" 2>&1; then
  echo "not ok embed:compile packages"; sed 's/^/    /' "$work/log"
else LD_LIBRARY_PATH=$work/usr/lib timeout 60 "$work/packages" "$work/project" || echo "not ok embed:packages, C: ended with $?"
fi

# A host in a hundred lines of C, which prints the contents of its buffers for the graphics card.
if ${CC:-cc} -std=c11 -Wall -Wextra -Wpedantic -Werror -I"$work/usr/include" examples/hosts/console.c -o "$work/console" \
     -L"$work/usr/lib" -lvisualscheme > "$work/diff" 2>&1 &&
   LD_LIBRARY_PATH=$work/usr/lib timeout 60 "$work/console" examples/hosts/table.vs > "$work/out" 2>&1 &&
   diff tests/embed/console.want "$work/out" > "$work/diff"; then echo "ok embed:console"
else echo "not ok embed:console"; sed 's/^/    /' "$work/diff"; fi

# The viewer in SDL2 and OpenGL, on a virtual screen and with a software graphics card: the test plays a user, and
# counts pixels. Numbers in a line that begins with `covered` may differ by a fiftieth, or by 3.
missing=
pkg-config --exists sdl2 gl 2> /dev/null || missing="SDL2's headers"
command -v xvfb-run > /dev/null || missing="xvfb-run"
[ -n "$(find /usr/lib /usr/lib64 -name swrast_dri.so -print 2> /dev/null | head -n 1)" ] || missing="Mesa's drivers"
if [ -n "$missing" ]; then
  echo "skip embed:viewer: $missing not found"
elif ! ${CC:-cc} -std=c11 -Wall -Wextra -Werror -I"$work/usr/include" examples/hosts/viewer.c -o "$work/viewer" \
    -L"$work/usr/lib" -lvisualscheme -lSDL2 -lGL -lm > "$work/log" 2>&1; then
  echo "not ok embed:compile viewer"; sed 's/^/    /' "$work/log"
else
  LD_LIBRARY_PATH=$work/usr/lib LIBGL_ALWAYS_SOFTWARE=1 timeout 120 xvfb-run -a -s "-screen 0 1024x768x24" \
    "$work/viewer" tests/embed/viewer.vs --test tests/embed/viewer.play > "$work/out" 2> "$work/log"
  code=$?
  if [ $code = 0 ] && awk '
      function near(a, b) { return a - b <= 3 + b / 50 && b - a <= 3 + b / 50 }
      NR == FNR { want[FNR] = $0; count = FNR; next }
      {
        gsub(/[,:]/, ""); line = want[FNR]; gsub(/[,:]/, "", line); n = split(line, w, " "); differs = n != NF
        for (i = 1; i <= n && !differs; i++)
          differs = $1 == "covered" && $i ~ /^[0-9]+$/ ? !near($i + 0, w[i] + 0) : $i != w[i]
        if (differs) { print "line " FNR ": " $0 " in place of " line; bad = 1 }
      }
      END { exit bad || FNR != count }' tests/embed/viewer.want "$work/out" > "$work/diff"; then
    echo "ok embed:viewer"
  else
    echo "not ok embed:viewer ended with $code"; cat "$work/diff" "$work/log" | sed 's/^/    /'
  fi
fi

# The Python package, installed without a network, with the installed library.
python=
for candidate in python3 /usr/bin/python3; do
  if [ -z "$python" ] && "$candidate" -c 'import numpy, setuptools, pip' 2> /dev/null; then python=$candidate; fi
done
if [ -z "$python" ]; then echo "skip embed:python: no NumPy, setuptools or pip"; exit; fi
cp -r python "$work/package"
if ! "$python" -m pip install -q --no-index --no-build-isolation --no-deps --target "$work/site" "$work/package" > "$work/log" 2>&1; then
  echo "not ok embed:python: pip"; tail -n 10 "$work/log" | sed 's/^/    /'; exit
fi
cover() {
  PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$work/site" VISUALSCHEME_LIBRARY="$work/usr/lib/libvisualscheme.so" "$python" tests/embed/python_covers.py "$@"
}
if cover sizes > "$work/sizes.c" && ${CC:-cc} -std=c11 -I"$work/usr/include" "$work/sizes.c" -o "$work/sizes"; then
  "$work/sizes" > "$work/sizes.txt"
  cover "$work/declared" "$work/sizes.txt" || true
else
  echo "not ok embed:python_covers did not run"
fi
top=$PWD host=$PWD/tests/embed/python_host.py
(cd "$work" && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$work/site" VISUALSCHEME_LIBRARY="$work/usr/lib/libvisualscheme.so" timeout 60 "$python" "$host" > "$work/out" 2>&1)
code=$?
grep '^ok \|^not ok ' "$work/out"
[ $code = 0 ] || { echo "not ok embed:python ended with $code"; grep -v '^ok \|^not ok ' "$work/out" | sed 's/^/    /'; }
(cd "$work" && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$work/site" VISUALSCHEME_LIBRARY="$work/usr/lib/libvisualscheme.so" timeout 60 "$python" "$top/examples/hosts/notebook.py" > "$work/out" 2>&1)
if diff "$top/tests/embed/notebook.want" "$work/out" > "$work/diff"; then echo "ok embed:notebook"; else echo "not ok embed:notebook"; sed 's/^/    /' "$work/diff"; fi
(cd "$work/project" && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$work/site" VISUALSCHEME_LIBRARY="$work/usr/lib/libvisualscheme.so" timeout 60 "$python" -c 'from visualscheme import Scheme
with Scheme(library_path=".vs") as s:
    s.run("(import (visualscheme) (towers spire)) (define v (volume (spire 2)))")
    print(float(s["v"]))' > "$work/out" 2>&1)
if [ "$(cat "$work/out")" = 6.0 ]; then echo "ok embed:packages, Python"; else echo "not ok embed:packages, Python"; sed 's/^/    /' "$work/out"; fi
