// The explorer: what is chosen, and everything that follows from it.

import { unpack } from "./packed.js";
import { findClusters, largestOf } from "./clusters.js";
import { Camera } from "./camera.js";
import { Painter, eachSeen, radiusOf } from "./painter.js";
import { byCluster, byLevel } from "./colours.js";
import { drawBonds, drawEdges, drawNames, drawScaleBar } from "./overlay.js";
import { Plot } from "./curves.js";
import { choices, drawBar, drawTicks, element, figures, press, sceneOf, wordsOfDisk } from "./panel.js";
import { Player } from "./player.js";
import { followPointer } from "./pointer.js";

const NAMES = { energy: "energy", collision_frequency: "collisions", initial_height: "initial height", cluster: "cluster" };

/** Clusters whose sizes are written beside them, and the least of those. */
const [NAMED, LEAST_NAMED] = [5, 10];

/** Pixels of a diameter from which bonds are drawn. */
const BONDS_SEEN = 14;

/** A key moves the view by so many pixels, and zooms by that factor. */
const PAN = 60;
const CLOSER = 1.25;

const { runs, scales, largest_factor } = JSON.parse(element("known").textContent);
const worker = new Worker(URL.createObjectURL(new Blob([element("worker").textContent], { type: "text/javascript" })));
const painter = new Painter(element("disks"));
const plots = { count: element("curve-count"), mean: element("curve-mean"), largest: element("curve-largest") };
for (const name in plots) plots[name] = new Plot(plots[name], (time) => chooseFrame(nearest(time)));

/** What is chosen. */
const chosen = { number: 0, frame: 0, S_c: 1.1, colour: "cluster" };

/** What follows: the run, its frames as far as they are unpacked, the curve of S_c as far as it is known. */
let run, camera, frames, curve;
let clusters = { frame: null, S_c: 0, found: null };
let drawing = false;

const player = new Player(
  () => chooseFrame((chosen.frame + 1) % run.frames.length),
  (playing) => {
    element("play").textContent = playing ? "❚❚" : "▶";
    element("play").setAttribute("aria-label", playing ? "pause" : "play");
  },
);

const textOf = (k) => element(`frame-${chosen.number}-${k}`).textContent;
const frameOf = (k) => (frames[k] ??= unpack(textOf(k), run.frames[k].layout));

/** The frame whose time is nearest, by its logarithm. */
function nearest(time) {
  const far = (frame) => Math.abs(Math.log(frame.time / time));
  return run.frames.reduce((best, frame, k) => (far(frame) < far(run.frames[best]) ? k : best), 0);
}

function chooseRun(number) {
  chosen.number = number;
  run = runs[number];
  frames = [];
  camera = new Camera(run.box, run.periodic);
  chosen.frame = Math.min(chosen.frame, run.frames.length - 1);
  const colours = [...run.colours, "cluster"];
  if (!colours.includes(chosen.colour)) chosen.colour = "cluster";
  element("run").value = number;
  element("scene").textContent = sceneOf(run);
  element("frame").max = run.frames.length - 1;
  drawTicks(element("ticks"), run.frames.map(({ time }) => time));
  choices(element("colours"), "radio", colours.map((name, k) => [name, NAMES[name], `key ${k + 1}`]), chooseColour);
  choices(element("chips"), null, run.factors.map((S_c) => [S_c, S_c, `S_c = ${S_c}, as in the dataset`]), chooseFactor);
  drawAxes();
  ask({ run, texts: run.frames.map((_, k) => textOf(k)) });
  chooseColour(chosen.colour);
  resize();
  unpackAll(run);
}

/** Unpack all frames, one after the other, so that play does not wait. */
async function unpackAll(of) {
  for (let k = 0; k < of.frames.length && run === of; k++) await frameOf(k);
}

function drawAxes() {
  const times = run.frames.map(({ time }) => time).filter((time) => time > 0);
  const known = run.curves;
  const grey = (values) =>
    (known?.distance_factor ?? []).map((label, c) => ({ label, times: known.time, values: values[c] }));
  const span = [times[0], times.at(-1)];
  plots.count.begin(span, grey(known?.cluster_count));
  plots.mean.begin(span, grey(known?.mean_cluster_size));
  plots.largest.begin(span, grey(known?.largest_cluster_size));
}

/** Let the worker find the curve of S_c. */
function ask(what) {
  curve = { S_c: chosen.S_c, found: [] };
  element("curves").setAttribute("aria-busy", "true");
  worker.postMessage({ number: chosen.number, S_c: chosen.S_c, ...what });
}

worker.onmessage = ({ data }) => {
  if (data.number !== chosen.number || data.S_c !== curve.S_c) return;
  curve.found[data.frame] = data.found;
  if (!curve.late) {
    curve.late = true;
    requestAnimationFrame(showCurve);
  }
};

function showCurve() {
  curve.late = false;
  const times = run.frames.map(({ time }) => time);
  element("curves").setAttribute("aria-busy", String(times.some((_, k) => !curve.found[k])));
  for (const name in plots) plots[name].live(times, times.map((_, k) => curve.found[k]?.[name]));
}

function chooseFrame(k) {
  chosen.frame = Math.min(Math.max(k, 0), run.frames.length - 1);
  refresh();
}

function chooseFactor(value) {
  chosen.S_c = Number(Math.min(Math.max(value, 1), largest_factor).toFixed(6));
  ask({});
  refresh();
}

function chooseColour(name) {
  chosen.colour = name;
  press(element("colours"), "aria-checked", name);
  drawBar(element("bar"), scales[name]);
  refresh();
}

/** Draw soon, once, however often it is asked. */
function refresh() {
  if (drawing) return;
  drawing = true;
  element("picture").setAttribute("aria-busy", "true");
  requestAnimationFrame(draw);
}

async function draw() {
  const [of, k] = [run, chosen.frame];
  const frame = await frameOf(k);
  drawing = false;
  if (of !== run || k !== chosen.frame) return refresh();
  const begun = performance.now();
  const { palette, index } =
    chosen.colour === "cluster" ? byCluster(clustersOf(frame)) : byLevel(scales[chosen.colour], frame[chosen.colour]);
  painter.paint(run, frame, camera, palette, index);
  drawOver(frame);
  showNumbers(frame);
  element("picture").setAttribute("aria-busy", "false");
  element("drawn").textContent = `drawn in ${(performance.now() - begun).toFixed(0)} ms`;
}

/** The clusters of a frame at the chosen S_c; the last answer is kept. */
function clustersOf(frame) {
  if (clusters.frame !== frame || clusters.S_c !== chosen.S_c) {
    clusters = { frame, S_c: chosen.S_c, found: findClusters(run, frame, chosen.S_c) };
  }
  return clusters.found;
}

function drawOver(frame) {
  const dots = window.devicePixelRatio;
  const context = painter.context;
  const byClusters = chosen.colour === "cluster";
  if (byClusters && camera.scale > BONDS_SEEN * dots) drawBonds(context, run, frame, camera, chosen.S_c);
  context.lineWidth = dots;
  drawEdges(context, camera);
  if (byClusters) drawNames(context, camera, largestOf(run, frame, clustersOf(frame), NAMED, LEAST_NAMED), dots);
  drawScaleBar(context, camera, dots);
  const [wide, high] = camera.seen.map((side) => Number(side.toPrecision(3)));
  element("view").textContent = `view ${wide} d × ${high} d = ${camera.zoom === 1 ? "the whole box" : `box / ${figures(camera.zoom, 3)}`}`;
}

function showNumbers(frame) {
  const about = run.frames[chosen.frame];
  const { count, mean, largest } = (curve.S_c === chosen.S_c && curve.found[chosen.frame]) || clustersOf(frame);
  const shown = {
    time: `${figures(about.time)} s`,
    kinetic_energy: figures(about.kinetic_energy),
    collisions_per_particle: figures(about.collisions_per_particle),
    cluster_count: String(count),
    mean_cluster_size: figures(mean, 6),
    largest_cluster_size: String(largest),
    "factor-value": chosen.S_c.toFixed(3),
    exactness: run.factors.includes(chosen.S_c)
      ? "At this S_c the numbers are those of the dataset."
      : `Places are rounded: S_c is good to ${figures(run.margin, 1)}.`,
  };
  for (const id in shown) element(id).textContent = shown[id];
  element("frame").value = chosen.frame;
  element("frame").setAttribute("aria-valuetext", shown.time);
  element("factor").value = chosen.S_c;
  press(element("chips"), "aria-pressed", chosen.S_c);
  for (const name in plots) plots[name].now(about.time);
}

/** Fit the picture into its place, in whole pixels of the screen. */
function resize() {
  const place = element("picture").getBoundingClientRect();
  const dots = window.devicePixelRatio;
  const scale = Math.min(place.width / run.box[0], place.height / run.box[1]) * dots;
  const [width, height] = run.box.map((side) => Math.max(Math.floor(side * scale), 1));
  Object.assign(painter.canvas, { width, height });
  Object.assign(painter.canvas.style, { width: `${width / dots}px`, height: `${height / dots}px` });
  camera.resize(width, height);
  refresh();
}

function zoom(factor, x = camera.width / 2, y = camera.height / 2) {
  camera.zoomAt(factor, x, y);
  refresh();
}

function pan(across, down) {
  camera.pan(across, down);
  refresh();
}

/** Say what the disk below the pointer is. */
async function point(x, y, event) {
  const frame = await frameOf(chosen.frame);
  let [found, least] = [-1, 3];
  eachSeen(run, frame, camera, (camera.scale / 2) * run.largest_diameter, (k, atX, atY) => {
    const apart = Math.hypot(atX - x, atY - y) - radiusOf(run, frame, camera, k);
    if (apart < least) [found, least] = [k, apart];
  });
  const hover = element("hover");
  hover.hidden = found < 0;
  if (found < 0) return;
  hover.textContent = wordsOfDisk(run, frame, scales, clustersOf(frame), found, camera.placeAt(x, y));
  const place = element("picture").getBoundingClientRect();
  hover.style.left = `${Math.min(event.clientX - place.left + 14, place.width - hover.offsetWidth)}px`;
  hover.style.top = `${Math.min(event.clientY - place.top + 14, place.height - hover.offsetHeight)}px`;
}

const KEYS = {
  " ": () => player.toggle(),
  ArrowRight: () => chooseFrame(chosen.frame + 1),
  ArrowLeft: () => chooseFrame(chosen.frame - 1),
  Home: () => chooseFrame(0),
  End: () => chooseFrame(run.frames.length - 1),
  ArrowUp: (fine) => chooseFactor(chosen.S_c + (fine ? 0.001 : 0.01)),
  ArrowDown: (fine) => chooseFactor(chosen.S_c - (fine ? 0.001 : 0.01)),
  "+": () => zoom(CLOSER),
  "=": () => zoom(CLOSER),
  "-": () => zoom(1 / CLOSER),
  0: () => {
    camera.fit();
    refresh();
  },
  w: () => pan(0, PAN),
  s: () => pan(0, -PAN),
  a: () => pan(PAN, 0),
  d: () => pan(-PAN, 0),
  "[": () => chooseRun(Math.max(chosen.number - 1, 0)),
  "]": () => chooseRun(Math.min(chosen.number + 1, runs.length - 1)),
  "?": () => element("help").showModal(),
  ...Object.fromEntries([1, 2, 3, 4].map((k) => [k, () => element("colours").children[k - 1]?.click()])),
};

document.addEventListener("keydown", (event) => {
  const { target, key, shiftKey, ctrlKey, metaKey, altKey } = event;
  const act = KEYS[key.length === 1 ? key.toLowerCase() : key];
  const own = target.closest("select, dialog") || (key === " " && target.closest("button"));
  const sliding = target.type === "range" && key !== " " && key.length > 1;
  if (!act || own || sliding || ctrlKey || metaKey || altKey) return;
  event.preventDefault();
  act(shiftKey);
});

function listen() {
  followPointer(painter.canvas, { zoom, pan, point, leave: () => (element("hover").hidden = true) });
  element("closer").addEventListener("click", () => zoom(CLOSER));
  element("farther").addEventListener("click", () => zoom(1 / CLOSER));
  element("fit").addEventListener("click", KEYS[0]);
  element("play").addEventListener("click", () => player.toggle());
  element("help-button").addEventListener("click", KEYS["?"]);
  element("run").addEventListener("change", (event) => chooseRun(Number(event.target.value)));
  element("rate").addEventListener("change", (event) => (player.rate = Number(event.target.value)));
  element("frame").addEventListener("input", (event) => chooseFrame(Number(event.target.value)));
  element("factor").addEventListener("input", (event) => chooseFactor(Number(event.target.value)));
  new ResizeObserver(resize).observe(element("picture"));
}

element("run").replaceChildren(...runs.map(({ label }, k) => new Option(label, k)));
element("factor").max = largest_factor;
chooseRun(0);
listen();
