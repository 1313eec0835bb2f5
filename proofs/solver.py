"""z3 on integers of so many bits."""

from z3 import *

from common import *


def valid(claim, formula, *but_not):
    """z3 proves the formula; and finds an exception to each of those that say a little more."""
    solver = Solver()
    solver.add(Not(formula))
    require(solver.check() == unsat, f"{claim}: {solver}"[:400])
    for more in but_not:
        solver = Solver()
        solver.add(Not(more))
        require(solver.check() == sat, f"{claim}: more than this holds")
    proven(claim)
