#!/usr/bin/env python3
"""Runs a program, in whatever language, on the scenes in which methods fail, and judges it.

The command is run once for each case. It reads the case, one line of JSON, from standard input:

    {"id": "held/let-go", "difficulty": 0.01, "scenario": {"spacing": 1.0, "natural_frequency": 1.0,
     "restitution": 0.8, "forcing_frequencies": [1.414...], "forcing": [[[-3.0, 0.0]]]},
     "start": {"time": 0.0, "positions": [0.0], "velocities": [0.0]}, "until": 20.87}

and prints a line for each impact, in the order of time: `time gap speed`, numbers with spaces
between them, flushed. It is ended as soon as its impacts decide the outcome. It may also print

    refused WORDS   at the beginning: it does not support the case
    warned WORDS    it could not decide an impact
    gave_up WORDS   it passed a bound on work of its own

An exit code other than 0 is a warning, too, unless its impacts have decided. Messages belong on
standard error. The README has the equation of motion, the rules by which a result is judged, and a
whole program as an example.
"""

import argparse
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
TIE = 1e-9  # impacts this near in time may come in any order
LAWFUL = 0.02  # how far off the velocities of a `law` may be
EXAMPLE = """examples:
  judge.py -- python3 my_program.py --step 0.01
  judge.py --limit 60 --out result.json -- ./my_program
  judge.py --scene ball --case held/let-go -- ./my_program
  judge.py --show held/let-go | ./my_program"""


class Wrong(Exception):
    """What keeps a case from being judged, and what to do about it."""


def counts(case, time, gap, speed):
    """Whether an impact counts."""
    expected, faster, among = case["expected"], 0.0, []
    if expected["kind"] == "impacts":
        faster, among = expected.get("faster", 0.0), expected.get("among", [])
    elif expected["kind"] == "rest":
        faster = expected["slower"]
        if time < expected["since"]:
            return False
    return time <= case["until"] and speed > faster and (not among or gap in among)


def enough(expected):
    """The number of impacts that decide the outcome."""
    if expected["kind"] == "impacts":
        return len(expected["impacts"]) + expected.get("only", False)
    return {"speed": expected.get("impacts"), "rest": 1, "law": math.inf}[expected["kind"]]


def in_order(expected, within, seen):
    """Compares impacts one after the other; those of one instant may come in any order."""
    seen, first = list(seen), 0
    while first < len(expected):
        last = first + 1
        while last < len(expected) and expected[last][0] - expected[last - 1][0] <= TIE:
            last += 1
        gaps = [gap for _, gap in expected[first:last]]
        seen[first:last] = sorted(seen[first:last], key=lambda hit: gaps.index(hit[1]) if hit[1] in gaps else -1)
        first = last
    for number, (time, gap) in enumerate(expected):
        if number == len(seen):
            return "missed"
        late = seen[number][0] - time
        if seen[number][1] != gap:
            return "ghost" if late < -within else "missed"
        if abs(late) > within:
            return "late"
    return "ghost" if len(seen) > len(expected) else "right"


def lawful(before, seen):
    """Judges the first impacts of three masses with the walls by their velocities before they met."""
    first = {gap: speed for _, gap, speed in reversed(seen)}
    if 0 not in first or len(before) not in first:
        return "missed"
    left, right = -first[0], first[len(before)]
    middle = sum(before) - left - right
    grows = left**2 + middle**2 + right**2 > sum(v**2 for v in before) + LAWFUL
    apart = left <= middle + LAWFUL and middle <= right + LAWFUL
    return "right" if apart and not grows else "wrong_speed"


def judge(case, impacts):
    """The outcome of a case from a list of impacts: time, gap, closing speed."""
    expected = case["expected"]
    seen = [hit for hit in impacts if counts(case, *hit)]
    if expected["kind"] == "law":
        return lawful(case["start"]["velocities"], seen)
    seen = seen[: enough(expected)]
    if expected["kind"] == "impacts":
        return in_order(expected["impacts"], expected["within"], seen)
    if expected["kind"] == "rest":
        return "wrong_rest" if seen else "right"
    if len(seen) < expected["impacts"]:
        return "missed"
    off = [abs(speed / expected["speed"] - 1.0) for _, _, speed in seen]
    return "right" if max(off) <= expected["within"] else "wrong_speed"


def handed(case):
    """What the program reads: the case without what is expected, and with all fields of its scenario."""
    given = case["scenario"]
    scenario = {"spacing": 1.0, "natural_frequency": 1.0, "restitution": 0.8} | given
    if "forcing_frequencies" not in given:
        scenario["forcing_frequencies"] = [scenario.pop("forcing_frequency", 2.0**0.5)]
        scenario["forcing"] = [given["forcing"]]
    return {key: case[key] for key in ["id", "difficulty"]} | {
        "scenario": scenario, "start": case["start"], "until": case["until"]}  # fmt: skip


def impact(case, line):
    """The impact in a line of output."""
    last = len(case["start"]["positions"])
    try:
        time, gap, speed = line.split()
        time, gap, speed = float(time), int(gap), float(speed)
    except ValueError:
        problem = "is not `time gap speed`; print nothing else there, and messages on standard error"
        raise Wrong(f"{case['id']}: the line {line[:60]!r} on standard output {problem}") from None
    if not 0 <= gap <= last:
        problem = f"there is no gap {gap}; number the gaps from 0, at the left wall, to {last}, at the right"
        raise Wrong(f"{case['id']}: {problem}")
    return time, gap, speed


def run(command, case, limit=None):
    """Runs a command on a case: the outcome, the seconds of processor time, and what it said if it is
    not right. With a limit it is ended after as many seconds of processor time."""

    def bound():
        import resource

        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))

    with tempfile.TemporaryFile("w+", errors="replace") as errors:
        try:
            child = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors, text=True,
                errors="replace", start_new_session=True, preexec_fn=bound if limit else None)  # fmt: skip
        except OSError as error:
            problem = f"{command[0]!r} cannot be run ({error.strerror}); write the command after `--` as in a shell"
            raise Wrong(f"{case['id']}: {problem}") from None
        try:
            seen, doubt, ended, most = [], "", False, enough(case["expected"])
            try:
                with child.stdin as stdin:
                    stdin.write(json.dumps(handed(case)) + "\n")
            except BrokenPipeError:
                pass  # it does not want to know
            for line in child.stdout:
                if line.split()[:1] in (["refused"], ["warned"], ["gave_up"]):
                    doubt = line.strip() if line.startswith("gave_up") else doubt or line.strip()
                elif line.strip():
                    hit = impact(case, line)
                    seen += [hit] if counts(case, *hit) else []
                ended = len(seen) >= most or doubt.startswith(("refused", "gave_up"))
                if ended:
                    break
        finally:
            if sys.exc_info()[0] or ended:
                end(child)
            child.stdout.close()
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        words = [line.strip() for line in errors if line.strip()]
    seconds = usage.ru_utime + usage.ru_stime
    found = judge(case, seen)
    if not ended and child.returncode:  # what it would have found is not known
        late = limit and (child.returncode == -signal.SIGXCPU or seconds > 0.95 * limit)
        found = "gave_up" if late else "warned"
        doubt = doubt or f"{found} exit code {child.returncode}: {(words or ['no message'])[-1]}"
    elif doubt and (found != "right" or not doubt.startswith("warned")):
        found = doubt.split()[0]
    message = "" if found == "right" else doubt
    return {"outcome": found, "seconds": round(seconds, 3), "message": message[:200]}


def run_all(command, scenes, limit=None):
    """Runs a command on scenes: for each case its id, and what `run` returns. After a case that passes
    the limit, the others of its scene are not run, and give up as well."""
    for scene in scenes:
        over = False
        for case in scene["cases"]:
            skipped = {"outcome": "gave_up", "seconds": 0.0, "message": "not run after another that gave up"}
            found = skipped if over else run(command, case, limit)
            over = over or bool(limit and found["outcome"] == "gave_up" and found["seconds"] > 0.95 * limit)
            yield {"id": case["id"]} | found


def end(child):
    """Ends a child and what it started."""
    try:
        os.killpg(child.pid, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        pass  # it is over


def hardest(cases, outcomes):
    """The smallest difficulty down to which all cases are right, or none."""
    solved = None
    for difficulty in sorted({case["difficulty"] for case in cases}, reverse=True):
        if any(outcomes[case["id"]] != "right" for case in cases if case["difficulty"] == difficulty):
            break
        solved = difficulty
    return solved


def summary(scenes, outcomes):
    """Counts what is right, as pairs [right, all]: by case; by orbit, where cases that ask different
    things of one motion count once, and all must be right; by difficulty; and by scene, where each
    counts one, with the share of its cases that is right and the hardest difficulty solved."""
    cases = [case for scene in scenes for case in scene["cases"]]
    orbits, levels = {}, {}
    for case in cases:
        right = outcomes[case["id"]] == "right"
        orbits.setdefault(json.dumps([case["scenario"], case["start"], case["until"]]), []).append(right)
        level = case["difficulty"] and math.floor(math.log10(case["difficulty"]) + 1e-9)
        levels.setdefault(f"1e{level}" if case["difficulty"] else "0", []).append(right)
    pair = lambda rights: [sum(rights), len(rights)]  # noqa: E731
    by_scene = {}
    for scene in scenes:
        right = [outcomes[case["id"]] == "right" for case in scene["cases"]]
        by_scene[scene["id"]] = pair(right) + [hardest(scene["cases"], outcomes)]
    return {
        "cases": pair([outcomes[case["id"]] == "right" for case in cases]),
        "orbits": pair([all(rights) for rights in orbits.values()]),
        "difficulties": {level: pair(levels[level]) for level in sorted(levels, key=float, reverse=True)},
        "scenes": [round(sum(right / of for right, of, _ in by_scene.values()), 2), len(by_scene)],
        "by_scene": by_scene,
    }


def report(scenes, found):
    """The text that tells a person what was found."""
    outcomes = {one["id"]: one["outcome"] for one in found}
    counted = summary(scenes, outcomes)
    lines = [f"{'scene':<15}{'right':>9}  {'hardest':>7}  otherwise"]
    for scene in scenes:
        right, of, difficulty = counted["by_scene"][scene["id"]]
        wrong = [outcomes[case["id"]] for case in scene["cases"] if outcomes[case["id"]] != "right"]
        words = ", ".join(f"{wrong.count(one)} {one.replace('_', ' ')}" for one in dict.fromkeys(wrong))
        solved = "–" if difficulty is None else f"{difficulty:g}"
        lines.append(f"{scene['id']:<15}{f'{right} of {of}':>9}  {solved:>7}  {words}".rstrip())
    text = lambda pair: f"{pair[0]:g} of {pair[1]}"  # noqa: E731
    said = dict.fromkeys(one["message"] for one in found if one["message"])
    lines += [
        "",
        f"cases: {text(counted['cases'])} right",
        f"orbits: {text(counted['orbits'])} right (orbits that graze are asked for times and for speeds)",
        f"scenes: {text(counted['scenes'])}, each counted one, by the share of its cases",
        "difficulties: " + ", ".join(f"{level} {text(pair)}" for level, pair in counted["difficulties"].items()),
        f"processor time: {sum(one['seconds'] for one in found):.1f} s, that of starting the program included",
        *(f"message: {one}" for one in said),
    ]
    return "\n".join(lines)


def write(path, result):
    """Writes a result, a line for each case, whole or not at all."""
    head = json.dumps({key: result[key] for key in result if key != "cases"}, ensure_ascii=False)
    rows = ",\n".join("  " + json.dumps(one, ensure_ascii=False) for one in result["cases"])
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        beside.write_text(f'{head[:-1]}, "cases": [\n{rows}\n]}}\n', encoding="utf-8")
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)


def load(file=HERE / "scenes.json"):
    """All scenes."""
    return json.loads(file.read_text(encoding="utf-8"))


def chosen(scenes, ids, cases):
    """The scenes with these ids, and the cases; all if none are named."""
    known = [scene["id"] for scene in scenes] + [case["id"] for scene in scenes for case in scene["cases"]]
    for one in [*ids, *cases]:
        if one not in known:
            raise Wrong(f"there is no {one}; --list names all")
    if ids or cases:
        for scene in scenes:
            scene["cases"] = [case for case in scene["cases"] if scene["id"] in ids or case["id"] in cases]
    return [scene for scene in scenes if scene["cases"]]


def seconds(text):
    """A bound on processor time."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of seconds, 1 at least")
    return int(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLE, usage="judge.py [options] -- command …",
                                     formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("--scene", metavar="ID", action="append", default=[], help="only this scene; may be repeated")
    parser.add_argument("--case", metavar="ID", action="append", default=[], help="only this case; may be repeated")
    parser.add_argument("--limit", metavar="SECONDS", type=seconds, help="whole seconds of processor time for a case; "
                        "what passes it gave up, and so do the cases after it in its scene, unrun (no limit "
                        "without it, so a program that bounces for ever does)")  # fmt: skip
    parser.add_argument("--out", metavar="FILE", type=Path, help="write outcome, time and message of each case, as JSON")
    parser.add_argument("--list", action="store_true", help="list scenes and cases, and end")
    parser.add_argument("--show", metavar="ID", help="print the case as the program reads it, and end")
    parser.add_argument("command", nargs="*", help="the program and its arguments, after `--`")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        scenes = chosen(load(), options.scene, [*options.case, *([options.show] if options.show else [])])
        if options.list:
            for scene in scenes:
                print(f"{scene['id']}: {scene['what']}", *(f"  {case['id']}" for case in scene["cases"]), sep="\n")
            return 0
        if options.show:
            print(json.dumps(handed(scenes[0]["cases"][0])))
            return 0
        if not options.command:
            parser.error("there is no command; write it after `--`, as in: judge.py -- python3 my_program.py")
        if options.out and not options.out.absolute().parent.is_dir():
            raise Wrong(f"{options.out}: there is no such folder; make it first")
        found = []
        for one in run_all(options.command, scenes, options.limit):
            found.append(one)
            words = f"{one['id']}: {one['outcome'].replace('_', ' ')}, {one['seconds']:.2f} s"
            print(words, file=sys.stderr, flush=True)
        print(report(scenes, found))
        if options.out:
            counted = summary(scenes, {one["id"]: one["outcome"] for one in found})
            head = {"scenes": (HERE / "VERSION").read_text().strip(), "command": options.command,
                    "limit": options.limit, "right": counted}  # fmt: skip
            write(options.out, head | {"cases": found})
    except Wrong as problem:
        print(f"judge.py: {problem}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("judge.py: interrupted; nothing was written", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
