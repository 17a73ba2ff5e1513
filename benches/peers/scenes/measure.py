#!/usr/bin/env python3
"""Runs programs that people use on the scenes of scenes/scenes.json, and writes benches/scenes.json.

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
sys.path.insert(0, str(HERE.parent))
import measure  # noqa: E402  (the neighbour, for the machine and the environment)

FILE = measure.TOP / "benches" / "scenes.json"
# Scripts, and what pip must install; none for those that run with the system's Python.
PROGRAMS = {
    "scipy_ivp": ["scipy==1.17.1"],
    "sundials_erkstep": None,
    "heyoka_taylor": ["heyoka==7.13.2", "numpy"],
    "siconos_chain": None,
    "mujoco_steps": ["mujoco==4.0.0"],
    "pymunk_steps": ["pymunk==7.3.1", "numpy"],
}


def settings_of(script):
    """What a program gives for each of its settings: its outcomes by scene, in the order of cases."""
    python = "/usr/bin/python3"
    if PROGRAMS[script]:
        environment = measure.WORK / "venv"
        python = str(environment / "bin" / "python")
        if not Path(python).is_file():
            subprocess.run([sys.executable, "-m", "venv", environment], check=True)
        install = [python, "-m", "pip", "install", "--quiet", "--only-binary", ":all:"]
        subprocess.run([*install, *PROGRAMS[script]], check=True)
    run = subprocess.run([python, HERE / f"{script}.py"], capture_output=True, text=True)
    if run.returncode:
        raise OSError((run.stderr.strip().splitlines() or ["no message"])[-1][:200])
    found = {}
    for row in map(json.loads, run.stdout.splitlines()):
        key = row["name"], row["version"], row["settings"]
        found.setdefault(key, {}).setdefault(row["scene"], []).append(row["outcome"])
    names = ["name", "version", "settings", "outcomes"]
    return [dict(zip(names, [*key, outcomes], strict=True)) for key, outcomes in found.items()]


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
            scripts[script] = here | {"absent": "", "settings": settings_of(script)}
        except (OSError, subprocess.CalledProcessError) as reason:
            scripts[script] = here | {"absent": str(reason), "settings": []}
            measure.say(f"  absent: {reason}")
        FILE.write_text(text_of([scripts[script] for script in PROGRAMS if script in scripts]))


def text_of(scripts):
    """JSON with a line for the outcomes of each scene: differences of two files can be read."""
    text = json.dumps(scripts, indent=1, ensure_ascii=False)
    words = r'\[\s*"[a-z_]+"(?:,\s*"[a-z_]+")*\s*\]'
    return re.sub(words, lambda found: json.dumps(json.loads(found[0])), text) + "\n"


if __name__ == "__main__":
    main()
