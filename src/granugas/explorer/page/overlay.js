// What is drawn over the disks: edges of the box, a bar of scale, names of the largest clusters.

import { eachBond } from "./clusters.js";
import { eachSeen } from "./painter.js";

const INK = "#f4f6fa";

/** The largest of 1, 2, 5, 10, 20 ... that is not above a length. */
export function roundLength(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return [5, 2, 1].find((k) => k * power <= length) * power;
}

/** The edges of the box where they are inside of the picture. */
export function drawEdges(context, camera) {
  context.strokeStyle = "#8d98ad";
  context.setLineDash([6, 5]);
  context.beginPath();
  for (const x of camera.columns(0, 0)) if (x > 1) line(context, x, 0, x, camera.height);
  for (const y of camera.rows(0, 0)) if (y > 1) line(context, 0, camera.height - y, camera.width, camera.height - y);
  context.stroke();
  context.setLineDash([]);
}

/** Lines between disks that are joined at S_c, where they are large enough to be seen. */
export function drawBonds(context, run, frame, camera, S_c) {
  const places = new Map();
  eachSeen(run, frame, camera, (camera.scale / 2) * run.largest_diameter, (k, x, y) => places.set(k, [x, y]));
  const longest = S_c * camera.scale * run.largest_diameter;
  context.strokeStyle = "#000a";
  context.lineWidth = camera.scale / 9;
  context.beginPath();
  eachBond(run, frame, S_c, (i, j) => {
    const [from, to] = [places.get(i), places.get(j)];
    if (!from || !to || Math.hypot(to[0] - from[0], to[1] - from[1]) > longest * 1.01) return;
    context.moveTo(...from);
    context.lineTo(...to);
  });
  context.stroke();
}

/** A bar of a round number of diameters, with its share of the box; `dots` are pixels of the screen's unit. */
export function drawScaleBar(context, camera, dots) {
  const length = roundLength(camera.seen[0] / 4);
  const words = `${length} d = ${Number((length / camera.box[0]).toPrecision(3))} L`;
  const [x, y, wide] = [14 * dots, camera.height - 16 * dots, length * camera.scale];
  context.font = `600 ${13 * dots}px system-ui, sans-serif`;
  context.textAlign = "left";
  context.fillStyle = "rgb(16 20 28 / 0.8)";
  context.fillRect(x - 8 * dots, y - 27 * dots, Math.max(wide, context.measureText(words).width) + 16 * dots, 37 * dots);
  context.fillStyle = context.strokeStyle = INK;
  context.lineWidth = 2 * dots;
  context.beginPath();
  line(context, x, y, x + wide, y);
  for (const end of [x, x + wide]) line(context, end, y - 4 * dots, end, y + 4 * dots);
  context.stroke();
  context.lineWidth = dots;
  context.fillText(words, x, y - 9 * dots);
  return words;
}

/** The sizes of the largest clusters, at the mean places of their disks: names = [{x, y, size}] in d. */
export function drawNames(context, camera, names, dots) {
  context.font = `700 ${13 * dots}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.lineWidth = 3.5 * dots;
  context.strokeStyle = "#10141c";
  context.fillStyle = INK;
  context.lineJoin = "round";
  for (const { x, y, size } of names) {
    for (const across of camera.columns(x, 0)) {
      for (const up of camera.rows(y, 0)) {
        const words = `M = ${size}`;
        const half = context.measureText(words).width / 2 + 4 * dots;
        const at = [Math.min(Math.max(across, half), camera.width - half), camera.height - up + 5 * dots];
        context.strokeText(words, ...at);
        context.fillText(words, ...at);
      }
    }
  }
  context.lineWidth = dots;
}

function line(context, x1, y1, x2, y2) {
  context.moveTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
  context.lineTo(Math.round(x2) + 0.5, Math.round(y2) + 0.5);
}
