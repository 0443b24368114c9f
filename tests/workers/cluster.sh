# Tests --on slurm and vs jobs on a cluster of three nodes that this script starts and stops. LONG=1: a film of 200 frames
# while a node dies, the controller restarts and a disk is full.
. tests/report.sh
. tests/private_cluster.sh

wanted cluster || exit 0
why=$(no_cluster); [ -z "$why" ] || { echo "skip cluster: $why"; exit 0; }
cd "$work" || exit 1
trap stop_cluster EXIT
trap 'exit 130' INT TERM
[ -z "$LONG" ] || touch small
start_cluster > why; code=$?
[ $code != 1 ] || { echo "skip cluster: $(cat why)"; exit 0; }
[ $code = 0 ] || { echo "not ok cluster: $(cat why)"; exit 0; }
jobs_left() { squeue -h | wc -l; }

# ---- a sweep: bundles, a part that always fails, two submissions, cancelling and repeating ----

: > why
cat > part.vs << 'MODEL'
(define-parameter n 1)
(when (= n 7) (car 0))
(report "volume" (* n n))
(draw (make-box origin (xyz n n 1)))
MODEL
sweep() { "$vs" sweep part.vs --set n=1..12:1 --format stl "$@"; }
sweep -q -o plain/ 2> /dev/null
sweep -o out/ --on slurm --bundle 3 > said 2>> why || { echo "the submission ended with $?"; cat said; } >> why
grep -q '^out: 12 parts in 4 bundles submitted as job [0-9]*, and the join as job [0-9]*$' said || cat said >> why
sweep -q -o out/ --on slurm --time 5 --memory 100 2> refused; [ $? = 2 ] && grep -q 'jobs of Slurm already' refused || { echo "a second submission:"; cat refused; } >> why
"$vs" jobs | grep -q '^out: vs sweep --on slurm: .* of 12 parts done, .*wait' || { echo 'vs jobs shows'; "$vs" jobs; } >> why
limited 300 "$vs" jobs wait -q out; code=$?; [ $code = 1 ] || echo "the batch ended with $code" >> why
for f in plain/*.stl; do cmp "$f" "out/${f#plain/}"; done >> why 2>&1
sed 's/plain/out/' plain/results.csv | cmp - out/results.csv >> why 2>&1
made() { cat "$1"/jobs/bundle-*.log said | sed -n 's/^\(.*\): made in.*/\1/p' | sort | uniq -c | awk '{ print $1 }' | sort | uniq -c | xargs; }
[ "$(made out)" = '11 1' ] || echo "parts were made: $(made out)" >> why
[ "$(grep -h 'n=7: failed' out/jobs/bundle-*.log | wc -l)" = 1 ] || echo "the part that fails was tried again" >> why
"$vs" jobs out | grep -qF '  messages: out/jobs/bundle-*.log' || { echo 'no file of messages is named:'; "$vs" jobs out; } >> why
"$vs" jobs retry out | grep -q 'no part is left' || echo "vs jobs retry repeats a failed part" >> why
result cluster:sweep why

: > why
echo '(define-parameter n 1) (define (spin) (if (file-exists? "go") 0 (spin))) (when (> n 1) (spin)) (draw (make-box origin (xyz n 1 1)))' > slow.vs
"$vs" sweep slow.vs --set n=1..6:1 --format stl -o slow/ --on slurm --bundle 1 > said 2>> why
for i in $(seq 300); do [ "$(squeue -h -t R | wc -l)" = 3 ] && break; sleep .1; done
"$vs" jobs cancel slow > said 2>> why; grep -q '1 of 6 parts are done' said || cat said >> why
for i in $(seq 100); do [ "$(jobs_left)" = 0 ] && break; sleep .2; done
[ "$(jobs_left)" = 0 ] || { echo "jobs are left"; squeue; } >> why
touch go; "$vs" jobs | grep -q '1 of 6 parts done, 5 left: vs jobs retry slow' || "$vs" jobs >> why
"$vs" jobs retry slow > said 2>> why; limited 300 "$vs" jobs wait -q slow || echo "it ended with $?" >> why
[ "$(ls slow/*.stl | wc -l)" = 6 ] && [ "$(grep -c done slow/results.csv)" = 6 ] || { ls slow; cat slow/jobs/*.log; } >> why
result cluster:cancel why
[ "$LONG" ] || exit 0

# ---- nodes that do not see the folder of the model, nor that of vs; node n2 makes other bytes ----

: > why
if [ "$spaces" ]; then
  mkdir -p hidden/model/parts hidden/bin shared && cp "$vs" hidden/bin/vs
  echo '(define a 1)' > hidden/model/parts/a.vs
  cat > hidden/model/house.vs << MODEL
(define-parameter n 1)
(load "parts/a.vs")
(define other (if (file-exists? "$work/hidden/other") 1 0))
(report "volume" n)
(draw (make-box origin (xyz n a (+ 1 other))))
MODEL
  packed() { (cd hidden/model && ../bin/vs sweep house.vs --set n=1..12:1 --format stl "$@"); }
  packed -q -o ../../plain-packed/
  packed -o ../../shared/out/ --on slurm --bundle 2 --pack > said 2>> why || { echo "the submission ended with $?"; cat said; } >> why
  limited 300 "$vs" jobs wait -q shared/out || { echo "the packed batch ended with $?"; tail -n 5 shared/out/jobs/*.log; } >> why
  for f in plain-packed/*.stl; do cmp "$f" "shared/out/${f#plain-packed/}"; done >> why 2>&1
  "$vs" jobs shared/out | grep -q 'refused: n2: its sample part has the hash' || { echo 'node n2 is not refused:'; "$vs" jobs shared/out; } >> why
  grep -qx n1 shared/out/jobs/pack/same && grep -qx n3 shared/out/jobs/pack/same || { echo 'the nodes that agree:'; cat shared/out/jobs/pack/same; } >> why
  packed -o ../../shared/out/ 2>&1 | grep -q '12 up to date' || echo 'the packed parts are not up to date' >> why
  echo '(define-parameter t 0) (load "parts/a.vs") (draw (make-box origin (xyz 1 a (+ 1 (/ t 100)))))' > hidden/model/film.vs
  film() { (cd hidden/model && ../bin/vs render film.vs --frames 6,t=1..6 --size 8x6 --quality draft "$@"); }
  film -q -o ../../plain-film/
  film -q -o ../../shared/film/ --on slurm --bundle 2 --pack 2>> why; limited 300 "$vs" jobs wait -q shared/film || { echo "the packed film ended with $?"; tail -n 5 shared/film/jobs/*.log; } >> why
  for f in plain-film/*.png; do cmp "$f" "shared/film/${f#plain-film/}"; done >> why 2>&1
  film -o ../../shared/film/ | grep -c 'up to date' | grep -q '^6$' || echo 'the packed frames are not up to date' >> why
  ls "${TMPDIR:-/tmp}" | grep vs-pack- >> why
  result cluster:pack why
else echo "skip cluster:pack: no namespaces of networks and processes here"; fi

# ---- 200 frames: node n2 dies, the disk of n3 is full, the controller restarts, frame 50 always fails ----

if [ -z "$spaces" ]; then echo "skip cluster:film: no namespaces of networks and processes here"; exit 0; fi
command -v povray > /dev/null || { echo "skip cluster:film: no povray (package povray)"; exit 0; }
: > why
export TMPDIR="$work/tmp"
echo '(define-parameter t 0) (when (= t 50) (car 0)) (draw (make-box origin (xyz 1 1 (+ 1 (/ t 100)))))' > film.vs
film() { "$vs" render film.vs --frames 200,t=1..200 --size 8x6 --quality draft "$@"; }
done_now() { "$vs" jobs --json "$1" | sed -n 's/.*"done": \([0-9]*\).*/\1/p'; }
until_done() { for i in $(seq 900); do [ "$(done_now film)" -ge "$1" ] && return; sleep .5; done; echo "not $1 frames in time" >> why; }
film -o film/ --on slurm --bundle 8 --time 30 --memory 500 > said 2>> why || cat said >> why
until_done 30; kill_node 2
until_done 60; kill "$(cat run/slurmctld.pid)"; sleep 3; start_controller
limited 1800 "$vs" jobs wait -q film; code=$?; [ $code = 1 ] || echo "the film ended with $code" >> why
[ "$(ls film/film-*.png | wc -l)" = 199 ] && [ ! -e film/film-050.png ] || echo "$(ls film/film-*.png | wc -l) frames are there" >> why
frames() { cat film/jobs/bundle-*.log film/jobs/first.log | grep -o "film-[0-9]*.png: $1" | sort | uniq -c; }
[ "$(frames 'made' | wc -l)" = 199 ] && [ "$(frames 'made' | awk '$1 != 1' | wc -l)" = 0 ] || { echo "frames were made:"; frames made | awk '$1 != 1'; } >> why
[ "$(frames failed | grep -c 050)" = 1 ] && [ "$(frames failed | awk '/050/ { print $1 }')" = 1 ] || { echo "frame 50 failed:"; frames failed | grep 050; } >> why
grep -q n3 film/jobs/failed-nodes || echo "no frame met the full disk" >> why
grep -q 'requeue job .* due to failure of node n2' slurmctld.log || echo "no bundle was on the node that died" >> why
find film -name '*.part*' -o -name '*.light.*' | sed 's/^/left behind: /' >> why
[ "$(grep -o '"exposure": [-0-9.]*' film/manifest.json | sort -u | wc -l)" = 1 ] || echo "exposures differ" >> why
film -q --only 1..3 -o own/ 2>> why; film -q --only 198..200 -o own/ 2>> why
for f in own/*.png; do cmp "$f" "film/${f#own/}"; done >> why 2>&1
film -o film/ 2> /dev/null | grep -c 'up to date' | grep -q '^49$' || echo "frames were made again" >> why
result cluster:film why

: > why
echo '(draw (make-sphere origin 1) (make-box (xyz -3 -3 -2) (xyz 3 3 -1)))' > large.vs
large() { "$vs" render large.vs --size 480x270 --quality draft --exposure 0 "$@"; }
large -o large/ --tiles 4x4 --on slurm --bundle 4 --time 30 --memory 1000 > said 2>> why || cat said >> why
limited 1800 "$vs" jobs wait -q large || { echo "the tiles ended with $?"; tail -n 5 large/jobs/*.log; } >> why
large -q -o whole.png 2>> why; cmp whole.png large/large.png >> why 2>&1
result cluster:tiles why
