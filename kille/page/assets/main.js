// The lesson view: what comes from the robot goes to its part of the page, and back.

import { Connection } from "./connection.js";
import { byId, el } from "./dom.js";
import { Lab } from "./lab.js";
import { LivePicture } from "./picture.js";
import { Replay } from "./replay.js";
import { Region } from "./region.js";
import { Table } from "./table.js";
import { Talk } from "./talk.js";
import { setLanguage, t } from "./texts.js";
import { Things } from "./things.js";

const picture = new LivePicture();
const things = new Things(choose);
const replay = new Replay(picture, things);
const lab = new Lab((number, on) => things.light(number, on), replay);
const talk = new Talk(say, (number, on) => things.light(number, on), (event) => lab.choose(event));
const table = new Table((message) => connection.ask(message));
const region = new Region(things, choose, (box) => connection.ask({ do: "point", box }));
const field = byId("text");
const said = []; // by the tutor, for the arrow keys
let recalled = 0;
let unconfirmed = null;
let language = "";
let meant = null; // the thing that the robot has just spoken of
let old = 0; // the last event that had happened before this page was open

label("en");
const connection = new Connection({
  state: (state) => {
    const link = byId("link");
    link.dataset.state = state === "full" ? "lost" : state;
    document.documentElement.dataset.link = link.dataset.state;
    link.textContent = t(state);
  },
  hello,
  picture: (jpeg, done) => picture.draw(jpeg, done),
  heard: (event) => talk.heard(event),
  turn: (event) => {
    confirm(event.ref);
    lab.add(event);
    talk.turn(event);
    meant = event.said ? event.thing : null;
    count("words", event.words);
  },
  restarted: () => {
    talk.endLatest();
    talk.notice(t("anew"));
  },
  failed: (event) => {
    confirm(event.ref);
    talk.failed(event);
  },
  refused: (event) => {
    confirm(event.ref);
    talk.failed(event);
  },
  view: (event) => {
    lab.addView(event);
    if (!replay.live(event)) return;
    things.show(event);
    region.cancel();
    if (event.id > old) things.mean(meant);
  },
  table: (event) => table.show(event),
  pointed: (event) => replay.live(event) && things.point(event),
  camera: ({ text }) => {
    byId("trouble").textContent = text;
    byId("trouble").hidden = !text;
    byId("stage").classList.toggle("stage--stale", Boolean(text));
  },
});

function hello(event, before) {
  if (event.language !== language) label(event.language);
  byId("facts").replaceChildren(
    ...[["sensor", event.sensor], ["memory", event.memory], ["words", event.words]].map(([name, value]) =>
      el("div", {}, el("dt", {}, t(name)), el("dd", { title: String(value), id: `fact-${name}` }, String(value))),
    ),
  );
  table.show(event.table);
  old = event.last;
  if (event.after === 0) {
    talk.clear();
    lab.clear();
    byId("trouble").hidden = true;
    byId("stage").classList.remove("stage--stale");
  }
  if (before && before !== event.run) {
    talk.notice(t("again"));
    if (unconfirmed && !field.value) {
      field.value = unconfirmed.text;
      talk.notice(t("unconfirmed"));
    }
    unconfirmed = null;
  }
  document.documentElement.dataset.ready = "yes";
}

function count(fact, number) {
  const shown = byId(`fact-${fact}`);
  if (shown) shown.textContent = shown.title = String(number);
}

/** The texts of the page in a language. */
function label(spoken) {
  language = spoken;
  setLanguage(spoken);
  const link = byId("link");
  link.textContent = t(link.dataset.state);
  for (const [id, name] of [["picture", "picture"], ["things", "things"], ["seen", "seen"], ["talk", "talk"], ["turns", "talk"], ["answers", "answers"], ["tools", "tools"]])
    byId(id).setAttribute("aria-label", t(name));
  byId("empty").textContent = t("empty");
  lab.label();
  byId("turns").dataset.hint = t("begin");
  field.placeholder = t("placeholder");
  byId("say").querySelector("label").textContent = t("say");
  byId("say").querySelector("button").textContent = t("send");
  table.label();
  byId("tools").replaceChildren(
    tool("look", () => connection.ask({ do: "look" })),
    tool("region", () => region.beginByKeys()),
    tool("restart", () => connection.ask({ do: "restart" })),
    el("span", { class: "tools__hint" }, t("hint")),
  );
}

function tool(name, onclick) {
  return el("button", { class: "button", type: "button", onclick }, t(name));
}

/** A thing is clicked: it answers which one was meant, or it is "this" or "that". */
function choose(number) {
  const answer = talk.answerFor(number);
  if (answer) {
    say(answer);
    return;
  }
  connection.ask({ do: "point", thing: number, ...(things.isSecond(number) && { as: "that" }) });
}

function say(text) {
  const ref = connection.ask({ do: "say", text });
  if (ref) unconfirmed = { ref, text };
  return Boolean(ref);
}

function confirm(ref) {
  if (unconfirmed?.ref === ref) unconfirmed = null;
}

byId("say").addEventListener("submit", (event) => {
  event.preventDefault();
  const text = field.value.trim();
  if (!say(text)) return;
  if (text) said.push(text);
  recalled = said.length;
  field.value = "";
});

field.addEventListener("keydown", (event) => {
  if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
  recalled = Math.max(0, Math.min(said.length, recalled + (event.key === "ArrowUp" ? -1 : 1)));
  field.value = said[recalled] ?? "";
  event.preventDefault();
});

document.addEventListener("keydown", (event) => {
  const typing = event.target.closest("input, textarea, select");
  if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
  if (/^[1-9]$/.test(event.key) && !replay.on) {
    const button = things.buttons.get(Number(event.key));
    button?.focus();
    button?.click();
  } else if (event.key === "r" || event.key === "R") region.beginByKeys();
  else if (event.key === "/") field.focus();
  else return;
  event.preventDefault();
});
