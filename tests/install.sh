#!/bin/sh
# Tests `make install` and `make uninstall`: what is placed, that it works away from the sources, and that nothing is
# left of it.
. tests/report.sh
wanted install || exit 0

# A folder with a blank in its name, and files of others where ours will be.
root="$work/a root/usr"
mkdir -p "$root/share/applications" "$root/share/man/man1" "$root/bin"
echo theirs > "$root/share/applications/other.desktop"; echo theirs > "$root/share/man/man1/other.1"
everything() { (cd "$root" && find . -exec ls -ldn --time-style=+ {} + | awk '{ $2 = $5 = ""; print }' | sort); }
everything > "$work/before"
if ! MAKEFLAGS= make -s BUILD="${BUILD#"$PWD"/}" DESTDIR="$work/a root" PREFIX=/usr install > "$work/log" 2>&1; then
  echo "not ok install/place"; tail -n 10 "$work/log" | sed 's/^/    /'; exit
fi
echo "ok install/place"

# Each file of the folders for readers is there, as in the sources.
tracked() { { [ -e .git ] && git ls-files "$@" 2> /dev/null; } || find "$@" -type f ! -name '*.pyc'; }
tracked manual examples library editors LICENSE NOTICE README.md CHANGELOG.md > "$work/tracked"
while read -r file; do
  case $file in library/*|editors/*) place=share/visualscheme ;; *) place=share/doc/visualscheme ;; esac
  cmp "$file" "$root/$place/$file"
done < "$work/tracked" > "$work/why" 2>&1
[ "$(wc -l < "$work/tracked")" -gt 200 ] || echo "only $(wc -l < "$work/tracked") files are compared" >> "$work/why"
result install/documents "$work/why"

# No debugger's data, and no writable or closed file.
{ for file in bin/vs lib/libvisualscheme.so.0 lib/libvisualscheme.a; do objdump -h "$root/$file" | grep -q 'debug_info' && echo "$file has debug_info"; done
  find "$root" -type f ! -perm 644 ! -perm 755; find "$root" -type d ! -perm 755; } > "$work/why" 2>&1
if command -v objdump > /dev/null; then result install/stripped "$work/why"; else echo "skip install/stripped: no objdump (package binutils)"; fi

# The README's main job with the installed program, from a folder of its own, gives the bytes of the built program.
awk '/^```scheme$/ { on = 1; next } /^```$/ { if (on) exit } on' README.md > "$work/columns.vs"
mkdir "$work/there" "$work/here"
(cd "$work/there" && env -i HOME="$work/there" PATH="$root/bin:/usr/bin:/bin" vs -q ../columns.vs -o columns.html -o columns.stl -o columns.scad) > "$work/why" 2>&1
(cd "$work/here" && "$vs" -q ../columns.vs -o columns.html -o columns.stl -o columns.scad) >> "$work/why" 2>&1
diff -r "$work/here" "$work/there" >> "$work/why" 2>&1
[ -s "$work/there/columns.stl" ] || echo "no columns.stl" >> "$work/why"
result install/job "$work/why"

# Each library of used_libraries.def is a file of the package that its row names; vs --version prints all with licences.
sed -e ':again' -e '/^LOADED(.*,$/{N;s/\n */ /;b again' -e '}' geometry/used_libraries.def | sed -n 's/^LOADED(//p' |
  sed 's/CHOLMOD_FILE/"libcholmod.so.[0-9]*"/; s/JPEG_FILE/"libjpeg.so.[0-9]*"/' | awk -F '"' '{ print $2 "|" $4 "|" $6 "|" $10 }' > "$work/rows"
"$vs" --version > "$work/version"
: > "$work/why"
while IFS='|' read -r name licence package file; do
  grep -q "^  $name, for .*: $licence\$" "$work/version" || echo "vs --version lacks $name"
  [ -f /etc/os-release ] && grep -q bookworm /etc/os-release && command -v dpkg > /dev/null || continue
  path=$(ldconfig -p | sed -n "s|^.$file .*=> ||p" | head -n 1)
  if [ -z "$path" ]; then echo "$name: $file of $package is not installed"
  else dpkg -S "$(readlink -f "$path")" "$path" 2> /dev/null | grep -q "^$package:" || echo "$name: $path is not in $package"; fi
done < "$work/rows" > "$work/why" 2>&1
[ "$(wc -l < "$work/rows")" = "$(grep -c '^LOADED(' geometry/used_libraries.def)" ] || echo "some rows are not read" >> "$work/why"
result install/libraries "$work/why"

# pkg-config gives the program's version and the places.
version=$("$root/bin/vs" --version | sed -n '1s/^vs \([0-9.]*\).*/\1/p')
: > "$work/why"
if command -v pkg-config > /dev/null; then
  said=$(PKG_CONFIG_PATH="$root/lib/pkgconfig" pkg-config --modversion visualscheme 2>&1)
  [ -n "$version" ] && [ "$said" = "$version" ] || echo "pkg-config has version $said, vs has $version" >> "$work/why"
  said=$(PKG_CONFIG_PATH="$root/lib/pkgconfig" pkg-config --variable=libdir visualscheme 2>&1)
  [ "$said" = /usr/lib ] || echo "the library's folder is $said" >> "$work/why"
  PKG_CONFIG_PATH="$root/lib/pkgconfig" pkg-config --libs visualscheme >> "$work/log" 2>> "$work/why"
  # The flags have the folder as the shell reads it, also with characters that mean something to sed, shell or pkg-config.
  odd="$work/a & b|c'd"
  PREFIX=$odd DESTDIR= STRIP= sh scripts/packaging/place.sh install "$BUILD" "$version" >> "$work/why" 2>&1
  flags=$(PKG_CONFIG_PATH="$odd/lib/pkgconfig" pkg-config --cflags-only-I visualscheme 2>> "$work/why")
  eval "set -- $flags"
  [ "${1:-}" = "-I$odd/include" ] || echo "the header's folder is $flags" >> "$work/why"
  PREFIX=$odd DESTDIR= sh scripts/packaging/place.sh uninstall >> "$work/why" 2>&1
  result install/pkg-config "$work/why"
else echo "skip install/pkg-config: no pkg-config"; fi

# The desktop's files name what is there: programs, icon, type.
: > "$work/why"
for file in "$root"/share/applications/visualscheme*.desktop; do
  said=$(sed -n 's/^Exec=\([^ ]*\).*/\1/p' "$file"); [ -x "$root/bin/$said" ] || echo "$file: no program $said"
  said=$(sed -n 's/^Icon=//p' "$file"); [ -s "$root/share/icons/hicolor/scalable/apps/$said.svg" ] || echo "$file: no icon $said"
  said=$(sed -n 's/^MimeType=\(.*\);/\1/p' "$file"); [ -z "$said" ] || grep -q "type=\"$said\"" "$root/share/mime/packages/visualscheme.xml" || echo "$file: no type $said"
  ! command -v desktop-file-validate > /dev/null || desktop-file-validate "$file"
done > "$work/why" 2>&1
if command -v xmllint > /dev/null; then xmllint --noout "$root/share/mime/packages/visualscheme.xml" "$root/share/icons/hicolor/scalable/apps/visualscheme.svg" >> "$work/why" 2>&1; fi
if command -v update-mime-database > /dev/null; then
  cp -r "$root/share/mime" "$work/mime" && XDG_DATA_DIRS=$work update-mime-database "$work/mime" >> "$work/why" 2>&1
  grep -qx '50:text/x-visualscheme:\*\.vs' "$work/mime/globs2" || echo "a .vs has no type" >> "$work/why"
fi
result install/desktop "$work/why"

# Another version replaces this one: files that it has no more are removed, with their folders.
placed() { PREFIX=/usr DESTDIR="$work/a root" sh scripts/packaging/place.sh "$@"; }
everything > "$work/first"
mkdir "$root/share/visualscheme/older" && echo older > "$root/share/visualscheme/older/file"
printf '%s\n' 'f share/visualscheme/older/file' 'd share/visualscheme/older' >> "$root/share/visualscheme/installed"
placed install "$BUILD" 0.0.0 > "$work/why" 2>&1
everything | diff "$work/first" - | grep -v 'share/visualscheme/installed$' | grep '^[<>]' >> "$work/why"
result install/replace "$work/why"

placed uninstall > "$work/why" 2>&1
everything | diff "$work/before" - >> "$work/why"
grep -Lx theirs "$root/share/applications/other.desktop" "$root/share/man/man1/other.1" >> "$work/why"
result install/uninstall "$work/why"

# An installation that ends before its last file can be removed as well.
last=$root/share/visualscheme/python/visualscheme
mkdir -p "$last"
everything > "$work/blocked"
mkdir -p "$last/__init__.py/a folder"
placed install "$BUILD" 0.0.0 > "$work/log" 2>&1; status=$?
rm -r "$last/__init__.py"
: > "$work/why"
{ [ $status = 1 ] && grep -q '__init__.py$' "$work/log" && [ -s "$root/bin/vs" ]; } || { echo "ended with $status"; cat "$work/log"; } > "$work/why"
placed uninstall >> "$work/why" 2>&1
everything | diff "$work/blocked" - >> "$work/why"
result install/interrupted "$work/why"
rm -r "$root/share/visualscheme"

placed uninstall > "$work/log" 2>&1; status=$?
: > "$work/why"
[ $status = 2 ] && grep -q '^nothing to remove: there is no .*/usr/share/visualscheme/installed$' "$work/log" || { echo "ended with $status"; cat "$work/log"; } > "$work/why"
result install/nothing "$work/why"
