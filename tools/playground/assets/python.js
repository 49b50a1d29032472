// Asks the worker, and replaces it when it is stopped.

export class Python {
  constructor(tell) {
    this.tell = tell;
    this.number = 0;
    this.begin();
  }

  begin() {
    this.waiting = new Map();
    this.tell("loading");
    this.worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    this.worker.onerror = (event) => this.tell("failed", event.message);
    this.worker.onmessage = ({ data }) => {
      if (data.ready) return this.tell(this.waiting.size ? "busy" : "ready");
      if (data.failed) return this.tell("failed", data.failed);
      const done = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (!this.waiting.size) this.tell("ready");
      done(data.answer);
    };
  }

  /** The answer to a request; null if it was stopped. */
  ask(request) {
    const id = ++this.number;
    this.tell("busy");
    return new Promise((done) => {
      this.waiting.set(id, done);
      this.worker.postMessage({ ...request, id });
    });
  }

  stop() {
    this.worker.terminate();
    const stopped = [...this.waiting.values()];
    this.begin();
    for (const done of stopped) done(null);
  }
}
