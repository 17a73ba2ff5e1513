"""Fills owner.toml in a copy, looks at every place, fills it again, and empties it."""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = """
authors = [
    { given = "Ada", family = "Example", orcid = "0000-0002-1825-0097", affiliation = "Somewhere" },
    { given = "Zoë", family = "O'Neill" },
]
repository = "https://code.example.org/ada/impact-paper"
doi = "10.5281/zenodo.1234567"
report = "safety@example.org"
"""
EMPTY = 'authors = []\nrepository = ""\ndoi = ""\nreport = ""\n'
REPOSITORY = "https://code.example.org/ada/impact-paper"
DOI = "10.5281/zenodo.1234567"


def run(folder, *arguments):
    command = [sys.executable, "-B", folder / ".ci/owner", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def texts(folder):
    """All files but owner.toml."""
    files = (f for f in folder.rglob("*") if f.is_file() and f.name != "owner.toml")
    return {f.relative_to(folder).as_posix(): f.read_bytes() for f in files}


class Filled(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.made.name) / "a copy"
        # What is built or not ours stays behind.
        left = shutil.ignore_patterns("target", ".git", "node_modules", "__pycache__")
        shutil.copytree(ROOT, cls.folder, ignore=left, copy_function=shutil.copyfile)
        cls.owner = cls.folder / "owner.toml"
        cls.committed = cls.owner.read_text(encoding="utf-8")
        cls.owner.write_text(EMPTY, encoding="utf-8")
        run(cls.folder)
        cls.before = texts(cls.folder)
        cls.owner.write_text(EXAMPLE, encoding="utf-8")
        cls.answer = run(cls.folder)
        cls.after = texts(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.made.cleanup()

    def text(self, path):
        return self.after[path].decode()

    def test_the_committed_files_are_as_the_tool_writes_them(self):
        told = run(ROOT, "--check").stderr
        stale = [line for line in told.splitlines() if not line.startswith("owner.toml: empty: ")]
        self.assertEqual(stale, [])

    def test_every_file_that_names_an_owner_is_filled(self):
        self.assertEqual(self.answer.returncode, 0, self.answer.stderr)
        changed = {path for path in self.after if self.after[path] != self.before.get(path)}
        told = {line.split(":")[0] for line in self.answer.stdout.splitlines()}
        self.assertEqual(changed, told)
        packages = {p.relative_to(ROOT).as_posix() for p in ROOT.glob("crates/*/Cargo.toml")}
        wheels = {p.relative_to(ROOT).as_posix() for p in ROOT.glob("crates/*/pyproject.toml")}
        expected = {
            *("CITATION.cff", "codemeta.json", "codecheck.yml", "ro-crate-metadata.json"),
            *("README.md", "REPRODUCTION.md", "SECURITY.md", "CODE_OF_CONDUCT.md"),
            *("Cargo.toml", "benches/Cargo.toml", "src/lib.rs"),
            *("crates/python/README.md", ".github/ISSUE_TEMPLATE/config.yml"),
        }
        self.assertEqual(changed, expected | packages | wheels)

    def test_citations(self):
        text = self.text("CITATION.cff")
        self.assertEqual(text.count('family-names: "Example"'), 2)
        self.assertEqual(text.count('orcid: "https://orcid.org/0000-0002-1825-0097"'), 2)
        self.assertEqual(text.count(f'doi: "{DOI}"'), 2)
        self.assertIn(f'\nrepository-code: "{REPOSITORY}"\n', text)
        self.assertNotIn("The impact-paper authors", text)
        # Authors of what is cited stay.
        self.assertEqual(text.count("family-names: Homer"), 3)
        try:
            import yaml
        except ImportError:
            return
        read = yaml.safe_load(text)
        self.assertEqual([a["given-names"] for a in read["authors"]], ["Ada", "Zoë"])
        self.assertEqual(read["preferred-citation"]["authors"], read["authors"])
        checked = yaml.safe_load(self.text("codecheck.yml"))
        self.assertEqual(checked["paper"]["authors"][1], {"name": "Zoë O'Neill"})

    def test_codemeta(self):
        read = json.loads(self.text("codemeta.json"))
        self.assertEqual([a["familyName"] for a in read["author"]], ["Example", "O'Neill"])
        self.assertEqual(read["issueTracker"], f"{REPOSITORY}/issues")
        self.assertEqual(read["codeRepository"], REPOSITORY)
        self.assertEqual(read["identifier"], f"https://doi.org/{DOI}")

    def test_research_object(self):
        graph = {e["@id"]: e for e in json.loads(self.text("ro-crate-metadata.json"))["@graph"]}
        root = graph["./"]
        self.assertEqual(root["identifier"], f"https://doi.org/{DOI}")
        authors = [graph[a["@id"]] for a in root["author"]]
        self.assertEqual([a["name"] for a in authors], ["Ada Example", "Zoë O'Neill"])
        self.assertEqual(authors[0]["@id"], "https://orcid.org/0000-0002-1825-0097")
        self.assertEqual(graph[authors[0]["affiliation"]["@id"]]["name"], "Somewhere")

    def test_codecheck(self):
        text = self.text("codecheck.yml")
        self.assertIn("ORCID: 0000-0002-1825-0097", text)
        self.assertIn(f'  reference: "https://doi.org/{DOI}"\n', text)
        self.assertIn(f'\nrepository: "{REPOSITORY}"\n', text)

    def test_packages(self):
        workspace = tomllib.loads(self.text("Cargo.toml"))
        shared = workspace["workspace"]["package"]
        self.assertEqual(shared["authors"], ["Ada Example", "Zoë O'Neill"])
        self.assertEqual(shared["repository"], REPOSITORY)
        for path in self.after:
            if re.fullmatch(r"(.*/)?Cargo\.toml", path) and "/peers/" not in path:
                package = tomllib.loads(self.text(path))["package"]
                self.assertEqual(package["repository"], {"workspace": True}, path)
            if path.endswith("pyproject.toml"):
                project = tomllib.loads(self.text(path))["project"]
                self.assertEqual(project["authors"][0], {"name": "Ada Example"})
                self.assertEqual(project["urls"]["Repository"], REPOSITORY)

    def test_pages_and_prose(self):
        # Pages have their address from Cargo.toml, and authors and the DOI from here.
        self.assertIn(f'            doi: "{DOI}",\n', self.text("src/lib.rs"))
        authors = """&[("Ada Example", "Somewhere"), ("Zoë O'Neill", "")];\n"""
        self.assertIn(authors, self.text("src/lib.rs"))
        self.assertIn('address: env!("CARGO_PKG_REPOSITORY")', self.text("src/lib.rs"))
        for path in ("SECURITY.md", "CODE_OF_CONDUCT.md"):
            self.assertIn("in confidence. The way: <safety@example.org>.\n", self.text(path))
        letter = f"that we erred. The edition is at <{REPOSITORY}>. Ada Example, Zoë O'Neill\n"
        self.assertIn(letter, self.text("REPRODUCTION.md"))
        readme = self.text("README.md")
        self.assertIn(f" DOI: [{DOI}](https://doi.org/{DOI}).", readme)
        self.assertIn(f"<{REPOSITORY}/issues>. By Ada Example, Zoë O'Neill.\n", readme)
        # PyPI resolves no links within a repository.
        links = re.findall(r"\]\((\S+)\)", self.text("crates/python/README.md"))
        self.assertTrue(links)
        for link in links:
            folder, path = link.split("/blob/main/")
            self.assertEqual(folder, REPOSITORY)
            self.assertTrue((ROOT / path).is_file(), link)
        # GitHub refuses mail addresses there.
        way = self.text(".github/ISSUE_TEMPLATE/config.yml")
        self.assertIn(f'    url: "{REPOSITORY}/blob/main/SECURITY.md"\n', way)

    def test_check_names_what_is_missing(self):
        told = run(self.folder, "--check")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertRegex(told.stdout, r"^owner\.toml: no ORCID: Zoë O'Neill; .*\n$")
        try:
            self.owner.write_text(EXAMPLE.replace(DOI, ""), encoding="utf-8")
            told = run(self.folder, "--check")
            self.assertIn("owner.toml: empty: doi\n", told.stderr)
            self.assertEqual(told.returncode, 1)
        finally:
            self.owner.write_text(EXAMPLE, encoding="utf-8")

    def test_twice_is_once_and_emptied_is_as_before(self):
        again = run(self.folder)
        self.assertEqual((again.returncode, again.stdout), (0, ""))
        self.assertEqual(texts(self.folder), self.after)
        try:
            self.owner.write_text(EMPTY, encoding="utf-8")
            told = run(self.folder, "--check").stderr
            self.assertIn("README.md: not as owner.toml", told)
            self.assertIn("owner.toml: empty: repository\n", told)
            run(self.folder)
            self.assertEqual(texts(self.folder), self.before)
            if tomllib.loads(self.committed) == tomllib.loads(EMPTY):
                for path in self.before:
                    self.assertEqual(self.before[path], (ROOT / path).read_bytes(), path)
        finally:
            self.owner.write_text(EXAMPLE, encoding="utf-8")
            run(self.folder)

    def test_wrong_fields_are_refused(self):
        before = texts(self.folder)
        try:
            for field, wrong, told in [
                ('"0000-0002-1825-0097"', '"0000-0002-1825-0098"', "is no ORCID"),
                (f'"{REPOSITORY}"', f'"{REPOSITORY}/"', "without a slash"),
                (f'"{REPOSITORY}"', f'"{REPOSITORY}.git"', "or .git"),
                (f'"{DOI}"', f'"https://doi.org/{DOI}"', "without https://doi.org/"),
                (f'"{DOI}"', '"10.5281/ZENODO.FIXME"', "as 10.5281/zenodo.1234567"),
                ('"safety@example.org"', '"ask around"', "a mail address"),
                ('family = "Example"', 'name = "Example"', "has no family name"),
                ("repository", "repo", "repo is unknown"),
                ('doi = "10.5281/zenodo.1234567"\n', "", "doi is not there"),
                ("authors = [", "authors = ", "owner.toml: "),
            ]:
                self.assertIn(field, EXAMPLE)
                self.owner.write_text(EXAMPLE.replace(field, wrong), encoding="utf-8")
                found = run(self.folder)
                self.assertEqual(found.returncode, 1, wrong)
                self.assertEqual(len(found.stderr.splitlines()), 1, found.stderr)
                self.assertIn(told, found.stderr)
            self.assertEqual(texts(self.folder), before)
        finally:
            self.owner.write_text(EXAMPLE, encoding="utf-8")


if __name__ == "__main__":
    unittest.main()
