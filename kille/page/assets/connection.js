// The WebSocket: it opens again by itself, and asks for the events that were missed.

const SOONEST = 300;
const LATEST = 4000;

export class Connection {
  /** `on` has functions for events by their type, `picture` and `state`. */
  constructor(on) {
    this.on = on;
    this.run = "";
    this.last = 0;
    this.wait = SOONEST;
    this.count = 0;
    this.mark = Math.random().toString(36).slice(2, 8);
    document.addEventListener("visibilitychange", () => this.watch());
    this.open();
  }

  open() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const query = new URLSearchParams({ run: this.run, after: this.last });
    this.socket = new WebSocket(`${scheme}://${location.host}/live?${query}`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = ({ data }) => this.take(data);
    this.socket.onclose = ({ code }) => this.openAgain(code);
  }

  openAgain(code) {
    this.on.state(code === 1013 ? "full" : "lost");
    setTimeout(() => this.open(), this.wait);
    this.wait = Math.min(LATEST, this.wait * 2);
  }

  take(data) {
    if (typeof data !== "string") {
      this.on.picture(data.slice(4), () => this.send({ do: "shown" }));
      return;
    }
    const event = JSON.parse(data);
    if (event.type === "hello") {
      this.wait = SOONEST;
      const before = this.run;
      this.run = event.run;
      this.last = event.after;
      this.on.state("open");
      this.on.hello(event, before);
      this.watch();
      return;
    }
    if (event.id) this.last = event.id;
    this.on[event.type]?.(event);
  }

  /** Ask for something; returns the name by which the answer refers to it. */
  ask(what) {
    const ref = `${this.mark}-${++this.count}`;
    return this.send({ ...what, ref }) ? ref : "";
  }

  send(message) {
    if (this.socket.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  /** Pictures are sent to who looks at them. */
  watch() {
    this.send({ do: "watch", on: document.visibilityState !== "hidden" });
  }
}
