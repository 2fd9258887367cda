// Starts `pelea lsp` and hands it the settings. Everything else is the server's work.
"use strict";

const vscode = require("vscode");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");

/** @type {LanguageClient | undefined} */
let client;

/** The settings that the server knows, under its own names. */
function options() {
  const settings = vscode.workspace.getConfiguration("pelea");
  const keys = ["lints", "lintDelay", "codeLens", "planTimeout", "planSearch", "maxFiles", "maxFileBytes"];
  return Object.fromEntries(keys.map((key) => [key, settings.get(key)]));
}

async function start() {
  const command = vscode.workspace.getConfiguration("pelea").get("path") || "pelea";
  const run = { command, args: ["lsp"], transport: TransportKind.stdio };
  client = new LanguageClient("pelea", "pelea", { run, debug: run }, {
    // Not what other extensions show, such as the last commit's text of a file.
    documentSelector: ["pddl", "hddl", "plan"].flatMap((language) =>
      ["file", "untitled"].map((scheme) => ({ scheme, language })),
    ),
    initializationOptions: options(),
  });
  try {
    await client.start();
  } catch (error) {
    vscode.window.showErrorMessage(`pelea: cannot start \`${command} lsp\`: ${error}. Is \`pelea.path\` right?`);
  }
}

/** @param {vscode.ExtensionContext} context */
async function activate(context) {
  context.subscriptions.push(
    vscode.workspace.onDidChangeConfiguration(async (event) => {
      if (!event.affectsConfiguration("pelea")) return;
      if (event.affectsConfiguration("pelea.path")) {
        await deactivate();
        await start();
      } else {
        await client?.sendNotification("workspace/didChangeConfiguration", { settings: options() });
      }
    }),
  );
  await start();
}

async function deactivate() {
  if (client?.isRunning()) await client.stop();
  client = undefined;
}

module.exports = { activate, deactivate };
