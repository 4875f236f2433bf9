// Hands on the picture: drag, wheel, double click, and the disk below the pointer.

/** Call zoom(factor, x, y), pan(across, down), point(x, y, event) and leave() with pixels of the canvas. */
export function followPointer(canvas, { zoom, pan, point, leave }) {
  const pixels = (...values) => values.map((value) => value * window.devicePixelRatio);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const turned = Math.max(Math.min(event.deltaY, 100), -100);
    zoom(Math.exp(-turned * 0.0025), ...pixels(event.offsetX, event.offsetY));
  });
  canvas.addEventListener("dblclick", (event) => zoom(2, ...pixels(event.offsetX, event.offsetY)));
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    canvas.classList.add("moving");
  });
  canvas.addEventListener("pointerup", () => canvas.classList.remove("moving"));
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons) pan(...pixels(event.movementX, event.movementY));
    else point(...pixels(event.offsetX, event.offsetY), event);
  });
  canvas.addEventListener("pointerleave", leave);
}
