'use strict';
// What never moves, from above: land, roads with their paint, buildings, trees, furniture. The picture is kept until the
// camera leaves it. Metres, x east, y north.

const TOWN_COLOURS = {
  light: {
    land: '#e6eadc', sidewalk: '#d6d2c8', kerb: '#bdb8ad', road: '#8b9199', junction: '#8b9199', other: '#a4918a', paint: '#f3f3ee',
    crossing: '#eceeec', building: ['#cdbfae', '#c4b7aa', '#d3c3b3', '#bfb4ab', '#c9b8a4'], roof: '#9d8f80', shadow: '#3a35301f',
    tree: ['#86b074', '#78a567', '#93b87f'], treeEdge: '#5f8a5066', treeLight: '#ffffff1c', slope: '#00000012',  prop: '#8a8f96', hedge: '#6f9e5c', wall: '#a59a8c', parked: '#6b737d',
    plots: { lawn: '#d7e3c0', park: '#c6dbab', square: '#e2d9c8', gravel: '#dbd1bc', water: '#a3cbe2', car_park: '#bfc2c6',
      playground: '#ead3a4', forest: '#b0cd98' },
  },
  dark: {
    land: '#1a1f1d', sidewalk: '#363a3d', kerb: '#4b5054', road: '#474d54', junction: '#474d54', other: '#584a45', paint: '#b9bec3',
    crossing: '#9da3a8', building: ['#2c3238', '#30363b', '#292f34', '#33383c', '#2e3337'], roof: '#444c53', shadow: '#00000055',
    tree: ['#2c4a30', '#27422b', '#315136'], treeEdge: '#00000044', treeLight: '#ffffff0a', slope: '#0000002b',  prop: '#6d747b', hedge: '#2f5133', wall: '#565b5f', parked: '#59626b',
    plots: { lawn: '#1f2a20', park: '#203022', square: '#2b2c2c', gravel: '#2c2b28', water: '#1d3a4c', car_park: '#34383c',
      playground: '#3a3426', forest: '#1c2e20' },
  },
};

const LINE = 0.14; // [m] width of painted lines, a little more than true ones: screens are coarse

class Town {
  constructor(town) {
    this.name = town.name;
    this.leftHand = town.left_hand;
    this.lanes = town.lanes.map((lane) => ({ ...lane, line: lineOf(lane.line), width: lane.width / 100 }));
    const beside = 30;
    this.box = { west: town.low[0] - beside, south: town.low[1] - beside, east: town.high[0] + beside, north: town.high[1] + beside };
    this.layers = new Layers();
    for (const plot of town.plots)
      this.layers.add(`plot ${plot.kind}`, { order: 0, fill: `plots.${plot.kind}` }, lineOf(plot.outline), { closed: true });
    for (const lane of this.lanes) this.addLane(lane);
    for (const outline of town.junctions)
      this.layers.add('junction', { order: 4, fill: 'junction' }, lineOf(outline), { closed: true });
    town.props.forEach((prop) => this.addProp(prop, town));
    town.buildings.forEach((building) => this.addBuilding(building));
    town.trees.forEach((tree, i) => this.addTree(tree, i));
    this.signals = this.signalBars(town.signals);
    this.cached = null;
  }

  addLane(lane) {
    const { line, width } = lane;
    const across = { margin: width / 2 };
    const strip = (key, order, stroke, wider = 0, pixels = 0) =>
      this.layers.add(`${key} ${width}`, { order, stroke, width: width + wider, pixels }, line, across);
    if (lane.kind === 'sidewalk') {
      strip('kerb', 1, 'kerb', 0.3);
      strip('sidewalk', 2, 'sidewalk');
    } else if (lane.kind === 'walking_area') {
      if (!lane.outline) return;
      const outline = lineOf(lane.outline);
      this.layers.add('kerb area', { order: 1, stroke: 'kerb', width: 0.3 }, outline, { closed: true });
      this.layers.add('walking area', { order: 2, fill: 'sidewalk' }, outline, { closed: true });
    } else if (lane.kind === 'driving') {
      strip('road', 3, 'road', 0.3, 1.6);
      this.addPaint(lane);
    } else if (lane.kind === 'internal') {
      strip('inside', 5, 'junction', 0.1, 1.2);
    } else if (lane.kind === 'other') {
      strip('other', 2.5, 'other');
    } else if (lane.kind === 'crossing') {
      this.layers.add(`zebra ${width}`, { order: 7, stroke: 'crossing', width, dash: [0.5, 0.5], from: 1.2 }, line, across);
    }
  }

  addPaint(lane) {
    const left = lane.width / 2;
    const paint = (key, dash, line, width = LINE) =>
      this.layers.add(`paint ${key}`, { order: 6, stroke: 'paint', width, dash, from: 1.6 }, line);
    const inner = this.leftHand ? -left : left;
    if (lane.inner === 'dashed') paint('dashed', [3, 6], besideOf(lane.line, inner));
    if (lane.inner === 'broken') paint('broken', [4, 4], besideOf(lane.line, inner));
    if (lane.inner === 'solid') paint('solid', [], besideOf(lane.line, inner));
    if (lane.inner === 'edge') paint('solid', [], besideOf(lane.line, inner - Math.sign(inner) * 0.15));
    if (lane.outer) paint('solid', [], besideOf(lane.line, -inner + Math.sign(inner) * 0.15));
    if (!lane.end || lane.line.length < 2) return;
    const lengths = lengthsOf(lane.line);
    const end = pointAlong(lane.line, lengths, Math.max(0, lengths[lengths.length - 1] - 0.6));
    const bar = [-left + 0.2, left - 0.2].map((t) => [end.x - t * Math.sin(end.yaw), end.y + t * Math.cos(end.yaw)]);
    paint(lane.end, lane.end === 'yield' ? [0.45, 0.35] : [], bar, 0.4);
  }

  addBuilding({ outline, height, style }) {
    const line = lineOf(outline);
    const reach = Math.min(7, 0.8 + 0.22 * height); // as a sun in the north-west throws it, not too far
    this.layers.add('shadow', { order: 10, fill: 'shadow' }, line.map(([x, y]) => [x + reach, y - reach]), { closed: true });
    const shade = style % 5;
    this.layers.add(`building ${shade}`, { order: 11, fill: `building.${shade}`, stroke: 'roof', width: 0.12, pixels: 0.7 }, line,
      { closed: true });
    if (line.length === 4 && height < 13) this.addGable(line);
  }

  /** Houses have a ridge along their longer side: the half behind it lies in the shade. */
  addGable([a, b, c, d]) {
    const middle = ([x0, y0], [x1, y1]) => [(x0 + x1) / 2, (y0 + y1) / 2];
    const isAlongAb = Math.hypot(b[0] - a[0], b[1] - a[1]) > Math.hypot(c[0] - b[0], c[1] - b[1]);
    const [begin, end] = isAlongAb ? [middle(a, d), middle(b, c)] : [middle(a, b), middle(d, c)];
    const halves = isAlongAb ? [[a, b], [d, c]] : [[a, d], [b, c]];
    const shade = halves.sort((one, other) => other[0][0] - other[0][1] - (one[0][0] - one[0][1]))[0]; // away from the sun
    this.layers.add('slope', { order: 12, fill: 'slope', from: 1 }, [begin, end, shade[1], shade[0]], { closed: true });
    this.layers.add('ridge', { order: 12.1, stroke: 'roof', width: 0.1, pixels: 0.6, from: 1.5 }, [begin, end]);
  }

  addTree([x, y, radius, kind], i) {
    const [cx, cy, r] = [x / 100, y / 100, Math.max(0.2, radius / 100)];
    const shade = (i + kind) % 3;
    this.layers.add('tree shadow', { order: 8, fill: 'shadow', from: 1 }, [[cx + 0.7, cy - 0.7]], { radius: r });
    this.layers.add(`tree ${shade}`, { order: 9, fill: `tree.${shade}`, stroke: 'treeEdge', width: 0.2, from: 0.35 }, [[cx, cy]], { radius: r });
    this.layers.add('tree light', { order: 9.1, fill: 'treeLight', from: 2 }, [[cx - 0.22 * r, cy + 0.22 * r]], { radius: 0.62 * r });
  }

  addProp([kind, x, y, yaw, length, width, value], { models }) {
    const thin = { fence: 'prop', wall: 'wall', hedge: 'hedge', bench: 'prop', bus_stop: 'prop', table: 'prop', swing: 'prop',
      fountain: 'plots.water', bin: 'prop', bollard: 'prop', hydrant: 'prop', mailbox: 'prop' };
    const where = [x / 100, y / 100, yaw / 1000];
    if (kind === 'parked_vehicle') {
      const shape = (models || [])[value] || { length: length / 100, width: width / 100 };
      this.layers.add('parked', { order: 7.5, fill: 'parked', from: 0.6 }, rectangle(...where, shape.length, shape.width), { closed: true });
    } else if (thin[kind]) {
      const corners = rectangle(...where, Math.max(0.3, length / 100), Math.max(0.25, width / 100));
      this.layers.add(`prop ${thin[kind]}`, { order: 7.6, fill: thin[kind], from: 1.5 }, corners, { closed: true });
    } else {
      this.layers.add('pole', { order: 7.7, fill: 'prop', from: 3 }, rectangle(...where, 0.25, 0.25), { closed: true });
    }
  }

  /** For each signal a bar beside the others of its lane, in front of the stop line; a dot for those who walk. */
  signalBars(signals) {
    const lanes = new Map();
    signals.forEach(([, , , lane], i) => lane >= 0 && lanes.set(lane, [...(lanes.get(lane) || []), i]));
    return signals.map(([x, y, yaw, lane], i) => {
      const bar = { x: x / 100, y: y / 100, yaw: yaw / 1000, forWalkers: lane < 0 };
      if (lane < 0) return bar;
      const here = lanes.get(lane);
      const width = this.lanes[lane].width * 0.92;
      bar.each = width / here.length;
      bar.left = -width / 2 + bar.each * here.indexOf(i);
      return bar;
    });
  }

  /** Draws the ground, from a picture that reaches beyond what is in sight. */
  draw(context, view, theme) {
    const ratio = view.ratio;
    const kept = this.cached;
    const sameScale = kept && kept.scale === view.scale && kept.theme === theme && kept.ratio === ratio;
    const covers = kept && kept.box.west <= view.box.west && kept.box.east >= view.box.east && kept.box.south <= view.box.south &&
      kept.box.north >= view.box.north;
    // While somebody zooms, a stretched picture will do for large towns.
    const goodEnough = kept && kept.theme === theme && covers && kept.cost > 12 && view.isZooming;
    if (!(sameScale && covers) && !goodEnough) this.paint(view, theme);
    const picture = this.cached;
    const scale = (view.scale / picture.scale) * 1;
    const [left, top] = view.toScreen(picture.box.west, picture.box.north);
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.imageSmoothingEnabled = scale !== 1;
    context.drawImage(picture.canvas, scale === 1 ? Math.round(left * ratio) : left * ratio,
      scale === 1 ? Math.round(top * ratio) : top * ratio, picture.canvas.width * scale, picture.canvas.height * scale);
    context.restore();
  }

  paint(view, theme) {
    const begin = performance.now();
    const ratio = view.ratio;
    const margin = 0.3;
    const wide = Math.ceil(view.width * (1 + 2 * margin) * ratio);
    const high = Math.ceil(view.height * (1 + 2 * margin) * ratio);
    const canvas = this.cached ? this.cached.canvas : document.createElement('canvas');
    if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
    const west = view.x - wide / ratio / view.scale / 2;
    const north = view.y + high / ratio / view.scale / 2;
    const box = { west, north, east: west + wide / ratio / view.scale, south: north - high / ratio / view.scale };
    const colours = TOWN_COLOURS[theme];
    const colour = (name) => name.split('.').reduce((found, part) => found && found[part], colours) || colours.prop;
    const context = canvas.getContext('2d', { alpha: false });
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = colours.land;
    context.fillRect(0, 0, wide, high);
    const scale = view.scale * ratio;
    context.setTransform(scale, 0, 0, -scale, -west * scale, north * scale);
    this.layers.draw(context, box, scale, colour);
    this.cached = { canvas, box, scale: view.scale, theme, ratio, cost: performance.now() - begin };
  }

  /** The lane under a place, for people: driving lanes and sidewalks before those in junctions. */
  laneAt(x, y) {
    let best = null;
    for (const lane of this.lanes) {
      const reach = lane.width / 2;
      lane.box = lane.box || boxOf(lane.line, reach);
      if (x < lane.box.west || x > lane.box.east || y < lane.box.south || y > lane.box.north) continue;
      for (let i = 1; i < lane.line.length; ++i) {
        const [x0, y0] = lane.line[i - 1];
        const [dx, dy] = [lane.line[i][0] - x0, lane.line[i][1] - y0];
        const share = Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1)));
        const away = Math.hypot(x - x0 - share * dx, y - y0 - share * dy);
        if (away < reach && (!best || away < best.away)) best = { lane, away };
      }
    }
    return best && best.lane;
  }
}
