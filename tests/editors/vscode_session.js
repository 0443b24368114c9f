// A session of VS Code's client of language servers with vs lsp: vscode_session.js EXTENSION FILE. Prints a line for each step. The client
// is vscode-languageclient; vscode_host.js stands in for the editor around it.
"use strict";
const Module = require("module"), fs = require("fs"), path = require("path");
const host = require("./vscode_host.js"), load = Module._load;
Module._load = function (name, ...more) { return name === "vscode" ? host.api : load.call(this, name, ...more); };
const [extension, file] = process.argv.slice(2).map((name) => path.resolve(name));
const say = (what, value) => console.log(`${what}: ${typeof value === "string" ? value : JSON.stringify(value)}`);
const pause = (ms) => new Promise((done) => setTimeout(done, ms));
async function until(what, test) {
  for (let i = 0; i < 1500; i++) { const found = test(); if (found) return found; await pause(20); }
  throw new Error(`${what} does not come: ${JSON.stringify(host.messages)}`);
}
const token = new host.api.CancellationTokenSource().token;
const at = (d, place) => d.positionAt(d.text.indexOf(place.replace("^", "")) + place.indexOf("^"));

async function session() {
  const context = { subscriptions: [] };
  require(extension).activate(context);
  const d = new host.TextDocument(file, "visualscheme", fs.readFileSync(file, "utf8"));
  host.documents.push(d);
  host.events.open.fire(d);
  host.window.activeTextEditor = { document: d };
  await until("the server", () => host.providers.size >= 11 && [...host.collections.values()].some((c) => c.size));
  const messages = () => { for (const c of host.collections.values()) if (c.has(String(d.uri))) return c.get(String(d.uri)); return []; };
  const settled = (count) => until(`${count} messages`, () => messages().length === count);
  await settled(2);
  say("messages", messages().map((m) => `${m.range.start.line + 1} ${m.code}: ${m.message}`));
  const wrong = messages().find((m) => m.code === "unbound");
  const actions = await host.providers.get("CodeActions").provideCodeActions(d, wrong.range, { diagnostics: [wrong], only: undefined, triggerKind: 1 }, token);
  say("actions", actions.map((a) => a.title));
  await host.api.workspace.applyEdit(actions[0].edit);
  await settled(1);
  const end = "\n(draw (make-sph";
  d.edit(d.text.length, d.text.length, end);
  const list = await host.providers.get("CompletionItem").provideCompletionItems(d, d.positionAt(d.text.length), token, { triggerKind: 0 });
  say("completion", (list.items || list).map((i) => i.label).filter((name) => name.startsWith("make-sphere")));
  d.edit(d.text.length, d.text.length, "ere (xyz 9 0 0) storey))\n");
  await settled(1);
  const hover = await host.providers.get("Hover").provideHover(d, at(d, "(wa^ll (xyz"), token);
  say("hover", [].concat(hover.contents).map((c) => c.value || c).join().split("\n")[1]);
  const help = await host.providers.get("SignatureHelp").provideSignatureHelp(d, at(d, "(make-box p ^4"), token, { triggerKind: 1 });
  say("signature", [help.signatures[0].label, help.activeParameter]);
  const definition = [].concat(await host.providers.get("Definition").provideDefinition(d, at(d, "9 0 0) sto^rey"), token))[0];
  say("definition", definition.range.start.line + 1);
  say("references", (await host.providers.get("Reference").provideReferences(d, at(d, "(define sto^rey"), { includeDeclaration: true }, token)).length);
  await host.api.workspace.applyEdit(await host.providers.get("Rename").provideRenameEdits(d, at(d, "(define sto^rey"), "height", token));
  say("outline", (await host.providers.get("DocumentSymbol").provideDocumentSymbols(d, token)).map((s) => s.name));
  const tokens = await host.providers.get("DocumentSemanticTokens").provideDocumentSemanticTokens(d, token);
  say("colours", tokens.data.length % 5 === 0 && tokens.data.length > 50);
  d.apply(await host.providers.get("DocumentFormattingEdit").provideDocumentFormattingEdits(d, { tabSize: 2, insertSpaces: true }, token));
  await settled(1);
  say("text", "\n" + d.text);
  const fault = '(error "too high:" height)\n';
  d.edit(d.text.length, d.text.length, fault);
  fs.writeFileSync(file, d.text);
  await d.save();
  await until("the run's message", () => messages().some((m) => m.code === "run"));
  say("run", messages().filter((m) => m.code === "run").map((m) => `${m.range.start.line + 1} ${m.message}`));
  d.edit(d.text.length - fault.length, d.text.length, "");
  await settled(1);
  fs.writeFileSync(file, d.text);
  await d.save();
  const told = await host.providers.get("Hover").provideHover(d, at(d, "(define hei^ght"), token);
  say("value", [].concat(told.contents).map((c) => c.value || c).join().includes("```scheme\n3\n```"));
  const lens = await host.providers.get("CodeLens").provideCodeLenses(d, token);
  say("lens", lens.map((l) => l.command.title));
  if (process.env.VIEWER) {
    await host.commands.get(lens[0].command.command)(...lens[0].command.arguments);
    await until("the panel", () => host.panels.length && host.panels[0].webview.html);
    await panel(host.panels[0]);
    await host.commands.get("visualscheme.view")();
    await until("the command's panel", () => host.panels.length === 2 && host.panels[1].webview.html);
    await panel(host.panels[1]);
    host.panels[1].dispose();
    await until("the view's end", async () => !await fetch(frame(host.panels[1])).then(() => true, () => false));
  }
  for (const s of context.subscriptions.reverse()) await s.dispose();
  if (host.messages.length) say("errors", host.messages);
}

const frame = (panel) => /<iframe src="([^"#]*)/.exec(panel.webview.html)[1];
// The panel's frame shows a live view, which lets VS Code frame it, and no page of the web.
async function panel(p) {
  const address = /<iframe src="(http:\/\/127\.0\.0\.1:\d+\/#[0-9a-f]+)"/.exec(p.webview.html), page = await fetch(frame(p));
  say("panel", [p.title, Boolean(address), p.webview.html.includes(`frame-src ${new URL(frame(p)).origin};`), page.status, /frame-ancestors ([^;]*)/.exec(page.headers.get("content-security-policy"))[1]]);
}

session().then(() => process.exit(0), (error) => { console.log(error.stack); process.exit(1); });
