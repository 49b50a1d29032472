// Speaking with the robot: a microphone that is held or open, and the robot's voice.

import { byId } from "./dom.js";
import { Playback } from "./playback.js";
import { t } from "./texts.js";

const BEFORE = 8; // pieces of sound from before the key was pressed
const AFTER = 250; // milliseconds of sound from after it was let go
const FULL = 64_000; // bytes that wait to be sent; what comes then is dropped

const TROUBLES = new Set(["micInsecure", "micOld", "micDenied", "micNone", "micBusy", "micFailed", "micLost"]);

export class Voice {
  constructor(connection) {
    this.connection = connection;
    this.playback = new Playback((turn, line, share) => connection.send({ do: "uttered", turn, line, share }));
    Object.assign(this, { me: 0, owner: 0, who: "", ready: false, open: false, held: false, over: true, aloud: false, deaf: "", mute: false });
    Object.assign(this, { count: 0, before: [], stream: null, wanted: false, status: "", offered: false });
    const hold = byId("hold");
    hold.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      hold.setPointerCapture(event.pointerId);
      this.press();
    });
    for (const it of ["pointerup", "pointercancel", "lostpointercapture"]) hold.addEventListener(it, () => this.release());
    hold.addEventListener("contextmenu", (event) => event.preventDefault());
    byId("open-mic").addEventListener("click", () => this.setOpen(!this.open));
    byId("talk-over").addEventListener("click", () => this.setOver(!this.over));
    byId("aloud").addEventListener("click", () => this.setAloud(!this.aloud));
    window.addEventListener("blur", () => this.release());
  }

  get mine() {
    return this.me !== 0 && this.owner === this.me;
  }

  // --- what the server tells ---

  hello(event) {
    this.me = event.browser;
    this.owner = 0;
    this.ready = false;
    this.deaf = event.deaf;
    this.mute = event.mute;
    this.aloud &&= !event.mute;
    this.connection.send({ do: "voice", on: this.aloud });
    if (this.wanted) this.ask();
    for (const id of ["hold", "open-mic"]) byId(id).disabled = Boolean(event.deaf);
    this.tell(this.status, this.slots);
    this.show();
  }

  microphone({ browser, who }) {
    const was = this.mine;
    this.owner = browser;
    this.who = who;
    if (was && !this.mine) {
      this.wanted = false;
      this.held = false;
      this.open = false;
      this.close();
      if (browser) this.tell("micTaken", { who });
    }
    this.offered = false;
    this.show();
  }

  listening() {
    this.ready = true;
    this.tell(this.open ? "micOpen" : "micReady");
    this.show();
  }

  taken({ who }) {
    this.wanted = false;
    this.open = this.held = false;
    this.close();
    this.offered = true;
    this.tell("micElsewhere", { who });
    this.show();
  }

  began() {
    if (this.over) this.playback.stop();
    this.tell("micHears");
  }

  unheard() {
    this.tell("micNoWords");
  }

  lost() {
    this.tell("micLost");
  }

  // --- what the tutor does ---

  press() {
    this.playback.stop();
    if (this.held) return;
    this.held = true;
    clearTimeout(this.ending);
    if (this.ending) this.finish();
    for (const piece of this.open ? [] : this.before) this.send("H", piece);
    if (!this.open && this.isHeard) this.tell("micHears");
    this.before = [];
    this.want();
    this.show();
  }

  release() {
    if (!this.held) return;
    this.held = false;
    if (!this.open) this.ending = setTimeout(() => this.finish(), AFTER);
    this.show();
  }

  /** The held utterance is over. */
  finish() {
    this.ending = 0;
    this.send("E", new Int16Array(0));
    if (this.isHeard) this.tell("micReady");
  }

  setOpen(on) {
    this.open = on;
    if (on) this.want();
    else this.drop();
    if (on && this.isHeard) this.tell("micOpen");
    this.show();
  }

  setOver(on) {
    this.over = on;
    this.show();
  }

  setAloud(on) {
    this.aloud = on && !this.mute;
    if (this.aloud) this.playback.sound();
    else this.playback.stop();
    this.connection.send({ do: "voice", on: this.aloud });
    this.show();
  }

  // --- the microphone ---

  get isHeard() {
    return this.mine && this.ready && this.stream !== null;
  }

  /** Have the microphone, if that can be. */
  async want() {
    if (this.wanted) return;
    this.wanted = true;
    const why = this.deaf ? `deaf_${this.deaf}` : await this.capture();
    if (why) {
      this.wanted = this.open = this.held = false;
      this.tell(why);
      this.show();
      return;
    }
    if (this.wanted) this.ask();
  }

  ask() {
    this.count = 0;
    if (!this.aloud && !this.mute) this.setAloud(true);
    this.tell("micPreparing");
    this.connection.send({ do: "microphone", on: true, take: this.offered });
  }

  /** Give the microphone back. */
  drop() {
    this.wanted = false;
    this.close();
    this.connection.send({ do: "microphone", on: false });
    this.tell("");
  }

  /** Open the browser's microphone; returns why that cannot be, if so. */
  async capture() {
    if (!window.isSecureContext) return "micInsecure";
    if (!navigator.mediaDevices?.getUserMedia || !window.AudioWorkletNode) return "micOld";
    try {
      const audio = { channelCount: 1, echoCancellation: true, noiseSuppression: true, autoGainControl: true };
      const stream = await navigator.mediaDevices.getUserMedia({ audio });
      const context = this.playback.sound();
      await context.audioWorklet.addModule("/sound_chunks.js");
      this.stream = stream;
      this.source = context.createMediaStreamSource(stream);
      this.worklet = new AudioWorkletNode(context, "sound-chunks", { numberOfOutputs: 0, channelCount: 1, channelCountMode: "explicit" });
      this.worklet.port.onmessage = ({ data }) => this.take(data);
      this.source.connect(this.worklet);
      stream.getAudioTracks()[0].onended = () => {
        this.drop();
        this.open = this.held = false;
        this.tell("micNone");
        this.show();
      };
      return "";
    } catch (error) {
      this.close();
      return { NotAllowedError: "micDenied", NotFoundError: "micNone", NotReadableError: "micBusy" }[error.name] ?? "micFailed";
    }
  }

  close() {
    this.source?.disconnect();
    for (const track of this.stream?.getTracks() ?? []) track.stop();
    this.stream = this.source = this.worklet = null;
    this.before = [];
    byId("hold").style.setProperty("--level", "0");
  }

  /** Take a piece of sound. */
  take(piece) {
    const loudest = piece.reduce((most, it) => Math.max(most, Math.abs(it)), 0) / 32768;
    byId("hold").style.setProperty("--level", this.held || this.open ? Math.sqrt(loudest).toFixed(2) : "0");
    if (this.open) {
      if (this.over || !this.playback.isPlaying) this.send("O", piece);
    } else if (this.held || this.ending) this.send("H", piece);
    else this.before = [...this.before.slice(1 - BEFORE), piece];
  }

  send(kind, piece) {
    if (!this.isHeard) return;
    const message = new Uint8Array(5 + piece.byteLength);
    message[0] = kind.charCodeAt(0);
    new DataView(message.buffer).setUint32(1, this.count++);
    message.set(new Uint8Array(piece.buffer), 5);
    if (this.connection.waiting < FULL) this.connection.sendSound(message);
  }

  // --- what is shown ---

  tell(text, slots = {}) {
    this.status = text;
    this.slots = slots;
    const idle = this.deaf ? `deaf_${this.deaf}` : "micReady";
    const told = byId("voice-status");
    told.textContent = t(text || idle, slots);
    told.classList.toggle("voice__status--trouble", TROUBLES.has(text));
  }

  show() {
    const mark = (id, on) => byId(id).setAttribute("aria-pressed", String(on));
    mark("open-mic", this.open);
    mark("talk-over", this.over);
    mark("aloud", this.aloud);
    byId("talk-over").hidden = !this.open;
    byId("aloud").disabled = this.mute;
    byId("aloud").title = this.mute ? t("mute") : "";
    const state = this.isHeard && (this.held || this.open) ? "on" : this.held || this.open ? "waiting" : "off";
    byId("voice").dataset.state = state;
    const fact = byId("fact-microphone");
    if (fact) fact.textContent = this.mine ? t("micHere") : this.who || t(this.deaf ? "micNot" : "micFree");
  }

  label() {
    byId("voice").setAttribute("aria-label", t("voice"));
    byId("hold").querySelector("span").textContent = t("hold");
    byId("open-mic").textContent = t("openMic");
    byId("talk-over").textContent = t("talkOver");
    byId("aloud").textContent = t("aloud");
    this.tell(this.status, this.slots);
    this.show();
  }
}
