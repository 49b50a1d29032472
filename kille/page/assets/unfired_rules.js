// The rules that did not fire in a turn, and why: asked for when they are unfolded.

import { el } from "./dom.js";
import { lookUp } from "./look_up.js";
import { t } from "./texts.js";

export function unfired(turn) {
  const body = el("div", { class: "unfired__body" });
  const made = el("details", { class: "unfired" }, el("summary", {}, t("unfired")), body);
  made.addEventListener("toggle", () => made.open && !body.childElementCount && load(turn, body));
  return made;
}

async function load(turn, body) {
  body.replaceChildren(el("p", { class: "part__empty" }, "…"));
  const answer = await lookUp(`/unfired/${turn.turns.join("/")}`);
  const { error, events } = answer.ok ? await answer.json() : { error: t("gone"), events: [] };
  body.replaceChildren(...(error ? [el("p", {}, error)] : eventReports(events)));
}

/** Unfolded is the event from which most came. */
function eventReports(events) {
  const most = Math.max(...events.map((it) => it.fired.length));
  const open = events.findIndex((it) => it.fired.length === most);
  return events.map((it, n) => eventReport(it, n === open));
}

function eventReport({ fired, others, reasons }, open) {
  return el(
    "details",
    { class: "unfired__event", open },
    el("summary", {}, t("insteadOf", { rules: fired.join(", ") })),
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
