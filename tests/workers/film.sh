# Tests films: ffmpeg joins the frames that POV-Ray makes into a film of their size, number and rate; a
# changed frame makes the film again; without ffmpeg the frames stay, and a message reports that it is missing.
. tests/report.sh

wanted film || exit 0
command -v povray > /dev/null || { echo "skip film: no povray (package povray)"; exit 0; }
cat > "$work/tower.vs" <<'EOF'
(define-parameter t 0.0)
(view "street" #:from (xyz 6 -9 3) #:to (xyz 0 0 2))
(draw (do-rotate (make-box (xyz -1 -1 0) (xyz 1 1 4)) 'z t))
EOF
film() { "$vs" render "$work/tower.vs" -o "$work/100% a.png" --view street --frames 4 --film 12 --quality draft --size 81x61 --exposure 0; }

: > "$work/why"
mkdir "$work/bin" && for program in povray sh; do ln -s "$(command -v $program)" "$work/bin/"; done
(PATH=$work/bin; film) > "$work/said" 2> "$work/err"; status=$?
[ $status = 3 ] || echo "without ffmpeg it ended with $status" >> "$work/why"
grep -q 'the film needs ffmpeg: install the package ffmpeg; all frames were written' "$work/err" || cat "$work/err" >> "$work/why"
[ "$(find "$work" -name '*street-00[1-4].png' | wc -l)" = 4 ] || echo "the frames do not stand" >> "$work/why"
result film:without "$work/why"

# A film whose wall turns dark has one exposure, that of its first frame, also after an interruption.
: > "$work/why"
cat > "$work/day.vs" <<'EOF'
(define-parameter t 0.0)
(view "street" #:from (xyz 6 -9 3) #:to (xyz 0 0 2))
(draw (color (if (< t 0.5) "white" "#202020") (make-box (xyz -9 0 0) (xyz 9 1 9))))
EOF
day() { "$vs" render "$work/day.vs" -o "$work/day.png" --frames 3 --quality draft --size 40x30 "$@" > "$work/said" 2>> "$work/why" || echo "ended with $?" >> "$work/why"; }
exposures() { grep -o '"exposure": [-0-9.]*' "$work/day.manifest.json" | sort | uniq -c | tr -s ' '; }
day
[ "$(exposures | wc -l)" = 1 ] && [ "$(exposures | cut -d' ' -f2)" = 3 ] || { echo "the exposures are"; exposures; } >> "$work/why"
stops=$(exposures | sed 's/.*: //'); cp "$work/day-003.png" "$work/third.png"; cp "$work/day-001.png" "$work/first.png"
"$vs" -q "$work/day.vs" -D t=1 -o "$work/fixed.png" --quality draft --size 40x30 --exposure "$stops" 2>> "$work/why"
"$vs" -q "$work/day.vs" -D t=1 -o "$work/alone.png" --quality draft --size 40x30 2>> "$work/why"
cmp "$work/fixed.png" "$work/third.png" >> "$work/why" 2>&1
cmp -s "$work/alone.png" "$work/third.png" && echo "the dark frame alone has the same exposure: the test says nothing" >> "$work/why"
day; [ "$(grep -c 'up to date' "$work/said")" = 3 ] || { echo "the frames were made again"; cat "$work/said"; } >> "$work/why"
rm "$work/day-003.png"; day; cmp "$work/day-003.png" "$work/third.png" >> "$work/why" 2>&1
[ "$(grep -c 'up to date' "$work/said")" = 2 ] || { echo "not two stand"; cat "$work/said"; } >> "$work/why"
[ -z "$(find "$work" -name '*.light.*')" ] || echo "the metered light is left behind" >> "$work/why"
# a part of the film has the exposure of the first frame, which is not in it
rm "$work"/day*.json "$work"/day-00*.png; day --only 3; cmp "$work/day-003.png" "$work/third.png" >> "$work/why" 2>&1
[ ! -e "$work/day-001.png" ] || echo "the first frame was made, too" >> "$work/why"
day --only 1..2; day; [ "$(grep -c 'up to date' "$work/said")" = 3 ] || { echo "parts were made again"; cat "$work/said"; } >> "$work/why"
cmp "$work/day-001.png" "$work/first.png" >> "$work/why" 2>&1
[ "$(exposures | wc -l)" = 1 ] && [ "$(exposures | sed 's/.*: //')" = "$stops" ] || { echo "the parts' exposures are"; exposures; } >> "$work/why"
day --exposure auto-1; exposures | grep -q " $(awk "BEGIN { printf \"%.2f\", $stops - 1 }")$" || { echo "auto-1 of $stops is"; exposures; } >> "$work/why"
day --exposure 1; [ -z "$(exposures)" ] || echo "a number given was metered" >> "$work/why"
result film:exposure "$work/why"

command -v ffprobe > /dev/null || { echo "skip film:made: no ffmpeg (package ffmpeg)"; exit 0; }
: > "$work/why"
film > "$work/said" 2>> "$work/why" || echo "ended with $?" >> "$work/why"
grep -q 'a-street.mp4: a film of 4 frames' "$work/said" || { echo "no film"; cat "$work/said"; } >> "$work/why"
[ "$(grep -c 'up to date' "$work/said")" = 4 ] || echo "the frames were made again" >> "$work/why"
shown=$(ffprobe -v error -show_entries stream=width,height,nb_frames,r_frame_rate -of csv=p=0 "$work/100% a-street.mp4" 2>&1)
[ "$shown" = 82,62,12/1,4 ] || echo "the film is $shown" >> "$work/why"
film > "$work/said" 2>> "$work/why"
[ "$(grep -c 'up to date' "$work/said")" = 5 ] || { echo "not all is up to date"; cat "$work/said"; } >> "$work/why"
rm "$work/100% a-street-002.png"
film > "$work/said" 2>> "$work/why"
[ "$(grep -c 'up to date' "$work/said")" = 3 ] || { echo "the film of a new frame is old"; cat "$work/said"; } >> "$work/why"
result film:made "$work/why"
