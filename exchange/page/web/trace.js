'use strict';
// The data of the page: unpacked once, then asked who is where at which time. A time is a tick, with a fraction while
// a run plays; seconds are computed from it where they are shown.

/** Whole numbers as NumberColumn (number_column.h) wrote them. */
class NumberReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  next() {
    const bytes = this.bytes;
    let byte = bytes[this.at++];
    let value = byte & 0x7f;
    for (let shift = 7; byte >= 0x80; shift += 7) {
      byte = bytes[this.at++];
      value |= (byte & 0x7f) << shift;
    }
    return (value >>> 1) ^ -(value & 1);
  }
}

/** The bytes behind base64 and zlib. */
async function unpacked(base64) {
  const text = atob(base64);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** A line of whole centimetres, the first point and then differences, as [x, y] in metres. */
function lineOf(numbers) {
  const points = [];
  let x = 0;
  let y = 0;
  for (let i = 0; i < numbers.length; i += 2) {
    x += numbers[i];
    y += numbers[i + 1];
    points.push([x / 100, y / 100]);
  }
  return points;
}

const TURN = 4096; // steps of a yaw
const KINDS = ['vehicle', 'car', 'walker', 'prop'];
const BICYCLE = 11; // world/models/catalogue.h, BodyStyle
const MOTORCYCLE = 10;
const FIRST_BACKGROUND = 1000000;

class Trace {
  static async read(base64) {
    const bytes = await unpacked(base64);
    const length = new DataView(bytes.buffer).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
    return new Trace(head, bytes.subarray(4 + length));
  }

  constructor(head, bytes) {
    Object.assign(this, { head, step: head.step, first: head.first, last: Math.max(head.first, head.last) });
    const readers = {};
    let at = 0;
    for (const [name, size] of head.columns) {
      readers[name] = new NumberReader(bytes.subarray(at, at + size));
      at += size;
    }
    this.clocks = head.clocks.map((count) => {
      const ticks = new Int32Array(count);
      for (let i = 0, tick = 0; i < count; ++i) ticks[i] = tick += readers.clocks.next();
      return ticks;
    });
    this.readTracks(readers);
  }

  readTracks(readers) {
    const places = this.head.tracks.reduce((sum, row) => sum + row[5], 0);
    const owned = this.head.tracks.reduce((sum, row) => sum + (row[1] === 0 ? row[5] : 0), 0);
    this.x = new Int32Array(places);
    this.y = new Int32Array(places);
    this.yaw = new Int16Array(places);
    this.speed = new Int32Array(places);
    this.lane = new Int32Array(places);
    this.lamps = new Int32Array(places);
    for (const name of ['steer', 'gap', 'offset', 'pedals']) this[name] = new Int32Array(owned);
    this.tracks = [];
    this.byActor = new Map();
    let begin = 0;
    let own = 0;
    for (const [id, kind, model, clock, first, count] of this.head.tracks) {
      const track = { id, kind: KINDS[kind], clock, first, count, begin, own, model, shape: this.shapeOf(kind, model) };
      this.readPlaces(track, readers);
      this.describe(track);
      begin += count;
      if (kind === 0) own += count;
      this.tracks.push(track);
      if (!this.byActor.has(id)) this.byActor.set(id, []);
      this.byActor.get(id).push(track);
    }
    for (const tracks of this.byActor.values()) this.join(tracks);
  }

  /** In the order of time. Who is hit as a car of traffic goes on as a body: one actor, who is nobody's from there on. */
  join(tracks) {
    const began = ({ clock, first }) => this.clocks[clock][first];
    tracks.sort((one, other) => began(one) - began(other));
    const hit = tracks.find((track) => track.kind === 'car');
    if (!hit) return;
    for (const track of tracks)
      if (track.kind === 'vehicle') Object.assign(track, { driver: 'nobody, a wreck', isParked: false });
  }

  shapeOf(kind, model) {
    const models = [this.head.models, this.head.models, this.head.walkers, this.head.props][kind];
    return { rear: models[0].length / 2, ...(models[model] || models[0]) };
  }

  /** Undoes PageActors::write (page_actors.cpp). */
  readPlaces(track, readers) {
    let [x, y, yaw, speed, lane, lamps, stepX, stepY] = [0, 0, 0, 0, -1, 0, 0, 0];
    let [steer, gap, offset, pedals] = [0, 0, 0, 0];
    for (let i = 0; i < track.count; ++i) {
      const k = track.begin + i;
      const movedX = stepX + readers.x.next();
      const movedY = stepY + readers.y.next();
      stepX = i === 0 ? 0 : movedX;
      stepY = i === 0 ? 0 : movedY;
      this.x[k] = x += movedX;
      this.y[k] = y += movedY;
      yaw = (((yaw + readers.yaw.next() + TURN / 2) % TURN) + TURN) % TURN - TURN / 2;
      this.yaw[k] = yaw;
      this.speed[k] = speed += readers.speed.next();
      this.lane[k] = lane += readers.lane.next();
      this.lamps[k] = lamps += readers.lamps.next();
      if (track.kind !== 'vehicle') continue;
      const j = track.own + i;
      this.steer[j] = steer += readers.steer.next();
      this.gap[j] = gap += readers.gap.next();
      this.offset[j] = offset += readers.offset.next();
      this.pedals[j] = pedals += readers.pedals.next();
    }
  }

  /** Who it is, in words. */
  describe(track) {
    const name = this.head.names[track.id];
    const driver = this.head.drivers[track.id];
    track.driver = driver || { vehicle: 'unknown', car: 'traffic', walker: 'walker', prop: 'prop' }[track.kind];
    track.isCast = track.id < FIRST_BACKGROUND && !this.head.start.imported && track.kind !== 'prop';
    track.isParked = driver === 'parked';
    track.isTwoWheeler = track.shape.body >= MOTORCYCLE;
    track.noun = track.kind === 'walker' ? 'walker' : track.shape.body === BICYCLE ? 'bicycle' : track.shape.name;
    track.name = name || `${track.noun} ${track.id}`;
  }

  seconds(tick) {
    return tick * this.step;
  }

  /** The last frame of a clock that is not behind a time, and how far the next one is: a share. */
  frameAt(clock, time) {
    const ticks = this.clocks[clock];
    if (ticks.length === 0 || time < ticks[0]) return { frame: -1, share: 0 };
    let low = 0;
    let high = ticks.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (ticks[middle] <= time) low = middle;
      else high = middle;
    }
    const span = low + 1 < ticks.length ? ticks[low + 1] - ticks[low] : 0;
    return { frame: low, share: span > 0 ? (time - ticks[low]) / span : 0, span };
  }

  /** Where an actor is at a frame and a share of the way to the next one; null when it is not there. */
  place(track, { frame, share, span }) {
    const i = frame - track.first;
    if (frame < 0 || i < 0 || i >= track.count) return null;
    const k = track.begin + i;
    const yaw = (this.yaw[k] / TURN) * 2 * Math.PI;
    const here = { track, k, x: this.x[k] / 100, y: this.y[k] / 100, yaw, speed: this.speed[k] / 100, lamps: this.lamps[k] };
    here.steer = track.kind === 'vehicle' ? this.steer[track.own + i] / 1000 : 0;
    if (share > 0 && i + 1 < track.count) this.moveOn(here, k, share, span * this.step);
    return here;
  }

  /** Between two frames: along the curve that leaves and arrives with the speeds and headings of both. */
  moveOn(here, k, share, seconds) {
    const dx = (this.x[k + 1] - this.x[k]) / 100;
    const dy = (this.y[k + 1] - this.y[k]) / 100;
    const next = this.speed[k + 1] / 100;
    const most = 0.75 * (Math.abs(here.speed) + Math.abs(next)) * seconds + 1;
    if (Math.hypot(dx, dy) > 2 * most) return; // it was put somewhere else
    let turned = this.yaw[k + 1] - this.yaw[k];
    turned -= Math.round(turned / TURN) * TURN;
    const turnedBy = (turned / TURN) * 2 * Math.PI;
    const u = share;
    const leaving = (u - 2 * u * u + u * u * u) * here.speed * seconds;
    const arriving = (u * u * u - u * u) * next * seconds;
    const done = u * u * (3 - 2 * u);
    here.x += done * dx + leaving * Math.cos(here.yaw) + arriving * Math.cos(here.yaw + turnedBy);
    here.y += done * dy + leaving * Math.sin(here.yaw) + arriving * Math.sin(here.yaw + turnedBy);
    here.yaw += u * turnedBy;
    here.speed += u * (next - here.speed);
  }

  /** Everybody at a time. */
  present(time) {
    const at = this.clocks.map((_, clock) => this.frameAt(clock, time));
    const all = [];
    for (const track of this.tracks) {
      const here = this.place(track, at[track.clock]);
      if (here) all.push(here);
    }
    return all;
  }

  /** One actor at a time, or null. */
  actorAt(id, time) {
    for (const track of this.byActor.get(id) || []) {
      const here = this.place(track, this.frameAt(track.clock, time));
      if (here) return here;
    }
    return null;
  }

  laneName(k) {
    const lane = this.head.town.lanes[this.lane[k]];
    return lane ? lane.name : '';
  }

  /** Index in the columns of the frame of a track that is not behind a tick; -1 when it is not there. */
  indexAt(track, tick) {
    const i = this.frameAt(track.clock, tick).frame - track.first;
    return i < 0 || i >= track.count ? -1 : track.begin + i;
  }
}
