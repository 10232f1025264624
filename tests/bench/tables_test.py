#!/usr/bin/env python3
"""README.md's figures have the shape that ./dev bench --tables writes, and nothing there is typed by hand."""
import re
import sys
import unittest
from pathlib import Path

import figures
import tables

README = (tables.ROOT / "README.md").read_text()
NUMBER = re.compile(r"(?:(?<=\| )-)?\d[\d,]*(\.\d+)?")  # less than nothing: what a driver adds, on a noisy day


def shape(text):
    return NUMBER.sub("N", text)


class AnyValue(dict):
    """Every value was measured, and is one."""

    def get(self, name, default=None):
        return default if name == "machine" else 1


def names_asked_for():
    return figures.rewritten(README, {})[1]


class ReadmeFigures(unittest.TestCase):
    def test_have_the_shape_that_the_script_makes(self):
        made = dict(figures.blocks_of(figures.rewritten(README, AnyValue())[0]))
        for name, text in figures.blocks_of(README):
            with self.subTest(block=name):
                if name == "machine":
                    self.assertRegex(text, r"^Measured at .+\.$")
                else:
                    self.assertEqual(shape(text), shape(made[name]))

    def test_are_all_inside_of_blocks(self):
        by_hand = figures.A_BLOCK.sub("", figures.section(README).group(1))
        self.assertIsNone(re.search(r"\d", by_hand), f"a number typed by hand: {by_hand}")

    def test_are_the_only_thing_that_is_rewritten(self):
        text, _ = figures.rewritten(README, AnyValue())
        section = figures.section
        for side in (lambda t: t[:section(t).start(1)], lambda t: t[section(t).end(1):],
                     lambda t: figures.A_BLOCK.sub("", section(t).group(1))):
            self.assertEqual(side(text), side(README))

    def test_that_were_not_measured_are_named_and_visible(self):
        text, missing = figures.rewritten(README, {"machine": "commit x on y"})
        self.assertIn("Tick/100.of_bare", missing)
        self.assertEqual(text.count(figures.NOT_MEASURED), len(missing))

    def test_need_all_blocks_in_order(self):
        with self.assertRaisesRegex(SystemExit, "expected machine, ticks"):
            figures.rewritten(README.replace("<!-- figures: ticks -->", ""), {})


class Benchmarks(unittest.TestCase):
    def test_count_by_the_median_of_their_repetitions(self):
        runs = [{"run_name": "Tick/100/iterations:1/manual_time", "run_type": "iteration", "real_time": time,
                 "cpu_time": time, "time_unit": "us", "of_bare": ratio}
                for time, ratio in ((300, 1.3), (100, 1.1), (200, 1.2))]
        aggregate = dict(runs[0], run_type="aggregate", of_bare=9)
        values = tables.values_of_benchmarks({"benchmarks": [*runs, aggregate]})
        self.assertEqual(values["Tick/100.of_bare"], 1.2)
        self.assertAlmostEqual(values["Tick/100.real_ms"], 0.2)

    def test_have_the_names_that_the_figures_ask_for(self):
        sources = [path.read_text() for path in Path(__file__).parent.glob("*_bench.*")]
        for name in names_asked_for():
            benchmark, _, counter = name.rpartition(".")
            if re.match(r"reprise |level |ten minutes", benchmark):
                continue  # measured by tables.py itself
            with self.subTest(value=name):
                kind, _, case = benchmark.partition("/")
                registered = rf"BENCHMARK\({kind}\)|\"{kind}\": |BENCHMARK_CAPTURE\({kind},\s+{case},"
                source = next((text for text in sources if re.search(registered, text)), None)
                self.assertIsNotNone(source)
                if counter not in ("real_ms", "cpu_ms", "of_normal"):
                    self.assertIn(f'"{counter}"', source)


if __name__ == "__main__":
    sys.exit(unittest.main())
