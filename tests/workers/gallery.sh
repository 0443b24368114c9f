# Tests the gallery: a page with a picture and a caption for each requested example, and a report of failures.
. tests/report.sh

wanted gallery || exit 0
command -v povray > /dev/null || { echo "skip gallery: no povray (package povray)"; exit 0; }
: > "$work/why"
mkdir -p "$work/build" && ln -s "$vs" "$work/build/vs"
EXAMPLES="vase arcade" QUALITY=draft SIZE=80x60 sh scripts/gallery.sh "$work/build" > "$work/said" 2>&1 || cat "$work/said" >> "$work/why"
grep -q '<img src="vase.png" alt="vase">.*A marble vase on a plinth\. <small>vase.vs' "$work/build/gallery/index.html" || echo "no vase on the page" >> "$work/why"
[ "$(grep -c '<figure>' "$work/build/gallery/index.html")" = 2 ] || echo "not two pictures" >> "$work/why"
"$BUILD/tools/pngstat" "$work/build/gallery/arcade.png" 2>&1 | awk '!($1 == 80 && $2 == 60 && $3 > 20) { print "arcade: " $0 }' >> "$work/why"
EXAMPLES="no-such-example" sh scripts/gallery.sh "$work/build" > /dev/null 2> "$work/said" && echo "a missing example is no failure" >> "$work/why"
grep -q no-such-example "$work/said" || echo "nothing is said of a missing example" >> "$work/why"
result gallery "$work/why"
