// The editor: a text area above the same text in colours, with mistakes underlined.
import { byId, el } from "./dom.js";
import { colour, tokens } from "./tokens.js";

const area = byId("text");
const colours = byId("colours");
let marks = [];

export const text = () => area.value;

export function setText(value) {
  area.value = value;
  area.setSelectionRange(0, 0);
  area.scrollTo(0, 0);
  setMarks([]);
}

/** Underline these places: line and column from 1, in characters. */
export function setMarks(places) {
  marks = places.filter((it) => it.line).map(rangeOf);
  paint();
}

/** Select a place, and bring it into view. */
export function show(place) {
  const { start, end } = rangeOf(place);
  area.focus();
  area.setSelectionRange(start, end);
  const line = parseFloat(getComputedStyle(area).lineHeight);
  area.scrollTop = Math.max(0, (place.line - 3) * line);
}

export function onChange(changed) {
  area.addEventListener("input", () => {
    marks = [];
    paint();
    changed();
  });
}

function rangeOf({ line, column, length }) {
  const lines = area.value.split("\n");
  const before = lines.slice(0, line - 1).reduce((sum, it) => sum + it.length + 1, 0);
  const letters = Array.from(lines[line - 1] ?? "");
  const at = letters.slice(0, column - 1).join("").length;
  const size = Math.max(1, letters.slice(column - 1, column - 1 + length).join("").length);
  return { start: before + at, end: before + at + size };
}

function paint() {
  const value = `${area.value}\n`;
  const cuts = new Map();
  for (const { kind, start, end } of tokens(value)) {
    cuts.set(start, { end, shade: colour(kind, value.slice(start, end)) });
  }
  const borders = new Set([0, value.length]);
  for (const [start, { end }] of cuts) borders.add(start).add(end);
  for (const { start, end } of marks) borders.add(start).add(end);
  const ordered = [...borders].filter((it) => it <= value.length).sort((a, b) => a - b);
  const parts = [];
  let current = null;
  for (let i = 0; i + 1 < ordered.length; i += 1) {
    const [start, end] = [ordered[i], ordered[i + 1]];
    current = cuts.get(start) ?? (current && start < current.end ? current : null);
    const wrong = marks.some((it) => it.start <= start && end <= it.end);
    const kind = [current && `is-${current.shade}`, wrong && "is-wrong"].filter(Boolean).join(" ");
    const piece = value.slice(start, end);
    parts.push(kind ? el("span", { class: kind }, piece) : piece);
  }
  colours.replaceChildren(...parts);
  follow();
}

function follow() {
  colours.scrollTop = area.scrollTop;
  colours.scrollLeft = area.scrollLeft;
}

let leaving = false;
area.addEventListener("scroll", follow);
area.addEventListener("keydown", (event) => {
  if (event.key === "Tab" && !event.shiftKey && !leaving) {
    event.preventDefault();
    document.execCommand("insertText", false, "    ");
  }
  leaving = event.key === "Escape";
});
