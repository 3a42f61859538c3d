// SPDX-License-Identifier: GPL-2.0-or-later
// The corners of the die in a photograph, clicked, as the option for `icwafer compare --photo`.

class Photo {
  constructor() {
    this.canvas = byId("photo-canvas");
    this.corners = [];
    this.cross = null;
    byId("photo-file").addEventListener("change", (event) => this.open(event.target.files[0]));
    byId("photo-undo").addEventListener("click", () => {
      this.corners.pop();
      this.draw();
    });
    this.canvas.addEventListener("click", (event) => {
      const scale = this.canvas.width / this.canvas.clientWidth;
      this.add([event.offsetX * scale, event.offsetY * scale]);
    });
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  open(file) {
    if (!file) return;
    this.name = file.name;
    this.image = new Image();
    this.image.onload = () => {
      URL.revokeObjectURL(this.image.src);
      [this.canvas.width, this.canvas.height] = [this.image.naturalWidth, this.image.naturalHeight];
      this.canvas.hidden = false;
      this.corners = [];
      this.cross = null;
      this.draw();
    };
    this.image.onerror = () => this.say(`${file.name} is no picture that this browser can show`);
    this.image.src = URL.createObjectURL(file);
  }

  key(event) {
    const step = event.shiftKey ? 1 : 16;
    const [dx, dy] = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key] ?? [0, 0];
    if (!dx && !dy && event.key !== "Enter") return;
    event.preventDefault();
    const { width, height } = this.canvas;
    const [x, y] = this.cross ?? [width / 2, height / 2];
    this.cross = [Math.min(Math.max(x + dx, 0), width), Math.min(Math.max(y + dy, 0), height)];
    if (event.key === "Enter") this.add(this.cross);
    this.draw();
  }

  add(corner) {
    if (this.corners.length === 4) this.corners = [];
    this.corners.push(corner);
    this.draw();
  }

  draw() {
    if (!this.image) return;
    const context = this.canvas.getContext("2d");
    const unit = this.canvas.width / Math.max(this.canvas.clientWidth, 1);
    context.drawImage(this.image, 0, 0);
    context.lineWidth = 2 * unit;
    context.strokeStyle = "#f0b23e";
    context.font = `${15 * unit}px system-ui, sans-serif`;
    context.beginPath();
    this.corners.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
    if (this.corners.length === 4) context.closePath();
    context.stroke();
    this.corners.forEach(([x, y], i) => {
      context.beginPath();
      context.arc(x, y, 5 * unit, 0, 7);
      context.fillStyle = "#f0b23e";
      context.fill();
      context.fillText(String(i + 1), x + 8 * unit, y - 8 * unit);
    });
    if (this.cross) {
      const [x, y] = this.cross;
      context.beginPath();
      context.moveTo(x - 12 * unit, y);
      context.lineTo(x + 12 * unit, y);
      context.moveTo(x, y - 12 * unit);
      context.lineTo(x, y + 12 * unit);
      context.stroke();
    }
    const corners = this.corners.map((corner) => corner.map((value) => value.toFixed(1)).join(","));
    this.say(corners.length < 4 ? `${corners.length} of 4 corners`
      : `icwafer compare --photo '${this.name.replaceAll("'", "'\\''")}' --corners ${corners.join(" ")} RENDER`);
  }

  say(text) {
    byId("photo-line").hidden = false;
    byId("photo-line").textContent = text;
  }
}
