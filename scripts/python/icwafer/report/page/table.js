// SPDX-License-Identifier: GPL-2.0-or-later
// All jobs with their settings and measures; sorts by any column, filters by words and values.

/** Rows that are drawn at first, and more at each wish: thousands would take seconds. */
const ROWS = 200;

class JobTable {
  constructor(viewer) {
    this.viewer = viewer;
    this.columns = this.describe();
    this.sorted = { column: null, direction: 1 };
    this.most = ROWS;
    this.body = element("tbody");
    this.head = element("tr", {}, element("th", { scope: "col" }, "Picture"), ...this.columns.map((column) => {
      const button = element("button", { type: "button" }, column.title);
      button.addEventListener("click", () => this.sort(column));
      return element("th", { scope: "col", class: column.number ? "number" : "" }, button);
    }));
    byId("jobs").append(element("thead", {}, this.head), this.body);
    byId("filter").addEventListener("input", () => this.fill());
    byId("more").addEventListener("click", () => {
      this.most += 5 * ROWS;
      this.fill();
    });
    viewer.addEventListener("change", () => this.mark());
    this.fill();
  }

  describe() {
    const settings = [...new Set(study.jobs.flatMap((job) => Object.keys(job.settings)))];
    const units = new Map(study.axes.map((axis) => [axis.name, axis.unit]));
    const columns = [
      { key: "id", title: "Render", value: (job) => job.id },
      ...settings.map((name) => ({
        key: name, title: units.get(name) ? `${name}, ${units.get(name)}` : name, value: (job) => job.settings[name],
      })),
      ...Object.keys(study.measures).map((key) => ({
        key, title: key.replace("_", "-"), value: (job) => job.measures?.[key],
      })),
      ...["seconds", "samples", "seed"].map((key) => ({ key, title: key, value: (job) => job[key] })),
      { key: "error", title: "error", value: (job) => job.error || undefined },
    ].filter((column) => column.key === "id"
      || study.jobs.some((job) => column.value(job) !== undefined && column.value(job) !== null));
    for (const column of columns) {
      column.number = study.jobs.some((job) => typeof column.value(job) === "number");
    }
    return columns;
  }

  sort(column) {
    const direction = this.sorted.column === column ? -this.sorted.direction : 1;
    this.sorted = { column, direction };
    this.fill();
  }

  matches(job, word) {
    const [, name, sign, wanted] = /^([^<>=]+)([<>=])(.+)$/.exec(word) ?? [];
    const column = this.columns.find((each) => each.key.toLowerCase() === name);
    if (column) {
      const value = column.value(job);
      if (sign === "=") return String(value).toLowerCase() === wanted || value === Number(wanted);
      return typeof value === "number" && (sign === "<" ? value < Number(wanted) : value > Number(wanted));
    }
    return this.columns.some((each) => formatted(each.value(job)).toLowerCase().includes(word));
  }

  fill() {
    const words = byId("filter").value.toLowerCase().split(/\s+/).filter(Boolean);
    const rows = study.jobs.filter((job) => words.every((word) => this.matches(job, word)));
    const { column, direction } = this.sorted;
    if (column) {
      // Jobs without a value stay at the end in either direction.
      const has = (job) => column.value(job) !== undefined && column.value(job) !== null;
      rows.sort((one, two) => has(two) - has(one) || (has(one) && direction * this.compare(column.value(one), column.value(two))));
    }
    this.head.querySelectorAll("th").forEach((cell, i) => {
      const sorts = i > 0 && this.columns[i - 1] === column;
      if (sorts) cell.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
      else cell.removeAttribute("aria-sort");
    });
    this.body.replaceChildren(...rows.slice(0, this.most).map((job) => this.row(job)));
    byId("more").hidden = rows.length <= this.most;
    byId("more").textContent = `Show more than the first ${this.most}`;
    byId("filter-count").textContent = `${rows.length} of ${study.jobs.length}`;
    this.mark();
  }

  compare(one, two) {
    return typeof one === "number" && typeof two === "number" ? one - two
      : String(one).localeCompare(String(two), "en", { numeric: true });
  }

  row(job) {
    const first = element("td");
    if (job.width) {
      const choose = ["a", "b"].map((side) => {
        const button = element("button", { type: "button", "aria-label": `Make ${job.id} ${side.toUpperCase()}` }, side.toUpperCase());
        button.addEventListener("click", () => this.viewer.set({ [side]: job.id }));
        return button;
      });
      const image = element("img", { src: job.thumbnail, alt: "", loading: "lazy" });
      const line = element("span", { class: "choose" }, image, ...choose);
      first.append(line);
    }
    return element("tr", { "data-job": job.id }, first, ...this.columns.map((column) => element("td", {
      class: column.key === "error" ? "error" : column.number ? "number" : "",
    }, formatted(column.value(job)))));
  }

  mark() {
    for (const row of this.body.children) {
      row.classList.toggle("of-a", row.dataset.job === this.viewer.a);
      row.classList.toggle("of-b", row.dataset.job === this.viewer.b);
    }
  }
}
