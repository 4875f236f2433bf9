// Beside the page: clusters of all frames of a run for the newest S_c.

import { unpack } from "./packed.js";
import { findClusters } from "./clusters.js";

/** Order of frames: every 8th first, so that a curve soon shows its shape. */
function order(length) {
  const places = Array.from({ length }, (_, k) => k);
  return [8, 4, 2, 1].flatMap((step) => places.filter((k) => k % step === 0 && (step === 8 || k % (2 * step) !== 0)));
}

/** Let messages in. */
const pause = () => new Promise((resolve) => setTimeout(resolve, 0));

let asked = { run: null, frames: [], S_c: null };

async function answer(question) {
  const { run, frames, S_c } = question;
  for (const k of order(run.frames.length)) {
    frames[k] ??= await unpack(question.texts[k], run.frames[k].layout);
    const { count, mean, largest } = findClusters(run, frames[k], S_c);
    await pause();
    if (asked !== question) return;
    postMessage({ number: question.number, S_c, frame: k, found: { count, mean, largest } });
  }
}

onmessage = ({ data }) => {
  const same = data.number === asked.number;
  const texts = data.texts ?? asked.texts;
  asked = { ...data, texts, run: data.run ?? asked.run, frames: same ? asked.frames : [] };
  answer(asked);
};
