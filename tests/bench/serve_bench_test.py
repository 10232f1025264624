#!/usr/bin/env python3
"""serve_bench.py's environments: one that is gone is told, and nobody waits for it."""
import os
import unittest

import serve_bench


def steps(pipe, seed, *_):
    """As environment() does, without a simulation; the one with seed 1 is killed by its first order."""
    for count in iter(pipe.recv, 0):
        if seed == 1:
            os._exit(7)
        pipe.send(count / 1000)


class Environments(unittest.TestCase):
    def test_step_as_often_as_they_are_asked_to(self):
        with serve_bench.Environments(steps, ((), ())) as environments:
            self.assertEqual(environments.rate((0,), 50), 1000)
        self.assertEqual([child.exitcode for child in environments.children], [0, 0])

    def test_one_that_ends_is_an_error_and_the_others_end_as_well(self):
        with self.assertRaisesRegex(ChildProcessError, "environment 1 ended with exit code 7"):
            with serve_bench.Environments(steps, ((), (), ())) as environments:
                environments.rate((0, 1, 2), 50)
        self.assertEqual([child.exitcode for child in environments.children], [0, 7, 0])


if __name__ == "__main__":
    unittest.main()
