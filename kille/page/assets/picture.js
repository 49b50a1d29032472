// The live picture on its canvas: the newest one, drawn when the browser draws.

import { byId } from "./dom.js";

export class LivePicture {
  constructor() {
    this.canvas = byId("picture");
    this.context = this.canvas.getContext("2d", { alpha: false });
    this.count = 0;
  }

  async draw(jpeg, done) {
    try {
      const bitmap = await createImageBitmap(new Blob([jpeg], { type: "image/jpeg" }));
      if (this.canvas.width !== bitmap.width || this.canvas.height !== bitmap.height) {
        this.canvas.width = bitmap.width;
        this.canvas.height = bitmap.height;
        byId("stage").style.aspectRatio = `${bitmap.width} / ${bitmap.height}`;
      }
      this.context.drawImage(bitmap, 0, 0);
      bitmap.close();
      this.canvas.dataset.pictures = ++this.count;
    } finally {
      done();
    }
  }
}
