#!/bin/sh
# Owns the embedding test: installs into a private folder, builds a stranger's programs against it, runs them; the shared library exports
# what the header declares and nothing else.
. tests/report.sh
wanted embed || exit 0

# make takes no name with a blank for a target: the folder of the build is named from here
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

for program in host format scene meshes pictures fit; do
  if ! ${CC:-cc} -std=c11 -Wall -Wextra -Werror -I"$work/usr/include" tests/embed/$program.c -o "$work/$program" -L"$work/usr/lib" -lvisualscheme -lm > "$work/log" 2>&1; then
    echo "not ok embed:compile $program"; sed 's/^/    /' "$work/log"; continue
  fi
  LD_LIBRARY_PATH=$work/usr/lib timeout 60 "$work/$program" $([ $program = pictures ] && echo "$work") > "$work/out" 2>&1
  code=$?
  cat "$work/out"
  [ $code -le 1 ] || echo "not ok embed:$program ended with $code"
done

# The Python package, installed without a network and run on the library that was installed.
python=
for candidate in python3 /usr/bin/python3; do
  if [ -z "$python" ] && "$candidate" -c 'import numpy, setuptools, pip' 2> /dev/null; then python=$candidate; fi
done
if [ -z "$python" ]; then echo "skip embed:python: no NumPy, setuptools or pip"; exit; fi
cp -r python "$work/package"
if ! "$python" -m pip install -q --no-index --no-build-isolation --no-deps --target "$work/site" "$work/package" > "$work/log" 2>&1; then
  echo "not ok embed:python: pip"; tail -n 10 "$work/log" | sed 's/^/    /'; exit
fi
host=$PWD/tests/embed/python_host.py
(cd "$work" && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$work/site" VISUALSCHEME_LIBRARY="$work/usr/lib/libvisualscheme.so" timeout 60 "$python" "$host" > "$work/out" 2>&1)
code=$?
grep '^ok \|^not ok ' "$work/out"
[ $code = 0 ] || { echo "not ok embed:python ended with $code"; grep -v '^ok \|^not ok ' "$work/out" | sed 's/^/    /'; }
