"""`import reprise` costs a driver no more than what it uses."""
import subprocess
import sys
import unittest

import reprise


class Loading(unittest.TestCase):
    def test_a_driver_loads_no_more_than_it_needs(self):
        script = (
            "import sys, reprise; assert 'numpy' not in sys.modules; reprise.Control, reprise.drive;"
            "print(*sorted(name for name in sys.modules if name.startswith('reprise')))"
        )
        said = subprocess.run([sys.executable, "-B", "-c", script], check=True, capture_output=True, text=True).stdout.split()
        for part in ("simulation", "trace", "way", "picture"):
            self.assertNotIn(f"reprise.{part}", said)

    def test_every_name_is_there_and_a_wrong_one_is_told(self):
        for name in reprise.__all__:
            self.assertIn(name, dir(reprise))
            self.assertIsNotNone(getattr(reprise, name))
        self.assertEqual(reprise.way.Way, reprise.Way)
        with self.assertRaisesRegex(AttributeError, "no attribute 'Cntrol'; there are Control, "):
            reprise.Cntrol  # noqa: B018


if __name__ == "__main__":
    unittest.main()
