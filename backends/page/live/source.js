// Contains the source pane: CodeMirror with Scheme's colours, brackets coloured by depth, indentation, completion,
// messages in place.
import { EditorView, keymap, lineNumbers, highlightActiveLine, highlightActiveLineGutter, drawSelection, Decoration, ViewPlugin } from "@codemirror/view";
import { EditorState, StateField, StateEffect, RangeSetBuilder, Transaction, Compartment } from "@codemirror/state";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { searchKeymap, highlightSelectionMatches } from "@codemirror/search";
import { autocompletion, completionKeymap, closeBrackets, closeBracketsKeymap } from "@codemirror/autocomplete";
import { StreamLanguage, HighlightStyle, syntaxHighlighting, bracketMatching, indentUnit, indentService } from "@codemirror/language";
import { setDiagnostics, lintGutter } from "@codemirror/lint";
import { tags } from "@lezer/highlight";
import { items, around, tokens, definitions } from "./scheme.js";
import { el } from "../dom.js";

const TYPING_MS = 300, TYPING = ["input", "delete", "move", "undo", "redo"]; // Events of the user that change the text.
const FORMS = new Set("define define-parameter define-syntax define-record-type define-primitive lambda let let* letrec letrec* named-lambda if cond case when unless begin do set! and or else syntax-rules guard parameterize load require include import import".split(" "));

const scheme = StreamLanguage.define({
  name: "scheme",
  startState: () => ({ block: 0, string: false, head: false }),
  token(stream, state) {
    if (state.block > 0) {
      while (!stream.eol()) {
        if (stream.match("#|")) state.block++;
        else if (stream.match("|#")) { if (--state.block === 0) break; }
        else stream.next();
      }
      return "comment";
    }
    if (state.string || stream.peek() === '"') {
      if (!state.string) stream.next(), state.string = true;
      for (let c; (c = stream.next());) {
        if (c === "\\") stream.next();
        else if (c === '"') { state.string = false; break; }
      }
      return "string";
    }
    if (stream.eatSpace()) return null;
    if (stream.match("#|")) { state.block = 1; return "comment"; }
    if (stream.peek() === ";") { stream.skipToEnd(); return "comment"; }
    if (stream.match(/^[([{]/)) { state.head = true; return "bracket"; }
    const head = state.head;
    state.head = false;
    if (stream.match(/^[)\]}]/)) return "bracket";
    if (stream.match(/^('|`|,@?)/)) return "meta";
    if (stream.match(/^#\\[^\s()\[\]]+/)) return "string";
    if (stream.match(/^#:[^\s()\[\]]+/)) return "propertyName";
    if (stream.match(/^#[tf](rue|alse)?\b/)) return "bool";
    if (stream.match(/^[-+]?(\d+\/\d+|(\d+\.?\d*|\.\d+)(e[-+]?\d+)?)(?=[\s()\[\]"';]|$)/i)) return "number";
    const word = stream.match(/^[^\s()\[\]{}"';`,]+/);
    if (!word) { stream.next(); return null; }
    return FORMS.has(word[0]) ? "keyword" : head ? "function" : "variableName";
  },
  tokenTable: { function: tags.function(tags.variableName) },
  languageData: { commentTokens: { line: ";", block: { open: "#|", close: "|#" } }, closeBrackets: { brackets: ["(", "[", '"'] } },
});

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" }, { tag: tags.string, color: "var(--code-string)" }, { tag: tags.number, color: "var(--code-number)" },
  { tag: tags.bool, color: "var(--code-number)" }, { tag: tags.keyword, color: "var(--code-keyword)", fontWeight: "600" }, { tag: tags.function(tags.variableName), color: "var(--code-call)" },
  { tag: tags.propertyName, color: "var(--code-key)" }, { tag: tags.meta, color: "var(--soft)" },
]);
const theme = EditorView.theme({
  "&": { fontSize: "13px", backgroundColor: "var(--solid)", color: "var(--ink)", "--code-comment": "var(--soft)", "--code-string": "#3b7d3f", "--code-number": "#b35a00", "--code-keyword": "#7a3fb0", "--code-call": "#1b5fb4", "--code-key": "#0f7b7b" },
  ".dark &": { "--code-string": "#8fce8f", "--code-number": "#f0a860", "--code-keyword": "#c9a2f5", "--code-call": "#82b7ff", "--code-key": "#74d0cf" },
  ".cm-scroller": { fontFamily: 'ui-monospace, "Cascadia Code", "JetBrains Mono", "DejaVu Sans Mono", monospace', lineHeight: "1.55" },
  ".cm-gutters": { backgroundColor: "var(--solid)", color: "var(--soft)", border: "none" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--hover)" },
  "&.cm-focused": { outline: "none" }, ".cm-cursor": { borderLeftColor: "var(--ink)" },
  ".cm-tooltip": { backgroundColor: "var(--solid)", border: "1px solid var(--line)", borderRadius: "8px" },
  ".depth-0": { color: "var(--soft)" }, ".depth-1": { color: "#b3752a" }, ".depth-2": { color: "#3f8a66" }, ".depth-3": { color: "#7d63b8" }, ".depth-4": { color: "#3d7fb5" },
});

// Colours brackets by their depth, and marks brackets without a partner.
const rainbow = ViewPlugin.fromClass(class {
  constructor(view) { this.decorations = this.make(view); }
  update(update) { if (update.docChanged || update.viewportChanged) this.decorations = this.make(update.view); }
  make(view) {
    const text = view.state.doc.toString(), { from, to } = view.viewport, builder = new RangeSetBuilder();
    if (text.length > 400000) return builder.finish();
    let depth = 0;
    tokens(text, (kind, a, b) => {
      if (kind === "close") depth = Math.max(0, depth - 1);
      if ((kind === "open" || kind === "close") && a >= from && b <= to) builder.add(a, b, Decoration.mark({ class: "depth-" + depth % 5 }));
      if (kind === "open") depth++;
    });
    return builder.finish();
  }
}, { decorations: (p) => p.decorations });

// Indents lines. The lines of a list are aligned with its second item, or indented by two columns if its head is a
// form.
const indentation = indentService.of((context, at) => {
  // When the user presses Enter, this is called before the line is broken.
  const broken = context.simulatedBreak === at, text = context.state.doc.sliceString(0, broken ? at : context.state.doc.lineAt(at).from), open = [];
  tokens(text, (kind, from) => { if (kind === "open") open.push(from); else if (kind === "close") open.pop(); });
  if (open.length === 0) return 0;
  const from = open[open.length - 1], start = context.state.doc.lineAt(from), column = from - start.from, inside = items(text + ")".repeat(open.length), from);
  if (inside.length < 2 || text[inside[0][0]] === "(" || text[inside[0][0]] === "[") return column + (inside.length > 0 && FORMS.has(text.slice(...inside[0])) ? 2 : 1);
  if (FORMS.has(text.slice(...inside[0])) || context.state.doc.lineAt(inside[1][0]).number !== start.number) return column + 2;
  return column + inside[1][0] - from;
});

// Wraps long lines, with a further indentation of two columns.
const hanging = ViewPlugin.fromClass(class {
  constructor(view) { this.decorations = this.make(view); }
  update(update) { if (update.docChanged || update.viewportChanged) this.decorations = this.make(update.view); }
  make(view) {
    const builder = new RangeSetBuilder();
    for (const { from, to } of view.visibleRanges)
      for (let at = from; at <= to;) {
        const line = view.state.doc.lineAt(at), columns = Math.min(24, line.text.search(/\S|$/)) + 2;
        builder.add(line.from, line.from, Decoration.line({ attributes: { style: `text-indent:-${columns}ch;padding-left:calc(${columns}ch + 6px)` } }));
        at = line.to + 1;
      }
    return builder.finish();
  }
}, { decorations: (p) => p.decorations });

const setMarks = StateEffect.define();
const marks = StateField.define({
  create: () => Decoration.none,
  update(value, transaction) {
    value = value.map(transaction.changes);
    for (const effect of transaction.effects) if (effect.is(setMarks)) value = effect.value;
    return value;
  },
  provide: (field) => EditorView.decorations.from(field),
});

export class Source {
  // describe(name) returns a promise of the calling form of a name of the language: { call, keywords, doc }.
  // typed(text) receives the text 300 ms after the last key. attempt(text) receives each step of a number that is turned.
  constructor(place, { changed, save, cursor, complete, check, attempt, typed, describe }) {
    this.base = undefined;
    this.check = check;
    this.attempt = attempt;
    this.describe = describe;
    this.descriptions = new Map(); // maps a name to the promise of its description
    this.hint = el("div", { class: "hint-line", role: "status", "aria-label": "How it is called", hidden: true });
    this.told = []; // Messages of the last run about this text.
    this.toldOf = null; // The unsaved text that this run had; null: it had the file's text.
    this.found = []; // Findings of the last check of the current text.
    const names = async (context) => {
      const word = context.matchBefore(/[^\s()\[\]{}"';`,]+/);
      if (!word || (word.from === word.to && !context.explicit)) return null;
      const own = [...definitions(this.text || "").keys()].filter((name) => name !== word.text), found = await complete(word.text), known = new Set(own);
      const info = async ({ label }) => this.#described(await this.#describe(label), -1);
      return { from: word.from, options: [...own.map((label) => ({ label, info, boost: 1 })), ...found.slice(0, 300).filter((label) => !known.has(label)).map((label) => ({ label, info }))],
        validFor: /^[^\s()\[\]{}"';`,]*$/ };
    };
    this.reading = new Compartment();
    this.view = new EditorView({
      parent: place,
      state: EditorState.create({ doc: "", extensions: [this.reading.of([]), lineNumbers(), lintGutter(), history(), drawSelection(), highlightActiveLine(), highlightActiveLineGutter(), bracketMatching(), closeBrackets(), indentation, indentUnit.of("  "), scheme, syntaxHighlighting(colours), theme, EditorView.lineWrapping, hanging, rainbow, marks,
        highlightSelectionMatches(), autocompletion({ override: [names], activateOnTypingDelay: 250 }),
        EditorView.domEventHandlers({ mousedown: (event, view) => event.altKey && this.#drag(event, view) }),
        keymap.of([{ key: "Ctrl-ArrowUp", run: () => this.#step(1) }, { key: "Ctrl-ArrowDown", run: () => this.#step(-1) },
          { key: "Shift-Ctrl-ArrowUp", run: () => this.#step(10) }, { key: "Shift-Ctrl-ArrowDown", run: () => this.#step(-10) }, { key: "Mod-s", preventDefault: true, run: () => { save(); return true; } }, ...closeBracketsKeymap, ...completionKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, indentWithTab]),
        EditorView.updateListener.of((update) => {
          if (update.docChanged) {
            changed();
            clearTimeout(this.checking);
            this.checking = setTimeout(() => this.#look(), 350);
            if (update.transactions.some((t) => TYPING.some((kind) => t.isUserEvent(kind)) && !t.isUserEvent("input.turn"))) {
              clearTimeout(this.typing);
              this.typing = setTimeout(() => typed(this.text), TYPING_MS);
            }
          }
          if (update.docChanged || update.selectionSet) {
            clearTimeout(this.hinting);
            this.hinting = setTimeout(() => this.#hint(), 80);
          }
          const byUser = update.transactions.some((t) => t.isUserEvent("select"));
          if (byUser) {
            clearTimeout(this.waiting);
            this.waiting = setTimeout(() => cursor(this.places()), 120);
          }
        }), EditorView.contentAttributes.of({ "aria-label": "Source", "aria-description": "Tab indents. Escape, then Tab leaves the source." }),
        EditorView.cspNonce.of(document.querySelector("script[nonce]")?.nonce ?? "")] }),
    });
  }

  // ---- the form of the call being written ----

  // Returns the calling form of a name. Definitions of this text have precedence over those of the language.
  async #describe(name) {
    const own = definitions(this.text || "").get(name);
    if (own !== undefined) return own && { call: own, keywords: "", doc: "" };
    if (!this.descriptions.has(name)) this.descriptions.set(name, this.describe(name).catch(() => null));
    return this.descriptions.get(name);
  }
  // Makes a line for each calling form, with the argument number `argument`, from 1, emphasized. Returns null if the
  // form is unknown.
  #described(told, argument) {
    if (!told?.call) return null;
    const line = (call) => el("p", {}, call.replace(/^\(|\)$/g, "").split(/\s+(?![^([]*[)\]])/).map((word, k) => [k > 0 ? " " : "", k === argument && k > 0 ? el("b", {}, word) : word]));
    const keywords = told.keywords && !told.call.includes("#:") ? el("p", { class: "soft" }, told.keywords) : null;
    return el("div", { class: "described" }, told.call.split("\n").slice(0, 4).map(line), keywords, told.doc ? el("p", { class: "soft" }, told.doc) : null);
  }
  // Shows below the source the nearest call around the cursor whose form is known.
  async #hint() {
    const text = this.text || "", at = this.view.state.selection.main.head;
    let shown = null;
    for (const from of around(text, at).slice(0, 6)) {
      if (at === from) continue;
      const inside = items(text, from), name = inside.length > 0 && /[([]/.test(text[from]) ? text.slice(...inside[0]) : "";
      if (!name || /^[([#"\d'`,-]/.test(name)) continue;
      const last = inside.findLastIndex(([begin]) => begin <= at);
      shown = this.#described(await this.#describe(name), last >= 0 && at > inside[last][1] ? last + 1 : last);
      if (shown) break;
    }
    if (at !== this.view.state.selection.main.head) return;
    this.hint.hidden = !shown;
    this.hint.replaceChildren(...(shown ? [shown] : []));
  }

  setReadOnly(on) {
    if (on === this.view.state.readOnly) return;
    this.view.dispatch({ effects: this.reading.reconfigure(on ? EditorState.readOnly.of(true) : []) });
  }

  get text() { return this.base === undefined ? undefined : this.view.state.doc.toString(); }
  get dirty() { return this.base !== undefined && this.text !== this.base; }

  load(text) {
    const was = this.view.state.doc.toString();
    this.base = text;
    if (was === text) return;
    // The beginning and the end that the old and the new text have in common stay, and the cursor in them stays.
    let a = 0, b = 0;
    while (a < was.length && a < text.length && was[a] === text[a]) a++;
    while (b < was.length - a && b < text.length - a && was[was.length - 1 - b] === text[text.length - 1 - b]) b++;
    this.view.dispatch({ changes: { from: a, to: was.length - b, insert: text.slice(a, text.length - b) }, annotations: Transaction.addToHistory.of(false) });
  }
  saved(text) { this.base = text; }

  offset(line, column) { // Returns the offset of a place. Columns count characters, and offsets count units of 16 bits.
    const at = this.view.state.doc.line(Math.min(Math.max(1, line), this.view.state.doc.lines));
    return at.from + [...at.text].slice(0, Math.max(0, column - 1)).join("").length;
  }
  position(offset) {
    const line = this.view.state.doc.lineAt(offset);
    return { line: line.number, column: [...line.text.slice(0, offset - line.from)].length + 1 };
  }

  go(line, column) {
    const at = this.offset(line, column);
    this.view.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: "center" }) });
    this.view.focus();
  }

  // Returns the places of the lists around the cursor, the innermost first.
  places() {
    return around(this.text || "", this.view.state.selection.main.head).map((at) => this.position(at));
  }

  // Marks the calls that led to an object: the first strongly, its callers faintly.
  mark(chain) {
    const text = this.view.state.doc.toString(), ranges = [];
    chain.forEach((o, k) => {
      const from = this.offset(o.line, o.column), inside = /[([]/.test(text[from] || "") ? items(text, from) : [];
      let to = inside.length > 0 ? inside[inside.length - 1][1] + 1 : this.view.state.doc.lineAt(from).to;
      to = Math.min(text.length, Math.max(to, from + 1));
      if (from < to) ranges.push(Decoration.mark({ class: k === 0 ? "made" : "called" }).range(from, to));
    });
    const effects = [setMarks.of(Decoration.set(ranges, true))];
    if (chain.length > 0) effects.push(EditorView.scrollIntoView(this.offset(chain[0].line, chain[0].column), { y: "center", x: "end" }));
    this.view.dispatch({ effects });
  }

  // ---- numbers that a drag or keys change ----

  // Returns the number literal at an offset, { from, to, text }, or null.
  numberAt(offset) {
    const line = this.view.state.doc.lineAt(offset);
    for (const m of line.text.matchAll(/(?<=^|[\s()[\]'])[-+]?(\d+\.?\d*|\.\d+)(?=$|[\s()[\];])/g)) {
      const from = line.from + m.index, to = from + m[0].length;
      if (from <= offset && offset <= to) return { from, to, text: m[0] };
    }
    return null;
  }
  // Changes a number by `steps` units of its last written digit.
  #turn(at, text, steps) {
    const places = (text.split(".")[1] || "").length, value = (Number(text) + steps * 10 ** -places).toFixed(places).replace(/^-(0(\.0*)?)$/, "$1");
    const now = this.numberAt(at);
    if (!now || now.text === value || this.view.state.readOnly) return;
    this.view.dispatch({ changes: { from: now.from, to: now.to, insert: value }, selection: { anchor: now.from, head: now.from + value.length }, userEvent: "input.turn" });
    this.attempt(this.text);
  }
  #step(steps) {
    const at = this.view.state.selection.main.head, number = this.numberAt(at);
    if (number) this.#turn(number.from, number.text, steps);
    return !!number;
  }
  #drag(event, view) {
    const offset = view.posAtCoords({ x: event.clientX, y: event.clientY }), number = offset === null ? null : this.numberAt(offset);
    if (!number) return false;
    const move = (e) => this.#turn(number.from, number.text, Math.round((e.clientX - event.clientX) / 6) * (e.shiftKey ? 10 : 1));
    const up = () => { removeEventListener("pointermove", move); removeEventListener("pointerup", up); };
    addEventListener("pointermove", move);
    addEventListener("pointerup", up);
    event.preventDefault();
    return true;
  }

  // Requests a check of the current text, whether saved or not.
  async #look() {
    const text = this.text, found = text === undefined ? [] : await this.check(text);
    if (text !== this.text) return;
    this.found = found.map((f) => ({ severity: f.type === "unreadable" ? "error" : "warning", message: f.details || f.type.replace(/-/g, " "),
      at: { line: f.line, column: f.column, endLine: f.end_line, endColumn: f.end_column } }));
    this.#show();
  }
  // text: the text that was run, if it is an unsaved one; otherwise the messages are about the file's text.
  diagnose(messages, text = null) {
    this.told = messages;
    this.toldOf = text;
    this.#show();
  }
  #show() {
    const told = (this.toldOf ?? this.base) === this.text ? this.told : [], said = new Set(told.map((m) => m.at.line + ":" + m.at.column));
    const messages = [...told, ...this.found.filter((m) => !said.has(m.at.line + ":" + m.at.column))];
    const length = this.view.state.doc.length;
    const found = messages.filter((m) => m.at.line > 0).map((m) => {
      const from = Math.min(length, this.offset(m.at.line, m.at.column)), to = Math.min(length, m.at.endLine ? this.offset(m.at.endLine, m.at.endColumn) : from + 1);
      return { from, to: Math.max(from, to), severity: m.severity === "error" ? "error" : m.severity === "warning" ? "warning" : "info", message: m.message };
    });
    this.view.dispatch(setDiagnostics(this.view.state, found));
  }

  // Changes the default in the (define-parameter name default ...) at a place, and nothing else. Returns false if there
  // is no such call at the place.
  replaceParameter(name, at, value) {
    const text = this.text, from = this.offset(at.line, at.column);
    let open = text.lastIndexOf("(define-parameter", from + 1);
    if (open < 0) return false;
    for (const candidate of [from, open]) {
      const inside = items(text, candidate);
      if (inside.length < 3 || text.slice(...inside[0]) !== "define-parameter" || text.slice(...inside[1]) !== name) continue;
      this.view.dispatch({ changes: { from: inside[2][0], to: inside[2][1], insert: value } });
      return true;
    }
    return false;
  }
}
