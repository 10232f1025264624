#!/usr/bin/env python3
"""Leaves stop signs on minor roads only: stop_signs.py < NETCONVERTS.net.xml > OURS.net.xml

At a junction of the type priority_stop netconvert makes every link a stop that gives way to anybody,
walkers on a crossing included. With crossings on all arms cars then halt on the main road as well. Here
the roads of the highest priority at such a junction get the state that they have at a plain priority
junction: they give way without a stop. No other byte changes.
"""
import re
import sys
import xml.etree.ElementTree as ElementTree


def main_roads(net):
    """Edges into stop junctions, those of the highest priority there."""
    stops = {junction.get("id") for junction in net.iter("junction")
             if junction.get("type") == "priority_stop"}
    arms = {}
    for edge in net.iter("edge"):
        if edge.get("to") in stops:
            arms.setdefault(edge.get("to"), []).append((int(edge.get("priority")), edge.get("id")))
    return {edge for into in arms.values() for priority, edge in into if priority == max(into)[0]}


def main():
    text = sys.stdin.read()
    unhindered = main_roads(ElementTree.fromstring(text))

    def settled(connection):
        return (connection[0].replace(' state="s"', ' state="m"') if connection[1] in unhindered
                else connection[0])

    sys.stdout.write(re.sub(r'<connection from="([^"]*)".*', settled, text))


if __name__ == "__main__":
    main()
