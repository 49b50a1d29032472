// The word shelf: every word that was taught, its examples, and what was learned from them.

import { el, renewChildren, svg } from "./dom.js";
import { lookUp } from "./look_up.js";
import { percent, t } from "./texts.js";

export class Shelf {
  constructor(frame) {
    this.frame = frame;
    this.start = 0;
    this.chosen = null;
    this.list = el("div", { class: "shelf__words", role: "group" });
    this.card = el("div", { class: "shelf__card", "aria-live": "polite" });
    this.heading = el("summary");
    frame.replaceChildren(this.heading, this.list, this.card);
    frame.addEventListener("toggle", () => this.reload());
  }

  label() {
    this.heading.textContent = t("shelf");
    this.list.setAttribute("aria-label", t("shelf"));
  }

  /** Something was learned or forgotten. */
  async reload() {
    if (!this.frame.open) return;
    const answer = await lookUp(`/words/${this.start}`);
    if (!answer.ok) return;
    const { count, words } = await answer.json();
    if (!words.length && this.start) {
      this.start = 0;
      this.reload();
      return;
    }
    renewChildren(this.list, ...(count ? words.map((it) => this.word(it)) : [el("p", { class: "part__empty" }, t("noWords"))]), ...this.pages(count, words.length));
    if (this.chosen) this.show(this.chosen);
  }

  pages(count, shown) {
    if (count <= shown) return [];
    const turn = (name, start, can) =>
      el("button", { class: "chip", type: "button", "data-key": name, disabled: !can, onclick: () => { this.start = start; this.reload(); } }, t(name));
    const step = Math.max(shown, this.step ?? 0);
    this.step = step;
    return [
      el("p", { class: "shelf__pages" },
        turn("earlier", Math.max(0, this.start - step), this.start > 0),
        t("ofWords", { first: this.start + 1, last: this.start + shown, count }),
        turn("later", this.start + step, this.start + shown < count)),
    ];
  }

  word({ kind, name, form, lessons, swatch }) {
    const pressed = String(this.chosen?.kind === kind && this.chosen?.name === name);
    return el(
      "button",
      { class: "chip shelf__word", type: "button", "data-key": `${kind} ${name}`, "aria-pressed": pressed, onclick: () => this.choose({ kind, name }) },
      swatch ? dye(swatch) : null, form, el("span", { class: "shelf__count" }, ` ${lessons}`),
    );
  }

  choose(word) {
    this.chosen = word;
    this.reload();
  }

  async show({ kind, name }) {
    const answer = await lookUp(`/word/${encodeURIComponent(kind)}/${encodeURIComponent(name)}`);
    if (!answer.ok) {
      this.card.replaceChildren();
      return;
    }
    const word = await answer.json();
    const parts = [
      el("h3", {}, word.swatch ? dye(word.swatch) : null, word.form),
      el("div", { class: "shelf__examples" }, ...word.examples.map((it) => example(it, word.form))),
      word.lessons > word.examples.length ? el("p", { class: "part__empty" }, t("latestExamples", { shown: word.examples.length, count: word.lessons })) : null,
      curve(word.curve),
      word.template ? heatMap(word.template, word.cell) : null,
    ];
    this.card.replaceChildren(...parts.filter(Boolean));
    if (kind === "object") this.showAccuracy(name, parts[2] ?? parts[1]);
  }

  /** Below the examples, as soon as it is worked out. */
  async showAccuracy(name, above) {
    const answer = await lookUp(`/hindsight/${encodeURIComponent(name)}`);
    const right = answer.ok ? await answer.json() : [];
    if (right.length > 1 && above.isConnected) above.after(accuracy(right));
  }
}

/** A picture of what a word was, or was not, said of. */
function example({ key, holds, day }, form) {
  const name = t(holds ? "isOne" : "isNone", { word: form, day });
  const picture = el("img", { src: `/example/${key}`, alt: name, title: name, loading: "lazy", width: 64, height: 64 });
  picture.addEventListener("error", () => picture.replaceWith(el("span", { class: "example__none", title: name }, t("noExample"))));
  return el("figure", { class: `example example--${holds ? "for" : "against"}` }, picture, el("figcaption", { "aria-hidden": "true" }, holds ? "+" : "−"));
}

function dye(colour) {
  const made = svg("svg", { class: "swatch", viewBox: "0 0 1 1", "aria-hidden": "true" });
  made.append(svg("rect", { width: 1, height: 1, fill: colour }));
  return made;
}

const WIDE = 200;
const HIGH = 48;

/** How many examples there had been after each of the latest lessons. */
function curve({ for: pro, against: con }) {
  const most = Math.max(1, ...pro, ...con);
  const line = (values, name) => {
    const at = (n, value) => `${(n / Math.max(1, values.length)) * WIDE},${HIGH - (value / most) * HIGH}`;
    return svg("polyline", { class: `curve__line curve__line--${name}`, points: [at(0, 0), ...values.map((it, n) => at(n + 1, it))].join(" ") });
  };
  const text = t("curve", { count: pro.length, pro: pro.at(-1) ?? 0, con: con.at(-1) ?? 0 });
  const drawing = svg("svg", { class: "curve", viewBox: `-2 -2 ${WIDE + 4} ${HIGH + 4}`, role: "img", "aria-label": text, preserveAspectRatio: "none" });
  drawing.append(line(pro, "for"), line(con, "against"));
  return el("figure", { class: "shelf__figure" }, drawing, el("figcaption", {}, text));
}

/** The share of lessons before which it was right, after each of them; a mark for each. */
function accuracy(right) {
  const at = (n) => ((n + 0.5) / right.length) * WIDE;
  const share = right.map((_, n) => right.slice(0, n + 1).filter(Boolean).length / (n + 1));
  const line = svg("polyline", { class: "curve__line", points: share.map((it, n) => `${at(n)},${HIGH - it * HIGH}`).join(" ") });
  const text = t("accuracy", { right: right.filter(Boolean).length, count: right.length, share: percent(share.at(-1)) });
  const drawing = svg("svg", { class: "curve", viewBox: `-2 -2 ${WIDE + 4} ${HIGH + 4}`, role: "img", "aria-label": text, preserveAspectRatio: "none" });
  const marks = right.map((it, n) => svg("line", { class: `curve__mark curve__mark--${it ? "for" : "against"}`, x1: at(n), x2: at(n), y1: it ? 0 : HIGH, y2: it ? 6 : HIGH - 6 }));
  drawing.append(...marks, line);
  return el("figure", { class: "shelf__figure" }, drawing, el("figcaption", {}, text));
}

/** How well a spatial word fits wherever the target stands; the landmark is in the middle. */
function heatMap(rows, cell) {
  const [high, wide] = [rows.length, rows[0].length];
  const best = Math.max(...rows.flat());
  const text = t("template", { across: Math.round(wide * cell * 100), most: percent(best) });
  const drawing = svg("svg", { class: "heat", viewBox: `0 0 ${wide} ${high}`, role: "img", "aria-label": text });
  rows.forEach((row, y) =>
    row.forEach((degree, x) => drawing.append(svg("rect", { class: "heat__cell", x, y, width: 1, height: 1, "fill-opacity": degree }))),
  );
  drawing.append(svg("circle", { class: "heat__landmark", cx: wide / 2, cy: high / 2, r: 0.5 }));
  return el("figure", { class: "shelf__figure" }, drawing, el("figcaption", {}, text));
}
