// Python, in a thread of its own: whoever runs away is ended with it.
import { loadPyodide } from "./pyodide/pyodide.mjs";

const fetched = fetch(new URL("python.zip", import.meta.url)).then((it) => it.arrayBuffer());

async function start() {
  const python = await loadPyodide({ indexURL: new URL("pyodide/", import.meta.url).href });
  const folder = "/lib/playground";
  python.unpackArchive(await fetched, "zip", { extractDir: folder });
  return python.runPython(`
import os, sys
sys.path.insert(0, "${folder}")
os.makedirs("/theories")
os.chdir("/theories")
from playground_answers import Playground
Playground().respond
`);
}

const ready = start();
ready.then(
  () => postMessage({ ready: true }),
  (error) => postMessage({ failed: String(error.message ?? error) }),
);

onmessage = async ({ data }) => {
  const respond = await ready;
  try {
    postMessage({ id: data.id, answer: JSON.parse(respond(JSON.stringify(data))) });
  } catch (error) {
    const said = String(error.message ?? error).trim().split("\n").at(-1);
    postMessage({ id: data.id, answer: { error: `ttr could not answer: ${said}` } });
  }
};
