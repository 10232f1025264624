#!/usr/bin/env python3
"""Writes a recording as CARLA's recorder does, from the format's description alone: the importer is
tested against another hand's encoder. CARLA's axes: x ahead, y right, z up, centimetres, degrees.

Who drives: a car (24) goes clockwise, seen from above, round a circle of 30 m at 10 m/s; a lorry
(25) goes along x at 5 m/s on a slope of 5 % and is taken away after six seconds; a bicycle (26) stands;
a car (28) comes in the third second, a walker (27) crosses at 1.5 m/s; a traffic light (9), a prop
(5)."""
import argparse
import math
import struct

RADIUS, SPEED = 30.0, 10.0


def text(value):
    data = value.encode()
    return struct.pack("<H", len(data)) + data


class Log:
    def __init__(self, wide, kinematics):
        self.vector_format = "<3d" if wide else "<3f"
        self.additional = kinematics
        self.data = struct.pack("<H", 1) + text("CARLA_RECORDER") + struct.pack("<q", 1600000000)
        self.data += text("Carla/Maps/Town01")

    def vector(self, v):
        return struct.pack(self.vector_format, *v)

    def packet(self, kind, data):
        self.data += struct.pack("<BI", kind, len(data)) + data

    def records(self, kind, records):
        self.packet(kind, struct.pack("<H", len(records)) + b"".join(records))

    def actor(self, number, kind, pose, blueprint, **attributes):
        data = struct.pack("<IB", number, kind) + self.vector(pose[0]) + self.vector(pose[1])
        data += struct.pack("<I", 7) + text(blueprint) + struct.pack("<H", len(attributes))
        for key, value in attributes.items():
            data += struct.pack("<B", 3) + text(key) + text(value)
        return data


def car_pose(time):
    """Clockwise: yaw grows. The place is the middle of the car."""
    angle = SPEED * time / RADIUS
    place = (100 * RADIUS * math.cos(angle), 100 * RADIUS * math.sin(angle), 0)
    return place, (0, 0, (math.degrees(angle) + 90 + 180) % 360 - 180)


def lorry_pose(time):
    pitch = math.degrees(math.atan(0.05))
    along = 500 * time
    return (along * math.cos(math.radians(pitch)), 5000, along * math.sin(math.radians(pitch))), (
        0, pitch, 0)


def walker_pose(time):
    return (1000, -150 * time, 93), (0, 0, -90)


def everybody(time):
    """Vehicles and walkers of the moment, by number."""
    poses = {24: car_pose(time), 26: ((0, -2000, 0), (0, 0, 180)), 27: walker_pose(time)}
    if time < 6:
        poses[25] = lorry_pose(time)
    if time >= 3:
        poses[28] = ((-2000, -2000, 0), (0, 0, 45))
    return poses


def velocity(number, time):
    step = 1e-4
    first, second = everybody(time)[number][0], everybody(time + step)
    if number not in second:
        return (0, 0, 0)
    return tuple((b - a) / 100 / step for a, b in zip(first, second[number][0]))


def added(log, number, time):
    pose = everybody(time).get(number)
    return {
        5: lambda: log.actor(5, 0, ((0, 0, 0), (0, 0, 0)), "static.prop.bench"),
        9: lambda: log.actor(9, 3, ((4000, 4000, 0), (0, 0, 90)), "traffic.traffic_light"),
        24: lambda: log.actor(24, 1, pose, "vehicle.tesla.model3", role_name="hero",
                              color="180,180,180", number_of_wheels="4"),
        25: lambda: log.actor(25, 1, pose, "vehicle.carlamotors.carlacola", role_name="autopilot"),
        26: lambda: log.actor(26, 1, pose, "vehicle.someone.newbike", number_of_wheels="2"),
        27: lambda: log.actor(27, 2, pose, "walker.pedestrian.0021", age="adult"),
        28: lambda: log.actor(28, 1, pose, "vehicle.someone.newcar"),
    }[number]()


def write_frame(log, number, time, duration, last_time):
    now, before = everybody(time), everybody(last_time) if number > 1 else {}
    log.packet(0, struct.pack("<Qdd", number, duration, time))
    new = [n for n in sorted(now) if n not in before] + ([5, 9] if number == 1 else [])
    log.records(2, [added(log, n, time) for n in new])
    log.records(3, [struct.pack("<I", n) for n in sorted(before) if n not in now])
    log.records(4, [struct.pack("<II", 5, 24)] if number == 1 else [])
    collisions = [struct.pack("<III??", number, 24, 28, True, False)] if 4 <= time < 4.4 else []
    log.records(5, collisions)
    still = {5: ((0, 0, 0), (0, 0, 0))}
    # The registry of CARLA is in no order.
    log.records(6, [struct.pack("<I", n) + log.vector(p) + log.vector(r)
                    for n, (p, r) in sorted({**now, **still}.items(), key=lambda i: i[0] * 7 % 11)])
    log.records(7, [struct.pack("<I?fb", 9, False, time, 2 if time < 5 else 0)])
    vehicles = [n for n in sorted(now) if n != 27]
    log.records(8, [struct.pack("<Ifff?i", n, 0.1, 0.5, 1.0 if n == 24 and time >= 8 else 0.0, False,
                                -1 if n == 25 else 1) for n in vehicles])
    log.records(9, [struct.pack("<If", 27, 1.5)])
    flags = {24: 0x1 | 0x2, 25: 0x20, 26: 0x0, 28: 0x10 | 0x4}
    log.records(10, [struct.pack("<II", n, flags[n]) for n in vehicles])
    log.records(11, [struct.pack("<Ifffff?B", 1, 5.0, 1, 1, 1, 1, True, 1)] if number == 1 else [])
    if log.additional:
        log.records(12, [struct.pack("<I", n) + log.vector(velocity(n, time)) + log.vector((0, 0, 0))
                         for n in sorted(now)])
        boxes = {28: ((10, 0, 150), (595, 126, 152)), 27: ((0, 0, 0), (19, 19, 93))}
        log.records(13, [struct.pack("<I", n) + log.vector(m) + log.vector(e)
                         for n, (m, e) in boxes.items() if n in new])
        if number == 1:
            log.records(17, [struct.pack("<I", 9) + log.vector((3000, 0, 0)) +
                             log.vector((200, 200, 200))])
        log.packet(14, struct.pack("<d", time))
        log.records(15, [])
        log.records(16, [])
    log.packet(18, struct.pack("<Q", number))
    log.packet(142, b"somebody's own packet")
    log.packet(1, b"")


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("output")
    options.add_argument("--ue5", action="store_true", help="doubles")
    options.add_argument("--additional", action="store_true", help="kinematics, boxes, triggers")
    options.add_argument("--seconds", type=float, default=10)
    options.add_argument("--frames", type=int, default=10**9, help="at most")
    options.add_argument("--cut", type=int, default=0, help="bytes to leave out at the end")
    given = options.parse_args()
    log = Log(given.ue5, given.additional)
    time, last, number = 0.0, 0.0, 1
    while time <= given.seconds + 1e-9 and number <= given.frames:
        # As uneven as in real logs: 17 to 124 ms. Sixteenths of 2 ms add up without rounding.
        duration = (9 + (number * 37) % 54) / 512
        write_frame(log, number, time, duration, last)
        last, time, number = time, time + duration, number + 1
    with open(given.output, "wb") as file:
        file.write(log.data[:len(log.data) - given.cut])


main()
