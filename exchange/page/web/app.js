'use strict';
// Joins the parts: reads the data, draws when something changed, and answers keys and buttons.

class App {
  constructor(trace) {
    this.trace = trace;
    this.theme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
    this.town = new Town({ ...trace.head.town, models: trace.head.models });
    this.actors = new Actors(trace, this.town);
    this.chosen = this.firstChosen();
    this.following = false;
    this.canvas = this.get('map');
    this.view = new View(this.canvas, this.town.box, {
      changed: () => this.draw(),
      resized: () => this.timeline && this.drawNow(),
      clicked: (left, top) => this.choose(this.actors.pick(this.view, left, top)),
      hovered: (left, top) => this.hover(left, top),
      moved: (how) => how === 'drag' && this.follow(false),
    });
    this.timeline = new Timeline(trace, {
      slider: this.get('slider'), marks: this.get('marks'), seconds: this.get('seconds'), tick: this.get('tick'), speed: this.get('speed'),
      play: this.get('play'),
    }, () => this.timeChanged());
    this.plots = new Plots(this.get('plots'), trace, (tick) => this.timeline.seek(tick));
    this.panels = new Panels(trace, (event) => this.go(event));
    this.timeline.setMarks(this.panels.marks());
    this.listActors();
    this.bindButtons();
    addEventListener('keydown', (event) => this.key(event));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', ({ matches }) => this.setTheme(matches ? 'dark' : 'light'));
    this.setTheme(this.theme);
    this.showChosen();
    this.start();
  }

  get(id) {
    return document.getElementById(id);
  }

  /** Whom most came to see: what another program drives, else the scenario's first with mass, else its first. */
  firstChosen() {
    const { tracks } = this.trace;
    const found = tracks.find((track) => track.driver === 'external') || tracks.find((track) => track.isCast && track.name === 'ego') ||
      tracks.find((track) => track.isCast && track.kind === 'vehicle') || tracks.find((track) => track.isCast) || tracks[0];
    return found ? found.id : 0;
  }

  /** With the chosen one in sight, near enough to see what it does; a link may say otherwise: #t=12.5&actor=ego. */
  start() {
    const asked = new URLSearchParams(location.hash.slice(1));
    const wanted = this.trace.tracks.find((track) => track.name === asked.get('actor') || String(track.id) === asked.get('actor'));
    if (wanted) this.choose(wanted);
    const seconds = Number.parseFloat(asked.get('t'));
    this.timeline.seek(Number.isFinite(seconds) ? Math.round(seconds / this.trace.step) : this.trace.first);
    if (this.trace.tracks.some((track) => track.isCast) || wanted) {
      const first = (this.trace.byActor.get(this.chosen) || [])[0];
      if (first) {
        const scale = Math.max(this.view.scale, Math.min(this.view.width, this.view.height * 1.4) / 120);
        this.view.lookAt(this.trace.x[first.begin] / 100, this.trace.y[first.begin] / 100, scale);
      }
      this.follow(true);
    }
  }

  bindButtons() {
    const on = (id, act) => this.get(id).addEventListener('click', act);
    on('play', () => this.timeline.toggle());
    on('to-start', () => this.timeline.seek(this.trace.first));
    on('back', () => this.timeline.step(-1));
    on('forward', () => this.timeline.step(1));
    on('zoom-in', () => this.view.zoom(1.5));
    on('zoom-out', () => this.view.zoom(1 / 1.5));
    on('fit', () => this.fit());
    on('follow', () => this.follow(!this.following));
    on('labels', () => this.nextLabels());
    on('theme', () => this.setTheme(this.theme === 'dark' ? 'light' : 'dark'));
    this.get('actor').addEventListener('change', ({ target }) => {
      this.choose((this.trace.byActor.get(Number(target.value)) || [])[0]);
      target.blur(); // the next key is for the clock again
    });
  }

  key(event) {
    const { target, key } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || target.tagName === 'SELECT') return;
    // A button that has the focus is pressed by space; the slider moves by itself.
    if (key === ' ' && (target.tagName === 'BUTTON' || target.tagName === 'SUMMARY')) return;
    const acts = {
      ' ': () => this.timeline.toggle(),
      ',': () => this.timeline.step(-1),
      '.': () => this.timeline.step(1),
      ArrowLeft: () => this.timeline.skip(event.shiftKey ? -10 : -1),
      ArrowRight: () => this.timeline.skip(event.shiftKey ? 10 : 1),
      Home: () => this.timeline.seek(this.trace.first),
      End: () => this.timeline.seek(this.trace.last),
      '[': () => this.timeline.faster(-1),
      ']': () => this.timeline.faster(1),
      n: () => this.toEvent(1),
      p: () => this.toEvent(-1),
      '+': () => this.view.zoom(1.3),
      '=': () => this.view.zoom(1.3),
      '-': () => this.view.zoom(1 / 1.3),
      0: () => this.fit(),
      f: () => this.follow(!this.following),
      l: () => this.nextLabels(),
    };
    if (!acts[key]) return;
    event.preventDefault();
    acts[key]();
  }

  fit() {
    this.follow(false);
    this.view.fit();
  }

  nextLabels() {
    const order = ['cast', 'all', 'none'];
    this.actors.labels = order[(order.indexOf(this.actors.labels) + 1) % order.length];
    this.say({ cast: "Labels: the scenario's actors", all: 'Labels: everybody in sight', none: 'No labels' }[this.actors.labels]);
    this.get('labels').setAttribute('aria-pressed', String(this.actors.labels !== 'none'));
    this.draw();
  }

  say(text) {
    const toast = this.get('toast');
    toast.textContent = text;
    toast.classList.add('shown');
    clearTimeout(this.toasting);
    this.toasting = setTimeout(() => toast.classList.remove('shown'), 1800);
  }

  setTheme(theme) {
    this.theme = theme;
    document.documentElement.classList.toggle('dark', theme === 'dark');
    document.documentElement.style.colorScheme = theme;
    this.timeline.drawMarks();
    if (this.plots.series) this.showPlots();
    this.draw();
  }

  listActors() {
    const select = this.get('actor');
    const group = (title, tracks) => {
      if (tracks.length === 0) return;
      const made = select.appendChild(element('optgroup', '', { label: title }));
      for (const track of tracks) made.append(new Option(track.name, track.id));
    };
    const all = [...this.trace.byActor.values()].map(([track]) => track).sort((one, other) => one.id - other.id);
    group('Scenario', all.filter((track) => track.isCast));
    group('Things', all.filter((track) => track.kind === 'prop'));
    group('Traffic', all.filter((track) => !track.isCast && (track.kind === 'vehicle' || track.kind === 'car')));
    group('On foot', all.filter((track) => !track.isCast && track.kind === 'walker'));
    select.disabled = all.length === 0;
  }

  choose(track) {
    if (!track) return;
    this.chosen = track.id;
    this.showChosen();
    this.follow(true);
  }

  showChosen() {
    this.get('actor').value = String(this.chosen);
    const [track] = this.trace.byActor.get(this.chosen) || [];
    this.get('plots').hidden = !track;
    if (!track) return;
    if (!this.series || this.series.id !== this.chosen) this.series = { id: this.chosen, ...seriesOf(this.trace, this.chosen) };
    this.showPlots();
    this.showCard();
  }

  showPlots() {
    const [track] = this.trace.byActor.get(this.chosen);
    this.plots.show(this.series, this.actors.colourOf(track, this.theme));
  }

  showCard() {
    const [track] = this.trace.byActor.get(this.chosen) || [];
    if (!track) return this.panels.showCard([['', 'Nobody is in this trace.']]);
    const here = this.trace.actorAt(this.chosen, this.timeline.tick);
    const now = here ? here.track : track;
    const facts = [['kind', now.noun], ['driver', now.driver.replace(/_/g, ' ')]];
    if (!here) facts.push(['', 'not there now']);
    else if (this.trace.laneName(here.k)) facts.push(['lane', this.trace.laneName(here.k)]);
    if (here && now.kind === 'vehicle') {
      const pedals = this.trace.pedals[now.own + here.k - now.begin];
      facts.push(pedals < 0 ? ['brake', `${-pedals} %`] : ['throttle', `${pedals} %`]);
    }
    this.panels.showCard(facts);
  }

  follow(on) {
    this.following = on;
    this.get('follow').setAttribute('aria-pressed', String(on));
    this.draw();
  }

  timeChanged() {
    if (!this.plots) return;
    this.plots.setTime(this.timeline.time);
    this.panels.setTime(this.timeline.tick);
    this.showCard();
    this.draw();
  }

  /** To what happened: when, who and where. */
  go(event) {
    this.timeline.pause();
    this.timeline.seek(event.tick);
    this.panels.markLine(event.line);
    const [track] = (event.actor && this.trace.byActor.get(event.actor)) || [];
    if (track) this.choose(track);
    else if (event.at) {
      this.follow(false);
      this.view.lookAt(event.at[0], event.at[1], Math.max(this.view.scale, 8));
    }
  }

  toEvent(by) {
    const ticks = this.panels.events.map(({ tick }) => tick);
    const now = this.timeline.tick;
    const next = by > 0 ? ticks.find((tick) => tick > now) : ticks.filter((tick) => tick < now).pop();
    if (next === undefined) this.say(by > 0 ? 'No later event' : 'No earlier event');
    else this.timeline.seek(next);
  }

  hover(left, top) {
    this.canvas.classList.toggle('over', Boolean(this.actors.pick(this.view, left, top)));
    const [x, y] = this.view.toWorld(left, top);
    const lane = this.view.scale > 1 ? this.town.laneAt(x, y) : null;
    this.get('where').textContent = lane ? (lane.street ? `${lane.name} · ${lane.street}` : lane.name) : '';
  }

  /** Once for all that changes before the next picture. */
  draw() {
    if (this.isAsked || !this.timeline) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.drawNow();
    });
  }

  drawNow() {
    const { view, canvas } = this;
    if (this.following) {
      const here = this.trace.actorAt(this.chosen, this.timeline.time);
      if (here) Object.assign(view, { x: here.x, y: here.y, isFit: false });
    }
    const context = canvas.getContext('2d', { alpha: false });
    context.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    this.town.draw(context, view, this.theme);
    this.actors.draw(context, view, this.timeline.time, this.theme, this.chosen);
    this.drawCrashes(context);
    this.showScale();
  }

  /** A ring where somebody just crashed. */
  drawCrashes(context) {
    const { trace, timeline, view } = this;
    for (const { kind, tick, end, at } of trace.head.events) {
      const since = trace.seconds(timeline.time - tick);
      const over = trace.seconds(timeline.time - (end || tick));
      if (kind !== 'collision' || !at || since < 0 || over > 1) continue;
      const [left, top] = view.toScreen(at[0], at[1]);
      context.beginPath();
      context.arc(left, top, 12 + 26 * Math.min(1, since), 0, 7);
      context.lineWidth = 3;
      context.strokeStyle = '#f03e3e';
      context.globalAlpha = 1 - Math.max(0, over);
      context.stroke();
      context.globalAlpha = 1;
    }
  }

  showScale() {
    if (this.shownScale === this.view.scale) return;
    this.shownScale = this.view.scale;
    const step = niceStep(120 / this.view.scale, 1.6);
    this.get('scale').textContent = step < 1 ? `${Math.round(step * 100)} cm` : `${step} m`;
    this.get('scale').style.setProperty('--length', `${step * this.view.scale}px`);
  }
}

function fail(error) {
  const text = typeof DecompressionStream === 'undefined'
    ? 'This browser is too old to unpack the run: any of 2023 or later can.'
    : `The run in this page cannot be read: ${error.message}`;
  document.getElementById('loading-text').textContent = text;
  document.querySelector('.spinner').hidden = true;
  throw error;
}

/** For tests and the curious: when all is there, the app itself, and who is drawn where at a tick. */
const replay = {
  ready: (async () => {
    const data = document.getElementById('data');
    const trace = await Trace.read(data.textContent.trim());
    data.remove();
    replay.app = new App(trace);
    document.getElementById('loading').hidden = true;
    return true;
  })().catch(fail),

  drawnAt(tick) {
    const { app } = replay;
    app.timeline.seek(tick);
    app.drawNow();
    return {
      actors: app.actors.drawn.map(({ track, x, y, yaw, speed }) => ({ id: track.id, kind: track.kind, name: track.name, x, y, yaw, speed })),
      signals: app.actors.signalsAt(tick),
    };
  },
};
window.replay = replay;
