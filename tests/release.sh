#!/bin/sh
# Tests `make dist`: the same bytes twice, the files of the release, and that they build without npm and node. LONG=1
# builds all of it without a network, and runs the README's main job.
. tests/report.sh
wanted release || exit 0
if ! [ -e .git ] || ! [ -d node_modules/esbuild ]; then echo "skip release: no clone with npm's packages"; exit; fi
command -v git > /dev/null || { echo "skip release: no git, with which make dist reads the clone (package git)"; exit; }
version=$(sed -n 's/^.define VS_VERSION "\(.*\)"/\1/p' visualscheme.h) name=visualscheme-$version
: > "$work/why"
for time in first second; do
  (umask "$([ $time = first ] && echo 022 || echo 077)"; TZ=$([ $time = first ] && echo UTC || echo Asia/Tokyo) sh scripts/dist.sh "$work/$time" "$version" > "$work/log" 2>&1) || cat "$work/log" >> "$work/why"
done
cmp "$work/first/$name.tar.gz" "$work/second/$name.tar.gz" >> "$work/why" 2>&1
result release/same "$work/why"

tar -xzf "$work/first/$name.tar.gz" -C "$work" || exit 1
{ git ls-tree -r --name-only HEAD; echo bundled/live.js; echo bundled/viewer.js; } | sort > "$work/wanted"
(cd "$work/$name" && find . ! -type d | sed 's|^\./||' | sort) | diff "$work/wanted" - > "$work/why"
result release/files "$work/why"

# Programs of npm fail and are noted; without a network where the system lets a process have none.
mkdir "$work/bin"
for program in node nodejs npm npx esbuild git; do printf '#!/bin/sh\necho "%s was called" >> "%s/called"; exit 1\n' $program "$work" > "$work/bin/$program"; done
chmod 755 "$work"/bin/*
alone=; unshare -rn true 2> /dev/null && alone="unshare -rn"
offline() { (cd "$work/$name" && MAKEFLAGS= PATH="$work/bin:$PATH" $alone make -s BUILD=build "$@"); }
offline build/viewer.js build/live.js > "$work/why" 2>&1
for file in viewer.js live.js; do [ -s "$work/$name/build/$file" ] && cmp "$work/$name/bundled/$file" "$work/$name/build/$file"; done >> "$work/why" 2>&1
cat "$work/called" >> "$work/why" 2> /dev/null
result release/bundles "$work/why"

[ -n "$LONG" ] || exit 0
offline -j2 all > "$work/log" 2>&1 || tail -n 10 "$work/log" > "$work/why"
awk '/^```scheme$/ { on = 1; next } /^```$/ { if (on) exit } on' README.md > "$work/columns.vs"
mkdir "$work/here" "$work/there"
(cd "$work/there" && limited 300 "$work/$name/build/vs" -q ../columns.vs -o columns.stl -o columns.html $(command -v povray > /dev/null && echo "-o columns.png")) >> "$work/why" 2>&1
for file in columns.stl columns.html $(command -v povray > /dev/null && echo columns.png); do [ -s "$work/there/$file" ] || echo "no $file" >> "$work/why"; done
(cd "$work/here" && "$vs" -q ../columns.vs -o columns.stl) >> "$work/why" 2>&1
cmp "$work/here/columns.stl" "$work/there/columns.stl" >> "$work/why" 2>&1
cat "$work/called" >> "$work/why" 2> /dev/null
result release/job "$work/why"

# The packages of Debian: without a fault that lintian knows, and tried in a bare machine.
if ! command -v dpkg-buildpackage > /dev/null || ! command -v dh > /dev/null; then echo "skip release/deb: no dpkg-buildpackage or debhelper"; exit; fi
sh scripts/deb.sh "$work/first" "$version" > "$work/why" 2>&1 && : > "$work/why"
result release/deb "$work/why"
if command -v lintian > /dev/null; then lintian --allow-root "$work"/first/deb/*.changes > "$work/why" 2>&1; result release/lintian "$work/why"
else echo "skip release/lintian: no lintian"; fi
for suite in bookworm; do
  if [ "$(id -u)" != 0 ] || ! command -v debootstrap > /dev/null; then echo "skip release/$suite: no root or no debootstrap"
  else
    BUILD= VS=$vs sh scripts/deb_trial.sh "$work/first" "$version" $suite > "$work/why" 2>&1; status=$?
    if [ $status = 3 ]; then echo "skip release/$suite: $(tail -n 1 "$work/why")"; continue; fi
    [ $status != 0 ] || : > "$work/why"
    result release/$suite "$work/why"
  fi
done
