"""The driver's end of the wire: frames over a Unix domain socket. remote/wire.fbs and docs/drivers.md say what they hold."""
from __future__ import annotations

import os
import socket
import struct
from typing import Any

import flatbuffers
from flatbuffers.table import Table

from . import schema
from .nouns import Noun
from .packing import pack

VERSION = 1
_KINDS = schema.ENUMS["remote.Kind"][1]
_NAMES = {number: name for name, number in _KINDS.items()}


def _control_frame() -> tuple[bytes, list[tuple[int, struct.Struct]]]:
    """A frame with a control, and where each of its fields is: filling one in costs a tenth of building one."""
    fields = schema.TABLES["remote.Control"]
    # Whatever is not its default has a place in the table.
    body = pack("remote.Control", {field: 1 for field in fields})
    table = Table(body, struct.unpack_from("<I", body)[0])
    places = []
    for number, of in sorted(fields.values()):
        kind = {"bool": "<?", "ushort": "<H", "double": "<d", "ulong": "<Q"}[of]
        places.append((8 + table.Pos + table.Offset(4 + 2 * number), struct.Struct(kind)))
    return struct.pack("<II", len(body), _KINDS["control"]) + bytes(body), places


_CONTROL_FRAME, _CONTROL_FIELDS = _control_frame()


class WireError(RuntimeError):
    """The run is gone without a word, or speaks another version of the wire."""


def _connect(address: str) -> socket.socket:
    if address.startswith("fd:"):
        return socket.socket(fileno=int(address[3:]))
    host, colon, port = address.rpartition(":")
    try:
        if colon and port.isdigit() and "/" not in host:
            channel = socket.create_connection((host, int(port)))
            channel.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            return channel
        channel = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        channel.connect(address)
    except OSError as error:
        raise WireError(f"{address}: nobody is there: {error.strerror or error}") from None
    return channel


class Wire:
    """One connection with a run."""

    digest = schema.DIGEST

    def __init__(self, address: str | socket.socket | None = None) -> None:
        if isinstance(address, socket.socket):
            self._channel = address
            return
        address = address or os.environ.get("REPRISE_DRIVER", "")
        if not address:
            raise WireError(
                "no run to drive in: start this program by reprise run SCENARIO.lua --driver NAME='...', or name a socket"
            )
        self._channel = _connect(address)
        self._descriptor: int | None = None

    def close(self) -> None:
        self._channel.close()

    def descriptor(self) -> int | None:
        """What was handed over with the first message, once: the caller's from then on."""
        descriptor, self._descriptor = self._descriptor, None
        return descriptor

    def receive_first(self) -> tuple[str, Noun]:
        """As receive(); an open file may come along: see descriptor()."""
        if self._channel.family == socket.AF_UNIX:
            head, descriptors, _, _ = socket.recv_fds(self._channel, 8, 1)
            self._descriptor = descriptors[0] if descriptors else None
            return self._rest(bytes(head) + bytes(self._read(8 - len(head))))
        return self.receive()

    def _read(self, size: int) -> memoryview:
        data = bytearray(size)
        view, got = memoryview(data), 0
        while got < size:
            try:
                count = self._channel.recv_into(view[got:])
            except ConnectionError:
                count = 0
            if count == 0:
                raise WireError("the run has hung up")
            got += count
        return view

    def receive(self) -> tuple[str, Noun]:
        """The next message: its kind, such as 'observation', and the noun it holds."""
        return self._rest(self._read(8))

    def _rest(self, head: bytes | memoryview) -> tuple[str, Noun]:
        size, number = struct.unpack("<II", head)
        kind = _NAMES.get(number)
        if kind is None:
            raise WireError(f"the run said a message of the unknown kind {number}")
        return kind, Noun(self._read(size), f"remote.{kind.capitalize()}")

    def _send(self, kind: str, builder: flatbuffers.Builder) -> None:
        self._put(kind, builder.Output())

    def _put(self, kind: str, body: bytearray) -> None:
        self._send_all(struct.pack("<II", len(body), _KINDS[kind]) + body)

    def _send_all(self, frame: bytes | bytearray) -> None:
        try:
            self._channel.sendall(frame)
        except ConnectionError:
            raise WireError("the run has hung up") from None

    def say(self, kind: str, **values: Any) -> None:
        """A message of any kind, by the fields of its table."""
        self._put(kind, pack(f"remote.{kind.capitalize()}", values))

    def ready(self) -> None:
        """Answers hello."""
        builder = flatbuffers.Builder(128)
        digest = builder.CreateString(schema.DIGEST)
        builder.StartObject(2)
        builder.PrependUint32Slot(0, VERSION, 0)
        builder.PrependUOffsetTRelativeSlot(1, digest, 0)
        builder.Finish(builder.EndObject())
        self._send("ready", builder)

    def control(self, tick: int, throttle: float, brake: float, steer: float, hand_brake: bool, reverse: bool,
                lamps: int) -> None:  # fmt: skip
        """Answers the observation of this tick."""
        frame = bytearray(_CONTROL_FRAME)
        values = (tick, throttle, brake, steer, hand_brake, reverse, lamps)
        for (place, of), value in zip(_CONTROL_FIELDS, values):
            of.pack_into(frame, place, value)
        self._send_all(frame)

    def goodbye(self, reason: str) -> None:
        """The driver's last word."""
        builder = flatbuffers.Builder(128)
        text = builder.CreateString(reason)
        builder.StartObject(1)
        builder.PrependUOffsetTRelativeSlot(0, text, 0)
        builder.Finish(builder.EndObject())
        self._send("goodbye", builder)
