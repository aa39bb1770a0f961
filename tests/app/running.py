# SPDX-License-Identifier: BSD-3-Clause
"""What tests of the command share: the program, and a folder that is thrown away."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else "bedscope"
PATIENCE = 120  # s that a run may need on a busy machine


class Running(unittest.TestCase):
    maxDiff = 500

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="bedscope_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.out = self.at("out")

    def at(self, *parts):
        return os.path.join(self.folder, *parts)

    def run_it(self, *arguments, **options):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=PATIENCE, **options)

    def analyse(self, what, *more, out=None):
        done = self.run_it("analyse", what, "-o", out or self.out, "--tables-only", "--quiet", *more)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return out or self.out
