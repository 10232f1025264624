'use strict';
// What is told in words: how the run ended, checks, events, the chosen actor, the scenario. All texts of the trace go into the
// document through textContent.

const EVENT_COLOURS = {
  collision: '#e03131', collision_ended: '#e03131', check_failed: '#e03131', check_passed: '#2f9e57', not_evaluated: '#c98a00', blocked: '#c98a00',
  printed: '#3b82c4', finished: '#6b7077', spawned: '#9aa3ab', despawned: '#9aa3ab',
};
const EVENT_WORDS = {
  collision: 'crashes', collision_ended: 'crashes', printed: 'said', spawned: 'comes and goes', despawned: 'comes and goes', blocked: 'blocked', finished: 'end',
  check_failed: 'checks', check_passed: 'checks', not_evaluated: 'checks',
};
const VERDICTS = { driver_lost: 'driver lost', error: 'cut off', part: 'part of a run' };
const MOST_ROWS = 1500; // of a list: what printed in each tick would freeze the page

/** An element with a text and attributes. */
function element(name, text = '', attributes = {}) {
  const made = document.createElement(name);
  if (text !== '') made.textContent = text;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

function wordOf(kind) {
  return EVENT_WORDS[kind] || kind.replace(/_/g, ' ');
}

function isCheck({ kind }) {
  return kind === 'check_failed' || kind === 'check_passed' || kind === 'not_evaluated';
}

class Panels {
  /** `go` takes a tick and, maybe, an actor and a place to look at. */
  constructor(trace, go) {
    Object.assign(this, { trace, go, head: trace.head, rows: [], hidden: new Set() });
    this.showHeader();
    this.showChecks();
    this.showFilters();
    this.showEvents();
    this.showScenario();
    this.showNotes();
  }

  get(id) {
    return document.getElementById(id);
  }

  showHeader() {
    const { head } = this;
    this.get('name').textContent = head.start.name;
    this.get('verdict').textContent = VERDICTS[head.verdict] || head.verdict;
    this.get('verdict').classList.add(...head.verdict.split(/\s+/).filter(Boolean));
    this.get('reason').textContent = head.reason;
    const fact = (key, value) => {
      const item = element('li', `${key} `);
      item.append(element('b', value));
      this.get('facts').append(item);
    };
    fact('town', head.town.name);
    if (head.start.imported) fact('from', head.start.imported);
    else fact('seed', head.start.seed);
    this.weather = this.get('facts').appendChild(element('li', 'weather '));
    this.weather.append(element('b', head.start.weather));
    if (head.start.cars > 0) fact('traffic', `${head.start.cars} cars`);
    fact('length', secondsText(this.trace, this.trace.last - this.trace.first + (head.last >= head.first ? 1 : 0)));
  }

  /** A line of a list that one can go to. */
  row(event, text, mark = '') {
    const item = element('li');
    const button = item.appendChild(element('button', '', { type: 'button' }));
    button.append(element('time', secondsText(this.trace, event.tick)));
    const dot = button.appendChild(element('span', '', { class: 'dot' }));
    dot.style.setProperty('--mark', EVENT_COLOURS[event.kind] || '#6b7077');
    const said = button.appendChild(element('span', '', { class: 'text' }));
    if (mark) said.append(element('span', mark, { class: `${{ check_passed: 'passed', check_failed: 'failed' }[event.kind] || 'open'}-mark` }), ' ');
    said.append(text);
    const more = [];
    if (event.end) more.push(`for ${secondsText(this.trace, event.end - event.tick)}`);
    if (event.worst) more.push(event.worst);
    if (event.line) more.push(`line ${event.line}`);
    if (more.length > 0) said.append(element('small', more.join(' · ')));
    button.addEventListener('click', () => this.go(event));
    return item;
  }

  showChecks() {
    const words = { check_passed: 'passed', check_failed: 'failed', not_evaluated: 'not evaluated' };
    const checks = this.head.events.filter(isCheck);
    this.get('checks-section').hidden = checks.length === 0;
    for (const check of checks.slice(0, MOST_ROWS)) this.get('checks').append(this.row(check, check.text, words[check.kind]));
  }

  showFilters() {
    const words = new Set(this.head.events.filter((event) => !isCheck(event)).map((event) => wordOf(event.kind)));
    if (words.size < 2) return;
    for (const word of words) {
      const button = this.get('filters').appendChild(element('button', word, { type: 'button', 'aria-pressed': 'true' }));
      button.addEventListener('click', () => {
        if (!this.hidden.delete(word)) this.hidden.add(word);
        button.setAttribute('aria-pressed', String(!this.hidden.has(word)));
        this.showEvents();
      });
    }
  }

  /** Events as the filters leave them, failures of checks among them. */
  get events() {
    return this.head.events.filter((event) => (!isCheck(event) || event.kind === 'check_failed') && !this.hidden.has(wordOf(event.kind)));
  }

  showEvents() {
    const list = this.get('events');
    list.replaceChildren();
    const events = this.events;
    this.rows = events.slice(0, MOST_ROWS).map((event) => {
      const text = event.kind === 'check_failed' ? `check failed: ${event.text}` : event.kind === 'finished' ? `ends: ${event.text}` : event.text;
      return { event, item: list.appendChild(this.row(event, text)) };
    });
    if (events.length === 0) list.append(element('li', 'Nothing to tell.', { class: 'none' }));
    if (events.length > MOST_ROWS) list.append(element('li', `and ${events.length - MOST_ROWS} more`, { class: 'none' }));
    this.current = null;
  }

  /** The marks on the slider. */
  marks() {
    return this.head.events
      .filter(({ kind }) => kind !== 'spawned' && kind !== 'despawned' && kind !== 'check_passed')
      .map(({ tick, end, kind }) => ({ tick, end, colour: EVENT_COLOURS[kind] || '#6b7077', strong: kind === 'collision' || kind === 'check_failed' }));
  }

  /** Marks the last event before a time, and says which weather it is. */
  setTime(time) {
    let last = null;
    for (const row of this.rows) {
      if (row.event.tick > time) break;
      last = row;
    }
    if (last !== this.current) {
      if (this.current) this.current.item.firstChild.classList.remove('now');
      if (last) {
        last.item.firstChild.classList.add('now');
        const list = this.get('events');
        const { offsetTop, offsetHeight } = last.item;
        const above = offsetTop - list.offsetTop;
        if (above < list.scrollTop || above + offsetHeight > list.scrollTop + list.clientHeight) list.scrollTop = above - list.clientHeight / 2;
      }
      this.current = last;
    }
    const weather = this.head.weathers.filter((one) => one.tick <= time).pop();
    if (weather && weather !== this.shownWeather) {
      this.shownWeather = weather;
      const grip = weather.friction === 1 ? '' : `, grip ${Number(weather.friction.toFixed(2))}`;
      this.weather.lastChild.textContent = `${weather.name || this.head.start.weather}${grip}`;
    }
  }

  showCard(facts) {
    const said = JSON.stringify(facts);
    if (said === this.cardSaid) return; // most ticks change nothing of it
    this.cardSaid = said;
    const card = this.get('card');
    card.replaceChildren();
    for (const [key, value] of facts) {
      const pair = card.appendChild(element('div'));
      pair.append(element('dt', key), element('dd', value));
    }
  }

  showScenario() {
    const { start } = this.head;
    const settings = this.get('settings');
    const add = (key, value) => settings.append(element('dt', key), element('dd', value));
    if (start.path) add('file', start.path);
    for (const [key, value] of start.settings) add(key, value);
    for (const branch of start.branches) {
      add('branch', `at ${secondsText(this.trace, branch.tick)} ${branch.name} ${branch.source ? 'took over' : 'went on'}`);
      for (const [key, value] of branch.settings) add(key, value);
    }
    add('trace', this.head.trace);
    const sources = [[start.path, start.source], ...start.branches.map(({ path, source }) => [path, source])];
    for (const [path, source] of sources.filter((one) => one[1])) this.addSource(path, source);
  }

  addSource(path, source) {
    const fold = this.get('sources').appendChild(element('details'));
    fold.append(element('summary', `Source of ${path || 'the scenario'}`));
    const text = fold.appendChild(element('pre', '', { tabindex: '0' }));
    // Laid out when somebody looks.
    fold.addEventListener('toggle', () => {
      if (text.childElementCount > 0) return;
      source.split('\n').forEach((line, i) => text.append(element('span', line || ' ', { 'data-line': String(i + 1) })));
      this.markLine(this.saidLine);
    });
  }

  /** Shows which line of the source said what was clicked on. */
  markLine(line) {
    this.saidLine = line;
    for (const marked of document.querySelectorAll('#sources .said')) marked.classList.remove('said');
    const found = line && document.querySelector(`#sources details:last-child pre span:nth-child(${Number(line)})`);
    if (!found) return;
    found.classList.add('said');
    const text = found.parentElement;
    text.scrollTop = found.offsetTop - text.offsetTop - text.clientHeight / 2;
  }

  showNotes() {
    this.get('notes-section').hidden = this.head.notes.length === 0;
    for (const note of this.head.notes) this.get('notes').append(element('li', note));
  }
}
