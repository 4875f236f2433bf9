// Clusters by distance (Luding & Herrmann 1999, Eq. 6): |r_i - r_j| <= S_c (d_i + d_j) / 2, in linked cells.

/** Steps of a diameter, by the largest one. */
export const SIZES = 65535;

/** From a cell to half of its neighbours: every pair of cells is met once. */
const NEIGHBOURS = [[1, 0], [-1, 1], [0, 1], [1, 1]];

/** The disk that stands for the cluster of i; halves the path to it on the way. */
function rootOf(root, i) {
  while (root[i] !== i) {
    root[i] = root[root[i]];
    i = root[i];
  }
  return i;
}

/** Make one cluster of two. The lower one stays, so that a root never stands behind its disks. */
function unite(root, i, j) {
  i = rootOf(root, i);
  j = rootOf(root, j);
  if (i < j) root[j] = i;
  else root[i] = j;
}

/** When two disks of a run are in contact, in steps of their places: at a distance factor of at most `factor`. */
function contactOf(run, factor) {
  const steps = 2 ** run.bits;
  const [stepX, stepY] = run.box.map((side, axis) => side / run.cells[axis] / steps);
  return { steps, stepX, stepY, reach: factor, reachOfSize: (factor * run.largest_diameter) / 2 / SIZES };
}

/**
 * Visit the disks of two cells that are in contact; of one cell with itself where across is null.
 * across = [columns, rows] from the first cell to the second, so no periodic image has to be looked for.
 */
function eachContact(frame, contact, home, other, across, visit) {
  const { start, x, y, size } = frame;
  const { stepX, stepY, reach, reachOfSize } = contact;
  const shiftX = across ? across[0] * contact.steps : 0;
  const shiftY = across ? across[1] * contact.steps : 0;
  const last = start[other + 1];
  for (let i = start[home]; i < start[home + 1]; i++) {
    const fromX = x[i] - shiftX;
    const fromY = y[i] - shiftY;
    for (let j = across ? start[other] : i + 1; j < last; j++) {
      const dx = (x[j] - fromX) * stepX;
      const dy = (y[j] - fromY) * stepY;
      const near = size ? reachOfSize * (size[i] + size[j]) : reach;
      if (dx * dx + dy * dy <= near * near) visit(i, j);
    }
  }
}

/**
 * Call visit(i, j) for the bonds of a frame at S_c, those that decide its clusters.
 *
 * At an S_c of the dataset rounded places decide only what they can; the frame names the bonds that are too close to call.
 */
export function eachBond(run, frame, S_c, visit) {
  const [columns, rows] = run.cells;
  const exact = run.factors.indexOf(S_c);
  const contact = contactOf(run, exact < 0 ? S_c : S_c - run.margin);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const home = row * columns + column;
      if (frame.start[home] === frame.start[home + 1]) continue;
      eachContact(frame, contact, home, home, null, visit);
      for (const across of NEIGHBOURS) {
        let beside = column + across[0];
        let above = row + across[1];
        if (beside < 0 || beside >= columns) {
          if (!run.periodic[0]) continue;
          beside = (beside + columns) % columns;
        }
        if (above >= rows) {
          if (!run.periodic[1]) continue;
          above = 0;
        }
        eachContact(frame, contact, home, above * columns + beside, across, visit);
      }
    }
  }
  if (exact >= 0) {
    const [first, second] = frame.close[exact];
    for (let b = 0; b < first.length; b++) visit(first[b], second[b]);
  }
}

/**
 * The clusters of a frame: `root` (the disk that stands for each disk's cluster), `sizes` (M_i, at the roots),
 * I_c = `count`, <M> = `mean`, M_max = `largest`.
 */
export function findClusters(run, frame, S_c) {
  const root = Int32Array.from({ length: frame.x.length }, (_, i) => i);
  eachBond(run, frame, S_c, (i, j) => unite(root, i, j));
  return { root, ...numbersOf(root) };
}

/** Sizes of the clusters at their roots, and I_c, <M>, M_max; every root is found on the way. */
function numbersOf(root) {
  const sizes = new Int32Array(root.length);
  let count = 0;
  let largest = 0;
  for (let i = 0; i < root.length; i++) {
    root[i] = root[root[i]];
    if (root[i] === i) count++;
    largest = Math.max(largest, ++sizes[root[i]]);
  }
  return { sizes, count, mean: root.length / count, largest };
}

/** The disks that stand for the largest clusters, at most `number`, each of at least `least` disks. */
function largestRoots(sizes, number, least) {
  const found = [];
  for (let i = 0; i < sizes.length; i++) {
    if (sizes[i] < Math.max(least, sizes[found[number - 1]] ?? 0)) continue;
    found.push(i);
    found.sort((j, k) => sizes[k] - sizes[j]);
    found.length = Math.min(found.length, number);
  }
  return found;
}

/** Of these clusters the size, and the mean place of their disks in d, around the edges of a periodic box. */
export function largestOf(run, frame, { root, sizes }, number, least) {
  const sums = new Map(largestRoots(sizes, number, least).map((i) => [i, [0, 0, 0, 0]]));
  const [columns, rows] = run.cells;
  const steps = 2 ** run.bits;
  for (let home = 0; home < columns * rows; home++) {
    for (let k = frame.start[home]; k < frame.start[home + 1]; k++) {
      const sum = sums.get(root[k]);
      if (!sum) continue;
      const x = (2 * Math.PI * ((home % columns) + frame.x[k] / steps)) / columns;
      const y = (2 * Math.PI * (Math.floor(home / columns) + frame.y[k] / steps)) / rows;
      [Math.cos(x), Math.sin(x), Math.cos(y), Math.sin(y)].forEach((part, p) => (sum[p] += part));
    }
  }
  const mean = (cosine, sine, side) => (0.5 + Math.atan2(-sine, -cosine) / (2 * Math.PI)) * side;
  return [...sums].map(([i, [cosX, sinX, cosY, sinY]]) => ({
    x: mean(cosX, sinX, run.box[0]),
    y: mean(cosY, sinY, run.box[1]),
    size: sizes[i],
  }));
}
