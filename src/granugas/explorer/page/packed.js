// Frames as the file holds them: a text, and a layout that says what is in it.

const KINDS = { u1: Uint8Array, u2: Uint16Array, u4: Uint32Array };

/** The arrays of a frame by name, from its text and its layout [name, kind, length]. */
async function arraysOf(text, layout) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const arrays = {};
  let place = 0;
  for (const [name, kind, length] of layout) {
    const array = new KINDS[kind](length);
    for (let plane = 0; plane < array.BYTES_PER_ELEMENT; plane++) {
      for (let i = 0; i < length; i++) array[i] |= bytes[place++] << (8 * plane);
    }
    arrays[name] = array;
  }
  return arrays;
}

/**
 * A frame: `start` of each cell among the disks, `x` and `y` in the cell, `size` where diameters differ, levels of the
 * colours by name, and `close`, for each exact S_c the pairs of disks whose bond is named.
 */
export async function unpack(text, layout) {
  const arrays = await arraysOf(text, layout);
  const start = new Uint32Array(arrays.count.length + 1);
  for (let c = 0; c < arrays.count.length; c++) start[c + 1] = start[c] + arrays.count[c];
  const close = [];
  for (let c = 0; `first_${c}` in arrays; c++) close.push([arrays[`first_${c}`], arrays[`second_${c}`]]);
  return { ...arrays, start, close };
}
