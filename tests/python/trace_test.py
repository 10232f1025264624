"""What the Python package reads of a trace is what `reprise cat` says: two readers that share no code.

usage: trace_test.py REPRISE WORK
"""
import csv
import io
import pathlib
import subprocess
import sys
import unittest

import numpy as np
import reprise
from reprise.nouns import enum

SPAWN = enum("CommandKind")["spawn"]
PROGRAM, WORK = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))
SOURCE = pathlib.Path(__file__).parents[2]


def call(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


class TraceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        cls.path = WORK / "a.mcap"
        call("run", SOURCE / "scenarios/free_drive.lua", "--for", 8, "-o", cls.path)
        cls.trace = reprise.Trace(cls.path)

    def columns(self, fields):
        table = list(csv.DictReader(io.StringIO(call("cat", self.path, "--fields", fields, "--format", "csv"))))
        number = fields.split(".")[-1] if "." in fields else ""
        return {name.split(" [")[0]: np.array([float(row[name]) for row in table]) for name in table[0]
                if name.split(" [")[0].endswith(number) and table[0][name] != ""}  # fmt: skip

    def test_every_value_of_vehicles_and_cars_is_the_one_that_cat_prints(self):
        for noun, fields in (("vehicles", ("position.x", "velocity.y", "odometer")), ("cars", ("position.z", "yaw", "id"))):
            table = self.trace.table(noun)
            for field in fields:
                ours = table
                for part in field.split("."):
                    ours = ours[part]
                cat = self.columns(f"{noun}.{field}")
                theirs = cat[field.replace(".", "_")]
                np.testing.assert_array_equal(ours, theirs.astype(ours.dtype), err_msg=field)

    def test_ticks_are_found_by_their_index_in_any_order(self):
        self.assertEqual(len(self.trace), 160)
        for index in (160, 1, 64, 65, 128, 2):
            self.assertEqual(self.trace[index].index, index)
        self.assertEqual([tick.index for tick in self.trace], list(range(1, 161)))
        for index in (0, 161):
            self.assertRaises(IndexError, lambda index=index: self.trace[index])

    def test_a_slice_keeps_its_ticks_numbers(self):
        path = WORK / "slice.mcap"
        call("slice", self.path, "--ticks", "70..90", "-o", path)
        part = reprise.Trace(path)
        self.assertEqual((part.first, part.last), (70, 90))
        spawned = {command.actor: command.text for tick in self.trace for command in tick.tick.commands if command.kind == SPAWN}
        self.assertTrue(spawned)
        self.assertEqual({actor: command.text for actor, command in part.spawned_before.items()}, spawned)
        self.assertEqual(self.trace.spawned_before, {})
        self.assertEqual(part[80].tick.vehicles.tobytes(), self.trace[80].tick.vehicles.tobytes())

    def test_outcome_and_scenario_are_those_of_the_run(self):
        self.assertEqual(self.trace.outcome["ticks"], "160")
        self.assertEqual(self.trace.scenario, (SOURCE / "scenarios/free_drive.lua").read_text())
        self.assertEqual(self.trace.town.name, "town1")

    def test_pandas_columns_say_their_units(self):
        frame = self.trace.to_pandas("measurements")
        self.assertEqual(len(frame), 160)
        np.testing.assert_array_equal(frame["speed [m/s]"], self.trace.table("measurements")["speed"])
        np.testing.assert_allclose(frame["time [s]"], frame["tick"] * 0.05)

    def test_pandas_tables_are_those_of_cat(self):
        import io

        import pandas

        for noun in ("measurements", "cars", "vehicles", "lanes", "actors"):
            said = call("cat", self.path, "--format", "csv", "--fields", noun)
            table = pandas.read_csv(io.StringIO(said), keep_default_na=True)
            frame = self.trace.to_pandas(noun)
            self.assertEqual(len(frame), len(table), noun)
            for column in ("name", "model_name", "lane_name", "kind", "left", "junction", "length [m]", "front_s [m]", "rear_axle_s [m]",
                           "spawned [s]"):  # fmt: skip
                if column in table and table[column].notna().any():
                    mine = frame[column]
                    there = table[column].notna()
                    self.assertEqual(mine.notna().tolist(), there.tolist(), f"{noun}.{column}")
                    if table[column].dtype == object:
                        self.assertEqual(mine[there].tolist(), table[column][there].tolist(), f"{noun}.{column}")
                    else:
                        np.testing.assert_allclose(mine[there].astype(float), table[column][there], atol=1e-6)

    def test_what_is_no_trace_is_told(self):
        path = WORK / "no.mcap"
        path.write_bytes(b"\x89MCAP0\r\n")
        self.assertRaisesRegex(reprise.TraceError, "no trace of Reprise", reprise.Trace, path)
        path.write_text("something else")
        self.assertRaisesRegex(reprise.TraceError, "no trace", reprise.Trace, path)

    def test_traffic_that_was_stripped_is_told(self):
        path = WORK / "core.mcap"
        call("strip", self.path, "--level", "core", "-o", path)
        core = reprise.Trace(path)
        self.assertEqual(core[5].tick.vehicles.tobytes(), self.trace[5].tick.vehicles.tobytes())
        self.assertRaisesRegex(reprise.TraceError, "expand", core.table, "cars")


if __name__ == "__main__":
    unittest.main()
