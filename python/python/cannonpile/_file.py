"""Atomic writing of files."""

from __future__ import annotations

import os


def write(path: str | os.PathLike[str], text: str) -> None:
    """Write a text atomically: to a temporary file, which then replaces an existing file."""
    # A symbolic link stays; its target is replaced.
    target = os.path.realpath(path)
    if os.path.exists(target) and not os.path.isfile(target):
        # A device or a pipe is written directly; opening a folder raises an error.
        with open(target, "w", encoding="utf-8") as file:
            file.write(text)
        return
    temporary = f"{target}.{os.urandom(4).hex()}"
    try:
        with open(temporary, "x", encoding="utf-8") as file:
            file.write(text)
        os.replace(temporary, target)
    except BaseException:
        if os.path.exists(temporary):
            os.remove(temporary)
        raise
