// The live picture on its canvas: the newest one, drawn when the browser draws.

import { byId } from "./dom.js";
import { lookUp } from "./look_up.js";

export class LivePicture {
  constructor() {
    this.canvas = byId("picture");
    this.context = this.canvas.getContext("2d", { alpha: false });
    this.count = 0;
    this.held = "";
  }

  /** Show a picture of earlier, or none if it cannot be had, and none of those that come. */
  async hold(address) {
    this.held = address;
    const answer = await lookUp(address);
    const bitmap = answer.ok ? await createImageBitmap(await answer.blob()) : null;
    if (this.held === address && bitmap) this.paint(bitmap);
    else if (this.held === address) this.context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    bitmap?.close();
  }

  /** Show what comes again. */
  release() {
    this.held = "";
  }

  async draw(jpeg, done) {
    try {
      if (this.held) return;
      const bitmap = await createImageBitmap(new Blob([jpeg], { type: "image/jpeg" }));
      if (!this.held) this.paint(bitmap);
      bitmap.close();
      this.canvas.dataset.pictures = ++this.count;
    } finally {
      done();
    }
  }

  paint(bitmap) {
    if (this.canvas.width !== bitmap.width || this.canvas.height !== bitmap.height) {
      this.canvas.width = bitmap.width;
      this.canvas.height = bitmap.height;
      byId("stage").style.aspectRatio = `${bitmap.width} / ${bitmap.height}`;
    }
    this.context.drawImage(bitmap, 0, 0);
  }
}
