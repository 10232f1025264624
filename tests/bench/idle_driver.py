"""The least that a driver in Python can do: it looks at its speed, and at a pixel of each camera, and answers.

usage: idle_driver.py [POLLING]
"""
import sys

import reprise


def decide(seen):
    for sensor in seen.run.sensors.rig:
        seen.image(sensor.name)[0, 0]
    return reprise.Control(throttle=0.4 if seen.ego.speed < 5 else 0.0)


reprise.drive(decide, **{"polling": float(polling) for polling in sys.argv[1:]})
