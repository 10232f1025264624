#!/usr/bin/env python3
"""Beside Blender's Cycles (Debian: blender), by hand: ./dev peers cycles

CPU time of one 800x600 picture on one core, of the same geometry seen by the same camera under the same sun: ours as it
ships, with its textures, sky, reflections and smooth edges; Cycles with grey surfaces, one sample a pixel and one bounce,
its trees built before the clock starts. Both are measured in turns of the same run, with the memory that
reprise-render has. Writes the picture that Cycles made beside the scene, so that anyone can see that it is the same
street.
"""
import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/bench"))
import picture_memory  # noqa: E402

GOAL = 2.0

IN_BLENDER = r'''
import json, math, sys, time
import bpy, numpy
from mathutils import Matrix, Vector

at, turns = sys.argv[sys.argv.index("--") + 1:]
scene_of = json.load(open(at + ".json"))
data = open(at + ".bin", "rb")
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
grey = bpy.data.materials.new("grey")

meshes = []
for number, sizes in enumerate(scene_of["prototypes"]):
    vertices = numpy.frombuffer(data.read(12 * sizes["vertices"]), "<f4")
    corners = numpy.frombuffer(data.read(12 * sizes["triangles"]), "<u4").astype("i4")
    mesh = bpy.data.meshes.new(str(number))
    mesh.vertices.add(sizes["vertices"])
    mesh.vertices.foreach_set("co", vertices)
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(sizes["triangles"])
    mesh.polygons.foreach_set("loop_start", numpy.arange(0, len(corners), 3, dtype="i4"))
    mesh.polygons.foreach_set("loop_total", numpy.full(sizes["triangles"], 3, dtype="i4"))
    mesh.update(calc_edges=True)
    mesh.materials.append(grey)
    meshes.append(mesh)


def matrix(rows):
    return Matrix((rows[0:4], rows[4:8], rows[8:12], (0, 0, 0, 1)))


for instance in scene_of["instances"]:
    thing = bpy.data.objects.new("thing", meshes[instance["prototype"]])
    thing.matrix_world = matrix(instance["pose"])
    scene.collection.objects.link(thing)

camera = scene_of["camera"]
lens = bpy.data.cameras.new("camera")
lens.sensor_fit = "HORIZONTAL"
lens.angle = camera["fov"]
lens.clip_end = 5000
eye = bpy.data.objects.new("camera", lens)
# Of the vehicle: x ahead, y left, z up. Of Blender's camera: x right, y up, z back.
axes = Matrix(((0, 0, -1, camera["mount"][0]), (-1, 0, 0, camera["mount"][1]), (0, 1, 0, camera["mount"][2]), (0, 0, 0, 1)))
eye.matrix_world = matrix(camera["vehicle"]) @ axes
scene.collection.objects.link(eye)
scene.camera = eye

sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy = 3
sun.rotation_mode = "QUATERNION"
sun.rotation_quaternion = Vector(scene_of["to_sun"]).to_track_quat("Z", "Y")
scene.collection.objects.link(sun)
world = bpy.data.worlds.new("sky")
world.color = (.5, .6, .8)
scene.world = world

scene.render.engine = "CYCLES"
scene.render.threads_mode = "FIXED"
scene.render.threads = 1
scene.render.resolution_x, scene.render.resolution_y = camera["width"], camera["height"]
scene.render.resolution_percentage = 100
scene.render.use_persistent_data = True  # its trees outlive a picture
scene.render.filepath = at + "-cycles.png"
cycles = scene.cycles
cycles.device = "CPU"
cycles.samples = 1
cycles.use_adaptive_sampling = False
cycles.use_denoising = False
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 1
cycles.transmission_bounces = cycles.transparent_max_bounces = cycles.volume_bounces = 0
bpy.ops.render.render(write_still=True)
times = []
for _ in range(int(turns)):
    cycles.seed += 1  # else it hands out the picture that it has
    begin = time.process_time()
    bpy.ops.render.render()
    times.append(1e3 * (time.process_time() - begin))
print("CYCLES " + json.dumps(times))
'''


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--turns", type=int, default=5, help="of both, one after the other (default 5)")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="keep the scene and Cycles' picture as OUTPUT.json, .bin, -cycles.png")
    said = parser.parse_args()
    blender = shutil.which("blender")
    if blender is None:
        sys.exit("beside_cycles.py: no blender: apt-get install --no-install-recommends blender")
    environment = os.environ | picture_memory.environment()
    with tempfile.TemporaryDirectory() as scratch:
        at = said.output or pathlib.Path(scratch) / "scene"
        script = pathlib.Path(scratch) / "in_blender.py"
        script.write_text(IN_BLENDER)
        ours, theirs = [], []
        for _ in range(said.turns):
            subprocess.run([said.build / "bench/scene_export", at], check=True, env=environment)
            ours.append(json.loads(at.with_suffix(".json").read_text())["picture_ms"])
            run = subprocess.run([blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python", script, "--", at, "3"],
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)  # fmt: skip
            line = next((line for line in run.stdout.splitlines() if line.startswith("CYCLES ")), None)
            if line is None:
                sys.exit(f"beside_cycles.py: blender ended with {run.returncode}:\n{run.stdout[-2000:]}")
            theirs.append(statistics.median(json.loads(line[len("CYCLES "):])))
    ratio = statistics.median(theirs) / statistics.median(ours)
    print(f"reprise {statistics.median(ours):6.0f} ms of CPU a picture of 800x600 ({', '.join(f'{t:.0f}' for t in ours)})")
    print(f"cycles  {statistics.median(theirs):6.0f} ms, grey, 1 sample a pixel, 1 bounce ({', '.join(f'{t:.0f}' for t in theirs)})")
    print(f"ratio   {ratio:6.2f} (goal {GOAL})")


if __name__ == "__main__":
    main()
