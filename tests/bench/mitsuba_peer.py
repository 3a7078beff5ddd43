"""Mitsuba 3 in a virtual environment of its own, one process for each variant."""

import glob
import json
import os
import re
import subprocess
import venv

from bench_tools import ROOT, say

VENV = ROOT / "build/peers-venv"
PYTHON = VENV / "bin/python3"


def newest_llvm():
    """Path of the newest libLLVM of the system, or None."""
    def version(path):
        return int(re.search(r"libLLVM(?:-|\.so\.)(\d+)", path)[1])

    found = [p for pattern in ("/usr/lib/*/libLLVM*.so*", "/usr/lib/llvm-*/lib/libLLVM*.so*", "/usr/lib64/libLLVM*.so*")
             for p in glob.glob(pattern) if re.search(r"libLLVM(-|\.so\.)\d+", p)]
    return max(found, key=version, default=None)


def install():
    """Makes the environment where it is missing. False, and why on stderr, where that fails."""
    def works():
        return PYTHON.exists() and subprocess.run([PYTHON, "-c", "import mitsuba, numpy"]).returncode == 0

    if PYTHON.exists() and works():
        return True
    say("Installing Mitsuba 3 into build/peers-venv")
    try:
        venv.create(VENV, with_pip=True, clear=True)
        subprocess.run([PYTHON, "-m", "pip", "install", "--quiet", "mitsuba", "numpy"], check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        say(f"Mitsuba could not be installed: {error}")
        return False
    return works()


class Worker:
    """A process that renders with one variant. Raises RuntimeError with Mitsuba's message."""

    def __init__(self, variant):
        environment = dict(os.environ)
        if variant.startswith("llvm") and "DRJIT_LIBLLVM_PATH" not in environment:
            library = newest_llvm()
            if not library:
                raise RuntimeError("no libLLVM on this system")
            environment["DRJIT_LIBLLVM_PATH"] = library
        self.llvm = environment.get("DRJIT_LIBLLVM_PATH") if variant.startswith("llvm") else None
        self.process = subprocess.Popen([PYTHON, ROOT / "tests/bench/mitsuba_worker.py", variant], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
        self.version = self._answer()["version"]

    def _answer(self):
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError("Mitsuba ended without an answer")
        answer = json.loads(line)
        if "error" in answer:
            raise RuntimeError(answer["error"])
        return answer

    def render(self, **job):
        self.process.stdin.write(json.dumps(job, default=str) + "\n")
        self.process.stdin.flush()
        return self._answer()

    def close(self):
        self.process.stdin.close()
        self.process.wait()
