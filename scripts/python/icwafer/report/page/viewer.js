// SPDX-License-Identifier: GPL-2.0-or-later
// Two pictures on one bench: side by side, slider, flicker, difference, FLIP; one zoom for all.

const MODES = {
  side: "Side by side", slider: "Slider", flicker: "Flicker", difference: "Difference",
  flip: "FLIP", hdr_flip: "HDR-FLIP",
};
const byId = (id) => document.getElementById(id);

class Viewer extends EventTarget {
  constructor() {
    super();
    this.a = (jobs.get(study.reference)?.width ? study.reference : pictured[0].id);
    this.b = (pictured.find((job) => job.id !== this.a) ?? pictured[0]).id;
    this.mode = "slider";
    this.channel = "rgb";
    this.exposure = 0;
    this.stops = -2; // the difference's full scale is 2 to this
    this.split = 0.5;
    this.showsB = false;
    this.orders = false;
    this.scale = null; // screen pixels per picture pixel; null: fits
    this.middle = [0.5, 0.5]; // of the view, in shares of the picture
    this.drawn = 0;
    this.canvases = [byId("first"), byId("second")];
    this.shown = remembered((key) => shownCanvas(...JSON.parse(key)), 6);
    this.differences = remembered((key) => differenceCanvas(...JSON.parse(key)), 2);
    this.maps = remembered((key) => mapCanvas(...JSON.parse(key)), 4);
    for (const canvas of this.canvases) this.listen(canvas);
    new ResizeObserver(() => this.draw()).observe(byId("panes"));
  }

  set(changes) {
    Object.assign(this, changes);
    this.dispatchEvent(new Event("change"));
    return this.draw();
  }

  get job() {
    return jobs.get(this.a);
  }

  get comparable() {
    const [a, b] = [jobs.get(this.a), jobs.get(this.b)];
    return a.width === b.width && a.height === b.height;
  }

  /** The maps compare with the reference only; an explanation when there is none of this B. */
  why(mode) {
    if (mode === "difference" && !this.comparable) return "A and B have different sizes";
    if (!mode.endsWith("flip") || jobs.get(this.b).maps.includes(mode)) return "";
    return study.reference ? "no map of B was computed" : "there is no picture of a reference";
  }

  layer(id) {
    return this.shown(JSON.stringify([id, this.exposure, this.channel]));
  }

  async draw() {
    const turn = ++this.drawn;
    const mode = this.why(this.mode) ? "side" : this.mode;
    let layers;
    if (mode === "difference") {
      layers = [this.differences(JSON.stringify([this.a, this.b, 2 ** this.stops, this.channel]))];
    } else if (mode.endsWith("flip")) {
      layers = [this.maps(JSON.stringify([this.b, mode]))];
    } else if (mode === "flicker") {
      layers = [this.layer(this.showsB ? this.b : this.a)];
    } else {
      layers = [this.layer(this.a), this.layer(this.b)];
    }
    layers = await Promise.all(layers);
    this.curves = this.orders ? await Promise.all([this.a, this.b].map(curvesOf)) : null;
    if (turn !== this.drawn) return;
    const two = mode === "side";
    byId("panes").classList.toggle("two", two);
    byId("panes").style.setProperty("--aspect", layers[0].width / layers[0].height);
    this.canvases[1].parentElement.hidden = !two;
    this.label(mode);
    this.paint(this.canvases[0], layers[0], mode === "slider" ? layers[1] : null);
    if (two) this.paint(this.canvases[1], layers[1], null);
    document.documentElement.dataset.drawn = String(turn);
  }

  label(mode) {
    const tags = [...document.querySelectorAll(".pane .tag:not(.right)")];
    byId("tag-right").hidden = mode !== "slider";
    byId("tag-right").textContent = `B  ${this.b}`;
    const text = {
      side: `A  ${this.a}`, slider: `A  ${this.a}`,
      flicker: this.showsB ? `B  ${this.b}` : `A  ${this.a}`, difference: `|A − B|`,
      flip: `FLIP of B  ${this.b}  against ${study.reference}`,
      hdr_flip: `HDR-FLIP of B  ${this.b}  against ${study.reference}`,
    }[mode];
    tags[0].textContent = text;
    tags[1].textContent = `B  ${this.b}`;
    this.canvases[0].setAttribute("aria-label", text);
    this.canvases[1].setAttribute("aria-label", `B ${this.b}`);
  }

  /** Screen pixels per picture pixel, and where the picture's corner is on a canvas. */
  placement(canvas, width, height) {
    const ratio = devicePixelRatio;
    const size = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    const fit = Math.min(size[0] / width, size[1] / height);
    const scale = this.scale ? this.scale * ratio : fit;
    return {
      size, scale, fit: fit / ratio,
      x: size[0] / 2 - this.middle[0] * width * scale,
      y: size[1] / 2 - this.middle[1] * height * scale,
    };
  }

  paint(canvas, first, second) {
    const { size, scale, x, y } = this.placement(canvas, first.width, first.height);
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    const context = canvas.getContext("2d");
    context.clearRect(0, 0, ...size);
    context.imageSmoothingEnabled = scale < 1.5;
    context.imageSmoothingQuality = "high";
    const [width, height] = [first.width * scale, first.height * scale];
    context.drawImage(first, x, y, width, height);
    if (second) {
      const edge = this.split * size[0];
      context.save();
      context.beginPath();
      context.rect(edge, 0, size[0], size[1]);
      context.clip();
      context.clearRect(0, 0, ...size);
      context.drawImage(second, x, y, width, height);
      context.restore();
      context.fillStyle = "#fff";
      context.fillRect(edge - devicePixelRatio, 0, 2 * devicePixelRatio, size[1]);
      context.beginPath();
      context.arc(edge, size[1] / 2, 9 * devicePixelRatio, 0, 7);
      context.fill();
    }
    if (this.curves) {
      const isB = canvas === this.canvases[1] || (this.mode === "flicker" && this.showsB);
      drawOrders(context, this.curves[Number(isB)], x, y, scale);
    }
  }

  zoom(factor, canvas = this.canvases[0], at = null) {
    const { width, height } = this.job;
    const { fit, scale, x, y, size } = this.placement(canvas, width, height);
    const before = this.scale ?? fit;
    const after = Math.min(Math.max(before * factor, fit / 2), 64);
    const ratio = devicePixelRatio;
    const anchor = at ? [at[0] * ratio, at[1] * ratio] : [size[0] / 2, size[1] / 2];
    const point = [(anchor[0] - x) / scale, (anchor[1] - y) / scale];
    this.set({
      scale: after,
      middle: [
        (point[0] - (anchor[0] - size[0] / 2) / (after * ratio)) / width,
        (point[1] - (anchor[1] - size[1] / 2) / (after * ratio)) / height,
      ],
    });
  }

  move(dx, dy) {
    const { width, height } = this.job;
    const { fit } = this.placement(this.canvases[0], width, height);
    const scale = this.scale ?? fit;
    const clamp = (value) => Math.min(Math.max(value, 0), 1);
    this.set({
      scale,
      middle: [
        clamp(this.middle[0] - dx / scale / width), clamp(this.middle[1] - dy / scale / height),
      ],
    });
  }

  listen(canvas) {
    const pointers = new Map();
    let divides = false;
    const place = (event) => [event.offsetX, event.offsetY];
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, place(event));
      divides = this.mode === "slider"
        && Math.abs(event.offsetX - this.split * canvas.clientWidth) < 16;
    });
    canvas.addEventListener("pointermove", (event) => {
      this.readOut(canvas, place(event));
      const last = pointers.get(event.pointerId);
      if (!last) return;
      const now = place(event);
      pointers.set(event.pointerId, now);
      if (divides) {
        this.set({ split: Math.min(Math.max(now[0] / canvas.clientWidth, 0), 1) });
      } else if (pointers.size === 2) {
        const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
        const spread = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
        const centre = [(now[0] + other[0]) / 2, (now[1] + other[1]) / 2];
        this.zoom(spread(now) / Math.max(spread(last), 1), canvas, centre);
      } else {
        this.move(now[0] - last[0], now[1] - last[1]);
      }
    });
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
    }
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(2 ** (-event.deltaY / 240), canvas, place(event));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const action = {
        "+": () => this.zoom(1.5), "=": () => this.zoom(1.5), "-": () => this.zoom(1 / 1.5),
        0: () => this.fit(), ArrowLeft: () => this.move(40, 0), ArrowRight: () => this.move(-40, 0),
        ArrowUp: () => this.move(0, 40), ArrowDown: () => this.move(0, -40),
        " ": () => (this.mode === "flicker" ? this.set({ showsB: !this.showsB }) : this.swap()),
      }[event.key];
      if (!action || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      action();
    });
  }

  fit() {
    this.set({ scale: null, middle: [0.5, 0.5] });
  }

  swap() {
    this.set({ a: this.b, b: this.a });
  }

  async readOut(canvas, at) {
    const { width, height } = this.job;
    const { scale, x, y } = this.placement(canvas, width, height);
    const column = Math.floor((at[0] * devicePixelRatio - x) / scale);
    const row = Math.floor((at[1] * devicePixelRatio - y) / scale);
    if (column < 0 || row < 0 || column >= width || row >= height) return;
    const lines = [`x ${column}  y ${row}`];
    for (const [name, id] of [["A", this.a], ["B", this.b]]) {
      const job = jobs.get(id);
      if (column >= job.width || row >= job.height) continue;
      const bits = await pixelsOf(id);
      const values = [0, 1, 2].map((plane) =>
        HALF[bits[plane * job.width * job.height + row * job.width + column]].toPrecision(3));
      lines.push(`${name} ${values.join(" ")}`);
    }
    byId("readout").textContent = lines.join("    ");
  }
}

/** Orders as lines in the colour of their wavelength on a dark edge, with a label each. */
function drawOrders(context, curves, x, y, scale) {
  const ratio = devicePixelRatio;
  context.save();
  context.lineCap = "round";
  for (const curve of curves) {
    const path = new Path2D();
    const s = curve.segments;
    for (let i = 0; i < s.length; i += 4) {
      path.moveTo(x + s[i] * scale, y + s[i + 1] * scale);
      path.lineTo(x + s[i + 2] * scale, y + s[i + 3] * scale);
    }
    context.setLineDash(curve.order === null ? [6 * ratio, 6 * ratio] : []);
    context.strokeStyle = "rgb(0 0 0 / .75)";
    context.lineWidth = 3.5 * ratio;
    context.stroke(path);
    context.strokeStyle = ORDER_COLOURS[curve.nm] ?? "#ffffff";
    context.lineWidth = 1.6 * ratio;
    context.stroke(path);
  }
  context.setLineDash([]);
  context.font = `${12 * ratio}px system-ui, sans-serif`;
  const taken = [];
  for (const curve of curves) labelOrder(context, curve, x, y, scale, taken);
  context.restore();
}

const ORDER_COLOURS = { 450: "#6ea8ff", 550: "#6fe36f", 650: "#ff6a5c" };

/** At the first place on the curve that is inside the picture and free. */
function labelOrder(context, curve, x, y, scale, taken) {
  const ratio = devicePixelRatio;
  const order = String(curve.order).replace("-", "−");
  const text = curve.order === null ? "q·τ = 0" : curve.nm ? `${order}: ${curve.nm} nm` : "order 0";
  const s = curve.segments;
  for (let i = 0; i < s.length; i += 4) {
    const at = [x + s[i] * scale + 6 * ratio, y + s[i + 1] * scale - 7 * ratio];
    const inside = at[0] > 0 && at[1] > 40 * ratio
      && at[0] < context.canvas.width - 80 * ratio && at[1] < context.canvas.height;
    const free = taken.every(([u, v]) =>
      Math.abs(u - at[0]) > 84 * ratio || Math.abs(v - at[1]) > 17 * ratio);
    if (!inside || !free) continue;
    taken.push(at);
    context.lineWidth = 4 * ratio;
    context.lineJoin = "round";
    context.strokeStyle = "rgb(0 0 0 / .85)";
    context.strokeText(text, ...at);
    context.fillStyle = ORDER_COLOURS[curve.nm] ?? "#ffffff";
    context.fillText(text, ...at);
    return;
  }
}
