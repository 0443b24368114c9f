#!/bin/sh
# Tests `vs --untrusted`: a model that tries every way to a file by every kind of path, to the environment,
# to programs and to directives of the formats. It must see nothing outside its folder; if strace is installed, no open,
# exec or connect may lead outside.
case limits/untrusted in *"$ONLY"*) ;; *) exit 0 ;; esac
. tests/report.sh
mkdir -p "$work/models/sub" "$work/out"
models=$work/models
echo '(define secret "SECRET-7") (display "SECRET-7")' > "$work/secret.vs"
ln -s ../secret.vs "$models/link.vs"
ln -s .. "$models/up"
ln -s /dev/zero "$models/zero"
ln -s /proc/self "$models/proc"
mkfifo "$models/fifo"
echo '(define inside "INSIDE-3")' > "$models/sub/inside.vs"
for f in tests/lang/lib/meshes/cube.off tests/lang/lib/pictures/grey8.png; do cp "$f" "$models/"; done

paths="/etc/passwd /etc/hostname ../secret.vs ./../secret.vs sub/../../secret.vs sub/../sub/inside.vs link.vs up/secret.vs zero proc/environ proc/fd/0 fifo /proc/self/environ /proc/self/maps
/dev/zero /dev/stdin //etc/passwd $work/secret.vs . / .. sub ~/.profile /sys/kernel/uevent_seqnum /tmp"
{
  for path in $paths; do
    for use in '(load "P")' "(eval '(include \"P\") (interaction-environment))" "(eval '(require \"P\") (interaction-environment))" '(display (read-line (open-input-file "P")))' '(display (file-exists? "P"))' \
      '(call-with-input-file "P" (lambda (p) (display (read-line p))))' '(with-input-from-file "P" read-line)' '(display (load-mesh "P"))' \
      '(display (make-height-field "P" (xyz 0 0 0) (xyz 1 1 0)))' '(sky #:image "P")' '(display (make-material #:image "P"))' '(lamp (xyz 0 0 9) #:ies "P")' '(make-text (xyz 0 0 0) 1 "a" #:font "P.ttf")' '(open-output-file "P")' '(delete-file "P")' \
      '(write (directory-files "P"))' '(display (file->string "P"))' '(display (load-csv "P"))' '(display (load-json "P"))' '(display (file->lines "P"))' '(write-json 1 "P")' '(write-xlsx "P" (list (list 1)))'; do
      printf '(guard (e (#t (display "refused "))) %s)\n' "$use" | sed "s|P\"|$path\"|; s|\"P.ttf|\"$path.ttf|"
    done
  done
  cat << 'MODEL'
(load "sub/inside.vs") (display inside)
(write (directory-files "sub"))
(display (volume (load-mesh "cube.off")))
(display (solid? (make-height-field "grey8.png" (xyz 0 0 0) (xyz 1 1 0) #:low -1)))
(display (list (get-environment-variable "HOME") (get-environment-variable "MARK") (get-environment-variables)))
(draw (native 'povray "#include \"/etc/passwd\" #write" #:otherwise (make-sphere (xyz 9 9 9) 1)))
(define bad '("a\"b" "a\nb" "]]>" "</script><script>alert(1)</script>" "#include \"/etc/passwd\"" "$(touch OWNED)" "`touch OWNED`" "-rf" "--version" "*/ }" "\\" "';" "%s%n" "<!--" "&lt;"))
(for-each (lambda (t i) (draw (layer t (with-material (make-material #:name t #:color "#336699") (make-box (xyz i 0 0) (xyz (+ i 1/2) 1 1)))))) bad (iota (length bad)))
MODEL
} > "$models/model.vs"

say() { if [ -s "$work/wrong" ]; then echo "not ok limits/untrusted-$1"; sed 's/^/    /' "$work/wrong" | head -n 12; else echo "ok limits/untrusted-$1"; fi; : > "$work/wrong"; }
: > "$work/wrong"
mkdir "$work/tmp"
run() { (cd "$work" && limited 60 env MARK=SECRET-8 TMPDIR="$work/tmp" "$@"); }

run "$BUILD/vs" --untrusted -q models/model.vs > "$work/said" 2> "$work/err" < /dev/null
status=$?
[ $status = 0 ] || { echo "ended with $status"; tail -n 5 "$work/err"; } >> "$work/wrong"
grep -a 'SECRET\|root:' "$work/said" "$work/err" >> "$work/wrong"
grep -q 'INSIDE-3("inside.vs")' "$work/said" || echo "did not read its own folder" >> "$work/wrong"
grep -a 'secret.vs\|"passwd"\|"uevent_seqnum"' "$work/said" >> "$work/wrong"
say reads

# trace MODEL: the files outside its folder that it opened or ran, and its connections
trace() {
  run strace -f -y -o "$work/trace" -e trace=%file,%network,%process "$BUILD/vs" --untrusted -q "$1" -o out/traced.stl > /dev/null 2>&1 < /dev/null
  [ -s "$work/trace" ] || echo "$1: nothing was traced"
  sed -n 's/.*open[a-z0-9]*(.* = [0-9]*<\(.*\)>$/\1/p' "$work/trace" | grep -v "^$work/models\|^$work/out\|^/usr/\|^/usr$\|^/dev/urandom\|^/lib\|^/etc/ld.so\|^/etc/localtime\|^/proc/[0-9]*/sched\|^/proc/[0-9]*/statm\|^/dev/null\|^/sys/devices/system/cpu" |
    sed "s|^|$1 opened |" | sort -u
  grep -a 'execve(' "$work/trace" | tail -n +2 | grep -v "$BUILD/vs"
  grep -a 'connect(\|sendto(\|socket(' "$work/trace"
}

if command -v strace >/dev/null 2>&1 && run strace -o /dev/null true 2>/dev/null; then
  trace models/model.vs >> "$work/wrong"
  say traced
  # its attempts as separate models, a hundred of them: an attempt that ends the program does not prevent another
  if [ -n "${LONG:-}" ]; then
    awk -v to="$models/hostile" 'END { for (i = 0; i < 100; i++) { f = to i ".vs"; for (k = i; k < NR; k += 100) print l[k] > f; print "(draw (make-sphere (xyz 0 0 0) 1))" > f; close(f) } } { l[NR - 1] = $0 }' "$models/model.vs"
    for i in $(seq 0 99); do trace "models/hostile$i.vs"; done >> "$work/wrong"
    rm -f "$models"/hostile*
    say traced-hundred
  fi
else
  echo "skip limits/untrusted-traced: no strace"
fi

# names and texts through every format: none becomes a directive, and the reader of each format reads the file
for suffix in pov scad x3d x3dv html stl obj ply off 3mf glb; do
  run "$BUILD/vs" --untrusted -q models/model.vs -o "out/a.$suffix" > /dev/null 2> "$work/err" < /dev/null || { echo "$suffix: ended with $?"; tail -n 3 "$work/err"; } >> "$work/wrong"
done
grep -a -n '^ *#include\|^ *#write' "$work/out/a.pov" | grep -v '"colors.inc"' >> "$work/wrong"
grep -a -n '<script>alert' "$work/out/a.html" "$work/out/a.x3d" >> "$work/wrong"
grep -a -n '^ *include\|^ *use <' "$work/out/a.scad" >> "$work/wrong"
grep -a -n '^\$(touch\|^-rf' "$work/out/a.obj" "$work/out/a.mtl" 2>/dev/null >> "$work/wrong"
if command -v xmllint >/dev/null 2>&1; then xmllint --noout "$work/out/a.x3d" >> "$work/wrong" 2>&1; fi
find "$work" -name OWNED >> "$work/wrong"
say texts

# with too few descriptors the message says so, and not that the model may not read a file
echo '(load "sub/inside.vs") (write (directory-files "sub")) (display (volume (load-mesh "cube.off")))' > "$models/few.vs"
ran=
for files in $(seq 4 24); do
  (ulimit -n $files; run "$BUILD/vs" --untrusted -q models/few.vs) > "$work/few" 2> "$work/err" < /dev/null
  status=$?
  grep -H "files of its own folder\|own folder and those in it" "$work/err" | sed "s/^/$files descriptors: /" >> "$work/wrong"
  if [ $status = 0 ]; then grep -q 'inside.vs' "$work/few" && ran=yes
  else grep -q 'Too many open files\|too many files\|error while loading\|cannot be confined\|cannot be prepared' "$work/err" || { echo "$files descriptors: ended with $status"; tail -n 2 "$work/err"; } >> "$work/wrong"; fi
done
[ "$ran" ] || echo "24 descriptors are not enough for any run" >> "$work/wrong"
say descriptors

if command -v povray >/dev/null 2>&1; then
  run "$BUILD/vs" --untrusted -q models/model.vs --size 32x24 --quality draft -o out/a.png > /dev/null 2> "$work/err" < /dev/null
  status=$?
  if grep -q Landlock "$work/err"; then echo "skip limits/untrusted-picture: no Landlock"
  else
    ls "$work/tmp" >> "$work/wrong" # nothing is left of the worker
    [ $status = 0 ] && [ -s "$work/out/a.png" ] || { echo "ended with $status"; tail -n 5 "$work/err"; } >> "$work/wrong"
    say picture
  fi
fi
