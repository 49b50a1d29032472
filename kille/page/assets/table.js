// The table by hand: a plan on which things are dragged and turned, what can be put on it,
// or a slider through a recording.

import { byId, el, renewChildren, svg } from "./dom.js";
import { t } from "./texts.js";

const STEP = 0.01; // metres that an arrow key moves; with Shift five times as far
const TURN = 15; // degrees
const PAUSE = 350; // ms after a key before the robot is told

export class Table {
  /** `ask(message)` has the scene changed. */
  constructor(ask) {
    this.ask = ask;
    this.frame = byId("table");
    this.body = byId("table-body");
    this.buttons = new Map();
    this.shapes = new Map();
    this.table = { things: [], plan: null, recording: null };
    this.held = null;
    this.timer = 0;
  }

  label() {
    this.frame.querySelector("summary").textContent = t(this.table.recording ? "wind" : "table");
    this.show(this.table);
  }

  show(table) {
    this.table = table;
    const { things, plan, recording } = table;
    this.frame.hidden = !(things.length || recording);
    this.frame.querySelector("summary").textContent = t(recording ? "wind" : "table");
    byId("empty").textContent = t(plan ? "emptyTable" : "empty");
    if (this.held || this.timer) return; // what is being moved stays in the hand
    if (recording) this.showRecording(recording);
    else if (plan) this.showPlan(plan, things);
    else renewChildren(this.body, this.catalogue(things, "show", "show"));
  }

  // --- a recording ---

  showRecording({ length, at }) {
    const name = () => t("moment", { at: Number(slider.value).toFixed(1), length: length.toFixed(1) });
    const shown = el("output", { class: "table__moment" });
    const slider = el("input", {
      type: "range", min: 0, max: length, step: Math.max(0.01, length / 500), value: at, "aria-label": t("wind"),
      oninput: () => { shown.textContent = name(); slider.setAttribute("aria-valuetext", name()); },
      onchange: () => this.ask({ do: "seek", at: Math.min(length, Number(slider.value)) }),
    });
    shown.textContent = name();
    slider.setAttribute("aria-valuetext", name());
    const focused = document.activeElement?.parentElement === this.body && document.activeElement.type === "range";
    this.body.replaceChildren(slider, shown);
    if (focused) slider.focus();
  }

  // --- a plan ---

  showPlan(plan, things) {
    const focused = this.body.contains(document.activeElement) ? document.activeElement.dataset.key : undefined;
    this.plan = { ...plan, placed: plan.placed.map((it) => ({ ...it })) };
    const [left, near, right, far] = plan.table;
    const drawing = svg("svg", { class: "plan__drawing", viewBox: `${left} ${-far} ${right - left} ${far - near}`, "aria-hidden": "true" });
    this.shapes = new Map(this.plan.placed.map((it) => [it.name, this.shape(it)]));
    this.buttons = new Map(this.plan.placed.map((it) => [it.name, this.button(it)]));
    drawing.append(...this.grid(), ...this.shapes.values());
    this.board = el("div", { class: "plan", role: "group", "aria-label": t("plan") }, drawing, ...this.buttons.values(), el("span", { class: "plan__robot" }, t("robot")));
    this.board.style.aspectRatio = `${right - left} / ${far - near}`;
    const present = new Set(plan.placed.map((it) => it.name));
    this.body.replaceChildren(
      this.board,
      el("div", { class: "table__beside" }, this.catalogue(things.filter((it) => !present.has(it)), "add", "add"), el("p", { class: "tools__hint" }, t("planHint"))),
    );
    for (const it of this.plan.placed) this.lay(it);
    // What was put there can be moved at once.
    if (focused) (this.buttons.get(focused) ?? this.body.querySelector("button"))?.focus();
  }

  /** Lines half a metre apart through the middle of the table. */
  grid() {
    const [left, near, right, far] = this.plan.table;
    const line = (x1, y1, x2, y2) => svg("line", { class: "plan__line", x1, y1: -y1, x2, y2: -y2 });
    return [-0.5, 0, 0.5].flatMap((at) => [line(at, near, at, far), line(left, at, right, at)]);
  }

  shape(thing) {
    return svg("polygon", { class: "plan__shape", points: thing.outline.map(([x, y]) => `${x},${-y}`).join(" ") });
  }

  button(thing) {
    const { name } = thing;
    return el("button", {
      class: "plan__thing", type: "button", "data-placed": name, "data-key": name, "aria-description": t("planHint"),
      onkeydown: (event) => this.key(event, thing),
      onpointerdown: (event) => this.take(event, thing),
      onpointermove: (event) => this.drag(event, thing),
      onpointerup: () => this.drop(thing),
      onpointercancel: () => { this.held = null; this.show(this.table); },
    }, name);
  }

  /** Draw a thing where it is. */
  lay(thing) {
    const { name, right, away, turn } = thing;
    const [left, near, end, far] = this.plan.table;
    this.shapes.get(name).setAttribute("transform", `translate(${right} ${-away}) rotate(${-turn})`);
    const button = this.buttons.get(name);
    button.style.left = `${((right - left) / (end - left)) * 100}%`;
    button.style.top = `${((far - away) / (far - near)) * 100}%`;
    button.setAttribute("aria-label", t("placed", { thing: name, right: cm(right), away: cm(away), turn: Math.round(turn) }));
  }

  /** The spot on the table at a place of the screen. */
  spot(event) {
    const [left, near, right, far] = this.plan.table;
    const board = this.board.getBoundingClientRect();
    return {
      right: left + ((event.clientX - board.left) / board.width) * (right - left),
      away: far - ((event.clientY - board.top) / board.height) * (far - near),
    };
  }

  take(event, thing) {
    if (event.button !== 0) return;
    const at = this.spot(event);
    this.held = { right: thing.right - at.right, away: thing.away - at.away, moved: false };
    event.currentTarget.setPointerCapture(event.pointerId);
  }

  drag(event, thing) {
    if (!this.held) return;
    const at = this.spot(event);
    this.held.moved = true;
    this.moveTo(thing, at.right + this.held.right, at.away + this.held.away);
  }

  drop(thing) {
    const moved = this.held?.moved;
    this.held = null;
    if (moved) this.tell(thing);
  }

  key(event, thing) {
    const by = event.shiftKey ? STEP * 5 : STEP;
    const moves = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, by], ArrowDown: [0, -by] };
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (moves[event.key]) this.moveTo(thing, thing.right + moves[event.key][0], thing.away + moves[event.key][1]);
    else if (event.key === "r" || event.key === "R") {
      thing.turn = (thing.turn + (event.key === "R" ? -TURN : TURN) + 360) % 360;
      this.lay(thing);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      clearTimeout(this.timer);
      this.timer = 0;
      this.ask({ do: "remove", thing: thing.name });
    } else return;
    event.preventDefault();
    event.stopPropagation();
    if (event.key === "Delete" || event.key === "Backspace") return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.tell(thing), PAUSE);
  }

  moveTo(thing, right, away) {
    const [left, near, end, far] = this.plan.table;
    thing.right = Math.max(left, Math.min(end, right));
    thing.away = Math.max(near, Math.min(far, away));
    this.lay(thing);
  }

  tell({ name, right, away, turn }) {
    this.timer = 0;
    this.ask({ do: "place", thing: name, right, away, turn });
  }

  // --- what can be put there ---

  catalogue(names, verb, text) {
    return el(
      "div",
      { class: "table__things", role: "group", "aria-label": t("catalogue") },
      ...names.map((thing) =>
        el("button", { class: "button", type: "button", "data-key": thing, "aria-label": t(text, { thing }), onclick: () => this.ask({ do: verb, thing }) }, thing),
      ),
    );
  }
}

const cm = (metres) => Math.round(metres * 100);
