// The page: what is asked, and what is shown of the answers.
import { byId, drawn, el } from "./dom.js";
import * as editor from "./editor.js";
import { fragmentOf, textOf } from "./links.js";
import { Python } from "./python.js";

const STATES = { loading: "Python is being loaded …", busy: "Working …", ready: "Ready", failed: "Python cannot be loaded here" };
const python = new Python(tell);
let examples = [];

function tell(state, why = "") {
  document.documentElement.dataset.state = state;
  byId("status").textContent = why ? `${STATES[state]}: ${why}` : STATES[state];
  byId("status").dataset.state = state;
  byId("stop").disabled = state !== "busy";
  byId("check").disabled = state === "failed";
}

function complain(message = "") {
  byId("trouble").textContent = message;
  byId("trouble").hidden = !message;
}

// --- checking ---

async function check() {
  complain();
  const asked = editor.text();
  const found = await python.ask({ do: "check", text: asked });
  if (!found) return complain("Stopped. Nothing was checked.");
  if (asked !== editor.text()) return;
  if (found.error) return complain(found.error);
  byId("summary").textContent = found.summary;
  byId("summary").dataset.holds = found.holds;
  showMistakes([...found.mistakes.map((it) => ({ ...it, sort: "error" })), ...(found.faults ?? []).map((it) => ({ ...it, sort: it.severity }))]);
  showAnswers(found.answers ?? []);
  showDefinitions(found.definitions ?? [], found.more ?? 0);
  byId("games").hidden = !found.games.length;
  byId("game").replaceChildren(...found.games.map((it) => el("option", { value: it }, it)));
  byId("played").replaceChildren();
  byId("tested").replaceChildren();
  byId("back").disabled = true;
  document.documentElement.dataset.checked = String(Number(document.documentElement.dataset.checked ?? 0) + 1);
}

function place(it, ...inside) {
  if (!it.line) return el("span", {}, ...inside);
  return el("button", { class: "place", type: "button", onclick: () => editor.show(it) }, `line ${it.line}: `, ...inside);
}

function showMistakes(found) {
  editor.setMarks(found);
  byId("mistakes").replaceChildren(
    ...found.map((it) =>
      el("li", { class: `mistake mistake--${it.sort}` }, place(it, it.message), it.help && el("span", { class: "help" }, it.help)),
    ),
  );
}

function showAnswers(found) {
  byId("answers").hidden = !found.length;
  byId("answers-list").replaceChildren(
    ...found.map((it) => {
      const mark = el("span", { class: it.holds ? "good" : "bad", title: it.holds ? "as claimed" : "not as claimed" }, it.holds ? "✓" : "✗");
      const told = it.holds ? it.found : `expected ${it.expected}, found ${it.found}`;
      const head = [mark, el("code", {}, it.text), el("span", { class: "found" }, told)];
      if (!it.html && !it.why) return el("li", { class: "answer" }, el("div", { class: "answer__head" }, ...head));
      const why = it.html ? drawn(it.html) : el("pre", { class: "why" }, it.why);
      return el("li", { class: "answer" }, el("details", { open: !it.holds }, el("summary", { class: "answer__head" }, ...head), why));
    }),
  );
}

function showDefinitions(found, more) {
  byId("definitions").hidden = !found.length;
  const rows = found.flatMap((it) => [el("dt", {}, it.name), el("dd", {}, it.html ? drawn(it.html) : it.text)]);
  if (more) rows.push(el("dt", {}, "…"), el("dd", {}, `${more} more`));
  byId("definitions-list").replaceChildren(...rows);
}

// --- games ---

async function ask(request, show) {
  complain();
  const found = await python.ask(request);
  if (!found) return complain("Stopped. Check the theory again to go on.");
  if (found.error) return complain(found.error);
  return show(found);
}

function showGame(found) {
  const turns = found.turns.map((turn) =>
    el(
      "li",
      { class: "turn" },
      el("code", { class: "turn__heard" }, `> ${turn.heard}`),
      ...turn.steps.map((step) =>
        el("details", { class: "step" }, el("summary", {}, el("b", {}, step.rule), el("span", { class: "found" }, step.changes.join("; ") || "nothing changes")), drawn(step.state)),
      ),
      ...turn.said.map((it) => el("code", { class: "turn__said" }, `< ${it}`)),
    ),
  );
  const offers = found.offers.map((it, number) =>
    el("button", { class: "button button--offer", type: "button", onclick: () => ask({ do: "move", move: number }, showGame) }, it),
  );
  byId("played").replaceChildren(
    el("ol", { class: "turns" }, ...turns),
    el("h3", {}, turns.length ? "The state now" : "The state at the start"),
    drawn(found.state),
    el("div", { class: "tools", role: "group", "aria-label": "Moves" }, ...(offers.length ? offers : ["No rule takes any move here."])),
  );
  byId("back").disabled = !turns.length;
}

function showTest(found) {
  byId("tested").replaceChildren(
    el("p", { class: found.holds ? "good" : "bad" }, found.summary),
    found.story ? el("pre", { class: "why" }, found.story) : "",
    el("details", {}, el("summary", {}, "What was covered"), el("pre", { class: "why" }, found.coverage)),
  );
}

const numberIn = (id) => Math.trunc(Number(byId(id).value)) || 0;

byId("check").addEventListener("click", check);
byId("stop").addEventListener("click", () => python.stop());
byId("play").addEventListener("click", () => ask({ do: "play", game: byId("game").value }, showGame));
byId("back").addEventListener("click", () => ask({ do: "back" }, showGame));
byId("test").addEventListener("click", () =>
  ask({ do: "test", game: byId("game").value, seed: numberIn("seed"), examples: numberIn("examples-count") }, showTest),
);
document.addEventListener("keydown", (event) => {
  if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) check();
});

// --- links and examples ---

byId("copy").addEventListener("click", async () => {
  complain();
  try {
    const fragment = await fragmentOf(editor.text());
    history.replaceState(null, "", `#${fragment}`);
    await navigator.clipboard?.writeText(location.href).catch(() => undefined);
    byId("status").textContent = "The link is in the address bar, and copied";
  } catch (error) {
    complain(error.message);
  }
});
byId("examples").addEventListener("change", () => {
  const chosen = examples.find((it) => it.name === byId("examples").value);
  if (chosen) open(chosen.text);
  byId("examples").value = "";
});

function open(text) {
  history.replaceState(null, "", location.pathname + location.search);
  editor.setText(text);
  return check();
}

async function openLink() {
  try {
    editor.setText(await textOf(location.hash.slice(1)));
  } catch (error) {
    return complain(error.message);
  }
  return check();
}

editor.onChange(() => complain());
window.addEventListener("hashchange", () => location.hash && openLink());
examples = await (await fetch("examples.json")).json();
for (const group of new Set(examples.map((it) => it.group))) {
  const inside = examples.filter((it) => it.group === group);
  byId("examples").append(el("optgroup", { label: group }, ...inside.map((it) => el("option", { value: it.name }, it.title))));
}
if (location.hash) openLink();
else open(examples.find((it) => it.name === "kennel").text);

/** For tests: what `ttr check` prints about a file. */
window.commandOutput = (file, text) => python.ask({ do: "command", file, text });
