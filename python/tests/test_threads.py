"""Long computations release the interpreter lock and can be cancelled with Ctrl-C."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections import deque

import pytest

import cannonpile
from cannonpile import Pile

BREATH = 0.002
ENOUGH = 4


def ticks_during(work):
    """Return the number of ticks of another thread during the work, and the duration in seconds."""
    ticks, running = [], True

    def tick():
        while running:
            ticks.append(time.perf_counter())
            time.sleep(BREATH)

    ticking = threading.Thread(target=tick)
    ticking.start()
    while not ticks:
        time.sleep(BREATH)
    try:
        began = time.perf_counter()
        work()
        ended = time.perf_counter()
    finally:
        running = False
        ticking.join()
    return sum(began < at < ended for at in ticks), ended - began


# Work of increasing size. The first size that takes long enough on this machine is used.
LONG = {
    "forces": lambda n: Pile(20 * n, "hcp").forces(),
    "forces of a straight pile": lambda n: Pile(60 * n).forces(),
    "vectors": lambda n: Pile(40 * n).vectors(),
    "positions": lambda n: Pile(40 * n).positions(),
    "contact_ids": lambda n: Pile(60 * n).contact_ids(),
    "multiples": lambda n: Pile(20 * n, "hcp").multiples(),
    "base": lambda n: Pile(40 * n, "hcp").base(),
    "stands": lambda n: Pile(20 * n, "hcp").stands,
    "weakest": lambda n: Pile(20 * n, "hcp").weakest(),
    "bounds": lambda n: Pile(3 + 2 * n).bounds(0, 0),
    "elastic": lambda n: Pile(6 + 3 * n, "+-+-+" + "+++" * n).elastic(),
    "compare": lambda n: compared(20 * n),
    "plot": lambda n: Pile(8 * n).plot("network"),
    "census": lambda n: deque(cannonpile.census(8 + n), maxlen=0),
    "mean": lambda n: cannonpile.mean(8 + 4 * n),
    "prove": lambda n: [cannonpile.prove() for _ in range(n)],
}


def compared(layers):
    pile = Pile(layers)
    pile.compare(pile.contact_ids(), pile.forces())


@pytest.mark.parametrize("name", LONG)
def test_another_thread_ticks(name):
    for size in range(1, 12):
        ticks, seconds = ticks_during(lambda: LONG[name](size))
        # On a busy machine the other thread may tick late.
        if ticks >= ENOUGH or seconds > 1000 * BREATH:
            break
    print(f"{name}: {ticks} ticks in {seconds:.2f} s")
    assert ticks >= ENOUGH


def test_held_interpreter_lock_is_detected():
    # Work that holds the interpreter lock prevents ticks.
    ticks, seconds = ticks_during(lambda: sum(range(3 * 10**7)))
    assert seconds > 50 * BREATH
    assert ticks < ENOUGH


def test_threads_share_a_pile():
    pile, found = Pile(30, "hcp"), []
    threads = [threading.Thread(target=lambda: found.append((pile.stands, pile.forces().sum()))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8 and len(set(found)) == 1


# Each takes minutes.
ENDLESS = {
    "forces": "[Pile(150, 'hcp').forces() for _ in range(1000)]",
    "multiples": "Pile(300, 'hcp').multiples()",
    "positions": "[Pile(300).positions() for _ in range(1000)]",
    "contact_ids": "[Pile(300).contact_ids() for _ in range(1000)]",
    "stands": "[Pile(1000, 'hcp').stands for _ in range(1000)]",
    "census": "list(cannonpile.census(2000))",
    "mean": "cannonpile.mean(200)",
    "elastic": "Pile(27, '+-+-+' + '+' * 21).elastic()",
    "prove": "[cannonpile.prove() for _ in range(10**6)]",
}


@pytest.mark.skipif(os.name != "posix", reason="the test needs POSIX signals")
@pytest.mark.parametrize("name", ENDLESS)
def test_ctrl_c(name):
    program = f"import cannonpile\nfrom cannonpile import Pile\nprint('begun', flush=True)\n{ENDLESS[name]}\nprint('ended')"
    # A script in the background of a shell ignores Ctrl-C by default.
    program = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n" + program
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            assert process.stdout.readline() == "begun\n"
            time.sleep(0.7)
            assert process.poll() is None, "the computation ended too early"
            process.send_signal(signal.SIGINT)
            sent = time.perf_counter()
            output, errors = process.communicate(timeout=20)
            print(f"{name}: {time.perf_counter() - sent:.2f} s after Ctrl-C")
        finally:
            process.kill()
    # A note may follow.
    assert re.search("^KeyboardInterrupt", errors, re.MULTILINE), errors
    assert output == ""
    assert process.returncode in (-signal.SIGINT, 130)
