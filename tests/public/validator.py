"""Validates JSON by a schema: as much of JSON Schema 2020-12 as the schemas of this project use. A
keyword that it does not know is an error, so that no schema says what nothing checks."""

import json
import re

TYPES = {
    "array": list,
    "boolean": bool,
    "integer": int,
    "number": (int, float),
    "object": dict,
    "string": str,
}
NOTES = {"$schema", "$defs", "title", "description", "default"}
# They are read with the keyword beside which they stand.
BESIDE = {"then", "else"}


def is_of(kind, value):
    return isinstance(value, TYPES[kind]) and (kind == "boolean" or not isinstance(value, bool))


def same(a, b):
    return json.dumps(a, sort_keys=True) == json.dumps(b, sort_keys=True)


class Validator:
    def __init__(self, schema):
        self.top = schema

    def faults(self, value, schema=None, path="$"):
        """Yields what is wrong with a value, with its place."""
        schema = self.top if schema is None else schema
        if isinstance(schema, bool):
            if not schema:
                yield f"{path}: nothing may stand here"
            return
        for word, rule in schema.items():
            if word in NOTES or word in BESIDE:
                continue
            check = getattr(self, "on_" + word.replace("$", ""), None)
            if check is None:
                raise ValueError(f"the validator does not know {word}")
            yield from check(rule, value, schema, path)

    def fits(self, value, schema):
        return next(self.faults(value, schema), None) is None

    def on_ref(self, rule, value, schema, path):
        found = self.top
        for name in rule.removeprefix("#/").split("/"):
            found = found[name]
        yield from self.faults(value, found, path)

    def on_type(self, rule, value, schema, path):
        if not is_of(rule, value):
            yield f"{path}: {value!r} is no {rule}"

    def on_const(self, rule, value, schema, path):
        if not same(rule, value):
            yield f"{path}: {value!r} is not {rule!r}"

    def on_enum(self, rule, value, schema, path):
        if not any(same(one, value) for one in rule):
            yield f"{path}: {value!r} is none of {rule}"

    def on_oneOf(self, rule, value, schema, path):
        count = sum(self.fits(value, one) for one in rule)
        if count != 1:
            yield f"{path}: {value!r} fits {count} of the alternatives"

    def on_not(self, rule, value, schema, path):
        if self.fits(value, rule):
            yield f"{path}: {value!r} is excluded"

    def on_if(self, rule, value, schema, path):
        branch = "then" if self.fits(value, rule) else "else"
        yield from self.faults(value, schema.get(branch, True), path)

    def on_required(self, rule, value, schema, path):
        if is_of("object", value):
            yield from (f"{path}: {name} is missing" for name in rule if name not in value)

    def on_properties(self, rule, value, schema, path):
        if is_of("object", value):
            for name in rule.keys() & value.keys():
                yield from self.faults(value[name], rule[name], f"{path}.{name}")

    def on_additionalProperties(self, rule, value, schema, path):
        if is_of("object", value):
            for name in value.keys() - schema.get("properties", {}).keys():
                yield from self.faults(value[name], rule, f"{path}.{name}")

    def on_prefixItems(self, rule, value, schema, path):
        if is_of("array", value):
            for i, (one, item) in enumerate(zip(rule, value)):
                yield from self.faults(item, one, f"{path}[{i}]")

    def on_items(self, rule, value, schema, path):
        if is_of("array", value):
            for i, item in list(enumerate(value))[len(schema.get("prefixItems", [])):]:
                yield from self.faults(item, rule, f"{path}[{i}]")

    def on_pattern(self, rule, value, schema, path):
        if is_of("string", value) and not re.search(rule, value):
            yield f"{path}: {value!r} is not of the form {rule}"


def bound(kinds, size, is_beyond, words):
    def check(self, rule, value, schema, path):
        if any(is_of(kind, value) for kind in kinds) and is_beyond(size(value), rule):
            yield f"{path}: {value!r} is {words} {rule}"

    return check


BOUNDS = {
    "minimum": (["number"], lambda n: n, lambda n, rule: n < rule, "below"),
    "maximum": (["number"], lambda n: n, lambda n, rule: n > rule, "above"),
    "exclusiveMinimum": (["number"], lambda n: n, lambda n, rule: n <= rule, "not above"),
    "minItems": (["array"], len, lambda n, rule: n < rule, "shorter than"),
    "maxItems": (["array"], len, lambda n, rule: n > rule, "longer than"),
    "minLength": (["string"], len, lambda n, rule: n < rule, "shorter than"),
    "minProperties": (["object"], len, lambda n, rule: n < rule, "smaller than"),
    "maxProperties": (["object"], len, lambda n, rule: n > rule, "larger than"),
}
for word, rules in BOUNDS.items():
    setattr(Validator, "on_" + word, bound(*rules))
