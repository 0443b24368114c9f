#!/bin/sh
# Makes a release, BUILD/visualscheme-VERSION.tar.gz: the committed files, and the scripts of web pages and live view,
# bundled with what comes from npm; with these a build needs neither npm nor node. The same commit gives the same bytes.
#
#   scripts/dist.sh BUILD VERSION
set -u
cd "$(dirname "$0")/.." || exit 1
build=$1 name=visualscheme-$2
fail() { echo "make dist: $*" >&2; exit 1; }
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

[ -e .git ] || fail "this folder is no clone, and a release has the files of a commit"
[ -d node_modules/three ] && [ -d node_modules/esbuild ] || fail "npm's packages are missing in node_modules: $(cat "$build/no-page" 2> /dev/null || echo "make demo fetches them")"
[ -z "$(git status --porcelain --untracked-files=no)" ] || echo "warning: changes that are not committed are not in the release" >&2
git archive --prefix="$name/" HEAD > "$work/committed.tar" && tar -xf "$work/committed.tar" -C "$work" || fail "git archive failed"

ln -s "$PWD/node_modules" "$work/$name/node_modules"
MAKEFLAGS= make -s -C "$work/$name" BUILD=bundled bundled/viewer.js bundled/live.js || fail "the bundles cannot be made"
[ -s "$work/$name/bundled/viewer.js" ] && [ -s "$work/$name/bundled/live.js" ] || fail "a bundle is empty"
rm "$work/$name/node_modules"

# Owners, times and order are those of no machine.
mkdir -p "$build"
tar -C "$work" --sort=name --mtime="@${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}" --owner=0 --group=0 --numeric-owner --mode=u+rw,go=rX,u+X \
  --format=ustar -cf "$work/release.tar" "$name" && gzip -9n < "$work/release.tar" > "$build/$name.tar.gz.part" && mv "$build/$name.tar.gz.part" "$build/$name.tar.gz" || fail "cannot write $build/$name.tar.gz"
echo "$build/$name.tar.gz: $(($(wc -c < "$build/$name.tar.gz") / 1024)) KB"
