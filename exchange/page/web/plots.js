'use strict';
// Speed, gap ahead and lateral offset of one actor over time, below each other, with a cursor at the clock's time.

const PLOTS = [
  { key: 'speed', title: 'Speed', unit: 'km/h', digits: 1, least: 10, fromZero: true },
  { key: 'gap', title: 'Gap ahead', unit: 'm', digits: 1, least: 10, fromZero: true, none: 'free' },
  { key: 'offset', title: 'Offset from the lane, left', unit: 'm', digits: 2, least: 1, fromZero: false, none: 'no lane' },
];

/** A step of 1, 2 or 5 times a power of ten that fits so many times into a span. */
function niceStep(span, count) {
  const raw = span / count || 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map((one) => one * power).find((one) => one >= raw) || raw;
}

class Plots {
  constructor(canvas, trace, seek) {
    Object.assign(this, { canvas, trace, series: null, time: trace.first });
    this.inset = 40; // [px] left of the curves
    new ResizeObserver(() => this.draw()).observe(canvas);
    const jump = (event) => {
      if (event.type === 'pointermove' && event.buttons !== 1) return;
      const { left, width } = canvas.getBoundingClientRect();
      const share = Math.min(1, Math.max(0, (event.clientX - left - this.inset) / (width - this.inset - 6)));
      seek(Math.round(trace.first + share * (trace.last - trace.first)));
    };
    canvas.addEventListener('pointerdown', jump);
    canvas.addEventListener('pointermove', jump);
  }

  show(series, colour) {
    Object.assign(this, { series, colour });
    this.kept = null;
    this.canvas.style.height = `${this.rows().length * 96 + 20}px`;
    this.draw();
  }

  setTime(time) {
    this.time = time;
    this.draw();
  }

  /** Those that have anything to show. */
  rows() {
    return PLOTS.filter(({ key }) => this.series && (key === 'speed' || this.series[key].some((value) => value !== null)));
  }

  /** Index of the last frame that is not behind the time; -1 when the actor is not there. */
  frameAt(time) {
    const { ticks } = this.series;
    let low = 0;
    let high = ticks.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (ticks[middle] <= time) low = middle + 1;
      else high = middle;
    }
    if (low === 0) return -1;
    const isOver = low === ticks.length && time > ticks[low - 1] + (this.trace.head.every || 1) * 20;
    return isOver ? -1 : low - 1;
  }

  draw() {
    const { context, width, height } = sized(this.canvas);
    if (!this.series || width < this.inset + 20) return;
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(`--${name}`);
    const rows = this.rows();
    const each = (height - 20) / rows.length;
    const right = width - 6;
    const leftOf = (tick) => this.inset + ((tick - this.trace.first) / Math.max(1, this.trace.last - this.trace.first)) * (right - this.inset);
    const now = this.frameAt(this.time);
    rows.forEach((row, i) => this.drawRow(context, { row, top: i * each, high: each, right, leftOf, now, colour }));
    this.drawTimes(context, height, right, leftOf, colour);
  }

  rangeOf(row) {
    this.kept = this.kept || {};
    if (!this.kept[row.key]) {
      let low = row.fromZero ? 0 : Infinity;
      let high = -Infinity;
      for (const value of this.series[row.key])
        if (value !== null) {
          low = Math.min(low, value);
          high = Math.max(high, value);
        }
      if (high - low < row.least) [low, high] = row.fromZero ? [low, low + row.least] : [(low + high - row.least) / 2, (low + high + row.least) / 2];
      const step = niceStep(high - low, 3);
      this.kept[row.key] = { low: Math.floor(low / step) * step, high: Math.ceil(high / step - 1e-9) * step, step };
    }
    return this.kept[row.key];
  }

  drawRow(context, { row, top, high, right, leftOf, now, colour }) {
    const values = this.series[row.key];
    const range = this.rangeOf(row);
    const [ceiling, floor] = [top + 22, top + high - 6];
    const topOf = (value) => floor - ((value - range.low) / (range.high - range.low)) * (floor - ceiling);
    context.font = '600 12px system-ui, sans-serif';
    context.textBaseline = 'alphabetic';
    context.textAlign = 'left';
    context.fillStyle = colour('text');
    context.fillText(row.title, 0, top + 13);
    const value = now < 0 ? null : values[now];
    const said = now < 0 ? '' : value === null ? row.none || '' : `${value.toFixed(row.digits).replace(/^-(0\.?0*)$/, '$1')} ${row.unit}`;
    context.textAlign = 'right';
    context.fillText(said, right, top + 13);
    context.font = '11px system-ui, sans-serif';
    context.fillStyle = colour('soft');
    context.strokeStyle = colour('line');
    context.lineWidth = 1;
    for (let at = range.low; at <= range.high + 1e-9; at += range.step) {
      const y = Math.round(topOf(at)) + 0.5;
      context.beginPath();
      context.moveTo(this.inset, y);
      context.lineTo(right, y);
      context.stroke();
      context.fillText(String(Number(at.toFixed(6))), this.inset - 6, y + 3.5);
    }
    this.drawCurve(context, values, leftOf, topOf);
    context.strokeStyle = colour('accent');
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(leftOf(this.time), ceiling - 4);
    context.lineTo(leftOf(this.time), floor + 4);
    context.stroke();
    if (value !== null && now >= 0) {
      context.fillStyle = this.colour;
      context.beginPath();
      context.arc(leftOf(this.time), topOf(value), 3.5, 0, 7);
      context.fill();
    }
  }

  /** At most a few values a pixel: the least and the greatest of each. */
  drawCurve(context, values, leftOf, topOf) {
    const { ticks } = this.series;
    context.strokeStyle = this.colour;
    context.lineWidth = 1.6;
    context.lineJoin = 'round';
    context.beginPath();
    let pen = false;
    const stride = Math.max(1, Math.floor(values.length / 1200));
    for (let i = 0; i < values.length; i += stride) {
      let low = null;
      let high = null;
      for (let k = i; k < Math.min(values.length, i + stride); ++k) {
        if (values[k] === null) continue;
        if (low === null || values[k] < values[low]) low = k;
        if (high === null || values[k] > values[high]) high = k;
      }
      if (low === null) {
        pen = false;
        continue;
      }
      for (const k of low === high ? [low] : [Math.min(low, high), Math.max(low, high)]) {
        const point = [leftOf(ticks[k]), topOf(values[k])];
        if (pen) context.lineTo(...point);
        else context.moveTo(...point);
        pen = true;
      }
    }
    context.stroke();
  }

  drawTimes(context, height, right, leftOf, colour) {
    const { trace } = this;
    const step = niceStep(trace.seconds(trace.last - trace.first), 5);
    context.fillStyle = colour('soft');
    context.font = '11px system-ui, sans-serif';
    context.textAlign = 'center';
    for (let s = Math.ceil(trace.seconds(trace.first) / step) * step; s <= trace.seconds(trace.last); s += step) {
      const left = leftOf(s / trace.step);
      if (left < right - 14 && left > this.inset + 4) context.fillText(`${Number(s.toFixed(3))} s`, left, height - 3);
    }
  }
}
