"""Interactive pages of a pile."""

from __future__ import annotations

import os

from ._file import write


class Page:
    """An interactive page of a pile, from `Pile.show`. Jupyter displays it.

    The page is one self-contained HTML document, which opens in a browser without network access.

    Parameters
    ----------
    html : str
        The HTML document.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> Pile(4).show().html[:15]
    '<!doctype html>'
    """

    __slots__ = ("_html",)

    # The height of the frame in Jupyter, in pixels.
    _HEIGHT = 640

    def __init__(self, html: str) -> None:
        self._html = html

    @property
    def html(self) -> str:
        """The HTML document.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> "http://" in Pile(4).show().html
        False
        """
        return self._html

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the document to a file, which a browser can open.

        Parameters
        ----------
        path : str or path
            The file, with the extension ``.html``, ``.htm`` or none. An existing file is replaced.

        Raises
        ------
        ValueError
            If the extension of the file is not that of an HTML document.
        OSError
            If the file cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> from cannonpile import Pile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder, "pile.html")
        ...     Pile(4).show().save(path)
        ...     path.read_text(encoding="utf-8")[:15]
        '<!doctype html>'
        """
        write(path, self._html, "pages are HTML", ".html", ".htm")

    def _repr_html_(self) -> str:
        # A frame separates the styles and scripts of the page from those of the notebook.
        document = self._html.replace("&", "&amp;").replace('"', "&quot;")
        style = f"width: 100%; height: {self._HEIGHT}px; border: 0"
        return f'<iframe title="A pile of spheres" sandbox="allow-scripts" style="{style}" srcdoc="{document}"></iframe>'

    def __str__(self) -> str:
        return self._html

    def __repr__(self) -> str:
        return f"<Page: {len(self._html)} characters of HTML>"
