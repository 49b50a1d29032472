// A region of one's own: dragged over the picture, or moved with the arrow keys.

import { byId } from "./dom.js";
import { t } from "./texts.js";

const SHAKE = 6; // pixels of the screen that a click may move
const STEP = 8; // pixels of the picture that a key moves

export class Region {
  /** `choose(number)` is called for a thing that is clicked, `draw(box)` for a box; it
   *  says whether that was asked for. */
  constructor(things, choose, draw) {
    this.things = things;
    this.choose = choose;
    this.draw = draw;
    this.stage = byId("stage");
    this.frame = byId("box");
    this.start = null;
    this.box = null;
    this.cameFrom = null; // what had the focus before a region was drawn by keys
    this.stage.addEventListener("pointerdown", (event) => this.begin(event));
    this.stage.addEventListener("pointermove", (event) => this.move(event));
    this.stage.addEventListener("pointerup", (event) => this.end(event));
    this.stage.addEventListener("pointercancel", () => this.cancel());
    this.frame.addEventListener("keydown", (event) => this.key(event));
  }

  get size() {
    return this.things.view.size ?? [640, 480];
  }

  /** The pixel of the picture at a place of the screen. */
  pixel(event) {
    const stage = this.stage.getBoundingClientRect();
    const [width, height] = this.size;
    const within = (value, most) => Math.round(Math.max(0, Math.min(value, most)));
    return [
      within(((event.clientX - stage.left) / stage.width) * width, width),
      within(((event.clientY - stage.top) / stage.height) * height, height),
    ];
  }

  begin(event) {
    if (event.button !== 0 || this.stage.classList.contains("stage--replay") || event.target.closest(".thing")) return;
    this.start = { at: this.pixel(event), x: event.clientX, y: event.clientY, on: event.target.dataset.thing };
    this.stage.setPointerCapture(event.pointerId);
    this.dragged = false;
  }

  move(event) {
    if (!this.start) return;
    const far = Math.hypot(event.clientX - this.start.x, event.clientY - this.start.y);
    if (far < SHAKE && !this.dragged) return;
    this.dragged = true;
    const [u, v] = this.start.at;
    const [u2, v2] = this.pixel(event);
    this.show([Math.min(u, u2), Math.min(v, v2), Math.max(u, u2), Math.max(v, v2)]);
  }

  end() {
    const start = this.start;
    this.start = null;
    if (!start) return;
    if (!this.dragged) {
      if (start.on) this.choose(Number(start.on));
      return;
    }
    this.send();
  }

  /** Show a region in the middle, to be moved by keys. */
  beginByKeys() {
    const [width, height] = this.size;
    this.show([width * 0.4, height * 0.4, width * 0.6, height * 0.6].map(Math.round));
    this.frame.setAttribute("aria-label", t("box"));
    this.cameFrom = document.activeElement;
    this.frame.focus();
  }

  key(event) {
    const moves = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] };
    const by = moves[event.key];
    if (by) this.show(event.shiftKey ? this.resized(by) : this.moved(by));
    else if (event.key === "Enter") {
      this.send();
      byId("text").focus(); // to say what is there
    } else if (event.key === "Escape") {
      this.cancel();
      this.cameFrom.focus();
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  moved([right, down]) {
    const [left, top, end, bottom] = this.box;
    const [width, height] = this.size;
    const x = Math.max(-left, Math.min(right, width - end));
    const y = Math.max(-top, Math.min(down, height - bottom));
    return [left + x, top + y, end + x, bottom + y];
  }

  resized([right, down]) {
    const [left, top, end, bottom] = this.box;
    const [width, height] = this.size;
    return [left, top, clamp(end + right, left + STEP, width), clamp(bottom + down, top + STEP, height)];
  }

  show(box) {
    this.box = box;
    const [width, height] = this.size;
    const style = this.frame.style;
    style.left = `${(box[0] / width) * 100}%`;
    style.top = `${(box[1] / height) * 100}%`;
    style.width = `${((box[2] - box[0]) / width) * 100}%`;
    style.height = `${((box[3] - box[1]) / height) * 100}%`;
    this.frame.classList.remove("stage__box--sent");
    this.frame.hidden = false;
  }

  send() {
    if (this.draw(this.box)) this.frame.classList.add("stage__box--sent");
    else this.cancel();
  }

  /** Something else is in view now: what is still being drawn goes on. */
  settle() {
    const sent = this.frame.classList.contains("stage__box--sent");
    const moves = document.activeElement === this.frame && !sent;
    if (!this.start && !moves) this.frame.hidden = true;
  }

  cancel() {
    this.start = null;
    this.frame.hidden = true;
  }
}

const clamp = (value, least, most) => Math.max(least, Math.min(value, most));
