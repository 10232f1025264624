'use strict';
// Lines and polygons in layers of one style each, gathered in tiles, so that only those in sight are drawn. Metres.

const TILE = 240; // [m]

/** Length of a line so far at each of its points. */
function lengthsOf(line) {
  const lengths = [0];
  for (let i = 1; i < line.length; ++i)
    lengths.push(lengths[i - 1] + Math.hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]));
  return lengths;
}

/** A line so many metres to the left of another. */
function besideOf(line, left) {
  return line.map(([x, y], i) => {
    const before = line[Math.max(0, i - 1)];
    const after = line[Math.min(line.length - 1, i + 1)];
    const dx = after[0] - before[0];
    const dy = after[1] - before[1];
    const length = Math.hypot(dx, dy) || 1;
    return [x - (left * dy) / length, y + (left * dx) / length];
  });
}

/** Place and heading so far along a line. */
function pointAlong(line, lengths, s) {
  let i = 1;
  while (i < line.length - 1 && lengths[i] < s) ++i;
  const [x0, y0] = line[i - 1];
  const [x1, y1] = line[i];
  const share = (s - lengths[i - 1]) / (lengths[i] - lengths[i - 1] || 1);
  return { x: x0 + share * (x1 - x0), y: y0 + share * (y1 - y0), yaw: Math.atan2(y1 - y0, x1 - x0) };
}

function boxOf(line, margin) {
  const box = { west: Infinity, south: Infinity, east: -Infinity, north: -Infinity };
  for (const [x, y] of line) {
    box.west = Math.min(box.west, x - margin);
    box.east = Math.max(box.east, x + margin);
    box.south = Math.min(box.south, y - margin);
    box.north = Math.max(box.north, y + margin);
  }
  return box;
}

function touch(one, other) {
  return one.west < other.east && one.east > other.west && one.south < other.north && one.north > other.south;
}

function rectangle(x, y, yaw, length, width) {
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  return [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([u, v]) => {
    const along = (u * length) / 2;
    const across = (v * width) / 2;
    return [x + along * c - across * s, y + along * s + across * c];
  });
}

/** A layer is drawn in one style: { fill } or { stroke, width, dash, round }, names of colours; `from` is the least scale [px/m] at
 * which it is worth drawing. The lowest first. */
class Layers {
  constructor() {
    this.styles = new Map();
    this.tiles = new Map();
  }

  /** A line, a polygon, or a circle around its one point. */
  add(key, style, line, { closed = false, margin = 0, radius = 0 } = {}) {
    if (line.length < 2 && radius === 0) return;
    this.styles.set(key, style);
    const box = boxOf(line, margin + radius);
    const column = Math.floor((box.west + box.east) / 2 / TILE);
    const row = Math.floor((box.south + box.north) / 2 / TILE);
    const name = `${column},${row}`;
    if (!this.tiles.has(name)) this.tiles.set(name, { box: { ...box }, paths: new Map() });
    const tile = this.tiles.get(name);
    tile.box.west = Math.min(tile.box.west, box.west);
    tile.box.east = Math.max(tile.box.east, box.east);
    tile.box.south = Math.min(tile.box.south, box.south);
    tile.box.north = Math.max(tile.box.north, box.north);
    if (!tile.paths.has(key)) tile.paths.set(key, new Path2D());
    const path = tile.paths.get(key);
    if (radius > 0) {
      path.moveTo(line[0][0] + radius, line[0][1]);
      path.arc(line[0][0], line[0][1], radius, 0, 2 * Math.PI);
      return;
    }
    path.moveTo(line[0][0], line[0][1]);
    for (let i = 1; i < line.length; ++i) path.lineTo(line[i][0], line[i][1]);
    if (closed) path.closePath();
  }

  /** `context` draws metres; `colour` turns a name into one. */
  draw(context, box, scale, colour) {
    const tiles = [...this.tiles.values()].filter((tile) => touch(tile.box, box));
    for (const [key, style] of [...this.styles].sort((one, other) => one[1].order - other[1].order)) {
      if (scale < (style.from || 0)) continue;
      context.setLineDash(style.dash || []);
      context.lineCap = 'butt';
      context.lineJoin = 'round';
      if (style.fill) context.fillStyle = colour(style.fill);
      if (style.stroke) context.strokeStyle = colour(style.stroke);
      context.lineWidth = Math.max(style.width || 0, (style.pixels || 0) / scale);
      for (const tile of tiles) {
        const path = tile.paths.get(key);
        if (!path) continue;
        if (style.fill) context.fill(path, 'nonzero');
        if (style.stroke) context.stroke(path);
      }
    }
    context.setLineDash([]);
  }
}
