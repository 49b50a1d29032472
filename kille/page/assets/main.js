// The lesson view: what comes from the robot goes to its part of the page, and back.

import { Connection } from "./connection.js";
import { byId, el, keepFocus } from "./dom.js";
import { Lab } from "./lab.js";
import { LivePicture } from "./picture.js";
import { Replay } from "./replay.js";
import { Region } from "./region.js";
import { Stepping } from "./stepping.js";
import { Table } from "./table.js";
import { Talk } from "./talk.js";
import { nameOf, setLanguage, t } from "./texts.js";
import { Things } from "./things.js";
import { Voice } from "./voice.js";

const picture = new LivePicture();
const things = new Things(choose);
const stepping = new Stepping((message) => connection.ask(message));
const replay = new Replay(picture, things);
const lab = new Lab((number, on) => things.light(number, on), replay, stepping.toggle);
const talk = new Talk(say, (number, on) => things.light(number, on), (event) => lab.choose(event), edit);
const table = new Table((message) => connection.ask(message));
const region = new Region(things, choose, (box) => connection.ask({ do: "point", box }));
const field = byId("text");
const HELD = 350; // milliseconds
const said = []; // by the tutor, for the arrow keys
let recalled = 0;
const unconfirmed = new Map(); // what was said and not answered yet, by its name
let language = "";
let meant = null; // the thing that the robot has just spoken of
let old = 0; // the last event that had happened before this page was open
let frozen = false;
let offered = ""; // what takes the latest lesson back
let undo = ""; // the same, while the robot is not at it
let instead = ""; // what is said first when the text in the field replaces what was heard

const connection = new Connection({
  state: (state) => {
    const link = byId("link");
    link.dataset.state = state === "full" ? "lost" : state;
    document.documentElement.dataset.link = link.dataset.state;
    link.textContent = t(state);
  },
  hello,
  /** Up to this event all is shown. */
  shown: (last) => {
    document.documentElement.dataset.shown = last;
    if (last >= old) document.documentElement.dataset.ready = "yes";
  },
  picture: (jpeg, done) => (frozen ? done() : picture.draw(jpeg, done)),
  voice: (turn, wav) => voice.playback.play(turn, wav),
  microphone: (event) => voice.microphone(event),
  listening: () => voice.listening(),
  taken: (event) => voice.taken(event),
  began: () => voice.began(),
  unheard: () => voice.unheard(),
  "sound-lost": () => voice.lost(),
  heard: (event) => {
    undo = "";
    talk.heard(event);
  },
  uttered: (event) => talk.uttered(event),
  stepping: (event) => stepping.switched(event),
  step: (event) => stepping.wait(event),
  turn: (event) => {
    stepping.over();
    things.settle();
    unconfirmed.delete(event.ref);
    if (event.said) voice.playback.expect(event.id, event.said.split("\n").length);
    offerUndo(event.undo_last);
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
    undo = offered;
    stepping.over();
    unconfirmed.delete(event.ref);
    talk.failed(event);
  },
  refused: (event) => {
    unconfirmed.delete(event.ref);
    talk.failed(event);
  },
  beside: (event) => {
    lab.addBeside(event);
    talk.beside(event);
  },
  view: (event) => {
    lab.addView(event);
    if (!replay.live(event)) return;
    things.show(event);
    region.settle();
    if (event.id > old && !event.glimpsed) things.mean(meant);
  },
  table: (event) => table.show(event),
  pointed: (event) => replay.live(event) && things.point(event),
  camera: ({ text }) => {
    // What a sensor complains of is English, whatever the page speaks.
    byId("trouble").replaceChildren(t("noPicture"), el("span", { lang: "en" }, text));
    byId("trouble").hidden = !text;
    byId("stage").classList.toggle("stage--stale", Boolean(text));
  },
});

const voice = new Voice(connection);
label("en");
byId("old").remove();

function hello(event, before) {
  if (event.language !== language) label(event.language);
  byId("facts").replaceChildren(
    ...[
      ["sensor", event.sensor],
      ["memory", event.memory],
      ["words", event.words],
      ["mode", nameOf("mode", event.mode)],
      ["language", nameOf("language", event.language)],
      ["microphone", ""],
    ].map(([name, value]) =>
      el("div", {}, el("dt", {}, t(name)), el("dd", { title: String(value), id: `fact-${name}` }, String(value))),
    ),
  );
  voice.hello(event);
  talk.name(event.theories);
  table.show(event.table);
  old = event.last;
  if (event.after === 0) {
    talk.clear();
    lab.clear();
    lab.beside.begin(event.theories);
    stepping.switched({ on: false });
    byId("trouble").hidden = true;
    byId("stage").classList.remove("stage--stale");
  }
  if (before && before !== event.run) {
    talk.notice(t("again"));
    for (const text of unconfirmed.values()) {
      talk.notice(t("unconfirmed", { text }));
      field.value ||= text;
    }
    unconfirmed.clear();
  }
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
  for (const [id, name] of [["picture", "picture"], ["things", "things"], ["seen", "seen"], ["talk", "talk"], ["turns", "talk"], ["answers", "answers"], ["tools", "tools"], ["deeds", "deeds"]])
    byId(id).setAttribute("aria-label", t(name));
  stepping.label();
  lab.label();
  voice.label();
  for (const [id, name] of [["freeze", "freeze"], ["undo", "undoLatest"], ["restart", "restart"]]) byId(id).textContent = t(name);
  byId("turns").dataset.hint = t("begin");
  field.placeholder = t("placeholder");
  byId("say").querySelector("label").textContent = t("say");
  byId("say").querySelector("button").textContent = t("send");
  table.label();
  byId("tools").replaceChildren(
    tool("look", () => connection.ask({ do: "look" })),
    tool("region", () => region.beginByKeys()),
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

/** What takes the latest lesson back, if anything does. */
function offerUndo(says) {
  undo = offered = says;
  const button = byId("undo");
  keepFocus(button, () => { button.disabled = !says; });
}

byId("undo").addEventListener("click", () => undo && say(undo));
byId("restart").addEventListener("click", () => connection.ask({ do: "restart" }));
byId("freeze").addEventListener("click", () => {
  frozen = !frozen;
  byId("freeze").setAttribute("aria-pressed", String(frozen));
  byId("stage").classList.toggle("stage--frozen", frozen);
  connection.watch(!frozen);
});

/** Put a text that was heard into the field; once sent, it replaces what was learned. */
function edit(text, first) {
  field.value = text;
  instead = first;
  field.focus();
}

function say(text) {
  voice.playback.stop();
  const ref = connection.ask({ do: "say", text });
  if (ref && text) unconfirmed.set(ref, text);
  return Boolean(ref);
}

byId("say").addEventListener("submit", (event) => {
  event.preventDefault();
  const text = field.value.trim();
  if (instead && text) say(instead);
  instead = "";
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

const typesIn = (element) => element.closest("input:not([type=range]), textarea, select");
let pressing = 0; // until a Space on a button is one that is held

document.addEventListener("keydown", (event) => {
  if (typesIn(event.target) || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === " ") {
    if (event.repeat) {
      if (voice.held) event.preventDefault();
      return;
    }
    // A short Space presses the button that has the focus, a long one is for talking.
    const other = event.target.closest("button:not(#hold), summary, input, a, [tabindex='0']");
    if (other) pressing = setTimeout(() => voice.press(), HELD);
    else {
      voice.press();
      event.preventDefault();
    }
    return;
  }
  if (event.target.closest("input")) return;
  if (/^[1-9]$/.test(event.key) && !replay.on) {
    const button = things.buttons.get(Number(event.key));
    button?.focus();
    button?.click();
  } else if (event.key === "r" || event.key === "R") region.beginByKeys();
  else if (event.key === "/") field.focus();
  else return;
  event.preventDefault();
});

document.addEventListener("keyup", (event) => {
  if (event.key !== " ") return;
  clearTimeout(pressing);
  if (!voice.held) return;
  event.preventDefault();
  voice.release();
});
