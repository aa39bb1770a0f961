# SPDX-License-Identifier: BSD-3-Clause
"""A folder for a test's case, removed at the end where the test passed."""
import os
import pathlib
import shutil
import tempfile


def folder(test, name="case"):
    base = pathlib.Path(tempfile.mkdtemp(prefix=f"{type(test).__name__}.", dir=os.environ.get("TMPDIR")))
    if not os.environ.get("BEDSCOPE_KEEP"):
        test.addCleanup(shutil.rmtree, base, True)
    return base / name
