"""Both bounds of the normal force of a central bottom sphere of an FCC pile at a = R, in mg, by programs for linear programming."""

import re
import shutil
import subprocess
import tempfile
from fractions import Fraction
from pathlib import Path

import numpy as np
from cannonpile import Pile
from equations import equations, touching

SENSES = ("Minimize", "Maximize")


def centre(layers):
    return (layers - 1) // 3, (layers - 1) // 3


def exact(layers):
    """Returns the bounds of the library, if it proves that they are attained."""
    least, greatest, proved = Pile(layers, spacing=1).bounds(*centre(layers))
    if not proved:
        raise NotImplementedError("the bounds of a pile of this size are not proved to be attained")
    return least, greatest


def error(layers, bounds):
    """Returns the larger error of the two bounds, relative to the upper one."""
    least, greatest, _ = Pile(layers, spacing=1).bounds(*centre(layers))
    return float(max(abs(Fraction(bounds[0]) - least), abs(Fraction(bounds[1]) - greatest)) / greatest)


def program(layers):
    """Returns the equations over all contacts, and the contacts of the central bottom sphere."""
    pile = Pile(layers, spacing=1)
    contacts = touching(pile)
    sites = {tuple(site): number for number, site in enumerate(pile.sites().tolist())}
    bottom = sites[(layers - 1, *centre(layers))]
    return equations(pile, contacts), np.flatnonzero(contacts[1] == bottom)


def highs(layers):
    """Solves both programs with HiGHS in SciPy."""
    import scipy.optimize
    import scipy.sparse

    (rows, columns, entries, totals), borne = program(layers)
    matrix = scipy.sparse.csr_matrix((entries.astype(float), (rows, columns)))
    cost = np.zeros(matrix.shape[1])
    cost[borne] = 1 / 3
    found = [scipy.optimize.linprog(sign * cost, A_eq=matrix, b_eq=totals, method="highs") for sign in (1, -1)]
    return 1 + found[0].fun, 1 - found[1].fun


def from_files(layers, solve):
    """Writes both programs as files, and calls `solve` with each. It returns the sum of the forces on the sphere, in mg/3."""
    (rows, columns, entries, totals), borne = program(layers)
    terms = [[] for _ in totals]
    for row, column, entry in zip(rows.tolist(), columns.tolist(), entries.tolist()):
        terms[row].append(f"{entry:+d} m{column}" if entry else "")
    balance = [f" r{n}: {' '.join(filter(None, row))} = {total}" for n, (row, total) in enumerate(zip(terms, totals.tolist()))]
    goal = " + ".join(f"m{n}" for n in borne)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "pile.lp"
        sums = []
        for sense in SENSES:
            file.write_text("\n".join([f"{sense}\n goal: {goal}", "Subject To", *balance, "End"]) + "\n")
            sums.append(solve(file))
    return tuple(1 + total / 3 for total in sums)


def of_program(name):
    """Returns the path of a program."""
    found = shutil.which(name)
    if not found:
        raise ImportError(f"there is no {name}")
    return found


def qsopt(layers):
    """Solves both programs with QSopt_ex, exactly."""
    esolver = of_program("esolver")

    def solve(file):
        answer = file.with_suffix(".sol")
        subprocess.run([esolver, "-L", "-O", answer, file], check=True, capture_output=True)
        return Fraction(re.search(r"Value = (\S+)", answer.read_text())[1])

    return from_files(layers, solve)


def scip(layers):
    """Solves both programs with the SCIP of PySCIPOpt, in floats with its default tolerance of 1e-6."""
    import pyscipopt

    def solve(file):
        model = pyscipopt.Model()
        model.hideOutput()
        model.readProblem(str(file))
        model.optimize()
        if model.getStatus() != "optimal":
            raise ValueError(f"SCIP says {model.getStatus()}")
        return model.getObjVal()

    return from_files(layers, solve)


def exact_scip(layers):
    """Solves both programs exactly with the program `scip`, if it was built for that. The one of PySCIPOpt is not."""
    program = of_program("scip")

    def solve(file):
        commands = ["set exact enable TRUE", f"read {file}", "optimize", "display solution", "quit"]
        command = [program, *(word for line in commands for word in ("-c", line))]
        said = subprocess.run(command, capture_output=True, text=True, check=False).stdout
        if "in exact solving mode" not in said:
            raise NotImplementedError("this scip was not built for exact programs")
        return Fraction(re.search(r"^objective value: +(\S+)$", said, re.MULTILINE)[1])

    return from_files(layers, solve)
