// The client of `ttr lsp` for Visual Studio Code, without other packages.
"use strict";

const { spawn } = require("child_process");
const vscode = require("vscode");

const LANGUAGES = ["ttr", "dlg"];

let server = null;
let number = 0;
const waiting = new Map();

// --- messages ---------------------------------------------------------------------

function send(message) {
  if (server === null) return;
  const body = Buffer.from(JSON.stringify({ jsonrpc: "2.0", ...message }), "utf8");
  server.stdin.write(`Content-Length: ${body.length}\r\n\r\n`);
  server.stdin.write(body);
}

function notify(method, params) {
  send({ method, params });
}

function ask(method, params) {
  if (server === null) return Promise.resolve(null);
  const id = ++number;
  return new Promise((resolve) => {
    waiting.set(id, resolve);
    send({ id, method, params });
  });
}

function messages(stream, take) {
  let rest = Buffer.alloc(0);
  stream.on("data", (data) => {
    rest = Buffer.concat([rest, data]);
    for (;;) {
      const end = rest.indexOf("\r\n\r\n");
      if (end < 0) return;
      const header = /Content-Length: (\d+)/i.exec(rest.toString("latin1", 0, end));
      const length = header === null ? 0 : Number(header[1]);
      if (rest.length < end + 4 + length) return;
      const body = rest.toString("utf8", end + 4, end + 4 + length);
      rest = rest.subarray(end + 4 + length);
      if (body) take(JSON.parse(body));
    }
  });
}

function take(message, diagnostics) {
  if (message.method === "textDocument/publishDiagnostics") {
    const { uri, diagnostics: found } = message.params;
    diagnostics.set(vscode.Uri.parse(uri), found.map(diagnosticOf));
  } else if (message.method !== undefined && message.id !== undefined) {
    send({ id: message.id, result: null }); // nothing that it asks for is needed
  } else if (waiting.has(message.id)) {
    waiting.get(message.id)(message.result ?? null);
    waiting.delete(message.id);
  }
}

// --- from the protocol to VS Code ---------------------------------------------------

function rangeOf({ start, end }) {
  return new vscode.Range(start.line, start.character, end.line, end.character);
}

function locationOf({ uri, range }) {
  return new vscode.Location(vscode.Uri.parse(uri), rangeOf(range));
}

function diagnosticOf(found) {
  const one = new vscode.Diagnostic(rangeOf(found.range), found.message, found.severity - 1);
  one.source = found.source;
  one.relatedInformation = (found.relatedInformation ?? []).map(
    (it) => new vscode.DiagnosticRelatedInformation(locationOf(it.location), it.message),
  );
  return one;
}

function at(document, position) {
  return {
    textDocument: { uri: document.uri.toString() },
    position: { line: position.line, character: position.character },
  };
}

async function provideHover(document, position) {
  const found = await ask("textDocument/hover", at(document, position));
  if (found === null) return null;
  return new vscode.Hover(new vscode.MarkdownString(found.contents.value), rangeOf(found.range));
}

async function provideDefinition(document, position) {
  const found = await ask("textDocument/definition", at(document, position));
  return (found ?? []).map(locationOf);
}

async function provideCompletionItems(document, position) {
  const found = await ask("textDocument/completion", at(document, position));
  return (found ?? []).map((it) => {
    const item = new vscode.CompletionItem(it.label, it.kind - 1);
    item.detail = it.detail;
    return item;
  });
}

async function provideDocumentSymbols(document) {
  const found = await ask("textDocument/documentSymbol", {
    textDocument: { uri: document.uri.toString() },
  });
  return (found ?? []).map(
    (it) =>
      new vscode.DocumentSymbol(
        it.name, "", it.kind - 1, rangeOf(it.range), rangeOf(it.selectionRange),
      ),
  );
}

// --- documents ----------------------------------------------------------------------

function isOurs(document) {
  return LANGUAGES.includes(document.languageId) && document.uri.scheme === "file";
}

function open(document) {
  const { languageId, version } = document;
  const uri = document.uri.toString();
  const item = { uri, languageId, version, text: document.getText() };
  if (isOurs(document)) notify("textDocument/didOpen", { textDocument: item });
}

function change({ document }) {
  const textDocument = { uri: document.uri.toString(), version: document.version };
  const contentChanges = [{ text: document.getText() }];
  if (isOurs(document)) notify("textDocument/didChange", { textDocument, contentChanges });
}

function tell(method) {
  return (document) => {
    const textDocument = { uri: document.uri.toString() };
    if (isOurs(document)) notify(method, { textDocument });
  };
}

// --- the extension --------------------------------------------------------------------

async function activate(context) {
  const { workspace, languages, window } = vscode;
  const command = workspace.getConfiguration("ttr").get("command");
  const diagnostics = languages.createDiagnosticCollection("ttr");
  context.subscriptions.push(diagnostics);
  const started = spawn(command, ["lsp"], { stdio: ["pipe", "pipe", "ignore"] });
  const ended = (why) => {
    if (server !== started) return;
    server = null;
    for (const resolve of waiting.values()) resolve(null);
    waiting.clear();
    window.showWarningMessage(
      `${command} lsp ${why}: theories are coloured, but not checked. ` +
        "Install pip install 'kille[editor]', or set ttr.command.",
    );
  };
  server = started;
  started.on("error", (error) => ended(`cannot be started (${error.code})`));
  started.on("exit", () => ended("has ended"));
  started.stdin.on("error", () => undefined); // it has ended, which is told above
  messages(started.stdout, (message) => take(message, diagnostics));
  await ask("initialize", { processId: process.pid, rootUri: null, capabilities: {} });
  notify("initialized", {});
  context.subscriptions.push(
    languages.registerHoverProvider(LANGUAGES, { provideHover }),
    languages.registerDefinitionProvider(LANGUAGES, { provideDefinition }),
    languages.registerCompletionItemProvider(LANGUAGES, { provideCompletionItems }, "."),
    languages.registerDocumentSymbolProvider(LANGUAGES, { provideDocumentSymbols }),
    workspace.onDidOpenTextDocument(open),
    workspace.onDidChangeTextDocument(change),
    workspace.onDidSaveTextDocument(tell("textDocument/didSave")),
    workspace.onDidCloseTextDocument(tell("textDocument/didClose")),
  );
  workspace.textDocuments.forEach(open);
}

async function deactivate() {
  const ending = server;
  if (ending === null) return;
  await ask("shutdown", undefined);
  notify("exit", undefined);
  server = null;
  ending.stdin.end();
}

module.exports = { activate, deactivate };
