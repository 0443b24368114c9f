#!/bin/sh
# Tests that a fault loses nothing: failing system calls (strace injects them), signals at random moments, two
# writers of one file, closed streams. Each time the file is the complete old or new one, no other file is left beside
# it, and the exit code is a defined one. LONG=1: 10,000 signals.
case limits/faults in *"$ONLY"*) ;; *) exit 0 ;; esac
. tests/report.sh
model='(display "printed") (draw (subtract (make-sphere (xyz 0 0 0) 1) (make-box (xyz 0 0 0) (xyz 1 1 1)) (make-cylinder (xyz 0 0 -2) 4 1/4)))'
echo "$model" > "$work/model.vs"
mkdir "$work/out" "$work/new"
wrong=$work/wrong
: > "$wrong"
say() { if [ -s "$wrong" ]; then echo "not ok limits/$1"; sed 's/^/    /' "$wrong" | head -n 12; else echo "ok limits/$1"; fi; : > "$wrong"; }

# whole NAME WHAT: out/NAME is the old or the new file, and the folder contains no other
whole() {
  if [ "$(cat "$work/out/$1")" != old ] && ! cmp -s "$work/out/$1" "$work/new/$1"; then echo "$2: $1 is neither the old file nor the new one" >> "$wrong"; fi
  [ "$(ls -A "$work/out")" = "$1" ] || { echo "$2: left $(ls -A "$work/out" | tr '\n' ' ')" >> "$wrong"; rm -f "$work"/out/*; }
  echo old > "$work/out/$1"
}

suffixes="stl html 3mf"
for s in $suffixes; do "$BUILD/vs" -q "$work/model.vs" -o "$work/new/a.$s" > /dev/null || echo "a.$s cannot be written" >> "$wrong"; done

if command -v strace >/dev/null 2>&1 && strace -o /dev/null true 2>/dev/null; then
  calls="write:ENOSPC write:EIO write:EINTR fsync:EIO fsync:ENOSPC close:EIO linkat:EIO linkat:ENOSPC rename:EIO openat:EMFILE openat:EACCES mmap:ENOMEM clone3:EAGAIN clone:EAGAIN mremap:ENOMEM"
  moments="1 2 3 4 5 6 7 8 9 10 12 15 20 25 30 40 60 80 1+ 2+ 5+ 10+"
  [ -n "${LONG:-}" ] || { calls="write:ENOSPC write:EINTR fsync:EIO linkat:EIO openat:EMFILE mmap:ENOMEM clone3:EAGAIN" moments=2; }
  for s in $suffixes; do
    echo old > "$work/out/a.$s"
    for call in $calls; do
      for when in $moments; do
        case $call/$when in *:EINTR/*+) continue ;; esac # who is always interrupted tries for ever
        timeout 60 strace -f -qq -o /dev/null -e trace="${call%:*}" -e inject="${call%:*}:error=${call#*:}:when=$when" "$BUILD/vs" -q "$work/model.vs" -o "$work/out/a.$s" > /dev/null 2> "$work/err" < /dev/null
        status=$?
        case $status in 0|2|3|4|127) ;; *) # 127: the loader's end, before ours has begun
          case $status/$call/$when in 139/mmap:ENOMEM/1|139/mmap:ENOMEM/1+) ;; # the loader does not look
            *) echo "$call at $when, $s: ended with $status: $(tail -n 1 "$work/err")" >> "$wrong" ;;
          esac ;;
        esac
        [ $status = 0 ] && ! cmp -s "$work/out/a.$s" "$work/new/a.$s" && echo "$call at $when, $s: ended with 0, and the file is not the new one" >> "$wrong"
        whole "a.$s" "$call at $when"
      done
      [ -n "${LONG:-}" ] || [ "$s" = stl ] || break
    done
    rm -f "$work"/out/*
  done
  say faults-of-the-system
else
  echo "skip limits/faults-of-the-system: no strace"
fi

# signals: each run is interrupted after a random part of its time
rm -f "$work"/out/*
echo old > "$work/old"
"$tools/stopped" "$([ -n "${LONG:-}" ] && echo 10000 || echo 20)" "$work/old" "$work/new/a.stl" "$work/out/a.stl" "$BUILD/vs" -q "$work/model.vs" -o "$work/out/a.stl" > "$work/stopped" 2>&1 ||
  cat "$work/stopped" >> "$wrong"
echo old > "$work/out/a.stl"
say faults-signals

# two writers of one file
for i in 1 2; do
  "$BUILD/vs" -q "$work/model.vs" -o "$work/out/a.stl" > /dev/null 2>&1 & one=$!
  "$BUILD/vs" -q "$work/model.vs" -o "$work/out/a.stl" > /dev/null 2>&1 & two=$!
  wait $one || echo "the first writer ended with $?" >> "$wrong"
  wait $two || echo "the second writer ended with $?" >> "$wrong"
  cmp -s "$work/out/a.stl" "$work/new/a.stl" || echo "two writers made something else" >> "$wrong"
  whole a.stl "two writers"
done
say faults-two-writers

# closed streams
"$BUILD/vs" -q "$work/model.vs" -o "$work/out/a.stl" >&- 2> /dev/null < /dev/null
[ $? = 2 ] || echo "closed standard output: not exit 2" >> "$wrong"
whole a.stl "closed standard output"
"$BUILD/vs" -q "$work/model.vs" -o "$work/out/a.stl" > "$work/printed" 2>&- < /dev/null || echo "closed standard error: ended with $?" >> "$wrong"
[ "$(cat "$work/printed")" = printed ] || echo "closed standard error: the print is lost" >> "$wrong"
whole a.stl "closed standard error"
"$BUILD/vs" -q "$work/model.vs" -o "$work/out/a.stl" >&- 2>&- <&-
whole a.stl "all closed"
"$BUILD/vs" -q "$work/model.vs" -o - --format stl > /dev/full 2> /dev/null && echo "a full standard output: ended with 0" >> "$wrong"
say faults-streams
