// Step by step: the turn waits before each rule, for all who look on.

import { byId, el } from "./dom.js";
import { brief, t } from "./texts.js";

export class Stepping {
  /** `ask(message)` asks the robot. */
  constructor(ask) {
    this.ask = ask;
    this.on = false;
    this.panel = byId("step");
    this.toggle = el("button", { class: "button", type: "button", onclick: () => this.ask({ do: "stepping", on: !this.on }) });
  }

  label() {
    this.toggle.textContent = t("stepping");
    this.toggle.setAttribute("aria-pressed", String(this.on));
    this.panel.setAttribute("aria-label", t("stepping"));
  }

  switched({ on }) {
    this.on = on;
    this.label();
    if (!on) this.over();
  }

  /** The turn waits before a rule. */
  wait({ rule, does, changes }) {
    const held = this.panel.contains(document.activeElement);
    const button = (name, rest) => el("button", { class: "button", type: "button", onclick: () => { this.ask({ do: "step", rest }); } }, t(name));
    const next = button("stepOne", false);
    this.panel.replaceChildren(
      el("p", {}, t("waits"), " ", el("b", {}, rule), ` ${does}`),
      el("ul", { class: "step__changes" }, ...(changes.length ? changes : [t("nothingNew")]).map((it) => el("li", {}, brief(it)))),
      el("div", { class: "waits__do" }, next, button("stepRest", true)),
    );
    this.panel.hidden = false;
    if (held) next.focus();
  }

  /** It waits no more. */
  over() {
    const held = this.panel.contains(document.activeElement);
    this.panel.hidden = true;
    this.panel.replaceChildren();
    if (held) byId("text").focus();
  }
}
