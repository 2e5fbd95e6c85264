// Starts `lacuna lsp` for Modelica files, and offers `make maps` and `lacuna check` as tasks. No logic of its own.
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

function settings() {
  const found = vscode.workspace.getConfiguration("lacuna");
  return { command: found.get("command"), libraries: found.get("libraries") };
}

function task(name, command, args) {
  const made = new vscode.Task(
    { type: "lacuna", task: name }, vscode.TaskScope.Workspace, name, "lacuna", new vscode.ProcessExecution(command, args)
  );
  made.presentationOptions = { reveal: vscode.TaskRevealKind.Always };
  return made;
}

async function activate(context) {
  const { command, libraries } = settings();
  const args = ["lsp", ...libraries.flatMap((folder) => ["--library", folder])];
  client = new LanguageClient("lacuna", "Lacuna", { command, args }, {
    documentSelector: [{ scheme: "file", language: "modelica" }],
  });
  context.subscriptions.push(
    vscode.tasks.registerTaskProvider("lacuna", {
      provideTasks: () => [task("maps", "make", ["maps"]), task("check", command, ["check", "${file}"])],
      resolveTask: () => undefined,
    })
  );
  await client.start();
}

function deactivate() {
  return client ? client.stop() : undefined;
}

module.exports = { activate, deactivate };
