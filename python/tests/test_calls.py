"""Long calls: progress, interruption, the end of the interpreter. Each of those that may end the process has one of its own."""

import os
import re
import signal
import subprocess
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import solidnoise


def run(script: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([sys.executable, "-X", "faulthandler", "-c", textwrap.dedent(script)], capture_output=True, text=True, timeout=120)


def test_progress_rises_to_1() -> None:
    fractions: list[float] = []
    solidnoise.gabor(frequency=40).lattice(0, 0.004, 200, progress=fractions.append)
    assert len(fractions) > 2 and fractions == sorted(fractions) and (fractions[0], fractions[-1]) == (0.0, 1.0)


def test_what_progress_raises_ends_the_call() -> None:
    class Enough(Exception):
        pass

    def stop(fraction: float) -> None:
        if fraction >= least:
            raise Enough(fraction)

    for least in (0.0, 1e-9):  # before the work, and in it
        with pytest.raises(Enough) as raised:
            solidnoise.gabor(frequency=100).lattice(0, 0.002, 900, progress=stop)  # some ten seconds
        assert least <= raised.value.args[0] < 1.0


def test_interruption_ends_a_call() -> None:
    found = run("""
        import os, signal, threading, solidnoise
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        try:
            solidnoise.gabor(frequency=300).lattice(0, 0.0005, 900)  # minutes
        except KeyboardInterrupt:
            print("interrupted")
        print(solidnoise.gabor().lattice(0, 0.1, 8).shape)  # and the next one works
    """)
    assert found.stdout == "interrupted\n(8, 8, 8)\n" and found.returncode == 0, found.stderr


def test_interruption_ends_a_texture() -> None:
    found = run("""
        import os, signal, threading, numpy as np, solidnoise
        model = solidnoise.fit(np.random.default_rng(1).random((64, 64, 3)))
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        try:
            model.texture((16384, 16384))  # minutes
        except KeyboardInterrupt:
            print("interrupted")
    """)
    assert found.stdout == "interrupted\n" and found.returncode == 0, found.stderr


def test_interruption_ends_the_writing_of_a_picture_and_leaves_none(tmp_path: Path) -> None:
    found = run(f"""
        import os, signal, threading, numpy as np, solidnoise
        pixels = np.random.default_rng(1).random((8000, 8000), dtype=np.float32)
        threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        try:
            solidnoise.write_image("{tmp_path}/x.png", pixels)  # eight seconds
        except KeyboardInterrupt:
            print("interrupted", os.listdir("{tmp_path}"))
    """)
    assert found.stdout == "interrupted []\n" and found.returncode == 0, found.stderr


def test_interruption_ends_the_fit_of_a_solid_and_curvature() -> None:
    for call in ("solidnoise.fit(pixels, solid=True, kappa=1e-6)", "solidnoise.curvature(vertices, faces, smooth=10000)"):
        found = run(f"""
            import os, signal, threading, numpy as np, solidnoise
            pixels = np.random.default_rng(1).random((512, 512))
            x, y = np.meshgrid(np.arange(300.0), np.arange(300.0))
            vertices = np.stack([x.ravel(), y.ravel(), np.sin(0.1 * x.ravel())], axis=-1)
            corner = (np.arange(299)[:, None] * 300 + np.arange(299)).ravel()
            faces = np.stack([corner, corner + 1, corner + 301, corner + 300], axis=-1)
            threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            try:
                {call}  # half a minute
            except KeyboardInterrupt:
                print("interrupted")
        """)
        assert found.stdout == "interrupted\n" and found.returncode == 0, (call, found.stderr)


def test_curvature_the_fit_of_a_solid_and_textures_tell_their_progress() -> None:
    x, y = np.meshgrid(np.arange(250.0), np.arange(250.0))
    vertices = np.stack([x.ravel(), y.ravel(), np.sin(0.1 * x.ravel())], axis=-1)
    corner = (np.arange(249)[:, None] * 250 + np.arange(249)).ravel()
    faces = np.stack([corner, corner + 1, corner + 251, corner + 250], axis=-1)

    def bend(told: Callable[[float], object]) -> object:
        return solidnoise.curvature(vertices, faces, smooth=1000, progress=told)

    def learn(told: Callable[[float], object]) -> object:
        return solidnoise.fit(np.random.default_rng(1).random((512, 512, 3)), solid=True, progress=told)

    def draw(told: Callable[[float], object]) -> object:
        return solidnoise.fit(np.random.default_rng(1).random((64, 64))).texture((4096, 4096), progress=told)

    for call in (bend, learn, draw):
        fractions: list[float] = []
        call(fractions.append)
        assert len(fractions) > 3 and fractions == sorted(fractions) and fractions[-1] == 1.0


def test_a_volume_that_needs_more_memory_than_is_allowed_is_not_begun() -> None:
    with pytest.raises(MemoryError) as raised:
        solidnoise.make_volume(solidnoise.preset("cumulus"), dim=2000, max_memory=2**30)
    assert re.fullmatch(r"\d+ x \d+ x \d+ voxels may need [\d.]+ GiB, max_memory allows 1.0 GiB; make dim smaller or voxel larger",
                        str(raised.value))
    assert solidnoise.make_volume(solidnoise.preset("cumulus"), dim=16, max_memory=2**30).grids


def test_more_threads_than_there_are_processors_are_taken_without_a_word() -> None:
    found = run("""
        import solidnoise
        print(solidnoise.gabor().lattice(0, 0.1, 64, threads=4096).shape)
    """)
    assert (found.stdout, found.stderr) == ("(64, 64, 64)\n", "")


def test_the_interpreter_ends_with_work_under_way() -> None:
    found = run("""
        import threading, time, solidnoise
        def work():
            while True:
                solidnoise.gabor(frequency=300).lattice(0, 0.0005, 600)
        for _ in range(3):
            threading.Thread(target=work, daemon=True).start()
        time.sleep(0.5)
        print("ends")
    """)
    assert found.stdout == "ends\n" and found.returncode == 0, found.stderr


def test_other_threads_go_on_during_a_call() -> None:
    import threading

    turns = 0
    done = threading.Event()

    def count() -> None:
        nonlocal turns
        while not done.is_set():
            turns += 1
            done.wait(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begun = turns
    solidnoise.gabor(frequency=100).lattice(0, 0.002, 200)
    during = turns - begun
    done.set()
    thread.join()
    assert during > 5  # had the call kept the interpreter to itself, it would be 0 or 1


def test_a_signal_handler_runs_during_a_call() -> None:
    seen: list[int] = []
    before = signal.signal(signal.SIGUSR1, lambda number, frame: seen.append(number))
    try:
        import threading

        threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGUSR1)).start()
        solidnoise.gabor(frequency=100).lattice(0, 0.002, 300)
        assert seen == [signal.SIGUSR1]
    finally:
        signal.signal(signal.SIGUSR1, before)
