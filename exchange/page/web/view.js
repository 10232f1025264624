'use strict';
// The camera over the town: where it looks, how near, whom it follows, and what fingers and mice do to it.

const NEAREST = 120; // [px/m]

class View {
  /** `changed` is called when something must be drawn again, `resized` when at once, `clicked` with a place of the screen. */
  constructor(canvas, box, { changed, resized, clicked, hovered, moved }) {
    Object.assign(this, { canvas, home: box, changed, resized, clicked, hovered, moved });
    Object.assign(this, { x: 0, y: 0, scale: 1, width: 1, height: 1, ratio: 1, isZooming: false });
    this.pointers = new Map();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
    this.fit();
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    for (const kind of ['pointerup', 'pointercancel']) canvas.addEventListener(kind, (event) => this.up(event));
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
  }

  resize() {
    const { width, height } = this.canvas.getBoundingClientRect();
    const isFit = this.isFit;
    this.ratio = Math.min(2, window.devicePixelRatio || 1);
    Object.assign(this, { width: Math.max(1, width), height: Math.max(1, height) });
    const [wide, high] = [Math.round(this.width * this.ratio), Math.round(this.height * this.ratio)];
    if (isFit) this.fit();
    if (this.canvas.width === wide && this.canvas.height === high) return;
    Object.assign(this.canvas, { width: wide, height: high });
    this.resized(); // at once: a canvas of another size is empty
  }

  /** What is in sight. [m] */
  get box() {
    const [half, high] = [this.width / this.scale / 2, this.height / this.scale / 2];
    return { west: this.x - half, east: this.x + half, south: this.y - high, north: this.y + high };
  }

  toScreen(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  toWorld(left, top) {
    return [this.x + (left - this.width / 2) / this.scale, this.y - (top - this.height / 2) / this.scale];
  }

  get farthest() {
    return 0.5 * this.scaleToFit();
  }

  scaleToFit() {
    return Math.min(this.width / (this.home.east - this.home.west), this.height / (this.home.north - this.home.south), NEAREST);
  }

  fit() {
    this.scale = this.scaleToFit();
    this.x = (this.home.west + this.home.east) / 2;
    this.y = (this.home.south + this.home.north) / 2;
    this.isFit = true;
    this.changed();
  }

  lookAt(x, y, scale = this.scale) {
    if (scale !== this.scale) this.isFit = false;
    Object.assign(this, { x, y, scale });
    this.changed();
  }

  /** Keeps what is under a place of the screen there. */
  zoom(factor, left = this.width / 2, top = this.height / 2) {
    const [x, y] = this.toWorld(left, top);
    this.scale = Math.min(NEAREST, Math.max(this.farthest, this.scale * factor));
    this.x = x - (left - this.width / 2) / this.scale;
    this.y = y + (top - this.height / 2) / this.scale;
    this.isFit = false;
    this.isZooming = true;
    clearTimeout(this.settling);
    this.settling = setTimeout(() => {
      this.isZooming = false;
      this.changed();
    }, 160);
    this.changed();
  }

  wheel(event) {
    event.preventDefault();
    const { left, top } = this.canvas.getBoundingClientRect();
    const lines = event.deltaMode === 1 ? 18 : 1;
    this.zoom(Math.exp(-0.0016 * lines * event.deltaY), event.clientX - left, event.clientY - top);
    this.moved('zoom');
  }

  at(event) {
    const { left, top } = this.canvas.getBoundingClientRect();
    return { left: event.clientX - left, top: event.clientY - top };
  }

  down(event) {
    if (event.button > 0) return;
    this.canvas.setPointerCapture(event.pointerId);
    const at = this.at(event);
    this.pointers.set(event.pointerId, { ...at, begin: at });
    this.dragged = this.pointers.size > 1;
  }

  move(event) {
    const at = this.at(event);
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) return this.hovered(at.left, at.top);
    if (Math.hypot(at.left - pointer.begin.left, at.top - pointer.begin.top) > 5) this.dragged = true;
    if (this.dragged && this.pointers.size === 1) {
      this.canvas.classList.add('dragging');
      this.isFit = false;
      this.x -= (at.left - pointer.left) / this.scale;
      this.y += (at.top - pointer.top) / this.scale;
      this.moved('drag');
      this.changed();
    } else if (this.pointers.size === 2) {
      const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, one]) => one);
      const before = Math.hypot(pointer.left - other.left, pointer.top - other.top) || 1;
      const now = Math.hypot(at.left - other.left, at.top - other.top) || 1;
      this.zoom(now / before, (at.left + other.left) / 2, (at.top + other.top) / 2);
      this.moved('zoom');
    }
    Object.assign(pointer, at);
  }

  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    this.canvas.classList.remove('dragging');
    if (event.type === 'pointerup' && !this.dragged) this.clicked(this.at(event).left, this.at(event).top);
  }
}
