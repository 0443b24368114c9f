#!/bin/sh
# Packs the extension for Visual Studio Code: vscode.sh BUILD VERSION makes BUILD/visualscheme-VERSION.vsix. esbuild joins the
# extension and the client of language servers in one file, and vsce packs it. Both come from npm: make check fetches them.
build=$1 version=$2
fail() { echo "vscode: $1" >&2; exit 1; }
[ -x node_modules/.bin/esbuild ] || fail "there is no esbuild in node_modules: make demo fetches it"
[ -d tests/node_modules/vscode-languageclient ] || fail "there is no vscode-languageclient in tests/node_modules: make test fetches it"
[ -f tests/node_modules/@vscode/vsce/vsce ] || fail "there is no vsce in tests/node_modules: make check fetches it"
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT || exit 1
mkdir -p "$build" && cp -r editors/vscode "$work/visualscheme" && cp LICENSE "$work/visualscheme/" || fail "the files cannot be copied"
rm -rf "$work/visualscheme/node_modules"
NODE_PATH=tests/node_modules node_modules/.bin/esbuild editors/vscode/extension.js --bundle --platform=node --target=node18 --external:vscode \
  --metafile="$work/parts.json" --log-level=warning --outfile="$work/visualscheme/extension.js" --allow-overwrite || fail "esbuild failed"
# The licences of the packages that are in the file.
node -e 'const fs = require("fs"), [of, folder] = process.argv.slice(1);
const names = new Set(Object.keys(JSON.parse(fs.readFileSync(of)).inputs).map((p) => (p.match(/.*node_modules\/((?:@[^/]+\/)?[^/]+)/) || [])[0]).filter(Boolean));
for (const name of names) {
  const licence = fs.readdirSync(name).find((f) => /^licen[cs]e/i.test(f));
  if (!licence) throw new Error(`${name} has no licence`);
  fs.appendFileSync(`${folder}/LICENSE`, `\n---- ${name.replace(/.*node_modules\//, "")} ----\n\n${fs.readFileSync(`${name}/${licence}`, "utf8")}`);
}' "$work/parts.json" "$work/visualscheme" || fail "the licences cannot be collected"
vsix=$(cd "$build" && pwd)/visualscheme-$version.vsix
(cd "$work/visualscheme" && node "$OLDPWD/tests/node_modules/@vscode/vsce/vsce" package "$version" --no-update-package-json --no-git-tag-version --no-dependencies --allow-missing-repository \
  --no-rewrite-relative-links --out "$vsix") > "$work/log" 2>&1 || { cat "$work/log" >&2; fail "vsce failed"; }
echo "$build/visualscheme-$version.vsix"
