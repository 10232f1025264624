'use strict';
// An actor's speed, gap ahead and lateral offset over time. The gap of vehicles with mass is recorded; that of cars is measured here,
// in the same way, from the boxes of all others.

const FREE = 100; // [m] nobody ahead is nearer

/** What the plots draw of an actor: numbers by frame, null where there is none. */
function seriesOf(trace, id) {
  const ticks = [];
  const speed = [];
  const gap = [];
  const offset = [];
  for (const track of trace.byActor.get(id) || []) {
    const gaps = track.kind === 'vehicle' ? recordedGaps(trace, track) : track.kind === 'car' ? gapsOf(trace, track) : null;
    for (let i = 0; i < track.count; ++i) {
      const k = track.begin + i;
      ticks.push(trace.clocks[track.clock][track.first + i]);
      speed.push((trace.speed[k] / 100) * 3.6);
      gap.push(gaps && gaps[i] < FREE ? gaps[i] : null);
      offset.push(track.kind === 'vehicle' && trace.lane[k] >= 0 ? trace.offset[track.own + i] / 100 : null);
    }
  }
  return { ticks, speed, gap, offset };
}

function recordedGaps(trace, track) {
  return Float64Array.from({ length: track.count }, (_, i) => trace.gap[track.own + i] / 100);
}

/** As kernel/nearest_ahead.cpp measures it for vehicles with mass: in the straight corridor of the car's width. */
function gapsOf(trace, track) {
  const gaps = new Float64Array(track.count).fill(FREE);
  const headings = Float64Array.from({ length: track.count }, (_, i) => (trace.yaw[track.begin + i] / TURN) * 2 * Math.PI);
  const cosines = headings.map(Math.cos);
  const sines = headings.map(Math.sin);
  for (const other of trace.tracks) {
    if (other === track || (other.kind !== 'vehicle' && other.kind !== 'car')) continue;
    const sameClock = other.clock === track.clock;
    const from = sameClock ? Math.max(0, other.first - track.first) : 0;
    const to = sameClock ? Math.min(track.count, other.first + other.count - track.first) : track.count;
    const beside = (track.shape.width + other.shape.width) / 2 + other.shape.length;
    for (let i = from; i < to; ++i) {
      const k = track.begin + i;
      const j = sameClock ? other.begin + track.first + i - other.first : trace.indexAt(other, trace.clocks[track.clock][track.first + i]);
      if (j < 0) continue;
      const dx = (trace.x[j] - trace.x[k]) / 100;
      const dy = (trace.y[j] - trace.y[k]) / 100;
      const ahead = cosines[i] * dx + sines[i] * dy;
      const left = cosines[i] * dy - sines[i] * dx;
      if (ahead < 0 || ahead > FREE + 20 || Math.abs(left) > beside) continue;
      const turned = (trace.yaw[j] / TURN) * 2 * Math.PI - headings[i];
      gaps[i] = Math.min(gaps[i], gapTo(track.shape, ahead, left, turned, other.shape));
    }
  }
  return gaps;
}

/** From a front bumper to a box at (x, y) of the vehicle's frame that reaches into the corridor; FREE when it does not. */
function gapTo(shape, x, y, turned, its) {
  const ahead = Math.cos(turned);
  const left = Math.sin(turned);
  let near = Infinity;
  let rightmost = Infinity;
  let leftmost = -Infinity;
  for (const along of [-its.rear, its.length - its.rear])
    for (const across of [-its.width / 2, its.width / 2]) {
      near = Math.min(near, x + along * ahead - across * left);
      const side = y + along * left + across * ahead;
      rightmost = Math.min(rightmost, side);
      leftmost = Math.max(leftmost, side);
    }
  if (rightmost > shape.width / 2 || leftmost < -shape.width / 2) return FREE;
  return Math.min(FREE, Math.max(0, near - (shape.length - shape.rear)));
}
