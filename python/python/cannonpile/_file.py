"""Files that are the old one or the new one, whole."""

from __future__ import annotations

import os


def write(path: str | os.PathLike[str], text: str) -> None:
    """Write a text aside, then rename it: an older file there is replaced at once, or left as it was."""
    # What a link leads to is replaced, not the link.
    target = os.path.realpath(path)
    if os.path.exists(target) and not os.path.isfile(target):
        # A device or a pipe cannot be replaced; a folder is refused.
        with open(target, "w", encoding="utf-8") as file:
            file.write(text)
        return
    aside = f"{target}.{os.urandom(4).hex()}"
    try:
        with open(aside, "x", encoding="utf-8") as file:
            file.write(text)
        os.replace(aside, target)
    except BaseException:
        if os.path.exists(aside):
            os.remove(aside)
        raise
