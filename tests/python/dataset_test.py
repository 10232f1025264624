"""What the loader says of a data set is what its files, and `reprise render`, say.

usage: dataset_test.py REPRISE WORK
"""
import json
import pathlib
import subprocess
import sys
import unittest
import zlib
import struct

import numpy as np
import reprise
from reprise.dataset import read_png

PROGRAM, WORK = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))
SOURCE = pathlib.Path(__file__).parents[2]
RIG = {"sensors": [{"name": "front", "size": [96, 64]}, {"name": "back", "yaw_deg": 180, "size": [64, 48]},
                   {"name": "far", "type": "depth", "size": [96, 64]}]}  # fmt: skip


def said(*words):
    subprocess.run([PROGRAM, *map(str, words)], check=True, capture_output=True, cwd=WORK)


def png(picture, filters):
    """A PNG whose rows have these filters, made byte by byte as the format's text says it."""
    height, width, unit = picture.shape
    text = b""
    for y in range(height):
        text += bytes([filters[y]])
        for i in range(width * unit):
            x, c = divmod(i, unit)
            a = int(picture[y, x - 1, c]) if x else 0
            b = int(picture[y - 1, x, c]) if y else 0
            d = int(picture[y - 1, x - 1, c]) if x and y else 0
            p = a + b - d
            nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - d), 2, d))[2]
            text += bytes([(int(picture[y, x, c]) - [0, a, b, (a + b) // 2, nearest][filters[y]]) % 256])
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", width, height, 8, 2 if unit == 3 else 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(text)) + chunk(b"IEND", b"")


class Datasets(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        WORK.mkdir(parents=True, exist_ok=True)
        subprocess.run(["rm", "-rf", WORK / "set", WORK / "coco", WORK / "seen"], check=True)
        (WORK / "rig.json").write_text(json.dumps(RIG))
        said("run", SOURCE / "scenarios/free_drive.lua", "--cars", 40, "--for", 4, "-o", "a.mcap")
        cls.words = ["--weathers", "clear_noon,clear_night", "--rig", "rig.json", "--every", "1s", "--split", "train:0.5"]
        said("dataset", "a.mcap", "-o", "set", *cls.words)
        said("dataset", "a.mcap", "-o", "coco", "--format", "coco", *cls.words)
        said("render", "a.mcap", "-o", "seen", "--weather", "clear_night", "--rig", "rig.json", "--ticks", "61t", "--npy", "--boxes")

    def test_pictures_and_boxes_are_those_of_render(self):
        for folder in ("set", "coco"):
            night = reprise.Dataset(WORK / folder, weather="clear_night", split="val")
            self.assertEqual([one["tick"] for one in night], [41, 61], folder)
            last = night[1]
            for name in ("front", "back"):
                np.testing.assert_array_equal(last[name], read_png(WORK / f"seen/{name}/000061.png"))
                boxes = json.loads((WORK / f"seen/{name}/boxes/000061.json").read_text())["boxes"]
                self.assertEqual(last[name + "_boxes"], boxes)
            metres = np.load(WORK / "seen/far/000061.npy")
            np.testing.assert_allclose(last["far"][metres < 200] / 256, metres[metres < 200], atol=1 / 500)

    def test_weathers_have_other_pictures_and_the_same_labels(self):
        noon, night = (reprise.Dataset(WORK / "set", weather=one) for one in ("clear_noon", "clear_night"))
        self.assertEqual(len(noon), 4)
        for day, dark in zip(noon, night):
            self.assertTrue((day["front"] != dark["front"]).any())
            np.testing.assert_array_equal(day["far"], dark["far"])
            self.assertEqual(day["front_boxes"], dark["front_boxes"])

    def test_masks_of_coco_have_the_pixels_of_their_boxes(self):
        masks = 0
        for split in ("train", "val"):
            coco = json.loads((WORK / f"coco/annotations/instances_{split}.json").read_text())
            sizes = {one["id"]: (one["height"], one["width"]) for one in coco["images"]}
            for one in coco["annotations"]:
                height, width = sizes[one["image_id"]]
                counts = one["segmentation"]["counts"]
                self.assertEqual(sum(counts), height * width)
                flat = np.repeat(np.arange(len(counts)) % 2, counts)
                y, x = np.nonzero(flat.reshape(width, height).T)
                self.assertEqual(len(y), one["area"])
                self.assertEqual([x.min(), y.min(), x.max() + 1 - x.min(), y.max() + 1 - y.min()], one["bbox"])
                masks += 1
        self.assertGreater(masks, 5)

    def test_labels_of_kitti_project_into_their_boxes(self):
        lines = 0
        for path in sorted((WORK / "set/labels/label_2").iterdir()):
            calibration = (WORK / "set/labels/calib" / path.name).read_text().splitlines()
            camera = np.array([float(one) for one in calibration[2].split()[1:]]).reshape(3, 4)
            for line in path.read_text().splitlines():
                kind, *numbers = line.split()
                cut, _, _, left, top, right, bottom, h, w, l, x, y, z, yaw = map(float, numbers)
                if cut > 0:
                    continue
                corners = np.array([[a * l, b * h, c * w] for a in (-.5, .5) for b in (-1, 0) for c in (-.5, .5)])  # fmt: skip
                turn = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
                seen = camera @ np.vstack([turn @ corners.T + [[x], [y], [z]], np.ones(8)])
                seen = seen[:2] / seen[2]
                # On slopes KITTI's upright box is not quite ours.
                room = 2
                self.assertTrue(seen[0].min() <= left + room and right <= seen[0].max() + room, line)
                self.assertTrue(seen[1].min() <= top + room and bottom <= seen[1].max() + room, line)
                lines += 1
        self.assertGreater(lines, 5)

    def test_what_is_there_is_left_alone_and_what_is_not_is_made_again(self):
        before = {path: path.read_bytes() for path in (WORK / "set").rglob("*") if path.is_file()}
        gone = [WORK / "set/clear_night/training/image_3/000002.png", WORK / "set/labels/label_2/000001.txt", WORK / "set/labels/far/000003.png"]
        for path in gone:
            path.unlink()
        kept = WORK / "set/clear_noon/training/image_2/000000.png"
        kept.write_bytes(b"of somebody else")
        said("dataset", "a.mcap", "-o", "set", *self.words)
        self.assertEqual(kept.read_bytes(), b"of somebody else")
        kept.write_bytes(before[kept])
        self.assertEqual(before, {path: path.read_bytes() for path in (WORK / "set").rglob("*") if path.is_file()})
        other = subprocess.run([PROGRAM, "dataset", "a.mcap", "-o", "set"], capture_output=True, text=True, cwd=WORK)
        self.assertEqual(other.returncode, 2)
        self.assertIn("set/dataset.json: another data set lies there: 'weathers' differs", other.stderr)

    def test_every_filter_of_png_is_taken_back(self):
        draw = np.random.default_rng(7)
        for unit in (1, 3):
            picture = draw.integers(0, 256, (15, 9, unit), dtype=np.uint8)
            path = WORK / "drawn.png"
            path.write_bytes(png(picture, [y % 5 for y in range(15)]))
            np.testing.assert_array_equal(read_png(path).reshape(picture.shape), picture)

    def test_mistakes_name_what_there_is(self):
        with self.assertRaisesRegex(KeyError, "no weather 'fog'; there are clear_noon, clear_night"):
            reprise.Dataset(WORK / "set", weather="fog")
        with self.assertRaisesRegex(KeyError, "no split 'test'; there are train, val"):
            reprise.Dataset(WORK / "set", split="test")


unittest.main()
