"""Figures and files."""

import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest

import cannonpile
from cannonpile import Pile

KINDS = ["pile", "indexing", "sphere", "shear", "base", "bounds", "network", "response"]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("units", ["pile", "si"])
def test_every_kind_is_svg(kind, units):
    figure = Pile(4).plot(kind, units=units)
    assert isinstance(figure, cannonpile.Figure)
    root = ElementTree.fromstring(figure.svg)
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert len(list(root.iter())) > 10
    assert figure._repr_svg_() == str(figure) == figure.svg


def test_figures_differ():
    assert len({Pile(4).plot(kind).svg for kind in KINDS}) == len(KINDS)
    assert Pile(4).plot().svg == Pile(4).plot("network").svg
    assert Pile(4).plot("base").svg != Pile(5).plot("base").svg
    assert Pile(4).plot("base").svg != Pile(4).plot("base", units="si").svg
    assert Pile(4).plot("base").svg != Pile(4).plot("base", title=False).svg


def test_width():
    for width in (300, 900):
        root = ElementTree.fromstring(Pile(4).plot("network", width=width).svg)
        assert str(width) in (root.get("width") or "") + " " + (root.get("viewBox") or "")


def test_at_and_layer():
    pile = Pile(5)
    assert pile.plot("sphere", at=(2, 1, 0)).svg != pile.plot("sphere", at=(2, 0, 1)).svg
    assert pile.plot("sphere", at=(4, 1, 1)).svg == pile.plot("sphere", at=(1, 1)).svg
    assert pile.plot("network", layer=1).svg != pile.plot("network", layer=2).svg


def test_note_warns_of_unstable_pile():
    assert Pile(4).plot("network").note is None
    note = Pile(8, "hcp").plot("network").note
    assert note and "\n" not in note


def test_save(tmp_path):
    figure = Pile(4).plot("base")
    assert figure.save(tmp_path / "base.svg") is None
    assert (tmp_path / "base.svg").read_text(encoding="utf-8") == figure.svg
    figure.save(str(tmp_path / "again.svg"))
    assert (tmp_path / "again.svg").read_bytes() == (tmp_path / "base.svg").read_bytes()
    with pytest.raises(OSError):
        figure.save(tmp_path / "nowhere" / "base.svg")


def test_save_is_atomic(tmp_path, monkeypatch):
    figure, old = Pile(6).plot("base"), tmp_path / "base.svg"
    old.write_text("old")
    link = tmp_path / "link.svg"
    link.symlink_to(old)

    def fail(*_):
        raise OSError("no room")

    with monkeypatch.context() as broken:
        broken.setattr("os.replace", fail)
        with pytest.raises(OSError, match="no room"):
            figure.save(old)
    assert old.read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["base.svg", "link.svg"]
    figure.save(link)
    assert link.is_symlink()
    assert old.read_text(encoding="utf-8") == figure.svg
    with pytest.raises(IsADirectoryError):
        figure.save(tmp_path)


def test_export(tmp_path):
    names = Pile(4, spacing="6/5").export(tmp_path / "pile", "csv", "lammps", "vtp", "yade", "card")
    assert set(names) == {path.name for path in (tmp_path / "pile").iterdir()}
    assert {"contacts.csv", "pile.in", "pile.py", "card.md", "scene.toml"} <= set(names)
    assert all((tmp_path / "pile" / name).stat().st_size for name in names)
    # The default format is csv.
    assert "contacts.csv" in Pile(4).export(str(tmp_path / "tables"))


@pytest.mark.parametrize("name", ["shear.png", "shear.pdf", "shear.html"])
def test_figures_are_svg(tmp_path, name):
    path = tmp_path / name
    with pytest.raises(ValueError, match="figures are SVG, which the extension of .* is not: use .svg"):
        Pile(4).plot("shear").save(path)
    assert not path.exists()
    for kept in ("shear.SVG", "shear"):
        Pile(4).plot("shear").save(tmp_path / kept)
    with pytest.raises(ValueError, match="pages are HTML"):
        Pile(4).show().save(tmp_path / "pile.svg")


def test_open_files_are_not_replaced(tmp_path):
    if not os.path.exists("/dev/stdout"):
        pytest.skip("the system has no names of open files")
    code = "from cannonpile import Pile; Pile(2).plot('shear').save('/dev/stdout')"
    log = tmp_path / "log.txt"
    with log.open("w") as out:
        out.write("before\n")
        out.flush()
        subprocess.run([sys.executable, "-c", code], stdout=out, check=True)
        out.seek(0, os.SEEK_END)
        out.write("after\n")
    text = log.read_text(encoding="utf-8")
    assert text.startswith("before\n<svg ") and text.endswith("after\n")
