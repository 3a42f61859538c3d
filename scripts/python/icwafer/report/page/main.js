// SPDX-License-Identifier: GPL-2.0-or-later
// Ties the page's controls to the viewer.

const viewer = new Viewer();

function radios(container, name, entries, chosen, change) {
  for (const [value, text] of Object.entries(entries)) {
    const input = element("input", { type: "radio", name, value, checked: value === chosen });
    input.addEventListener("change", () => change(value));
    container.append(element("label", {}, input, text));
  }
}

radios(byId("modes"), "mode", MODES, viewer.mode, (mode) => viewer.set({ mode }));
radios(byId("channels"), "channel", CHANNELS, viewer.channel, (channel) => viewer.set({ channel }));

for (const side of ["a", "b"]) {
  const select = byId(`pick-${side}`);
  for (const job of pictured) select.append(element("option", { value: job.id }, job.id));
  select.addEventListener("change", () => viewer.set({ [side]: select.value }));
}

byId("swap").addEventListener("click", () => viewer.swap());
byId("split").addEventListener("input", (event) => viewer.set({ split: Number(event.target.value) }));
byId("full").addEventListener("input", (event) => viewer.set({ stops: Number(event.target.value) }));
byId("exposure").addEventListener("input", (event) => viewer.set({ exposure: Number(event.target.value) }));
byId("exposure-reset").addEventListener("click", () => viewer.set({ exposure: 0 }));
byId("orders").addEventListener("change", (event) => viewer.set({ orders: event.target.checked }));
byId("zoom-in").addEventListener("click", () => viewer.zoom(1.5));
byId("zoom-out").addEventListener("click", () => viewer.zoom(1 / 1.5));
byId("zoom-fit").addEventListener("click", () => viewer.fit());
byId("zoom-one").addEventListener("click", () => viewer.set({ scale: 1 / devicePixelRatio }));

let beat = null;
function flicker(run) {
  clearInterval(beat);
  beat = run
    ? setInterval(() => viewer.set({ showsB: !viewer.showsB }), 1000 / Number(byId("flicker-rate").value))
    : null;
  byId("flicker-run").textContent = run ? "Stop" : "Start";
}
byId("flicker-run").addEventListener("click", () => flicker(!beat));
byId("flicker-rate").addEventListener("input", () => beat && flicker(true));
byId("flicker-step").addEventListener("click", () => viewer.set({ showsB: !viewer.showsB }));

function facts(title, entries) {
  const list = element("dl");
  for (const [name, value] of entries) {
    if (value === null || value === undefined || value === "") continue;
    list.append(element("div", {}, element("dt", {}, name), element("dd", {}, formatted(value))));
  }
  list.setAttribute("aria-label", title);
  return list;
}

function copyButton(text) {
  const button = element("button", { type: "button", class: "copy" }, "Copy command");
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(text);
      button.textContent = "Copied";
    } catch {
      // No clipboard from a file in some browsers: select it, for the keys.
      getSelection().selectAllChildren(button.previousElementSibling);
      button.textContent = "Selected: press Ctrl+C";
    }
    setTimeout(() => (button.textContent = "Copy command"), 2500);
  });
  return button;
}

function card(side) {
  const job = jobs.get(viewer[side]);
  const units = new Map(study.axes.map((axis) => [axis.name, axis.unit]));
  const made = element("div", { class: `card of-${side}` },
    element("h3", {}, `${side.toUpperCase()}  ${job.id}${job.id === study.reference ? "  (reference)" : ""}`),
    facts("Settings", Object.entries(job.settings).map(([name, value]) =>
      [name, `${formatted(value)} ${units.get(name) ?? ""}`])),
    facts("Measures", Object.entries(job.measures).map(([name, value]) => [study.measures[name], value])),
    facts("Render", [
      ["seconds", job.seconds], ["samples", job.samples], ["seed", job.seed],
      ["size", job.original.join(" × ")], ["view transform", job.view],
    ]));
  if (job.command) made.append(element("pre", { class: "command", tabindex: "0" }, job.command), copyButton(job.command));
  return made;
}

function drawBar(mode) {
  const bar = byId("bar-canvas").getContext("2d");
  const image = new ImageData(256, 1);
  for (let i = 0; i < 256; ++i) paint(image.data, i, i);
  bar.putImageData(image, 0, 0);
  const full = mode === "difference" ? 2 ** viewer.stops : 1;
  byId("bar-ticks").replaceChildren(...[0, 0.25, 0.5, 0.75, 1].map((share) =>
    element("span", {}, formatted(share * full))));
  byId("bar-label").textContent = mode === "difference"
    ? "Absolute difference, scene-linear, largest of the channels shown"
    : `Visible difference at ${formatted(study.pixelsPerDegree)} pixels per degree: 0 none, 1 the largest`;
}

function update() {
  const { mode } = viewer;
  for (const input of byId("modes").querySelectorAll("input")) {
    const why = viewer.why(input.value);
    input.disabled = Boolean(why);
    input.parentElement.title = why;
    input.checked = input.value === mode;
  }
  const visible = viewer.why(mode) ? "side" : mode;
  const mapped = visible === "difference" || visible.endsWith("flip");
  byId("pick-a").value = viewer.a;
  byId("pick-b").value = viewer.b;
  byId("split").value = viewer.split;
  byId("exposure").value = viewer.exposure;
  byId("exposure-out").textContent = `${viewer.exposure > 0 ? "+" : ""}${viewer.exposure} EV`;
  byId("full-out").textContent = formatted(2 ** viewer.stops);
  byId("split-control").hidden = visible !== "slider";
  byId("flicker-control").hidden = visible !== "flicker";
  byId("full-control").hidden = visible !== "difference";
  byId("exposure-control").hidden = byId("exposure-reset").hidden = mapped;
  byId("channels").hidden = visible.endsWith("flip");
  byId("orders-control").hidden = !pictured.some((job) => job.orders);
  byId("bar").hidden = !mapped;
  if (mapped) drawBar(visible);
  if (visible !== "flicker" && beat) flicker(false);
}

let cards = "";
viewer.addEventListener("change", () => {
  update();
  if (cards !== viewer.a + "\n" + viewer.b) {
    cards = viewer.a + "\n" + viewer.b;
    byId("facts").replaceChildren(card("a"), card("b"));
  }
});

byId("scale-note").textContent = study.scale < 1
  ? `Pictures are embedded at ${formatted(100 * study.scale)} % of their size; measures are of the originals.`
  : "Pictures are embedded in full size, as half floats, through a table of their view transform.";

byId("colours").hidden = !byId("colours").querySelector("svg");
new ContactSheet(viewer);
new Plots(viewer);
new JobTable(viewer);
new Photo();
for (const link of document.querySelectorAll("nav a")) {
  link.hidden = document.querySelector(link.getAttribute("href")).hidden;
}
viewer.set({});
