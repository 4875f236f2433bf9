// What the page says in words and numbers beside the picture.

import { CLUSTER_LEGEND, shareOf, wordsFor } from "./colours.js";
import { decades, powerOfTen } from "./curves.js";

export const element = (id) => document.getElementById(id);

/** A number to so many figures, without powers of ten where it reads well. */
export function figures(value, digits = 4) {
  if (value === 0) return "0";
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent >= -3 && exponent < 6) return value.toFixed(Math.max(digits - 1 - exponent, 0));
  return `${(value / 10 ** exponent).toFixed(Math.max(digits - 2, 0))}·${powerOfTen(exponent)}`;
}

/** The scene of a run in one line. */
export function sceneOf(run) {
  const times = run.contact_time.map((time) => `${figures(time, 2)} s`).join(", ");
  const sides = run.box.map((side) => Number(side.toFixed(1)));
  const box = sides[0] === sides[1] ? `L = ${sides[0]} d` : `box ${sides[0]} d × ${sides[1]} d`;
  return `N = ${run.n_particles}, ν = ${run.area_fraction}, r = ${run.restitution}, t_c = ${times}, ${box}, d = ${run.diameter * 1000} mm`;
}

/** Buttons of which one is pressed: [value, words]; choose(value). */
export function choices(host, role, values, choose) {
  host.replaceChildren(
    ...values.map(([value, words, hint]) => {
      const button = Object.assign(document.createElement("button"), { textContent: words, title: hint, value });
      if (role) button.setAttribute("role", role);
      button.addEventListener("click", () => choose(value));
      return button;
    }),
  );
}

/** Show which of the buttons is pressed. */
export function press(host, attribute, value) {
  for (const button of host.children) button.setAttribute(attribute, String(button.value === String(value)));
}

/** The bar of a scale, or what the colours of clusters mean. */
export function drawBar(host, scale) {
  const box = (colour) => `<span class="box" style="background:${colour}"></span>`;
  const words = (entries) => `<div class="words">${entries.join("")}</div>`;
  if (!scale) {
    host.innerHTML = words(CLUSTER_LEGEND.map(([colours, text]) => `<span>${colours.map(box).join("")} ${text}</span>`));
    return;
  }
  const levels = scale.colours.map((colour) => `<i style="background:${colour}"></i>`).join("");
  const ticks = scale.ticks.map((tick) => `<span style="left:${100 * shareOf(scale, tick)}%">${tick}</span>`).join("");
  const beyond = scale.beyond ? [`<span>${box("#fff")} ${scale.beyond}</span>`] : [];
  const about = words([`<span>${scale.label}</span>`, ...beyond]);
  host.innerHTML = `<div class="levels">${levels}</div><div class="ticks">${ticks}</div>${about}`;
}

/** Powers of ten below the slider of time, whose places are frames. */
export function drawTicks(host, times) {
  const place = (time) => {
    const k = times.findIndex((other) => other >= time);
    if (k < 1 || times[k - 1] <= 0) return k;
    return k - 1 + Math.log(time / times[k - 1]) / Math.log(times[k] / times[k - 1]);
  };
  const last = times.length - 1;
  const first = times.find((time) => time > 0);
  const marks = [[0, times[0] === 0 ? "0" : ""], ...decades(first, times[last]).map((k) => [place(10 ** k), powerOfTen(k)])];
  host.innerHTML = marks
    .filter(([at]) => at >= 0)
    .map(([at, words], k) => `<span style="left:${(100 * at) / last}%">${words}${k === marks.length - 1 ? " s" : ""}</span>`)
    .join("");
}

/** What is known of a disk, at a place in d and in the clusters of S_c. */
export function wordsOfDisk(run, frame, scales, clusters, k, place) {
  const lines = run.colours.map((name) => `${scales[name].label}: ${wordsFor(scales[name], frame[name][k])}`);
  const at = place.map((value, axis) => `${value.toFixed(2)} d = ${(value / run.box[axis]).toFixed(4)} L`);
  return [`x = ${at[0]}`, `y = ${at[1]}`, `cluster of M = ${clusters.sizes[clusters.root[k]]}`, ...lines].join("\n");
}
