# SPDX-License-Identifier: Apache-2.0
"""The example that the README shows."""
import os
import re
import subprocess
import sys

import tautline

ROOT = os.environ["TAUTLINE_SOURCE_DIR"]
EXAMPLE = os.path.join(ROOT, "plugin", "examples", "elbow_moment_arms.py")


def test_draws_its_picture(tmp_path):
    model = os.path.join(ROOT, "models", "elbow.osim")
    # Where the module is: PYTHONPATH may be relative to another folder than the one that the picture goes to.
    module = os.path.dirname(os.path.dirname(os.path.abspath(tautline.__file__)))
    told = subprocess.run([sys.executable, EXAMPLE, model], cwd=tmp_path, check=True, capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": module})
    assert re.search(r"largest moment arm -?\d+\.\d mm at \d+ degrees", told.stdout), told.stdout
    picture = (tmp_path / "elbow_moment_arms.svg").read_text()
    assert "<svg" in picture and picture.count("<path") > 3


def test_readme_shows_what_runs(monkeypatch):
    with open(os.path.join(ROOT, "README.md")) as readme:
        blocks = re.findall(r"```python\n(.*?)```", readme.read(), re.DOTALL)
    assert len(blocks) == 1
    scope = {}
    monkeypatch.chdir(ROOT)
    exec(blocks[0], scope)  # pylint: disable=exec-used
    assert scope["arms"].shape == (91, len(scope["study"].paths))
    assert abs(scope["paths"].length[0] - 0.2100783) < 1e-6
