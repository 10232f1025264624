'use strict';
// The one clock of the page: a time in ticks, moved by playing, by the slider and by steps.

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];

class Timeline {
  /** `changed` is called whenever the time is another one. */
  constructor(trace, parts, changed) {
    Object.assign(this, { trace, parts, changed, time: trace.first, playing: false, speed: 1 });
    const { slider, speed } = parts;
    Object.assign(slider, { min: trace.first, max: trace.last, value: trace.first });
    for (const one of SPEEDS) speed.append(new Option(`${one}×`, one, one === 1, one === 1));
    slider.addEventListener('input', () => this.seek(Number(slider.value)));
    speed.addEventListener('change', () => {
      this.speed = Number(speed.value);
      speed.blur();
    });
    new ResizeObserver(() => this.drawMarks()).observe(parts.marks);
    this.marks = [];
    this.show();
  }

  /** The tick that is or was last. */
  get tick() {
    return Math.floor(this.time + 1e-6);
  }

  seek(time) {
    this.time = Math.min(this.trace.last, Math.max(this.trace.first, time));
    this.show();
    this.changed();
  }

  /** To a whole tick; who steps wants to look. */
  step(ticks) {
    this.pause();
    const from = ticks < 0 ? Math.ceil(this.time - 1e-6) : this.tick;
    this.seek(from + ticks);
  }

  skip(seconds) {
    this.seek(Math.round(this.time + seconds / this.trace.step));
  }

  faster(by) {
    const next = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, SPEEDS.indexOf(this.speed) + by))];
    this.speed = next;
    this.parts.speed.value = next;
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    if (this.playing || this.trace.last <= this.trace.first) return;
    if (this.time >= this.trace.last) this.seek(this.trace.first);
    this.playing = true;
    this.shown = performance.now();
    this.showState();
    requestAnimationFrame((now) => this.advance(now));
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.showState();
    this.seek(this.tick); // what stands still is what was recorded
  }

  advance(now) {
    if (!this.playing) return;
    // Whoever comes back to the page did not want to miss a thing.
    const passed = Math.min(0.25, Math.max(0, (now - this.shown) / 1000));
    this.shown = now;
    this.seek(this.time + (passed * this.speed) / this.trace.step);
    if (this.time >= this.trace.last) this.pause();
    else requestAnimationFrame((next) => this.advance(next));
  }

  showState() {
    document.body.classList.toggle('playing', this.playing);
    this.parts.play.setAttribute('aria-label', this.playing ? 'Pause' : 'Play');
  }

  show() {
    const { slider, seconds, tick } = this.parts;
    slider.value = this.tick;
    const text = secondsText(this.trace, this.tick);
    slider.setAttribute('aria-valuetext', text);
    seconds.textContent = text;
    tick.textContent = `tick ${this.tick} of ${this.trace.last}`;
    this.drawMarks();
  }

  /** Marks are { tick, end, colour, strong }. */
  setMarks(marks) {
    this.marks = marks;
    this.drawMarks();
  }

  /** Pixels from the left, as the slider's thumb has them. */
  leftOf(tick, width) {
    const thumb = 16;
    const span = Math.max(1, this.trace.last - this.trace.first);
    return thumb / 2 + ((tick - this.trace.first) / span) * (width - thumb);
  }

  drawMarks() {
    const { marks } = this.parts;
    const { context, width } = sized(marks);
    const style = getComputedStyle(document.documentElement);
    const y = 20;
    context.lineCap = 'round';
    context.lineWidth = 4;
    const bar = (from, to, colour) => {
      context.strokeStyle = colour;
      context.beginPath();
      context.moveTo(from, y);
      context.lineTo(to, y);
      context.stroke();
    };
    bar(this.leftOf(this.trace.first, width), this.leftOf(this.trace.last, width), style.getPropertyValue('--line'));
    bar(this.leftOf(this.trace.first, width), this.leftOf(this.time, width), style.getPropertyValue('--accent'));
    for (const { tick, end, colour, strong } of this.marks) {
      const left = this.leftOf(tick, width);
      const long = this.leftOf(end || tick, width) - left;
      context.fillStyle = colour;
      if (end) {
        context.globalAlpha = 0.35;
        context.fillRect(left, 6, long, 6);
        context.globalAlpha = 1;
      }
      context.fillRect(left - 1, strong ? 1 : 5, 2.5, strong ? 11 : 7);
    }
  }
}

/** As everywhere on this page: the time of a tick. */
function secondsText(trace, tick) {
  return `${trace.seconds(tick).toFixed(2)} s`;
}

/** A canvas with as many pixels as the screen has, and its context in CSS pixels, cleared. */
function sized(canvas) {
  const { width, height } = canvas.getBoundingClientRect();
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}
