"""measuring_driver.py FOLDER: keeps what sensors that are no cameras measured: FOLDER/SENSOR_TICK.raw their bytes,
FOLDER/SENSOR_TICK.txt their columns and numbers. Drives in a slow curve into whatever is there."""
import sys

import numpy as np
import reprise

folder = sys.argv[1]
WIDE = ("gnss", "imu", "bumper", "lines")


def decide(seen):
    assert list(seen.images) == [name for name in seen.sensors if name == "front"], list(seen.images)
    for name, rows in seen.sensors.items():
        if name == "front":
            assert rows.shape == (40, 60, 3) and np.array_equal(rows, seen.image("front"))
            continue
        assert rows.ndim == 1 and rows.dtype.itemsize == len(rows.dtype.names) * (8 if name in WIDE else 4), rows.dtype
        assert not len(rows) or not (rows.flags.owndata or rows.flags.writeable)
        with open(f"{folder}/{name}_{seen.index}.raw", "wb") as file:
            file.write(rows.tobytes())
        with open(f"{folder}/{name}_{seen.index}.txt", "w") as file:
            print(*rows.dtype.names, file=file)
            for row in rows:
                print(*(float(value) for value in row), file=file)
    if "roof" in seen.sensors:
        roof = seen.sensors["roof"]
        assert reprise.xyz(roof).shape == (len(roof), 3) and reprise.xyz(roof).dtype == np.float32
        assert np.array_equal(reprise.xyz(roof)[:, 2], roof["z"]) and np.shares_memory(reprise.xyz(roof), roof)
    try:
        seen.image("roof")
        raise SystemExit("that is no camera")
    except KeyError as error:
        assert "'roof' is no camera: seen.sensors['roof']" in str(error), error
    return reprise.Control(throttle=1.0, steer=0.3)


reprise.drive(decide)
