// SPDX-License-Identifier: GPL-2.0-or-later
// Light to what a screen shows, and values of maps to colours.

const CHANNELS = { rgb: "RGB", r: "R", g: "G", b: "B", y: "Y" };
const LUMINANCE = [0.2126, 0.7152, 0.0722];

// Magma (S. van der Walt, N. Smith, matplotlib; CC0) at eleven places: even steps of lightness.
const MAGMA = (() => {
  const places = [
    "000004", "140e36", "3b0f70", "641a80", "8c2981", "b73779",
    "de4968", "f7705c", "fe9f6d", "fecf92", "fcfdbf",
  ].map((hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)));
  const table = new Uint8Array(256 * 3);
  for (let i = 0; i < 256; ++i) {
    const place = (i / 255) * (places.length - 1);
    const low = Math.min(Math.floor(place), places.length - 2);
    for (let c = 0; c < 3; ++c) {
      table[3 * i + c] = places[low][c] + (place - low) * (places[low + 1][c] - places[low][c]);
    }
  }
  return table;
})();

/** Where light lies among the points of a table. */
function tablePlace(light, points) {
  const [first, last] = study.tableStops;
  const place = ((Math.log2(light + 2 ** first) - first) / (last - first)) * (points - 1);
  return Math.min(Math.max(place, 0), points - 1.0001);
}

/** A canvas of a job as a screen shows it, or one of its channels in grey. */
async function shownCanvas(id, exposure, channel) {
  const job = jobs.get(id);
  const [bits, table] = await Promise.all([pixelsOf(id), tableOf(job.view)]);
  const isCurve = table.length === 3 * study.curvePoints;
  const points = isCurve ? study.curvePoints : study.cubePoints;
  const lookUp = isCurve ? lookUpCurve : lookUpCube;
  const gain = 2 ** exposure;
  const places = new Float32Array(HALF.length);
  for (let i = 0; i < places.length; ++i) places[i] = tablePlace(HALF[i] * gain, points);
  const count = job.width * job.height;
  const image = new ImageData(job.width, job.height);
  const only = "rgb".indexOf(channel);
  for (let i = 0; i < count; ++i) {
    let r = places[bits[i]], g = places[bits[count + i]], b = places[bits[2 * count + i]];
    if (channel === "y") {
      const light = LUMINANCE[0] * HALF[bits[i]] + LUMINANCE[1] * HALF[bits[count + i]]
        + LUMINANCE[2] * HALF[bits[2 * count + i]];
      r = g = b = tablePlace(light * gain, points);
    } else if (channel !== "rgb") {
      r = g = b = only === 0 ? r : only === 1 ? g : b;
    }
    lookUp(table, r, g, b, image.data, 4 * i);
  }
  return canvasOf(image);
}

function lookUpCurve(curve, r, g, b, target, at) {
  for (let c = 0; c < 3; ++c) {
    const place = c === 0 ? r : c === 1 ? g : b;
    const low = Math.floor(place);
    const near = curve[3 * low + c];
    target[at + c] = (near + (place - low) * (curve[3 * low + 3 + c] - near)) / 257;
  }
  target[at + 3] = 255;
}

/** Tetrahedral interpolation in a table with red fastest: greys stay grey. */
function lookUpCube(cube, r, g, b, target, at) {
  const n = study.cubePoints;
  const stepR = 3, stepG = 3 * n, stepB = 3 * n * n;
  const base = Math.floor(r) * stepR + Math.floor(g) * stepG + Math.floor(b) * stepB;
  const x = r % 1, y = g % 1, z = b % 1;
  const far = base + stepR + stepG + stepB;
  // From the near corner to the far one along the axes in the order of their fractions.
  let one, two, high, middle, low;
  if (x >= y) {
    if (y >= z) [one, two, high, middle, low] = [stepR, stepR + stepG, x, y, z];
    else if (x >= z) [one, two, high, middle, low] = [stepR, stepR + stepB, x, z, y];
    else [one, two, high, middle, low] = [stepB, stepB + stepR, z, x, y];
  } else if (x >= z) [one, two, high, middle, low] = [stepG, stepG + stepR, y, x, z];
  else if (y >= z) [one, two, high, middle, low] = [stepG, stepG + stepB, y, z, x];
  else [one, two, high, middle, low] = [stepB, stepB + stepG, z, y, x];
  one += base;
  two += base;
  for (let c = 0; c < 3; ++c) {
    target[at + c] = ((1 - high) * cube[base + c] + (high - middle) * cube[one + c]
      + (middle - low) * cube[two + c] + low * cube[far + c]) / 257;
  }
  target[at + 3] = 255;
}

/** A canvas of |A - B|: the largest of the channels, or one; `full` is the end of the scale. */
async function differenceCanvas(idA, idB, full, channel) {
  const job = jobs.get(idA);
  const [a, b] = await Promise.all([pixelsOf(idA), pixelsOf(idB)]);
  const count = job.width * job.height;
  const planes = { r: [0], g: [1], b: [2] }[channel] ?? [0, 1, 2];
  const image = new ImageData(job.width, job.height);
  for (let i = 0; i < count; ++i) {
    let worst = 0, sum = 0;
    for (const plane of planes) {
      const off = HALF[a[plane * count + i]] - HALF[b[plane * count + i]];
      worst = Math.max(worst, Math.abs(off));
      sum += LUMINANCE[plane] * off;
    }
    paint(image.data, i, ((channel === "y" ? Math.abs(sum) : worst) / full) * 255);
  }
  return canvasOf(image);
}

async function mapCanvas(id, kind) {
  const job = jobs.get(id);
  const levels = await mapOf(`${kind}:${id}`);
  const image = new ImageData(job.width, job.height);
  levels.forEach((level, i) => paint(image.data, i, level));
  return canvasOf(image);
}

function paint(data, pixel, level) {
  const entry = 3 * Math.min(255, Math.round(level));
  data[4 * pixel] = MAGMA[entry];
  data[4 * pixel + 1] = MAGMA[entry + 1];
  data[4 * pixel + 2] = MAGMA[entry + 2];
  data[4 * pixel + 3] = 255;
}

function canvasOf(image) {
  const canvas = element("canvas", { width: image.width, height: image.height });
  canvas.getContext("2d").putImageData(image, 0, 0);
  return canvas;
}
