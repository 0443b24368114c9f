#!/bin/sh
# Owns getting a machine ready: installs the packages of scripts/packages.list for the purposes named, and what comes from npm: the viewer's parts when building.
# Does nothing, and asks for nothing, when all is there. Debian and Ubuntu; elsewhere it says what is needed.
set -u
cd "$(dirname "$0")/.." || exit 1

have() { command -v "$1" >/dev/null 2>&1; }
installed() { dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q 'install ok installed'; }

# The sets a purpose needs, in the list's order; the ? is kept.
wanted() {
  for purpose in "$@"; do awk -v p="$purpose" '$1 == p { print $2 }' scripts/packages.list; done
}

by_hand() {
  echo "Please install these by hand, then run make again:" >&2
  echo "  $*" >&2
  exit 1
}

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }

must= may=
for package in $(wanted "$@"); do
  name=${package%\?}
  if have dpkg-query && installed "$name"; then continue; fi
  case $package in *\?) may="$may $name" ;; *) must="$must $name" ;; esac
done

# npm fetches three.js and esbuild, of which the viewer inside our web pages is made. Where there is an npm, Debian's is never installed: it would break the other.
case " $* " in *" build "*)
  { [ -d node_modules/three ] && [ -d node_modules/esbuild ]; } || have npm || must="$must nodejs npm" ;;
esac

if [ -n "$must$may" ]; then
  have apt-get || by_hand $must $may
  if [ "$(id -u)" != 0 ] && ! have sudo; then
    [ -z "$must" ] || by_hand $must $may
    echo "Not root and no sudo: going on without$may" >&2
    may=
  fi
fi
if [ -n "$must$may" ]; then
  echo "Installing with apt-get:$must$may"
  log=$(mktemp) || exit 1
  trap 'rm -f "$log"' EXIT
  apt() { as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends "$@" > "$log" 2>&1; }
  apt update || echo "apt-get update failed; trying with what is known" >&2
  if [ -n "$must" ] && ! apt install $must; then
    tail -n 5 "$log" >&2
    by_hand $must
  fi
  for name in $may; do
    apt install "$name" || echo "Could not install $name; the tests that need it will be skipped" >&2
  done
fi

# Packages from npm: the viewer inside our pages when building; a browser's driver and the checker of .glb files for the tests.
fetch() {
  [ -d "node_modules/$1" ] && return
  echo "Fetching $1 with npm"
  npm ci --ignore-scripts --no-audit --no-fund --loglevel=error > /dev/null || echo "npm could not fetch $1: $2; run 'npm ci --ignore-scripts' and build again" >&2
}
case " $* " in *" build "*) fetch three "web pages (.html) will not be available"; fetch esbuild "web pages (.html) will not be available" ;; esac
case " $* " in *" tests "*) fetch gltf-validator "the test of .glb files will be skipped"; fetch playwright-core "the tests of pages will be skipped" ;; esac
exit 0
