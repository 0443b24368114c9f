#!/bin/sh
# Tests the ending the command by signals: SIGTERM and SIGHUP end it in order, with 130, and leave no incomplete
# file and no POV-Ray. (The prompt's test covers SIGINT: a script's background jobs ignore it.)
. tests/report.sh
wanted signals || exit 0
mkdir "$work/tmp"
export TMPDIR="$work/tmp"
model='(for-each (lambda (i) (draw (make-sphere (xyz (* 3 i) 0 0) 1))) (iota 20000))'

# Waits up to ten seconds for a command to succeed.
await() { for i in $(seq 200); do "$@" && return; sleep 0.05; done; return 1; }
begun() { ls -l "/proc/$process/fd" 2>/dev/null | grep -q "$work/[#o]"; } # an output has no name until it is whole
has_child() { child=$(pgrep -P "$process"); [ -n "$child" ]; }
gone() { ! kill -0 "$child" 2>/dev/null; }

# name, the exit code; the folders may contain nothing but the messages
judge() {
  left=$(ls -A "$work/tmp"; ls -A "$work" | grep -v '^tmp$\|^messages$')
  if [ "$2" = 130 ] && [ -z "$left" ]; then echo "ok signals:$1"
  else echo "not ok signals:$1: ended with $2, leaving: $left"; sed 's/^/    /' "$work/messages"; fi
  rm -rf "$work"/out*
}

# The command handles TERM and HUP: bits 14 and 0 of the caught signals. On a busy machine half a second may not be
# enough.
listens() { caught=$(sed -n 's/^SigCgt:[^0-9a-f]*//p' "/proc/$process/status" 2>/dev/null); [ -n "$caught" ] && [ $((0x$caught & 0x4001)) = $((0x4001)) ]; }
up() { if [ -d /proc/self ]; then await listens; fi; sleep 0.5; }

# A caller may ignore them (nohup does), and the shell cannot undo this: env can.
heard="env --default-signal=TERM,HUP"
for signal in TERM HUP; do
  $heard "$BUILD/vs" -q -e '(let loop () (loop))' > "$work/messages" 2>&1 & process=$!
  up; kill -$signal $process; wait $process
  judge "$signal while it evaluates" $?

  sleep 20 | $heard "$BUILD/vs" -q > "$work/messages" 2>&1 & process=$!
  up; kill -$signal $process; wait $process
  judge "$signal while it waits for input" $?

  $heard "$BUILD/vs" -q -e "$model" -o "$work/out.stl" > "$work/messages" 2>&1 & process=$!
  await begun; kill -$signal $process; wait $process
  judge "$signal while it writes" $?

  if ! command -v povray >/dev/null 2>&1 || ! command -v pgrep >/dev/null 2>&1; then echo "skip signals:$signal while POV-Ray runs: no povray or no pgrep"; continue; fi
  $heard "$BUILD/vs" -q examples/gare-do-oriente.vs -o "$work/out.png" > "$work/messages" 2>&1 & process=$!
  await has_child; kill -$signal $process; wait $process
  judge "$signal while POV-Ray runs" $?
  if await gone; then echo "ok signals:POV-Ray is gone after $signal"; else echo "not ok signals:POV-Ray outlives $signal"; kill "$child"; fi
done

# A batch frees no memory after an interrupt, and every phase polls: drawings of a million nodes, by processor time.
if ! command -v python3 > /dev/null; then echo "skip signals:millions: no python3"
elif [ -z "${LONG:-}" ]; then
  python3 tests/interrupted.py "$BUILD/vs" 20000 1 > "$work/messages" 2>&1 && : > "$work/messages"
  result "signals:thousands of nodes" "$work/messages"
else
  python3 tests/interrupted.py "$BUILD/vs" 1000000 3 > "$work/messages" 2>&1 && : > "$work/messages"
  result "signals:millions of nodes" "$work/messages"
fi
