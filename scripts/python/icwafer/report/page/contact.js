// SPDX-License-Identifier: GPL-2.0-or-later
// The sweep as a grid of small pictures with the axes' values at its edges; a click makes it B.

function choice(label, options, chosen, change) {
  const select = element("select");
  for (const [value, text] of options) {
    select.append(element("option", { value: String(value), selected: value === chosen }, text));
  }
  select.addEventListener("change", () => change(select.value));
  return element("label", { class: "control" }, label, select);
}

class ContactSheet {
  constructor(viewer) {
    this.viewer = viewer;
    const swept = study.axes.filter((axis) => axis.values.length > 1);
    if (!swept.length) {
      byId("sheet").hidden = true;
      return;
    }
    const byLength = [...swept].sort((one, two) => two.values.length - one.values.length);
    this.swept = swept;
    this.across = byLength[0];
    this.down = byLength[1] ?? null;
    this.fixed = new Map(swept.map((axis) => [axis.name, 0]));
    this.jobs = new Map(study.jobs.map((job) => [this.key((axis) => job.settings[axis.name]), job]));
    viewer.addEventListener("change", () => this.mark());
    this.build();
  }

  build() {
    const named = (name) => this.swept.find((axis) => axis.name === name) ?? null;
    const options = this.swept.map((axis) => [axis.name, axis.name]);
    const controls = byId("sheet-controls");
    controls.replaceChildren(
      choice("Across", options, this.across.name, (name) => {
        if (this.down?.name === name) this.down = this.across;
        this.across = named(name);
        this.build();
      }),
    );
    if (this.swept.length > 1) {
      controls.append(choice("Down", [["", "(nothing)"], ...options], this.down?.name ?? "", (name) => {
        if (this.across.name === name) this.across = this.down ?? this.across;
        this.down = this.across.name === name ? null : named(name);
        this.build();
      }));
    }
    for (const axis of this.swept) {
      if (axis === this.across || axis === this.down) continue;
      const values = axis.values.map((value, i) => [i, formatted(value)]);
      controls.append(choice(withUnit(axis), values, this.fixed.get(axis.name), (i) => {
        this.fixed.set(axis.name, Number(i));
        this.build();
      }));
    }
    this.fill();
  }

  fill() {
    const grid = byId("sheet-grid");
    const rows = this.down ? this.down.values : [null];
    const columns = this.across.values;
    grid.style.gridTemplateColumns =
      `${this.down ? "minmax(5em, max-content) " : ""}repeat(${columns.length}, var(--cell))`;
    const corner = this.down ? [element("div", { class: "axis name" }, withUnit(this.down))] : [];
    const title = element("div", { class: "axis name" }, withUnit(this.across));
    title.style.gridColumn = `${this.down ? 2 : 1} / -1`;
    const heads = columns.map((value) => element("div", { class: "axis" }, formatted(value)));
    const blank = this.down ? [element("div")] : [];
    const cells = rows.flatMap((row) => [
      ...(this.down ? [element("div", { class: "axis" }, formatted(row))] : []),
      ...columns.map((column) => this.cell(row, column)),
    ]);
    grid.replaceChildren(...corner, title, ...blank, ...heads, ...cells);
    this.mark();
  }

  /** One text for a combination of the axes' values. */
  key(valueOf) {
    return JSON.stringify(this.swept.map(valueOf));
  }

  cell(row, column) {
    const job = this.jobs.get(this.key((axis) => axis === this.across ? column
      : axis === this.down ? row : axis.values[this.fixed.get(axis.name)]));
    if (!job?.width) {
      return element("div", { class: "cell missing" }, job ? `${job.id}: ${job.error}` : "not rendered");
    }
    const button = element("button", { type: "button", class: "cell", "data-job": job.id, title: `${job.id}: make it B` },
      element("img", { src: job.thumbnail, alt: job.id, loading: "lazy" }));
    button.addEventListener("click", () => this.viewer.set({ b: job.id }));
    return button;
  }

  mark() {
    for (const cell of byId("sheet-grid").querySelectorAll("[data-job]")) {
      cell.classList.toggle("of-a", cell.dataset.job === this.viewer.a);
      cell.classList.toggle("of-b", cell.dataset.job === this.viewer.b);
    }
  }
}
