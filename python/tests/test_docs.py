"""The README and docs/python.md do what they say: all of their code runs, in the pages' order."""

import os
import re
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]


def test_the_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    os.symlink(PROJECT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    blocks = [block for page in ("README.md", "docs/python.md")
              for block in re.findall(r"```python\n(.*?)```", (PROJECT / page).read_text(), re.DOTALL)]
    assert len(blocks) >= 7
    exec(compile("\n".join(blocks), "docs/python.md", "exec"), {})
    for name in ("smoke.vdb", "cloud.vdb", "cloud.png", "moss.json"):
        assert (tmp_path / name).stat().st_size > 0
    assert "solidnoise.gabor(dims=3, frequency=4.0, seed=7, octaves=3)" in capsys.readouterr().out
