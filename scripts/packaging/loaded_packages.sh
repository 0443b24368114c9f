#!/bin/sh
# Prints the packages of this machine that own the libraries which vs loads at their first use: those of
# geometry/used_libraries.def, separated by commas.
set -u
cd "$(dirname "$0")/../.." || exit 1
sed -e ':again' -e '/^LOADED(.*,$/{N;s/\n */ /;b again' -e '}' geometry/used_libraries.def |
  sed -n 's/CHOLMOD_FILE/"libcholmod.so.[0-9]*"/; s/JPEG_FILE/"libjpeg.so.[0-9]*"/; /^LOADED(/p' | cut -d '"' -f 2,9- | tr '"' ' ' | sort |
  while read -r name files; do
    found=
    for file in $files; do
      path=$(PATH=$PATH:/sbin:/usr/sbin ldconfig -p | sed -n "s|^.$file .*=> ||p" | head -n 1)
      if [ -n "$path" ]; then found=$(dpkg -S "$(readlink -f "$path")" "$path" 2> /dev/null | sed 's/:.*//' | head -n 1); fi
      [ -z "$found" ] || break
    done
    [ -n "$found" ] || echo "the library $name is not installed" >&2
    echo "$found"
  done | sort -u | grep . | paste -s -d , | sed 's/,/, /g'
