# Tests that passes change no picture and no volume: every example without passes and with all of them, meshed,
# and drawn by POV-Ray as numbers in the draft quality (the other qualities sample at random, and differ from run to
# run). A sample, or with LONG=1 every example, and each pass alone.
. tests/report.sh

examples='doric-columns cylinder-grid rotunda gare-do-oriente'
[ -z "${LONG:-}" ] || examples=$(ls examples/*.vs | sed 's|examples/||; s|\.vs$||')
# Parameters that make an example small: its pictures and meshes are made five times.
smaller() {
  case $1 in
  city) echo "-D blocks=2 -D tallest=6" ;;
  cylinder-grid) echo "-D count=9" ;;
  deformed-tower) echo "-D storeys=6" ;;
  diagrid-roof) echo "-D across=3 -D along=4" ;;
  diagrid-tower) echo "-D storeys=8 -D sides=8" ;;
  gare-analysed) echo "-D columns=1 -D rows=1" ;;
  school-plan) echo "-D classes=2" ;;
  gare-do-oriente) echo "-D columns=1 -D rows=1" ;;
  gyroid-pavilion) echo "-D fineness=40" ;;
  hanging-shell) echo "-D n=8" ;;
  lofted-tower) echo "-D height=20 -D turn=0" ;;
  panelised-roof) echo "-D nu=4 -D nv=4" ;;
  twisted-tower) echo "-D floors=6" ;;
  vaulted-hall) echo "-D bays-long=2 -D bays-deep=2" ;;
  esac
}
ways='-O'
[ -z "${LONG:-}" ] || ways='-O -Ofold -Oshare -Oflatten -Oprune'

# Every set of passes in every back-end: the same closed volume, and only the requested passes have changed the drawing.
if wanted passes/switches; then
  model=tests/workers/formats.vs
  : > "$work/why"
  volume=
  for fold in '' fold,; do for flatten in '' flatten,; do for prune in '' prune,; do for share in '' share,; do
    set=$fold$flatten$prune$share
    set=${set%,}
    "$vs" --quiet "-O${set:-0}" --stats=json $model -o "$work/m.stl" -o "$work/m.pov" -o "$work/m.scad" -o "$work/m.x3d" -o "$work/m.html" -o "$work/m.glb" -o "$work/m.3mf" -o "$work/m.obj" \
      -o "$work/m.ply" -o "$work/m.off" > "$work/said" 2> "$work/stats" || echo "-O${set:-0} ended with $?: $(head -n 1 "$work/stats")" >> "$work/why"
    for pass in fold flatten prune share; do
      count=$(sed -n "s/.*\"passes.$pass\": \([0-9]*\).*/\1/p" "$work/stats" | head -n 1)
      case ,$set, in
        *,$pass,*) [ -n "$count" ] || echo "-O$set: no count of $pass" >> "$work/why" ;;
        *) [ "$count" = 0 ] || echo "-O${set:-0}: $pass was not asked for and did ${count:-nothing that is counted}" >> "$work/why" ;;
      esac
    done
    now=$("$BUILD/tools/stlcheck" "$work/m.stl" 2>&1 | awk '{ print $4 }')
    volume=${volume:-$now}
    echo "$volume $now" | awk -v set="${set:-0}" '!($1 > 0 && ($1 - $2)^2 < (1e-4 * $1)^2) { print "-O" set ": volume " $2 ", not " $1 }' >> "$work/why"
  done; done; done; done
  result passes/switches "$work/why"
fi

for name in $examples; do
  test=passes/$name arguments=$(smaller "$name")
  wanted "$test" || continue
  if ! command -v povray > /dev/null; then echo "skip $test: no povray (package povray)"; continue; fi
  : > "$work/why"
  # shellcheck disable=SC2086
  "$vs" --quiet --quality draft --size 160x120 -O0 $arguments examples/$name.vs -o "$work/plain.exr" -o "$work/plain.stl" > "$work/said" 2>&1 || sed "s/^/-O0 failed: /" "$work/said" >> "$work/why"
  for way in $ways; do
    # shellcheck disable=SC2086
    "$vs" --quiet --quality draft --size 160x120 $way $arguments examples/$name.vs -o "$work/way.exr" -o "$work/way.stl" > "$work/said" 2>&1 || sed "s/^/$way failed: /" "$work/said" >> "$work/why"
    # Numbers in the scene may differ in their last digit, so at an edge one pixel in a thousand may be sampled
    # differently. The cafe's chairs are of oak. POV-Ray begins its grain anew in copies that are moved
    # (manual/materials.md); in folded ones it begins at the model's origin, which shows in half a hundredth of the
    # pixels.
    most='0.001 0.0001'
    [ "$name" != corner-cafe ] || most='0.01 0.0005'
    "$BUILD/tools/exrdiff" "$work/plain.exr" "$work/way.exr" 2>> "$work/why" |
      awk -v way="$way" -v most="$most" '{ split(most, m) } !($1 > 0 && $3 <= m[1] * $1 && $6 + 0 < m[2]) { print way ": another picture: " $0 }' >> "$work/why"
    echo "$("$BUILD/tools/stlcheck" "$work/plain.stl" 2>&1) $("$BUILD/tools/stlcheck" "$work/way.stl" 2>&1)" |
      awk -v way="$way" '{ for (i = 1; i <= NF; i++) if ($i == "volume") v[++n] = $(i + 1)
        if (n != 2 || !(v[1] > 0) || (v[1] - v[2])^2 > (1e-4 * v[1])^2) print way ": another volume: " $0 }' >> "$work/why"
  done
  result "$test" "$work/why"
done
