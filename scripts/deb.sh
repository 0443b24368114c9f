#!/bin/sh
# Makes packages of Debian below BUILD/deb from the release BUILD/visualscheme-VERSION.tar.gz and scripts/packaging/debian.
#
#   scripts/deb.sh BUILD VERSION
set -u
cd "$(dirname "$0")/.." || exit 1
name=visualscheme-$2 release=$1/visualscheme-$2.tar.gz
fail() { echo "make deb: $*" >&2; exit 1; }
[ -f "$release" ] || fail "$release is missing: make dist"
rm -rf "$1/deb" && mkdir -p "$1/deb" && deb=$(cd "$1/deb" && pwd) && cp "$release" "$deb/visualscheme_$2.orig.tar.gz" && tar -xzf "$release" -C "$deb" || fail "cannot unpack $release"
cp -r "$deb/$name/scripts/packaging/debian" "$deb/$name/debian" && cd "$deb/$name/debian" || exit 1

# The fields that the project has elsewhere: what a build needs, holders of rights, version and day.
maintainer="The VisualScheme authors <authors@visualscheme.example>"
needs=$(awk '$1 == "build" && $2 !~ /^(gcc|make|libc6-dev)$/ { printf "%s%s", (n++ ? ", " : ""), $2 }' ../scripts/packages.list)
sed "s/@MAINTAINER@/$maintainer/; s/@BUILD@/$needs/" control.in > control
{ sed "s/@COPYRIGHT@/$(sed -n 's/^Copyright (c) //p' ../LICENSE)/" copyright.in; awk 'NR > 4 { print ($0 == "" ? " ." : " " $0) }' ../LICENSE; } > copyright
printf 'visualscheme (%s-1) unstable; urgency=medium\n\n  * New release: CHANGELOG.md has its changes.\n\n -- %s  %s\n' "$2" "$maintainer" "$(LC_ALL=C date -u -R -r ../visualscheme.h)" > changelog
rm control.in copyright.in
cd .. && MAKEFLAGS= BUILD= DEB_BUILD_OPTIONS="parallel=$(nproc) ${DEB_BUILD_OPTIONS:-}" dpkg-buildpackage -us -uc > "$deb/log" 2>&1 || { tail -n 20 "$deb/log" >&2; fail "dpkg-buildpackage failed: $deb/log"; }
rm -rf "$deb/${name:?}"
for file in "$deb"/*.deb; do echo "$1/deb/$(basename "$file"): $(($(wc -c < "$file") / 1024)) KB"; done
