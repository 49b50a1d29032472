// Runs the extension as VS Code would, as far as it asks anything of it.
// Arguments: the extension, the command `ttr`, a file, and where to hover: LINE COLUMN.
"use strict";

const fs = require("fs");
const Module = require("module");
const { pathToFileURL } = require("url");

const [extension, command, file, line, column] = process.argv.slice(2);
const uriOf = (text) => ({ scheme: text.split(":")[0], toString: () => text });
const value = (...names) =>
  class {
    constructor(...given) {
      names.forEach((name, n) => (this[name] = given[n]));
    }
  };
const subscription = { dispose() {} };
const providers = {};
const told = [];
let news = () => undefined;
const document = {
  uri: uriOf(pathToFileURL(file).href),
  languageId: file.split(".").pop(),
  version: 1,
  getText: () => fs.readFileSync(file, "utf8"),
};
const listen = () => subscription;
const provide = (kind) => (_, provider) => ((providers[kind] = provider), subscription);

const vscode = {
  Uri: { parse: uriOf },
  Range: value("line", "character", "endLine", "endCharacter"),
  Location: value("uri", "range"),
  Diagnostic: value("range", "message", "severity"),
  DiagnosticRelatedInformation: value("location", "message"),
  Hover: value("contents", "range"),
  MarkdownString: value("value"),
  CompletionItem: value("label", "kind"),
  DocumentSymbol: value("name", "detail", "kind", "range", "selectionRange"),
  window: { showWarningMessage: (text) => told.push(text) && news() },
  workspace: {
    getConfiguration: () => ({ get: () => command }),
    textDocuments: [document],
    onDidOpenTextDocument: listen,
    onDidChangeTextDocument: listen,
    onDidSaveTextDocument: listen,
    onDidCloseTextDocument: listen,
  },
  languages: {
    createDiagnosticCollection: () => ({
      set: (uri, found) => told.push(found) && news(),
      ...subscription,
    }),
    registerHoverProvider: provide("hover"),
    registerDefinitionProvider: provide("definition"),
    registerCompletionItemProvider: provide("completion"),
    registerDocumentSymbolProvider: provide("symbols"),
  },
};

const load = Module._load;
Module._load = (name, ...rest) => (name === "vscode" ? vscode : load(name, ...rest));

async function main() {
  const { activate, deactivate } = require(extension);
  const first = new Promise((resolve) => (news = resolve));
  await activate({ subscriptions: [] });
  await first;
  const place = { line: Number(line), character: Number(column) };
  const found = {
    told,
    hover: await providers.hover.provideHover(document, place),
    definition: await providers.definition.provideDefinition(document, place),
    completion: await providers.completion.provideCompletionItems(document, place),
    symbols: await providers.symbols.provideDocumentSymbols(document),
  };
  await deactivate();
  console.log(JSON.stringify(found));
}

main();
