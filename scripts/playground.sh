#!/bin/sh
# Puts the playground together: `sh scripts/playground.sh BUILD`. BUILD/playground is a folder of static files for any
# web server: the page, the program in WebAssembly, the examples and the fonts. index.html opens without a server, too:
# it then takes all from offline.js, because a page from a file may not fetch.
set -eu
cd "$(dirname "$0")/.."
build=$1
to=$build/playground made=$build/wasm
rm -rf "$to.new"
mkdir -p "$to.new/files/model/examples" "$to.new/files/usr/share/fonts/truetype"
# The live view's page, with the files of this folder and a manifest for installing.
sed -e 's|href="/live.css"|href="playground.css"|; s|src="/live.js" nonce="@nonce@"|src="playground.js"|; s|The live view needs|The playground needs|' \
  -e '/rel="icon"/a <link rel="manifest" href="manifest.webmanifest">' backends/page/live/live.html > "$to.new/index.html"
for file in worker.js element.js service.js manifest.webmanifest; do cp "live/playground/page/$file" "$to.new/"; done
cp "$made/engine.js" "$made/engine.wasm" "$made/playground.js" "$to.new/"
cat "$made/live.css" live/playground/page/playground.css > "$to.new/playground.css"
cp -r examples/. "$to.new/files/model/examples/"
fonts=/usr/share/fonts/truetype/dejavu
[ ! -d "$fonts" ] || { mkdir -p "$to.new/files$fonts" && cp "$fonts"/*.ttf "$to.new/files$fonts/"; }
(cd "$to.new/files" && find . -type f | sed 's|^\./||' | LC_ALL=C sort |
  awk 'BEGIN { print "[" } { printf "%s\"%s\"", (NR > 1 ? ",\n" : ""), $0 } END { print "\n]" }') > "$to.new/files.json"
node live/playground/offline.mjs "$to.new" > "$to.new/offline.js"
rm -rf "$to"
mv "$to.new" "$to"
echo "  page  $to/index.html: the program has $(gzip -9 -c "$to/engine.wasm" | wc -c) bytes compressed, the page $(cat "$to/playground.js" "$to/playground.css" "$to/engine.js" | gzip -9 -c | wc -c)"
