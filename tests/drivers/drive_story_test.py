"""The stories of long_drives.py blame whom they should. drive_story_test.py REPRISE FOLDER"""
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import drive_story  # noqa: E402
from drive_story import Account  # noqa: E402
from reprise.trace import Trace  # noqa: E402

REPRISE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])


def account(name, body):
    """Of a scenario on the straight road with this in its run."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    script, trace = FOLDER / f"{name}.lua", FOLDER / f"{name}.mcap"
    script.write_text(f"return scenario '{name}' {{ town = 'straight', duration = 8, run = function()\n{body}\nwait(60) end }}")
    subprocess.run([REPRISE, "run", script, "-o", trace], check=True, capture_output=True)
    return Account(Trace(trace))


class Stories(unittest.TestCase):
    def test_who_drives_into_a_parked_car_could_have_stopped(self):
        told = account("rams", """
            local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual', lane = 'east_1', s = 40, speed = 12 }
            spawn{ model = 'van', driver = 'parked', ahead_of = ego, gap = 70 }
            ego:control{ throttle = 0.3 }""")  # fmt: skip
        self.assertEqual(told.avoidable, 1, told.stories)

    def test_who_stands_and_is_hit_could_not(self):
        told = account("is_hit", """
            local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual', lane = 'east_1', s = 100 }
            ego:control{ brake = 1 }
            local car = spawn{ model = 'sedan', driver = 'traffic', lane = 'east_1', s = 40, speed = 12 }
            car:hold_speed(12)""")  # fmt: skip
        self.assertGreaterEqual(told.counts["collision"], 1)
        self.assertEqual(told.avoidable, 0, told.stories)

    def test_who_stands_at_the_end_is_stuck_but_not_who_was_taken_out_standing(self):
        self.addCleanup(setattr, drive_story, "STUCK", drive_story.STUCK)
        drive_story.STUCK = 3
        body = """
            local car = spawn{{ model = 'sedan', driver = 'traffic', lane = 'east_1', s = 40 }}
            car:hold_speed(0)
            spawn{{ model = 'sedan', driver = 'manual', lane = 'east_1', s = 200 }}:control{{ brake = 1 }}
            wait(1.5)
            {}"""
        self.assertEqual(account("stands", body.format("")).stuck_cars, 2)
        self.assertEqual(account("is_gone", body.format("car:despawn()")).stuck_cars, 1)

    def test_the_kilometres_are_those_of_the_odometer(self):
        told = account("drives", "spawn{ name = 'ego', model = 'sedan', driver = 'autopilot', lane = 'east_1', s = 20, speed = 10 }")
        self.assertGreater(told.driven, 70)
        self.assertEqual(told.stories, [])
        self.assertAlmostEqual(told.mean_speed, told.driven / 8, delta=0.2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
