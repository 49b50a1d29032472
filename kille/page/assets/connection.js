// The WebSocket: it opens again by itself, asks for the events that were missed, and
// asks again for what was not answered, which the server does once.

const SOONEST = 300;
const LATEST = 4000;
const SILENCE = 2000; // milliseconds after which it is asked whether the server is there
const PATIENCE = 5000; // milliseconds within which it answers
const ANSWERS = new Set(["turn", "pointed", "failed", "refused"]);

export class Connection {
  /** `on` has functions for events by their type, `picture`, `voice` and `state`. */
  constructor(on) {
    this.on = on;
    this.run = "";
    this.last = 0;
    this.wait = SOONEST;
    this.count = 0;
    this.looks = true;
    this.unanswered = new Map();
    this.mark = Array.from(crypto.getRandomValues(new Uint32Array(2)), (it) => it.toString(36)).join("");
    document.addEventListener("visibilitychange", () => this.watch());
    setInterval(() => this.check(), 1000);
    this.open();
  }

  open() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const query = new URLSearchParams({ run: this.run, after: this.last });
    const socket = new WebSocket(`${scheme}://${location.host}/live?${query}`);
    socket.binaryType = "arraybuffer";
    socket.onmessage = ({ data }) => this.socket === socket && this.take(data);
    socket.onclose = ({ code }) => this.socket === socket && this.openAgain(code);
    this.socket = socket;
    this.greeted = false;
    this.heard = this.asked = performance.now();
  }

  openAgain(code) {
    this.socket = null;
    this.on.state(code === 1013 ? "full" : "lost");
    if (!this.greeted) this.findOutWhy();
    setTimeout(() => this.open(), this.wait);
    this.wait = Math.min(LATEST, this.wait * 2);
  }

  /** Whether the server is there, and does not know this browser any more. */
  async findOutWhy() {
    const answer = await fetch("/icon.svg", { cache: "no-store", signal: AbortSignal.timeout(PATIENCE) }).catch(() => null);
    if (answer?.status === 403 && !this.greeted) this.on.state("stranger");
  }

  /** Once a second: is the server still there? */
  check() {
    if (!this.socket) return;
    const now = performance.now();
    if (this.asked !== null && now - this.asked > PATIENCE) {
      this.socket.close();
      this.openAgain(0);
    } else if (this.asked === null && now - this.heard > SILENCE) {
      this.asked = now;
      this.send({ do: "ping" });
    }
  }

  take(data) {
    this.heard = performance.now();
    this.asked = null;
    if (typeof data !== "string") {
      const number = new DataView(data).getUint32(0);
      const content = data.slice(4);
      if (isSound(content)) this.on.voice(number, content);
      else this.on.picture(content, () => this.send({ do: "shown" }));
      return;
    }
    const event = JSON.parse(data);
    if (event.type === "hello") {
      this.greet(event);
      return;
    }
    if (event.id) this.last = event.id;
    if (ANSWERS.has(event.type)) this.unanswered.delete(event.ref);
    this.on[event.type]?.(event);
    this.on.shown(this.last);
  }

  greet(event) {
    this.wait = SOONEST;
    this.greeted = true;
    const before = this.run;
    this.run = event.run;
    this.last = event.after;
    this.on.state("open");
    this.on.hello(event, before);
    this.on.shown(this.last);
    this.watch();
    if (before !== event.run) this.unanswered.clear();
    for (const message of this.unanswered.values()) this.send(message);
  }

  /** Ask for something; returns the name by which the answer refers to it. */
  ask(what) {
    const message = { ...what, ref: `${this.mark}-${++this.count}` };
    if (!this.send(message)) return "";
    this.unanswered.set(message.ref, message);
    return message.ref;
  }

  send(message) {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  sendSound(message) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(message);
  }

  /** The bytes that wait to be sent. */
  get waiting() {
    return this.socket?.bufferedAmount ?? 0;
  }

  /** Pictures are sent to who looks at them. */
  watch(looks = this.looks) {
    this.looks = looks;
    this.send({ do: "watch", on: looks && document.visibilityState !== "hidden" });
  }
}

/** Whether these are the bytes of a WAV file. */
const isSound = (content) => String.fromCharCode(...new Uint8Array(content, 0, 4)) === "RIFF";
