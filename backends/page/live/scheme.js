// Owns the reading of Scheme text for an editor: the ends of data, and which characters are comments, strings and
// words.

const ends = new Set([..." \t\r\n()[]{}\";'`,"]);

// Passes every token to each(kind, from, to): "open" "close" "string" "comment" "number" "word" "constant" "quote".
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

// Returns the ranges of a list's items, [from, to] each, quotes included: the list begins at text[at].
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

// Returns the lists around a place, the innermost first, as offsets of their opening parentheses. A place directly
// before or after a list is in it.
export function around(text, at) {
  const open = [], found = [];
  tokens(text, (kind, from, to) => {
    if (kind === "open") open.push(from);
    else if (kind === "close") {
      const began = open.pop();
      if (began !== undefined && began <= at && at <= to) found.push(began);
    }
  });
  while (open.length > 0) { // Not closed yet.
    const began = open.pop();
    if (began <= at) found.push(began);
  }
  return found;
}

// Returns the top-level definitions of a text, by name: "(name a b)" for procedures, "" for values.
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
