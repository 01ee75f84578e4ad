"""Solve systems by the command `contact` that this wheel installs: a thin layer over `contact solve --batch`.

A system is a mapping whose keys are the long options of `contact solve` with underscores, and an answer has the keys of
`contact solve --format json`; both are strings wherever digits count:

    >>> solve_all([{"height": "1.05"}, {"height": "1.2", "scalar": "exact"}])[0]["contact_force"]
    '4.81'
    >>> with Solver() as solver:
    ...     solver.solve(method="penalty", penalty="1e6")["penetration"]

Decimals as strings are read exactly; a float of Python is written as the shortest decimal that is the same float.
"""

import json
import os
import shutil
import subprocess
import sysconfig
from typing import Any, Dict, Iterable, List, Mapping, Optional

__all__ = ["ContactError", "Solver", "find_contact", "solve_all"]

Number = Any  # int, float, str such as "1/20", Fraction, Decimal
System = Mapping[str, Number]
Answer = Dict[str, Any]


class ContactError(ValueError):
    """The command refuses a system; the message is the one line that it says.

    `index` is the place of the system among those given to `solve_all`, from 0.
    """

    index: Optional[int] = None


def find_contact() -> str:
    """The path of the command: where this wheel has put it, or else on PATH."""
    name = "contact" + (sysconfig.get_config_var("EXE") or "")
    installed = os.path.join(sysconfig.get_path("scripts"), name)
    found = installed if os.path.isfile(installed) else shutil.which("contact")
    if found is None:
        raise FileNotFoundError(f"{installed}: there is no command 'contact', and none on PATH")
    return found


def _refused(message: str, index: Optional[int]) -> ContactError:
    error = ContactError(message)
    error.index = index
    return error


def _line(system: System, index: Optional[int] = None) -> str:
    # What is not finite is no JSON.
    for key, value in system.items():
        if isinstance(value, float) and value - value != 0:
            raise _refused(f"invalid value '{value}' for '{key}': must be finite", index)
    return json.dumps(dict(system), default=str) + "\n"


def _answer(line: str, index: Optional[int] = None) -> Answer:
    answer = json.loads(line)
    if "error" in answer:
        raise _refused(answer["error"], index)
    return answer


def solve_all(systems: Iterable[System], command: Optional[str] = None) -> List[Answer]:
    """Solves many systems at once, on all cores, and returns their answers in the same order.

    Raises `ContactError` with the command's message for the first system that is refused.
    """
    lines = "".join(_line(system, index) for index, system in enumerate(systems))
    arguments = [command or find_contact(), "solve", "--batch"]
    done = subprocess.run(arguments, input=lines, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    # The status is 1 if a line is an error or did not converge: each answer says so itself.
    if done.returncode not in (0, 1):
        raise ContactError(done.stderr.strip())
    return [_answer(line, index) for index, line in enumerate(done.stdout.splitlines())]


class Solver:
    """Solves one system after the other in one process, so that the next may depend on the last answer.

    Options given here are for the systems that do not say otherwise. To be closed, or used by `with`.
    """

    def __init__(self, command: Optional[str] = None, **defaults: Number) -> None:
        self._defaults = defaults
        self._process = subprocess.Popen(
            [command or find_contact(), "solve", "--batch"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
        )

    def solve(self, **system: Number) -> Answer:
        """The answer for one system; raises `ContactError` with the command's message if it is refused."""
        line = _line({**self._defaults, **system})
        try:
            self._process.stdin.write(line)
            self._process.stdin.flush()
            said = self._process.stdout.readline()
        except (BrokenPipeError, ValueError):  # the command has ended, or `close` has been called
            said = ""
        if not said:
            raise ContactError("the command has ended" if self._process.stdin.closed else self._last_words())
        return _answer(said)

    def _last_words(self) -> str:
        return self._process.stderr.read().strip() or "the command has ended"

    def close(self) -> None:
        """Ends the process; further calls do nothing."""
        if not self._process.stdin.closed:
            try:
                self._process.communicate()
            except BrokenPipeError:
                pass

    def __enter__(self) -> "Solver":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
