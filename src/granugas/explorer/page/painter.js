// Disks as pixels. Small ones are stamps that are blended into an image, large ones arcs of the canvas.

import { SIZES } from "./clusters.js";

/** Stamps are made for so many places of a centre within a pixel, along each axis. */
const PHASES = 4;

/** Radius in pixels above which disks are drawn as arcs; there are few of them then. */
const STAMPED = 20;

/** Radius in pixels below which no disk is drawn: its colour would not be seen. */
const SMALLEST = 0.85;

export const BACKGROUND = "#10141c";

/** Red, green and blue of "#rrggbb" as a pixel. */
export const pixelOf = (colour) => {
  const value = parseInt(colour.slice(1), 16);
  return ((0xff << 24) | ((value & 0xff) << 16) | (value & 0xff00) | (value >> 16)) >>> 0;
};

/** Share of a pixel, from 0 to 256, that a disk covers whose centre is at (x, y) from the pixel's own. */
function coverage(radius, x, y) {
  const distance = Math.hypot(x, y);
  if (distance >= radius + 0.71) return 0;
  if (distance <= radius - 0.71) return 256;
  let inside = 0;
  for (let i = -3.5; i < 4; i++) for (let j = -3.5; j < 4; j++) inside += Math.hypot(x + i / 8, y + j / 8) < radius;
  return inside * 4;
}

/** A disk at each phase: offsets of its pixels in an image of that width, and how much of them it covers. */
function stampsOf(radius, width) {
  const reach = Math.ceil(radius + 1);
  return Array.from({ length: PHASES * PHASES }, (_, phase) => {
    const [x, y] = [((phase % PHASES) + 0.5) / PHASES, (Math.floor(phase / PHASES) + 0.5) / PHASES];
    const [offsets, shares] = [[], []];
    for (let row = -reach; row <= reach; row++) {
      for (let column = -reach; column <= reach; column++) {
        const share = coverage(radius, column + 0.5 - x, row + 0.5 - y);
        if (share > 0) {
          offsets.push(row * width + column);
          shares.push(share);
        }
      }
    }
    return { offsets: Int32Array.from(offsets), shares: Int32Array.from(shares) };
  });
}

/** Mix a colour into a pixel by its share of 256. */
const mix = (colour, below, share) => {
  const rest = 256 - share;
  const redBlue = (((colour & 0xff00ff) * share + (below & 0xff00ff) * rest) >>> 8) & 0xff00ff;
  const green = (((colour & 0xff00) * share + (below & 0xff00) * rest) >>> 8) & 0xff00;
  return (0xff000000 | redBlue | green) >>> 0;
};

/** Call visit(k, x, y) for each disk that is seen, at its pixels; `radius` is the largest one in pixels. */
export function eachSeen(run, frame, camera, radius, visit) {
  const [columns, rows] = run.cells;
  const [cellX, cellY] = [run.box[0] / columns, run.box[1] / rows];
  const scale = camera.scale;
  const [stepX, stepY] = [(cellX * scale) / 2 ** run.bits, (cellY * scale) / 2 ** run.bits];
  const places = Array.from({ length: columns }, (_, column) => camera.columns(column * cellX, cellX * scale + radius));
  for (let row = 0; row < rows; row++) {
    for (const up of camera.rows(row * cellY, cellY * scale + radius)) {
      for (let column = 0; column < columns; column++) {
        const home = row * columns + column;
        const [first, last] = [frame.start[home], frame.start[home + 1]];
        if (first === last) continue;
        for (const across of places[column]) {
          for (let k = first; k < last; k++) {
            const x = across + (frame.x[k] + 0.5) * stepX;
            const y = camera.height - up - (frame.y[k] + 0.5) * stepY;
            if (x > -radius && x < camera.width + radius && y > -radius && y < camera.height + radius) visit(k, x, y);
          }
        }
      }
    }
  }
}

/** Radius of a disk in pixels, as it is drawn. */
export function radiusOf(run, frame, camera, k) {
  return Math.max(SMALLEST, (camera.scale / 2) * (frame.size ? (run.largest_diameter * frame.size[k]) / SIZES : 1));
}

export class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d", { alpha: false });
    this.stamps = new Map();
  }

  /** Draw a frame; the colour of disk k is palette[index[k]], pixels. */
  paint(run, frame, camera, palette, index) {
    const largest = Math.max(SMALLEST, (camera.scale / 2) * run.largest_diameter);
    if (largest > STAMPED) this.paintArcs(run, frame, camera, palette, index, largest);
    else this.paintStamps(run, frame, camera, palette, index, largest);
  }

  paintStamps(run, frame, camera, palette, index, largest) {
    const border = Math.ceil(largest) * 2 + 4; // what sticks out of the picture has room here
    const [width, height] = [camera.width + 2 * border, camera.height + 2 * border];
    if (this.image?.width !== width || this.image?.height !== height) {
      this.image = new ImageData(width, height);
      this.pixels = new Uint32Array(this.image.data.buffer);
      this.stamps.clear();
    }
    const pixels = this.pixels.fill(pixelOf(BACKGROUND));
    const equal = frame.size ? null : this.stampsFor(largest, width);
    eachSeen(run, frame, camera, largest, (k, x, y) => {
      const stamps = equal ?? this.stampsFor(radiusOf(run, frame, camera, k), width);
      const [column, row] = [Math.floor(x), Math.floor(y)];
      const phase = Math.floor((y - row) * PHASES) * PHASES + Math.floor((x - column) * PHASES);
      const { offsets, shares } = stamps[phase];
      const origin = (row + border) * width + column + border;
      const colour = palette[index[k]];
      for (let p = 0; p < offsets.length; p++) {
        const at = origin + offsets[p];
        pixels[at] = shares[p] === 256 ? colour : mix(colour, pixels[at], shares[p]);
      }
    });
    this.context.putImageData(this.image, -border, -border, border, border, camera.width, camera.height);
  }

  paintArcs(run, frame, camera, palette, index, largest) {
    const context = this.context;
    context.fillStyle = BACKGROUND;
    context.fillRect(0, 0, camera.width, camera.height);
    eachSeen(run, frame, camera, largest, (k, x, y) => {
      const pixel = palette[index[k]];
      context.fillStyle = `rgb(${pixel & 0xff} ${(pixel >> 8) & 0xff} ${(pixel >> 16) & 0xff})`;
      context.beginPath();
      context.arc(x, y, radiusOf(run, frame, camera, k), 0, 2 * Math.PI);
      context.fill();
    });
  }

  /** Stamps of a radius, to a sixteenth of a pixel where there are many radii. */
  stampsFor(radius, width) {
    const key = Math.round(radius * 64) / 64;
    if (!this.stamps.has(key)) {
      if (this.stamps.size > 256) this.stamps.clear();
      this.stamps.set(key, stampsOf(key, width));
    }
    return this.stamps.get(key);
  }
}
