"""The judge of the scenes runs programs as its README shows, and says what is wrong with them."""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCENES = Path(__file__).resolve().parents[2] / "scenes"
CASES = ["grazing-hits/1e-2", "grazing-hits/1e-8", "mirror/six"]


class Judge(unittest.TestCase):
    def outcomes(self, code):
        with tempfile.TemporaryDirectory() as folder:
            program, result = Path(folder) / "program.py", Path(folder) / "result.json"
            program.write_text(code, encoding="utf-8")
            python = [sys.executable, "-B"]
            cases = [word for case in CASES for word in ("--case", case)]
            judge = [*python, SCENES / "judge.py", *cases, "--out", result, "--", *python, program]
            run = subprocess.run(judge, capture_output=True, encoding="utf-8", check=True)
            self.assertIn(" of 3 right", run.stdout)
            return [case["outcome"] for case in json.loads(result.read_text(encoding="utf-8"))["cases"]]

    def test_programs_are_run_and_judged(self):
        readme = (SCENES / "README.md").read_text(encoding="utf-8")
        example = re.search(r"```python\n(.*?)```", readme, re.S)[1]
        for code, outcomes in [
            (example, ["right", "missed", "right"]),
            ("print('refused all')\nwhile True: pass", ["refused"] * 3),
            ("print('gave_up at once')", ["gave_up"] * 3),
            ("print('warned')\nprint(0, 0, 1)", ["warned"] * 3),
            ("print(0, 0, 1)\nraise SystemExit('no')", ["late", "late", "warned"]),
            ("while True: print(0, 0, 1, flush=True)", ["late", "late", "ghost"]),
        ]:
            self.assertEqual(self.outcomes(code), outcomes, code)


if __name__ == "__main__":
    unittest.main()
