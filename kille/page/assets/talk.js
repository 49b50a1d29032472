// The lesson as it was held: what was said, what came of it, and what can be answered.

import { byId, el, keepFocus } from "./dom.js";
import { percent, t } from "./texts.js";

const KEPT = 300; // turns on the page

export class Talk {
  /** `say(text)` says something for the tutor; `light(number, on)` shows a thing,
   *  `inspect(event)` what a turn did inside; `edit(text, first)` puts a text into the
   *  field, to be sent after another. */
  constructor(say, light, inspect, edit) {
    this.edit = edit;
    this.undo = "";
    this.inspect = inspect;
    this.say = say;
    this.light = light;
    this.list = byId("turns");
    this.waiting = new Map();
    this.answers = [];
    this.theories = [];
    new ResizeObserver(() => this.scroll()).observe(this.list);
  }

  /** What the theories of two robots are called; none where there is one robot. */
  name(theories) {
    this.theories = theories;
  }

  clear() {
    this.list.replaceChildren();
    this.waiting.clear();
    this.offer([]);
  }

  notice(text) {
    this.add(el("div", { class: "turn" }, el("p", { class: "notice" }, text)));
  }

  /** What the tutor has said or done. */
  heard({ ref, says, id, perhaps, arranges }) {
    const turn = el("div", { class: "turn turn--waiting" }, this.bubble(arranges ? "tutor bubble--deed" : "tutor", says));
    this.waiting.set(ref || id, turn);
    this.endLatest();
    this.undo = "";
    this.offer([]);
    if (perhaps?.length) turn.append(this.heardAs(perhaps));
    this.add(turn);
  }

  /** What was perhaps said: another text may be said instead, or be mended. */
  heardAs(perhaps) {
    const instead = ([says, p]) =>
      el(
        "button",
        { class: "chip chip--heard", type: "button", "aria-label": `${t("sayInstead", { says })} (${percent(p)})`, onclick: () => this.sayInstead(says) },
        el("span", {}, says),
        el("span", { class: "chip__degree" }, percent(p)),
      );
    const [[best, p], ...others] = perhaps;
    return el(
      "div",
      { class: "chips chips--heard", role: "group", "aria-label": t("heardAs") },
      el("span", { class: "chip chip--plain" }, `${t("heardAs")} ${percent(p)}`),
      ...others.map(instead),
      el("button", { class: "chip", type: "button", "aria-label": `${t("edit")}: ${best}`, onclick: () => this.edit(best, this.undo) }, t("edit")),
    );
  }

  /** Take back what was learned from a text that was not said, and say another. */
  sayInstead(text) {
    if (this.undo) this.say(this.undo);
    this.say(text);
  }

  /** So much of an answer was uttered before it was cut off. */
  uttered({ turn, text, whole }) {
    if (whole) return;
    const found = this.list.querySelector(`[data-event="${turn}"]`);
    const told = text ? t("cutOff", { text }) : t("cutAtOnce");
    found?.append(el("p", { class: "cut" }, told));
    this.scroll();
  }

  /** What came of it. */
  turn(event) {
    const turn = this.take(event);
    if (event.said) turn.dataset.event = event.id;
    turn.dataset.turn = event.turns[0];
    this.undo = event.undo;
    for (const line of paragraphs(event.said)) turn.append(this.bubble("robot", line));
    const chips = this.chips(event);
    if (chips.length) turn.append(el("div", { class: "chips" }, ...chips));
    if (event.rules.length) turn.append(this.rules(event));
    if (turn.childElementCount && !turn.isConnected && (event.said || event.lessons.length)) this.add(turn);
    this.offer(event.answers);
    this.scroll();
  }

  /** What came of it for the second robot: what it says, if that is not the same. */
  beside({ turns, said, lessons, failed }) {
    const name = this.theories[1];
    let turn = [...this.list.querySelectorAll(`[data-turn="${turns[0]}"]`)].at(-1);
    const ours = turn?.querySelectorAll(".bubble--robot") ?? [];
    const same = [...ours].map((it) => it.dataset.said).join("\n") === paragraphs(said).join("\n");
    if (same && !failed && (!turn || !said)) return;
    turn ??= el("div", { class: "turn", "data-turn": turns[0] });
    let made;
    if (failed) made = el("p", { class: "bubble bubble--wrong" }, `${name}: ${t("besideFailed")}`, el("span", { lang: "en" }, failed));
    else if (same) made = el("span", { class: "chip chip--plain" }, t("besideSame", { name }));
    else {
      const learned = lessons.map(({ holds, learned, word }) => `${learned ? "" : "↶ "}${holds ? "+" : "−"} ${word}`).join("  ");
      made = el(
        "p",
        { class: "bubble bubble--second" },
        el("b", { class: "bubble__name" }, name, learned ? el("span", {}, learned) : null),
        paragraphs(said).join("\n") || t("besideSilent"),
      );
    }
    const last = [...ours].at(-1) ?? turn.querySelector(".bubble");
    const chips = turn.querySelector(".chips:not(.chips--heard)");
    if (same && !failed && chips) chips.append(made);
    else if (last) last.after(made);
    else turn.append(made);
    if (!turn.isConnected) this.add(turn);
    this.scroll();
  }

  failed(event) {
    // That the camera is gone is told over the picture, too: once is enough.
    if (event.seen && !this.waiting.has(event.ref)) return;
    const turn = this.take(event);
    turn.append(el("p", { class: "bubble bubble--wrong" }, t("notDone"), el("span", { lang: "en" }, event.text)));
    if (!turn.isConnected) this.add(turn);
    this.scroll();
  }

  /** The turn that waits for this event, or a new one. */
  take({ ref }) {
    const turn = this.waiting.get(ref) ?? el("div", { class: "turn" });
    this.waiting.delete(ref);
    turn.classList.remove("turn--waiting");
    this.endLatest();
    return turn;
  }

  bubble(who, text) {
    const speaker = t(who.startsWith("tutor") ? "you" : "robot");
    return el("p", { class: `bubble bubble--${who}`, "data-said": text }, el("span", { class: "unseen" }, `${speaker}: `), text);
  }

  chips(event) {
    const made = event.lessons.map(({ holds, learned, word, phrase, content }) => {
      const told = `${learned ? "learned" : "takenBack"}${holds ? "" : "Not"}`;
      const kind = !learned ? "taken" : holds ? "for" : "against";
      return el(
        "span",
        { class: `chip chip--${kind}`, title: content },
        el(learned ? "span" : "s", { "aria-hidden": "true" }, `${holds ? "+" : "−"} ${word}`),
        el("span", { class: "unseen" }, t(told, { word: phrase })),
      );
    });
    if (event.thing && event.said) {
      const show = (on) => () => this.light(event.thing, on);
      const on = { onpointerenter: show(true), onpointerleave: show(false), onfocus: show(true), onblur: show(false) };
      made.unshift(el("button", { class: "chip", type: "button", ...on }, `#${event.thing}`));
    }
    if (event.said) made.push(el("span", { class: "chip chip--plain" }, took(event.ms)));
    if (event.undo) made.push(this.deed("undo", event.undo));
    if (event.why) made.push(this.deed("why", event.why));
    return made;
  }

  deed(name, says) {
    return el("button", { class: "chip chip--do", type: "button", onclick: () => this.say(says) }, t(name));
  }

  rules(event) {
    const { rules } = event;
    const items = rules.map(({ name, does }) => el("li", {}, el("b", {}, name), ` ${does}`));
    const inside = el("button", { class: "chip chip--inside", type: "button", onclick: () => this.inspect(event) }, t("inside"));
    return el("details", { class: "rules" }, el("summary", {}, t("rules")), el("ol", {}, ...items), inside);
  }

  /** "Undo" and "Why?" are about the latest turn: earlier ones lose theirs. */
  endLatest() {
    for (const it of this.list.querySelectorAll(".chip--do")) keepFocus(it, () => it.remove());
  }

  /** Offer answers to what the robot has asked. */
  offer(answers) {
    this.answers = answers;
    const bar = byId("answers");
    keepFocus(bar, () => bar.replaceChildren(...answers.map((it) => this.answer(it))));
    bar.hidden = answers.length === 0;
  }

  /** A button that says an answer; where that is the number of a thing, with its word. */
  answer({ says, thing, name }) {
    const show = (on) => () => thing && this.light(thing, on);
    const on = { onpointerenter: show(true), onpointerleave: show(false), onfocus: show(true), onblur: show(false) };
    return el("button", { class: "button", type: "button", ...on, onclick: () => this.say(says) }, name ? `${says} ${name}` : says);
  }

  /** What to say for a thing that is chosen, if the robot has asked which one. */
  answerFor(number) {
    return this.answers.find((it) => it.thing === number)?.says;
  }

  add(item) {
    this.list.append(item);
    while (this.list.childElementCount > KEPT) this.list.firstElementChild.remove();
    this.scroll();
  }

  scroll() {
    this.list.scrollTop = this.list.scrollHeight;
  }
}

/** The sentences of an answer; lines that begin with a space belong to the one before. */
function paragraphs(said) {
  const found = [];
  for (const line of said ? said.split("\n") : []) {
    if (line.startsWith(" ") && found.length) found[found.length - 1] += `\n${line.trim()}`;
    else found.push(line);
  }
  return found;
}

const took = (ms) => (ms < 1000 ? t("tookMs", { ms }) : t("took", { seconds: (ms / 1000).toFixed(1) }));
