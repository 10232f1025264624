'use strict';
// Whoever moves, and what changes colour: who is drawn, in which colour and order; signals, trails and labels.

const SIGNALS = ['#6b7077', '#f03e3e', '#ff922b', '#ffd43b', '#40c057', '#74d68a', '#f03e3e']; // as SignalColor counts
const CAST = ['#e8572a', '#2878d0', '#1f9d61', '#9151d6', '#d13b94', '#0f95a5', '#b8860b', '#5c6bc0'];
const LONGEST = 26; // letters of a label

/** From an actor's origin ahead to the middle of its box. [m] */
function middleOf({ kind, shape }) {
  return kind === 'walker' || kind === 'prop' ? 0 : shape.length / 2 - shape.rear;
}

class Actors {
  constructor(trace, town) {
    Object.assign(this, { trace, town, labels: 'cast', drawn: [] });
    this.cast = new Map(); // colours of the scenario's own, those with mass first
    for (const isFirst of [true, false])
      for (const { id, kind, isCast, isParked } of trace.tracks)
        if (isCast && !isParked && (kind === 'vehicle') === isFirst && !this.cast.has(id)) this.cast.set(id, CAST[this.cast.size % CAST.length]);
    this.signalChanges = this.changesBySignal(town.signals.length);
  }

  changesBySignal(count) {
    const changes = Array.from({ length: count }, () => []);
    for (const [tick, signal, colour] of this.trace.head.signals) if (changes[signal]) changes[signal].push([tick, colour]);
    return changes;
  }

  /** SignalColor of each signal at a time. */
  signalsAt(time) {
    return this.signalChanges.map((changes) => {
      let low = 0;
      let high = changes.length;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (changes[middle][0] <= time) low = middle + 1;
        else high = middle;
      }
      return low > 0 ? changes[low - 1][1] : 0;
    });
  }

  colourOf(track, theme) {
    const colours = ACTOR_COLOURS[theme];
    if (this.cast.has(track.id)) return this.cast.get(track.id);
    if (track.kind === 'walker') return colours.walker;
    if (track.kind === 'prop') return track.shape.paint || colours.prop;
    if (track.isTwoWheeler) return colours.bicycle;
    if (track.shape.livery > 0) return colours.liveries[track.shape.livery];
    return track.isParked ? colours.parked : colours.traffic[track.id % colours.traffic.length];
  }

  /** `context` draws pixels of the page. */
  draw(context, view, time, theme, chosen) {
    const seconds = this.trace.seconds(time);
    this.drawn = this.trace.present(time);
    const box = { west: view.box.west - 20, east: view.box.east + 20, south: view.box.south - 20, north: view.box.north + 20 };
    const inSight = this.drawn.filter(({ x, y }) => x > box.west && x < box.east && y > box.south && y < box.north);
    this.drawTrail(context, view, time, theme, chosen);
    this.drawSignals(context, view, time);
    // The scenario's own last: nobody hides them.
    inSight.sort((one, other) => Number(one.track.isCast) - Number(other.track.isCast));
    if (view.scale > 2.5) for (const here of inSight) drawBeams(context, view, here, theme);
    for (const here of inSight) {
      context.save();
      const [left, top] = view.toScreen(here.x, here.y);
      context.translate(left, top);
      context.rotate(-here.yaw);
      context.scale(view.scale, -view.scale);
      if (here.track.id === chosen) this.drawHalo(context, view, here, theme);
      const paint = this.colourOf(here.track, theme);
      if (here.track.kind === 'walker') drawWalker(context, view, here, theme, paint);
      else if (here.track.kind === 'prop') drawProp(context, view, here, theme);
      else drawVehicle(context, view, here, theme, seconds, paint);
      context.restore();
    }
    this.drawLabels(context, view, inSight, theme, chosen);
  }

  drawSignals(context, view, time) {
    if (view.scale < 0.5) return;
    const colours = this.signalsAt(time);
    this.town.signals.forEach((bar, i) => {
      const [left, top] = view.toScreen(bar.x, bar.y);
      if (left < -20 || top < -20 || left > view.width + 20 || top > view.height + 20) return;
      context.fillStyle = SIGNALS[colours[i]] || SIGNALS[0];
      if (bar.forWalkers) {
        if (view.scale < 3) return;
        context.beginPath();
        context.arc(left, top, Math.max(2, 0.45 * view.scale), 0, 7);
        context.fill();
        return;
      }
      context.save();
      context.translate(left, top);
      context.rotate(-bar.yaw);
      const thick = Math.max(3, 0.7 * view.scale);
      context.fillRect(-thick / 2 + 0.2 * view.scale, -(bar.left + bar.each) * view.scale, thick, bar.each * view.scale * 0.94);
      context.restore();
    });
  }

  drawHalo(context, view, { track }, theme) {
    const middle = middleOf(track);
    const radius = Math.max(track.shape.length / 2 + 1.3, 15 / view.scale);
    context.beginPath();
    context.arc(middle, 0, radius, 0, 7);
    context.fillStyle = `${ACTOR_COLOURS[theme].chosen}26`;
    context.fill();
    context.lineWidth = 1.6 / view.scale;
    context.strokeStyle = ACTOR_COLOURS[theme].chosen;
    context.stroke();
  }

  /** Where the chosen one came from: all of it thin, the last ten seconds strong. */
  drawTrail(context, view, time, theme, chosen) {
    const colour = ACTOR_COLOURS[theme].chosen;
    for (const track of this.trace.byActor.get(chosen) || []) {
      const { frame } = this.trace.frameAt(track.clock, time);
      const last = Math.min(frame - track.first, track.count - 1);
      if (last < 1) continue;
      const ticks = this.trace.clocks[track.clock];
      const recent = time - 10 / this.trace.step;
      const line = (from, to, width, alpha) => {
        const stride = Math.max(1, Math.floor((to - from) / 1500));
        context.beginPath();
        for (let i = from; i <= to; i = i < to ? Math.min(to, i + stride) : to + 1)
          context.lineTo(...view.toScreen(this.trace.x[track.begin + i] / 100, this.trace.y[track.begin + i] / 100));
        context.globalAlpha = alpha;
        context.lineWidth = width;
        context.stroke();
      };
      context.strokeStyle = colour;
      context.lineJoin = context.lineCap = 'round';
      line(0, last, Math.max(1.5, 0.25 * view.scale), 0.3);
      let from = last;
      while (from > 0 && ticks[track.first + from] > recent) --from;
      line(from, last, Math.max(2.5, 0.5 * view.scale), 0.45);
      context.globalAlpha = 1;
    }
  }

  drawLabels(context, view, inSight, theme, chosen) {
    if (this.labels === 'none') return;
    const colours = ACTOR_COLOURS[theme];
    const taken = [];
    context.font = '600 12px system-ui, sans-serif';
    context.textBaseline = 'middle';
    const first = (here) => (here.track.id === chosen ? 0 : here.track.isCast ? 1 : 2);
    const wanted = inSight.filter((here) => (first(here) < 2 && (view.scale > 2 || !here.track.isParked)) || (this.labels === 'all' && view.scale > 2.2));
    wanted.sort((one, other) => first(one) - first(other) || one.track.id - other.track.id);
    for (const here of wanted) {
      const speed = `${Math.abs(here.speed * 3.6).toFixed(0)} km/h`;
      const { track } = here;
      const full = track.isCast || track.id === chosen || track.kind === 'walker' ? track.name : track.noun;
      const name = full.length > LONGEST ? `${full.slice(0, LONGEST - 1)}…` : full;
      const text = track.isParked || track.kind === 'prop' ? name : `${name}  ${speed}`;
      const width = context.measureText(text).width + 12;
      const middle = middleOf(track);
      const [left, top] = view.toScreen(here.x + middle * Math.cos(here.yaw), here.y + middle * Math.sin(here.yaw));
      const far = Math.max(14, (0.5 * (track.kind === 'walker' ? 0.6 : track.shape.width) + 0.9) * view.scale) + 10;
      const box = { west: left - width / 2, east: left + width / 2, south: top - far - 10, north: top - far + 10 };
      if (taken.some((other) => touch(box, other))) {
        if (first(here) === 2 || (first(here) === 1 && taken.length > 8)) continue;
        Object.assign(box, { south: top + far - 10, north: top + far + 10 });
      }
      taken.push(box);
      context.fillStyle = colours.label;
      context.beginPath();
      context.roundRect(box.west, box.south, width, 20, 6);
      context.fill();
      context.fillStyle = this.colourOf(track, theme);
      context.fillRect(box.west, box.south + 4, 3, 12);
      context.fillStyle = colours.text;
      context.fillText(text, box.west + 7, box.south + 10.5);
    }
  }

  /** Who is drawn near a place of the screen, or null. */
  pick(view, left, top) {
    let best = null;
    for (const here of this.drawn) {
      const { shape } = here.track;
      const [x, y] = view.toWorld(left, top);
      const dx = x - here.x;
      const dy = y - here.y;
      const along = dx * Math.cos(here.yaw) + dy * Math.sin(here.yaw) - middleOf(here.track);
      const across = dy * Math.cos(here.yaw) - dx * Math.sin(here.yaw);
      const beyond = Math.max(Math.abs(along) - shape.length / 2, Math.abs(across) - shape.width / 2, 0) * view.scale;
      if (beyond < 12 && (!best || beyond < best.beyond)) best = { here, beyond };
    }
    return best && best.here.track;
  }
}
