"""What archives, journals and contributors read agrees with what there is."""

import hashlib
import json
import re
import tomllib
import unittest
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


def toml(path):
    return tomllib.loads(text(path))


def ids(value):
    """All references {"@id": …} inside a value."""
    if isinstance(value, dict):
        if value.keys() == {"@id"}:
            yield value["@id"]
        for item in value.values():
            yield from ids(item)
    elif isinstance(value, list):
        for item in value:
            yield from ids(item)


class Crate(unittest.TestCase):
    def setUp(self):
        crate = json.loads(text("ro-crate-metadata.json"))
        self.assertEqual(crate["@context"], "https://w3id.org/ro/crate/1.2/context")
        self.entities = {entity["@id"]: entity for entity in crate["@graph"]}
        self.assertEqual(len(self.entities), len(crate["@graph"]))

    def test_it_describes_itself_and_the_folder(self):
        descriptor = self.entities["ro-crate-metadata.json"]
        self.assertEqual(descriptor["about"], {"@id": "./"})
        self.assertEqual(descriptor["conformsTo"], {"@id": "https://w3id.org/ro/crate/1.2"})
        for key in ("name", "description", "datePublished", "license", "author", "hasPart"):
            self.assertTrue(self.entities["./"][key], key)

    def test_every_reference_lands(self):
        for entity in self.entities.values():
            self.assertIn("@type", entity)
            self.assertRegex(entity["@id"], r"^[!-~]+$")
            for to in ids({key: value for key, value in entity.items() if key != "@id"}):
                known = to in self.entities or to.startswith(("http://", "https://"))
                self.assertTrue(known or (ROOT / to).is_file(), f"{entity['@id']}: {to}")

    def test_every_file_has_its_hash_and_is_a_part(self):
        parts, hashed = {"./"}, 0
        for part in ("./", "paper/"):
            parts |= set(ids(self.entities[part]["hasPart"]))
        for name, entity in self.entities.items():
            if entity["@type"] not in ("File", "Dataset"):
                continue
            self.assertIn(name, parts)
            self.assertTrue((ROOT / name).exists(), name)
            if "sha256" in entity:
                digest = hashlib.sha256((ROOT / name).read_bytes()).hexdigest()
                self.assertEqual(entity["sha256"], digest, name)
                hashed += 1
        self.assertEqual(hashed, len(text("paper/SHA256SUMS").splitlines()))

    def test_the_run(self):
        run = self.entities["#make-paper"]
        self.assertEqual(run["@type"], "CreateAction")
        self.assertIn("profile full", run["description"])
        self.assertEqual(list(ids(run["result"])), ["paper/"])
        program = self.entities[run["instrument"][0]["@id"]]
        compiler = self.entities[program["softwareRequirements"][0]["@id"]]
        self.assertEqual(compiler["version"], toml("rust-toolchain.toml")["toolchain"]["channel"])
        for software in (program, compiler):
            for key in ("name", "url", "version"):
                self.assertTrue(software[key], key)
        described = [run["actionStatus"], self.entities["./"]["publisher"]]
        described += [e["conformsTo"] for e in self.entities.values() if e["@type"] == "File" and "conformsTo" in e]
        self.assertEqual(set(ids(described)) - self.entities.keys(), set())


class Files(unittest.TestCase):
    def test_one_title(self):
        title = text("templates/edition/00-abstract.md").splitlines()[0].removeprefix("# ")
        crate = {entity["@id"]: entity for entity in json.loads(text("ro-crate-metadata.json"))["@graph"]}
        self.assertEqual(crate["./"]["name"], title)
        for path, times in [("CITATION.cff", 2), ("codecheck.yml", 1)]:
            self.assertEqual(text(path).count(f'title: "{title}"\n'), times, path)

    def test_one_version_and_one_day(self):
        workspace = toml("Cargo.toml")["workspace"]["package"]
        citation, meta = text("CITATION.cff"), json.loads(text("codemeta.json"))
        versions = set(re.findall(r"(?m)^ *version: (.*)$", citation)) | {meta["version"]}
        for manifest in ROOT.glob("crates/*/Cargo.toml"):
            needs = tomllib.loads(manifest.read_text(encoding="utf-8")).get("dependencies", {})
            ours = (need for need in needs.values() if isinstance(need, dict) and "path" in need)
            versions |= {need["version"] for need in ours if "version" in need}
        for project in ROOT.glob("crates/*/pyproject.toml"):
            versions.add(tomllib.loads(project.read_text(encoding="utf-8"))["project"]["version"])
        self.assertEqual(versions, {workspace["version"]})
        self.assertIn(f"\n## {workspace['version']}", text("CHANGELOG.md"))
        self.assertEqual(meta["programmingLanguage"]["version"], workspace["rust-version"])
        days = {meta["dateModified"], *re.findall(r'date-released: "(.*)"', citation)}
        days |= set(re.findall(r'(?m)^            date: "(.*)",', text("src/lib.rs")))
        self.assertEqual(len(days), 1, days)
        year, month = re.search(r"(?m)^  year: (\d+)\n  month: (\d+)$", citation).groups()
        self.assertTrue(days.pop().startswith(f"{year}-{int(month):02}-"), "of preferred-citation")

    def test_the_manifest_has_every_figure_with_its_data(self):
        listed = re.findall(r"(?m)^  - file: (.*)\n    comment: .+$", text("codecheck.yml"))
        for file in listed:
            self.assertTrue((ROOT / file).is_file(), file)
        shown = json.loads(text("paper/ledger.json"))["figures"]
        shown = {f"paper/{file}" for figure in shown for file in [figure["picture"], *figure["data"]]}
        self.assertEqual(shown - set(listed), set())
        self.assertIn("paper/ledger.json", listed)
        self.assertTrue(text("codecheck.yml").startswith("---\n"))

    def test_the_licence_names_what_there_is(self):
        licence = text("LICENSE")
        for path in re.findall(r"LICENSE-[A-Z-]+[A-Z]|\S+/\S+\b(?<!paper/fonts)", licence):
            self.assertTrue((ROOT / path).exists(), path)
        for path in ROOT.iterdir():
            if path.is_dir() and path.name in ("src", "crates", "tests", "benches", "templates", "paper", "scenes"):
                self.assertIn(path.name, licence)

    def test_whoever_publishes_a_crate_has_packed_and_compared_it(self):
        publishable = set()
        for manifest in ROOT.glob("crates/*/Cargo.toml"):
            package = tomllib.loads(manifest.read_text(encoding="utf-8"))["package"]
            if package.get("publish") is not False:
                publishable.add(package["name"])
                for key in ("description", "readme", "keywords", "categories"):
                    self.assertTrue(package[key], key)
        for script in (".ci/package", ".ci/semver"):
            crates = re.search(r"(?m)^crates=\((.*)\)$", text(script))[1].split()
            self.assertEqual(set(crates), publishable, script)
        ordered = re.findall(r"-p ([a-z-]+)`", text("RELEASING.md"))
        self.assertEqual(set(ordered), publishable)

    def test_the_container_does_what_the_readme_says(self):
        docker = text("Dockerfile")
        channel = toml("rust-toolchain.toml")["toolchain"]["channel"]
        self.assertRegex(docker, rf"(?m)^FROM rust:{re.escape(channel)}-slim-\w+(@sha256:\w+)?$")
        made = [line for line in docker.splitlines() if line.startswith("RUN make")]
        self.assertEqual(made, ["RUN make paper", "RUN make test"])
        before = docker.split("RUN make", 1)[0]
        self.assertRegex(before, r"(?m)^USER (?!root)\w+$")
        for command in ("make paper", "make test"):
            self.assertIn(command, text("README.md"))

    def test_the_five_ways_in(self):
        block = re.search(r"## Five ways in\n\n```sh\n(.*?)```", text("README.md"), re.S)[1]
        commands = [line.split("#")[0].strip() for line in block.splitlines()]
        self.assertEqual(len(commands), 5)
        for command in commands:
            if example := re.search(r"--example (\w+)", command):
                found = [*ROOT.glob(f"crates/*/examples/{example[1]}*")]
                self.assertEqual(len(found), 1, command)
            if target := re.match(r"make (\w+)", command):
                self.assertIn(f"\n{target[1]}: ", text("Makefile"))
        self.assertIn("- run: .ci/paths\n", text(".github/workflows/nightly.yml"))

    def test_workflows_call_what_there_is(self):
        for workflow in (ROOT / ".github/workflows").iterdir():
            words = workflow.read_text(encoding="utf-8")
            for script in re.findall(r"(?<![\w/])\.ci/[a-z-]+", words):
                self.assertTrue((ROOT / script).is_file(), f"{workflow.name}: {script}")
            for target in re.findall(r"run: make ([a-z-]+)", words):
                self.assertIn(f"\n{target}: ", text("Makefile"), workflow.name)

    def test_updates_are_looked_for_where_there_are_manifests(self):
        kinds = {
            "cargo": "Cargo.toml",
            "github-actions": ".github/workflows",
            "npm": "package.json",
            "pip": "pyproject.toml",
            "docker": "Dockerfile",
        }
        pattern = r"package-ecosystem: (\S+)\n    directory: /(\S*)"
        found = dict(re.findall(pattern, text(".github/dependabot.yml")))
        self.assertEqual(found.keys(), kinds.keys())
        for kind, folder in found.items():
            if (ROOT / folder).is_dir():
                self.assertTrue((ROOT / folder / kinds[kind]).exists(), kind)

    def test_links_land_and_documents_keep_their_length(self):
        for document in ROOT.glob("*.md"):
            for to in re.findall(r"(?<!caption)\]\(([^)#:]+)\)", document.read_text(encoding="utf-8")):
                self.assertTrue((ROOT / to).exists(), f"{document.name}: {to}")
        for document, most in [("README.md", 850), ("DESIGN.md", 2300), ("CHANGELOG.md", 700)]:
            # What owner.toml adds is the owner's.
            words = text(document).split("To cite: [CITATION.cff](CITATION.cff).")[0].split()
            self.assertLessEqual(len(words), most, document)

    def test_the_readme_has_the_score_of_the_ledger(self):
        rows = json.loads(text("paper/ledger.json"))["claims"]
        rows = [row for row in rows if row["kind"] == "statement"]
        count = Counter(row["verdict"] for row in rows)

        def resting_on(*bases):
            verdicts = [row["verdict"] for row in rows if row["basis"] in bases]
            return len(verdicts), verdicts.count("reproduced")

        theory, measures = resting_on("exact", "rounding", "finite cases"), resting_on("our measure")
        digits, reproduced = resting_on("printed digit")
        self.assertEqual(reproduced, 0)
        for sentence in [
            f"of {len(rows)} statements {count['reproduced']} are reproduced, "
            f"{count['differs and explained']} differ and are explained, {count['differs']} differ, "
            f"and {count['cannot be judged']} cannot be judged",
            f"rest {theory[0]} of them, of which {theory[1]} are reproduced; on our measure of a word "
            f"rest {measures[0]}, of which {measures[1]} are; the one number printed for the "
            f"simulation, in {digits} readings, cannot",
        ]:
            self.assertIn(sentence, " ".join(text("README.md").split()))

    def test_no_file_has_a_path_of_a_machine(self):
        endings = (".rs", ".toml", ".md", ".tex", ".bib", ".json", ".csv", ".svg", "run")
        files = [ROOT / "Makefile", ROOT / "CITATION.cff", *ROOT.glob("*.md"), *ROOT.glob("*.toml")]
        for folder in ("src", "crates", "tests", "templates", "paper", ".ci"):
            files += [file for file in (ROOT / folder).rglob("*") if file.name.endswith(endings)]
        self.assertGreater(len(files), 500)
        for file in filter(Path.is_file, files):
            path = re.search("/(work|root|home|tmp|Users)/", file.read_text(encoding="utf-8"))
            self.assertIsNone(path, file)


if __name__ == "__main__":
    unittest.main()
