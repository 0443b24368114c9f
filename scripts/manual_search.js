/* Implements the search of the manual's pages. index.js, made with the pages, holds `manual`: [heading, page's title, address, text] for each section. Nothing is
 * fetched, so that it works from a folder. All words must occur; headings that are or begin with what was typed come first, and what only has it within a
 * word, as "search" has "arch", last. */
(() => {
  const root = document.currentScript.dataset.root, box = document.getElementById("search"), list = document.getElementById("found");
  const sections = manual.map(([heading, page, address, text]) => ({ heading, page, address, text, name: heading.toLowerCase(), all: (heading + " " + page + " " + text).toLowerCase() }));
  const named = (s, typed) => s.name.replace(/[(),]/g, " ").split(/\s+/).includes(typed);

  // Returns true if a word of the text begins with w.
  function begins(text, w) {
    for (let i = text.indexOf(w); i >= 0; i = text.indexOf(w, i + 1)) if (!i || !/[\p{L}\p{N}]/u.test(text[i - 1])) return true;
    return false;
  }

  function rank(s, typed, words) {
    if (!words.every((w) => s.all.includes(w))) return 0;
    if (s.name === typed || named(s, typed)) return 6;
    if (words.every((w) => named(s, w))) return 5;
    if (s.name.startsWith(typed) || s.name.startsWith("(" + typed)) return 4;
    if (words.every((w) => begins(s.name, w))) return 3;
    return words.every((w) => begins(s.all, w)) ? 2 : 1;
  }

  function snippet(s, words) {
    const at = Math.max(0, Math.min(...words.map((w) => s.text.toLowerCase().indexOf(w)).filter((i) => i >= 0), s.text.length) - 40);
    return (at < s.text.length && at ? "\u2026" : "") + s.text.slice(at < s.text.length ? at : 0).slice(0, 140);
  }

  function show() {
    const typed = box.value.trim().toLowerCase(), words = typed.split(/\s+/);
    list.replaceChildren();
    if (!typed) return;
    const found = sections.map((s, i) => [rank(s, typed, words), i, s]).filter(([r]) => r).sort((a, b) => b[0] - a[0] || a[1] - b[1]);
    for (const [, , s] of found.slice(0, 20)) {
      const item = document.createElement("li"), link = document.createElement("a"), about = document.createElement("small");
      link.href = root + s.address;
      link.textContent = s.heading + (s.page === s.heading ? "" : " \u2014 " + s.page);
      about.textContent = snippet(s, words);
      item.append(link, about);
      list.append(item);
    }
    if (!found.length) list.append(Object.assign(document.createElement("li"), { textContent: "Nothing in the manual has all these words." }));
  }

  box.addEventListener("input", show);
  box.addEventListener("keydown", (e) => {
    const first = list.querySelector("a");
    if (e.key === "Enter" && first) location.href = first.href;
    if (e.key === "Escape") { box.value = ""; show(); }
    if (e.key === "ArrowDown" && first) { e.preventDefault(); first.focus(); }
  });
  document.addEventListener("keydown", (e) => { if (e.key === "/" && document.activeElement !== box) { e.preventDefault(); box.focus(); } });
  const asked = new URLSearchParams(location.search).get("search"); // a page may be opened with ?search=words
  if (asked) { box.value = asked; show(); }
})();
