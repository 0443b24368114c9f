# Defines the common part of the scripts of tests/: a private folder that ends with the script, the program, and the report
# of a result. A script begins with `. tests/report.sh`, at the root of the repository, with BUILD and ONLY set by
# tests/run.sh.
. tests/limited.sh
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
vs=$BUILD/vs tools=$BUILD/tools

result() { # NAME FILE: the file holds the reasons why the test failed, and is empty if it passed
  if [ -s "$2" ]; then echo "not ok $1"; head -n 12 "$2" | sed 's/^/    /'; else echo "ok $1"; fi
}
wanted() { # NAME: is this test, or a test NAME:... within it, asked for by ONLY?
  case $1 in *"$ONLY"*) return 0 ;; esac
  case $ONLY in "$1":*) return 0 ;; *) return 1 ;; esac
}
# Prints the reason why tests cannot use a terminal here, in one line; nothing if they can.
no_terminal() {
  if ! command -v script > /dev/null; then echo "no script (package bsdutils)"
  elif ! script -qec true /dev/null > /dev/null 2>&1 < /dev/null; then echo "no pseudo-terminal here (/dev/pts)"; fi
}
