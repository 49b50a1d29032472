// An earlier turn beside its state: its picture and its things, while the lesson goes on.

import { byId } from "./dom.js";
import { t } from "./texts.js";

const SINCE = 3; // the latest view, and what has been pointed at since

export class Replay {
  constructor(picture, things) {
    this.picture = picture;
    this.things = things;
    this.on = false;
    this.since = [];
  }

  /** Something that is to be seen has happened; returns whether it is shown now. */
  live(event) {
    this.since = event.type === "view" ? [event] : [...this.since, event].slice(-SINCE);
    return !this.on;
  }

  /** Show what was in view in a turn. */
  show(turn, view, name) {
    this.on = true;
    this.picture.hold(`/picture/${turn.turns[0]}.jpg`);
    this.things.show(view);
    this.things.mean(turn.said ? turn.thing : null);
    this.say(name);
  }

  /** Show what is in view now. */
  end() {
    if (!this.on) return;
    this.on = false;
    this.picture.release();
    for (const event of this.since) {
      if (event.type === "view") this.things.show(event);
      else this.things.point(event);
    }
    this.say("");
  }

  say(name) {
    const stage = byId("stage");
    stage.classList.toggle("stage--replay", this.on);
    for (const id of ["things", "outlines", "box"]) byId(id).inert = this.on;
    byId("replay").hidden = !this.on;
    byId("replay").textContent = this.on ? t("replayed", { turn: name }) : "";
  }
}
