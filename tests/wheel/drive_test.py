"""What `reprise drive` promises a person: whole drives by keys. The variable REPRISE names the program.

Nothing here waits for a time: keys are sent until what they do is told.
"""
import csv
import ctypes
import fcntl
import io
import os
import pathlib
import pty
import re
import select
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import unittest

PROGRAM = os.environ["REPRISE"]
SMALL_TOWN = pathlib.Path(__file__).resolve().parents[1] / "cli/crash/small.net.xml"
PICTURES = ["--camera", "semantic", "--size", "64x36"]
WAITING = 120  # [s] of patience on a loaded machine


def close_window(display, window):
    """Asks as a window manager does when its cross is clicked: a ClientMessage WM_DELETE_WINDOW."""
    client_message = 33
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XInternAtom.restype = ctypes.c_ulong
    connection = ctypes.c_void_p(x11.XOpenDisplay(display.encode()))
    atoms = [x11.XInternAtom(connection, name, 0) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW")]
    # XClientMessageEvent: type, serial, send_event, display, window, message_type, format, data.l[5]; an XEvent has 192 bytes
    event = struct.pack("iLiPLLi5l", client_message, 0, 1, connection.value, window, atoms[0], 32, atoms[1], 0, 0, 0, 0)
    x11.XSendEvent(connection, ctypes.c_ulong(window), 0, ctypes.c_long(0), event.ljust(192, b"\0"))
    x11.XCloseDisplay(connection)


class Driven(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        shutil.copy(SMALL_TOWN, self.folder)
        self.words = ["drive", "--town", "small.net.xml", "--cars", "0", "--seed", "3", *PICTURES]
        (self.folder / "my.lua").write_text("""return scenario 'my' {
            town = 'small.net.xml', cars = 0, seed = 3, duration = 600,
            run = function() spawn{ name = 'ego', model = 'sedan', driver = 'external' } wait(600) end }""")

    def reprise(self, *words, **more):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=WAITING, **more)
        return done.returncode, done.stdout + done.stderr

    def recorded(self, trace, field):
        """Its value in each tick."""
        code, text = self.reprise("cat", trace, "--fields", field, "--format", "csv")
        self.assertEqual(code, 0, text)
        rows = list(csv.DictReader(io.StringIO(text)))
        column = next(name for name in rows[0] if name.startswith(field.rpartition(".")[2]))
        return [float(row[column]) for row in rows]

    def expect_whole(self, trace):
        self.assertFalse((self.folder / (trace + ".partial")).exists())
        code, said = self.reprise("verify", trace)
        self.assertEqual(code, 0, said)
        self.assertIn("equal at every one of", said)
        self.assertIn("ended: by the driver of 'ego'", self.reprise("info", trace)[1])

    def expect_driven_ahead_and_left(self, trace):
        steer = self.recorded(trace, "controls.steer")
        self.assertGreater(max(self.recorded(trace, "controls.throttle")), 0.5)
        self.assertGreater(max(steer), 0.1)
        self.assertEqual(min(steer), 0)
        turns = [abs(late - early) for early, late in zip(steer, steer[1:])]
        self.assertLess(max(turns), 0.2, "the wheel does not jump")
        self.assertGreater(self.recorded(trace, "vehicles.odometer")[-1], 3)


class Windows(Driven):
    """On a screen that nobody sees, with keys that it says were pressed."""

    def setUp(self):
        super().setUp()
        for program in ("Xvfb", "xdotool"):
            if shutil.which(program) is None:
                self.skipTest(f"{program} is missing: packages.txt, [tests]")
        reading, writing = os.pipe()
        screen = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1024x768x24", "-nolisten", "tcp",
                                   "-noreset"],
                                  pass_fds=[writing], stderr=subprocess.DEVNULL)
        self.addCleanup(screen.wait)
        self.addCleanup(screen.kill)
        os.close(writing)
        number = b""
        while not number.endswith(b"\n"):  # said when it is ready
            more = os.read(reading, 16)
            self.assertTrue(more, "Xvfb ended")
            number += more
        os.close(reading)
        self.environment = {**os.environ, "DISPLAY": ":" + number.decode().strip()}
        self.environment.pop("WAYLAND_DISPLAY", None)

    def xdo(self, *words):
        done = subprocess.run(["xdotool", *words], env=self.environment, capture_output=True, text=True, check=False,
                              timeout=WAITING)
        return done.stdout.strip()

    def start(self, *words):
        self.drive = subprocess.Popen([PROGRAM, *words], cwd=self.folder, env=self.environment, text=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                      start_new_session=True)
        self.addCleanup(self.drive.stdout.close)
        self.addCleanup(self.drive.kill)
        found = ""
        while not found and self.drive.poll() is None:  # a search fails when a window goes that it looks at
            found = self.xdo("search", "--onlyvisible", "--name", "km/h")
        if not found:
            self.fail("no window: " + self.drive.stdout.read())
        self.window = found.splitlines()[0]
        self.xdo("windowfocus", "--sync", self.window)

    def title_with(self, pattern):
        """Looks at the window's title until it says that."""
        while self.drive.poll() is None:
            if found := re.search(pattern, self.xdo("getwindowname", self.window)):
                return found
        self.fail(self.drive.stdout.read())

    def expect_good_end(self):
        said, _ = self.drive.communicate(timeout=WAITING)
        self.assertEqual(self.drive.returncode, 0, said)
        self.assertIn("ended: by the driver", said)
        return said

    def test_keys_drive_and_steer_and_escape_ends_it_whole(self):
        self.start(*self.words)
        self.assertEqual(self.title_with(r" ([DR])  ")[1], "D")
        self.xdo("keydown", "Up")
        self.title_with(r"  1\d km/h|[2-9]\d km/h")
        self.xdo("keydown", "Left")
        begin = int(self.title_with(r"0:(\d\d)")[1])
        self.title_with("|".join(f"0:{second:02}" for second in range(begin + 2, 60)))
        self.xdo("keyup", "Left")
        self.xdo("key", "Escape")
        self.assertIn("drive.mcap: ", self.expect_good_end())
        self.expect_whole("drive.mcap")
        self.expect_driven_ahead_and_left("drive.mcap")

    def test_reverse_goes_backwards(self):
        self.start(*self.words, "-o", "back.mcap", "--pace", "0")
        self.title_with(r" D  ")
        self.xdo("key", "r")
        self.title_with(r" R  ")
        self.xdo("keydown", "w")
        self.title_with(r"[5-9] km/h  R")
        self.xdo("key", "q")
        self.expect_good_end()
        self.expect_whole("back.mcap")
        self.assertLess(self.recorded("back.mcap", "measurements.speed")[-1], -1)

    def test_a_window_that_is_closed_ends_it_whole(self):
        self.start(*self.words)
        self.title_with("km/h")
        close_window(self.environment["DISPLAY"], int(self.window))
        self.expect_good_end()
        self.expect_whole("drive.mcap")

    def test_any_scenario_is_driven_by_keyboard(self):
        self.start("run", "my.lua", "--driver", "ego=keyboard", "-o", "my.mcap")
        self.title_with("km/h")
        self.xdo("key", "Escape")
        self.assertIn("'ego' carries no rig: there is no picture of it", self.expect_good_end())
        self.expect_whole("my.mcap")

    def test_a_drive_is_branched_by_another_person(self):
        self.start(*self.words)
        self.title_with("0:0[1-9]")
        self.xdo("key", "Escape")
        self.expect_good_end()
        self.start("branch", "drive.mcap", "--at", "10t", "--driver", "ego=keyboard", "-o", "branched.mcap")
        self.title_with("0:0[1-9]")
        self.xdo("key", "Escape")
        self.drive.communicate(timeout=WAITING)
        self.expect_whole("branched.mcap")


class Terminals(Driven):
    """In a pseudo-terminal."""

    def test_keys_drive_and_steer_and_escape_ends_it_whole(self):
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.folder)
            for name in ("DISPLAY", "WAYLAND_DISPLAY"):
                os.environ.pop(name, None)
            os.execv(PROGRAM, ["reprise", *self.words])
        self.addCleanup(os.close, terminal)
        fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("4H", 30, 100, 0, 0))
        shown = ""

        def look():
            nonlocal shown
            ready, _, _ = select.select([terminal], [], [], WAITING)
            self.assertTrue(ready, shown[-500:])
            try:
                more = os.read(terminal, 1 << 16)
            except OSError:  # closed by its last user
                more = b""
            shown += more.decode(errors="replace")
            return bool(more)

        def press_until(key, pattern):
            start = len(shown)
            while not re.search(pattern, shown[start:]):
                os.write(terminal, key)
                self.assertTrue(look(), shown[-500:])
            return re.findall(pattern, shown[start:])[-1]

        press_until(b"", "km/h")
        press_until(b"\x1b[A", r"\n1\d km/h")
        begin = int(press_until(b"a", r"km/h .*0:(\d\d)"))
        press_until(b"a", "|".join(f"0:{second:02}" for second in range(begin + 2, 60)))
        os.write(terminal, b"\x1b")
        while look():
            pass
        _, status = os.waitpid(pid, 0)
        self.assertEqual(os.waitstatus_to_exitcode(status), 0, shown[-500:])
        self.assertIn("\u2580", shown, "a picture")
        self.assertRegex(shown, r"(?s)\x1b\[\?1049h.*\x1b\[\?1049l.*ended: by the driver", "the screen comes back")
        self.expect_whole("drive.mcap")
        self.expect_driven_ahead_and_left("drive.mcap")


class Nowhere(Driven):
    """Without a screen and without a terminal."""

    def test_is_told_in_one_line_before_anything_is_written(self):
        blind = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        for words, told in ((self.words, "no display: "), (["run", "my.lua", "--driver", "ego=keyboard"], "no display: "),
                            ([*self.words, "--view", "window"], "no window: "),
                            ([*self.words, "--view", "terminal"], "no terminal: ")):
            before = sorted(self.folder.iterdir())
            code, said = self.reprise(*words, env=blind, start_new_session=True, stdin=subprocess.DEVNULL)
            self.assertEqual(code, 2, said)
            self.assertRegex(said, rf"^reprise: {told}[^\n]*\n$")
            self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_mistakes_are_told(self):
        for words, told in ((["--model", "seden"], "did you mean 'sedan'"), (["--size", "0x9"], "expected such as 256x144"),
                            (["--view", "terminl"], "did you mean 'terminal'"), (["--weather", "sunny"], "weather"),
                            (["--pace", "-1"], "--pace"), (["--camera", "lidar"], "camera")):
            code, said = self.reprise("drive", *words)
            self.assertEqual(code, 2, said)
            self.assertIn(told, said)
            self.assertEqual(said.count("\n"), 1, said)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(word for word in sys.argv[1:])], verbosity=2)
