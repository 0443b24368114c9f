#!/bin/sh
# Makes the gallery: a picture of every example on one page, BUILD/gallery/index.html. `sh scripts/gallery.sh BUILD`; in
# its environment QUALITY (good), SIZE (960x720), EXAMPLES (names; all of them), JOBS (the number of pictures at a time;
# default: the number of cores). It keeps pictures whose scenes have not changed; it reports failures, and the exit code
# is then 1.
set -u
build=$1 quality=${QUALITY:-good} size=${SIZE:-960x720}
folder=$build/gallery
mkdir -p "$folder" || exit 2
page=$folder/index.html.new
escape() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }
cat > "$page" <<END
<!doctype html><html lang="en"><meta charset="utf-8"><title>VisualScheme: gallery</title>
<style>body { margin: 2em; font: 16px/1.4 sans-serif; background: #f4f4f2; color: #222; display: grid;
  grid-template-columns: repeat(auto-fill, minmax(24em, 1fr)); gap: 2em } h1 { grid-column: 1 / -1; margin: 0 }
  figure { margin: 0 } img { width: 100%; display: block } figcaption { padding: .5em 0 } small { color: #666 }</style>
<h1>Gallery</h1>
END
# POV-Ray traces with a thread for each core, but meshes and scenes before it use a single one: therefore several
# pictures are made at a time
models=""
for model in ${EXAMPLES:-$(ls examples/*.vs | sed 's|examples/||; s|\.vs$||')}; do models="$models examples/$model.vs"; done
# shellcheck disable=SC2086
"$build/vs" render $models -o "$folder/" --quality "$quality" --size "$size" --jobs "${JOBS:-$(nproc)}" --manifest "$folder/manifest.json"
status=$?
for path in $models; do
  model=$(basename "$path" .vs)
  [ -f "$folder/$model.png" ] || continue
  # the caption is the first sentence of the model's first comment
  caption=$(sed -n '/^;/!q; s/^;* *//p' "$path" | tr '\n' ' ' | sed 's/\. .*/./' | escape)
  printf '<figure><a href="%s.png"><img src="%s.png" alt="%s"></a><figcaption>%s <small>%s.vs</small></figcaption></figure>\n' \
    "$model" "$model" "$model" "$caption" "$model" >> "$page"
done
echo '</html>' >> "$page"
mv "$page" "$folder/index.html" && echo "  $folder/index.html"
[ "$status" = 0 ] || exit 1
