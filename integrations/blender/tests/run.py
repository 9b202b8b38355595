"""Runs pytest in Blender: blender --background --python run.py -- TESTS.py"""

import os
import sys

import pytest

status = int(pytest.main(["-q", "-p", "no:cacheprovider", *sys.argv[sys.argv.index("--") + 1:]]))
sys.stdout.flush()
os._exit(status)  # Blender's own exit would say 0
