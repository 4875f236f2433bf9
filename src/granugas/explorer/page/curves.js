// Curves over logarithmic time: those of the dataset in grey, that of the chosen S_c over them.

const [WIDTH, HEIGHT] = [340, 104];
const EDGE = { left: 40, right: 34, top: 6, bottom: 16 };

const DIGITS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** "10³" */
export function powerOfTen(exponent) {
  const digits = [...String(Math.abs(exponent))].map((digit) => DIGITS[digit]).join("");
  return `10${exponent < 0 ? "⁻" : ""}${digits}`;
}

/** The whole powers of ten from low to high. */
export function decades(low, high) {
  const found = [];
  for (let k = Math.ceil(Math.log10(low) - 1e-9); k <= Math.log10(high) + 1e-9; k++) found.push(k);
  return found;
}

const ROUND = [1, 2, 5];

/** The numbers 1, 2, 5, 10, 20 ... that enclose two others. */
function enclosing(low, high) {
  const steps = [];
  for (let k = Math.floor(Math.log10(low)); k <= Math.ceil(Math.log10(high)); k++) steps.push(...ROUND.map((m) => m * 10 ** k));
  return [steps.findLast((step) => step <= low), steps.find((step) => step >= high && step > low)];
}

/** Ticks of an axis and their words: powers of ten, where there are too few of them 1, 2, 5, 10 ... */
function ticksOf(low, high) {
  const powers = decades(low, high).map((k) => [10 ** k, powerOfTen(k)]);
  if (powers.length > 2) return powers;
  return decades(low / 10, high)
    .flatMap((k) => ROUND.map((m) => m * 10 ** k))
    .filter((value) => value >= low * 0.999 && value <= high * 1.001)
    .map((value) => [value, value < 1e5 ? String(value) : `${value / 10 ** Math.floor(Math.log10(value))}·${powerOfTen(Math.floor(Math.log10(value)))}`]);
}

export class Plot {
  /** svg: the element; choose(time): what a click asks for. */
  constructor(svg, choose) {
    this.svg = svg;
    svg.setAttribute("viewBox", `0 0 ${WIDTH} ${HEIGHT}`);
    svg.addEventListener("click", (event) => {
      const box = svg.getBoundingClientRect();
      const share = (((event.clientX - box.left) / box.width) * WIDTH - EDGE.left) / (WIDTH - EDGE.left - EDGE.right);
      if (this.times) choose(this.times[0] * (this.times[1] / this.times[0]) ** Math.min(Math.max(share, 0), 1));
    });
  }

  /** times: [first, last]; curves: [{label, times, values}] of the dataset. The live curve is to come. */
  begin(times, curves) {
    Object.assign(this, { times, curves, values: null });
    this.live([], []);
  }

  axes() {
    const { times, values, curves } = this;
    const lines = decades(...times).map((k) => {
      const x = this.x(10 ** k);
      return `<line class="grid" x1="${x}" x2="${x}" y1="${EDGE.top}" y2="${HEIGHT - EDGE.bottom}"/>
        <text x="${x}" y="${HEIGHT - 4}" text-anchor="middle">${powerOfTen(k)}</text>`;
    });
    const levels = ticksOf(...values).map(([value, words]) => {
      const y = this.y(value);
      return `<line class="grid" x1="${EDGE.left}" x2="${WIDTH - EDGE.right}" y1="${y}" y2="${y}"/>
        <text x="${EDGE.left - 5}" y="${y + 3.5}" text-anchor="end">${words}</text>`;
    });
    let above = Infinity;
    const ends = curves
      .map((curve) => ({ ...curve, y: this.y(curve.values.at(-1)) }))
      .sort((a, b) => b.y - a.y)
      .map(({ label, y }) => {
        if (above - y < 9) return "";
        above = y;
        return `<text class="end" x="${WIDTH - EDGE.right + 4}" y="${y + 3}">${label}</text>`;
      });
    const grey = curves.map((curve) => `<path class="known" d="${this.path(curve.times, curve.values)}"/>`);
    this.svg.innerHTML = `${lines.join("")}${levels.join("")}${grey.join("")}${ends.join("")}
      <text class="unit" x="${WIDTH - EDGE.right + 12}" y="${HEIGHT - 4}">t (s)</text>
      <line class="now" y1="${EDGE.top}" y2="${HEIGHT - EDGE.bottom}" visibility="hidden"/>
      <path class="live"/><g class="dots"></g>`;
  }

  /** The curve of the chosen S_c, as far as it is known. */
  live(times, values) {
    const there = times.map((_, k) => k).filter((k) => times[k] > 0 && values[k] !== undefined);
    const [x, y] = [there.map((k) => times[k]), there.map((k) => values[k])];
    const all = [...y, ...this.curves.flatMap((curve) => curve.values)];
    const range = all.length ? enclosing(Math.min(...all), Math.max(...all)) : [1, 10];
    if (String(range) !== String(this.values)) {
      this.values = range;
      this.axes();
      this.now(this.time);
    }
    this.svg.querySelector(".live").setAttribute("d", this.path(x, y));
    const dots = x.map((time, k) => `<circle cx="${this.x(time)}" cy="${this.y(y[k])}" r="1.8"/>`);
    this.svg.querySelector(".dots").innerHTML = dots.join("");
  }

  /** Where in time the picture is. */
  now(time) {
    this.time = time;
    const line = this.svg.querySelector(".now");
    line.setAttribute("visibility", time > 0 ? "visible" : "hidden");
    if (time > 0) for (const end of ["x1", "x2"]) line.setAttribute(end, this.x(time));
  }

  x(time) {
    const share = Math.log(time / this.times[0]) / Math.log(this.times[1] / this.times[0]);
    return EDGE.left + share * (WIDTH - EDGE.left - EDGE.right);
  }

  y(value) {
    const share = Math.log(value / this.values[0]) / Math.log(this.values[1] / this.values[0]);
    return HEIGHT - EDGE.bottom - share * (HEIGHT - EDGE.top - EDGE.bottom);
  }

  path(times, values) {
    return times.map((time, k) => `${k ? "L" : "M"}${this.x(time).toFixed(1)} ${this.y(values[k]).toFixed(1)}`).join("");
  }
}
