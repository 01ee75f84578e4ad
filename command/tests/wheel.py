"""Test of the installed wheel: `python -I command/tests/wheel.py VERSION`."""

import doctest
import pathlib
import shutil
import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from decimal import Decimal
from fractions import Fraction
from importlib import metadata, resources

import spring_mass_contact
from spring_mass_contact import ContactError, Solver, find_contact, solve_all


def refused(call, message, index=None):
    try:
        call()
    except ContactError as error:
        assert message in str(error) and "\n" not in str(error), error
        assert error.index == index, error.index
    else:
        raise AssertionError(f"not refused: {message}")


def main(version):
    root = pathlib.Path(__file__).resolve().parent.parent
    assert root not in pathlib.Path(spring_mass_contact.__file__).parents or "wheel-tried" in spring_mass_contact.__file__
    assert metadata.version("spring-mass-contact") == version
    assert pathlib.Path(find_contact()).parent == pathlib.Path(sys.executable).parent
    assert resources.files("spring_mass_contact").joinpath("py.typed").is_file()

    # R = 9.81 − 100 (H − 1) pushes, or there is no force; in the order that was asked.
    heights = ["1.05", Decimal("1.05"), Fraction(21, 20), 1.2]
    answers = solve_all({"height": height, "scalar": "exact"} for height in heights)
    assert [answer["contact_force"] for answer in answers] == ["481/100"] * 3 + ["0"], answers
    assert solve_all([]) == []
    assert solve_all([{"height": 1.2}, {"height": 1.2, "scalar": "f64"}], scalar="exact")[1]["scalar"] == "f64"
    for systems in ({"height": 1}, ["height"]):
        try:
            solve_all(systems)
        except TypeError as error:
            assert str(error) == "systems[0] 'height': must be a mapping of options", error
        else:
            raise AssertionError(f"not refused: {systems}")
    documented = doctest.testmod(spring_mass_contact)
    assert documented.attempted > 1 and not documented.failed, documented
    # More than a pipe holds, both ways.
    many = solve_all({"height": "1.05", "scalar": "exact", "id": n} for n in range(5000))
    assert [answer["id"] for answer in many] == list(range(5000))
    refused(lambda: solve_all([{}, {"mass": -1}]), "invalid value '-1' for 'mass'", 1)
    refused(lambda: solve_all([{"mas": 2}]), "unexpected key 'mas'", 0)
    refused(lambda: solve_all([{"mass": float("nan")}]), "invalid value 'nan' for 'mass'", 0)

    # A refusal ends nothing; p = R/(c + ε).
    with Solver(scalar="exact", method="penalty") as solver:
        refused(lambda: solver.solve(penalty="0"), "invalid value '0' for 'penalty'")
        assert Fraction(solver.solve(penalty=100)["penetration"]) == Fraction("4.81") / 200
        stalled = solver.solve(method="augmented", scalar="f64", penalty=1e5, tolerance="1e-30")
        assert stalled["outcome"] == "stagnated", stalled
    refused(solver.solve, "the command has ended")
    solver.close()
    # An answer that nobody waited for is not that of the next system.
    slow = dict(method="augmented", scalar="mpfr:1000000", penalty=1, tolerance="1e-100000", max_augmentations=10**6)
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, signal.default_int_handler)
        with Solver() as solver:
            signal.setitimer(signal.ITIMER_REAL, 0.2)
            try:
                solver.solve(**slow)
            except KeyboardInterrupt:
                pass
            else:
                raise AssertionError("not interrupted")
            refused(solver.solve, "the command has ended")
    # Threads take turns.
    with Solver() as solver, ThreadPoolExecutor(8) as pool:
        assert list(pool.map(lambda n: solver.solve(id=n)["id"], range(2000))) == list(range(2000))
    # Without an answer for each system there is none; Python refuses the words that it is called with.
    for call in (lambda: solve_all([{}], {"height": 1}), lambda: Solver({"height": 1})):
        try:
            call()
        except TypeError as error:
            assert "command {'height': 1}: must be the path" in str(error), error
        else:
            raise AssertionError("not refused")
    for silent in filter(None, map(shutil.which, ("true", "false"))):
        refused(lambda: solve_all([{}, {}], silent), "and 0 of 2 answers")
    # It is not the command that fails.
    refused(lambda: Solver(command=sys.executable).solve(), "solve")


if __name__ == "__main__":
    main(sys.argv[1])
