#!/usr/bin/env python3
"""Runs programs that people use on the scenes of scenes/, by scenes/judge.py, and writes benches/scenes.json.

What pip brings is installed below target/peers. Siconos and SUNDIALS must be installed with the
system (Debian: python3-siconos, libsundials-dev). A program that cannot be run stands in the file
with the reason.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parents[2] / "scenes")]
import judge  # noqa: E402
import measure  # noqa: E402  (the neighbour, for the machine and the environment)

FILE = measure.TOP / "benches" / "scenes.json"
LIMIT = 60  # seconds of processor time for a case
# Scripts, and what pip must install; none for those that run with the system's Python.
PROGRAMS = {
    "rk4_bisection": ["numpy==2.4.6"],
    "scipy_ivp": ["scipy==1.17.1"],
    "sundials_erkstep": None,
    "heyoka_taylor": ["heyoka==7.13.2", "numpy==2.4.6"],
    "siconos_chain": None,
    "mujoco_steps": ["mujoco==4.0.0"],
    "pymunk_steps": ["pymunk==7.3.1", "numpy==2.4.6"],
}


def settings_of(script):
    """What a program gives for each of its settings: outcomes and times by scene, in the order of cases."""
    python = "/usr/bin/python3"
    if PROGRAMS[script]:
        environment = measure.WORK / "venv"
        python = str(environment / "bin" / "python")
        if not Path(python).is_file():
            subprocess.run([sys.executable, "-m", "venv", environment], check=True)
        install = [python, "-m", "pip", "install", "--quiet", "--only-binary", ":all:"]
        subprocess.run([*install, *PROGRAMS[script]], check=True)
    command = [python, str(HERE / f"{script}.py")]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode:
        raise OSError((run.stderr.strip().splitlines() or ["no message"])[-1][:200])
    program = json.loads(run.stdout)
    for words in program["settings"]:
        measure.say(f"  {words}")
        outcomes, seconds = {}, {}
        for one in judge.run_all([*command, words], judge.load(), LIMIT):
            scene = one["id"].split("/")[0]
            outcomes.setdefault(scene, []).append(one["outcome"])
            seconds.setdefault(scene, []).append(round(one["seconds"], 2))
        yield {"name": program["name"], "version": program["version"], "settings": words,
               "outcomes": outcomes, "seconds": seconds}  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("programs", nargs="*", help=f"of: {' '.join(PROGRAMS)}; all if none is named")
    wanted = parser.parse_args().programs or list(PROGRAMS)
    if unknown := [script for script in wanted if script not in PROGRAMS]:
        parser.error(f"there is no program {unknown[0]}")
    measure.WORK.mkdir(parents=True, exist_ok=True)
    old = json.loads(FILE.read_text()) if FILE.is_file() else []
    scripts = {one["script"]: one for one in old}
    for script in wanted:
        measure.say(script)
        here = {"script": script, "date": measure.today(), "machine": measure.machine()}
        try:
            scripts[script] = here | {"absent": "", "settings": list(settings_of(script))}
        except (OSError, subprocess.CalledProcessError, judge.Wrong) as reason:
            scripts[script] = here | {"absent": str(reason), "settings": []}
            measure.say(f"  absent: {reason}")
        FILE.write_text(text_of([scripts[script] for script in PROGRAMS if script in scripts]))


def text_of(scripts):
    """JSON with a line for the cases of each scene: differences of two files can be read."""
    text = json.dumps(scripts, indent=1, ensure_ascii=False)
    lists = r'\[\s*(?:"[a-z_]+"|[0-9.]+)(?:,\s*(?:"[a-z_]+"|[0-9.]+))*\s*\]'
    return re.sub(lists, lambda found: json.dumps(json.loads(found[0])), text) + "\n"


if __name__ == "__main__":
    main()
