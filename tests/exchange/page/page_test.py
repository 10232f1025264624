"""The page of `reprise show` in a real browser: it shows what the trace has, asks for nothing, and obeys no name.

usage: page_test.py REPRISE WORK
"""
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

import numpy as np
import reprise
from browser import Browser

PROGRAM, WORK = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1)).resolve()
SOURCE = pathlib.Path(__file__).parents[3]
os.environ["REPRISE"] = PROGRAM

# Whoever runs any of this has set window.hacked; what is not run is shown as it is.
HOSTILE = "</script><script>window.hacked=1</script>\"'><img src=x onerror=window.hacked=1>&amp;<!--"
HOSTILE_RUN = """
return scenario 'hostile' { town = 'town1', duration = 4, cars = 3, seed = 5, params = { word = '' }, run = function(p)
    local name = '%s'
    local ego = spawn{ name = name, model = 'taxi' }
    check.never('never ' .. name, function() return false end)
    check.always('always ' .. name, function() return time() < 1 end)
    print(name, '\\27[31m', '\\226\\128\\174', '{{data}}')
    wait(2)
    finish(name)
end } -- </pre>%s
""" % (HOSTILE.replace("'", "\\'"), HOSTILE)
DRIVE = """
return scenario 'drive' { town = 'town1', duration = 30, cars = 40, seed = 3, run = function()
    local lane = pick_lane{ length = 80, right = false }
    spawn{ name = 'ego', model = 'sedan', lane = lane, s = 10, speed_kmh = 30 }
    spawn{ name = 'bike', model = 'bicycle', lane = lane, s = 40, speed_kmh = 15 }
    spawn{ name = 'van', model = 'van', driver = 'parked', lane = lane, s = 70, offset = -2 }
    local child = spawn{ name = 'child', model = 'child', lane = lane, s = 60, offset = -3 }
    child:walk_to{ across = lane, speed = 1 }
    wait(10)
end }
"""
CRASH = """
return scenario 'crash' { town = 'straight', duration = 4, run = function()
    local hit = spawn{ name = 'hit', model = 'van', driver = 'traffic', lane = 'east_1', s = 160, speed = 5 }
    hit:hold_speed(5)
    local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual', lane = 'east_1', s = 140, speed = 15 }
    ego:control{}
    wait(60)
end }
"""


def run(*words, code=0):
    done = subprocess.run([PROGRAM, *map(str, words)], cwd=WORK, capture_output=True, text=True)
    assert done.returncode == code, f"{words}: {done.returncode}: {done.stderr}{done.stdout}"
    return done.stderr + done.stdout


def recorded(name, text, *more):
    """Path of the trace of a scenario."""
    (WORK / f"{name}.lua").write_text(text)
    run("run", f"{name}.lua", "-o", f"{name}.mcap", *more, code=1 if name == "hostile" else 0)
    return WORK / f"{name}.mcap"


def shown(trace, *more):
    """Address of its page."""
    page = WORK / f"{pathlib.Path(trace).stem}.html"
    run("show", trace, "-o", page, *more)
    return page.as_uri()


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        cls.drive = recorded("drive", DRIVE)
        cls.browser = Browser(WORK)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def opened(self, address):
        self.browser.complaints.clear()
        self.browser.requests.clear()
        self.browser.open(address)

    def assert_quiet(self, address):
        self.assertEqual(self.browser.complaints, [])
        own = [url for url in self.browser.requests if not url.startswith("data:image/svg")]
        self.assertEqual(own, [address], "nothing but the file itself is asked for")

    def value(self, expression):
        return self.browser.evaluate(expression)

    def drawn(self, tick):
        seen = self.value(f"replay.drawnAt({tick})")
        return {one["id"]: one for one in seen["actors"]}, seen["signals"]

    def assert_as_recorded(self, trace, index, actors, signals):
        tick = trace[index]
        self.assertEqual(signals, tick.tick.signals.tolist())
        own = {one["id"]: one for records in (tick.tick.vehicles, tick.traffic.cars, tick.traffic.walkers) for one in records}
        self.assertEqual(set(actors), {int(actor) for actor in own})
        for actor, state in own.items():
            at, position = actors[int(actor)], state["position"]
            np.testing.assert_allclose((at["x"], at["y"]), (position["x"], position["y"]), atol=0.0051)
            if "yaw" in state.dtype.names:
                self.assertLess(abs((at["yaw"] - float(state["yaw"]) + np.pi) % (2 * np.pi) - np.pi), 0.001)
                self.assertAlmostEqual(at["speed"], float(state["speed"]), delta=0.0051)
            else:
                turned = state["orientation"]
                ahead = np.array([1 - 2 * (turned["y"] ** 2 + turned["z"] ** 2), 2 * (turned["w"] * turned["z"] + turned["x"] * turned["y"])])
                np.testing.assert_allclose([np.cos(at["yaw"]), np.sin(at["yaw"])], ahead / np.hypot(*ahead), atol=0.001)

    def test_everybody_is_drawn_where_the_trace_has_them(self):
        address = shown(self.drive)
        self.opened(address)
        trace = reprise.Trace(self.drive)
        for index in (1, 2, 57, 133, len(trace)):
            actors, signals = self.drawn(index)
            self.assertGreater(len(actors), 30)
            self.assert_as_recorded(trace, index, actors, signals)
        names = {one["name"] for one in actors.values()}
        self.assertLessEqual({"ego", "bike", "van", "child"}, names)
        self.assert_quiet(address)

    def test_between_drawn_ticks_everybody_is_near_where_they_were(self):
        self.opened(shown(self.drive, "--every", "10"))
        trace = reprise.Trace(self.drive)
        self.assertIn("one tick in 10", self.value("document.getElementById('notes').textContent"))
        for index in (1, 101, len(trace)):  # taken, as is the last one
            self.assert_as_recorded(trace, index, *self.drawn(index))
        actors, signals = self.drawn(107)
        tick = trace[107]
        self.assertEqual(signals, tick.tick.signals.tolist(), "colours change when they do")
        for car in tick.traffic.cars:
            at = actors[int(car["id"])]
            self.assertLess(np.hypot(at["x"] - car["position"]["x"], at["y"] - car["position"]["y"]), 0.25)

    def test_who_is_hit_is_one_actor_before_and_after(self):
        trace = recorded("crash", CRASH)
        self.opened(shown(trace))
        whole = reprise.Trace(trace)
        options = "[...document.getElementById('actor').options].map((one) => one.text)"
        self.assertEqual(self.value(options).count("hit"), 1)
        number = next(number for number, name in whole.names.items() if name == "hit")
        ticks = self.value(f"seriesOf(replay.app.trace, {number}).ticks")
        self.assertEqual(ticks, list(range(1, len(whole) + 1)), "its curves run through, in the order of time")
        cards = []
        for tick in (10, len(whole)):
            self.value(f"(() => {{ const {{ app }} = replay; app.choose(app.trace.byActor.get({number})[0]); "
                       f"replay.drawnAt({tick}); app.showCard(); }})()")  # fmt: skip
            cards.append(self.value("document.getElementById('card').innerText"))
        self.assertIn("traffic", cards[0])
        self.assertIn("a wreck", cards[1])
        self.assertIn("hit is hit at", self.value("document.getElementById('events').innerText"))

    def test_the_gap_of_cars_is_measured_as_the_kernel_measures_that_of_vehicles(self):
        self.opened(shown(self.drive))
        gaps = self.value("(() => { const t = replay.app.trace, ego = t.tracks.find((one) => one.name === 'ego');"
                          "return [...gapsOf(t, ego)].map((gap, i) => [gap, recordedGaps(t, ego)[i]]); })()")  # fmt: skip
        gaps = np.array(gaps)
        self.assertTrue((gaps[:, 1] < 100).any(), "somebody is ahead")
        near = gaps[:, 1] < 99
        apart = np.abs(gaps[near, 0] - gaps[near, 1])
        # A box that only just reaches into the corridor may be out of it when rounded to centimetres.
        self.assertLess(np.quantile(apart, 0.95), 0.05, f"{apart.max()} in {len(apart)} ticks")

    def test_no_name_or_text_is_obeyed(self):
        address = shown(recorded("hostile", HOSTILE_RUN, "--set", "word='</script><b>'"))
        page = (WORK / "hostile.html").read_text()
        self.assertNotIn("hacked", page, "what a trace says is pressed, and no markup")
        self.opened(address)
        self.value("(() => { const app = replay.app; for (let t = app.trace.first; t <= app.trace.last; ++t) replay.drawnAt(t); "
                   "document.querySelectorAll('details').forEach((one) => { one.open = true; }); "
                   "document.querySelectorAll('.list button').forEach((one) => one.click()); })()")  # fmt: skip
        self.value("new Promise((done) => setTimeout(done, 50))")
        self.assertIsNone(self.value("window.hacked"))
        self.assertEqual(self.value("document.images.length"), 0)
        self.assertEqual(self.value("document.querySelectorAll('script').length"), page.count("<script>"))
        said = self.value("document.body.innerText")
        self.assertIn(HOSTILE, said)
        self.assertIn("\\x1b[31m", said, "control characters are written out")
        self.assertNotIn("\u202e", said, "nothing turns the direction of writing")
        self.assertIn(f"-- </pre>{HOSTILE}", self.value("document.querySelector('pre').textContent"))
        self.assert_quiet(address)

    def test_a_script_that_came_in_would_not_run(self):
        self.opened(shown(self.drive))
        self.value("document.body.append(Object.assign(document.createElement('script'), { textContent: 'window.hacked = 1' }))")
        self.assertIsNone(self.value("window.hacked"))
        self.assertIn("Content Security Policy", " ".join(self.browser.complaints))

    def test_keys_and_buttons_move_the_one_clock(self):
        self.opened(shown(self.drive))
        last = len(reprise.Trace(self.drive))
        clock = "document.getElementById('clock').innerText.replace(/\\s+/g, ' ')"
        self.assertEqual(self.value(clock), f"0.05 s tick 1 of {last}")
        self.browser.press(".")
        self.assertEqual(self.value(clock), f"0.10 s tick 2 of {last}")
        self.browser.press("ArrowRight")
        self.assertEqual(self.value(clock), f"1.10 s tick 22 of {last}")
        self.browser.press(",")
        self.assertEqual(self.value(clock), f"1.05 s tick 21 of {last}")
        self.browser.press("End")
        self.assertEqual(self.value(clock), f"{last * 0.05:.2f} s tick {last} of {last}")
        self.browser.press("Home")
        self.browser.press(" ")
        self.value("new Promise((done) => { const wait = () => replay.app.timeline.time > 3 ? done() : setTimeout(wait, 20); wait(); })")
        self.assertTrue(self.value("replay.app.timeline.playing"))
        self.browser.press(" ")
        self.assertFalse(self.value("replay.app.timeline.playing"))
        self.assertEqual(self.value("replay.app.timeline.time % 1"), 0, "what stands still is what was recorded")
        self.value("document.querySelector('#events li:last-child button').click()")
        self.assertEqual(self.value(clock), f"{last * 0.05:.2f} s tick {last} of {last}")

    def test_a_click_on_an_actor_follows_it(self):
        self.opened(shown(self.drive))
        self.value("replay.app.fit(), replay.drawnAt(40)")
        left, top = self.value("(() => { const { view, actors } = replay.app, van = actors.drawn.find(({ track }) => track.name === 'van'),"
                               "box = view.canvas.getBoundingClientRect(), [x, y] = view.toScreen(van.x, van.y);"
                               "return [box.left + x, box.top + y]; })()")  # fmt: skip
        self.browser.click(left, top)
        self.assertEqual(self.value("document.getElementById('actor').selectedOptions[0].text"), "van")
        self.assertEqual(self.value("document.getElementById('follow').getAttribute('aria-pressed')"), "true")

    def test_every_kind_of_trace_is_shown_and_says_what_it_lacks(self):
        for level, said in (("core", "Traffic and walkers were stripped"), ("keyed", "once in 20 ticks")):
            run("strip", self.drive, "--level", level, "-o", f"{level}.mcap")
            self.opened(shown(WORK / f"{level}.mcap"))
            self.assertIn(said, self.value("document.getElementById('notes').innerText"))
            self.assertIn("ego", [one["name"] for one in self.drawn(61)[0].values()])
            self.assertEqual(self.browser.complaints, [])
        self.assert_as_recorded(reprise.Trace(self.drive), 61, *self.drawn(61))  # keyed: a tick that was kept
        run("slice", self.drive, "--ticks", "41..100", "-o", "part.mcap")
        self.opened(shown(WORK / "part.mcap"))
        self.assertIn("ticks 41 to 100", self.value("document.getElementById('notes').innerText"))
        self.assert_as_recorded(reprise.Trace(self.drive), 41, *self.drawn(41))
        (WORK / "cut.mcap").write_bytes(self.drive.read_bytes()[:-self.drive.stat().st_size // 3])
        run("recover", "cut.mcap", "-o", "saved.mcap", code=3)
        self.opened(shown(WORK / "saved.mcap"))
        self.assertEqual(self.value("document.getElementById('verdict').textContent"), "cut off")
        (WORK / "other.lua").write_text("return scenario 'other' { run = function() wait(1) end }")
        run("branch", self.drive, "--at", "5s", "--script", "other.lua", "-o", "branch.mcap")
        self.opened(shown(WORK / "branch.mcap"))
        self.assertIn("at 5.00 s other took over", self.value("document.getElementById('settings').innerText"))
        self.assertEqual(self.value("document.querySelectorAll('#sources summary').length"), 2)
        subprocess.run(["/usr/bin/python3", SOURCE / "tests/exchange/make_carla_log.py", WORK / "carla.log", "--seconds", "5"], check=True)
        run("import", "carla.log", "-o", "carla.mcap")
        self.opened(shown(WORK / "carla.mcap"))
        self.assertIn("poses only", self.value("document.getElementById('notes').innerText"))
        self.assertGreater(len(self.drawn(10)[0]), 0)
        self.assertEqual(self.browser.complaints, [])

    def test_inputs_alone_are_refused_and_nothing_is_left(self):
        run("strip", self.drive, "--level", "inputs", "-o", "inputs.mcap")
        said = run("show", "inputs.mcap", code=2)
        self.assertRegex(said, r"^reprise: inputs\.mcap holds inputs only; `reprise expand .*\n$")
        self.assertFalse((WORK / "inputs.html").exists())

    def test_without_a_name_it_lies_beside_the_trace(self):
        (WORK / "beside").mkdir()
        shutil.copy(self.drive, WORK / "beside" / "a.mcap")
        self.assertRegex(run("show", "beside/a.mcap"), r"^beside/a\.html: \d+ ticks, \d\.\d MB")
        self.assertTrue((WORK / "beside" / "a.html").exists())

    def test_on_a_phone_nothing_is_wider_than_the_screen(self):
        self.browser.size(360, 740, 2, True)
        try:
            self.opened(shown(self.drive))
            self.assertLessEqual(self.value("document.documentElement.scrollWidth"), 360)
            self.assertGreater(self.value("document.getElementById('map').clientHeight"), 250)
        finally:
            self.browser.size(1280, 800)

    def test_buttons_have_names_and_texts_have_contrast(self):
        self.opened(shown(self.drive))
        nameless = self.value("[...document.querySelectorAll('button, select, input')].filter((one) => "
                              "!(one.getAttribute('aria-label') || one.innerText || one.labels?.length)).map((one) => one.outerHTML)")  # fmt: skip
        self.assertEqual(nameless, [])
        for theme in ("light", "dark"):
            self.value(f"replay.app.setTheme('{theme}')")
            colours = {name: self.value(f"getComputedStyle(document.documentElement).getPropertyValue('--{name}').trim()")
                       for name in ("text", "soft", "good", "bad", "warn", "panel", "ground", "accent", "accent-text")}  # fmt: skip
            for front, back in (("text", "panel"), ("soft", "panel"), ("soft", "ground"), ("good", "panel"), ("bad", "panel"),
                                ("warn", "panel"), ("accent-text", "accent")):  # fmt: skip
                self.assertGreaterEqual(contrast(colours[front], colours[back]), 4.5, f"{theme}: {front} on {back}")

    def test_ten_minutes_among_a_hundred_cars_are_small_and_open_quickly(self):
        text = DRIVE.replace("duration = 30, cars = 40", "duration = 600, cars = 100").replace("wait(10)", "wait(600)")
        page = pathlib.Path(shown(recorded("long", text))[len("file://"):])
        self.assertLess(page.stat().st_size, 10e6)
        # A browser of its own: no process of it may use more than a minute of a processor.
        with Browser(WORK / "long", cpu_seconds=60) as browser:
            browser.open(page.as_uri())
            self.assertEqual(browser.complaints, [])
            last = browser.evaluate("replay.app.trace.last")
            self.assertEqual(last, 12000)
            browser.evaluate("(() => { const { app } = replay; app.fit(); for (let t = 1; t < 12000; t += 97) replay.drawnAt(t); })()")
            seen = browser.evaluate("replay.drawnAt(9001)")
        cars = {int(car["id"]) for car in reprise.Trace(WORK / "long.mcap")[9001].traffic.cars}
        self.assertLessEqual(cars, {one["id"] for one in seen["actors"]})


def contrast(front, back):
    """As WCAG 2.1 defines it, of colours like #1c2127."""
    def luminance(colour):
        parts = np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)]) / 255
        linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
        return float(linear @ [0.2126, 0.7152, 0.0722])

    light, dark = sorted((luminance(front), luminance(back)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


if __name__ == "__main__":
    if not (shutil.which("chromium") or shutil.which("chromium-browser")):
        print("no chromium: skipped")
        sys.exit(77)
    unittest.main(verbosity=2)
