"""The plans of Town 1 and Town 2: our own layouts.

Their lengths follow the two towns of Dosovitskiy et al., "CARLA: An Open Urban Driving Simulator", CoRL 2017
(2.9 km and 1.4 km of drivable roads).
"""
from plan import Plan, Roundabout, Street, circle, rectangle


def town1():
    """An old town: a ring avenue, a roundabout and a crossing in the middle, a winding lane."""
    west, middle, east = 112, 206, 300
    width, height = 421, 294
    ring = Roundabout("m2", (middle, 206), 15, dict(e=0, n=90, w=180, s=270))
    square = rectangle(214, 105, 262, 152)
    return Plan(
        junctions=dict(
            b1=(west, 0, "lit"), b2=(middle, 0, "stop"), b3=(east, 0, "lit"),
            t1=(west, height, "lit"), t2=(middle, height, "yield"), t3=(east, height, "lit"),
            l1=(0, 106, "lit"), r1=(width, 130, "yield"),
            a1=(west, 96, "lit"), a2=(west, 156, "stop"), a3=(west, 206, "yield"),
            c1=(east, 96, "lit"), c2=(east, 152, "stop"), c3=(east, 206, "lit"),
            m1=(middle, 96, "lit")),
        streets=[
            Street("b1", "b2", "avenue", "South Avenue", [], 25),
            Street("b2", "b3", "avenue", "South Avenue", [], 25),
            Street("b3", "r1", "avenue", "East Avenue", [(356, 0), (width, 52)], 25),
            Street("r1", "t3", "avenue", "East Avenue", [(width, height)], 25),
            Street("t3", "t2", "avenue", "North Avenue", [], 25),
            Street("t2", "t1", "avenue", "North Avenue", [], 25),
            Street("t1", "l1", "avenue", "West Avenue", [(62, height), (0, 220)], 25),
            Street("l1", "b1", "avenue", "West Avenue", [(0, 0)], 25),
            Street("b1", "a1", "street", "Mill Street", [], 25),
            Street("a1", "a2", "street", "Mill Street", [], 25),
            Street("a2", "a3", "street", "Mill Street", [], 25),
            Street("a3", "t1", "street", "Mill Street", [], 25),
            Street("b3", "c1", "street", "Church Street", [], 25),
            Street("c1", "c2", "street", "Church Street", [], 25),
            Street("c2", "c3", "street", "Church Street", [], 25),
            Street("c3", "t3", "street", "Church Street", [], 25),
            Street("a1", "m1", "street", "Bridge Street", [], 25),
            Street("m1", "c1", "street", "Bridge Street", [], 25),
            Street("m1", "m2s", "street", "Market Street", [], 25),
            Street("a3", "m2w", "street", "Park Street", [], 25),
            Street("m2e", "c3", "street", "Park Street", [], 25),
            # Two sharp bends between houses: nobody sees around them.
            Street("l1", "a2", "lane30", "Weaver Lane", [(56, 106), (56, 156)], 12),
            Street("c2", "r1", "lane30", "Orchard Lane", [], 25),
            Street("b2", "m1", "lane30", "Smith Lane", [], 25),
            Street("m2n", "t2", "lane30", "Rope Lane", [], 25)],
        roundabouts=[ring],
        plots=[
            ("park", rectangle(126, 108, 196, 180)),
            ("water", circle((170, 132), 11, 16)),
            ("playground", rectangle(132, 152, 152, 172)),
            ("square", square),
            ("car_park", rectangle(314, 168, 344, 192)),
            ("gravel", rectangle(18, 18, 40, 40)),
            ("forest", rectangle(362, 236, 396, 276))],
        districts=[("village", []), ("old", rectangle(west, 0, east, height)),
                   ("brick", rectangle(east, 0, width + 60, height))],
        keep_clear=[square, rectangle(126, 108, 196, 180), rectangle(314, 168, 344, 192)])


def town2():
    """A young town: a small ring road and a centre with one crossing and a hidden corner."""
    width, height = 210, 210
    west, east = 74, 142
    square = rectangle(84, 62, 128, 104)
    return Plan(
        junctions=dict(
            b1=(west, 0, "lit"), l1=(0, 114, "lit"), l2=(0, 54, "stop"), r1=(width, 114, "lit"),
            r2=(width, 52, "yield"), a1=(west, 114, "lit"), a2=(east, 114, "stop"),
            d1=(west, 54, "yield"), t1=(west, height, "lit")),
        streets=[
            Street("b1", "r2", "main", "Harbour Road", [(width, 0)], 22),
            Street("r2", "r1", "main", "Harbour Road", [], 22),
            Street("r1", "t1", "main", "Ring Road", [(width, 155), (162, height)], 22),
            Street("t1", "l1", "main", "Ring Road", [(0, height)], 22),
            Street("l1", "l2", "main", "Station Road", [], 22),
            Street("l2", "b1", "main", "Station Road", [(0, 0)], 22),
            Street("b1", "d1", "street", "Central Street", [], 22),
            Street("d1", "a1", "street", "Central Street", [], 22),
            Street("a1", "t1", "street", "Central Street", [], 22),
            Street("l1", "a1", "street", "Museum Street", [], 22),
            Street("a1", "a2", "street", "Museum Street", [], 22),
            Street("a2", "r1", "street", "Museum Street", [], 22),
            Street("l2", "d1", "lane30", "Garden Way", [], 22),
            # A corner between high houses: nobody sees around it.
            Street("a2", "r2", "lane30", "Gallery Way", [(east, 52)], 12)],
        roundabouts=[],
        plots=[
            ("square", square),
            ("park", rectangle(88, 126, 150, 180)),
            ("water", circle((132, 150), 10, 16)),
            ("playground", rectangle(96, 134, 112, 150)),
            ("car_park", rectangle(14, 70, 50, 98)),
            ("lawn", rectangle(20, 136, 58, 176))],
        districts=[("modern", []), ("centre", rectangle(west, 0, width, 114))],
        keep_clear=[square, rectangle(88, 126, 150, 180), rectangle(14, 70, 50, 98)])
