#!/usr/bin/env python3
"""Measures this project's engine and its peers, and writes benches/measured.json.

Everything is built or installed below target/. What cannot be installed or does not end in time
becomes a row "absent" with its reason, and the rest goes on.
"""

import argparse
import csv
import datetime
import json
import math
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent
WORK = TOP / "target" / "peers"
OURS = TOP / "target" / "release" / "impact-paper"
MEASURE = TOP / "target" / "release" / "measure"
FILE = TOP / "benches" / "measured.json"
# At n = 20 chain 0 comes to rest on a regular orbit, where no error grows; chain 1 is chaotic.
SIGMA, UNTIL, CHAIN = 0.3, 200.0, 1
SIZES = [20, 100]
PATIENCE = 10.0  # seconds within which a command is begun again
KEYS = ["compared", "horizon_impact", "horizon_time"]
# Name of a part: its script and what pip must install for it.
PYTHON = {
    "heyoka": ("heyoka_taylor.py", ["heyoka==7.13.2"]),
    "scipy": ("scipy_dop853.py", ["scipy==1.17.1"]),
    "sundials": ("sundials_cvode.py", ["scikit-sundae==1.2.0"]),
    "pymunk": ("pymunk_steps.py", ["pymunk==7.3.1"]),
}
PARTS = ["ours", "methods", *PYTHON, "diffsol", "commands"]
ROW = {
    "what": "engine", "name": "", "version": "", "settings": "", "value": None, "n": 0, "sigma": SIGMA,
    "until": UNTIL, "chains": 1, "threads": 1, "impacts": 0,
    "microseconds_per_impact": None, "evaluations_per_impact": None, "compared": None,
    "horizon_impact": None, "horizon_time": None, "segment_misses": None, "segments": None,
    "seconds": None, "engine_seconds": None, "peak_mib": None, "note": "",
}  # fmt: skip


class Absent(Exception):
    """Something cannot be run; the text is one line of why."""


def say(text):
    print(text, file=sys.stderr, flush=True)


def call(command, limit, keep=False):
    """Standard output, wall time and largest memory in MiB of a command.

    With `keep`, what was printed before the time ran out is returned.
    """
    began = time.perf_counter()
    with open(WORK / "errors.log", "w+") as errors, open(WORK / "output.log", "w+") as output:
        child = subprocess.Popen(command, stdout=output, stderr=errors, cwd=TOP)
        late = False
        while True:
            pid, status, usage = os.wait4(child.pid, os.WNOHANG)
            if pid:
                break
            if time.perf_counter() - began > limit and not late:
                late = True
                child.kill()
            time.sleep(0.001)
        child.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.perf_counter() - began
        output.seek(0)
        text = output.read()
        errors.seek(0)
        lines = [line.strip() for line in errors.read().splitlines() if line.strip()]
    reason = f"not finished after {limit} s" if late else (lines or ["no message"])[-1]
    if late and keep:
        return text, seconds, reason
    if late or child.returncode:
        raise Absent(reason.replace(str(TOP) + os.sep, "")[:200])
    return text, seconds, None if keep else usage.ru_maxrss / 1024


def ours(*arguments, limit=300, program=OURS):
    return call([str(program), *map(str, arguments)], limit)


def measure(*arguments, limit=300):
    return ours(*arguments, limit=limit, program=MEASURE)


def inputs(n):
    """Files of the scenario and of its true impacts."""
    scenario, reference = WORK / f"n{n}.json", WORK / f"reference-n{n}.json"
    text, _, _ = measure("scenario", "--masses", n, "--sigma", SIGMA, "--chain", CHAIN)
    fresh = not scenario.is_file() or scenario.read_text() != text
    scenario.write_text(text)
    if fresh or not reference.is_file():
        say(f"  true impacts of n = {n}")
        run = ["cargo", "run", "--release", "--quiet", "--locked", "-p", "impact-bench", "--bin", "reference", "--"]
        text, _, _ = call([*run, str(scenario), str(UNTIL)], 900)
        json.loads(text)
        reference.write_text(text)
    return scenario, reference


def engine(case, version, what="engine", **more):
    """A row from a case of `measure engine`."""
    same = ["n", "sigma", "until", "chains", "threads", "impacts", "seconds", "peak_mib"]
    nanoseconds = case["ns_per_impact"]
    row = {key: case[key] for key in same + ["evaluations_per_impact"]}
    row["microseconds_per_impact"] = nanoseconds and nanoseconds / 1e3
    return row | {"what": what, "name": "impact-paper", "version": version} | more


def timed(*settings):
    """`measure engine`, repeated for as long as peers are."""
    from common import ENOUGH

    command = ["engine", *settings, "--repetitions"]
    case = json.loads(measure(*command, 3)[0])["cases"][0]
    seconds = case["ns_per_impact_median"] * case["impacts"] * 1e-9
    return json.loads(measure(*command, math.ceil(ENOUGH / seconds))[0])


def part_ours():
    """One chain of every size, then many chains."""
    from common import judge

    for n in [20, 100, 1_000, 10_000]:
        say(f"  one chain of {n} masses")
        report = timed("--masses", n, "--chain", CHAIN)
        more = {}
        if n in SIZES:
            scenario, reference = inputs(n)
            true = json.loads(reference.read_text())
            text, _, _ = ours("trace", scenario, "--until", UNTIL)
            lines = [line.split(",") for line in text.splitlines()[1:]]
            own = [(float(line[0]), int(line[1])) for line in lines]
            more = dict(zip(KEYS, judge(own, true), strict=True))
        yield engine(report["cases"][0], report["version"], **more)
    text, _, _ = measure("engine", "--masses", 1_000_000, "--repetitions", 1)
    report = json.loads(text)
    yield engine(report["cases"][0], report["version"], note="memory: a single run")
    for threads in sorted({1, os.cpu_count() or 1}):
        say(f"  an ensemble on {threads} thread(s)")
        report = timed("--masses", 100, "--chains", 64, "--threads", threads)
        yield engine(report["cases"][0], report["version"], "ensemble")


def part_methods():
    """The methods of this project, and without the vectors of this processor. `measure methods`
    prints rows."""
    for of in ["race", "bias", "scale", "questions", "bias --generic", "questions --generic"]:
        text, _, late = call([str(MEASURE), "methods", *of.split()], 3600, keep=True)
        yield from map(json.loads, text.splitlines())
        if late:
            yield {"what": "absent", "name": "methods", "note": f"the next setting: {late}"}


def part_python(part):
    """A peer with a script in Python."""
    script, packages = PYTHON[part]
    environment = WORK / "venv"
    python = environment / "bin" / "python"
    if not python.is_file():
        call([sys.executable, "-m", "venv", str(environment)], 120)
    quiet = ["--quiet", "--disable-pip-version-check", "--only-binary", ":all:"]
    call([str(python), "-m", "pip", "install", *quiet, *packages], 600)
    for n in SIZES:
        say(f"  n = {n}")
        yield from peer([str(python), str(HERE / script)], n, part)


def part_diffsol():
    """A peer with a project in Rust."""
    say("  build")
    where = ["--manifest-path", str(HERE / "diffsol" / "Cargo.toml")]
    where += ["--target-dir", str(WORK / "diffsol")]
    call(["cargo", "build", "--release", "--locked", "--quiet", *where], 1200)
    for n in SIZES:
        say(f"  n = {n}")
        yield from peer([str(WORK / "diffsol" / "release" / "diffsol-peer")], n, "diffsol")


def peer(command, n, part):
    """Rows that a peer prints, one a line; a setting that hangs is a row of its own."""
    scenario, reference = inputs(n)
    files = [str(scenario), str(reference), str(UNTIL)]
    text, _, late = call([*command, *files], 150, keep=True)
    for line in text.splitlines():
        yield json.loads(line)
    if late:
        yield {"what": "absent", "name": part, "n": n, "note": f"the next setting: {late}"}


def rows_of(name):
    """Rows of a data file of the report."""
    with (TOP / "paper" / "data" / name).open() as file:
        return list(csv.DictReader(file))


def part_commands():
    """Wall time of whole commands, without saved results; of short ones the best."""
    report = json.loads(measure("engine", "--masses", 1, "--until", 1)[0])
    fresh = Path(tempfile.mkdtemp(dir=WORK))
    # The sweep as the report has it: beyond the rise with fewer realisations.
    run, rows = (rows_of(f"sweep-{table}.csv") for table in ["run", "rows"])
    sigmas = {}
    for row in rows:
        beyond = float(row["sigma (d omega^2)"]) > float(run[0]["level_above (d omega^2)"])
        number = run[0][f"{'level_' if beyond else ''}realisations (1)"]
        sigmas.setdefault(number, []).append(row["sigma (d omega^2)"])
    commands = {"main sweep": [
        ["sweep", "--sigma", ",".join(own), "--realisations", number, "--format", "json"]
        for number, own in sigmas.items()
    ]}  # fmt: skip
    for profile in ["quick", "full"]:
        folders = ["--results", fresh / profile, "--out", fresh / f"paper-{profile}"]
        commands[profile] = [["paper", "--profile", profile, *folders]]
    for name, calls in commands.items():
        say(f"  {name}")
        try:
            found, spent = None, 0.0
            while spent <= PATIENCE:
                shutil.rmtree(fresh, ignore_errors=True)
                own = [ours(*arguments, limit=900) for arguments in calls]
                took = sum(seconds for _, seconds, _ in own)
                if found is None or took < sum(seconds for _, seconds, _ in found):
                    found = own
                spent += took
        except Absent as reason:
            yield {"what": "absent", "name": f"commands: {name}", "note": str(reason)}
            continue
        texts, times, peaks = zip(*found, strict=True)
        seconds, peak = sum(times), max(peaks)
        row = {"what": "command", "name": name, "version": report["version"]}
        if name == "main sweep":
            rows = [row for text in texts for row in json.loads(text)]
            impacts = sum(row["impacts"] for row in rows)
            row |= {"impacts": impacts, "microseconds_per_impact": seconds / impacts * 1e6}
            row |= {"n": 100, "until": 700.0, "chains": sum(row["realisations"] for row in rows)}
        yield row | {"sigma": 0.0, "seconds": seconds, "peak_mib": peak,
                     "threads": os.cpu_count() or 1}  # fmt: skip
    shutil.rmtree(fresh, ignore_errors=True)


def machine():
    """Processor, cores and system; no names."""
    processor = platform.machine()
    if Path("/proc/cpuinfo").is_file():
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
        processor = (models or [processor])[0]
    system = f"{platform.system()} {platform.machine()}"
    return {"processor": processor, "cores": os.cpu_count() or 1, "os": system}


def today():
    return datetime.date.today().isoformat()


def of_part(row):
    """The part that writes a row."""
    by_what = dict.fromkeys(["engine", "ensemble"], "ours")
    by_what |= dict.fromkeys(["method", "size", "question"], "methods") | {"command": "commands"}
    return by_what.get(row["what"], row["name"].split()[0].lower().strip(":"))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", help=f"parts, with commas between, of: {','.join(PARTS)}")
    parser.add_argument("--out", type=Path, default=FILE, help="file to write or bring up to date")
    arguments = parser.parse_args()
    wanted = arguments.only.split(",") if arguments.only else PARTS
    if unknown := [part for part in wanted if part not in PARTS]:
        parser.error(f"--only: there is no part {unknown[0]}; parts are {','.join(PARTS)}")
    here = {"date": today(), "machine": machine()}
    old = []
    if arguments.only and arguments.out.is_file():
        old = json.loads(arguments.out.read_text())["sessions"]
    for session in old:
        session["rows"] = [row for row in session["rows"] if of_part(row) not in wanted]
    # What was measured here today stands in one session.
    same = [session for session in old if all(session[key] == here[key] for key in here)]
    old = [session for session in old if session["rows"] and session not in same]
    kept = [row for session in same for row in session["rows"]]
    WORK.mkdir(parents=True, exist_ok=True)
    say("build")
    build = ["cargo", "build", "--release", "--locked", "--quiet"]
    call([*build, "-p", "impact-paper", "-p", "impact-bench", "--bins"], 1800)
    rows = {part: [row for row in kept if of_part(row) == part] for part in PARTS}
    for part in wanted:
        say(part)
        began = time.perf_counter()
        run = globals().get(f"part_{part}", lambda part=part: part_python(part))
        try:
            for row in run():
                rows[part].append(ROW | row)
                say("    " + told(rows[part][-1]))
        except Exception as reason:  # one part that fails must not take the others with it
            why = str(reason) if isinstance(reason, Absent) else repr(reason)[:200]
            rows[part].append(ROW | {"what": "absent", "name": part, "note": why})
            say(f"    absent: {why}")
        # Whatever happens later, this much is kept.
        done = [row for each in PARTS for row in rows[each]]
        arguments.out.write_text(text_of([*old, here | {"rows": done}]))
        say(f"  {part}: {time.perf_counter() - began:.0f} s")


def told(row):
    """A row for people."""
    parts = [row["name"], row["settings"], f"n={row['n']}"]
    for key in ["microseconds_per_impact", "horizon_impact", "segment_misses", "seconds"]:
        if row[key] is not None:
            parts.append(f"{key}={row[key]:.4g}")
    return " ".join(part for part in parts if part)


def text_of(sessions):
    """JSON with a row on each line: differences of two measurements can be read."""
    blocks = []
    for session in sessions:
        head = ", ".join(f'"{key}": {json.dumps(session[key])}' for key in ["date", "machine"])
        lines = ",\n".join(json.dumps(row, ensure_ascii=False) for row in session["rows"])
        blocks.append(f'{{{head}, "rows": [\n{lines}\n]}}')
    return '{"sessions": [\n' + ",\n".join(blocks) + "\n]}\n"


if __name__ == "__main__":
    main()
