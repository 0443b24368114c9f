// Reads Scheme text for an editor: finds the ends of data, and the characters that belong to comments, strings and
// words.

const ends = new Set([..." \t\r\n()[]{}\";'`,"]);

// Calls each(kind, from, to) for every token. kind: "open" "close" "string" "comment" "number" "word" "constant"
// "quote".
export function tokens(text, each) {
  let i = 0;
  while (i < text.length) {
    const c = text[i], from = i;
    if (/\s/.test(c)) { i++; continue; }
    if (c === ";") {
      while (i < text.length && text[i] !== "\n") i++;
      each("comment", from, i);
    } else if (c === "#" && text[i + 1] === "|") {
      let depth = 0;
      do {
        if (text.startsWith("#|", i)) depth++, i += 2;
        else if (text.startsWith("|#", i)) depth--, i += 2;
        else i++;
      } while (depth > 0 && i < text.length);
      each("comment", from, i);
    } else if (c === '"') {
      for (i++; i < text.length && text[i] !== '"'; i++) if (text[i] === "\\") i++;
      i = Math.min(text.length, i + 1);
      each("string", from, i);
    } else if ("([{".includes(c)) each("open", from, ++i);
    else if (")]}".includes(c)) each("close", from, ++i);
    else if ("'`,".includes(c)) {
      i += text.startsWith(",@", i) ? 2 : 1;
      each("quote", from, i);
    } else if (c === "#" && text[i + 1] === ";") each("quote", from, i += 2);
    else {
      i += c === "#" && text[i + 1] === "\\" ? 3 : 1;
      while (i < text.length && !ends.has(text[i])) i++;
      const word = text.slice(from, i);
      each(/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$|^[-+]?\d+\/\d+$/i.test(word) ? "number" : /^#[^:]/.test(word) ? "constant" : "word", from, i);
    }
  }
}

// Returns the ranges [from, to] of the items of the list that begins at text[at]. Quotes belong to their items.
export function items(text, at) {
  const found = [];
  let depth = 0, began = -1, done = false;
  tokens(text.slice(at), (kind, from, to) => {
    if (done || kind === "comment") return;
    if (kind === "quote" || kind === "open") {
      if (depth === 1 && began < 0) began = at + from;
      if (kind === "open") depth++;
      return;
    }
    if (kind === "close" && --depth === 0) return void (done = true);
    if (depth === 1) {
      found.push([began >= 0 ? began : at + from, at + to]);
      began = -1;
    } else if (depth === 0) done = true;
  });
  return found;
}

// Returns the lists around a position, the innermost first, as offsets of their opening parentheses. A position
// directly before or after a list counts as inside it.
export function around(text, at) {
  const open = [], found = [];
  tokens(text, (kind, from, to) => {
    if (kind === "open") open.push(from);
    else if (kind === "close") {
      const began = open.pop();
      if (began !== undefined && began <= at && at <= to) found.push(began);
    }
  });
  while (open.length > 0) { // These lists are not closed yet.
    const began = open.pop();
    if (began <= at) found.push(began);
  }
  return found;
}

// Returns a map of the top-level definitions of a text. It maps the name of a procedure to "(name a b)", and the name
// of a value to "".
export function definitions(text) {
  const found = new Map();
  for (const m of text.matchAll(/^[([](?:define|define-\w+)[ \t]+/gm)) {
    const at = m.index + m[0].length;
    if (text[at] !== "(") {
      const name = /^[^\s()[\]"';]+/.exec(text.slice(at, at + 200));
      if (name) found.set(name[0], "");
      continue;
    }
    const parts = items(text, at).map(([from, to]) => text.slice(from, to));
    if (parts.length > 0) found.set(parts[0].replace(/^[([]+/, ""), `(${parts.join(" ").replace(/\s+/g, " ")})`);
  }
  return found;
}

// Returns true if a program reads whole: each bracket, string and comment is closed, and no bracket is without a partner.
export function isWhole(text) {
  const partner = { ")": "(", "]": "[", "}": "{" }, open = [];
  let whole = true;
  tokens(text, (kind, from, to) => {
    if (kind === "open") open.push(text[from]);
    else if (kind === "close") whole &&= open.pop() === partner[text[from]];
    else if (kind === "string") whole &&= to - from > 1 && text[to - 1] === '"' && /(^|[^\\])(\\\\)*"$/.test(text.slice(from + 1, to));
    else if (kind === "comment" && text[from] === "#") whole &&= text.endsWith("|#", to);
  });
  return whole && open.length === 0;
}
