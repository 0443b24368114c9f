#!/bin/sh
# Measures the costs of two batches: 10,000 variants of a facade and a film of 2,000 frames of 4K. Prints the table of
# manual/cluster.md. `bench/cluster.sh build/vs build/measure`; WRITE=FILE replaces the table of that file. The cluster is
# that of tests/private_cluster.sh: three nodes on this machine.
#
# Parts, the work around them and joins are processor time, so that other work on the machine hardly counts; submissions
# are elapsed time, since they wait for Slurm. A part is a run of `vs` by itself. The work of the batch is all that
# `vs sweep` and `vs render` add to the parts: preparation and submission, the work around each part (process, manifest,
# hashes), and the join. The work around a set is that of a set of a box, a whole run of `vs` included. The work around a
# frame is the difference between frames of a film and pictures.
set -u
vs=$(realpath "$1") measure=$(realpath "$2")
[ -x "$vs" ] && [ -x "$measure" ] || { echo "bench/cluster.sh: make all build/measure first" >&2; exit 1; }
into=${WRITE:+$(realpath "$WRITE")}
cd "$(dirname "$0")/.." || exit 1
examples=$PWD/examples work=$(mktemp -d) || exit 1
. tests/private_cluster.sh
why=$(no_cluster); [ -z "$why" ] || { echo "bench/cluster.sh: $why" >&2; exit 1; }
trap stop_cluster EXIT
trap 'exit 130' INT TERM
start_cluster >&2 || exit 1
cd "$work" || exit 1
cp "$examples/voronoi-facade.vs" facade.vs && cp "$examples/twisted-tower.vs" tower.vs || exit 1

# Prints the seconds of processor time of a command, the median of $1 runs; with by=2 the elapsed seconds.
by=1
cost() {
  "$measure" "$@" > said 2> cost || { echo "bench/cluster.sh: $*" >&2; cat said cost >&2; return 1; }
  awk -v by=$by 'END { print $by / 1000 }' cost
}
value() { awk "BEGIN { printf \"%.6f\", $1 }"; }
until_idle() { while [ -n "$(squeue -h)" ]; do sleep .5; done; }

# ---- 10,000 sets: prepared and submitted, made in bundles, joined ----

echo '(define-parameter n 1) (report "square" (* n n)) (draw (make-box origin (xyz 1 1 n)))' > small.vs
sweep="$vs sweep -q small.vs --set n=1..10000:1 --format stl -o out/"
sets_prepared=$(by=2; cost 1 $sweep --on slurm --time 30 --memory 500) || exit 1
"$vs" jobs wait -q out || { "$vs" jobs out; tail -n 5 out/jobs/*.log; exit 1; } >&2
sets_joined=$(cost 3 $sweep --join) || exit 1
around_a_set=$(cost 1 "$vs" sweep -q small.vs --set n=1..500:1 --format stl -o around/ -j 1 --only 1..500) || exit 1
around_a_set=$(value "$around_a_set / 500")
variant_stl=$(cost 3 "$vs" -q facade.vs -D count=270 -o facade.stl) || exit 1
variant_png=$(cost 3 "$vs" -q facade.vs -D count=270 -o facade.png --size 480x360 --quality draft) || exit 1

# ---- 2,000 frames ----

film() { echo "$vs render -q tower.vs --frames 2000,turn=0..360 --exposure 0 --size $1 --quality $2 -o $3/"; }
frames_prepared=$(by=2; cost 1 $(film 3840x2160 good submitted) --on slurm --time 90 --memory 1900) || exit 1
"$vs" jobs cancel submitted > /dev/null; until_idle
of_a_film=$(cost 1 $(film 16x9 draft tiny) --jobs 1 --only 1..40) || exit 1
picture=$(cost 9 "$vs" -q tower.vs -D turn=3 -o tiny.png --size 16x9 --quality draft --exposure 0) || exit 1
around_a_frame=$(value "$of_a_film / 40 - $picture")
# a join lists 2,000 frames, and reads each: a frame of 4K, with the start of the program
$(film 16x9 draft tiny) --join > said 2>&1
grep -q '1960 of 2000 pictures are missing' said || { echo 'a join of 40 frames of 2,000 says:'; cat said; exit 1; } >&2
listed=$(cost 3 sh -c "$(film 16x9 draft tiny) --join > /dev/null 2>&1; true") || exit 1
one() { echo "$vs render -q tower.vs --frames 1,turn=9..9 --exposure 0 --size 3840x2160 -o $1/ --quality $1"; }
draft=$(cost 1 $(one draft)) && good=$(cost 1 $(one good)) && read_one=$(cost 5 $(one good) --join) || exit 1
frames_joined=$(value "$listed + 2000 * $read_one")

# ---- Slurm itself ----

began=$(date +%s.%N)
sbatch --parsable --array=1-60 --output=/dev/null --wrap true > said || exit 1
until_idle
empty=$(value "($(date +%s.%N) - $began) / 60")

row() { # NAME PARTS SECONDS-OF-A-PART PREPARED AROUND-A-PART JOINED
  awk -v name="$1" -v n="$2" -v part="$3" -v prepared="$4" -v around="$5" -v joined="$6" 'BEGIN {
    own = prepared + n * around + joined
    printf "| %s | %.2f s | %.1f h | %.2f s | %.1f ms | %.1f s | %.2f %% |\n", name, part, n * part / 3600, prepared, 1000 * around, joined, 100 * own / (n * part)
  }'
}
{
  echo '| batch | a part | all parts | submitted | around a part | joined | work of the batch |'
  echo '|---|--:|--:|--:|--:|--:|--:|'
  row '10,000 facades, `.stl`' 10000 "$variant_stl" "$sets_prepared" "$around_a_set" "$sets_joined"
  row '10,000 facades, pictures of 480 by 360' 10000 "$variant_png" "$sets_prepared" "$around_a_set" "$sets_joined"
  row '2,000 frames of 3840 by 2160, draft' 2000 "$draft" "$frames_prepared" "$around_a_frame" "$frames_joined"
  row '2,000 frames of 3840 by 2160, good' 2000 "$good" "$frames_prepared" "$around_a_frame" "$frames_joined"
  echo
  printf 'An empty job of an array takes Slurm %.2f s here, elapsed, on three nodes of one processor each.\n' "$empty"
} > table
cat table
[ -z "$into" ] || { awk -v table="$work/table" '
  /^<!-- cluster -->$/ { print; while ((getline line < table) > 0) print line; skip = 1 }
  /^<!-- end -->$/ { skip = 0 }
  !skip' "$into" > new && cat new > "$into"; }
