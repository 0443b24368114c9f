# Owns what the scripts of tests/ share: a private folder that ends with the script, the program, and how a result is told. A script begins with
# `. tests/report.sh`, at the root of the repository, with BUILD and ONLY set by tests/run.sh.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
vs=$BUILD/vs tools=$BUILD/tools

result() { # NAME FILE: the file holds the reasons why the test failed, and is empty if it passed
  if [ -s "$2" ]; then echo "not ok $1"; head -n 12 "$2" | sed 's/^/    /'; else echo "ok $1"; fi
}
smaller() { # EXAMPLE, a file: the parameters that make it small where all its formats, or all passes, would take minutes
  case $1 in
  examples/city.vs) echo "-D blocks=2 -D tallest=6" ;;
  examples/cylinder-grid.vs) echo "-D count=9" ;;
  examples/deformed-tower.vs) echo "-D storeys=6" ;;
  examples/gare-do-oriente.vs) echo "-D columns=1 -D rows=1" ;;
  examples/gyroid-pavilion.vs) echo "-D fineness=40" ;;
  examples/hanging-shell.vs) echo "-D n=8" ;;
  examples/lofted-tower.vs) echo "-D height=20 -D turn=0" ;;
  examples/panelised-roof.vs) echo "-D nu=4 -D nv=4" ;;
  examples/rules/massive-street.vs) echo "-D lots=3" ;;
  examples/thesis/5.5-gare.vs) echo "-D x=2 -D y=1" ;;
  examples/twisted-tower.vs) echo "-D floors=6" ;;
  examples/vaulted-hall.vs) echo "-D bays-long=2 -D bays-deep=2" ;;
  esac
}
wanted() { # NAME: is this test, or a test within this script, asked for by ONLY?
  case $1 in *"$ONLY"*) return 0 ;; *) return 1 ;; esac
}
