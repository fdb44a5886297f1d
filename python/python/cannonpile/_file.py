"""Atomic writing of files."""

from __future__ import annotations

import os
import sys


def write(path: str | os.PathLike[str], text: str, kind: str, *extensions: str) -> None:
    """Write a text atomically: to a temporary file, which then replaces an existing file.

    Raises
    ------
    ValueError
        If the file has an extension, and it is not one of these.
    """
    path = os.fsdecode(path)
    ending = os.path.splitext(path)[1]
    if ending and ending.lower() not in extensions:
        raise ValueError(f"path: {kind}, which the extension of {path} is not: use {extensions[0]}")
    # A symbolic link stays; its target is replaced.
    target = os.path.realpath(path)
    descriptor = _descriptor(path)
    if descriptor is not None:
        # An open file, such as /dev/stdout, is written where it is.
        sys.stdout.flush()
        with open(os.dup(descriptor), "w", encoding="utf-8") as file:
            file.write(text)
        return
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


def _descriptor(path: str) -> int | None:
    """Return the number of the open file of this process that a path leads to. None for any other path."""
    target = path
    for _ in range(40):
        folder, name = os.path.split(target)
        folder = os.path.realpath(folder)
        if name.isdecimal() and folder in map(os.path.realpath, ("/proc/self/fd", "/dev/fd")):
            return int(name)
        if not os.path.islink(target):
            break
        target = os.path.join(folder, os.readlink(target))
    return None
