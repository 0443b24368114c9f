#!/bin/sh
# Installs the program, the library and all that belongs to them below PREFIX, or removes exactly these again.
#
#   scripts/packaging/place.sh install BUILD VERSION
#   scripts/packaging/place.sh uninstall
#
# Variables: PREFIX (/usr/local), DESTDIR, LIB (the libraries' folder below PREFIX: lib), STRIP (the command: strip; an
# empty one keeps what debuggers read). The file PREFIX/share/visualscheme/installed lists each placed file, `f PATH`,
# and each folder that was not there before, `d PATH`. `uninstall` reads it, and so does an `install` of another
# version, which removes the files that this version has no more.
set -u
cd "$(dirname "$0")/../.." || exit 1
umask 022
PREFIX=${PREFIX:-/usr/local} LIB=${LIB:-lib} DESTDIR=${DESTDIR:-} STRIP=${STRIP-strip}
root=$DESTDIR$PREFIX manifest=share/visualscheme/installed
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
tree=$work/tree

fail() { echo "$*" >&2; exit 1; }
# place MODE FILE PATH: copies a file to its place below PREFIX.
place() { mkdir -p "$tree/$(dirname "$3")" && cp "$2" "$tree/$3" && chmod "$1" "$tree/$3" || exit 1; }
# place_all FOLDER PATH: copies the files of a folder of the sources; from a clone, the committed ones alone.
place_all() {
  { [ -e .git ] && git ls-files "$1" 2> /dev/null; } > "$work/files" || find "$1" -type f ! -name '*.pyc' > "$work/files"
  while read -r file; do place 644 "$file" "$2/${file#"$1"/}"; done < "$work/files"
}
# stripped PATH OPTION...: removes from a placed file what only debuggers read.
stripped() { path=$1; shift; [ -z "$STRIP" ] || $STRIP "$@" "$tree/$path" || fail "cannot strip $path"; }

# escaped PATH: prints a path as pkg-config reads it, for the right side of a substitution by sed.
escaped() { printf '%s' "$1" | sed "s/[^A-Za-z0-9_./+:-]/\\\\&/g" | sed 's/[\\&|]/\\&/g'; }

# Lays the whole tree in the work folder.
lay() {
  build=$1 version=$2 doc=share/doc/visualscheme
  place 755 "$build/vs" bin/vs
  stripped bin/vs
  place 755 "$build/libvisualscheme.so" "$LIB/libvisualscheme.so.0"
  stripped "$LIB/libvisualscheme.so.0" -S -x
  ln -s libvisualscheme.so.0 "$tree/$LIB/libvisualscheme.so"
  place 644 "$build/libvisualscheme.a" "$LIB/libvisualscheme.a"
  stripped "$LIB/libvisualscheme.a" -S
  place 644 visualscheme.h include/visualscheme.h
  sed "s|@PREFIX@|$(escaped "$PREFIX")|; s|@LIB@|$(escaped "$LIB")|; s|@VERSION@|$version|" scripts/packaging/visualscheme.pc > "$work/pc" || fail "cannot make visualscheme.pc"
  place 644 "$work/pc" "$LIB/pkgconfig/visualscheme.pc"

  sh scripts/man.sh "$version" > "$work/vs.1" || fail "cannot make the manual page"
  place 644 "$work/vs.1" share/man/man1/vs.1
  sh scripts/man3.sh "$version" "$tree/share/man/man3" || fail "cannot make the library's manual pages"
  for file in bash-completion/completions/vs zsh/site-functions/_vs fish/vendor_completions.d/vs.fish; do
    sh scripts/completions.sh "${file%%[-/]*}" > "$work/completion" || fail "cannot make the completion of $file"
    place 644 "$work/completion" "share/$file"
  done

  place 644 scripts/packaging/visualscheme.desktop share/applications/visualscheme.desktop
  place 644 scripts/packaging/visualscheme-view.desktop share/applications/visualscheme-view.desktop
  place 644 scripts/packaging/visualscheme.xml share/mime/packages/visualscheme.xml
  place 644 scripts/packaging/visualscheme.svg share/icons/hicolor/scalable/apps/visualscheme.svg

  for file in README.md CHANGELOG.md LICENSE NOTICE SECURITY.md; do place 644 $file $doc/$file; done
  place_all manual $doc/manual
  place_all examples $doc/examples
  for folder in library editors python; do place_all $folder share/visualscheme/$folder; done
}

# Tells the desktop and the linker what has changed, where they have the commands for it.
refresh() {
  [ -z "$DESTDIR" ] || return 0
  if command -v update-mime-database > /dev/null && [ -d "$root/share/mime/packages" ]; then update-mime-database "$root/share/mime" 2> /dev/null; fi
  if command -v update-desktop-database > /dev/null && [ -d "$root/share/applications" ]; then update-desktop-database "$root/share/applications" 2> /dev/null; fi
  if command -v ldconfig > /dev/null && [ "$(id -u)" = 0 ]; then ldconfig; fi
  return 0
}

# Removes the files that are listed, then those listed folders that are empty, the deepest first.
remove() { # LIST
  sed -n 's/^f //p' "$1" | while read -r path; do rm -f "$root/$path" || echo "$root/$path"; done > "$work/left"
  [ ! -s "$work/left" ] || fail "cannot remove $(head -n 1 "$work/left")"
  # The desktop's indexes describe the files of their folder: without files they say nothing.
  if grep -q '^d share/mime$' "$1" && [ -z "$(ls "$root/share/mime/packages" 2> /dev/null)" ]; then rm -rf "$root/share/mime"; fi
  if grep -q '^d share/applications$' "$1" && [ "$(ls "$root/share/applications" 2> /dev/null)" = mimeinfo.cache ]; then rm -f "$root/share/applications/mimeinfo.cache"; fi
  sed -n 's/^d //p' "$1" | sort -r | while read -r path; do rmdir "$root/${path#.}" 2> /dev/null; done
  return 0
}

case ${1:-} in
install)
  lay "$2" "$3"
  old=$root/$manifest
  (cd "$tree" && find . ! -type d | sed 's|^\./||' | sort) > "$work/new"
  # Folders: those that an earlier install made, and those that are missing now.
  { [ ! -f "$old" ] || grep '^d ' "$old"
    { (cd "$tree" && find . -type d | sed 's|^\./||'); dirname "$manifest"; } | while read -r path; do [ -d "$root/$path" ] || echo "d $path"; done; } | sort -u > "$work/folders"
  if [ -f "$old" ]; then
    sed 's/^/f /' "$work/new" | sort > "$work/kept"
    { sed -n '/^f /p' "$old" | sort | comm -23 - "$work/kept"; grep '^d ' "$old"; } > "$work/gone"
    remove "$work/gone"
  fi
  (cd "$tree" && find . -type d) | while read -r path; do mkdir -p "$root/$path" || exit 1; done || fail "cannot write below $root"
  # The list comes first: after an interrupted installation, uninstall finds what was placed.
  mkdir -p "$root/${manifest%/*}" && { sed 's/^/f /' "$work/new"; echo "f $manifest"; cat "$work/folders"; } > "$root/$manifest" || fail "cannot write $root/$manifest"
  while read -r path; do
    rm -f "$root/$path" && cp -P "$tree/$path" "$root/$path" || fail "cannot write $root/$path"
  done < "$work/new"
  refresh ;;
uninstall)
  [ -f "$root/$manifest" ] || { echo "nothing to remove: there is no $root/$manifest" >&2; exit 2; }
  cp "$root/$manifest" "$work/list" || exit 1
  remove "$work/list"
  refresh ;;
*) sed -n 's/^#   //p' "$0" >&2; exit 2 ;;
esac
