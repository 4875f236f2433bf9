// What part of the box is seen: pixels from diameters and back. The y axis points up.

const modulo = (value, length) => ((value % length) + length) % length;

/** At the closest, so many diameters across. */
const NEAREST = 6;

export class Camera {
  /** box: sides in d; periodic: of each axis. */
  constructor(box, periodic) {
    this.box = box;
    this.periodic = periodic;
    this.left = this.bottom = 0;
    this.zoom = 1;
    this.width = this.height = 1;
  }

  /** Pixels of the picture; as high and wide as the box is. */
  resize(width, height) {
    this.width = width;
    this.height = height;
    this.settle();
  }

  /** Pixels of a diameter. */
  get scale() {
    return (this.zoom * this.width) / this.box[0];
  }

  /** Sides of what is seen, in d. */
  get seen() {
    return [this.box[0] / this.zoom, this.box[1] / this.zoom];
  }

  fit() {
    this.left = this.bottom = 0;
    this.zoom = 1;
  }

  /** Pan by pixels. */
  pan(across, down) {
    this.left -= across / this.scale;
    this.bottom += down / this.scale;
    this.settle();
  }

  /** Zoom by a factor about a pixel, which stays where it is. */
  zoomAt(factor, x, y) {
    const [atX, atY] = [this.left + x / this.scale, this.bottom + (this.height - y) / this.scale];
    this.zoom = Math.min(Math.max(this.zoom * factor, 1), Math.max(this.box[0] / NEAREST, 1));
    this.left = atX - x / this.scale;
    this.bottom = atY - (this.height - y) / this.scale;
    this.settle();
  }

  /** Keep to the box; a periodic one goes on beyond its edges. */
  settle() {
    const [width, height] = this.seen;
    const within = (at, side, seen, periodic) => (periodic ? modulo(at, side) : Math.min(Math.max(at, 0), side - seen));
    this.left = within(this.left, this.box[0], width, this.periodic[0]);
    this.bottom = within(this.bottom, this.box[1], height, this.periodic[1]);
  }

  /** Where a pixel is, in d and inside of the box. */
  placeAt(x, y) {
    const place = [this.left + x / this.scale, this.bottom + (this.height - y) / this.scale];
    return place.map((value, axis) => (this.periodic[axis] ? modulo(value, this.box[axis]) : value));
  }

  /** Pixels at which a length along x that begins at `from` is seen, once or twice, given how far around it counts. */
  columns(from, around) {
    return this.images(modulo(from - this.left, this.box[0]), from - this.left, 0, this.width, around);
  }

  /** The same along y: pixels from the lower edge. */
  rows(from, around) {
    return this.images(modulo(from - this.bottom, this.box[1]), from - this.bottom, 1, this.height, around);
  }

  images(wrapped, plain, axis, pixels, around) {
    const places = this.periodic[axis] ? [wrapped * this.scale, (wrapped - this.box[axis]) * this.scale] : [plain * this.scale];
    return places.filter((place) => place > -around && place < pixels + around);
  }
}
