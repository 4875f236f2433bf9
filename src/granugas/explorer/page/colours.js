// Colours of the disks: levels of a quantity, or clusters, told apart by brightness as well as by hue.

import { pixelOf } from "./painter.js";

/** Of what is beyond a scale, and of the largest cluster: brighter than all others. */
const WHITE = "#ffffff";

const ALONE = "#465062";

/** Of the other clusters, from dark to light. */
const CLUSTERS = ["#1f6fb4", "#c2541b", "#149478", "#c678a8", "#5bb2e6", "#e8a21a", "#efe36b"];

/** The palette and the colour of each disk by a scale: {palette, index}. */
export function byLevel(scale, levels) {
  return { palette: Uint32Array.from([...scale.colours, WHITE], pixelOf), index: levels };
}

/** The same by cluster: single disks are dim, the largest cluster is white. */
export function byCluster({ root, sizes, largest }) {
  const biggest = sizes.indexOf(largest);
  const index = new Uint8Array(root.length);
  for (let i = 0; i < root.length; i++) {
    const mixed = Math.imul(root[i], 0x9e3779b1) >>> 16; // neighbours differ
    index[i] = sizes[root[i]] === 1 ? 0 : root[i] === biggest ? CLUSTERS.length + 1 : 1 + (mixed % CLUSTERS.length);
  }
  return { palette: Uint32Array.from([ALONE, ...CLUSTERS, WHITE], pixelOf), index };
}

/** What the colours of clusters mean: [colours, words]. */
export const CLUSTER_LEGEND = [
  [[ALONE], "single disk"],
  [CLUSTERS, "clusters"],
  [[WHITE], "the largest"],
];

/** Words for the level of a disk on a scale. */
export function wordsFor(scale, level) {
  if (level >= scale.colours.length) return scale.beyond;
  const share = (level + 0.5) / scale.colours.length;
  const value = scale.logarithmic ? scale.low * (scale.high / scale.low) ** share : scale.low + share * (scale.high - scale.low);
  return value.toPrecision(2);
}

/** Where a value is on its scale, from 0 to 1. */
export function shareOf(scale, value) {
  const step = scale.logarithmic ? Math.log : Number;
  return (step(value) - step(scale.low)) / (step(scale.high) - step(scale.low));
}
