"""What the loader says of a data set is what its files, and `reprise render`, say.

usage: dataset_test.py REPRISE WORK
"""
import importlib.util
import json
import pathlib
import subprocess
import sys
import unittest
import zlib
import struct

import numpy as np
import reprise
import reprise.dataset
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


def homogeneous(points):
    return np.vstack([points.T.astype(float), np.ones(len(points))])


def agreeing(seen, camera, depth):
    """How many points in a camera's frame are as far as a depth picture says, within 2 cm and 0.2 %, and how many it shows."""
    height, width = depth.shape
    seen = seen[:, seen[2] > 0.5]
    pixel = camera @ np.vstack([seen, np.ones(seen.shape[1])])
    u, v = np.floor(pixel[:2] / pixel[2]).astype(int)
    inside = (u > 0) & (v > 0) & (u < width - 1) & (v < height - 1)
    u, v, z = u[inside], v[inside], seen[2, inside]
    around = np.stack([depth[v + dy, u + dx] for dy in (-1, 0, 1) for dx in (-1, 0, 1)])
    room = 0.02 + 0.002 * z
    return np.array([((z > around.min(0) - room) & (z < around.max(0) + room)).sum(), len(z)])


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

    def test_one_that_was_stopped_is_not_opened_as_if_it_were_whole(self):
        index = json.loads((WORK / "set/dataset.json").read_text())
        (WORK / "stopped").mkdir(exist_ok=True)
        (WORK / "stopped/dataset.json").write_text(json.dumps({**index, "complete": False}))
        with self.assertRaisesRegex(ValueError, "stopped/dataset.json: is not complete; the command that makes it goes on"):
            reprise.Dataset(WORK / "stopped")

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
        agree = np.zeros(2)
        for path in sorted((WORK / "points/labels/calib").iterdir()):
            lines = dict(line.split(": ") for line in path.read_text().splitlines())
            p2, to_camera, from_imu = (np.array(lines[key].split(), float).reshape(3, 4) for key in ("P2", "Tr_velo_to_cam", "Tr_imu_to_velo"))
            points = np.fromfile(WORK / f"points/clear_noon/training/velodyne/{path.stem}.bin", np.float32).reshape(-1, 4)
            self.assertTrue((points[:, 3] >= 0).all() and (points[:, 3] <= 1).all() and len(points) > 5000)
            # The IMU's frame is the carrier's, in which the rig says where the LiDAR is.
            np.testing.assert_allclose(from_imu[:, :3] @ [0.9, -0.1, 1.9] + from_imu[:, 3], 0, atol=1e-9)
            depth = read_png(WORK / f"points/labels/far/{path.stem}.png") / 256
            agree += agreeing(to_camera @ homogeneous(points[:, :3]), p2, depth)
        # The rest sees past an edge that hides it from the camera, or others that moved during the sweep.
        self.assertGreater(agree[1], 1000)
        self.assertGreater(agree[0] / agree[1], 0.97)

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
        self.assertEqual((changed.returncode, changed.stdout), (1, f"points/{path.relative_to(WORK / 'points')}: was changed since it was made\npoints: 1 of {len(index['files'])} files differs\n"))
        text = (WORK / "points/dataset.json").read_text()
        (WORK / "points/dataset.json").write_text(text.replace('"complete": true', '"complete": false'))
        half = check()
        (WORK / "points/dataset.json").write_text(text)
        self.assertEqual((half.returncode, half.stderr), (2, "reprise: points/dataset.json: is not complete; the command that makes it goes on where it was\n"))

    def test_rigs_without_a_place_in_data_sets_are_refused_in_a_line(self):
        imu = {"name": "motion", "type": "imu"}
        for rig, why in (([self.rig[0], imu], "sensor 'motion': a data set holds what cameras, LiDARs and radars see; reprise render --rig writes what sensors of type imu measure"),
                         ([self.rig[2]], "a data set needs a camera of type rgb"),
                         ([self.rig[0], {**self.rig[2], "actor": "world"}], "'roof' and 'front' have carriers of their own, and no calibration takes the points of one to the other")):  # fmt: skip
            (WORK / "odd.json").write_text(json.dumps({"sensors": rig}))
            odd = subprocess.run([PROGRAM, "dataset", "p.mcap", "-o", "odd", "--rig", "odd.json"], capture_output=True, text=True, cwd=WORK)
            self.assertEqual((odd.returncode, odd.stderr), (2, f"reprise: odd.json: {why}\n"))
            self.assertFalse((WORK / "odd").exists())


# What devkits read of each table; a name after ">" is the table that a token is of, "" stands for none.
SCHEMA = {
    "category": {"name": str, "description": str}, "attribute": {"name": str, "description": str},
    "visibility": {"level": str, "description": str}, "sensor": {"channel": str, "modality": str},
    "instance": {"category_token": ">category", "nbr_annotations": int, "first_annotation_token": ">sample_annotation", "last_annotation_token": ">sample_annotation"},
    "calibrated_sensor": {"sensor_token": ">sensor", "translation": [float] * 3, "rotation": [float] * 4, "camera_intrinsic": list},
    "ego_pose": {"timestamp": int, "translation": [float] * 3, "rotation": [float] * 4},
    "log": {"logfile": str, "vehicle": str, "date_captured": str, "location": str},
    "scene": {"name": str, "description": str, "log_token": ">log", "nbr_samples": int, "first_sample_token": ">sample", "last_sample_token": ">sample"},
    "sample": {"timestamp": int, "scene_token": ">scene", "prev": ">sample", "next": ">sample"},
    "sample_data": {"sample_token": ">sample", "ego_pose_token": ">ego_pose", "calibrated_sensor_token": ">calibrated_sensor", "filename": str, "fileformat": str,
                    "width": int, "height": int, "timestamp": int, "is_key_frame": bool, "prev": ">sample_data", "next": ">sample_data"},
    "sample_annotation": {"sample_token": ">sample", "instance_token": ">instance", "attribute_tokens": list, "visibility_token": ">visibility", "translation": [float] * 3,
                          "size": [float] * 3, "rotation": [float] * 4, "num_lidar_pts": int, "num_radar_pts": int, "prev": ">sample_annotation", "next": ">sample_annotation"},
    "map": {"log_tokens": list, "category": str, "filename": str}}  # fmt: skip


def pose(row):
    """Of a row with translation and rotation (w, x, y, z): 4 x 4."""
    w, x, y, z = row["rotation"]
    made = np.eye(4)
    made[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]  # fmt: skip
    made[:3, 3] = row["translation"]
    return made


class Nuscenes(unittest.TestCase):
    """Two drives under two weathers: what the tables say of them, by their own links."""

    @classmethod
    def setUpClass(cls):
        front = {"size": [320, 180], "position": [1.5, 0, 1.5], "fov_deg": 70}
        cls.rig = [
            {"name": "front", **front}, {"name": "far", "type": "depth", **front}, {"name": "cam_back", **front, "yaw_deg": 180},
            {"name": "roof", "type": "lidar", "position": [0.9, 0, 1.9], "yaw_deg": 5, "pitch_deg": 1, "attributes": {"range": 80, "points_per_second": 640000, "range_accuracy": 0}},
            {"name": "exact", "type": "semantic_lidar", "position": [0.9, 0, 1.9]}, {"name": "front_right", "type": "radar", "position": [3.7, 0, 0.6]}]  # fmt: skip
        WORK.mkdir(parents=True, exist_ok=True)
        subprocess.run(["rm", "-rf", WORK / "nu"], check=True)
        (WORK / "nu.json").write_text(json.dumps({"sensors": cls.rig}))
        said("run", SOURCE / "scenarios/free_drive.lua", "--cars", 60, "--seed", 3, "--for", 6, "-o", "c.mcap")
        said("run", SOURCE / "scenarios/child_runs_out.lua", "-o", "d.mcap")
        cls.words = ["dataset", "c.mcap", "d.mcap", "-o", "nu", "--format", "nuscenes", "--weathers", "clear_noon,hard_rain_noon", "--rig", "nu.json", "--every", "1s", "--split", "train:0.5"]
        said(*cls.words)
        cls.noon, cls.rain = (cls.tables(one) for one in ("clear_noon", "hard_rain_noon"))

    @staticmethod
    def tables(weather):
        """By name and token."""
        folder = WORK / "nu" / weather / "v1.0-mini"
        return {name: {row["token"]: row for row in json.loads((folder / f"{name}.json").read_text())} for name in SCHEMA}

    def test_tables_have_the_fields_that_devkits_read_and_every_token_is_there(self):
        for tables in (self.noon, self.rain):
            for name, fields in SCHEMA.items():
                self.assertGreater(len(tables[name]), 0, name)
                for row in tables[name].values():
                    self.assertEqual(set(row) - {"index"}, {"token", *fields})
                    for key, kind in fields.items():
                        value = row[key]
                        if isinstance(kind, str):
                            self.assertTrue(value in tables[kind[1:]] or (value == "" and key in ("prev", "next")), (name, key, value))
                        elif isinstance(kind, list):
                            self.assertEqual([type(one) for one in value], kind, (name, key))
                        else:
                            self.assertIs(type(value), kind, (name, key))
                    if row.get("next"):
                        self.assertEqual(tables[name][row["next"]]["prev"], row["token"])
                        self.assertGreater(tables[name][row["next"]].get("timestamp", 1), row.get("timestamp", 0))
            for row in tables["sample_annotation"].values():
                self.assertTrue(all(one in tables["attribute"] for one in row["attribute_tokens"]))
            for row in tables["instance"].values():
                chain = [row["first_annotation_token"]]
                while tables["sample_annotation"][chain[-1]]["next"]:
                    chain.append(tables["sample_annotation"][chain[-1]]["next"])
                self.assertEqual((chain[-1], len(chain)), (row["last_annotation_token"], row["nbr_annotations"]))
            for row in tables["map"].values():
                self.assertTrue(set(row["log_tokens"]) <= set(tables["log"]))
            self.assertEqual({one for row in tables["map"].values() for one in row["log_tokens"]}, set(tables["log"]))
            self.assertEqual(sorted(row["channel"] for row in tables["sensor"].values()), ["CAM_BACK", "CAM_FRONT", "LIDAR_TOP", "RADAR_FRONT_RIGHT"])

    def test_tokens_and_labels_are_the_same_under_every_weather(self):
        for name in SCHEMA:
            for token, row in self.noon[name].items():
                other = self.rain[name][token]
                unlike = {key for key in row if row[key] != other[key]}
                self.assertTrue(unlike <= {"num_lidar_pts", "num_radar_pts", "description"}, (name, unlike))
        self.assertNotEqual([row["num_lidar_pts"] for row in self.noon["sample_annotation"].values()], [row["num_lidar_pts"] for row in self.rain["sample_annotation"].values()])

    def data(self, tables, weather):
        """For each sample by channel: what to read, the pose of the car and the pose in the car; and the intrinsics."""
        samples = {token: {} for token in tables["sample"]}
        for row in tables["sample_data"].values():
            mount = tables["calibrated_sensor"][row["calibrated_sensor_token"]]
            channel = tables["sensor"][mount["sensor_token"]]["channel"]
            samples[row["sample_token"]][channel] = (WORK / "nu" / weather / row["filename"], pose(tables["ego_pose"][row["ego_pose_token"]]), pose(mount), mount["camera_intrinsic"], row)
        return samples

    def test_points_agree_with_depth_and_cameras_stand_where_their_boxes_say(self):
        index = json.loads((WORK / "nu/dataset.json").read_text())
        agree = np.zeros(2)
        for number, sensors in enumerate(self.data(self.noon, "clear_noon").values()):
            path, car, lidar, _, _ = sensors["LIDAR_TOP"]
            picture, _, camera, intrinsic, row = sensors["CAM_FRONT"]
            points = np.fromfile(path, np.float32).reshape(-1, 5)
            self.assertTrue((points[:, 3] >= 0).all() and (points[:, 3] <= 255).all() and set(points[:, 4]) <= set(range(32)))
            # Rings count from the lowest: those of the ground near by.
            self.assertLess(points[points[:, 4] == 0][:, 2].mean(), points[points[:, 4] == 20][:, 2].mean())
            depth = read_png(WORK / f"nu/labels/far/{picture.name}") / 256
            self.assertEqual(depth.shape, (row["height"], row["width"]))
            agree += agreeing((np.linalg.inv(camera) @ lidar @ homogeneous(points[:, :3]))[:3], np.hstack([intrinsic, [[0], [0], [0]]]), depth)
            boxes = json.loads((WORK / f"nu/labels/boxes_front/{picture.stem}.json").read_text())
            origin = np.eye(4)
            origin[:2, 3] = index["traces"][index["frames"][number]["trace"]]["origin"]
            np.testing.assert_allclose(origin @ car @ camera, boxes["world_from_camera"], atol=1e-6)
        self.assertGreater(agree[1], 1000)
        self.assertGreater(agree[0] / agree[1], 0.97)

    def test_annotations_are_the_boxes_of_the_cameras_and_hold_the_points_that_they_count(self):
        found = set()
        for tables, weather in ((self.noon, "clear_noon"), (self.rain, "hard_rain_noon")):
            samples = self.data(tables, weather)
            for row in tables["sample_annotation"].values():
                sensors = samples[row["sample_token"]]
                into_box = np.linalg.inv(pose(row))
                width, length, height = row["size"]
                for channel, key in (("LIDAR_TOP", "num_lidar_pts"), ("RADAR_FRONT_RIGHT", "num_radar_pts")):
                    path, car, mount, _, _ = sensors[channel]
                    points = reprise.dataset.read_points(path)
                    places = np.stack([points[axis] for axis in "xyz"], 1) if channel.startswith("RADAR") else points[:, :3]
                    inside = np.abs(into_box @ car @ mount @ homogeneous(places))[:3] <= np.array([[length], [width], [height]]) / 2
                    self.assertEqual(inside.all(0).sum(), row[key])
                    found.add((channel, row[key] > 0))
                picture, car, camera, _, _ = sensors["CAM_FRONT"]
                boxes = json.loads((WORK / f"nu/labels/boxes_front/{picture.stem}.json").read_text())["boxes"]
                middle = (np.linalg.inv(car @ camera) @ pose(row))[:3, 3]
                for box in boxes:
                    there = np.array(box["camera_from_box"])
                    if np.abs(there[:3, 3] - middle).max() < 1e-3:
                        np.testing.assert_allclose(box["size"], [length, width, height])
                        np.testing.assert_allclose(there[:3, :3], (np.linalg.inv(car @ camera) @ pose(row))[:3, :3], atol=1e-6)
                        found.add("a box")
        self.assertEqual(found, {("LIDAR_TOP", True), ("LIDAR_TOP", False), ("RADAR_FRONT_RIGHT", True), ("RADAR_FRONT_RIGHT", False), "a box"})
        # The town's child and van, and whom the LiDAR alone sees behind a corner.
        names = {self.noon["category"][one["category_token"]]["name"] for one in self.noon["instance"].values()}
        self.assertTrue({"human.pedestrian.child", "vehicle.car"} <= names, names)
        beams = sum(len(json.loads(path.read_text())["beams"]) for path in (WORK / "nu/labels/beams").iterdir())
        self.assertGreater(beams, 0)

    def test_velocities_follow_from_neighbours_and_fit_the_attributes(self):
        rows, seen = self.noon["sample_annotation"], set()
        for row in rows.values():
            if not row["next"]:
                continue
            after = rows[row["next"]]
            time = (self.noon["sample"][after["sample_token"]]["timestamp"] - self.noon["sample"][row["sample_token"]]["timestamp"]) * 1e-6
            self.assertAlmostEqual(time, max(1, round(time)))  # whom nobody sees for a while is not annotated meanwhile
            way = np.linalg.norm(np.subtract(after["translation"], row["translation"])) / time
            does = [self.noon["attribute"][one]["name"] for one in row["attribute_tokens"] + after["attribute_tokens"]]
            if does == ["vehicle.parked"] * 2:
                self.assertLess(way, 0.01)
            if does == ["vehicle.moving"] * 2:
                self.assertTrue(0.05 < way < 30)
            seen.add(does[0])
        self.assertTrue({"vehicle.moving", "vehicle.parked"} <= seen, seen)

    def test_radars_say_which_detections_move_over_the_ground(self):
        standing = 0
        for sensors in self.data(self.noon, "clear_noon").values():
            points = reprise.dataset.read_points(sensors["RADAR_FRONT_RIGHT"][0])
            over_ground = np.hypot(points["vx_comp"], points["vy_comp"])
            np.testing.assert_array_equal(points["dyn_prop"] == 1, over_ground < 0.5)
            standing += (points["dyn_prop"] == 1).sum()
        self.assertGreater(standing, 50)

    def test_all_is_made_again_and_a_stopped_one_goes_on(self):
        check = lambda: subprocess.run([PROGRAM, "dataset", "--check", "nu"], capture_output=True, text=True, cwd=WORK)
        same = check()
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)
        for path in ("labels/beams/000001.json", "hard_rain_noon/samples/LIDAR_TOP/000002.pcd.bin", "clear_noon/samples/CAM_FRONT/000003.png", "clear_noon/v1.0-mini/sample.json"):
            (WORK / "nu" / path).unlink()
        self.assertIn("is no longer there", check().stdout)
        said(*self.words)
        self.assertEqual(check().returncode, 0)

    def test_a_lidar_alone_annotates_who_stands_parked_in_the_town(self):
        subprocess.run(["rm", "-rf", WORK / "alone"], check=True)
        (WORK / "alone.json").write_text(json.dumps({"sensors": [self.rig[3]]}))
        said(*[{"nu": "alone", "nu.json": "alone.json", "clear_noon,hard_rain_noon": "clear_noon"}.get(one, one) for one in self.words])
        alone = {row["token"]: row for row in json.loads((WORK / "alone/clear_noon/v1.0-mini/sample_annotation.json").read_text())}
        parked = 0
        # Whom cameras see as well is the same row but for how well they do; whom the LiDAR met has points.
        for token, row in alone.items():
            self.assertEqual(row["visibility_token"], "1")
            other = self.noon["sample_annotation"][token]
            for key in ("sample_token", "instance_token", "attribute_tokens", "translation", "size", "rotation", "num_lidar_pts"):
                self.assertEqual(row[key], other[key])
        for token, row in self.noon["sample_annotation"].items():
            if row["num_lidar_pts"] > 0:
                self.assertIn(token, alone)
                parked += [self.noon["attribute"][one]["name"] for one in row["attribute_tokens"]] == ["vehicle.parked"]
        beams = [one for path in sorted((WORK / "alone/labels/beams").iterdir()) for one in json.loads(path.read_text())["beams"]]
        self.assertGreater(len([one for one in beams if "thing" in one]), 3)
        self.assertGreater(parked, 3)
        self.assertEqual(reprise.Dataset(WORK / "alone")[0]["roof"].shape[1], 5)

    def test_sweeps_lie_between_samples_and_show_what_render_shows_there(self):
        subprocess.run(["rm", "-rf", WORK / "swept_nu", WORK / "unswept_nu", WORK / "swept_by_render"], check=True)
        rig = [{**one, "attributes": {**one.get("attributes", {}), "rolling": 0}} if one.get("type") == "lidar" else one for one in self.rig]
        (WORK / "swept_nu.json").write_text(json.dumps({"sensors": rig}))
        words = ["--format", "nuscenes", "--weathers", "clear_noon", "--rig", "swept_nu.json", "--every", "1s", "--split", "train:0.5", "--ticks", "1s..6s"]
        said("dataset", "c.mcap", "-o", "swept_nu", "--sweeps", "0.25s", *words)
        said("render", "c.mcap", "-o", "swept_by_render", "--weather", "clear_noon", "--rig", "swept_nu.json", "--ticks", "1s..6s", "--every", "5t", "--points", "npy", "--no-view", "--boxes")
        folder = WORK / "swept_nu/clear_noon"
        tables = {name: {row["token"]: row for row in json.loads((folder / f"v1.0-mini/{name}.json").read_text())} for name in SCHEMA}
        index = json.loads((WORK / "swept_nu/dataset.json").read_text())
        origin = np.eye(4)
        origin[:2, 3] = index["traces"][0]["origin"]
        rows = tables["sample_data"]
        by_time = sorted(tables["sample"].values(), key=lambda row: row["timestamp"])
        seen, chains = set(), 0
        for first in [row for row in rows.values() if row["prev"] == ""]:
            chains += 1
            chain = [first]
            while chain[-1]["next"]:
                chain.append(rows[chain[-1]["next"]])
            scene = tables["sample"][first["sample_token"]]["scene_token"]
            # From sample to sample three more, the first and the last of a scene are samples.
            self.assertEqual([row["is_key_frame"] for row in chain], [True] + [False, False, False, True] * (tables["scene"][scene]["nbr_samples"] - 1))
            self.assertEqual({after["timestamp"] - row["timestamp"] for row, after in zip(chain, chain[1:])}, {250_000})
            for row in chain:
                seen.add(row["token"])
                nearest = next(one for one in by_time if one["timestamp"] >= row["timestamp"])
                self.assertEqual(row["sample_token"], nearest["token"])
                mount = tables["calibrated_sensor"][row["calibrated_sensor_token"]]
                channel = tables["sensor"][mount["sensor_token"]]["channel"]
                self.assertEqual(pathlib.Path(row["filename"]).parts[:2], ("samples" if row["is_key_frame"] else "sweeps", channel))
                tick = row["timestamp"] % 86_400_000_000 // 50_000
                if channel.startswith("CAM"):
                    name = {"CAM_FRONT": "front", "CAM_BACK": "cam_back"}[channel]
                    np.testing.assert_array_equal(read_png(folder / row["filename"]), read_png(WORK / f"swept_by_render/{name}/{tick:06}.png"))
                    boxes = json.loads((WORK / f"swept_by_render/{name}/boxes/{tick:06}.json").read_text())
                    pose_ego = pose(tables["ego_pose"][row["ego_pose_token"]])
                    np.testing.assert_allclose(origin @ pose_ego @ pose(mount), boxes["world_from_camera"], atol=1e-6)
                elif channel == "LIDAR_TOP":
                    points = reprise.dataset.read_points(folder / row["filename"])
                    ours = np.load(WORK / f"swept_by_render/roof/{tick:06}.npy")
                    np.testing.assert_array_equal(points[:, :3], np.stack([-ours[:, 1], ours[:, 0], ours[:, 2]], 1))
        self.assertEqual((seen, chains), (set(rows), 4 * len(tables["scene"])))
        # Nothing else is different from a set without them.
        said("dataset", "c.mcap", "-o", "unswept_nu", *words)
        for path in (WORK / "unswept_nu/labels").rglob("*"):
            if path.is_file():
                self.assertEqual(path.read_bytes(), (WORK / "swept_nu" / path.relative_to(WORK / "unswept_nu")).read_bytes())
        for name in ("sample", "sample_annotation", "instance", "scene"):
            self.assertEqual((WORK / f"unswept_nu/clear_noon/v1.0-mini/{name}.json").read_bytes(), (folder / f"v1.0-mini/{name}.json").read_bytes())
        gone = sorted((folder / "sweeps/LIDAR_TOP").iterdir())[4]
        kept = gone.read_bytes()
        gone.unlink()
        said("dataset", "c.mcap", "-o", "swept_nu", "--sweeps", "0.25s", *words)
        self.assertEqual(gone.read_bytes(), kept)
        for wrong, why in ((["--sweeps", "0.3s"], "--sweeps: --every, 20 ticks, must be a multiple of it, got '0.3s'"),
                           (["--sweeps", "1s"], "--sweeps: --every, 20 ticks, must be a multiple of it, got '1s'"),
                           (["--sweeps", "0.25s", "--format", "coco"], "--sweeps: only of --format nuscenes")):  # fmt: skip
            odd = subprocess.run([PROGRAM, "dataset", "c.mcap", "-o", "odd", "--format", "nuscenes", "--every", "1s", *wrong], capture_output=True, text=True, cwd=WORK)
            self.assertEqual((odd.returncode, odd.stderr), (2, f"reprise: {why}\n"))

    def test_rigs_that_nuscenes_has_no_place_for_are_refused_in_a_line(self):
        front, roof = self.rig[0], self.rig[3]
        for rig, why in (([front, {**front, "name": "cam_front"}], "sensor 'cam_front': is CAM_FRONT in nuScenes, as 'front' is"),
                         ([front, {**roof, "name": "lidar_top"}, {**roof, "name": "LIDAR_TOP"}], "sensor 'LIDAR_TOP': is LIDAR_TOP in nuScenes, as 'lidar_top' is"),
                         ([self.rig[1], self.rig[5]], "nuScenes needs a camera of type rgb, or a lidar"),
                         ([{**front, "actor": "world"}], "sensor 'front': in nuScenes one car carries all sensors"),
                         ([{**front, "attributes": {"k1": -0.2}}], "sensor 'front': nuScenes' cameras are pinholes: without the attributes of its lens")):  # fmt: skip
            (WORK / "odd.json").write_text(json.dumps({"sensors": rig}))
            odd = subprocess.run([PROGRAM, "dataset", "c.mcap", "-o", "odd", "--format", "nuscenes", "--rig", "odd.json"], capture_output=True, text=True, cwd=WORK)
            self.assertEqual((odd.returncode, odd.stderr), (2, f"reprise: odd.json: {why}\n"))
            self.assertFalse((WORK / "odd").exists())

    @unittest.skipUnless(importlib.util.find_spec("nuscenes"), "nuscenes-devkit is not installed")
    def test_the_devkit_opens_it_and_counts_the_same_points(self):
        from nuscenes import NuScenes
        from nuscenes.utils.data_classes import LidarPointCloud, RadarPointCloud
        from nuscenes.utils.geometry_utils import points_in_box
        from nuscenes.utils.splits import get_scenes_of_split

        for weather in ("clear_noon", "hard_rain_noon"):
            nusc = NuScenes(version="v1.0-mini", dataroot=str(WORK / "nu" / weather), verbose=False)
            names = {one: get_scenes_of_split(f"reprise_{one}", nusc) for one in ("train", "val")}
            self.assertEqual(sorted(sum(names.values(), [])), [one["name"] for one in nusc.scene])
            for sample in nusc.sample:
                path, boxes, _ = nusc.get_sample_data(sample["data"]["LIDAR_TOP"])
                cloud = LidarPointCloud.from_file(path)
                for box in boxes:
                    row = nusc.get("sample_annotation", box.token)
                    self.assertLess(abs(points_in_box(box, cloud.points[:3]).sum() - row["num_lidar_pts"]), 3)
                    self.assertLess(np.linalg.norm(np.nan_to_num(nusc.box_velocity(box.token))), 40)
                RadarPointCloud.from_file(nusc.get_sample_data_path(sample["data"]["RADAR_FRONT_RIGHT"]))
                log = nusc.get("log", nusc.get("scene", sample["scene_token"])["log_token"])
                mask = nusc.get("map", log["map_token"])["mask"]
                car = nusc.get("ego_pose", sample["data"]["LIDAR_TOP"])["translation"]
                self.assertTrue(mask.is_on_mask(car[0], car[1])[0])
                self.assertFalse(mask.is_on_mask(car[0] - 249, car[1] - 249)[0])


unittest.main()
