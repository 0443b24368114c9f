# Tests the time while POV-Ray works: a terminal shows the finished share and the remaining time. Ctrl-C ends
# a run of pictures with 130, without POV-Ray and without an incomplete picture, and the next run makes the missing
# ones.
. tests/report.sh

wanted waiting || exit 0
command -v povray > /dev/null || { echo "skip waiting: no povray (package povray)"; exit 0; }

cat > "$work/slow.vs" <<'EOF'
(define glass-ball (with-material 'glass (make-sphere origin 1)))
(for* ((i 6) (j 6)) (draw (do-move glass-ball (vxyz (* 2 i) (* 2 j) 1))))
(ground 0)
(sky #:turbidity 3)
(view "one" #:from (xyz -6 -6 4) #:to (xyz 5 5 1))
(view "two" #:from (xyz 16 -6 4) #:to (xyz 5 5 1))
EOF

why=$(no_terminal)
if [ -z "$why" ]; then
  : > "$work/why"
  (cd "$work" && timeout -s INT 60 script -qec "$vs slow.vs -o slow.png --quality good --size 640x480" /dev/null) 2>&1 < /dev/null | tr '\r' '\n' > "$work/said"
  grep -q 'slow.png: rendering [0-9]*%, [0-9.]* \(s\|min\) left' "$work/said" || { echo "no time left is told:"; tail -n 5 "$work/said"; } >> "$work/why"
  rm -f "$work/slow.png"
  result waiting:time-left "$work/why"
else
  echo "skip waiting:time-left: $why"
fi

if command -v pgrep > /dev/null; then
  : > "$work/why"
  mkdir -p "$work/out" "$work/tmp"
  TMPDIR=$work/tmp env --default-signal=INT "$vs" render "$work/slow.vs" -o "$work/out/" --all-views --jobs 2 --size 640x480 --manifest "$work/out/m.json" > "$work/said" 2>&1 & process=$!
  for i in $(seq 200); do [ -n "$(pgrep -P "$process")" ] && [ -n "$(ls "$work/tmp")" ] && break; sleep 0.05; done
  sleep 1
  children=$(pgrep -P "$process"; for c in $(pgrep -P "$process"); do pgrep -P "$c"; done)
  kill -INT "$process"; wait "$process"; status=$?
  [ "$status" = 130 ] || echo "ended with $status" >> "$work/why"
  sleep 0.5
  for c in $children; do ! kill -0 "$c" 2> /dev/null || { echo "process $c goes on" >> "$work/why"; kill "$c"; }; done
  left=$(ls -A "$work/tmp"; ls -A "$work/out" | grep -v '^m.json$')
  [ -z "$left" ] || echo "left behind: $left" >> "$work/why"
  "$vs" render "$work/slow.vs" -o "$work/out/" --all-views --quality draft --size 64x48 --manifest "$work/out/m.json" > "$work/said" 2>&1 || cat "$work/said" >> "$work/why"
  [ "$(ls "$work/out" | grep -c '\.png$')" = 2 ] || echo "the next run makes $(ls "$work/out" | tr '\n' ' ')" >> "$work/why"
  result waiting:ctrl-c "$work/why"
else
  echo "skip waiting:ctrl-c: no pgrep (package procps)"
fi

# If the program or a run of pictures is killed, POV-Ray ends as well, and the next run deletes the files of the killed
# one.
if command -v pgrep > /dev/null; then
  : > "$work/why"
  mkdir -p "$work/tmp9" "$work/out9"
  for command in "render $work/slow.vs -o $work/out9/ --all-views --jobs 2" "-q $work/slow.vs -o $work/out9/k.png"; do
    TMPDIR=$work/tmp9 "$vs" $command --size 640x480 > /dev/null 2>&1 & process=$!
    for i in $(seq 300); do pgrep -f "$work/tmp9/visualscheme-work" > /dev/null && break; sleep 0.05; done
    pgrep -f "$work/tmp9/visualscheme-work" > /dev/null || echo "$command: POV-Ray was not seen" >> "$work/why"
    kill -9 "$process"; wait "$process" 2> /dev/null
    for i in $(seq 60); do pgrep -f "$work/tmp9/visualscheme-work" > /dev/null || break; sleep 0.05; done
    for left in $(pgrep -f "$work/tmp9/visualscheme-work"); do echo "$command: POV-Ray goes on" >> "$work/why"; kill -9 "$left"; done
    sleep 0.3
    find "$work/tmp9" "$work/out9" -exec touch -h -d '1 hour ago' {} +
    TMPDIR=$work/tmp9 "$vs" -q "$work/slow.vs" -o "$work/out9/k.png" --size 32x24 --quality draft > "$work/said" 2>&1 || cat "$work/said" >> "$work/why"
    left=$(ls -A "$work/tmp9"; ls -A "$work/out9" | grep 'k.png.')
    [ -z "$left" ] || echo "$command: left behind: $left" >> "$work/why"
  done
  result waiting:killed "$work/why"
fi
