# Tests that every kind of view of every example becomes a picture, whole and cut. LONG=1 takes all examples and
# kinds; otherwise four examples of many parts and paints, and a cut view of each.
. tests/report.sh
command -v povray > /dev/null || { echo "skip views: no povray (package povray)"; exit 0; }

cp -r examples "$work/examples"
cd "$work/examples" || exit 1
names='arcade corner-cafe rotunda deformed-tower'
kinds='isometric'
[ -z "${LONG:-}" ] || names=$(ls ./*.vs | sed 's|^\./||; s|\.vs$||') kinds='isometric plan section top bottom front back left right'

# small sizes of the examples that would take minutes
smaller() {
  case $1 in
  cylinder-grid) echo -D count=9 ;; vaulted-hall) echo -D bays-long=2 -D bays-deep=2 ;;
  gare-do-oriente) echo -D columns=1 -D rows=1 ;; city) echo -D blocks=2 -D tallest=6 ;;
  esac
}

for name in $names; do
  wanted "views/$name" || continue
  { cat "$name.vs"; echo
    for kind in $kinds; do
      case $kind in
      section) echo "(view \"v-section\" 'section #:cut (make-plane (xyz .1 .1 .1) uy))" ;;
      *) echo "(view \"v-$kind\" '$kind #:cut 1.5)" ;;
      esac
    done; } > "v-$name.vs"
  : > why
  for kind in $kinds; do
    # shellcheck disable=SC2046
    "$vs" -q $(smaller "$name") "v-$name.vs" --view "v-$kind" --quality draft --size 64x48 -o v.png > said 2>&1 ||
      { echo "$kind: ended with $?"; cat said; } >> why
    [ -s v.png ] || echo "$kind: no picture" >> why
    rm -f v.png
  done
  result "views/$name" why
done
