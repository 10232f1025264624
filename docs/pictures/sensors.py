"""sensors.py FOLDER TICK OUT: pictures of what each sensor saw, for sensors.sh: LiDAR and radar from above, boxes in space."""
import json
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "python"))
from reprise.dataset import read_png  # noqa: E402

FOLDER, TICK, OUT = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
HEIGHT, WIDTH, METRE = 480, 640, 6  # a metre is 6 pixels


def write(name, picture):
    (OUT / f"{name}.ppm").write_bytes(b"P6 %d %d 255\n" % (picture.shape[1], picture.shape[0]) + picture.astype(np.uint8).tobytes())


def dot(picture, x, y, colour, size):
    """Ahead is up, left is left; [m]."""
    row, column = (HEIGHT * 0.7 - x * METRE).astype(int), (WIDTH / 2 - y * METRE).astype(int)
    for down in range(size):
        for right in range(size):
            r, c = row + down, column + right
            inside = (r >= 0) & (r < HEIGHT) & (c >= 0) & (c < WIDTH)
            picture[r[inside], c[inside]] = colour[inside]


def above(name):
    points = np.load(FOLDER / name / f"{TICK}.npy")
    picture = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    if name == "lidar":
        height = np.clip((points[:, 2] + 2) / 4, 0, 1)[:, None]
        colour = np.array([60, 90, 255]) * (1 - height) + np.array([255, 220, 60]) * height
        dot(picture, points[:, 0], points[:, 1], colour, 2)
    else:  # red comes nearer, green goes away
        speed, azimuth, depth = points[:, 0], points[:, 1], points[:, 3]
        colour = np.where(speed[:, None] < -0.5, [255, 90, 60], np.where(speed[:, None] > 0.5, [60, 200, 90], [210, 210, 210]))
        dot(picture, depth * np.cos(azimuth), depth * np.sin(azimuth), colour, 5)
    return picture


def line(picture, start, end):
    count = int(np.abs(end - start).max()) + 2
    if count > 5000:
        return
    at = np.linspace(start, end, count).astype(int)
    inside = (at[:, 0] >= 0) & (at[:, 0] < WIDTH) & (at[:, 1] >= 0) & (at[:, 1] < HEIGHT)
    picture[at[inside, 1], at[inside, 0]] = [80, 255, 80]


def boxes():
    picture = read_png(FOLDER / "rgb" / f"{TICK}.png").copy()
    focal = WIDTH / 2
    for one in json.loads((FOLDER / "rgb/boxes" / f"{TICK}.json").read_text())["boxes"]:
        if one["pixels"] < 30:
            continue
        pose, size = np.array(one["camera_from_box"]), np.array(one["size"])
        signs = np.array([[a, b, c] for a in (-.5, .5) for b in (-.5, .5) for c in (-.5, .5)])  # fmt: skip
        corners = signs * size @ pose[:3, :3].T + pose[:3, 3]
        if corners[:, 2].min() < 0.5:
            continue
        seen = corners[:, :2] / corners[:, 2:] * focal + [WIDTH / 2, HEIGHT / 2]
        for i in range(8):
            for k in range(i):
                if np.abs(signs[i] - signs[k]).sum() == 1:
                    line(picture, seen[i], seen[k])
    return picture


write("rgb", read_png(FOLDER / "rgb" / f"{TICK}.png"))
for kind in ("depth", "semantic", "instance", "normals", "flow"):
    write(kind, read_png(FOLDER / kind / "view" / f"{TICK}.png"))
for kind in ("lidar", "radar"):
    write(kind, above(kind))
write("boxes", boxes())
