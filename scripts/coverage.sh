#!/bin/sh
# Prints the report of `make coverage`: `scripts/coverage.sh BUILD FOLDER...` prints for each folder the number of lines
# of code that the tests have reached.
set -u
build=$1
shift
for folder in "$@"; do
  find "$build/obj/$folder" -name '*.gcda' | sed 's|.gcda$|.o|' | xargs -r gcov -n -r -s "$PWD" 2>/dev/null | awk -v folder="$folder" '
    /^File / { mine = index($0, "\047" folder "/") && /\.c\047/ }
    /^Lines executed:/ && mine { split($0, part, /[:% ]+/); all += part[5]; hit += part[3] * part[5] / 100; mine = 0 }
    END { printf "%-10s %6.1f %% of %d lines\n", folder, all ? 100 * hit / all : 0, all }'
done
