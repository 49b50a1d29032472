// The robot's voice: its sentences one after another, and how much of them was heard.

export class Playback {
  /** `told(turn, line, share)`: so many lines, and this share of the next, were uttered. */
  constructor(told) {
    this.told = told;
    this.turn = 0;
    this.lines = 0;
    this.parts = [];
    this.decoding = Promise.resolve();
  }

  /** The context for all sound; it has to be asked for by a click or a key. */
  sound() {
    this.context ??= new AudioContext();
    if (this.context.state === "suspended") this.context.resume();
    return this.context;
  }

  get isPlaying() {
    return this.parts.length > 0;
  }

  /** The robot says so many lines in the turn of this number. */
  expect(turn, lines) {
    if (turn > this.turn) Object.assign(this, { turn, lines, next: 0 });
  }

  /** Play the next line of a turn, as a WAV file. */
  play(turn, wav) {
    if (turn !== this.turn || !this.context) return;
    this.decoding = this.decoding.then(async () => {
      const sound = await this.context.decodeAudioData(wav).catch(() => null);
      if (!sound || turn !== this.turn || this.next === null) return;
      const node = this.context.createBufferSource();
      node.buffer = sound;
      node.connect(this.context.destination);
      const before = this.parts.at(-1);
      const start = Math.max(this.context.currentTime + 0.02, before ? before.start + before.seconds : 0);
      const part = { node, start, seconds: sound.duration, line: this.next++ };
      node.onended = () => this.end(part);
      node.start(start);
      this.parts.push(part);
    });
  }

  end(part) {
    this.parts = this.parts.filter((it) => it !== part);
    if (this.next !== null && part.line + 1 === this.lines) this.told(this.turn, this.lines, 0);
  }

  /** Fall silent, and tell how much was uttered. */
  stop() {
    if (!this.isPlaying) return;
    const now = this.context.currentTime;
    const part = this.parts.find((it) => now < it.start + it.seconds) ?? this.parts.at(-1);
    const share = Math.max(0, Math.min(1, (now - part.start) / part.seconds));
    const parts = this.parts;
    this.parts = [];
    this.next = null;
    for (const { node } of parts) {
      node.onended = null;
      node.stop();
    }
    this.told(this.turn, part.line, share);
  }
}
