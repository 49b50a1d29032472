// The things in view: an outline and a button for each, and what they may be called.

import { bar, byId, el, svg } from "./dom.js";
import { percent, t } from "./texts.js";

const GAP = 4;
const CROWD = 7; // things among which those without a word have their number alone

export class Things {
  /** `choose` is called with the number of a thing that is meant. */
  constructor(choose) {
    this.choose = choose;
    this.view = { size: [640, 480], focus: null, things: [] };
    this.outlines = new Map();
    this.buttons = new Map();
    this.pointed = { this: null, that: null, isNew: false };
    new ResizeObserver(() => this.layOut()).observe(byId("stage"));
  }

  show(view) {
    const focused = document.activeElement?.dataset?.thing;
    const before = new Map(this.view.things.map((it) => [it.number, JSON.stringify([it.name, it.names])]));
    const isSame = (it) => before.get(it.number) === JSON.stringify([it.name, it.names]);
    this.view = view;
    const [width, height] = view.size ?? [640, 480];
    byId("outlines").setAttribute("viewBox", `0 0 ${width} ${height}`);
    // What is as it was stays where it is in the page: somebody may be pressing it.
    this.outlines = renew(byId("outlines"), this.outlines, view.things, () => true, (it) => this.outline(it));
    this.buttons = renew(byId("things"), this.buttons, view.things, isSame, (it) => this.button(it));
    for (const it of view.things) this.outlines.get(it.number).setAttribute("d", smoothPath(it.outline));
    byId("empty").hidden = view.things.length > 0 || !view.size;
    byId("rivals").hidden = true;
    this.mark(view.glimpsed ? { ...this.pointed, this: view.focus } : { this: view.focus, that: null, isNew: false });
    if (focused && document.activeElement?.dataset?.thing !== focused) this.buttons.get(Number(focused))?.focus();
  }

  outline(thing) {
    const made = svg("path", { class: "outline" });
    made.dataset.thing = thing.number;
    made.addEventListener("pointerenter", () => this.light(thing.number, true));
    made.addEventListener("pointerleave", () => this.light(thing.number, false));
    return made;
  }

  button(thing) {
    const best = thing.names[0];
    const word = thing.name || t("nameless");
    const label = best ? `${word}, ${percent(best.degree)}` : word;
    const made = el(
      "button",
      {
        class: "thing",
        type: "button",
        "data-thing": thing.number,
        "data-label": t("thing", { number: thing.number, word: label }),
        "aria-describedby": "rivals",
        onclick: () => this.choose(thing.number),
        onpointerenter: () => this.light(thing.number, true),
        onpointerleave: () => this.light(thing.number, false),
        onfocus: () => this.light(thing.number, true),
        onblur: () => this.light(thing.number, false),
      },
      el("span", { class: "thing__number" }, String(thing.number)),
      el("span", { class: `thing__word${thing.name ? "" : " thing__word--none"}` }, thing.name || "?"),
      el("span", { class: "thing__role", "aria-hidden": "true" }),
      bar(thing.name && best ? best.degree : 0),
    );
    return made;
  }

  /** Whether a thing that is clicked now is "that": another one than "this", which was
   *  clicked since the last turn. To click it once more makes it "this". */
  isSecond(number) {
    const { this: first, that, isNew } = this.pointed;
    return isNew && first !== null && that === null && first !== number;
  }

  /** What was pointed at has been spoken of: the next click is "this" again. */
  settle() {
    this.pointed.isNew = false;
  }

  /** The tutor has pointed at a thing, or at a region of their own. */
  point({ thing = null, as }) {
    const second = as === "that";
    this.mark({ this: second ? this.pointed.this : thing, that: second ? thing : null, isNew: true });
  }

  /** Show what "this" and "that" are now. */
  mark(pointed) {
    this.pointed = pointed;
    const roleOf = (number) => ["this", "that"].find((it) => pointed[it] === number);
    for (const [its, outline] of this.outlines) {
      outline.classList.toggle("outline--this", roleOf(its) === "this");
      outline.classList.toggle("outline--that", roleOf(its) === "that");
    }
    for (const [its, button] of this.buttons) {
      const role = roleOf(its);
      const said = role && pointed.isNew ? t(role) : "";
      button.setAttribute("aria-pressed", String(Boolean(role)));
      button.setAttribute("aria-label", `${button.dataset.label}${said && ` (${said})`}`);
      button.dataset.role = role ?? "";
      button.querySelector(".thing__role").textContent = said;
    }
    this.layOut();
  }

  /** Let the thing pulse that the robot means. */
  mean(number) {
    const outline = this.outlines.get(number);
    if (!outline) return;
    outline.classList.remove("outline--meant");
    outline.getBoundingClientRect();
    outline.classList.add("outline--meant");
  }

  /** Light a thing up, and show the rivals of its name. */
  light(number, on) {
    this.outlines.get(number)?.classList.toggle("outline--lit", on);
    this.buttons.get(number)?.classList.toggle("thing--lit", on);
    const thing = this.view.things.find((it) => it.number === number);
    const card = byId("rivals");
    card.hidden = !on || !thing;
    if (card.hidden) return;
    const rows = thing.names.map((it) =>
      el("div", { class: "rivals__row" }, el("span", {}, it.word), el("span", {}, percent(it.degree)), bar(it.degree)),
    );
    card.replaceChildren(...(rows.length ? rows : [el("span", {}, t("nameless"))]));
    this.placeCard(card, this.buttons.get(number));
  }

  placeCard(card, button) {
    const stage = byId("stage").getBoundingClientRect();
    const at = button.getBoundingClientRect();
    const below = at.bottom - stage.top + GAP;
    const fits = below + card.offsetHeight <= stage.height;
    card.style.top = `${fits ? below : Math.max(0, at.top - stage.top - card.offsetHeight - GAP)}px`;
    card.style.left = `${clamp(at.left - stage.left, 0, stage.width - card.offsetWidth)}px`;
  }

  /** Put the buttons beside their things, so that none covers another, as far as that can
   *  be. Where there is no room for its word, a thing has its number, and the word while
   *  one looks at it. */
  layOut() {
    const { things, size } = this.view;
    byId("rivals").hidden = true;
    const taken = [];
    for (const thing of things) {
      const button = this.buttons.get(thing.number);
      const best = () => leastCovering(placesFor(thing.box, size, button), taken);
      button.classList.toggle("thing--brief", things.length >= CROWD && !thing.name);
      let place = best();
      if (place.covers) {
        button.classList.add("thing--brief");
        place = best();
      }
      taken.push(place);
      button.style.left = `${place.left}px`;
      button.style.top = `${place.top}px`;
    }
  }
}

/** Where the button of a thing can stand: above, below or beside it, or on it. */
function placesFor([left, top, right, bottom], size, button) {
  const stage = byId("stage");
  const [width, height] = size ?? [640, 480];
  const scale = { x: stage.clientWidth / width, y: stage.clientHeight / height };
  const own = { width: button.offsetWidth, height: button.offsetHeight };
  const x = ((left + right) / 2) * scale.x - own.width / 2;
  const middle = ((top + bottom) / 2) * scale.y - own.height / 2;
  const places = [
    [x, top * scale.y - own.height - GAP],
    [x, bottom * scale.y + GAP],
    [right * scale.x + GAP, middle],
    [left * scale.x - own.width - GAP, middle],
    [x, middle],
    ...[left, right].flatMap((u) => [top, bottom].map((v) => [u * scale.x - own.width / 2, v * scale.y - own.height / 2])),
  ];
  return places.map(([u, v]) => ({
    left: clamp(u, GAP, stage.clientWidth - own.width - GAP),
    top: clamp(v, GAP, stage.clientHeight - own.height - GAP),
    ...own,
  }));
}

/** The elements of things by their numbers, in order: those before where they fit. */
function renew(parent, before, things, fits, make) {
  const found = new Map(things.map((it) => [it.number, (fits(it) && before.get(it.number)) || make(it)]));
  const made = [...found.values()];
  for (const it of [...parent.children]) if (!made.includes(it)) it.remove();
  made.forEach((it, n) => parent.children[n] !== it && parent.insertBefore(it, parent.children[n] ?? null));
  return found;
}

/** A closed path that passes the corners in curves. */
function smoothPath(corners) {
  const middle = ([u, v], [u2, v2]) => `${(u + u2) / 2} ${(v + v2) / 2}`;
  if (corners.length < 3) return "";
  const curves = corners.map((it, n) => `Q${it.join(" ")} ${middle(it, corners[(n + 1) % corners.length])}`);
  return `M${middle(corners.at(-1), corners[0])}${curves.join("")}Z`;
}

const clamp = (value, least, most) => Math.max(least, Math.min(value, Math.max(least, most)));

/** The first of the places that covers least of those that are taken. */
function leastCovering(places, taken) {
  const measured = places.map((it) => ({ ...it, covers: taken.reduce((sum, other) => sum + overlap(it, other), 0) }));
  return measured.reduce((best, it) => (it.covers < best.covers ? it : best));
}

/** The area that two places share, with a gap around one of them. */
function overlap(one, other) {
  const along = (start, length) => Math.min(one[start] + one[length], other[start] + other[length] + GAP) - Math.max(one[start], other[start] - GAP);
  return Math.max(0, along("left", "width")) * Math.max(0, along("top", "height"));
}
