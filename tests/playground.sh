#!/bin/sh
# Tests the playground, which `make playground` makes: the program in node (playground/node.mjs), and the page in
# Chromium (playground/page.mjs). PLAYGROUND: its folder.
case playground in *"${ONLY%%/*}"*) ;; *) exit 0 ;; esac
made=${PLAYGROUND:-$PWD/build/playground}
command -v node > /dev/null || { echo "skip playground: no node (package nodejs)"; exit 0; }
[ -f "$made/engine.wasm" ] || { echo "skip playground: it is not built (make playground)"; exit 0; }
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
timeout 3000 node tests/playground/node.mjs "$BUILD/vs" "$made" "$work" ${LONG:+all} || echo "not ok playground/node: ended with $?"
if command -v chromium > /dev/null && [ -d tests/node_modules/playwright-core ]; then
  timeout 1500 node tests/playground/page.mjs "$made" "$work/page" || echo "not ok playground/page: ended with $?"
else
  echo "skip playground/page: no chromium (package chromium) or no playwright-core (npm ci --prefix tests --ignore-scripts)"
fi
