"""Figures."""

from __future__ import annotations

import os

from ._file import write


class Figure:
    """A figure as SVG. Jupyter displays it.

    Parameters
    ----------
    svg : str
        The SVG document.
    note : str, optional
        A warning about the pile.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> figure = Pile(10).plot("network")
    >>> figure.svg[:5]
    '<svg '
    """

    __slots__ = ("_note", "_svg")

    def __init__(self, svg: str, note: str | None = None) -> None:
        self._svg = svg
        self._note = note

    @property
    def svg(self) -> str:
        """The SVG document.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(3).plot("shear").svg.count('class="arrow"')
        6
        """
        return self._svg

    @property
    def note(self) -> str | None:
        """A warning that the pile is unstable, or that its stability is unknown. None without a warning.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(7, "hcp").plot("network").note[:10]
        'this pile '
        >>> Pile(7).plot("network").note is None
        True
        """
        return self._note

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the document to a file.

        Parameters
        ----------
        path : str or path
            The file, with the extension ``.svg`` or none. An existing file is replaced.

        Raises
        ------
        ValueError
            If the extension of the file is not that of an SVG document.
        OSError
            If the file cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> from cannonpile import Pile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder, "base.svg")
        ...     Pile(4).plot("base").save(path)
        ...     path.read_text(encoding="utf-8")[:5]
        '<svg '
        """
        write(path, self._svg, "figures are SVG", ".svg")

    def _repr_svg_(self) -> str:
        return self._svg

    def __str__(self) -> str:
        return self._svg

    def __repr__(self) -> str:
        return f"<Figure: {len(self._svg)} characters of SVG>"
