"""What `reprise serve` and reprise.Simulation promise. The variable REPRISE names the program."""
import os
import pathlib
import re
import select
import signal
import socket
import stat
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

import numpy as np
import reprise
from reprise.wire import Wire, WireError

PROGRAM = os.environ["REPRISE"]
HERE = pathlib.Path(__file__).resolve().parent
DRIVEN = """return scenario 'driven' {
    town = 'town1', cars = 20, seed = 3, duration = 3,
    run = function()
        spawn{ name = 'ego', model = 'sedan', driver = 'external' }
        wait(3600)
    end,
}
"""
THOROUGH = bool(os.environ.get("REPRISE_THOROUGH"))  # as often as was promised, not as often as every change wants
WAITING = 20  # [s] of patience for what takes milliseconds; a promise of its own is named where it is one


def drive(seen):
    """Some driving that depends on what is seen."""
    return reprise.Control(throttle=0.6 if seen.ego.speed < 9 else 0.0, steer=0.2 if seen.index % 40 < 9 else -0.05)


def chains(sim, ticks, **changes):
    seen, found = sim.reset(**changes), []
    while seen is not None and len(found) < ticks:
        found.append(seen.tick.digests["chain"].tobytes())
        seen = sim.step(drive(seen))
    return found


def reprise_program(*words):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False, timeout=120)
    return done.returncode, done.stdout + done.stderr


def descendants(pid):
    """All processes below this one."""
    found = []
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            children = [int(word) for word in task.read_text().split()]
        except OSError:
            continue
        for child in children:
            found += [child, *descendants(child)]
    return found


def is_alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


def wait_until(condition, what):
    until = time.monotonic() + WAITING
    while not condition():
        if time.monotonic() > until:
            raise AssertionError(f"waited {WAITING} s in vain: {what}")
        select.select([], [], [], 0.005)


class Server:
    """A `reprise serve` of the test's."""

    def __init__(self, *words):
        self.process = subprocess.Popen([PROGRAM, "serve", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        line = self.process.stdout.readline()
        self.said = line
        self.place = line.removeprefix("serving at ").strip()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(WAITING)
        self.process.stdout.close()


class Case(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="serve_")
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        (self.folder / "driven.lua").write_text(DRIVEN)


class Episodes(Case):
    def test_a_reset_is_a_fresh_process_tick_for_tick(self):
        with reprise.Simulation("town1", cars=40, seed=7) as sim:
            first = chains(sim, 60)
            other = chains(sim, 30, seed=8)  # another kernel
            again = chains(sim, 60, seed=7)
            once_more = chains(sim, 60)  # a copy of one that is ready
        with reprise.Simulation("town1", cars=40, seed=7) as sim:
            fresh = chains(sim, 60)
        self.assertEqual(len(set(first)), 60)
        self.assertNotEqual(first[:30], other)
        self.assertEqual(first, again)
        self.assertEqual(first, once_more)
        self.assertEqual(first, fresh)

    def test_many_episodes_on_a_busy_machine_are_one_chain(self):
        servers, each = (4, 25) if THOROUGH else (2, 6)
        for _ in os.sched_getaffinity(0):
            busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
            self.addCleanup(busy.wait)
            self.addCleanup(busy.kill)
        found = []
        for _ in range(servers):
            with reprise.Simulation("town1", cars=20, seed=7) as sim:
                found += [tuple(chains(sim, 15)) for _ in range(each)]
        self.assertEqual(len(found), servers * each)
        self.assertEqual(len(set(found[0])), 15)
        self.assertEqual(set(found), {found[0]})

    def test_a_reset_while_ticks_of_a_latency_are_on_their_way_begins_anew(self):
        late = DRIVEN.replace("driver = 'external'", "driver = 'external', latency = 3")
        with reprise.Simulation(scenario=late) as sim:
            found = [chains(sim, 10) for _ in range(3)]
        self.assertEqual(len(set(found[0])), 10)
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])

    def test_an_episode_is_what_reprise_run_records_and_verify_finds_again(self):
        trace, run = self.folder / "served.mcap", self.folder / "run.mcap"
        with reprise.Simulation(scenario="driven.lua", folder=self.folder) as sim:
            sim.reset(seed=5)
            sim.step()
            sim.reset(seed=3, trace="served.mcap")
            outcome = sim.run(drive)
        self.assertEqual((outcome.verdict, outcome.ticks), ("completed", 60))
        script = f"import sys; sys.path[:0] = {[str(HERE)]!r}; import reprise, serve_test; reprise.drive(serve_test.drive)"
        command = f"{sys.executable} -B -c \"{script}\""
        code, said = reprise_program("run", str(self.folder / "driven.lua"), "--driver", f"ego={command}", "-o", str(run))
        self.assertEqual(code, 0, said)
        chain = [re.search(r"chain +(\w+)", reprise_program("info", str(one))[1])[1] for one in (trace, run)]
        self.assertEqual(chain[0], chain[1])
        code, said = reprise_program("verify", str(trace))
        self.assertEqual(code, 0, said)

    def assert_whole(self, name, outcome):
        """The trace verifies, says how it ended, and ends so when it is made again."""
        code, said = reprise_program("verify", str(self.folder / name))
        self.assertEqual(code, 0, said)
        self.assertIn(outcome, reprise_program("info", str(self.folder / name))[1])
        again = self.folder / "again.mcap"
        reprise_program("run", str(self.folder / name), "-o", str(again))
        self.assertEqual(again.read_bytes(), (self.folder / name).read_bytes())

    def test_traces_of_episodes_that_their_client_ended_say_so_and_verify(self):
        with reprise.Simulation(scenario="driven.lua", folder=self.folder) as sim:
            sim.reset(trace="left_by_reset.mcap")
            sim.step(throttle=1.0)
            sim.reset(trace="left_at_once.mcap")
            sim.reset(trace="left_by_closing.mcap")
            sim.step(throttle=1.0)
        for name in ("left_by_reset.mcap", "left_at_once.mcap", "left_by_closing.mcap"):
            self.assert_whole(name, "ended: by its client")

    def test_a_client_that_is_gone_without_a_word_is_a_lost_driver(self):
        with Server("--socket", str(self.folder / "s"), "--folder", str(self.folder)) as server:
            sim = reprise.Simulation(scenario="driven.lua", server=server.place)
            sim.reset(trace="gone.mcap")
            sim.step(throttle=1.0)
            wire, sim._wire = sim._wire, None
            wire.close()
            wait_until((self.folder / "gone.mcap").exists, "the trace is closed")
        self.assert_whole("gone.mcap", "driver_lost: the driver of 'ego' was lost")

    def test_an_episode_that_the_server_ends_says_so_also_before_its_driver_was_there(self):
        nobody = "return scenario 'empty' {\n    town = 'town1', duration = 80000,\n    run = function() wait(80000) end,\n}\n"
        with Server("--socket", str(self.folder / "s"), "--folder", str(self.folder)) as server:
            driven = reprise.Simulation(scenario="driven.lua", server=server.place)
            driven.reset(trace="driven.mcap")
            driven.step(throttle=1.0)
            empty = reprise.Simulation(scenario=nobody, server=server.place, trace="empty.mcap")
            empty._say("reset", **empty._message())
            wait_until((self.folder / "empty.mcap.partial").exists, "the episode runs")
            wire, empty._wire = empty._wire, None
            wire.close()  # nobody waits for it any more: the server ends it
            wait_until((self.folder / "empty.mcap").exists, "the trace is closed")
        self.assert_whole("driven.mcap", "ended: by its server")
        self.assert_whole("empty.mcap", "ended: by its server")
        driven.close()

    def test_a_client_that_breaks_the_rules_hears_so_and_may_begin_again(self):
        def say_nan(wire, seen):
            wire.control(seen.index, float("nan"), 0, 0, False, False, 0)

        def answer_another_tick(wire, seen):
            wire.control(seen.index + 7, 0, 0, 0, False, False, 0)

        def be_ready(wire, seen):
            wire.ready()

        with reprise.Simulation(scenario="driven.lua", folder=self.folder, trace="bad.mcap") as sim:
            for misbehave, why in ((say_nan, "throttle = nan"), (answer_another_tick, "answered tick 8 when tick 1"),
                                   (be_ready, "something else than a control")):  # fmt: skip
                misbehave(sim._wire, sim.reset())
                with self.assertRaisesRegex(reprise.Fault, f"^the driver of 'ego' .*{why}"):
                    sim._look()
                self.assert_whole("bad.mcap", "driver_lost: the driver of 'ego' was lost")

    def test_whose_vehicle_is_taken_away_hears_how_the_episode_ends(self):
        gone = DRIVEN.replace("spawn", "local ego = spawn").replace("wait(3600)", "wait(1)\n        ego:despawn()\n        wait(3600)")
        endless = gone.replace("duration = 3", "duration = 80000")
        broken = gone.replace("wait(3600)", "wait(1)\n        spam()")
        drive_on = lambda seen: reprise.Control(throttle=0.4)
        with reprise.Simulation(scenario=gone, folder=self.folder) as sim:
            for _ in range(2):
                sim.reset(trace="gone.mcap")
                outcome = sim.run(drive_on)
                self.assertEqual((outcome.verdict, outcome.reason, outcome.ticks), ("completed", "time limit", 60))
            self.assert_whole("gone.mcap", "completed: time limit")
            sim.reset(scenario=broken)
            with self.assertRaisesRegex(reprise.Fault, "scenario.lua:8: .*spam"):
                sim.run(drive_on)
            # Nobody waits for the end of what would take hours: neither the next episode, nor who closes.
            seen = sim.reset(scenario=endless, trace="left.mcap")
            for _ in range(19):
                seen = sim.step(throttle=0.4)
            sim.say(reprise.Control())
            begin = time.monotonic()
            self.assertEqual(sim.reset(scenario=gone, trace=None).index, 1)
            self.assertLess(time.monotonic() - begin, WAITING)
            self.assert_whole("left.mcap", "ended: by its client")
            sim.reset(scenario=endless, trace="closed.mcap")
            for _ in range(19):
                sim.step(throttle=0.4)
            sim.say(reprise.Control())
        self.assert_whole("closed.mcap", "ended: by its client")

    def test_a_goodbye_in_an_episode_ends_the_session(self):
        with Server("--socket", str(self.folder / "s"), "--folder", str(self.folder)) as server:
            sim = reprise.Simulation(scenario="driven.lua", server=server.place)
            sim.reset()
            sim._wire.goodbye("enough")
            with self.assertRaises(WireError):
                sim._look()
            sim.close()

    def test_resets_that_are_said_at_once_are_played_one_after_the_other(self):
        with reprise.Simulation(scenario="driven.lua", folder=self.folder) as sim:
            for _ in range(4):
                sim._say("reset", **sim._message())
            for _ in range(4):
                self.assertEqual(sim._hear(first=True)[0], "hello")
            sim._wire.ready()
            self.assertEqual(sim._hear()[0], "observation")

    def test_cpp_clients_have_episodes_as_python_does(self):
        done = subprocess.run([os.environ["EPISODES"], "driven.lua", "cpp.mcap"], cwd=self.folder, capture_output=True,
                              text=True, check=False, timeout=120)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_whole("cpp.mcap", "completed: time limit")
        with reprise.Simulation(scenario="driven.lua", folder=self.folder, trace="python.mcap", seed=3) as sim:
            sim.run(lambda seen: reprise.Control(throttle=0.5 if seen.ego.speed < 8 else 0.0))
        self.assertEqual((self.folder / "cpp.mcap").read_bytes(), (self.folder / "python.mcap").read_bytes())

    def test_a_scenarios_mistake_is_told_with_its_line_and_the_session_lives_on(self):
        broken = "return scenario 'broken' {\n    run = function()\n        spam()\n    end,\n}\n"
        with reprise.Simulation(folder=self.folder) as sim:
            with self.assertRaisesRegex(reprise.Fault, "scenario.lua:3: .*'spam'.*spawn") as caught:
                sim.reset(scenario=broken)
            self.assertEqual(caught.exception.line, 3)
            late = DRIVEN.replace("wait(3600)", "wait(0.1)\n        spam()")
            sim.reset(scenario=late)
            with self.assertRaisesRegex(reprise.Fault, "scenario.lua:6: "):
                for _ in range(10):
                    sim.step()
            with self.assertRaisesRegex(reprise.Fault, "before a vehicle 'ego'"):
                sim.reset(scenario="return scenario 'empty' {\n    run = function() end,\n}\n")
            self.assertEqual(sim.reset(scenario="driven.lua").index, 1)

    def test_a_goal_is_reached_or_missed_by_the_time_of_10_kmh(self):
        with reprise.Simulation("town1", start=("b1_b2_1", 20.0), goal=("b1_b2_1", 60.0), trace="task.mcap",
                                folder=self.folder) as sim:  # fmt: skip
            seen = sim.reset()
            seen = sim.step()  # the goal is given when the vehicle is there
            self.assertEqual(seen.turning, "follow_lane")
            self.assertAlmostEqual(seen.way_to_goal, 40.0, delta=0.5)
            outcome = sim.run(lambda seen: reprise.Control(throttle=0.5 if seen.ego.speed < 8 else 0.0))
            self.assertEqual((outcome.verdict, outcome.reason), ("passed", "arrived"))
            sim.reset()
            outcome = sim.run(lambda seen: reprise.Control(brake=1.0))
            self.assertEqual(outcome.verdict, "failed")
            self.assertAlmostEqual(outcome.ticks * 0.05, 40 * 3.6 / 10, delta=0.3)

    def test_a_tasks_cameras_see_the_same_in_every_reset(self):
        rig = [dict(name="front", width=64, height=48), dict(name="far", kind="depth", width=32, height=32, every=5)]
        with reprise.Simulation("town1", seed=3, rig=rig) as sim:
            episodes = []
            for _ in range(2):
                seen, live = sim.reset(), []
                while seen.index < 8:
                    live.append(seen.image("front").copy())
                    self.assertEqual(seen.image("far") is not None, seen.index % 5 == 1)
                    seen = sim.step(throttle=0.5)
                episodes.append(live)
        self.assertEqual(episodes[0][0].shape, (48, 64, 3))
        np.testing.assert_array_equal(*episodes)
        self.assertGreater(episodes[0][0].std(), 5, "a street is not all of one colour")

    def test_who_is_shown_each_few_ticks_is_told_what_passed_between(self):
        rig = [dict(name="front", width=16, height=16), dict(name="far", kind="depth", width=16, height=16, every=6)]
        with reprise.Simulation("town1", cars=20, seed=3, every=3, rig=rig, folder=self.folder) as sim:
            seen, shown, told = sim.reset(trace="few.mcap"), [], []
            while seen.index < 40:
                shown.append(seen.index)
                told += [tick.digests["chain"].tobytes() for tick in (*seen.passed, seen.tick)]
                self.assertIsNotNone(seen.image("front"))
                self.assertEqual(seen.image("far") is not None, seen.index % 6 == 1)
                seen = sim.step(drive(seen))
            self.assertRaises(ValueError, sim.reset, every=0)
            self.assertRaises(ValueError, sim.reset, every=2, scenario="some.lua")
        self.assertEqual(shown, list(range(1, 40, 3)))
        recorded = [one.tick.digests["chain"].tobytes() for one in reprise.Trace(self.folder / "few.mcap")]
        self.assertEqual(told, recorded[: len(told)])
        self.assertEqual(reprise_program("verify", str(self.folder / "few.mcap"))[0], 0)

    def test_a_task_carries_sensors_that_are_no_cameras(self):
        rig = [dict(name="roof", kind="lidar", z=1.8, roll_deg=10, attributes=dict(channels=4, range=30, rotation_frequency=20, rolling=0)),
               dict(name="imu", kind="imu"), dict(name="bumper", kind="collision", every=9)]  # fmt: skip
        with reprise.Simulation("town1", seed=3, rig=rig, start=("b1_b2_1", 20.0)) as sim:
            seen = sim.reset()
            roof = sim.step().sensors["roof"].copy()
            self.assertEqual(sorted(set(roof["ring"])), [0, 1, 2, 3])
            np.testing.assert_allclose(seen.sensors["imu"][0]["compass"], (np.pi / 2 - seen.ego.yaw) % (2 * np.pi), atol=1e-6)
            self.assertEqual(len(seen.sensors["bumper"]), 0)
            sim.reset(rig=[{**rig[0], "roll_deg": 0}])
            level = sim.step().sensors["roof"]
            # Rolled to the right, the ground on the left lies deeper in the sensor's own frame.
            ground = lambda points: reprise.xyz(points)[(points["y"] > 2) & (points["y"] < 4), 2].min()
            self.assertGreater(abs(ground(roof) - ground(level)), 0.2)

    def test_a_sensor_of_a_task_may_be_named_as_that_of_a_scenario(self):
        with reprise.Simulation("straight", rig=[dict(name="front-left_2", width=4, height=4)]) as sim:
            self.assertEqual(sim.reset().image("front-left_2").shape, (4, 4, 3))

    def test_what_only_cameras_have_is_refused_of_other_sensors(self):
        for said in (dict(width=5), dict(height=100), dict(fov_deg=60)):
            with reprise.Simulation("town1", folder=self.folder, rig=[dict(name="imu", kind="imu", **said)]) as sim:
                with self.assertRaisesRegex(reprise.Fault, f"'{next(iter(said))}' is of cameras"):
                    sim.reset()

    def test_a_rig_that_cannot_be_is_refused(self):
        with reprise.Simulation("town1", folder=self.folder) as sim:
            for sensor in (dict(name="a' }, x = os.exit() --"), dict(name="a", kind="smell"), dict(name="a", fov_deg=float("nan")),
                           dict(name="a", width=100000), dict(name=""), dict(name="a", kind="lidar", attributes={"chanels": 3}),
                           dict(name="a", kind="lidar", attributes={"channels'] = 1 } } --": 3}),
                           dict(name="a", kind="lidar", attributes=dict(range=float("inf"))), dict(name="a", roll_deg=1e9),
                           dict(name="a", kind="lidar", every=1000, attributes=dict(points_per_second=1e8, rotation_frequency=0.1))):  # fmt: skip
                with self.assertRaises(reprise.Fault):
                    sim.reset(rig=[sensor])
            self.assertEqual(sim.reset(rig=()).index, 1)

    def test_each_meta_command_changes_what_it_says_and_nothing_else_is_needed(self):
        rig = [dict(name="front", width=32, height=24)]
        with reprise.Simulation("town1", cars=5, seed=3, rig=rig, start=("b1_b2_1", 20.0)) as sim:
            noon = sim.reset()
            picture = noon.image("front").copy()
            rain = sim.reset(weather="hard_rain_sunset")
            self.assertEqual((noon.run.episode.weather_name, rain.run.episode.weather_name), ("clear_noon", "hard_rain_sunset"))
            self.assertFalse(np.array_equal(picture, rain.image("front")), "the same street looks otherwise")
            other = sim.reset(rig=[dict(name="wide", kind="depth", width=16, height=8)])
            self.assertEqual([sensor.name for sensor in other.run.sensors.rig], ["wide"])
            self.assertEqual(other.image("wide").shape, (8, 16))
            with self.assertRaisesRegex(KeyError, "carries wide"):
                other.image("front")
            again = sim.reset(weather="clear_noon", rig=rig)
            np.testing.assert_array_equal(again.image("front"), picture)
            blind = sim.reset(rig=(), cars=9, seed=4, start=("b1_b2_1", 60.0), model="van")
            self.assertEqual((len(blind.run.sensors.rig), len(blind.images)), (0, 0))
            self.assertEqual((blind.run.episode.cars, blind.run.episode.seed), (9, 4))
            self.assertAlmostEqual(float(blind.ego.lane_s), 60.0, delta=0.5)
            self.assertNotEqual(blind.vehicles["model"][0], again.vehicles["model"][0])
            with_goal = sim.reset(goal=("b1_b2_1", 70.0))
            self.assertAlmostEqual(sim.step().way_to_goal, 10.0, delta=0.5)
            self.assertEqual(with_goal.run.town.name, "town1")
            self.assertEqual(sim.reset(town="town2", start=None, goal=None).run.town.name, "town2")

    def test_walkers_of_a_task_walk_by_a_seed_of_their_own(self):
        def places(seen):
            return [(float(walker["position"]["x"]), float(walker["position"]["y"])) for walker in seen.walkers]

        with reprise.Simulation("town1", walkers=12, seed=3) as sim:
            first = sim.reset()
            self.assertEqual((len(first.walkers), first.run.episode.walkers, first.run.episode.walker_seed), (12, 12, 3))
            same, other = places(sim.reset(walker_seed=3, seed=4)), places(sim.reset(walker_seed=5))
            self.assertEqual(same, places(sim.reset(walker_seed=None, seed=3)))
            self.assertNotEqual(same, other)
            self.assertEqual(len(sim.reset(walkers=0).walkers), 0)
            with self.assertRaisesRegex(reprise.Fault, "^the task's walkers: expected 0 to 2000$"):
                sim.reset(walkers=2001)
        with self.assertRaisesRegex(ValueError, "^walkers: a scenario says itself how many people walk"):
            reprise.Simulation(scenario="a.lua", walkers=3)

    def test_a_control_that_cannot_be_is_refused_and_the_episode_goes_on(self):
        with reprise.Simulation("town1") as sim:
            sim.reset()
            for wrong in (dict(throttle=2), dict(throttle="0.4"), dict(steer=float("nan")), dict(brake=None), dict(lamps=-1),
                          dict(lamps=0.5), dict(steer=np.zeros(2))):  # fmt: skip
                with self.assertRaisesRegex(ValueError, f"^Control\\({next(iter(wrong))}=.*expected"):
                    sim.step(**wrong)
            for wrong in ({"throttle": 0.4}, 0.4):
                with self.assertRaisesRegex(TypeError, "a driver returns a reprise.Control, not"):
                    sim.step(wrong)
            with self.assertRaisesRegex(TypeError, "not both"):
                sim.step(reprise.Control(), throttle=0.4)
            with self.assertRaisesRegex(TypeError, "is a `return` missing"):
                sim.run(lambda seen: None)
            self.assertEqual(sim.step(throttle=np.float32(0.4)).index, 2)

    def test_begins_anew_where_it_was_interrupted_while_it_waited(self):
        with reprise.Simulation("town1", seed=3) as sim:
            wanted = chains(sim, 5)
            seen = sim.reset()
            sim._wire.control(seen.index, 0.4, 0, 0, False, False, 0)  # and Ctrl-C: nobody reads the answer
            wait_until(lambda: select.select([sim._wire], [], [], 0)[0], "the server answers")
            self.assertEqual(chains(sim, 5), wanted)

    def test_begins_anew_where_the_last_word_of_an_episode_was_not_heard(self):
        broken = DRIVEN.replace("wait(3600)", "wait_ticks(1) spam()")
        with reprise.Simulation("straight", seconds=0.1, folder=self.folder) as sim:
            for again in (dict(), dict(scenario=broken), dict(scenario=None)):
                sim.reset(**again)
                sim.say(reprise.Control())  # and Ctrl-C: nobody reads how it ends
                wait_until(lambda: select.select([sim._wire], [], [], 0)[0], "the server answers")
            self.assertEqual(sim.reset().index, 1)

    def test_each_control_is_said_once_and_heard_of_once(self):
        with reprise.Simulation("straight") as sim:
            sim.reset()
            with self.assertRaisesRegex(RuntimeError, "say\\(\\) comes before hear\\(\\)"):
                sim.hear()
            sim.say(reprise.Control(throttle=0.4))  # and Ctrl-C in step(): nobody reads the answer
            for again in (sim.step, lambda: sim.say(reprise.Control())):
                with self.assertRaisesRegex(RuntimeError, "the last control was not heard yet"):
                    again()
            self.assertEqual([sim.hear().index, sim.step().index], [2, 3])
            sim.say(reprise.Control())
            self.assertEqual([sim.reset().index, sim.step().index], [1, 2])

    def test_a_fork_that_closes_ends_nothing(self):
        with reprise.Simulation("straight") as sim:
            sim.reset()
            child = os.fork()
            if child == 0:
                try:
                    sim.close()
                finally:
                    os._exit(0)
            os.waitpid(child, 0)
            self.assertEqual([sim.step().index for _ in range(3)], [2, 3, 4])

    def test_a_fork_does_not_step_the_episode_of_who_made_it(self):
        with reprise.Simulation("straight") as one, reprise.MultiSimulation(("a",), SEVERAL, folder=self.folder) as several:
            one.reset()
            several.reset()
            child = os.fork()
            if child == 0:
                signal.alarm(WAITING)  # where it waits for an answer that the other one has heard
                told = 0
                for use in (one.step, one.reset, one.hear, lambda: several.step({"a": reprise.Control()}), several.reset):
                    try:
                        use()
                    except RuntimeError as error:
                        told += "forked from: make another one here" in str(error) or use == one.hear
                os._exit(told)
            self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 5, "-14: it waited")
            self.assertEqual([one.step().index for _ in range(3)], [2, 3, 4])
            self.assertEqual(several.step({"a": reprise.Control()})["a"].index, 2)

    def test_what_would_be_passed_over_is_refused(self):
        for wrong in (dict(cars=5), dict(town="town2"), dict(goal="drawn"), dict(rig=[dict(name="front")]), dict(model="van")):
            with self.subTest(wrong), self.assertRaisesRegex(ValueError, f"^{next(iter(wrong))}=.*is for tasks"):
                reprise.Simulation(scenario="driven.lua", **wrong)
        with reprise.Simulation("straight", cars=3, folder=self.folder) as sim:
            with self.assertRaisesRegex(ValueError, "^settings=.*is for scenarios"):
                sim.reset(settings={"gap": 3})
            self.assertRaises(ValueError, sim.reset, scenario="driven.lua", weather="hard_rain_noon")
            self.assertEqual(len(sim.reset().cars), 3)
            self.assertEqual(len(sim.reset(scenario="driven.lua").cars), 20)  # what was asked of tasks waits for the next one

    def test_arguments_of_odd_types_are_refused_in_a_line_before_anything_is_said(self):
        array = np.zeros((2, 2))
        odd = [("rig", ("front", {"front": {}}, ["front"], [array], 3, array), "expected a list of sensors, each a dict"),
               ("rig", ([dict(name="a", attributes=3)], [dict(name="a", attributes=dict(range="far"))]), "expected a dict of names and numbers"),
               ("rig", ([dict(name="a", wide=2)], [{"name": "a", 3: 2}]), "rig: a sensor has no "),
               ("rig", ([dict(width=2)], [{}]), "has no name"),
               ("rig", ([dict(name="a", width=2.5)], [dict(name="a", width=-1)]), "expected a whole number"),
               ("start", (2.5, True, array, b"x", (), ("a",), ("a", "b"), {"a": 1}, -1, 2**32), "expected"),
               ("goal", (float("nan"), float("inf"), object(), (1, 2, 3), np.zeros(2)), "expected a lane, with or without metres"),
               ("scenario", (3, b"x", ["a"], array), "expected a text or a path"),
               ("every", (0, 101, 2.0, "2", None, array, 10**30), "expected 1 to 100 ticks"),
               ("seed", ("", [], array, -1, 2**64, 0.5), "expected a whole number"),
               ("walker_seed", ("", {}), "expected a whole number"), ("seconds", ("", [], array), "expected a number"),
               ("cars", (array, "", 1e308), "expected a whole number"), ("town", (array, 3, b"town1", "town1\0"), "expected a text"),
               ("weather", ("a\0b",), "expected a text without"), ("trace", (3, "a\0.mcap"), "expected a text")]  # fmt: skip
        with reprise.Simulation("straight", folder=self.folder) as sim:
            for name, values, wanted in odd:
                for value in values:
                    with self.subTest(name, value=value), self.assertRaises(ValueError) as caught:
                        sim.reset(**{name: value})
                    self.assertNotIsInstance(caught.exception, reprise.Fault)
                    said = str(caught.exception)
                    self.assertIn(wanted, said)
                    self.assertTrue(said.isprintable() and len(said) < 400, said)
            for value in (3, "gap", [("gap", 3)], {3: 3}, array):
                with self.subTest(settings=value), self.assertRaisesRegex(ValueError, "^settings=.*: expected a dict"):
                    sim.reset(scenario=DRIVEN, settings=value)
            seen = sim.reset(start=np.int64(0), every=np.int32(2), seed=np.uint8(3))
            self.assertEqual((seen.index, seen.run.every, seen.run.episode.seed), (1, 2, 3))
        for drivers in (5, None, [5], ["a", ["b"]], {"a": 1}, b"ab"):
            with self.subTest(drivers=drivers), self.assertRaisesRegex(ValueError, "names of different vehicles"):
                reprise.MultiSimulation(drivers, SEVERAL)
        for server in (3, b"s", ["s"]):
            with self.subTest(server=server), self.assertRaisesRegex(ValueError, "^address=.*: expected a text or a path"):
                reprise.Simulation(server=server)
        for polling in (None, "x", [1], True):
            with self.subTest(polling=polling), self.assertRaisesRegex(ValueError, "^polling=.*: expected seconds"):
                reprise.Simulation(polling=polling)

    def test_a_server_that_cannot_be_started_leaves_nothing_and_says_why(self):
        (self.folder / "file").touch()
        before = os.listdir("/proc/self/fd")
        for folder in ("none", "file"):
            with self.assertRaisesRegex(NotADirectoryError, f"^folder='.*{folder}': there is no such folder"):
                reprise.Simulation(folder=self.folder / folder)
        with unittest.mock.patch.dict(os.environ, REPRISE=str(self.folder / "none")):
            try:
                reprise.Simulation()
            except FileNotFoundError as error:  # which keeps alive what was not closed
                self.assertEqual(len(os.listdir("/proc/self/fd")), len(before), error)

    def test_seconds_that_cannot_be_are_told_in_the_words_of_who_asked(self):
        with reprise.Simulation("straight") as sim:
            for seconds in (-1, float("nan"), float("inf"), 86401):
                with self.subTest(seconds), self.assertRaisesRegex(reprise.Fault, "^seconds = .*: must be in \\(0, 86400\\]$"):
                    sim.reset(seconds=seconds)
            self.assertEqual(sim.reset(seconds=86400).index, 1)

    def test_more_than_a_server_takes_is_refused_here_and_the_session_lives_on(self):
        with reprise.Simulation("straight") as sim:
            with self.assertRaisesRegex(ValueError, "^reset: expected 2097152 bytes at most, got 30"):
                sim.reset(scenario="\n" + " " * 3_000_000)
            self.assertEqual(sim.reset().index, 1)

    def test_a_server_that_was_started_for_us_and_ended_is_said_to_have(self):
        with reprise.Simulation() as sim:
            sim.reset()
            sim._server._process.kill()
            with self.assertRaisesRegex(WireError, "hung up: its server was ended by signal 9"):
                for _ in range(100_000):
                    sim.step()

    def test_fifty_resets_leave_no_process_and_no_descriptor(self):
        with reprise.Simulation("town1", seed=1) as sim:
            def state():
                below = descendants(os.getpid())
                return len(below), sorted(len(os.listdir(f"/proc/{pid}/fd")) for pid in below)

            sim.reset()
            before = state()
            for _ in range(50):
                sim.step()
                sim.reset()
            self.assertEqual(state(), before)
            there = descendants(os.getpid())
        wait_until(lambda: not any(map(is_alive, there)), "children of a closed simulation end")


SEVERAL = """return scenario 'several' {
    town = 'town1', cars = 20, seed = 3, duration = 5,
    run = function()
        local a = spawn{ name = 'a', model = 'sedan', driver = 'external' }
        wait(1)
        spawn{ name = 'b', model = 'sedan', driver = 'external' }
        wait(2)
        a:despawn()
        wait(3600)
    end,
}
"""


class Several(Case):
    """One client that drives several vehicles."""

    def setUp(self):
        super().setUp()
        (self.folder / "several.lua").write_text(SEVERAL)

    def ways(self, sim, **changes):
        """Who is there, with the chain that they are shown, tick by tick."""
        seen, found = sim.reset(**changes), []
        while seen:
            found.append((list(seen), {one.tick.digests["chain"].tobytes() for one in seen.values()}))
            self.assertEqual([one.run.name for one in seen.values()], list(seen))
            seen = sim.step({name: drive(one) for name, one in seen.items()})
        return found

    def assert_same_as_programs(self, ways):
        """The trace of these ways, one.mcap, is that of as many programs."""
        self.assertEqual({len(chains) for _, chains in ways}, {1}, "all are shown the same tick")
        script = f"import sys; sys.path[:0] = {[str(HERE)]!r}; import reprise, serve_test; reprise.drive(serve_test.drive)"
        drivers = [word for name in "ab" for word in ("--driver", f'{name}={sys.executable} -B -c "{script}"')]
        code, said = reprise_program("run", str(self.folder / "several.lua"), *drivers, "-o", str(self.folder / "two.mcap"))
        self.assertEqual(code, 0, said)
        self.assertEqual((self.folder / "one.mcap").read_bytes(), (self.folder / "two.mcap").read_bytes())
        code, said = reprise_program("verify", str(self.folder / "one.mcap"))
        self.assertEqual(code, 0, said)

    def test_drive_what_as_many_programs_drive(self):
        with reprise.MultiSimulation(("a", "b"), "several.lua", folder=self.folder) as sim:
            ways = self.ways(sim, trace="one.mcap")
            self.assertEqual((sim.outcome.verdict, sim.outcome.ticks), ("completed", 100))
        self.assertEqual([names for names, _ in ways], 20 * [["a"]] + 40 * [["a", "b"]] + 39 * [["b"]])
        self.assert_same_as_programs(ways)

    def test_an_episode_that_is_left_with_nobody_on_the_road_verifies(self):
        late = SEVERAL.replace("local a", "wait(80000) local a").replace("duration = 5", "duration = 80000")
        gone = SEVERAL.replace("wait(1)\n", "wait(1) a:despawn() wait(80000)\n").replace("duration = 5", "duration = 80000")
        for scenario in (late, gone):
            for ends in ("goodbye", "close"):
                with self.subTest(ends, late=scenario is late):
                    with Server("--socket", str(self.folder / "s"), "--folder", str(self.folder)) as server:
                        sim = reprise.MultiSimulation(("a", "b"), scenario, server=server.place, trace="left.mcap")
                        sim._say("reset", **sim._message(), drivers=["a", "b"])
                        for _ in range(2):
                            kind, message = sim._hear(first=True)
                            sim._wires[message.name] = Wire(socket.socket(fileno=sim._wire.descriptor()))
                        if scenario is gone:
                            wire = sim._wires["a"]
                            self.assertEqual(wire.receive_first()[0], "hello")
                            wire.ready()
                            for _ in range(20):
                                wire.control(wire.receive()[1].nested("tick", "world.Tick").index, 0, 0, 0, False, False, 0)
                            self.assertEqual(wire.receive()[0], "goodbye")
                        else:
                            wait_until((self.folder / "left.mcap.partial").exists, "the episode runs")
                        if ends == "goodbye":
                            sim._wire.goodbye("enough")
                        sim._let_go()
                        sim._wire.close()
                        wait_until((self.folder / "left.mcap").exists, "the trace is closed")
                        sim._wire = None
                        sim.close()
                    code, said = reprise_program("verify", str(self.folder / "left.mcap"))
                    self.assertEqual(code, 0, said)
                    # By whom is a race where it hangs up: who waits for it may see that first.
                    self.assertRegex(reprise_program("info", str(self.folder / "left.mcap"))[1], "ended: by its (client|server)")
                    (self.folder / "left.mcap").unlink()

    def test_each_is_shown_the_ticks_that_its_scenario_says(self):
        several = SEVERAL.replace("name = 'a',", "name = 'a', every = 3,").replace("name = 'b',", "name = 'b', every = 4,")
        (self.folder / "several.lua").write_text(several)
        with reprise.MultiSimulation(("a", "b"), "several.lua", folder=self.folder) as sim:
            ways = self.ways(sim, trace="one.mcap")
            self.assertEqual((sim.outcome.verdict, sim.outcome.ticks), ("completed", 100))
        # 'a' is spawned in tick 1 and taken away in tick 61, 'b' is spawned in tick 21.
        shown = {"a": range(1, 61, 3), "b": range(21, 100, 4)}
        there = [[name for name in "ab" if tick in shown[name]] for tick in range(1, 100)]
        self.assertEqual([names for names, _ in ways], [names for names in there if names])
        self.assert_same_as_programs(ways)

    def test_an_episode_that_is_left_leaves_a_whole_trace_and_nothing_for_the_next(self):
        with reprise.MultiSimulation(("a", "b"), "several.lua", folder=self.folder) as sim:
            wanted = self.ways(sim)
            seen = sim.reset(trace="left_by_reset.mcap")
            for _ in range(30):
                seen = sim.step({name: reprise.Control(throttle=1.0) for name in seen})
            self.assertEqual(self.ways(sim, trace=None), wanted)
            sim.reset(trace="left_by_closing.mcap")
            there = descendants(os.getpid())
        self.assertFalse(any(map(is_alive, there)))
        for name in ("left_by_reset.mcap", "left_by_closing.mcap"):
            code, said = reprise_program("verify", str(self.folder / name))
            self.assertEqual(code, 0, said)
            self.assertIn("driver_lost", reprise_program("info", str(self.folder / name))[1])

    def test_fifty_resets_leave_no_process_and_no_descriptor(self):
        with reprise.MultiSimulation(("a", "b"), "several.lua", folder=self.folder) as sim:
            def state():
                below = [os.getpid(), *descendants(os.getpid())]
                return len(below), sorted(len(os.listdir(f"/proc/{pid}/fd")) for pid in below)

            sim.reset()
            before = state()
            for _ in range(50):
                sim.step({"a": reprise.Control()})
                sim.reset()
            self.assertEqual(state(), before)

    def test_mistakes_are_told_and_the_session_lives_on(self):
        for names in ((), "ab", ("a", "a")):
            with self.assertRaisesRegex(ValueError, "names of different vehicles"):
                reprise.MultiSimulation(names, SEVERAL)
        with reprise.MultiSimulation(("a", "b"), SEVERAL, folder=self.folder) as sim:
            seen = sim.reset()
            with self.assertRaisesRegex(ValueError, "a control for each of a, got none"):
                sim.step({})
            with self.assertRaisesRegex(ValueError, "a control for each of a, got a, c"):
                sim.step({"a": reprise.Control(), "c": reprise.Control()})
            with self.assertRaisesRegex(TypeError, "a driver returns a reprise.Control, not None"):
                sim.step({"a": None})
            with self.assertRaisesRegex(reprise.Fault, "scenario.lua:8: ") as caught:
                seen = sim.reset(scenario=SEVERAL.replace("a:despawn()", "a:despan()"))
                for _ in range(100):
                    seen = sim.step({name: reprise.Control() for name in seen})
            self.assertEqual(caught.exception.line, 8)
            with self.assertRaisesRegex(reprise.Fault, "scenario.lua:4: .*'a' is driven by another program"):
                sim.reset(scenario=SEVERAL, drivers=("b", "c"))
            with self.assertRaisesRegex(reprise.Fault, "before a vehicle of a, b was there"):
                sim.reset(scenario="return scenario 'empty' {\n    run = function() end,\n}\n", drivers=("a", "b"))
            with self.assertRaisesRegex(reprise.Fault, "needs the name of another actor"):
                sim.reset(scenario=SEVERAL, drivers=("a", ""))
            self.assertEqual(list(sim.reset(drivers=("a", "b"))), ["a"])

    def test_a_driver_that_says_nonsense_ends_the_run_for_all(self):
        with reprise.MultiSimulation(("a", "b"), SEVERAL, trace="a.mcap", folder=self.folder) as sim:
            seen = sim.reset()
            while len(seen) < 2:
                seen = sim.step({name: reprise.Control() for name in seen})
            sim._wires["b"].control(seen["b"].index, 7.0, 0, 0, False, False, 0)
            self.assertEqual(sim.step({name: reprise.Control() for name in seen}), {})
            self.assertEqual((sim.outcome.verdict, sim.outcome.ticks), ("driver_lost", seen["a"].index))
        code, said = reprise_program("verify", str(self.folder / "a.mcap"))
        self.assertEqual(code, 0, said)


class Servers(Case):
    def test_two_clients_at_once_disturb_each_other_in_nothing(self):
        with Server("--socket", str(self.folder / "s"), "--folder", str(self.folder)) as server:
            with reprise.Simulation("town1", cars=20, seed=7, server=server.place) as alone:
                wanted = chains(alone, 20)
            with reprise.Simulation("town1", cars=20, seed=7, server=server.place) as one, \
                    reprise.Simulation("town2", cars=20, seed=9, server=server.place) as two:  # fmt: skip
                seen, other, found = one.reset(), two.reset(), []
                for _ in range(20):
                    found.append(seen.tick.digests["chain"].tobytes())
                    seen, other = one.step(drive(seen)), two.step(drive(other))
            self.assertEqual(found, wanted)

    def test_who_comes_to_a_run_for_episodes_is_told_and_the_run_waits_on(self):
        place = self.folder / "s"
        run = subprocess.Popen([PROGRAM, "run", "driven.lua", "--driver", f"ego=socket:{place}", "-o", "a.mcap"], cwd=self.folder,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)  # fmt: skip
        self.addCleanup(run.kill)
        wait_until(place.exists, "the run listens")
        for make in (lambda: reprise.Simulation(server=place), lambda: reprise.MultiSimulation(("a",), SEVERAL, server=place)):
            with self.assertRaisesRegex(WireError, "s'\\): no server is there, but a run that waits for a driver: reprise.drive()"):
                make()
        self.assertEqual(reprise.drive(drive, place), 59)
        self.assertIn("completed", run.communicate(timeout=WAITING)[0])

    def test_who_comes_to_a_server_for_a_run_is_told_when_it_is_hung_up_on(self):
        ours, theirs = socket.socketpair()
        with ours, unittest.mock.patch("reprise.wire._connect", lambda _: ours):
            theirs.close()
            with self.assertRaisesRegex(WireError, "hung up before it said hello; at a `reprise serve` a reprise.Simulation begins"):
                reprise.drive(drive, "s")

    def test_a_server_is_named_by_a_path_as_well(self):
        with Server("--socket", str(self.folder / "s")) as server:
            with reprise.Simulation(server=pathlib.Path(server.place)) as sim:
                self.assertEqual(sim.reset().index, 1)

    def test_the_socket_is_its_owners_and_gone_in_the_end(self):
        path = self.folder / "s"
        with Server("--socket", str(path)) as server:
            self.assertEqual(stat.S_IMODE(path.stat().st_mode), 0o600)
            with reprise.Simulation(server=server.place) as sim:
                sim.reset()
                there = descendants(server.process.pid)
                self.assertGreaterEqual(len(there), 3)
                server.process.terminate()
                with self.assertRaises((WireError, reprise.Fault)):
                    for _ in range(100_000):
                        sim.step()
                self.assertEqual(server.process.wait(WAITING), 128 + signal.SIGTERM)
        self.assertFalse(path.exists())
        self.assertFalse(any(map(is_alive, there)))

    def test_when_the_server_ends_the_trace_is_whole(self):
        with Server("--socket", str(self.folder / "s"), "--folder", str(self.folder)) as server:
            with reprise.Simulation(scenario="driven.lua", server=server.place, trace="a.mcap") as sim:
                sim.reset()
                sim.step()
                server.process.terminate()
                server.process.wait(WAITING)
        code, said = reprise_program("verify", str(self.folder / "a.mcap"))
        self.assertEqual(code, 0, said)

    def test_when_the_server_is_killed_clients_hear_of_it_and_its_children_end(self):
        path = self.folder / "s"
        with Server("--socket", str(path)) as server:
            with reprise.Simulation(server=server.place) as sim:
                sim.reset()
                there = descendants(server.process.pid)
                server.process.kill()
                killed = time.monotonic()
                with self.assertRaises(WireError):
                    for _ in range(100_000):
                        sim.step()
                # A second is the promise, to which a machine that is loaded adds its own.
                self.assertLess(time.monotonic() - killed, 1 if THOROUGH else WAITING)
                wait_until(lambda: not any(map(is_alive, there)), "children of a killed server end")
        self.assertTrue(path.exists())  # nobody could take it away
        with Server("--socket", str(path)) as server, reprise.Simulation(server=server.place) as sim:
            self.assertEqual(sim.reset().index, 1)

    def test_no_more_clients_than_episodes(self):
        with Server("--socket", str(self.folder / "s"), "--episodes", "1") as server:
            with reprise.Simulation(server=server.place):
                with self.assertRaisesRegex(reprise.Fault, "1 client is served already"):
                    reprise.Simulation(server=server.place)

    def strangers(self, server, count, says=b""):
        """Connections that never show that they may come in."""
        host, _, port = server.place.rpartition(":")
        for _ in range(count):
            one = socket.create_connection((host, int(port))) if host else socket.socket(socket.AF_UNIX)
            self.addCleanup(one.close)
            if not host:
                one.connect(server.place)
            one.sendall(says)

    def test_strangers_who_say_nothing_keep_nobody_out(self):
        with Server("--socket", str(self.folder / "s"), "--episodes", "2") as server:
            with reprise.Simulation(server=server.place) as before:
                before.reset()
                self.strangers(server, 1)
                self.strangers(server, 1, b"\0")
                with reprise.Simulation(server=server.place) as sim:
                    self.assertEqual(sim.reset().index, 1)
                    self.strangers(server, 40)  # more than are listened to at once
                    with self.assertRaisesRegex(reprise.Fault, "2 clients are served already"):
                        reprise.Simulation(server=server.place)
                    self.assertLess(len(descendants(server.process.pid)), 30)
                    self.assertEqual((before.step().index, sim.step().index), (2, 2))
                self.strangers(server, 40)
                wait_until(lambda: self.opens(server), "a place is free again")
                self.assertEqual(before.step().index, 3)

    def opens(self, server, **said):
        try:
            reprise.Simulation(server=server.place, **said).close()
        except reprise.Fault:
            return False
        return True

    def test_strangers_without_the_token_keep_nobody_out(self):
        token = self.folder / "token"
        token.touch(0o600)
        token.write_text("a token of some length\n")
        with Server("--port", "0", "--listen", "127.0.0.2", "--token-file", str(token), "--episodes", "1") as server:
            self.strangers(server, 20)
            for _ in range(3):
                with self.assertRaisesRegex(reprise.Fault, "wrong token"):
                    reprise.Simulation(server=server.place, token="another token, as long")
            with reprise.Simulation(server=server.place, token="a token of some length") as sim:
                self.assertEqual(sim.reset().index, 1)
                with self.assertRaisesRegex(reprise.Fault, "wrong token"):  # not how many are served
                    reprise.Simulation(server=server.place, token="another token, as long")

    def test_names_that_lead_out_of_the_folder_are_refused(self):
        inside = self.folder / "inside"
        inside.mkdir()
        (inside / "link.lua").symlink_to(self.folder / "driven.lua")
        (inside / "link.mcap").symlink_to(self.folder / "secret.mcap")
        (inside / "late.mcap.partial").symlink_to(self.folder / "secret.mcap")
        (inside / "driven.lua").write_text(DRIVEN)
        (inside / "reads.lua").write_text(DRIVEN.replace("wait(3600)", "print('link.csv') wait(3600)"))
        (self.folder / "secret.csv").write_text("t,x,y,heading_deg\n")
        (inside / "link.csv").symlink_to(self.folder / "secret.csv")
        with Server("--socket", str(self.folder / "s"), "--folder", str(inside)) as server:
            wire = Wire(server.place)
            wire.say("open", version=1)
            self.assertEqual(wire.receive()[0], "open")
            for name in ("../driven.lua", str(self.folder / "driven.lua"), "..", "", ".lua", "link.lua", "a\0b.lua", "driven.txt",
                         "reads.lua"):  # fmt: skip
                with self.subTest(scenario=name):
                    wire.say("reset", file=name)
                    self.assertEqual(wire.receive()[0], "fault")
            for name in ("../a.mcap", str(self.folder / "a.mcap"), "link.mcap", "late.mcap", ".mcap", "a.txt"):
                with self.subTest(trace=name):
                    wire.say("reset", file="driven.lua", trace=name)
                    kind, message = wire.receive()
                    self.assertEqual(kind, "fault")
                    # Before anything is begun: not by a writer that finds it out later.
                    self.assertIn("links are not followed" if name.startswith("l") else "expected the name of a file", message.text)
            for town in ("../town1", "/etc/passwd", "town1/town1.net.xml", ".", ""):
                with self.subTest(town=town):
                    wire.say("reset", task={"town": town})
                    kind, message = wire.receive()
                    self.assertEqual(kind, "fault")
                    self.assertIn("no town", message.text)
            wire.close()
        self.assertEqual(sorted(one.name for one in self.folder.iterdir()), ["driven.lua", "inside", "secret.csv"])

    def test_faults_name_files_as_in_the_folder_and_not_where_that_stands(self):
        inside = self.folder / "in:side"
        broken = inside / "towns/broken"
        broken.mkdir(parents=True)
        (broken / "broken.net.xml").write_text("<net>\n<edge")
        (inside / "wrong.lua").write_text(DRIVEN.replace("wait(3600)", "wait('x')"))
        self.assertIn("wait('x')", (inside / "wrong.lua").read_text())
        for folder in (inside, pathlib.Path(os.path.relpath(inside))):
            with self.subTest(folder), Server("--socket", str(self.folder / "s"), "--folder", str(folder)) as server:
                wire = Wire(server.place)
                wire.say("open", version=1)
                self.assertEqual(wire.receive()[0], "open")
                heard = []
                for said in ({"file": "nope.lua"}, {"task": {"town": "broken"}}, {"file": "wrong.lua"}):
                    wire.say("reset", **said)
                    kind, message = wire.receive()
                    while kind == "hello" or kind == "observation":
                        kind, message = wire.receive()
                    self.assertEqual(kind, "fault")
                    self.assertNotIn("in:side", message.text)
                    self.assertNotIn(self.folder.name, message.text)
                    heard.append(message)
                self.assertIn("no scenario file 'nope.lua'", heard[0].text)
                self.assertRegex(heard[1].text, r"^towns/broken/\S+\.xml:2: ")
                self.assertEqual(heard[1].line, 2)
                self.assertRegex(heard[2].text, "^wrong.lua:[0-9]+: ")
                self.assertEqual(heard[2].line, int(heard[2].text.split(":")[1]))
                wire.close()

    def test_links_to_towns_elsewhere_are_refused(self):
        elsewhere, inside = self.folder / "elsewhere", self.folder / "inside"
        inside.mkdir()

        def put(network, name):
            network.mkdir(parents=True)
            (network / f"{name}.net.xml").write_bytes((HERE.parent / "crash/small.net.xml").read_bytes())

        put(elsewhere / "small", "small")
        (inside / "towns").symlink_to(elsewhere)
        code, said = reprise_program("serve", "--socket", str(self.folder / "s"), "--folder", str(inside))
        self.assertEqual(code, 2, said)
        self.assertIn("towns: is a link; clients of a server reach nothing outside of its folder", said)
        (inside / "towns").unlink()
        towns = inside / "towns"
        put(towns / "own", "own")
        put(towns / "linked", "linked")
        (towns / "small").symlink_to(elsewhere / "small")
        (towns / "linked/more.txt").symlink_to(elsewhere)
        with Server("--socket", str(self.folder / "s"), "--folder", str(inside)) as server:
            with reprise.Simulation(server=server.place) as sim:
                for town in ("small", "linked"):
                    with self.assertRaisesRegex(reprise.Fault, f"towns/{town}.*: is a link"):
                        sim.reset(town=town)
                self.assertEqual(sim.reset(town="own").index, 1)

    def test_what_is_no_message_is_told_to_who_said_it(self):
        with Server("--socket", str(self.folder / "s")) as server:
            wire = Wire(server.place)
            wire.say("open", version=1)
            self.assertEqual(wire.receive()[0], "open")
            wire._send_all(struct.pack("<II", 4, 99) + b"none")
            kind, message = wire.receive()
            self.assertEqual(kind, "fault")
            self.assertIn("the client said what is no message (kind 99, 4 bytes)", message.text)
            with self.assertRaises(WireError):
                wire.receive()
            wire.close()

    def hears(self, client):
        """All that is said to a socket until it is hung up on."""
        client.settimeout(WAITING)
        said = b""
        try:
            while more := client.recv(4096):
                said += more
        except ConnectionResetError:
            pass
        return said

    def test_only_who_has_greeted_and_says_nonsense_is_told_so(self):
        with Server("--socket", str(self.folder / "s")) as server:
            with socket.socket(socket.AF_UNIX) as stranger:
                stranger.connect(server.place)
                stranger.sendall(struct.pack("<II", 4, 99) + b"none")
                self.assertEqual(self.hears(stranger), b"")
            idle = Wire(server.place)
            idle.say("open", version=1)
            self.assertEqual(idle.receive()[0], "open")
            server.process.terminate()
            with self.assertRaisesRegex(WireError, "hung up"):  # it made no mistake
                idle.receive()
            idle.close()

    def test_a_fault_is_one_line_whatever_it_names(self):
        nasty = "a\nb\x1b[31m"
        changes = [dict(trace=nasty + ".mcap"), dict(town=nasty), dict(weather=nasty), dict(model=nasty), dict(start=(nasty, 3.0)),
                   dict(scenario=DRIVEN, settings={nasty: 1}), dict(scenario=nasty.replace("\n", "") + ".lua")]  # fmt: skip
        with reprise.Simulation("straight", folder=self.folder) as sim:
            for change in changes:
                with self.subTest(change), self.assertRaises(reprise.Fault) as caught:
                    sim.reset(**change)
                self.assertTrue(str(caught.exception).isprintable(), str(caught.exception))
            with self.assertRaises(FileNotFoundError):  # a path is one, whatever it holds
                sim.reset(scenario=self.folder / "a\nb.lua")
            (self.folder / "a\nb.lua").write_text(DRIVEN)
            self.assertEqual(sim.reset(scenario=self.folder / "a\nb.lua").index, 1)
            with self.assertRaisesRegex(TypeError, r"^reset: no 'a\\nb'; there are town"):
                sim.reset(**{"a\nb": 1})
        for place in ("/tmp/a\nb", "a\nb:3"):
            with self.assertRaisesRegex(WireError, r"a\\nb.*: nobody is there"):
                reprise.Simulation(server=place)
        with reprise.MultiSimulation(("a\nb",), DRIVEN, folder=self.folder) as sim:
            with self.assertRaisesRegex(reprise.Fault, r"there is a driver for a\\x0ab$"):
                sim.reset()

    def test_what_is_no_message_ends_the_session_only(self):
        with Server("--socket", str(self.folder / "s")) as server:
            for bytes_said in (b"GET / HTTP/1.1\r\n\r\n", struct.pack("<II", 0xFFFFFFFF, 6), struct.pack("<II", 4, 99) + b"none"):
                with socket.socket(socket.AF_UNIX) as client:
                    client.connect(server.place)
                    client.sendall(bytes_said)
                    client.shutdown(socket.SHUT_WR)
                    client.settimeout(WAITING)
                    try:
                        while client.recv(4096):
                            pass
                    except ConnectionResetError:
                        pass
            with reprise.Simulation(server=server.place) as sim:
                self.assertEqual(sim.reset().index, 1)


class Ports(Case):
    def test_tcp_drives_as_a_socket_does(self):
        with Server("--port", "0") as server:
            self.assertRegex(server.place, r"^127\.0\.0\.1:\d+$")
            with reprise.Simulation(cars=5, seed=2, server=server.place) as sim:
                over_tcp = chains(sim, 10)
        with reprise.Simulation(cars=5, seed=2) as sim:
            self.assertEqual(over_tcp, chains(sim, 10))

    def test_several_drivers_need_a_socket_that_can_hand_over_theirs(self):
        with Server("--port", "0") as server:
            with reprise.MultiSimulation(("a", "b"), SEVERAL, server=server.place) as sim:
                with self.assertRaisesRegex(reprise.Fault, "Unix domain socket"):
                    sim.reset()

    def test_another_address_is_refused_without_listen(self):
        with Server("--port", "0") as server:
            port = int(server.place.split(":")[1])
            with socket.socket() as client:
                with self.assertRaises(ConnectionRefusedError):
                    client.connect(("127.0.0.2", port))  # another one of this machine's

    def test_listening_elsewhere_wants_a_token(self):
        code, said = reprise_program("serve", "--port", "0", "--listen", "127.0.0.2")
        self.assertEqual(code, 2)
        self.assertIn("--token-file", said)
        token = self.folder / "token"
        code, said = reprise_program("serve", "--port", "0", "--token-file", str(token))
        self.assertEqual(code, 2)
        self.assertIn(f"--token-file {token}: cannot be read: No such file or directory", said)
        token.write_text("long enough, but anybody's\n")
        token.chmod(0o640)
        code, said = reprise_program("serve", "--port", "0", "--token-file", str(token))
        self.assertEqual(code, 2)
        self.assertIn(f"--token-file {token}: other users may open it (mode 640): chmod 600 {token}", said)
        token.chmod(0o600)
        token.write_text("short\n")
        code, said = reprise_program("serve", "--port", "0", "--listen", "127.0.0.2", "--token-file", str(token))
        self.assertEqual(code, 2)
        self.assertIn("at least 16 characters", said)

    def test_only_the_right_token_opens(self):
        token = self.folder / "token"
        token.touch(0o600)
        token.write_text("a token of some length\n")
        with Server("--port", "0", "--listen", "127.0.0.2", "--token-file", str(token)) as server:
            for wrong in (None, "", "a token of some", "a token of some length ", "another token, as long"):
                with self.assertRaisesRegex(reprise.Fault, "wrong token"):
                    reprise.Simulation(server=server.place, token=wrong)
            with reprise.Simulation(server=server.place, token="a token of some length") as sim:
                self.assertEqual(sim.reset().index, 1)


if __name__ == "__main__":
    unittest.main()
