// SPDX-License-Identifier: GPL-2.0-or-later
// A measure over a swept setting, a line for each value of another one.

// Okabe and Ito's colours, told apart with any colour vision, and shapes for print.
const SERIES = ["#e69f00", "#56b4e9", "#009e73", "#cc79a7", "#d55e00", "#4f7fd6", "#b5a000", "#999999"];
const SHAPES = ["circle", "square", "diamond", "triangle"];

function svg(name, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** Round numbers that cover a range, about five. */
function roundTicks(low, high) {
  const rough = (high - low) / 4 || Math.abs(high) || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((factor) => factor * power).find((size) => size >= rough);
  const ticks = [];
  for (let i = Math.floor(low / step + 1e-9); (i - 1) * step < high - step * 1e-9 || ticks.length < 2; ++i) {
    ticks.push(Number((i * step).toPrecision(12)));
  }
  return ticks;
}

class Plots {
  constructor(viewer) {
    this.viewer = viewer;
    this.swept = study.axes.filter((axis) => axis.values.length > 1);
    const measures = Object.keys(study.measures);
    if (!this.swept.length || !measures.length) {
      byId("plots").hidden = true;
      return;
    }
    this.x = this.swept[0];
    this.by = this.swept[1] ?? null;
    this.measure = measures.includes("flip") ? "flip" : measures[0];
    this.build();
    let width = byId("plot").clientWidth;
    new ResizeObserver(() => {
      if (byId("plot").clientWidth === width) return;
      width = byId("plot").clientWidth;
      this.show();
    }).observe(byId("plot"));
  }

  build() {
    const axes = this.swept.map((axis) => [axis.name, axis.name]);
    const named = (name) => this.swept.find((axis) => axis.name === name) ?? null;
    byId("plot-controls").replaceChildren(
      choice("Measure", Object.entries(study.measures), this.measure, (name) => {
        this.measure = name;
        this.build();
      }),
      choice("Over", axes, this.x.name, (name) => {
        if (this.by?.name === name) this.by = this.x;
        this.x = named(name);
        this.build();
      }),
      ...(this.swept.length > 1 ? [choice("A line for each", [["", "(mean of all)"],
        ...axes.filter(([name]) => name !== this.x.name)], this.by?.name ?? "", (name) => {
        this.by = named(name);
        this.build();
      })] : []),
    );
    this.show();
  }

  show() {
    byId("plot").replaceChildren(this.draw());
  }

  /** For each line, its points: place on the axis, mean of the measure, jobs. */
  series() {
    const key = (x, by) => JSON.stringify([x, this.by ? by : null]);
    const groups = new Map();
    for (const job of study.jobs) {
      if (job.measures?.[this.measure] === undefined) continue;
      const place = key(job.settings[this.x.name], this.by && job.settings[this.by.name]);
      if (!groups.has(place)) groups.set(place, []);
      groups.get(place).push(job);
    }
    return (this.by ? this.by.values : [null]).map((value) => this.x.values.map((x) => {
      const found = groups.get(key(x, value)) ?? [];
      const sum = found.reduce((total, job) => total + job.measures[this.measure], 0);
      return { x, y: sum / found.length, found };
    }).filter((point) => point.found.length));
  }

  draw() {
    const width = Math.min(Math.max(byId("plot").clientWidth, 320), 960);
    const [height, left, top, bottom] = [width < 600 ? 280 : 400, 58, 18, 52];
    const right = this.by ? (width < 600 ? 76 : 130) : 24;
    const series = this.series();
    const points = series.flat();
    const numeric = this.x.values.every((value) => typeof value === "number");
    const places = numeric ? this.x.values : this.x.values.map((_, i) => i);
    // Names have no distance: they stand in the middle of equal parts.
    const margin = numeric ? 0 : 0.5;
    const [lowX, highX] = [Math.min(...places) - margin, Math.max(...places) + margin];
    const ys = points.map((point) => point.y);
    const ticks = roundTicks(Math.min(...ys, this.measure === "psnr" ? Infinity : 0), Math.max(...ys));
    const [lowY, highY] = [ticks[0], ticks[ticks.length - 1]];
    const atX = (x) => left + (((numeric ? x : this.x.values.indexOf(x)) - lowX) / (highX - lowX || 1)) * (width - left - right);
    const atY = (y) => height - bottom - ((y - lowY) / (highY - lowY || 1)) * (height - top - bottom);
    const title = `${study.measures[this.measure]}, over ${withUnit(this.x)}`;
    const chart = svg("svg", { class: "chart", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": title });
    for (const tick of ticks) {
      chart.append(
        svg("line", { class: "grid", x1: left, x2: width - right, y1: atY(tick), y2: atY(tick) }),
        svg("text", { class: "quiet", x: left - 10, y: atY(tick) + 4, "text-anchor": "end" }, formatted(tick)),
      );
    }
    let last = -Infinity;
    for (const x of [...this.x.values].sort((one, two) => atX(one) - atX(two))) {
      if (atX(x) - last < 44) continue;
      last = atX(x);
      chart.append(svg("text", { class: "quiet", x: last, y: height - bottom + 20, "text-anchor": "middle" }, formatted(x)));
    }
    chart.append(svg("text", { x: (left + width - right) / 2, y: height - 8, "text-anchor": "middle" }, withUnit(this.x)));
    const labels = [];
    series.forEach((line, i) => this.drawLine(chart, line, i, atX, atY, numeric, labels));
    this.drawLabels(chart, labels, width - right + 12);
    return chart;
  }

  drawLine(chart, line, i, atX, atY, numeric, labels) {
    if (!line.length) return;
    const colour = SERIES[i % SERIES.length];
    const ordered = [...line].sort((one, two) => atX(one.x) - atX(two.x));
    chart.append(svg("polyline", {
      points: ordered.map((point) => `${atX(point.x)},${atY(point.y)}`).join(" "),
      fill: "none", stroke: colour, "stroke-width": 2, "stroke-dasharray": numeric ? "none" : "1 6",
      "stroke-linecap": "round",
    }));
    for (const point of ordered) {
      const mark = svg("path", {
        class: "mark", fill: colour, tabindex: 0, role: "button",
        d: this.shape(SHAPES[i % SHAPES.length], atX(point.x), atY(point.y)),
      }, svg("title", {}, `${point.found.map((job) => job.id).join(", ")}: ${formatted(point.y)}`));
      const choose = () => this.viewer.set({ b: point.found[0].id });
      mark.addEventListener("click", choose);
      mark.addEventListener("keydown", (event) => event.key === "Enter" && choose());
      chart.append(mark);
    }
    const end = ordered[ordered.length - 1];
    if (this.by) {
      labels.push({ y: atY(end.y), colour, text: `${formatted(this.by.values[i])} ${this.by.unit}` });
    }
  }

  /** Beside the lines' ends, moved apart where they would overlap. */
  drawLabels(chart, labels, x) {
    let last = -Infinity;
    for (const label of labels.sort((one, two) => one.y - two.y)) {
      last = Math.max(label.y, last + 17);
      chart.append(
        svg("rect", { x, y: last - 5, width: 10, height: 10, fill: label.colour }),
        svg("text", { x: x + 16, y: last + 4 }, label.text),
      );
    }
  }

  shape(name, x, y) {
    return {
      circle: `M${x - 5.5} ${y}a5.5 5.5 0 1 0 11 0a5.5 5.5 0 1 0 -11 0`,
      square: `M${x - 5} ${y - 5}h10v10h-10z`,
      diamond: `M${x} ${y - 6.5}l6.5 6.5l-6.5 6.5l-6.5 -6.5z`,
      triangle: `M${x} ${y - 6}l6.5 11h-13z`,
    }[name];
  }
}
