"""The program with its window on an X server without a screen, driven by mouse and keys. Needs Xvfb and libXtst, which
xdotool brings."""

import ctypes
import os
import re
import subprocess
import sys
import time
from pathlib import Path

WINDOW = (1280, 828)


class Server:
    """An X server without a screen, and hands for it."""

    def __init__(self):
        reading, writing = os.pipe()
        self.process = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "{}x{}x24".format(*WINDOW)],
                                        pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as number:
            self.display = ":" + number.readline().strip()
        self.x, self.test = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
        self.x.XOpenDisplay.restype = ctypes.c_void_p
        self.connection = ctypes.c_void_p(self.x.XOpenDisplay(self.display.encode()))
        if not self.connection:
            raise SystemExit(f"{sys.argv[0]}: Xvfb does not start")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()

    def move(self, x, y):
        self.test.XTestFakeMotionEvent(self.connection, -1, int(x), int(y), 0)
        self.x.XFlush(self.connection)

    def button(self, down, number=1):
        self.test.XTestFakeButtonEvent(self.connection, number, int(down), 0)
        self.x.XFlush(self.connection)

    def click(self, x, y):
        for act in (lambda: self.move(x, y), lambda: self.button(True), lambda: self.button(False)):
            act()
            time.sleep(0.1)

    def keys(self, *symbols):
        codes = [self.x.XKeysymToKeycode(self.connection, ctypes.c_ulong(symbol)) for symbol in symbols]
        for code, down in [(c, 1) for c in codes] + [(c, 0) for c in reversed(codes)]:
            self.test.XTestFakeKeyEvent(self.connection, code, down, 0)
        self.x.XFlush(self.connection)


SPACE, CONTROL, C, Q = 0x20, 0xFFE3, 0x63, 0x71


class Window:
    """The program, started on a scene with so many samples and pixels, until its first picture is on the screen."""

    def __init__(self, program, scene, folder, server, samples=10_000_000, size=None, cwd=None):
        self.server, self.frames, self.controls = server, folder / "frames", folder / "controls"
        for log in (self.frames, self.controls):
            log.unlink(missing_ok=True)
        text = re.sub(r"^(spp *=.*|\[render\])$", "", scene.read_text(), flags=re.M) + f"\n[render]\nspp = {samples}\n"
        for key, pixels in zip(("width", "height"), size or ()):
            text = re.sub(rf"^{key} *=.*", f"{key} = {pixels}", text, flags=re.M)
        self.scene = folder / "scene.toml"
        self.scene.write_text(text)
        settings = folder / "glimt/window.toml"
        if not settings.exists():  # else what the window before has left there
            settings.parent.mkdir(exist_ok=True)
            settings.write_text("picture_fits_window = false\n")
        started = time.time()
        self.process = subprocess.Popen([program, self.scene], cwd=cwd or folder,
                                        env=os.environ | {"DISPLAY": server.display, "XDG_CONFIG_HOME": str(folder),
                                                          "XDG_STATE_HOME": str(folder), "GLIMT_FRAME_LOG": str(self.frames),
                                                          "GLIMT_WIDGET_LOG": str(self.controls)})
        wait_for(lambda: self.pictures() and self.controls.exists())
        self.start = self.pictures()[0][0] - started

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.server.keys(CONTROL, Q)
        try:
            self.process.wait(10)
        finally:
            self.process.kill()

    def pictures(self, after=0):
        """(time, samples, finished) of each, but for the first `after`."""
        if not self.frames.exists():
            return []
        lines = self.frames.read_text().split("\n")[after:-1]
        return [(float(at), int(samples), finished == "1") for at, samples, finished in map(str.split, lines)]

    def chart(self, curves):
        """Shows the chart with so many curves: other seeds, which it reads from its file."""
        self.server.move(400, 300)
        if "chart.hide\t" not in self.controls.read_text():  # as it was at the end of the window before
            self.server.keys(C)
        text = self.scene.read_text()
        for seed in range(2, curves + 2):
            seen = len(self.pictures())
            self.scene.write_text(f"{text}seed = {seed}\n")
            # The curve before had more samples when it ended.
            began = lambda news: any(b < a for (_, a, _), (_, b, _) in zip(news, news[1:]))
            wait_for(lambda: began(self.pictures(max(seen - 1, 0))) and self.pictures()[-1][1] >= 4)
        wait_for(lambda: "curve.0.base\t" in self.controls.read_text())

    def middle_of(self, control):
        for line in self.controls.read_text().splitlines():
            name, place = line.split("\t")
            if name == control:
                x, y, width, height = map(float, place.split())
                return x + width / 2, y + height / 2
        raise SystemExit(f"{sys.argv[0]}: there is no control called {control}")

    def processor_ms(self):
        ticks = 0
        for task in Path(f"/proc/{self.process.pid}/task").iterdir():
            fields = (task / "stat").read_text().rsplit(")", 1)[1].split()
            ticks += int(fields[11]) + int(fields[12])
        return 1000 * ticks / os.sysconf("SC_CLK_TCK")


def wait_for(condition):
    give_up = time.time() + 60
    while not condition():
        if time.time() > give_up:
            raise SystemExit(f"{sys.argv[0]}: gave up waiting for the window")
        time.sleep(0.02)
