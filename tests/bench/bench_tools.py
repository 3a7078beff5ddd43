"""What the bench scripts share: running the program and measuring it, medians, tables."""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/release"
GLIMT = BUILD / "glimt"


@dataclass
class Run:
    """One run of a program: the whole process, from start to end."""

    seconds: float  # wall clock
    processor_seconds: float
    peak_mb: float  # resident, 10^6 bytes
    stats: dict  # what `glimt render --stats` says; "seconds" there is rendering alone


def say(*words):
    print(*words, file=sys.stderr, flush=True)


def warn_if_busy():
    load = os.getloadavg()[0]
    if load > 0.3:
        say(f"The machine is busy (load {load:.1f}); times and ratios of times need a quiet one.")


def build(*targets, groups=("build", "core", "window", "tests"), wishes=()):
    """Sets up and builds like tests/run. Packages of the groups in `wishes` may be missing."""
    subprocess.run([ROOT / "third_party/install", *groups], check=True)
    for group in wishes:
        if subprocess.run([ROOT / "third_party/install", group]).returncode != 0:
            say(f"Going on without the packages of [{group}].")
    for command in (["cmake", "--preset", "release", "-S", ROOT, "-DGLIMT_TESTS=ON"],
                    ["cmake", "--build", BUILD, "--target", *targets]):
        done = subprocess.run(command, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            sys.exit(done.stdout + f"{Path(sys.argv[0]).name}: the build failed")


def run(command):
    """Run of the command; raises CalledProcessError with what it printed where it fails."""
    with tempfile.TemporaryFile() as output:
        start = time.perf_counter()
        child = subprocess.Popen([str(part) for part in command], stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            output.seek(0)
            raise subprocess.CalledProcessError(child.returncode, command, output.read().decode(errors="replace"))
    return Run(seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024e-6, {})


def render(scene, *options, output=None, program=GLIMT):
    """`glimt render`, measured. `output` None: an EXR that is thrown away."""
    with tempfile.TemporaryDirectory() as folder:
        stats = Path(folder) / "stats.json"
        image = output or Path(folder) / "image.exr"
        result = run([program, "render", scene, "-o", image, "--quiet", "--stats", stats, *options])
        result.stats = json.loads(stats.read_text())
        return result


def output_of(program, *arguments):
    """JSON that the program prints."""
    return json.loads(subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout)


def compare(image, reference, program=GLIMT):
    return output_of(program, "compare", image, reference, "--json")


def quartiles(values):
    """Lower quartile, median, upper quartile."""
    if len(values) == 1:
        return values[0], values[0], values[0]
    return tuple(statistics.quantiles(values, n=4, method="inclusive"))


def spread(values, form="{:.3g}"):
    """Median and quartiles as text: "0.28 (0.27..0.31)"."""
    low, middle, high = (form.format(v) for v in quartiles(values))
    return f"{middle} ({low}..{high})"


def table(title, header, rows):
    """Prints rows of texts, the first column to the left and the others to the right."""
    rows = [header, *rows]
    widths = [max(len(row[i]) for row in rows) for i in range(len(header))]
    print(f"\n{title}\n")
    for number, row in enumerate(rows):
        cells = [row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:]))]
        print("  " + "  ".join(cells).rstrip())
        if number == 0:
            print("  " + "  ".join("-" * width for width in widths))
    sys.stdout.flush()
