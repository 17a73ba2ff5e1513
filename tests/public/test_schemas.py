"""The schemas describe values.json, ledger.json and scenes.json, and refuse what is damaged."""

import copy
import json
import re
import unittest
from pathlib import Path

from validator import Validator

ROOT = Path(__file__).resolve().parents[2]
FILES = {
    "paper/values.json": "crates/literate/schemas/values.json",
    "paper/ledger.json": "crates/literate/schemas/ledger.json",
    "scenes/scenes.json": "scenes/schema.json",
}


def read(path):
    return json.loads((ROOT / path).read_text(encoding="utf-8"))


def parts(value, path=()):
    """The paths of all parts of a document."""
    yield path
    if isinstance(value, (dict, list)):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from parts(item, (*path, key))


def replaced(document, path, value):
    document = copy.deepcopy(document)
    if not path:
        return value
    at = document
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = value
    return document


def first_of_each_form(document):
    """A smaller document with the first values of each form: same keys, same words."""
    form = lambda v: json.dumps(v["number"] if isinstance(v["number"], str) else sorted(v["number"]))
    kind = lambda v: json.dumps(v["kind"] if isinstance(v["kind"], str) else sorted(v["kind"]))
    found = {}
    for address, value in document.items():
        found.setdefault((form(value), kind(value), *value), (address, value))
    return dict(found.values())


class Schemas(unittest.TestCase):
    def test_the_files_are_as_their_schemas_say(self):
        for file, schema in FILES.items():
            faults = Validator(read(schema)).faults(read(file))
            self.assertIsNone(next(faults, None), file)

    def test_another_validator_agrees(self):
        try:
            from jsonschema import Draft202012Validator
        except ImportError:
            self.skipTest("the package jsonschema is not installed")
        for file, schema in FILES.items():
            Draft202012Validator.check_schema(read(schema))
            self.assertTrue(Draft202012Validator(read(schema)).is_valid(read(file)), file)

    def test_every_part_of_a_value_and_of_a_statement_counts(self):
        values, ledger = first_of_each_form(read("paper/values.json")), read("paper/ledger.json")
        ledger = {name: rows[:1] for name, rows in ledger.items()}
        for document, schema in [(values, "values"), (ledger, "ledger")]:
            validator = Validator(read(f"crates/literate/schemas/{schema}.json"))
            self.assertTrue(validator.fits(document, None))
            for path in parts(document):
                wrong = replaced(document, path, {"no": ["such", "thing"]})
                self.assertFalse(validator.fits(wrong, None), f"{schema}: {path}")

    def test_what_is_missing_or_unknown_is_refused(self):
        for name, wrong in {
            "values": [
                {"a": {"id": "a", "number": {"integer": 1}}},
                {"a": {"id": "a", "number": {"integer": 1.5}, "kind": "exact"}},
                {"a": {"id": "a", "number": {"integer": 1}, "kind": "guessed"}},
                {"a": {"id": "a", "number": {"integer": 1}, "kind": "exact", "colour": "red"}},
                {"a": {"id": "a", "number": {"real": {"value": 1, "digits": {"error": -1}}}, "kind": "exact"}},
                {"a": {"id": "a", "number": {"integer": 1, "text": "one"}, "kind": "exact"}},
            ],
            "ledger": [
                {"claims": [], "figures": []},
                {"claims": [{}], "figures": [], "equations": []},
                {"claims": [], "figures": [], "equations": [{"number": -1, "section": 1, "what": "", "home": ""}]},
            ],
        }.items():
            validator = Validator(read(f"crates/literate/schemas/{name}.json"))
            for document in wrong:
                self.assertFalse(validator.fits(document, None), document)

    def test_verdicts_and_bases_are_those_of_the_program(self):
        code = (ROOT / "crates/literate/src/claims/check.rs").read_text(encoding="utf-8")
        claim = read("crates/literate/schemas/ledger.json")["$defs"]["claim"]["properties"]
        for name, key in [("Basis", "basis"), ("Verdict", "verdict")]:
            words = re.search(rf"    {name}:\n(.*?)\n}}", code, re.S)[1]
            self.assertEqual(claim[key]["enum"], re.findall(r'\w+ = "(.*)",', words))

    def test_an_unknown_keyword_is_an_error(self):
        with self.assertRaisesRegex(ValueError, "uniqueItems"):
            list(Validator({"uniqueItems": True}).faults([1, 1]))


if __name__ == "__main__":
    unittest.main()
