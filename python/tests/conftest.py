import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.fixture
def tool(tmp_path: Path) -> Callable[..., str]:
    """Runs one of the programs in the test's folder; returns what it printed."""

    def run(name: str, *arguments: object) -> str:
        command = [os.path.join(os.environ["SOLIDNOISE_TOOLS"], name), *map(str, arguments)]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True).stdout

    return run
