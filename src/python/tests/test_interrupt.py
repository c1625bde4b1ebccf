"""Ctrl-C ends every command soon, and keeps what the command keeps."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import pendulum

import holonom

#: Calls that would take seconds to hours.
CALLS = {
    "study": {"vary": "l=1..2:4", "record": "max(x)", "until": 1e5},
    "stress": {"x": "step=1e-9..1e-8:2", "y": "l=1..2:2", "limit": "1h", "budget": "9h"},
    "linearize": {"along": "0..1e5:11", "until": 1e5},
    "loci": {"until": 1e5, "every": 1e4},
    "kinematics": {"values": "l=1..2:100000"},
    "validate": {"horizon": 1e5, "until": 1e5, "budget": "1000s"},
    "transition": {"lyapunov": 1e5},
    "drift": {"until": 1e5},
    "tradeoff": {"until": 1e4, "budget": "1000s"},
    "simplify": {"within": "1%", "until": 1e5},
}

#: Commands that write the results so far.
KEEPING = ["study", "stress"]

PROGRAM = """
import signal, sys, time
sys.path.insert(0, sys.argv[1])
import holonom
from conftest import pendulum
from test_interrupt import CALLS
signal.signal(signal.SIGINT, signal.default_int_handler)
scene = holonom.Scene(pendulum())
for name, options in CALLS.items():
    print(name, flush=True)
    try:
        getattr(scene, name)(**options)
        print("not interrupted", flush=True)
    except KeyboardInterrupt as error:
        print(time.monotonic(), hasattr(error, "partial"), flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="a process cannot send itself Ctrl-C there")
def test_ctrl_c_ends_every_command():
    words = [sys.executable, "-c", PROGRAM, str(Path(__file__).parent)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
        for name in CALLS:
            assert process.stdout.readline().strip() == name
            time.sleep(0.5)
            asked = time.monotonic()
            process.send_signal(signal.SIGINT)
            ended, has_part = process.stdout.readline().split()
            # A tenth of a second, and the rest of it for a busy machine. Work that does not hear takes two seconds.
            assert 0 < float(ended) - asked < 1.0, name
            assert name not in KEEPING or has_part == "True", name


def test_rows_of_an_interrupted_study_are_kept(tmp_path):
    """The first variant ends soon, the second never."""
    variants = {"vary": "t_end=0.1..1e6:2", "record": "max(x)", "o": tmp_path / "results"}
    scene = holonom.Scene(pendulum(parameters={"l": 1, "t_end": 1}, simulation={"t_end": "t_end"}))
    signal.setitimer(signal.ITIMER_REAL, 2)
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt) as caught:
            scene.study(**variants)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert caught.value.partial.rows == 1 and caught.value.partial.study.variants == 2
    assert len((tmp_path / "results/study.csv").read_text().splitlines()) == 2
    # The next command is not interrupted.
    assert scene.check().degrees_of_freedom == 1
