// Two robots side by side: what each made of a turn, with what differs marked.

import { el, matrix } from "./dom.js";
import { lookUp } from "./look_up.js";
import { brief, nameOf, percent, t } from "./texts.js";

const ROBOTS = ["first", "second"];

export class Beside {
  constructor() {
    this.names = [];
    this.told = new Map();
  }

  /** The theories of the two robots; none if there is one robot. */
  begin(names) {
    this.names = names;
    this.told.clear();
  }

  /** What came of a turn for the second robot. */
  add(event) {
    this.told.set(event.turns[0], event);
  }

  forget(turn) {
    this.told.delete(turn.turns[0]);
  }

  /** The comparison of a turn, which is filled as soon as the robot has time for it. */
  section(turn, view) {
    if (!this.names.length) return null;
    const made = el("section", { class: "beside", "aria-label": t("beside") });
    this.fill(made, turn, view);
    return made;
  }

  async fill(made, turn, view) {
    const answer = await lookUp(`/beside/${turn.turns.join("/")}`);
    if (!answer.ok) return;
    const report = await answer.json();
    const told = this.told.get(turn.turns[0]);
    const parts = report.error
      ? [el("p", {}, report.error)]
      : [...this.answers(turn, told), ...names(view, told), ...lines(report.lines), ...rules(report.rules), ...report.state.flatMap(fields)];
    const same = parts.every((it) => !it.classList.contains("beside__row--differs"));
    made.replaceChildren(
      el("h3", {}, t("beside")),
      el("div", { class: "beside__heads" }, ...this.names.map((name, n) => el("b", { class: `beside__name beside__name--${ROBOTS[n]}` }, name))),
      ...(same ? [both(t("besideNothing"))] : []),
      ...parts,
    );
  }

  answers(turn, told) {
    const failed = told?.failed ? el("span", { class: "beside__failed" }, t("besideFailed"), el("span", { lang: "en" }, told.failed)) : null;
    const pair = [turn.said || t("besideSilent"), failed ?? (told?.said || t("besideSilent"))];
    return [heading("besideSays"), pair[0] === pair[1] ? both(pair[0]) : row(pair)];
  }
}

const heading = (name) => el("h4", {}, t(name));

/** A row with one cell for each robot; marked, unless both are the same text. */
function row(pair, differs = pair[0] !== pair[1]) {
  return el(
    "div",
    { class: `beside__row${differs ? " beside__row--differs" : ""}` },
    ...pair.map((it, n) => el("div", { class: `beside__cell beside__cell--${ROBOTS[n]}` }, it || "–")),
  );
}

/** What both have, told once. */
const both = (text) => el("p", { class: "beside__both" }, text);

/** What each robot would call the things in view. */
function names(view, told) {
  if (!view || !told?.names.length) return [];
  const name = ({ name, names: [best] }) => (best ? `${name || "?"} ${percent(best.degree)}` : "?");
  const pairs = view.things.map((it, n) => [`#${it.number} ${name(it)}`, `#${it.number} ${told.names[n] ? name(told.names[n]) : "?"}`]);
  const same = pairs.filter(([one, other]) => one === other).map(([one]) => one);
  return [heading("besideNames"), ...(same.length ? [both(same.join(" · "))] : []), ...pairs.filter(([one, other]) => one !== other).map((it) => row(it))];
}

/** What was heard, judged and said: first what both have, then what only one has. */
function lines([one, other]) {
  const text = ([kind, line]) => `${nameOf("line", kind)} ${brief(line)}`.trim();
  const [ours, theirs] = [one.map(text), other.map(text)];
  const shared = ours.filter((it) => theirs.includes(it));
  const only = (its) => its.filter((it) => !shared.includes(it)).map((it) => el("p", { class: "beside__line" }, it));
  const pair = [only(ours), only(theirs)];
  const made = [heading("besideLines")];
  if (shared.length) made.push(el("details", {}, el("summary", {}, t("besideLinesBoth", { count: shared.length })), ...shared.map(both)));
  if (pair.some((it) => it.length)) made.push(row(pair.map((it) => (it.length ? el("div", {}, ...it) : "")), true));
  return made;
}

/** The rules in order: those of both by their names, the others in their robot's column. */
function rules(fired) {
  const made = [heading("besideRules")];
  for (const run of runs(fired)) {
    if (run[0].by === "both") made.push(both(run.map((it) => it.name).join(", ")));
    else {
      const of = (by) => run.filter((it) => it.by === by).map(({ name, does }) => el("p", { class: "beside__line" }, el("b", {}, name), ` ${does}`));
      made.push(row(ROBOTS.map((by) => (of(by).length ? el("div", {}, ...of(by)) : "")), true));
    }
  }
  return made;
}

/** Neighbours that both robots share, or do not. */
function runs(fired) {
  const found = [];
  for (const it of fired) {
    const last = found.at(-1);
    if (last && (last[0].by === "both") === (it.by === "both")) last.push(it);
    else found.push([it]);
  }
  return found;
}

/** A part of the state: the fields that differ as matrices, the others by their names. */
function fields({ name, fields: apart, alike }) {
  return [
    heading(name),
    ...apart.flatMap((it) => [el("p", { class: "beside__field" }, it.name), row(it.html.map((html) => (html ? matrix(html) : "")), true)]),
    alike.length ? both(t("besideAlike", { names: alike.join(", ") })) : null,
  ].filter(Boolean);
}
