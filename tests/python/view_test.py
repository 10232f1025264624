"""Pictures from above are self-contained, and show who is where the trace says.

usage: view_test.py REPRISE WORK
"""
import html
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import numpy as np
import reprise

PROGRAM, WORK = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))
SOURCE = pathlib.Path(__file__).parents[2]
os.environ["REPRISE"] = PROGRAM
EGO = "#e8572a"


def figures(svg):
    """(x, y, yaw [deg], colour) of each vehicle and walker in the picture, in the world's frame."""
    found = re.findall(r'<g fill="(#\w+)" transform="translate\(([-\d.]+) ([-\d.]+)\) rotate\(([-\d.]+)\)">', svg)
    return [(float(x), -float(y), -float(yaw), colour) for colour, x, y, yaw in found]


class Views(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        cls.path = WORK / "a.mcap"
        subprocess.run([PROGRAM, "run", SOURCE / "scenarios/free_drive.lua", "--for", "5", "-o", cls.path], check=True,
                       capture_output=True)  # fmt: skip
        cls.trace = reprise.Trace(cls.path)

    def test_of_a_simulation_has_the_driven_vehicle_in_the_middle_and_others_around(self):
        with reprise.Simulation("town1", cars=60, seed=7) as sim:
            with self.assertRaisesRegex(RuntimeError, "no episode runs"):
                sim.show()
            seen = sim.reset()
            for _ in range(20):
                seen = sim.step(throttle=0.5)
            view, whole = sim.show(radius=50), seen.show(radius=None)
        self.assertEqual(view.svg, view._repr_html_(), "a notebook needs no script for it")
        ego = [one for one in figures(view.svg) if one[3] == EGO]
        self.assertEqual(len(ego), 1)
        np.testing.assert_allclose(ego[0][:2], seen.ego.position[:2], atol=0.01)
        self.assertAlmostEqual(ego[0][2], np.degrees(seen.ego.yaw), delta=0.1)
        west, north, width, height = map(float, re.search(r'viewBox="([^"]*)"', view.svg)[1].split())
        np.testing.assert_allclose([west + width / 2, -north - height / 2], seen.ego.position[:2], atol=0.1)
        self.assertEqual(len(figures(whole.svg)), len(seen.cars) + 1)
        self.assertLess(len(figures(view.svg)), len(figures(whole.svg)))
        self.assertLess(len(view.svg), len(whole.svg) / 2, "what is not seen is not there")

    def test_the_page_is_that_of_reprise_show(self):
        page = self.trace.page(10, 20, reprise=PROGRAM).save(WORK / "page.html").read_text()
        subprocess.run([PROGRAM, "show", self.path, "--ticks", "10..20", "-o", WORK / "shown.html"], check=True, capture_output=True)
        self.assertEqual(page, (WORK / "shown.html").read_text())
        with self.assertRaisesRegex(reprise.TraceError, "--ticks 900..: no such ticks"):
            self.trace.page(900, reprise=PROGRAM)

    def test_of_a_trace_moves_everybody_to_where_the_ticks_have_them(self):
        view = self.trace.show(every=7)
        page = view.save(WORK / "replay.html").read_text()
        data = json.loads(re.search(r'id="data">(.*?)</script>', page)[1])
        indices = range(1, 101, 7)
        self.assertEqual(len(data["frames"]), len(indices))
        self.assertAlmostEqual(data["seconds"], 0.35)
        names = [signal.program for signal in self.trace.town.signals]
        self.assertEqual(len(re.search(r'<g class="signals">(.*?)</g>', page)[1].split(" fill=")) - 1, len(names))
        colours = None
        for index, frame in zip(indices, data["frames"]):
            tick = self.trace[index]
            there = np.array(frame["actors"]).reshape(-1, 4)
            places = np.concatenate([tick.traffic.cars["position"], tick.traffic.walkers["position"], tick.tick.vehicles["position"]])
            np.testing.assert_allclose(there[:, 1], places["x"], atol=0.006)
            np.testing.assert_allclose(-there[:, 2], places["y"], atol=0.006)
            np.testing.assert_allclose(frame["at"], [places["x"][-1], -places["y"][-1]], atol=0.006)
            colours = frame["signals"] or colours
            self.assertEqual(colours, "".join(map(str, tick.tick.signals)))
        self.assertEqual(len(set(there[:, 0])), len(there))

    def test_pages_are_whole_and_ask_nobody_else_for_anything(self):
        for view in (self.trace.show(), self.trace[50].show()):
            for name in ("a.html", "a.svg"):
                text = view.save(WORK / name).read_text()
                self.assertEqual(re.findall(r'(?:src|href|url|@import)\W+\w+:', text.replace("xmlns=", "")), [])
            xml.etree.ElementTree.parse(WORK / "a.svg")
            self.assertIn("save(", repr(view))
        frame = self.trace.show(1, 10)._repr_html_()
        self.assertTrue(frame.startswith("<iframe srcdoc="))
        inner = html.unescape(re.search(r'srcdoc="([^"]*)"', frame)[1])
        self.assertEqual(inner, self.trace.show(1, 10).save(WORK / "b.html").read_text())

    def test_ticks_that_are_not_there_are_told(self):
        with self.assertRaisesRegex(ValueError, "expected ticks from 1 to 100"):
            self.trace.show(200)
        with self.assertRaisesRegex(ValueError, "every=0"):
            self.trace.show(every=0)

    def test_a_trace_without_its_traffic_shows_who_has_mass(self):
        subprocess.run([PROGRAM, "strip", self.path, "--level", "core", "-o", WORK / "core.mcap"], check=True, capture_output=True)
        core = reprise.Trace(WORK / "core.mcap")
        self.assertEqual(len(figures(core[20].show().svg)), len(core[20].tick.vehicles))


if __name__ == "__main__":
    unittest.main()
