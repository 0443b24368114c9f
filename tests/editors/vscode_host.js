// Replaces the module that VS Code gives to its extensions: documents, edits, and the providers that a client registers.
// A member that the tests do not examine accepts any name and any call.
"use strict";
const path = require("path"), url = require("url");

class EventEmitter {
  constructor() { this.heard = new Set(); this.event = (listener, self, bin) => { const call = (e) => listener.call(self, e); this.heard.add(call); const gone = { dispose: () => this.heard.delete(call) }; if (bin) bin.push(gone); return gone; }; }
  fire(e) { for (const call of [...this.heard]) call(e); }
  dispose() { this.heard.clear(); }
}
class Position {
  constructor(line, character) { Object.assign(this, { line, character }); }
  translate(l, c) { return new Position(this.line + l, this.character + c); }
}
class Range {
  constructor(a, b, c, d) { [this.start, this.end] = typeof a === "number" ? [new Position(a, b), new Position(c, d)] : [a, b]; }
  get isEmpty() { return this.start.line === this.end.line && this.start.character === this.end.character; }
}
class Uri {
  constructor(text) { const u = new url.URL(text); Object.assign(this, { text, scheme: u.protocol.slice(0, -1), authority: u.host, path: decodeURIComponent(u.pathname), query: u.search.slice(1), fragment: u.hash.slice(1) }); }
  get fsPath() { return this.path; }
  toString() { return this.text; }
  with() { return this; }
  static parse(text) { return new Uri(text); }
  static file(name) { return new Uri(url.pathToFileURL(path.resolve(name)).href); }
}
class Diagnostic { constructor(range, message, severity) { Object.assign(this, { range, message, severity }); } }
class TextEdit {
  constructor(range, newText) { Object.assign(this, { range, newText }); }
  static replace(range, text) { return new TextEdit(range, text); }
  static insert(at, text) { return new TextEdit(new Range(at, at), text); }
}
class WorkspaceEdit {
  constructor() { this.all = []; }
  set(uri, edits) { if (edits) this.all.push(...edits.map((edit) => ({ uri, edit: Array.isArray(edit) ? edit[0] : edit }))); }
  replace(uri, range, text) { this.all.push({ uri, edit: new TextEdit(range, text) }); }
  insert(uri, at, text) { this.replace(uri, new Range(at, at), text); }
}
class MarkdownString { constructor(value) { this.value = value || ""; } appendMarkdown(more) { this.value += more; return this; } appendCodeblock(more) { this.value += more; return this; } }
const record = (...names) => class { constructor(...of) { names.forEach((name, i) => { this[name] = of[i]; }); } };
class CancellationTokenSource { constructor() { this.token = { isCancellationRequested: false, onCancellationRequested: new EventEmitter().event }; } cancel() { this.token.isCancellationRequested = true; } dispose() {} }
const numbered = (...names) => Object.fromEntries(names.map((name, i) => [name, i]));

// Answers to any name and any call, so that a client can register what the tests do not look at.
const anything = (base = {}) => new Proxy(function () {}, { get: (_, name) => name in base ? base[name] : name === "then" ? undefined : name === Symbol.toPrimitive ? () => 0 : anything(), apply: () => anything({ dispose() {} }), construct: () => anything() });
const filled = (base) => new Proxy(base, { get: (_, name) => name in base ? base[name] : name === "then" ? undefined : String(name).startsWith("onDid") || String(name).startsWith("onWill") ? new EventEmitter().event : anything() });

const events = { open: new EventEmitter(), change: new EventEmitter(), close: new EventEmitter(), save: new EventEmitter() };
const documents = [], providers = new Map(), collections = new Map(), commands = new Map(), panels = [], shown = [], messages = [];

class TextDocument {
  constructor(name, languageId, text) { Object.assign(this, { uri: Uri.file(name), fileName: path.resolve(name), languageId, text, version: 1, isClosed: false, isDirty: false, isUntitled: false, eol: 1, notebook: undefined }); }
  getText(range) { return range ? this.text.slice(this.offsetAt(range.start), this.offsetAt(range.end)) : this.text; }
  get lineCount() { return this.text.split("\n").length; }
  offsetAt(at) { return this.text.split("\n").slice(0, at.line).reduce((n, line) => n + line.length + 1, 0) + at.character; }
  positionAt(offset) { const lines = this.text.slice(0, offset).split("\n"); return new Position(lines.length - 1, lines[lines.length - 1].length); }
  edit(from, to, text) {
    const range = new Range(this.positionAt(from), this.positionAt(to));
    this.text = this.text.slice(0, from) + text + this.text.slice(to);
    this.version++;
    events.change.fire({ document: this, contentChanges: [{ range, rangeOffset: from, rangeLength: to - from, text }] });
  }
  apply(edits) { for (const [from, to, text] of edits.map((e) => [this.offsetAt(e.range.start), this.offsetAt(e.range.end), e.newText]).sort((a, b) => b[0] - a[0])) this.edit(from, to, text); }
  save() { events.save.fire(this); return Promise.resolve(true); }
}

const register = (kind) => (selector, provider, ...more) => { providers.set(kind, provider); return { dispose: () => providers.delete(kind), more }; };
const kinds = ["CompletionItem", "Hover", "SignatureHelp", "Definition", "Reference", "Rename", "DocumentSymbol", "DocumentFormattingEdit", "CodeActions", "CodeLens", "DocumentSemanticTokens", "InlayHints"];
const languages = { match: (selector, document) => [].concat(selector).some((s) => !s.language || s.language === document.languageId) ? 10 : 0,
  createDiagnosticCollection: (name) => { const map = new Map(); collections.set(name, map); return { name, set: (uri, list) => map.set(String(uri), list || []), delete: (uri) => map.delete(String(uri)), get: (uri) => map.get(String(uri)), clear: () => map.clear(), dispose: () => map.clear() }; } };
for (const kind of kinds) languages[`register${kind}Provider`] = register(kind);

const settings = { command: process.env.VS || "vs", checkOnSave: true };
const workspace = { textDocuments: documents, workspaceFolders: undefined, notebookDocuments: [], isTrusted: true, getConfiguration: () => ({ get: (name, otherwise) => name in settings ? settings[name] : otherwise, inspect: () => undefined }), getWorkspaceFolder: () => undefined,
  onDidOpenTextDocument: events.open.event, onDidChangeTextDocument: events.change.event, onDidCloseTextDocument: events.close.event, onDidSaveTextDocument: events.save.event,
  onWillSaveTextDocument: new EventEmitter().event, createFileSystemWatcher: () => anything(),
  applyEdit: async (edit) => { for (const uri of new Set(edit.all.map((e) => String(e.uri)))) documents.find((d) => String(d.uri) === uri).apply(edit.all.filter((e) => String(e.uri) === uri).map((e) => e.edit)); return true; } };
const channel = () => ({ name: "", append() {}, appendLine() {}, replace() {}, clear() {}, show() {}, hide() {}, dispose() {} });
const window = { activeTextEditor: undefined, visibleTextEditors: [], tabGroups: filled({ all: [] }), createOutputChannel: channel,
  showErrorMessage: async (text) => { messages.push(text); }, showWarningMessage: async (text) => { messages.push(text); }, showInformationMessage: async () => undefined,
  createWebviewPanel: (type, title, where, options) => { const gone = new EventEmitter(), panel = { type, title, where, options, webview: { html: "" }, revealed: 0, reveal() { this.revealed++; }, onDidDispose: gone.event, dispose: () => gone.fire() }; panels.push(panel); return panel; } };
const env = { language: "en", appName: "test", machineId: "", openExternal: async (uri) => { shown.push(String(uri)); return true; }, asExternalUri: async (uri) => uri };
const registry = { registerCommand: (name, call, self) => { commands.set(name, call.bind(self)); return { dispose: () => commands.delete(name) }; }, executeCommand: async (name, ...of) => commands.has(name) ? commands.get(name)(...of) : undefined };

const api = filled({ version: "1.90.0", EventEmitter, Position, Range, Uri, Diagnostic, TextEdit, WorkspaceEdit, MarkdownString, CancellationTokenSource,
  Location: record("uri", "range"), Hover: record("contents", "range"), CompletionItem: record("label", "kind"), CompletionList: record("items", "isIncomplete"), SnippetString: record("value"), CodeLens: record("range", "command"),
  CodeAction: record("title", "kind"), CodeActionKind: class CodeActionKind { constructor(value) { this.value = value; } append(part) { return new api.CodeActionKind(this.value ? this.value + "." + part : part); } static QuickFix = new this("quickfix"); static Empty = new this(""); }, DiagnosticRelatedInformation: record("location", "message"), SignatureHelp: record(), SignatureInformation: record("label", "documentation"), ParameterInformation: record("label", "documentation"),
  SymbolInformation: record("name", "kind", "containerName", "location"), DocumentSymbol: record("name", "detail", "kind", "range", "selectionRange"), SemanticTokens: record("data", "resultId"), SemanticTokensLegend: record("tokenTypes", "tokenModifiers"), SemanticTokensEdits: record("edits"),
  RelativePattern: record("base", "pattern"), Disposable: class { constructor(call) { this.dispose = call; } }, CancellationError: class extends Error {}, CallHierarchyItem: record(), TypeHierarchyItem: record(), InlayHint: record(), DocumentLink: record(), LinkedEditingRanges: record(),
  DiagnosticSeverity: numbered("Error", "Warning", "Information", "Hint"), DiagnosticTag: { Unnecessary: 1, Deprecated: 2 }, CompletionItemKind: numbered("Text", "Method", "Function", "Constructor", "Field", "Variable", "Class", "Interface", "Module", "Property", "Unit", "Value", "Enum", "Keyword", "Snippet"), SymbolKind: numbered("File", "Module"), CompletionItemTag: { Deprecated: 1 }, CompletionTriggerKind: numbered("Invoke", "TriggerCharacter", "TriggerForIncompleteCompletions"), SignatureHelpTriggerKind: { Invoke: 1 }, CodeActionTriggerKind: { Invoke: 1, Automatic: 2 },
  TextDocumentSaveReason: { Manual: 1 }, EndOfLine: { LF: 1, CRLF: 2 }, ViewColumn: { Beside: -2 }, ProgressLocation: {}, FileType: { File: 1 }, UIKind: { Desktop: 1 }, LogLevel: {}, ConfigurationTarget: {}, languages, workspace: filled(workspace), window: filled(window), env: filled(env), commands: registry });

module.exports = { api, documents, events, providers, collections, commands, panels, shown, messages, settings, TextDocument, window };
