"""What a driver's author is told who made a mistake: the run's one line names it, the tick and the place in his code.

usage: driver_test.py REPRISE WORK
"""
import itertools
import os
import pathlib
import socket
import struct
import subprocess
import sys
import threading
import unittest
import unittest.mock

import numpy as np
import reprise
from reprise.nouns import Noun
from reprise.packing import pack
from reprise.schema import ENUMS
from reprise import wire as wire_module
from reprise.wire import Wire

PROGRAM, WORK = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))
SOURCE = pathlib.Path(__file__).parents[2]
SCENARIO = """return scenario 'one' { town = 'small.net.xml', cars = 0, seed = 11, duration = 1,
    run = function() spawn{ name = 'ego', model = 'sedan', driver = 'external', lane = 'am_1', s = 20 } wait(60) end }
"""
# What stands in the driver's third line, asked in tick 5 -> what the run says; None: nothing, as it may be done.
MISTAKES = {
    "raise RuntimeError('my own')": r"RuntimeError in tick 5: my own \(driver.py:4\)",
    "raise RuntimeError('one\\ntwo \\udcff')": r"RuntimeError in tick 5: one\\ntwo \\udcff \(driver.py:4\)",
    "return None": r"TypeError in tick 5: a driver returns a reprise.Control, not None \(is a `return` missing\?\)",
    "return {'throttle': 0.4}": r"TypeError in tick 5: a driver returns a reprise.Control, not \{.*\(reprise.Control\(\*\*values\)",
    "return reprise.Control(throttle=2)": r"ValueError in tick 5: Control\(throttle=2\): expected a number in \[0, 1\] \(driver.py:4\)",
    "return reprise.Control(throttle=seen.ego.sped)": r"AttributeError in tick 5: no 'sped': .*\(driver.py:4\)",
    "sys.exit('no model')": r"it called sys.exit\('no model'\) in tick 5",
    "sys.exit()": r"it called sys.exit\(\) in tick 5",
    "os.kill(os.getpid(), signal.SIGINT); time.sleep(9)": r"it was interrupted \(Ctrl-C\) in tick 5",
    "return reprise.Control(throttle=np.float32(0.4), steer=np.array([0.1])[0])": None,
    "print('what I print', seen.index)": None,
}


class Mistakes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        (WORK / "one.lua").write_text(SCENARIO)
        (WORK / "small.net.xml").write_bytes((SOURCE / "tests/cli/crash/small.net.xml").read_bytes())

    def drive(self, line):
        (WORK / "driver.py").write_text(
            "import os, signal, sys, time, numpy as np, reprise\n"
            "def decide(seen):\n"
            "    if seen.index == 5:\n"
            f"        {line}\n"
            "    return reprise.Control(throttle=0.3)\n"
            "reprise.drive(decide)\n"
        )
        command = [PROGRAM, "run", "one.lua", "-o", "a.mcap", "--driver", f"ego={sys.executable} -B driver.py"]
        return subprocess.run(command, cwd=WORK, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              timeout=60)  # fmt: skip

    def test_are_told_once_with_their_tick(self):
        for line, told in MISTAKES.items():
            with self.subTest(line):
                done = self.drive(line)
                self.assertEqual(done.returncode, 0 if told is None else 1, done.stdout)
                ours = [one for one in done.stdout.splitlines() if one.startswith("reprise: ")]
                if told is None:
                    self.assertEqual(ours, [])
                else:
                    self.assertEqual(len(ours), 1, done.stdout)
                    self.assertRegex(ours[0], f"^reprise: the driver of 'ego' left: {told}")

    def test_in_who_starts_a_driver_in_turn_are_told(self):
        for place in ("fd:987", "fd:none"):
            with self.assertRaisesRegex(reprise.WireError, f"{place}: is no open socket; .*close_fds=False"):
                reprise.drive(lambda seen: reprise.Control(), place)

    def test_what_a_driver_prints_is_seen(self):
        self.assertIn("what I print 5\n", self.drive("print('what I print', seen.index)").stdout)

    def test_in_a_control_are_told_when_it_is_made(self):
        for wrong in (dict(throttle=-0.1), dict(brake=1.01), dict(steer=-1.5), dict(steer=float("nan")), dict(throttle="1"),
                      dict(throttle=np.zeros(2)), dict(brake=None), dict(lamps=-1), dict(lamps=65536), dict(lamps=1.0),
                      dict(hand_brake="no"), dict(reverse=5), dict(reverse=None)):  # fmt: skip
            with self.assertRaisesRegex(ValueError, rf"^Control\({next(iter(wrong))}=.*expected .* in \["):
                reprise.Control(**wrong)
        reprise.Control(throttle=True, brake=np.float32(1), steer=-1, lamps=np.uint16(65535), reverse=np.bool_(True), hand_brake=1)

    def test_a_control_says_what_a_built_one_says(self):
        for value in (dict(tick=9, throttle=0.25, brake=0.5, steer=-1.0, hand_brake=True, reverse=True, lamps=0xFFFF),
                      dict(tick=0, throttle=0.0, brake=0.0, steer=0.0, hand_brake=False, reverse=False, lamps=0)):  # fmt: skip
            ours, theirs = socket.socketpair()
            with theirs, ours:
                Wire(ours).control(**value)
                size, kind = struct.unpack("<II", theirs.recv(8))
                body = theirs.recv(1000)
            self.assertEqual((size, kind), (len(body), ENUMS["remote.Kind"][1]["control"]))
            if value["tick"]:  # a builder leaves zeros out, where we say them
                self.assertEqual(body, bytes(pack("remote.Control", value)))
            said = Noun(body, "remote.Control")
            self.assertEqual({name: getattr(said, name) for name in value}, value)

    def test_waiting_asleep_and_awake_hear_the_same(self):
        for polling in (0.0, 10.0):
            ours, theirs = socket.socketpair()
            with theirs, ours, self.subTest(polling):
                wire = Wire(ours, polling)
                Wire(theirs).say("fault", text="before it waits")
                saying = threading.Timer(0.01, Wire(theirs).say, ("fault",), dict(text="while it waits"))
                saying.start()
                for text in ("before it waits", "while it waits"):
                    self.assertEqual(wire.receive()[1].text, text)
                saying.join()
                theirs.close()
                with self.assertRaisesRegex(reprise.WireError, "hung up"):
                    wire.receive()

    def test_polling_leaves_the_processor_to_who_wants_it_longer_and_longer(self):
        ours, theirs = socket.socketpair()
        with theirs, ours, unittest.mock.patch.multiple(wire_module, _processors=lambda: 2):
            waiting = wire_module._Awaiting(ours, 3600.0)
            theirs.send(b"x")  # it is there whenever the waits look

            def polled(waits, share):
                looks = 0
                for _ in range(waits):
                    found = iter((False, True, True))  # at the second look of who polls, at the first of who sleeps
                    calls = []
                    waiting._poll = lambda timeout=None: calls.append(timeout) or timeout is None or next(found)
                    seconds = itertools.count()
                    with unittest.mock.patch.multiple(wire_module.time, monotonic=lambda: next(seconds) * 1.0,
                                                      thread_time=lambda: next(seconds) * share):  # fmt: skip
                        waiting()
                    looks += calls[0] == 0
                return looks

            for asleep in (16, 32, 64, 128, 256, 512, 1024, 1024):
                self.assertEqual((polled(8, 0.1), polled(asleep, 0.1)), (8, 0))
            self.assertEqual((polled(64, 1), polled(8, 0.1), polled(16, 0.1), polled(1, 1)), (64, 8, 0, 1))

    def test_in_what_an_episode_starts_from_are_told_and_the_simulation_lives_on(self):
        wrong = (dict(cars=1.5), dict(cars="many"), dict(seed=-1), dict(seed=1 << 64), dict(seed="7"), dict(walkers=-1),
                 dict(weather=5), dict(weather={"rain": 5}), dict(town=5), dict(model=5), dict(seconds="long"),
                 dict(rig=[dict(name="front", width=0.5)]), dict(rig=[dict(name=5)]))  # fmt: skip
        os.environ["REPRISE"] = PROGRAM
        with reprise.Simulation("straight", seconds=0.1) as sim:
            for each in wrong:
                with self.subTest(each), self.assertRaisesRegex(ValueError, "expected"):
                    sim.reset(**each)
            with self.assertRaisesRegex(reprise.Fault, "no town"):
                sim.reset(town="nowhere")
            with self.assertRaises(FileNotFoundError):
                sim.reset(scenario="no/such.lua")
            self.assertEqual(sim.reset(cars=np.int64(0), seed=7.0).index, 1)


if __name__ == "__main__":
    unittest.main()
