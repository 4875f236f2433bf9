// Time that goes on by itself.

export class Player {
  /** step(): one frame on, false at the end; changed(playing): it starts or stops. */
  constructor(step, changed) {
    this.step = step;
    this.changed = changed;
    this.playing = false;
    this.rate = 10;
  }

  toggle() {
    this.playing = !this.playing;
    this.changed(this.playing);
    if (this.playing) {
      this.due = performance.now();
      requestAnimationFrame((now) => this.tick(now));
    }
  }

  stop() {
    if (this.playing) this.toggle();
  }

  tick(now) {
    if (!this.playing) return;
    if (now >= this.due - 2) { // screens are not quite on time
      this.due = Math.max(this.due + 1000 / this.rate, now);
      this.step();
    }
    requestAnimationFrame((next) => this.tick(next));
  }
}
