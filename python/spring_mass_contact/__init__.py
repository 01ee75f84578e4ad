"""Solutions of systems by the command `contact` of this wheel: a thin layer over `contact solve --batch`.

A system is a mapping whose keys are the long options of `contact solve` with underscores; what is not in it has the
default that `contact help solve` prints, and `id` may be anything:

    id, stiffness, mass, gravity, free_length, height, method, penalty, tolerance, max_augmentations,
    initial_multiplier, bilateral, scalar

An answer has the keys of `contact solve --format json`. Numbers of an answer are strings, which keep all digits:

    >>> [answer["contact_force"] for answer in solve_all([{"height": "1.05"}, {"height": 1.2}], scalar="exact")]
    ['481/100', '0']
    >>> with Solver(method="penalty", scalar="exact") as solver:
    ...     solver.solve(penalty="1e6")["penetration"]
    '481/100010000'

Decimals as strings are read exactly; a float of Python is written as the shortest decimal that is the same float.
`state` is contact, grazing or separated. A solve that does not converge has an answer, too: `outcome` is direct or
converged if all is well, or else stagnated or iteration_limit.
"""

import json
import os
import shutil
import subprocess
import sysconfig
import threading
from typing import Any, Dict, Iterable, List, Mapping, Optional

__all__ = ["ContactError", "Solver", "find_contact", "solve_all"]

Number = Any  # int, float, str such as "1/20", Fraction, Decimal
System = Mapping[str, Number]
Answer = Dict[str, Any]


class ContactError(ValueError):
    """Refusal of a system by the command; the message is its line.

    `index` is the position of the system among those given to `solve_all`, from 0.
    """

    index: Optional[int] = None


def find_contact() -> str:
    """Returns the path of the command: that of this wheel, or else one on PATH."""
    name = "contact" + (sysconfig.get_config_var("EXE") or "")
    installed = os.path.join(sysconfig.get_path("scripts"), name)
    found = installed if os.path.isfile(installed) else shutil.which("contact")
    if found is None:
        raise FileNotFoundError(f"{installed}: there is no command 'contact', and none on PATH")
    return found


def _batch(command: Optional[str]) -> List[str]:
    if not isinstance(command, (str, os.PathLike, type(None))):
        raise TypeError(f"command {command!r}: must be the path of a program; options are keywords")
    return [os.fspath(command or find_contact()), "solve", "--batch"]


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


def solve_all(systems: Iterable[System], command: Optional[str] = None, **defaults: Number) -> List[Answer]:
    """Solves many systems on all cores, and returns their answers in the same order.

    The keywords are options of all systems that do not contain them. Raises `ContactError` with the command's message
    for the first system that is refused. `command` is the path of another `contact` than that of the wheel.
    """
    arguments = _batch(command)
    lines = []
    for index, system in enumerate(systems):
        if not isinstance(system, Mapping):
            raise TypeError(f"systems[{index}] {system!r}: must be a mapping of options")
        lines.append(_line({**defaults, **system}, index))
    done = subprocess.run(arguments, input="".join(lines), stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    # The status is 1 if a line is an error or did not converge: each answer says so itself.
    answers = done.stdout.splitlines()
    if done.returncode not in (0, 1) or len(answers) != len(lines):
        ended = f"the command has ended with status {done.returncode} and {len(answers)} of {len(lines)} answers"
        raise ContactError(done.stderr.strip() or ended)
    return [_answer(line, index) for index, line in enumerate(answers)]


class Solver:
    """Solver of one system after the other in one process, so that the next may depend on the last answer.

    The keywords are options of all systems that do not contain them, and `command` is the path of another `contact`
    than that of the wheel. A solver is closed by `close` or `with`. Threads may share it, and take turns.
    """

    def __init__(self, command: Optional[str] = None, **defaults: Number) -> None:
        self._defaults = defaults
        self._turn = threading.Lock()
        self._process = subprocess.Popen(
            _batch(command),
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
        )

    def solve(self, **system: Number) -> Answer:
        """Returns the answer for one system, whose options are keywords: a mapping is passed as `**system`.

        Raises `ContactError` with the command's message if it is refused. If an exception such as `KeyboardInterrupt`
        interrupts the wait for an answer, the solver ends: the next call would return this answer.
        """
        line = _line({**self._defaults, **system})
        with self._turn:
            try:
                self._process.stdin.write(line)
                self._process.stdin.flush()
                said = self._process.stdout.readline()
            except (BrokenPipeError, ValueError):  # the command has ended, or `close` has been called
                said = ""
            except BaseException:
                self._process.kill()
                self.close()
                raise
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
