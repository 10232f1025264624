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
        said("dataset", "a.mcap", "-o", "set", *self.words)  # the index holds digests of what is there
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


class Points(unittest.TestCase):
    """A rig with two LiDARs and a radar in a moving car: sweeps roll, and the calibration is of the tick."""

    @classmethod
    def setUpClass(cls):
        view = {"size": [480, 320], "position": [1.5, 0.2, 1.4], "yaw_deg": 4, "pitch_deg": -3}
        sweep = {"range": 80, "points_per_second": 400000, "range_accuracy": 0}
        cls.rig = [
            {"name": "front", **view}, {"name": "far", "type": "depth", **view},
            {"name": "roof", "type": "lidar", "position": [0.9, -0.1, 1.9], "yaw_deg": 10, "pitch_deg": -2, "roll_deg": 1, "attributes": sweep},
            {"name": "mast", "type": "lidar", "position": [0.2, 0, 2.2], "attributes": {"channels": 4}},
            {"name": "exact", "type": "semantic_lidar", "position": [0.9, 0, 1.9]},
            {"name": "nose", "type": "radar", "position": [3.7, 0, 0.6]}]  # fmt: skip
        WORK.mkdir(parents=True, exist_ok=True)
        subprocess.run(["rm", "-rf", WORK / "points", WORK / "points_coco", WORK / "swept"], check=True)
        (WORK / "points.json").write_text(json.dumps({"sensors": cls.rig}))
        said("run", SOURCE / "scenarios/free_drive.lua", "--cars", 40, "--for", 8, "-o", "p.mcap")
        cls.words = ["--weathers", "clear_noon,hard_rain_noon", "--rig", "points.json", "--ticks", "6s..8s", "--every", "1s", "--split", "train:0.5"]
        said("dataset", "p.mcap", "-o", "points", *cls.words)

    def test_points_and_depth_of_one_surface_agree_through_the_calibration(self):
        agree = total = 0
        for path in sorted((WORK / "points/labels/calib").iterdir()):
            lines = dict(line.split(": ") for line in path.read_text().splitlines())
            p2, to_camera, from_imu = (np.array(lines[key].split(), float).reshape(3, 4) for key in ("P2", "Tr_velo_to_cam", "Tr_imu_to_velo"))
            points = np.fromfile(WORK / f"points/clear_noon/training/velodyne/{path.stem}.bin", np.float32).reshape(-1, 4)
            self.assertTrue((points[:, 3] >= 0).all() and (points[:, 3] <= 1).all() and len(points) > 5000)
            # The IMU's frame is the carrier's, in which the rig says where the LiDAR is.
            np.testing.assert_allclose(from_imu[:, :3] @ [0.9, -0.1, 1.9] + from_imu[:, 3], 0, atol=1e-9)
            seen = to_camera @ np.vstack([points[:, :3].T.astype(float), np.ones(len(points))])
            seen = seen[:, seen[2] > 0.5]
            pixel = p2 @ np.vstack([seen, np.ones(seen.shape[1])])
            u, v = np.floor(pixel[:2] / pixel[2]).astype(int)
            inside = (u > 0) & (v > 0) & (u < 479) & (v < 319)
            u, v, z = u[inside], v[inside], seen[2, inside]
            depth = read_png(WORK / f"points/labels/far/{path.stem}.png") / 256
            around = np.stack([depth[v + dy, u + dx] for dy in (-1, 0, 1) for dx in (-1, 0, 1)])
            room = 0.02 + 0.002 * z
            agree += ((z > around.min(0) - room) & (z < around.max(0) + room)).sum()
            total += len(z)
        # The rest sees past an edge that hides it from the camera, or others that moved during the sweep.
        self.assertGreater(total, 1000)
        self.assertGreater(agree / total, 0.97)

    def test_only_what_a_weather_changes_is_there_under_each(self):
        noon, rain = (reprise.Dataset(WORK / "points", weather=one) for one in ("clear_noon", "hard_rain_noon"))
        for dry, wet in zip(noon, rain):
            self.assertEqual([dry[name].shape[1] for name in ("roof", "mast", "exact", "nose")], [4, 7, 8, 6])
            self.assertFalse(np.array_equal(dry["roof"], wet["roof"]))
            np.testing.assert_array_equal(dry["exact"], wet["exact"])
            np.testing.assert_array_equal(dry["far"], wet["far"])

    def test_points_are_those_of_render_where_nothing_rolls(self):
        rig = [{**one, "attributes": {**one.get("attributes", {}), "rolling": 0}} if "lidar" in one.get("type", "") else one for one in self.rig]
        (WORK / "still.json").write_text(json.dumps({"sensors": rig}))
        words = [word.replace("points.json", "still.json") for word in self.words]
        said("dataset", "p.mcap", "-o", "points_coco", "--format", "coco", *words)
        said("render", "p.mcap", "-o", "swept", "--weather", "hard_rain_noon", "--rig", "still.json", "--ticks", "6s..8s", "--every", "1s", "--points", "npy")
        for item in reprise.Dataset(WORK / "points_coco", weather="hard_rain_noon"):
            for name in ("roof", "mast", "exact", "nose"):
                np.testing.assert_array_equal(item[name], np.load(WORK / f"swept/{name}/{item['tick']:06}.npy"))

    def test_points_that_are_gone_are_made_again_and_others_left_alone(self):
        before = {path: path.read_bytes() for path in (WORK / "points").rglob("*") if path.is_file()}
        for path in ("hard_rain_noon/training/velodyne/000001.bin", "labels/exact/000000.npy", "clear_noon/training/nose/000002.npy"):
            (WORK / "points" / path).unlink()
        said("dataset", "p.mcap", "-o", "points", *self.words)
        self.assertEqual(before, {path: path.read_bytes() for path in (WORK / "points").rglob("*") if path.is_file()})

    def test_check_makes_all_again_and_names_the_file_that_is_not(self):
        check = lambda *words: subprocess.run([PROGRAM, "dataset", *words, "--check", "points"], capture_output=True, text=True, cwd=WORK)
        index = json.loads((WORK / "points/dataset.json").read_text())
        there = {str(path.relative_to(WORK / "points")) for path in (WORK / "points").rglob("*") if path.is_file()}
        linked = {path for path in there if any(part in ("calib", "label_2", "ImageSets") for part in pathlib.Path(path).parts[1:-1]) and not path.startswith("labels")}
        self.assertEqual({one["path"] for one in index["files"]}, there - linked - {"dataset.json"})
        # Neither the rig's file nor threads nor the place of the trace matter.
        (WORK / "points.json").rename(WORK / "away.json")
        (WORK / "p.mcap").rename(WORK / "moved.mcap")
        same = check("moved.mcap", "--threads", "1")
        gone = check()
        (WORK / "moved.mcap").rename(WORK / "p.mcap")
        (WORK / "away.json").rename(WORK / "points.json")
        self.assertEqual((same.returncode, same.stdout), (0, f"points: all {len(index['files'])} files were made again, byte for byte\n"), same.stderr)
        self.assertEqual((gone.returncode, gone.stderr.count("\n")), (2, 1), gone.stderr)
        path = WORK / "points/hard_rain_noon/training/velodyne/000001.bin"
        kept = path.read_bytes()
        path.write_bytes(kept[:-16])
        changed = check()
        path.write_bytes(kept)
        self.assertEqual((changed.returncode, changed.stdout), (1, f"points/{path.relative_to(WORK / 'points')}: was changed since it was made\npoints: 1 of {len(index['files'])} files differ\n"))
        text = (WORK / "points/dataset.json").read_text()
        (WORK / "points/dataset.json").write_text(text.replace('"complete": true', '"complete": false'))
        half = check()
        (WORK / "points/dataset.json").write_text(text)
        self.assertEqual((half.returncode, half.stderr), (2, "reprise: points/dataset.json: is not complete; the command that makes it goes on where it was\n"))

    def test_rigs_without_a_place_in_data_sets_are_refused_in_a_line(self):
        imu = {"name": "motion", "type": "imu"}
        for rig, why in (([self.rig[0], imu], "sensor 'motion': a data set holds what cameras, LiDARs and radars see; reprise render --rig writes what a imu measures"),
                         ([self.rig[2]], "a data set needs a camera of type rgb"),
                         ([self.rig[0], {**self.rig[2], "actor": "world"}], "'roof' and 'front' have carriers of their own, and no calibration takes the points of one to the other")):  # fmt: skip
            (WORK / "odd.json").write_text(json.dumps({"sensors": rig}))
            odd = subprocess.run([PROGRAM, "dataset", "p.mcap", "-o", "odd", "--rig", "odd.json"], capture_output=True, text=True, cwd=WORK)
            self.assertEqual((odd.returncode, odd.stderr), (2, f"reprise: odd.json: {why}\n"))
            self.assertFalse((WORK / "odd").exists())


unittest.main()
