// Contains the view of a conflict: the page's text and the file's text side by side, with their different lines marked.
import { el } from "../dom.js";

const LINES_MOST = 4000000; // Greatest product of the numbers of lines that are compared one by one.

// Returns for two lists of lines which of them the other lacks, as two arrays of booleans: a longest common sequence of
// the lines between the common beginning and the common end.
export function differences(a, b) {
  let from = 0, end = 0;
  while (from < a.length && from < b.length && a[from] === b[from]) from++;
  while (end < a.length - from && end < b.length - from && a[a.length - 1 - end] === b[b.length - 1 - end]) end++;
  const n = a.length - from - end, m = b.length - from - end, own = [a, b].map((lines) => lines.map((_, i) => i >= from && i < lines.length - end));
  if (n * m === 0 || n * m > LINES_MOST) return own;
  // most[i * (m + 1) + j]: number of common lines of the texts from line i and from line j on.
  const most = new Uint32Array((n + 1) * (m + 1)), at = (i, j) => i * (m + 1) + j;
  for (let i = n - 1; i >= 0; i--)
    for (let j = m - 1; j >= 0; j--) most[at(i, j)] = a[from + i] === b[from + j] ? 1 + most[at(i + 1, j + 1)] : Math.max(most[at(i + 1, j)], most[at(i, j + 1)]);
  for (let i = 0, j = 0; i < n && j < m;) {
    if (a[from + i] === b[from + j]) own[0][from + i++] = own[1][from + j++] = false;
    else if (most[at(i + 1, j)] >= most[at(i, j + 1)]) i++;
    else j++;
  }
  return own;
}

export class Conflict {
  // mine() writes the page's text over the file's, theirs() takes the file's text.
  constructor({ mine, theirs }) {
    const button = (text, action, title) => el("button", { type: "button", class: "button", title, onclick: action }, text);
    this.words = el("span");
    this.shows = button("Show both", () => this.show(), "Show the page's text and the file's side by side");
    this.notice = el("div", { class: "newer", role: "alert", hidden: true }, this.words, this.shows);
    this.texts = ["Yours, in this page", "On disk"].map((title) => ({ pre: el("pre", { tabindex: "0", role: "region", "aria-label": title }), title }));
    this.root = el("section", { class: "conflict", "aria-label": "Both texts", tabindex: "-1", hidden: true },
      el("header", {}, el("p", {}, "The file has changed on disk since this page read it. Lines that the other text lacks are marked."),
        button("Keep yours", mine, "Write your text over the file"), button("Take the file's", theirs, "Give up your changes"), button("Later", () => this.close(), "Back to your text; Save asks again")),
      el("div", { class: "both" }, this.texts.map(({ pre, title }) => el("figure", {}, el("figcaption", {}, title), pre))));
    this.root.addEventListener("keydown", (event) => { if (event.key === "Escape") this.close(); event.stopPropagation(); });
    for (const { pre } of this.texts) pre.addEventListener("scroll", () => this.#together(pre));
  }
  // Says in the source pane that the file has changed. show() opens both texts.
  tell(path, show) {
    this.show = show;
    this.words.textContent = path.split("/").pop() + " has changed on disk, and you have changes here.";
    this.notice.hidden = false;
  }
  open(mine, disk) {
    const lines = [mine, disk].map((text) => text.split("\n")), own = differences(...lines);
    this.texts.forEach(({ pre }, k) => pre.replaceChildren(...lines[k].map((line, i) => el("span", { class: own[k][i] ? "own" : null }, line + "\n"))));
    this.root.hidden = false;
    this.root.focus();
    const first = this.root.querySelector(".own");
    if (first) first.parentNode.scrollTop = first.offsetTop - first.parentNode.clientHeight / 3;
  }
  close() {
    this.root.hidden = this.notice.hidden = true;
  }
  #together(moved) {
    for (const { pre } of this.texts) if (pre !== moved && Math.abs(pre.scrollTop - moved.scrollTop) > 1) pre.scrollTop = moved.scrollTop;
  }
}
