#!/bin/sh
# Prepares a machine: installs the packages of scripts/packages.list for the named purposes, and fetches packages
# from npm: the viewer's parts for a build, those of tests/package.json for the tests. Does nothing, and asks for
# nothing, if all is installed. For Debian and Ubuntu; elsewhere it prints the needed packages. If npm can fetch
# nothing, the script goes on: BUILD/no-page then gives the reason why there will be no web page. A release has bundled/,
# and a build of it needs nothing from npm.
set -u
cd "$(dirname "$0")/.." || exit 1
build=${BUILD:-build} purposes=" $* "
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

have() { command -v "$1" > /dev/null 2>&1; }
wants() { case $purposes in *" $1 "*) return 0 ;; *) return 1 ;; esac; }
installed() { dpkg-query -W -f '${Status}' "$1" 2> /dev/null | grep -q 'install ok installed'; }
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }
by_hand() {
  echo "Please install these by hand, then run make again:" >&2
  echo "  $*" >&2
  exit 1
}

# Prints the progress of a command every ten seconds: reads its log with the awk program and prints that line. Ends with
# `watched`.
watch_log() { (while sleep 10 > /dev/null 2>&1; do awk "$1" "$work/log"; done) & watcher=$!; }
watched() { kill "$watcher" 2> /dev/null; wait "$watcher" 2> /dev/null; }

# ---- missing packages: the build needs those of must; without those of may it skips something ----

must= may=
for purpose in $purposes; do
  for package in $(awk -v p="$purpose" '$1 == p { print $2 }' scripts/packages.list); do
    name=${package%\?}
    case " $must $may " in *" $name "*) continue ;; esac
    if have dpkg-query && installed "$name"; then continue; fi
    case $package in *\?) may="$may $name" ;; *) must="$must $name" ;; esac
  done
done

viewer= checkers=
if wants build && ! [ -f bundled/viewer.js ] && ! { [ -d node_modules/three ] && [ -d node_modules/esbuild ]; }; then viewer=1; fi
if wants tests && ! { [ -d tests/node_modules/playwright-core ] && [ -d tests/node_modules/gltf-validator ]; }; then checkers=--omit=optional; fi
if wants check && ! [ -d tests/node_modules/x_ite ]; then checkers=--include=optional; fi
# If a node is installed, the script never installs Debian's: it would break the other.
if [ -n "$viewer$checkers" ] || wants tests; then have node || may="$may nodejs"; fi

# ---- Debian's packages ----

apt() { as_root env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get -q -y --no-install-recommends -o APT::Keep-Downloaded-Packages=false "$@" > "$work/log" 2>&1; }
# Prints the size of the download, and then the progress.
install() {
  env LC_ALL=C apt-get --assume-no --no-install-recommends install "$@" 2> /dev/null | awk '
    / newly installed/ { n = $3 } /^Need to get/ { get = $4 " " $5; sub(/.*\//, "", get) } /^After this operation/ { disk = $4 " " $5 }
    END { if (n) printf "  %d packages with what they need: %s to fetch, %s on the disk\n", n, get ? get : "nothing", disk }'
  watch_log '/^Get:/ { got++ } /^Unpacking / { unpacked++ } /^Setting up / { ready++ } END { printf "  fetched %d, unpacked %d, set up %d\n", got, unpacked, ready }'
  apt install "$@"; status=$?
  watched
  return $status
}

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
  apt update || echo "apt-get update failed; trying with what is known" >&2
  there=
  for name in $may; do
    if apt-cache policy "$name" 2> /dev/null | grep -q 'Candidate: [^(]'; then there="$there $name"
    else echo "There is no $name here; the tests that need it will be skipped" >&2; fi
  done
  if [ -n "$must$there" ] && ! install $must $there; then
    if [ -n "$must" ] && ! install $must; then
      tail -n 5 "$work/log" >&2
      by_hand $must
    fi
    for name in $there; do
      installed "$name" || apt install "$name" || echo "Could not install $name; the tests that need it will be skipped" >&2
    done
  fi
fi

# ---- packages from npm ----

# Debian's npm depends on 360 packages, most of them for compiling addons and for developing node's modules, which
# fetching does not need. If there is no npm, the script unpacks the package and its dependencies into a folder that it
# deletes at its end: apt takes the following for installed.
unused="gyp libnode-dev webpack node-babel7 eslint istanbul node-core-js node-lodash handlebars node-jest-debbundle node-terser node-postcss"
npm=
borrow_npm() {
  mkdir -p "$work/npm/debs/partial"
  { cat /var/lib/dpkg/status
    for name in $unused; do
      printf '\nPackage: %s\nStatus: install ok installed\nVersion: 9999\nArchitecture: all\nMaintainer: nobody\nDescription: not needed\n' "$name"
    done; } > "$work/npm/status"
  env LC_ALL=C apt-get -q -y --no-install-recommends -o Debug::NoLocking=true -o Dir::State::status="$work/npm/status" \
    -o Dir::Cache="$work/npm" -o Dir::Cache::archives="$work/npm/debs" --download-only install npm > "$work/log" 2>&1 || return 1
  echo "Borrowing Debian's npm, which is not kept: $(ls "$work"/npm/debs/*.deb | wc -l) packages, $(du -sh "$work/npm/debs" | cut -f1)"
  for deb in "$work"/npm/debs/*.deb; do dpkg-deb -x "$deb" "$work/npm/root" || return 1; done
  export NODE_PATH="$work/npm/root/usr/share/nodejs"
  npm="node $NODE_PATH/npm/bin/npm-cli.js"
  $npm --version > "$work/log" 2>&1
}

# fetch FOLDER OPTION: the packages of the folder's package-lock.json, each checked against its checksum there. Sets why
# if this fails.
why=
fetch() {
  if [ -z "$npm" ]; then
    if ! have node; then why="there is no node (package nodejs)"; return 1; fi
    if have npm; then npm=npm
    elif ! have apt-get || ! borrow_npm; then npm= why="there is no npm, and apt-get could not fetch it"; return 1; fi
  fi
  # Of the optional packages it needs one: esbuild's program for this machine, or those that only make check needs.
  all=$(awk '/^    "node_modules\// { n++ } /^      "optional": true/ { n-- } END { print n }' "$1/package-lock.json")
  [ "$2" = --omit=optional ] || all=$((all + 1))
  echo "Fetching $all packages with npm into $1/node_modules"
  watch_log '/http fetch GET 200/ { got++ } END { printf "  fetched %d\n", got }'
  timeout 600 $npm ci --prefix "$1" "$2" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=http --cache "$work/cache" \
    --fetch-retries=1 --fetch-retry-mintimeout=2000 --fetch-timeout=60000 > "$work/log" 2>&1
  status=$?
  watched
  if [ $status = 0 ]; then echo "  $(du -sh "$1/node_modules" | cut -f1) on the disk"; return 0; fi
  why=$(sed -n 's/^npm [Ee][Rr][Rr][^ ]* //p' "$work/log" | awk '/reason: / { print; found = 1; exit } !/^code |^errno / && !first { first = $0 } END { if (!found) print first }' | head -n 1)
  if [ $status = 124 ]; then why="npm fetched for ten minutes without an end"; else why="npm could not fetch it: ${why:-it ended with $status}"; fi
  return 1
}

if [ -n "$viewer" ]; then
  mkdir -p "$build"
  if fetch . --omit=dev; then rm -f "$build/no-page"; else echo "$why" > "$build/no-page"; fi
fi
if [ -n "$checkers" ]; then
  fetch tests "$checkers" || echo "Tests in a browser and of .glb files will be skipped: $why" >&2
fi
exit 0
