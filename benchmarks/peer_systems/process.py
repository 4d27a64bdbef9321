"""A process that answers one question at a time, with a time limit: the frame of every system."""

from __future__ import annotations

import os
import re
import resource
import shutil
import signal
import subprocess
import threading
import time
from dataclasses import dataclass
from pathlib import Path
from queue import Empty, Queue

_START_SECONDS = 120.0
#: Bytes of address space; FriCAS reserves eight GiB at its start.
_ADDRESS_SPACE = 12 << 30


@dataclass(frozen=True)
class Reply:
    """What a system printed for one equation, and how long it took; `outcome` is "text", "time-out" or "died"."""

    outcome: str
    text: str
    seconds: float


@dataclass(frozen=True)
class Answer:
    """What the reply says.

    `kind`: "solved", "none", "undecided" (the system says that it can't, or answers without a solution), "error".
    `form`: what the expressions are: "y" solutions, "omega" their logarithmic derivatives, "riccati" a polynomial of omega.
    `syntax`: the system's name, for the reader of its expressions.
    """

    kind: str
    form: str = "y"
    syntax: str = ""
    expressions: tuple[str, ...] = ()


def _limit_memory() -> None:
    """In the child: a system that wants more address space than this fails, and not the machine."""
    resource.setrlimit(resource.RLIMIT_AS, (_ADDRESS_SPACE, _ADDRESS_SPACE))


class System:
    """One system.  Subclasses say how it is started, asked and understood."""

    name = ""
    executable = ""
    command: tuple[str, ...] = ()
    opening = ""
    end = "<<<end>>>"
    # What the system prints when it can't go on: it waits for an answer of the user's, or its state is damaged.
    stuck: re.Pattern[str] | None = None

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None
        self._lines: Queue[str | None] = Queue()
        self.peak_mib = 0.0

    @classmethod
    def is_installed(cls) -> bool:
        return shutil.which(cls.executable) is not None

    def version(self) -> str:
        raise NotImplementedError

    def request(self, S: str) -> str:
        """The text that asks for the solutions, and then prints the end marker on a line of its own."""
        raise NotImplementedError

    def understand(self, text: str) -> Answer:
        raise NotImplementedError

    def solve(self, S: str, limit: float) -> Reply:
        """Ask for y'' = S y; the process is killed at the limit, and started again for the next equation."""
        if self._process is None:
            self._start()
        assert self._process is not None
        assert self._process.stdin is not None
        start = time.perf_counter()
        try:
            self._process.stdin.write(self.request(S))
            self._process.stdin.flush()
        except BrokenPipeError:
            return self._ended("died", "", start)
        return self._collect(start, start + limit)

    def close(self) -> None:
        """Note the memory and kill the process group."""
        if self._process is None:
            return
        self._note_memory()
        os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        self._process = None

    def _start(self) -> None:
        self._lines = Queue()
        self._process = subprocess.Popen(
            self.command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            errors="replace",
            start_new_session=True,
            preexec_fn=_limit_memory,
            env={**os.environ, "TERM": "dumb", "COLUMNS": "1000"},
        )
        threading.Thread(target=self._read, args=(self._process, self._lines), daemon=True).start()
        assert self._process.stdin is not None
        self._process.stdin.write(self.opening + self.request("x^2+3"))
        self._process.stdin.flush()
        start = time.perf_counter()
        reply = self._collect(start, start + _START_SECONDS)
        if reply.outcome != "text":
            raise RuntimeError(f"{self.name} doesn't start: {reply.text[-500:]}")

    @staticmethod
    def _read(process: subprocess.Popen[str], lines: Queue[str | None]) -> None:
        assert process.stdout is not None
        for line in process.stdout:
            lines.put(line)
        lines.put(None)

    def _collect(self, start: float, deadline: float) -> Reply:
        collected: list[str] = []
        while True:
            try:
                line = self._lines.get(timeout=max(0.0, deadline - time.perf_counter()))
            except Empty:
                return self._ended("time-out", "".join(collected), start)
            if line is None:
                return self._ended("died", "".join(collected), start)
            if self.end in line:
                return Reply("text", "".join(collected), time.perf_counter() - start)
            collected.append(line)
            if self.stuck is not None and self.stuck.search(line):
                return self._ended("died", "".join(collected), start)

    def _ended(self, outcome: str, text: str, start: float) -> Reply:
        seconds = time.perf_counter() - start
        self.close()
        return Reply(outcome, text, seconds)

    def _note_memory(self) -> None:
        assert self._process is not None
        self.peak_mib = max(self.peak_mib, sum(_peak_mib(pid) for pid in _family(self._process.pid)))


def _family(pid: int) -> list[int]:
    found = [pid]
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in task.read_text().split():
            found += _family(int(child))
    return found


def _peak_mib(pid: int) -> float:
    try:
        status = Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return 0.0
    match = re.search(r"VmHWM:\s*(\d+)", status)
    return int(match.group(1)) / 1024 if match else 0.0
