// Owns the extension's commands: checking a model, whose messages become problems, and its live view in a panel.
"use strict";
const vscode = require("vscode");
const { execFile, spawn } = require("child_process");
const path = require("path");

const setting = (name) => vscode.workspace.getConfiguration("visualscheme").get(name);

// FILE:LINE:COLUMN: [warning: |note: ]message
function problems(text, folder) {
  const found = new Map();
  for (const line of text.split("\n")) {
    const m = /^(.+?):(\d+):(\d+): (?:(warning|note): )?(.*)$/.exec(line);
    if (!m) continue;
    const file = path.resolve(folder, m[1]), at = new vscode.Position(Number(m[2]) - 1, Number(m[3]) - 1);
    const kind = m[4] === "warning" ? vscode.DiagnosticSeverity.Warning : m[4] === "note" ? vscode.DiagnosticSeverity.Information : vscode.DiagnosticSeverity.Error;
    if (!found.has(file)) found.set(file, []);
    found.get(file).push(new vscode.Diagnostic(new vscode.Range(at, at.translate(0, 1)), m[5], kind));
  }
  return found;
}

// The findings of `vs check --json`, without running the model: the span of each, and its name as the code.
function findings(text, folder) {
  const found = new Map();
  let list = [];
  try { list = JSON.parse(text).findings; } catch { return found; }
  for (const f of list) {
    const file = path.resolve(folder, f.file);
    const d = new vscode.Diagnostic(new vscode.Range(new vscode.Position(f.line - 1, f.column - 1), new vscode.Position(f.end_line - 1, f.end_column - 1)), f.details, vscode.DiagnosticSeverity.Warning);
    d.code = f.type;
    if (!found.has(file)) found.set(file, []);
    found.get(file).push(d);
  }
  return found;
}

// The panel's page: the live view in a frame. The address has its token after #, which the frame alone reads.
function page(address) {
  const quoted = address.replace(/&/g, "&amp;").replace(/"/g, "&quot;").replace(/</g, "&lt;"), origin = new URL(address).origin;
  return `<!DOCTYPE html>
<html><head><meta charset="utf-8"><title>VisualScheme</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; frame-src ${origin}; style-src 'unsafe-inline'">
<style>html, body, iframe { margin: 0; padding: 0; border: 0; width: 100%; height: 100%; overflow: hidden; display: block }</style></head>
<body><iframe src="${quoted}" sandbox="allow-scripts allow-same-origin allow-downloads allow-popups" allow="clipboard-write; fullscreen"></iframe></body></html>`;
}

// Shows the address beside the text: the first time in a new panel, then in that one. ended: called when the user closes the panel.
const panels = new Map();
async function showPanel(address, title, ended) {
  const open = panels.get(address);
  if (open) return open.reveal(undefined, true);
  const panel = vscode.window.createWebviewPanel("visualscheme.view", title, { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true }, { enableScripts: true, retainContextWhenHidden: true });
  panels.set(address, panel);
  panel.onDidDispose(() => { panels.delete(address); if (ended) ended(); });
  const [where, token] = address.split("#"), reached = await vscode.env.asExternalUri(vscode.Uri.parse(where)); // elsewhere if vs runs on another machine
  panel.webview.html = page(String(reached).replace(/#.*$/, "") + (token ? "#" + token : ""));
  return panel;
}

// The language server, if its client's package is installed: completion, help, definitions, colours, quick fixes, runs after a save. An address that the
// server asks to show appears in a panel.
function startServer() {
  let node;
  try { node = require("vscode-languageclient/node"); } catch { return null; }
  const showDocument = async (asked, next) => {
    if (!asked.external || !/^http:\/\/127\.0\.0\.1:/.test(asked.uri)) return next(asked);
    await showPanel(asked.uri, "VisualScheme");
    return { success: true };
  };
  const client = new node.LanguageClient("visualscheme", "VisualScheme", { command: setting("command"), args: ["lsp"] },
    { documentSelector: [{ scheme: "file", language: "visualscheme" }, { scheme: "untitled", language: "visualscheme" }], initializationOptions: { pictures: true, run: setting("checkOnSave") }, middleware: { window: { showDocument } } });
  client.start();
  return client;
}

function activate(context) {
  const server = startServer();
  if (server) context.subscriptions.push({ dispose: () => server.stop() });
  const list = vscode.languages.createDiagnosticCollection("visualscheme"), looks = vscode.languages.createDiagnosticCollection("visualscheme-check"), views = new Map();
  const show = (into, found) => {
    into.clear();
    for (const [file, of] of found) into.set(vscode.Uri.file(file), of);
  };
  const check = (document) => {
    if (!document || document.languageId !== "visualscheme") return;
    const folder = path.dirname(document.fileName);
    if (!server) execFile(setting("command"), ["check", "--json", document.fileName], { cwd: folder, maxBuffer: 1 << 24 }, (error, out) => show(looks, findings(out, folder)));
    execFile(setting("command"), ["--quiet", "--check", "--limit-time", "60", document.fileName], { cwd: folder, maxBuffer: 1 << 24 }, (error, out, said) => {
      if (error && error.code === "ENOENT") return vscode.window.showErrorMessage("There is no command " + setting("command"));
      show(list, problems(said, folder));
    });
  };
  const view = () => {
    const editor = vscode.window.activeTextEditor, file = editor && editor.document.fileName;
    if (!file) return;
    if (views.has(file)) return views.get(file).address && showPanel(views.get(file).address);
    const server = spawn(setting("command"), ["view", "-q", file], { cwd: path.dirname(file) });
    let text = "";
    views.set(file, server);
    server.stdout.on("data", (more) => {
      text += more;
      if (server.address || !text.includes("\n")) return;
      server.address = text.slice(0, text.indexOf("\n")).trim();
      showPanel(server.address, path.basename(file), () => server.kill());
    });
    server.on("error", (error) => { views.delete(file); vscode.window.showErrorMessage(error.message); });
    server.on("exit", () => views.delete(file));
  };
  const write = async () => {
    const editor = vscode.window.activeTextEditor, file = editor && editor.document.fileName;
    if (!file) return;
    const to = await vscode.window.showInputBox({ prompt: "The output's file: its ending says the format", value: file.replace(/\.vs$/, "") + ".stl" });
    if (!to) return;
    await editor.document.save();
    await new Promise((done) => execFile(setting("command"), ["--quiet", file, "-o", to], { cwd: path.dirname(file), maxBuffer: 1 << 24 }, (error, out, said) => {
      show(list, problems(said, path.dirname(file)));
      if (error) vscode.window.showErrorMessage(to + " was not written: " + (said.split("\n")[0] || error.message));
      else vscode.window.showInformationMessage("Wrote " + to);
      done();
    }));
  };
  context.subscriptions.push(list, looks, vscode.commands.registerCommand("visualscheme.write", write), vscode.commands.registerCommand("visualscheme.check", () => check(vscode.window.activeTextEditor && vscode.window.activeTextEditor.document)),
    vscode.commands.registerCommand("visualscheme.view", view), vscode.workspace.onDidSaveTextDocument((d) => { if (setting("checkOnSave") && !server) check(d); }),
    { dispose: () => { for (const server of views.values()) server.kill(); } });
}

module.exports = { activate, deactivate() {}, problems, findings, page, startServer };
