// SPDX-License-Identifier: GPL-2.0-or-later
// Pixels, maps and tables out of the page; the other side of encode.py.

const study = JSON.parse(document.getElementById("study").textContent);
const jobs = new Map(study.jobs.map((job) => [job.id, job]));
const pictured = study.jobs.filter((job) => job.width);

const HALF = new Float32Array(0x7c00);
for (let bits = 0; bits < HALF.length; ++bits) {
  const exponent = bits >> 10;
  const fraction = (bits & 1023) / 1024;
  HALF[bits] = exponent ? 2 ** (exponent - 15) * (1 + fraction) : 2 ** -14 * fraction;
}

const blobs = new Map([...document.querySelectorAll("script[data-name]")]
  .map((element) => [element.dataset.name, element]));

async function unpack(name) {
  const element = blobs.get(name);
  const packed = Uint8Array.from(atob(element.textContent), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Bits of half floats, three planes of width x height. */
async function unpackPixels(job) {
  const bytes = await unpack(`pixels:${job.id}`);
  const count = bytes.length / 2;
  const bits = new Uint16Array(count);
  for (let i = 0; i < count; i += job.width) {
    let value = 0;
    for (let j = i; j < i + job.width; ++j) {
      value = (value + (bytes[j] << 8) + bytes[count + j]) & 0xffff;
      bits[j] = value;
    }
  }
  return bits;
}

/** A map of 0 to 255, width x height. */
async function unpackMap(job, kind) {
  const levels = await unpack(`${kind}:${job.id}`);
  for (let i = 0; i < levels.length; i += job.width) {
    for (let j = i + 1; j < i + job.width; ++j) levels[j] = (levels[j] + levels[j - 1]) & 255;
  }
  return levels;
}

/** Keeps the latest results of an asynchronous function of one text. */
function remembered(make, most) {
  const kept = new Map();
  return (key) => {
    const found = kept.get(key) ?? make(key);
    kept.delete(key);
    kept.set(key, found);
    if (kept.size > most) kept.delete(kept.keys().next().value);
    return found;
  };
}

const pixelsOf = remembered((id) => unpackPixels(jobs.get(id)), 16);
const mapOf = remembered((key) => {
  const kind = key.slice(0, key.indexOf(":"));
  return unpackMap(jobs.get(key.slice(kind.length + 1)), kind);
}, 8);
const curvesOf = remembered(async (id) =>
  (jobs.get(id).orders ? JSON.parse(new TextDecoder().decode(await unpack(`curves:${id}`))) : []), 16);
const tableOf = remembered(async (view) => new Uint16Array((await unpack(`view:${view}`)).buffer), 8);

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key in made && typeof value !== "string") made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

function formatted(value) {
  if (typeof value !== "number") return value === null || value === undefined ? "" : String(value);
  if (Number.isInteger(value)) return String(value);
  const size = Math.abs(value);
  return size >= 1e-3 && size < 1e5 ? String(Number(value.toPrecision(4))) : value.toExponential(2);
}

function withUnit(axis) {
  return axis.unit ? `${axis.name}, ${axis.unit}` : axis.name;
}
