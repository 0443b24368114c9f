// Owns the test of the search in the manual's pages, with the delivered script in a page that contains only its box and
// its list: node search.mjs PAGES
import { readFileSync } from "node:fs";
import { runInNewContext } from "node:vm";

const pages = process.argv[2];
const element = () => ({ children: [], listeners: {}, value: "", append(...c) { this.children.push(...c); }, replaceChildren() { this.children = []; },
  addEventListener(name, f) { this.listeners[name] = f; }, querySelector() { return null; } });
const parts = { search: element(), found: element() };
const document = { currentScript: { dataset: { root: "" } }, getElementById: (id) => parts[id], createElement: element, addEventListener() {} };
const index = readFileSync(`${pages}/index.js`, "utf8");
runInNewContext(`${index}\n${readFileSync(`${pages}/search.js`, "utf8")}`, { document, location: { search: "" }, URLSearchParams });

const find = (words) => {
  parts.search.value = words;
  parts.search.listeners.input();
  return parts.found.children.filter((c) => c.children.length).map((c) => c.children[0].href);
};
for (const [words, wanted] of [["do-sweep", "language/objects.html#do-sweep"], ["roof", "building.html#roof-outline-pitch-gables-overhang-mansard-dormers-thickness"], ["openscad", "coming-from-openscad.html"],
  ["sphere", "primitives/sphere.html#sphere"], ["random seed", "language/numbers.html"]]) {
  const [first = ""] = find(words);
  console.log(first.startsWith(wanted) ? `ok manual:search:${words}` : `not ok manual:search:${words}: first is ${first}`);
}
const arches = find("arch").slice(0, 2);
console.log(arches.length && !arches.some((a) => a.includes("search")) ? "ok manual:search:words" : `not ok manual:search:words: ${arches}`);
console.log(find("xyzzy").length === 0 ? "ok manual:search:nothing" : "not ok manual:search:nothing");
const rows = runInNewContext(`${index}; manual`, {}), texts = {};
const lost = rows.map((r) => r[2]).filter((address) => {
  const [file, id] = address.split("#");
  return !(texts[file] ??= readFileSync(`${pages}/${file}`, "utf8")).includes(` id="${id}"`);
});
console.log(rows.length > 300 && !lost.length ? "ok manual:search:addresses" : `not ok manual:search:addresses: ${rows.length} rows, lost ${lost.slice(0, 5)}`);
