#!/bin/sh
# Tests that no output overwrites an input: a model that reads every kind of file writes every format and
# notation, and each command of the tables that writes a file runs, onto each of the input files and by every kind of
# name. So does each option that names an output, where one model, or the last run of several, reads the input. The
# exit code is 2, every file is unchanged, and no other output is written.
case limits/inputs in *"$ONLY"*) ;; *) exit 0 ;; esac
. tests/report.sh
root=$PWD
mkdir "$work/m"
cp tests/lang/lib/meshes/cube.obj "$work/m/mesh.obj"
cp tests/lang/lib/pictures/grey8.png "$work/m/land.png"
cp tests/lang/lib/pictures/colour.png "$work/m/look.png"
cp tests/lang/lib/pictures/rgba-zip.exr "$work/m/sky.exr"
cp tests/lang/lib/lamps/spot.ies "$work/m/lamp.ies"
cp /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf "$work/m/font.ttf"
cd "$work/m" || exit 1
echo '(define side 2)' > part.scm
printf 'x,y\n1,2\n' > data.csv
echo '{"a": 1}' > data.json
echo words > words.txt
: > empty.txt
cat > m.vs << 'MODEL'
(load "part.scm")
(define-parameter r 1)
(define rows (load-csv "data.csv"))
(define tree (load-json "data.json"))
(define words (string-append (file->string "words.txt") (file->string "empty.txt")))
(sky #:image "sky.exr")
(lamp (xyz 0 0 9) #:ies "lamp.ies")
(view "street" #:from (xyz 9 9 9) #:to (xyz 0 0 0))
(draw (unite (load-mesh "mesh.obj") (make-height-field "land.png" (xyz 0 0 0) (xyz side side 0)))
      (make-text (xyz 0 0 3) 1 "a" #:font "font.ttf")
      (with-material (make-material #:image "look.png") (make-box (xyz 5 0 0) (xyz 6 1 1))))
MODEL
inputs="m.vs part.scm data.csv data.json words.txt empty.txt sky.exr lamp.ies mesh.obj land.png font.ttf look.png"
cp m.vs land.vs # whose picture by default is land.png
mkdir plain; for f in $inputs; do cp "$f" plain/; done
if ! "$vs" -q m.vs -o ok.pov 2> "$work/err"; then
  { echo "the model fails"; cat "$work/err"; } > "$work/wrong"
  result limits/inputs "$work/wrong"
  exit
fi

refused() { # WHAT COMMAND...: must end with 2 (1 where the program itself writes), and leave all as it is; else all is restored
  what=$1; shift
  ls -A . sub > "$work/were" 2> /dev/null
  limited 60 "$@" > "$work/out" 2> "$work/err" < /dev/null
  code=$?
  case $what in call-*) want=1 ;; *) want=2 ;; esac
  [ $code = $want ] || { echo "$what: ended with $code"; tail -n 2 "$work/err"; } >> "$work/wrong"
  for f in $inputs; do cmp -s "$f" "plain/$f" || { echo "$what: $f is gone" >> "$work/wrong"; rm -f "$f"; cp "plain/$f" "$f"; }; done
  ls -A . sub 2> /dev/null | diff "$work/were" - | sed -n 's/^> //p' > "$work/made"
  while read -r made; do echo "$what: writes $made before it refuses"; rm -rf "./$made"; done < "$work/made" >> "$work/wrong"
}

# with LONG every format and notation onto every input; otherwise each onto the program and, in turn, one of the others
set -- $inputs
for format in $(sed -n 's/^VS_\(FORMAT\|NOTATION\)([a-z0-9]*, *[a-z0-9_]*, *"\([^"]*\)".*/\2/p' "$root/backends/backends.def"); do
  for f in m.vs $([ "$LONG" ] && echo $inputs || echo "$1"); do refused "--format $format -o $f" "$vs" -q m.vs --format "$format" -o "$f"; done
  refused "--untrusted --format $format -o $1" "$vs" --untrusted -q m.vs --format "$format" -o "$1"
  shift; [ $# -gt 0 ] || set -- $inputs
done
# by every kind of name; then none of several outputs is written
mkdir sub; ln m.vs hard.scad; ln -s m.vs soft.scad
for name in ./m.vs sub/../m.vs "$work/m/m.vs" hard.scad soft.scad; do refused "-o $name" "$vs" -q m.vs --format openscad -o "$name"; done
refused "two outputs" "$vs" -q m.vs -o first.scad -o soft.scad
[ -e first.scad ] && echo "two outputs: the first is written" >> "$work/wrong"
# a program may write to its own files through ports
"$vs" -q -e '(define (put x) (call-with-output-file "own.txt" (lambda (p) (write x p)))) (put 1) (display (file->string "own.txt")) (put 2)' > /dev/null || echo "a program cannot write a file that it has read" >> "$work/wrong"
echo 'cube(1);' > frame-001.scad
# a later frame reads what an earlier one has replaced: under its name, by a link, untrusted, as a picture that is read
# only when the page is written; the old file is back, and the frames before stay
echo '(define-parameter t 0.0) (when (> t 0) (load "part-001.scm")) (draw (make-box origin (xyz 1 1 (+ t 1))))' > later.vs
echo '(define-parameter t 0) (draw (if (> t 0) (with-material (make-material #:image "shot-002.png") (make-box origin (xyz 1 1 1))) (make-sphere origin 1)))' > paint.vs
later() { # WHAT INPUT COMMAND...
  what=$1 input=$2; shift 2
  limited 60 "$@" > "$work/out" 2> "$work/err" < /dev/null
  code=$?
  [ $code = 2 ] && grep -q "frame [23] reads this file" "$work/err" || { echo "$what: ended with $code"; tail -n 2 "$work/err"; } >> "$work/wrong"
  cmp -s "$input" "$work/kept" || echo "$what: $input is gone" >> "$work/wrong"
  for f in *.old-*; do [ ! -e "$f" ] || echo "$what: $f is left" >> "$work/wrong"; done
}
cp part.scm "$work/kept"; cp part.scm part-001.scm; cp part.scm before.scm; ln -s before.scm link-001.scm
later "a later frame" part-001.scm "$vs" -q later.vs --frames 3 --format openscad -o part.scm
later "a later frame, untrusted" part-001.scm "$vs" --untrusted -q later.vs --frames 3 --format openscad -o part.scm
sed 's/part-001/before/' later.vs > link.vs
later "a later frame, by a link" before.scm "$vs" -q link.vs --frames 2 --format openscad -o link.scm
cp look.png "$work/kept"; cp look.png shot-002.png
later "a later frame, its picture" shot-002.png "$vs" -q paint.vs --frames 4,t=-1..2 --format povray -o shot.png
rm -f part-00?.scm link-00?.scm before.scm shot-00?.png
"$vs" -q later.vs --frames 2 --format openscad -o part.scm 2> /dev/null; [ -s part-001.scm ] || echo "a frame cannot read what this run has made" >> "$work/wrong"
rm -f part-00?.scm
refused "frames" "$vs" -q -e '(define-parameter t 0) (draw (make-box origin (xyz 1 1 (+ t 1)))) (load "frame-001.scad")' --frames 1 -o frame.scad
# every command of the table
cp sky.exr a.exr
for command in $(sed -n 's/^COMMAND(\([a-z]*\),.*/\1/p' "$root/cli/commands.def"); do
  case $command in
  help|ast|check|params|test|view|pick|lsp) ;; # write no file
  profile) printf '<svg/>' > calls.svg; echo '(file->string "calls.svg")' > calls.vs; cp calls.svg calls.vs plain/; inputs="$inputs calls.svg"
    refused profile "$vs" profile calls.vs -o calls.svg; inputs=${inputs% calls.svg} ;;
  jupyter) ;; # writes the description of a kernel only
  jobs) ;; # it runs vs sweep and vs render, which refuse
  search) ;; # it writes no file
  new|add) ;; # new replaces nothing, add only its own packages: the suite desk tests it
  mcp) ;; # it exports as vs FILE does: the suite mcp tests that no program is replaced
  format) ;; # its output is its input: the suite format tests that nothing is lost
  doc) ln -s ../m.js sub/index.html; echo 'box(point(0,0,0), 1, 1, 1);' > m.js; cp m.js plain.js
    "$vs" doc m.js -o sub > /dev/null 2>&1; [ $? = 2 ] && cmp -s m.js plain.js || echo "doc: replaces the program" >> "$work/wrong" ;;
  cure) # the drawing before and the one after: neither is written if the model reads either
    for own in before after; do
      cp words.txt cured-$own.svg; cp words.txt plain/cured-$own.svg; inputs="$inputs cured-$own.svg"
      echo "(import (visualscheme) (visualscheme building)) (define-parameter r 1.0 #:min 0 #:max 9) (file->string \"cured-$own.svg\") (require-that \"large\" (> r 5)) (draw (make-sphere origin r))" > rule.vs
      refused "cure $own" "$vs" cure rule.vs -o cured.svg
      inputs=${inputs% cured-$own.svg}; rm cured-$own.svg
    done ;;
  diff) cp m.vs n.vs; refused diff "$vs" diff m.vs n.vs --format openscad -o m.vs; refused diff "$vs" diff m.vs n.vs -o mesh.obj ;;
  translate) echo '(load "part.scm") (draw (make-box (xyz 0 0 0) side side side))' > t.vs; cp t.vs plain/
    inputs="$inputs t.vs"
    for to in openscad javascript povray; do for f in t.vs part.scm; do refused "translate --to $to -o $f" "$vs" translate t.vs --to $to -o "$f"; done; done
    inputs=${inputs% t.vs} ;;
  fit) printf 'ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n' > scan.ply
    echo '(define-parameter w 1.1) (draw (make-box (xyz 0 0 0) (xyz w 1 1)))' > fit.vs; cp scan.ply plain.ply
    "$vs" fit fit.vs scan.ply --placed -o scan.ply > /dev/null 2>&1; [ $? = 2 ] && cmp -s scan.ply plain.ply || echo "fit: replaces the scan" >> "$work/wrong" ;;
  render)
    refused "render by default" "$vs" render land.vs
    for f in land.png look.png; do refused "render -o $f" "$vs" render m.vs -o $f; done
    refused "render --untrusted" "$vs" render --untrusted land.vs
    # a model of the batch reads the picture of another, or the film: nothing is written
    echo '(draw (make-sphere origin 1))' > one.vs
    echo '(file->string "one.png") (draw (make-sphere origin 2))' > two.vs
    echo '(define-parameter t 0) (file->string "film.mp4") (draw (make-sphere origin (+ 1 t)))' > film.vs
    for own in one.png film.mp4; do cp words.txt $own; cp words.txt plain/; cp words.txt plain/$own; done
    inputs="$inputs one.png film.mp4"
    for order in "one.vs two.vs" "two.vs one.vs"; do refused "render $order" "$vs" render $order --size 20x15 --quality draft; done
    refused "render one.vs --jobs 4 two.vs" "$vs" render one.vs two.vs --jobs 4 --size 20x15 --quality draft
    refused "render --film" "$vs" render film.vs --frames 2 --film 25 --size 20x15 --quality draft -o film.png
    for made in two.png film-001.png film-1.png film.manifest.json; do [ -e $made ] && echo "render: $made is written, though another output is refused" >> "$work/wrong"; done
    inputs=${inputs% one.png film.mp4}
    # every option of the table that names an output: one model or the last run of several reads the file
    echo '(define-parameter k 1) (when (= k 2) (load "m.vs")) (draw (make-sphere origin k))' > last.vs
    set -- $inputs
    for option in $(sed -n 's/^OPTION([^,]*, "\([a-z-]*\)", VALUE_REQUIRED, "\(OUT\|FILE\)",$/\1/p' "$root/cli/options.def"); do
      for runs in m.vs "m.vs --all-views" "one.vs m.vs" "m.vs one.vs --jobs 4" "last.vs --set k=1 --set k=2" "last.vs --frames 2,k=1..2"; do
        for f in $([ "$LONG" ] && echo $inputs || echo "$1"); do
          case $option in
          output) [ "$runs" != m.vs ] || refused "render -o $f" "$vs" render m.vs -o "$f" ;; # others number their pictures
          *) mkdir made; refused "render $runs --$option $f" "$vs" render $runs --size 20x15 --quality draft -o made --$option "$f"
            [ -z "$(ls made)" ] || echo "render $runs --$option $f: writes $(ls made | tr '\n' ' ') before it refuses" >> "$work/wrong"
            rm -r made ;;
          esac
        done
        shift; [ $# -gt 0 ] || set -- $inputs
      done
    done ;;
  sweep)
    # the table and the sheet, of an empty folder and of one that holds the read file under the name of any output
    for f in m.vs data.csv; do refused "sweep -o $f" "$vs" sweep m.vs --set r=1,2 -o "./$f.csv" --sheet "$f"; done
    ln -f data.csv own.csv; refused "sweep -o own.csv" "$vs" sweep m.vs --set r=1,2 -o own.csv; rm own.csv
    printf 'r\n1\n' > sets.csv; cp sets.csv plain/; inputs="$inputs sets.csv"
    refused "sweep -o sets.csv" "$vs" sweep m.vs --set sets.csv -o sets.csv
    inputs=${inputs% sets.csv}
    echo '(define-parameter k 1) (when (= k 2) (file->string "into/OWN")) (draw (make-sphere origin k))' > of.vs
    for own in results.csv index.html manifest.jsonl of-k=1.off of-k=2.off; do
      rm -rf into; mkdir into; cp words.txt into/$own; sed -i "s|into/[^\"]*|into/$own|" of.vs
      for more in '' '--only 2'; do
        case "$own $more" in 'results.csv --only 2'|'index.html --only 2'|'of-k=1.off --only 2') continue ;; esac # not written
        [ "$own $more" != 'manifest.jsonl --only 2' ] || mv into/manifest.jsonl into/manifest-2..2.jsonl
        [ "$own $more" != 'manifest.jsonl --only 2' ] || sed -i 's|into/manifest.jsonl|into/manifest-2..2.jsonl|' of.vs
        held=$(cat into/* | cksum)
        "$vs" sweep of.vs --set k=1,2 -q $more --format off -o into > "$work/out" 2> "$work/err"; code=$?
        [ $code = 2 ] && [ "$(cat into/* | cksum)" = "$held" ] || { echo "sweep: into/$own $more: ended with $code, has $(ls into | tr '\n' ' ')"; tail -n 2 "$work/err"; } >> "$work/wrong"
      done
    done
    rm -rf into ;;
  tone|falsecolor) ln -sf a.exr p.png; cp a.exr plain.exr
    "$vs" $command a.exr -o p.png > /dev/null 2>&1; [ $? = 2 ] && cmp -s a.exr plain.exr || echo "$command: replaces the picture" >> "$work/wrong" ;;
  compare) ln -sf a.exr p.png; cp a.exr b.exr
    "$vs" compare a.exr b.exr -o p.png > /dev/null 2>&1; [ $? = 2 ] && cmp -s a.exr b.exr || echo "compare: replaces the picture" >> "$work/wrong" ;;
  denoise) cp a.exr plain.exr
    "$vs" denoise a.exr -o a.exr > /dev/null 2>&1; [ $? = 2 ] && cmp -s a.exr plain.exr || echo "denoise: replaces the picture" >> "$work/wrong" ;;
  sunstudy) # onto each of the names that a study has, as one shows that is refused nothing
    echo '(draw (make-box origin (xyz 1 1 1)))' > plain.vs
    "$vs" sunstudy -q plain.vs --place 38,-9 --date 2026-06-21 --from 12 --to 13 --size 16x12 --quality draft -o study
    for name in $(ls study); do
      rm -rf study; mkdir study; ln -s ../data.csv "study/$name"
      refused "sunstudy $name" "$vs" sunstudy m.vs --place 38,-9 --date 2026-06-21 --from 12 --to 13 --size 16x12 --quality draft -o study
      [ "$(ls study)" = "$name" ] || echo "sunstudy $name: writes $(ls study | tr '\n' ' ') before it refuses" >> "$work/wrong"
    done ;;
  *) echo "$command: this test does not know it" >> "$work/wrong" ;;
  esac
done
result limits/inputs "$work/wrong"
