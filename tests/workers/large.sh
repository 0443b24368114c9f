# Tests large pictures: above 128 MB POV-Ray would by itself keep its picture in a file outside its private
# folder, where it may not write. 4K; with LONG=1 also A1 at 300 dots per inch.
. tests/report.sh
command -v povray > /dev/null || { echo "skip large: no povray (package povray)"; exit 0; }

pixels() { od -An -tu1 -j16 -N8 "$1" | awk '{ print 16777216*$1+65536*$2+256*$3+$4 "x" 16777216*$5+65536*$6+256*$7+$8 }'; }

draw() { # NAME SIZE [PATH]
  wanted "large/$1" || return
  PATH=${3:-}$PATH "$vs" -q -e '(ground) (draw (make-sphere (xyz 0 0 1) 1))' --quality draft --size "$2" -o "$work/a.png" \
    > "$work/why" 2>&1 || echo "ended with $?" >> "$work/why"
  [ "$(pixels "$work/a.png")" = "$2" ] || echo "the picture has $(pixels "$work/a.png") pixels" >> "$work/why"
  "$tools/pngstat" "$work/a.png" > "$work/stat" 2>&1 || cat "$work/stat" >> "$work/why"
  result "large/$1" "$work/why"
}

for size in 3840x2160 ${LONG:+9933x7016}; do draw "$size" "$size"; done
# a machine without the memory for the picture: POV-Ray keeps it in a file, without the option +MI
mkdir "$work/bin"
cat > "$work/bin/povray" <<X
#!/bin/sh
for a; do shift; case \$a in +MI*) ;; *) set -- "\$@" "\$a" ;; esac; done
exec $(command -v povray) "\$@"
X
chmod +x "$work/bin/povray"
draw in-a-file 3200x2400 "$work/bin:"
