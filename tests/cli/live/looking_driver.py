"""looking_driver.py FOLDER [sensors]: as looking_driver.cpp. `sensors`: nothing else may be shown."""
import math
import sys

import numpy as np
import reprise

SHAPES = {"rgb": ((84, 84, 3), np.uint8), "depth": ((84, 84), np.float32), "semantic": ((84, 84), np.uint8),
          "instance": ((40, 60), np.uint16), "flow": ((40, 60, 2), np.float32), "events": ((40, 60, 2), np.uint8)}
folder, sensors_only = sys.argv[1], sys.argv[2:] == ["sensors"]


def decide(seen):
    for name, image in seen.images.items():
        shape, dtype = SHAPES[name] if name in SHAPES else ((40, 60, 3), np.uint8)
        assert image.shape == shape and image.dtype == dtype, (name, image.shape, image.dtype)
        assert not image.flags.owndata and not image.flags.writeable
        assert np.array_equal(image, seen.image(name), equal_nan=dtype == np.float32)
        with open(f"{folder}/{name}_{seen.index}.raw", "wb") as file:
            file.write(image.tobytes())
    assert ("side" in seen.images) == (seen.image("side") is not None)
    try:
        seen.image("back")
        raise SystemExit("there is no such sensor")
    except KeyError as error:
        assert "the vehicle carries rgb, depth, semantic, instance, flow, side, events" in str(error), error
    if sensors_only:
        assert len(seen.cars) == len(seen.walkers) == len(seen.signals) == 0
        assert len(seen.vehicles) == 1 and len(seen.tick.measurements) == 1
        assert math.isnan(seen.ego.gap_ahead)
        assert seen.ego.speed > -1
    else:
        assert len(seen.cars) > 0
    return reprise.Control(throttle=0.5, steer=0.125)


reprise.drive(decide)
