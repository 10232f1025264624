"""The driver's end of the wire: frames over a Unix domain socket. remote/wire.fbs and docs/drivers.md say what they hold."""
from __future__ import annotations

import numbers
import os
import select
import socket
import struct
import time
from typing import Any, Callable

import flatbuffers
from flatbuffers.table import Table

from . import schema
from .arguments import path_or_text, printable, shown
from .nouns import Noun
from .packing import pack

VERSION = 1
POLLING = 0.005
"""[s] for so long a driver polls for a tick where its author says nothing else."""

_KINDS = schema.ENUMS["remote.Kind"][1]
_NAMES = {number: name for name, number in _KINDS.items()}
_TABLES = {name: f"remote.{name.capitalize()}" for name in _KINDS}


def _control_frame() -> tuple[struct.Struct, list[bytes | int]]:
    """A frame with a control as one struct, and its values: bytes that are always the same, and in place of each field
    its number in Wire.control(). Filling one in costs a fortieth of building one."""
    fields = schema.TABLES["remote.Control"]
    # Whatever is not its default has a place in the table.
    body = pack("remote.Control", {field: 1 for field in fields})
    frame = struct.pack("<II", len(body), _KINDS["control"]) + bytes(body)
    table = Table(frame, 8 + struct.unpack_from("<I", body)[0])
    kinds = {"bool": "?", "ushort": "H", "double": "d", "ulong": "Q"}
    places = sorted((table.Pos + table.Offset(4 + 2 * number), number, kinds[of]) for number, of in fields.values())
    shape, values, done = "<", [], 0
    for place, number, kind in [*places, (len(frame), -1, "")]:
        if place > done:
            shape += f"{place - done}s"
            values.append(frame[done:place])
        if kind:
            shape += kind
            values.append(number)
            done = place + struct.calcsize("<" + kind)
    return struct.Struct(shape), values


_CONTROL, _CONTROL_VALUES = _control_frame()
_HEAD = struct.Struct("<II")  # length of the body, kind
_ROOT = struct.Struct("<I")
_GUESS = 1 << 16  # [bytes] a message mostly is no longer, with its head


class WireError(RuntimeError):
    """The run is gone without a word, or speaks another version of the wire."""


def _connect(address: str) -> socket.socket:
    shown = printable(address)
    if address.startswith("fd:"):
        try:
            return socket.socket(fileno=int(address[3:]))
        except (ValueError, OSError):
            raise WireError(f"{shown}: is no open socket; who starts a driver in turn must leave it open "
                            "(subprocess.run(..., close_fds=False))") from None  # fmt: skip
    host, colon, port = address.rpartition(":")
    try:
        if colon and port.isdigit() and "/" not in host:
            channel = socket.create_connection((host, int(port)))
            channel.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            return channel
        channel = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        channel.connect(address)
    except OSError as error:
        raise WireError(f"{shown}: nobody is there: {error.strerror or error}") from None
    return channel


class _Awaiting:
    """Waits for what comes over a socket: for `polling` seconds by looking again and again, then asleep. remote/polling.h
    says when it sleeps at once: it is the same rule.

    Never asleep in recv(): there we would be woken for nothing when the run reads what we said, at its cost, some 15 us.
    """

    def __init__(self, channel: socket.socket, polling: float) -> None:
        poll = select.poll()
        poll.register(channel, select.POLLIN)
        self._poll = poll.poll
        self._polling = polling if polling > 0 and _processors() > 1 else 0.0
        self._to_sleep = self._rivalry = self._calm = self._doublings = 0

    def __call__(self) -> None:
        if self._to_sleep:
            self._to_sleep -= 1
        elif self._polling and self._finds():
            return
        self._poll()

    def _finds(self) -> bool:
        begin, own_begin = time.monotonic(), time.thread_time()
        found, waited = bool(self._poll(0)), 0.0
        while not found and waited < self._polling:
            os.sched_yield()
            found = bool(self._poll(0))
            waited = time.monotonic() - begin
        self._to_sleep = 0 if found else 2
        self._heed(time.thread_time() - own_begin < 0.8 * waited)
        return found

    def _heed(self, had_a_rival: bool) -> None:
        if not had_a_rival:
            self._rivalry = max(self._rivalry - 1, 0)
            self._calm += 1
            if self._calm == 64:
                self._doublings = 0
            return
        self._calm = 0
        self._rivalry += 2
        if self._rivalry >= 16:
            self._rivalry = 0
            self._to_sleep = 16 << self._doublings
            self._doublings = min(self._doublings + 1, 6)


def _processors() -> int:
    """That this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Wire:
    """One connection with a run."""

    digest = schema.DIGEST

    def __init__(self, address: str | socket.socket | None = None, polling: float = POLLING) -> None:
        if isinstance(polling, bool) or not isinstance(polling, numbers.Real):
            raise ValueError(f"polling={shown(polling)}: expected seconds")
        self._descriptor: int | None = None
        self._ahead = b""  # of the next messages
        if not isinstance(address, socket.socket):
            address = path_or_text("address", address or os.environ.get("REPRISE_DRIVER", ""))
            if not address:
                raise WireError("no run to drive in: start this program by reprise run SCENARIO.lua --driver NAME='...', or "
                                "name a socket")  # fmt: skip
            address = _connect(address)
        self._channel = address
        self._await = _Awaiting(address, polling)

    def close(self) -> None:
        self._channel.close()

    def fileno(self) -> int:
        """For select(): whether something was said."""
        return self._channel.fileno()

    def descriptor(self) -> int | None:
        """What was handed over with the first message, once: the caller's from then on."""
        descriptor, self._descriptor = self._descriptor, None
        return descriptor

    def receive_first(self) -> tuple[str, Noun]:
        """As receive(); an open file may come along: see descriptor()."""
        return self._noun(self._frame(self._some_with_files if self._channel.family == socket.AF_UNIX else self._some))

    def _some(self, most: int) -> bytes:
        self._await()
        try:
            data = self._channel.recv(most)
        except ConnectionError:
            data = b""
        if not data:
            raise WireError("the run has hung up")
        return data

    def _some_with_files(self, most: int) -> bytes:
        self._await()
        try:
            data, descriptors, _, _ = socket.recv_fds(self._channel, most, 1)
        except ConnectionError:
            data, descriptors = b"", []
        if not data:
            raise WireError("the run has hung up")
        self._descriptor = descriptors[0] if descriptors else self._descriptor
        return data

    def _frame(self, some: Callable[[int], bytes]) -> bytes:
        """The bytes of the next message with its head; mostly one call brings all of them. What came of the messages
        behind it is kept. They are new with each message: arrays look into them as long as somebody wants them."""
        data, self._ahead = self._ahead or some(_GUESS), b""
        while len(data) < _HEAD.size:
            data += some(_GUESS)
        size = _HEAD.size + _HEAD.unpack_from(data)[0]
        if len(data) == size:
            return data
        if len(data) > size:
            self._ahead = data[size:]
            return data[:size]
        parts, left = [data], size - len(data)
        while left > 0:
            parts.append(some(min(left, 1 << 20)))
            left -= len(parts[-1])
        return b"".join(parts)

    def receive(self) -> tuple[str, Noun]:
        """The next message: its kind, such as 'observation', and the noun it holds."""
        return self._noun(self._frame(self._some))

    def _noun(self, frame: bytes) -> tuple[str, Noun]:
        number = _HEAD.unpack_from(frame)[1]
        kind = _NAMES.get(number)
        if kind is None:
            raise WireError(f"the run said a message of the unknown kind {number}")
        (root,) = _ROOT.unpack_from(frame, _HEAD.size)
        return kind, Noun(frame, _TABLES[kind], _HEAD.size + root)

    def _send(self, kind: str, builder: flatbuffers.Builder) -> None:
        self._put(kind, builder.Output())

    def _put(self, kind: str, body: bytearray) -> None:
        self._send_all(struct.pack("<II", len(body), _KINDS[kind]) + body)

    def _send_all(self, frame: bytes | bytearray) -> None:
        try:
            self._channel.sendall(frame)
        except ConnectionError:
            raise WireError("the run has hung up") from None

    def say(self, kind: str, most: int | None = None, **values: Any) -> None:
        """A message of any kind, by the fields of its table. Raises ValueError where that is more than so many bytes."""
        body = pack(f"remote.{kind.capitalize()}", values)
        if most is not None and len(body) > most:
            raise ValueError(f"{kind}: expected {most} bytes at most, got {len(body)}")
        self._put(kind, body)

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
        said = (tick, throttle, brake, steer, hand_brake, reverse, lamps)
        self._send_all(_CONTROL.pack(*[said[of] if type(of) is int else of for of in _CONTROL_VALUES]))

    def goodbye(self, reason: str) -> None:
        """The driver's last word."""
        builder = flatbuffers.Builder(128)
        text = builder.CreateString(reason)
        builder.StartObject(1)
        builder.PrependUOffsetTRelativeSlot(0, text, 0)
        builder.Finish(builder.EndObject())
        self._send("goodbye", builder)
