"""A process that answers one question at a time, with a time limit: the frame of every system."""

from __future__ import annotations

import os
import re
import resource
import select
import shutil
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

_START_SECONDS = 120.0
#: For so many seconds an answer is awaited without sleeping: to be woken up takes as long as a short answer does.
_AWAKE_SECONDS = 0.05
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

    `kind`: "solved", "none", "undecided" (the system says that it can't, or answers without a solution), "error"; without
    an answer "time-out".
    `form`: what the expressions are: "y" solutions, "omega" their logarithmic derivatives, "riccati" a polynomial of omega.
    `syntax`: the system's name, for the reader of its expressions.
    `partial`: there is only one of two independent solutions.
    """

    kind: str
    form: str = "y"
    syntax: str = ""
    expressions: tuple[str, ...] = ()
    partial: bool = False


def _limit_memory() -> None:
    """In the child: a system that wants more address space than this fails, and not the machine."""
    resource.setrlimit(resource.RLIMIT_AS, (_ADDRESS_SPACE, _ADDRESS_SPACE))


class System:
    """One system.  Subclasses say how it is started, asked and understood."""

    name = ""
    executable = ""
    command: tuple[str, ...] = ()
    opening = ""
    # An answer ends with a line that contains the marker, or where the system prints a prompt, with the prompt.
    end = "<<<end>>>"
    prompt: re.Pattern[bytes] | None = None
    # What the system prints when it can't go on: it waits for an answer of the user's, or its state is damaged.
    stuck: re.Pattern[str] | None = None

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._unfinished = b""  # output that belongs to no line or no question yet
        self.peak_mib = 0.0

    @classmethod
    def is_installed(cls) -> bool:
        return shutil.which(cls.executable) is not None

    def version(self) -> str:
        raise NotImplementedError

    def request(self, S: str) -> str:
        """The text that asks for the solutions, and without a `prompt` then prints the end marker on a line of its own."""
        raise NotImplementedError

    def understand(self, text: str) -> Answer:
        raise NotImplementedError

    def solve(self, S: str, limit: float) -> Reply:
        """Ask for y'' = S y; the process is killed at the limit, and started again for the next equation."""
        if self._process is None:
            self._start()
        return self._ask(self.request(S), limit)

    def close(self) -> None:
        """Note the memory and kill the process group."""
        if self._process is None:
            return
        self._note_memory()
        os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()
        self._process = None

    def _start(self) -> None:
        self._unfinished = b""
        self._process = subprocess.Popen(
            self.command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            bufsize=0,
            start_new_session=True,
            preexec_fn=_limit_memory,
            env={**os.environ, "TERM": "dumb", "COLUMNS": "1000"},
        )
        assert self._process.stdout is not None
        os.set_blocking(self._process.stdout.fileno(), False)
        first = self.opening + self.request("x^2+3")
        for request in [first] if self.prompt is None else ["", first]:  # a prompt comes before the first question, too
            reply = self._ask(request, _START_SECONDS)
            if reply.outcome != "text":
                raise RuntimeError(f"{self.name} doesn't start: {reply.text[-500:]}")

    def _ask(self, request: str, limit: float) -> Reply:
        """Write the request, and read up to the line with the end marker, or to the prompt."""
        assert self._process is not None
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        data, output = request.encode(), self._process.stdout.fileno()
        collected: list[str] = []
        start = time.perf_counter()
        try:
            self._process.stdin.write(data)
        except BrokenPipeError:
            return self._ended("died", collected, start)
        while True:
            *lines, self._unfinished = self._unfinished.split(b"\n")
            for k, line in enumerate(lines):
                text = line.decode(errors="replace")
                if self.end in text:
                    self._unfinished = b"\n".join([*lines[k + 1 :], self._unfinished])
                    return Reply("text", "".join(collected), time.perf_counter() - start)
                collected.append(text + "\n")
                if self.stuck is not None and self.stuck.search(text):
                    return self._ended("died", collected, start)
            if self.prompt is not None and self.prompt.fullmatch(self._unfinished):
                self._unfinished = b""
                return Reply("text", "".join(collected), time.perf_counter() - start)
            part = self._read(output, start, limit)
            if not part:
                return self._ended("died" if part is not None else "time-out", collected, start)
            self._unfinished += part

    @staticmethod
    def _read(output: int, start: float, limit: float) -> bytes | None:
        """What there is to read, once there is something; empty at the end of the output, None at the limit."""
        while True:
            try:
                return os.read(output, 1 << 16)
            except BlockingIOError:
                elapsed = time.perf_counter() - start
            if elapsed > limit:
                return None
            if elapsed > _AWAKE_SECONDS:
                select.select([output], [], [], limit - elapsed)

    def _ended(self, outcome: str, collected: list[str], start: float) -> Reply:
        seconds = time.perf_counter() - start
        self.close()
        return Reply(outcome, "".join(collected), seconds)

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
