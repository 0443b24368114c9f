# Tests that a scene cannot break out: POV-Ray, which gets text of the program (native), writes files only in
# its private folder and opens no socket; and 10,000 random strings, as names of materials and layers, as texts and as
# text of a file, never become directives of a scene.
. tests/report.sh

wanted escape || exit 0
command -v povray > /dev/null || { echo "skip escape: no povray (package povray)"; exit 0; }

: > "$work/why"
for name in "$work/ESCAPED" /tmp/visualscheme-escaped; do
  printf '(draw (native (quote povray) "#fopen F \\"%s\\" write\\n#write(F, \\"x\\")\\n#fclose F\\nsphere { 0, 1 }" #:otherwise (make-sphere origin 1)))\n' "$name" > "$work/escape.vs"
  "$vs" -q "$work/escape.vs" -o "$work/escape.png" --size 40x30 --quality draft > /dev/null 2> "$work/err"
  status=$?
  if [ -e "$name" ]; then
    rm -f "$name"
    # a kernel without Landlock prevents no writing
    if grep -qs landlock /sys/kernel/security/lsm; then echo "$name was written" >> "$work/why"; else echo "skip escape:files: no Landlock"; break; fi
  else
    [ $status = 3 ] || echo "ended with $status" >> "$work/why"
    grep -q 'escape.vs:1:7: POV-Ray: Cannot open user file' "$work/err" || { echo "said:"; cat "$work/err"; } >> "$work/why"
  fi
done
result escape:files "$work/why"

: > "$work/why"
if command -v strace > /dev/null && strace -o /dev/null true 2> /dev/null; then
  echo '(draw (make-sphere origin 1))' > "$work/ball.vs"
  strace -f -o "$work/trace" -e trace=socket,connect "$vs" -q "$work/ball.vs" -o "$work/ball.png" --size 40x30 --quality draft 2>> "$work/why"
  grep -a 'socket(.*= [0-9]' "$work/trace" >> "$work/why"
  result escape:network "$work/why"
fi

# Words of POV-Ray, quotes, comments and bytes of all kinds, combined at random; without its strings and comments, the
# scene's text has exactly the words of the same scene with plain names.
: > "$work/why"
for names in plain strange; do
  cat > "$work/$names.vs" << PROGRAM
(define seed 20260621)
(define (chance n) (set! seed (modulo (+ (* 1103515245 seed) 12345) 2147483648)) (modulo (quotient seed 1000) n))
(define pieces (vector "\"" "\\\\" "\n" "\r" "\t" "*/" "/*" "//" "#include \"/etc/passwd\"" "#write(F, 1)" "#end" "#macro X()" "#declare A = 1;" "}" "{" "union {" ";" "'" "\`" "\$(id)" "%s%n" "é" "\x2028;" "\x7f;" "\x1;" "</script>" "]]>" "global_settings" "+O/tmp/x" "-rf" " " "a" "Z9" "_" "<1,2>" "::" "&quot;"))
(define (word) (apply string-append (for/list ((i (+ 1 (chance 6)))) (vector-ref pieces (chance (vector-length pieces))))))
(define (name i) (let ((w (word))) (if (string=? "$names" "plain") "plain" w)))
(draw (for/list ((i 5000)) (layer (name i) (with-material (make-material #:name (name i) #:color (list (/ (modulo i 50) 50) 0.5 0.5)) (make-box (xyz i 0 0) (xyz (+ i 1/2) 1 1))))))
(draw (for/list ((i 1000)) (make-text (xyz (* 4 i) 5 0) 1 (string-append "t" (name i)))))
(for ((i 1000)) (label (xyz (* 4 i) 8 0) (name i)))
PROGRAM
  file=$work/$names; [ $names = plain ] || file="$work/#include \"a\" } strange"
  [ $names = plain ] || mv "$work/strange.vs" "$file.vs"
  "$vs" -q "$file.vs" -o "$work/$names.pov" -o "$work/$names.svg" -o "$work/$names.x3d" 2>> "$work/why"
  command -v xmllint > /dev/null || continue
  xmllint --huge --noout "$work/$names.svg" "$work/$names.x3d" > "$work/said" 2>&1 || head -n 3 "$work/said" >> "$work/why"
  # Strings first, since a // within a string begins no comment; then comments; then the words and signs, of names of
  # materials the number alone
  sed 's/"\(\\.\|[^"\\]\)*"/STRING/g; s,//.*,,; s,/\*[^*]*\*/,,g' "$work/$names.pov" | sed 's/\bM\([0-9]*\)_*[A-Za-z0-9_]*\b/M\1/g' | grep -o '#*[A-Za-z_][A-Za-z0-9_]*\|[{}"#]' | sort | uniq -c | sort -k2 |
    grep -v ' [MT][0-9]*$' > "$work/$names.words"
done
[ "$(grep -c 'box {' "$work/strange.pov")" = 5000 ] || echo "the scene has not its 5000 boxes" >> "$work/why"
cut -c9- "$work/plain.words" > "$work/plain.set"; cut -c9- "$work/strange.words" > "$work/strange.set"
diff "$work/plain.set" "$work/strange.set" >> "$work/why"
"$vs" -q "$file.vs" -o "$work/strange.png" --size 60x40 --quality draft 2>> "$work/why" || echo "POV-Ray does not take the scene" >> "$work/why"
result escape:names "$work/why"

# Random names of models' files and of outputs, from the same pieces: the scene differs only in the letters of its
# title, and no other files appear.
: > "$work/why"
mkdir -p "$work/files" && (
  cd "$work/files" || exit 1
  awk 'BEGIN { srand(20260621); n = split("\"|#include \"a\"|}|{|;|\x27|`|$(touch x)|%s%n|é|*~+O~|-rf|--|+I|union {|#end|\t|&quot;|<1,2>|a b|.pov|", pieces, "|")
    for (i = 0; i < 60; i++) { name = "m" i; for (k = 0; k < 5; k++) name = name pieces[1 + int(rand() * n)]; print name } }' > ../file-names
  echo '(draw (make-box origin (xyz 1 1 1)))' > plain.vs && "$vs" -q plain.vs -o plain.pov && tail -n +2 plain.pov > ../plain-scene
  while IFS= read -r name; do
    cp plain.vs "$name.vs" && "$vs" -q "$name.vs" -o "$name.pov" || echo "not made: $name"
    tail -n +2 "$name.pov" | cmp -s - ../plain-scene || { echo "another scene: $name"; head -n 2 "$name.pov"; }
    head -n 1 "$name.pov" | grep -q '^// [^#{}"]*$' || { echo "a title with signs:"; head -n 1 "$name.pov"; }
  done < ../file-names
  name=$(sed -n 7p ../file-names); "$vs" -q "$name.vs" -o "$name.png" --size 40x30 --quality draft || echo "no picture: $name"
  [ "$(ls -A | wc -l)" = 123 ] || { echo "files: "; ls -A | head -n 20; }
) >> "$work/why" 2>&1
result escape:file-names "$work/why"
