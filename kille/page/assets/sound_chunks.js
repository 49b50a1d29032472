// Runs beside the microphone: brings its sound to 16 kHz, and hands it on in pieces.

const RATE = 16000;
const PIECE = 800; // samples: a twentieth of a second
const LOBES = 12; // of the sinc, on each side

class SoundChunks extends AudioWorkletProcessor {
  constructor() {
    super();
    this.step = sampleRate / RATE;
    this.reach = Math.ceil(LOBES * Math.max(1, this.step));
    this.sound = new Float32Array(2 * this.reach); // what was not yet used
    this.at = this.reach; // where the next sample is, in what came
    this.made = new Int16Array(PIECE);
    this.count = 0;
  }

  process([input]) {
    if (input[0]) this.add(input[0]);
    return true;
  }

  add(samples) {
    const sound = new Float32Array(this.sound.length + samples.length);
    sound.set(this.sound);
    sound.set(samples, this.sound.length);
    for (; this.at + this.reach < sound.length; this.at += this.step) this.give(this.between(sound, this.at));
    const used = Math.floor(this.at) - this.reach;
    this.sound = sound.slice(used);
    this.at -= used;
  }

  /** The sound at a place between samples, without what is too high for the new rate. */
  between(sound, place) {
    const cut = Math.min(1, 1 / this.step) * 0.95;
    let sum = 0;
    for (let n = Math.floor(place) - this.reach + 1; n <= Math.floor(place) + this.reach; n++) {
      const away = place - n;
      const window = 0.5 + 0.5 * Math.cos((Math.PI * away) / this.reach);
      const angle = Math.PI * cut * away;
      sum += sound[n] * cut * window * (angle === 0 ? 1 : Math.sin(angle) / angle);
    }
    return sum;
  }

  give(value) {
    this.made[this.count++] = Math.max(-32768, Math.min(32767, Math.round(value * 32767)));
    if (this.count < PIECE) return;
    this.port.postMessage(this.made, [this.made.buffer]);
    this.made = new Int16Array(PIECE);
    this.count = 0;
  }
}

registerProcessor("sound-chunks", SoundChunks);
