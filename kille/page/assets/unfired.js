// The rules that did not fire in a turn, and why: asked for when they are unfolded.

import { el } from "./dom.js";
import { t } from "./texts.js";

export function unfired(turn) {
  const body = el("div", { class: "unfired__body" });
  const made = el("details", { class: "unfired" }, el("summary", {}, t("unfired")), body);
  made.addEventListener("toggle", () => made.open && !body.childElementCount && load(turn, body));
  return made;
}

async function load(turn, body) {
  body.replaceChildren(el("p", { class: "part__empty" }, "…"));
  const answer = await fetch(`/unfired/${turn.turns.join("/")}`);
  const { error, events } = answer.ok ? await answer.json() : { error: t("gone"), events: [] };
  body.replaceChildren(...(error ? [el("p", {}, error)] : events.map(eventReport)));
}

function eventReport({ fired, others, reasons }) {
  return el(
    "section",
    { class: "unfired__event" },
    el("h4", {}, t("insteadOf", { rules: fired.join(", ") })),
    ...reasons.map(reason),
    others ? el("p", { class: "part__empty" }, t("others", { count: others })) : null,
  );
}

function reason({ why, rules }) {
  const known = { "found nothing": t("foundNothing"), "came later": t("cameLater") };
  return el(
    "details",
    { class: "step" },
    el("summary", {}, known[why] ?? why, " ", el("span", { class: "unfired__count" }, t("rulesCount", { count: rules.length }))),
    el("ul", { class: "step__changes" }, ...rules.map(({ name, does }) => el("li", {}, el("b", {}, name), ` ${does}`))),
  );
}
