// The lab: what each turn did to the information state, chosen on a timeline.

import { Beside } from "./side_by_side.js";
import { byId, el, matrix, renewChildren } from "./dom.js";
import { lookUp } from "./look_up.js";
import { Shelf } from "./word_shelf.js";
import { brief, nameOf, t } from "./texts.js";
import { unfired } from "./unfired_rules.js";

const KEPT = 200; // turns that can be looked at, with their pictures

export class Lab {
  /** `light(number, on)` shows a thing in the picture; `replay` what was in view.
   *  `tools` are buttons that the lab has room for. */
  constructor(light, replay, ...tools) {
    this.tools = tools;
    this.replay = replay;
    this.turns = [];
    this.dropped = 0;
    this.views = new Map();
    this.shelf = new Shelf(byId("shelf"));
    this.beside = new Beside();
    this.shown = -1;
    this.folded = new Map();
    this.save = el("details", { class: "save" });
    this.toggle = byId("lab-toggle");
    this.timeline = byId("timeline");
    for (const it of ["pointerover", "pointerout"])
      byId("lab-body").addEventListener(it, (event) => this.point(event, light));
    this.now = el("button", { class: "button", type: "button", hidden: true, onclick: () => this.show(this.turns.length - 1) });
    document.addEventListener("keydown", (event) => event.key === "Escape" && this.replay.on && this.now.click());
    this.toggle.addEventListener("click", () => this.open(byId("lab").hidden));
    this.timeline.addEventListener("input", () => this.show(Number(this.timeline.value) - 1));
  }

  /** Have a thing of the picture light up while the pointer is on its name, "o2". */
  point(event, light) {
    const text = event.target.childElementCount ? "" : event.target.textContent;
    const number = /(?:^|\W)o(\d{1,4})$/.exec(text.trim())?.[1];
    if (number) light(Number(number), event.type === "pointerover");
  }

  label() {
    this.toggle.textContent = t("lab");
    byId("lab").setAttribute("aria-label", t("lab"));
    this.timeline.setAttribute("aria-label", t("timeline"));
    this.shelf.label();
    byId("lab-tools").replaceChildren(...this.tools, this.now, this.save);
    this.now.textContent = t("now");
    this.offerFiles();
    this.title();
  }

  open(on) {
    byId("lab").hidden = !on;
    this.toggle.setAttribute("aria-pressed", String(on));
    document.documentElement.classList.toggle("with-lab", on);
    this.show(this.turns.length - 1);
  }

  clear() {
    this.turns = [];
    this.dropped = 0;
    this.views.clear();
    this.shown = -1;
    this.replay.end();
    byId("lab-body").replaceChildren();
    this.title();
  }

  /** A turn was taken; the lab follows, unless an earlier one is looked at. */
  add(event) {
    if (!event.turns || event.turns[0] === event.turns[1]) return;
    if (event.lessons.length) this.shelf.reload();
    const follows = this.shown === this.turns.length - 1;
    this.turns.push(event);
    if (this.turns.length > KEPT) this.drop();
    this.timeline.max = this.turns.length;
    if (byId("lab").hidden) this.shown = this.turns.length - 1;
    else if (follows) this.show(this.turns.length - 1);
  }

  /** What was in view after the turn that was just taken. */
  addView(event) {
    const turn = this.turns.at(-1);
    if (turn && turn.ref === event.ref && !event.glimpsed) this.views.set(turn, event);
  }

  /** What came of it for the second robot. */
  addBeside(event) {
    this.beside.add(event);
    const turn = this.turns[this.shown];
    const shown = byId("lab-body").querySelector(".beside");
    if (shown && turn?.turns[0] === event.turns[0]) this.beside.fill(shown, turn, this.views.get(turn));
  }

  /** Forget the earliest turn. */
  drop() {
    const first = this.turns.shift();
    this.beside.forget(first);
    this.views.delete(first);
    this.dropped += 1;
    if (this.shown > 0) this.shown -= 1;
    this.timeline.value = this.shown + 1;
  }

  /** Show the turn of which the talk shows this event. */
  choose(event) {
    this.open(true);
    this.show(this.turns.indexOf(event));
  }

  title() {
    const turn = this.turns[this.shown];
    const number = this.dropped + this.shown + 1;
    const heard = turn ? turn.heard || t("looked") : "";
    const title = turn ? t("turn", { number, heard }) : t("noTurn");
    byId("lab-title").textContent = byId("lab-title").title = title;
    this.timeline.setAttribute("aria-valuetext", title);
    return title;
  }

  /** Where the turn that is shown, and the dialogue, can be had as files. */
  offerFiles() {
    const file = (name, under, kind) =>
      el("a", { class: "chip", href: `/export${under}/${kind}`, download: true, "data-key": `${name} ${kind}`, "aria-label": `${t(name)}: ${t(kind)}` }, t(kind));
    const row = (name, under) =>
      el("p", { class: "save__row" }, el("span", {}, t(name)), ...["dlg", "log", "tex"].map((kind) => file(name, under, kind)));
    const turn = this.turns[this.shown];
    const rows = [...(turn ? [row("saveTurn", `/${turn.turns.join("/")}`)] : []), row("saveAll", "")];
    renewChildren(this.save, el("summary", { "data-key": "save" }, t("save")), ...rows);
  }

  /** Show in the picture what was in view in a turn, or what is in view now. */
  showView(turn, title) {
    const view = this.views.get(turn);
    if (view && turn !== this.turns.at(-1) && !byId("lab").hidden) this.replay.show(turn, view, title);
    else this.replay.end();
    const left = document.activeElement === this.now;
    this.now.hidden = !this.replay.on;
    if (left && this.now.hidden) this.timeline.focus();
  }

  async show(index) {
    const turn = this.turns[index];
    this.shown = index;
    this.timeline.value = index + 1;
    this.showView(turn, this.title());
    this.offerFiles();
    if (!turn || byId("lab").hidden) return;
    const body = byId("lab-body");
    body.inert = true; // it shows another turn as yet: what is unfolded there would be lost
    const answer = await lookUp(`/inside/${turn.turns.join("/")}`);
    const found = answer.ok ? await answer.json() : null;
    if (this.shown !== index) return;
    body.inert = false;
    if (!found) {
      body.replaceChildren(el("p", { class: "part__empty" }, t(answer.status === 404 ? "gone" : "notNow")));
      return;
    }
    const { lines, steps, state } = found;
    const parts = [this.beside.section(turn, this.views.get(turn)), this.account(lines, steps), steps.length ? unfired(turn) : null, ...state.map((part) => this.part(part))];
    body.replaceChildren(...parts.filter(Boolean));
  }

  /** The derivation: what was heard, each rule with its changes, what was judged and said. */
  account(lines, steps) {
    const made = el("section", { class: "part" }, el("h3", {}, t("derivation")));
    let changes = null;
    if (!lines.length) made.append(el("p", { class: "part__empty" }, t("noRule")));
    const fired = steps.values();
    for (const [kind, text] of lines) {
      if (kind === "rule") {
        changes = el("ul", { class: "step__changes" });
        made.append(this.step(text, fired.next().value, changes));
      } else if (kind === "" && changes) changes.append(el("li", {}, brief(text)));
      else made.append(el("p", { class: "line" }, el("span", { class: "line__kind" }, nameOf("line", kind)), el("span", {}, brief(text))));
    }
    return made;
  }

  /** A rule that fired: its name, what it is for, and on demand the event and the state
   *  that it was for, what it has bound, and what it changed. */
  step(text, { on, when, bindings }, changes) {
    const row = (name, value) => (value ? [el("dt", {}, name), el("dd", {}, brief(value))] : []);
    const [name, ...does] = text.split(": ");
    return el(
      "details",
      { class: "step" },
      el("summary", {}, el("b", {}, name), ` ${does.join(": ")}`),
      el("dl", { class: "step__why" }, ...row(t("on"), on), ...row(t("when"), when), ...bindings.flatMap(([name, value]) => row(`${name} =`, value))),
      changes,
    );
  }

  part({ name, fields }) {
    const full = fields.filter((it) => !it.empty || it.changed);
    const empty = fields.filter((it) => it.empty && !it.changed).map((it) => it.name);
    return el(
      "section",
      { class: "part" },
      el("h3", {}, t(name)),
      ...full.map((field) => this.field(name, field)),
      empty.length ? el("p", { class: "part__empty" }, t("empties", { names: empty.join(", ") })) : null,
    );
  }

  /** A field as a matrix that folds; what has changed is open, unless it was folded. */
  field(part, { name, changed, html }) {
    const key = `${part}.${name}`;
    const made = el(
      "details",
      { class: `field${changed ? " field--changed" : ""}`, open: this.folded.get(key) ?? changed },
      el("summary", {}, name, changed ? el("span", { class: "field__mark" }, t("changed")) : null),
      matrix(html),
    );
    made.querySelector("summary").addEventListener("click", () => this.folded.set(key, !made.open));
    return made;
  }
}
