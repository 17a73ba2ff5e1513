"""Describes the repository as an RO-Crate: who made it, what is in it with its hashes, and the run
that made the report."""

import json
import re

TITLE = "Impact dynamics of large dimensional systems: a reproducible edition"
KINDS = {
    "csv": "text/csv",
    "json": "application/json",
    "md": "text/markdown",
    "svg": "image/svg+xml",
    "tex": "application/x-tex",
}
COMPLETED = "http://schema.org/CompletedActionStatus"
SCHEMAS = {
    "crates/literate/schemas/values.json": "JSON Schema of all numbers of a report.",
    "crates/literate/schemas/ledger.json": "JSON Schema of statements, figures and equations of a report.",
}
LICENCES = {
    "MIT": ("MIT License", "Code, or the next at your option: LICENSE-MIT."),
    "Apache-2.0": ("Apache License 2.0", "Code, or the one before at your option: LICENSE-APACHE."),
    "CC-BY-4.0": ("Creative Commons Attribution 4.0", "Prose, figures and data: LICENSE-CC-BY."),
}


def crate(root, owner):
    """The whole RO-Crate: what there is, with the hashes that paper/SHA256SUMS has."""
    read = lambda path: (root / path).read_text(encoding="utf-8")
    cited = dict(re.findall(r'(?m)^(version|date-released|abstract): "?([^"\n]*)', read("CITATION.cff")))
    values = json.loads(read("paper/values.json"))
    shown = lambda address: next(iter(values[address]["number"].values()))
    titles = {f["picture"]: f["title"] for f in json.loads(read("paper/ledger.json"))["figures"]}
    compiler = re.search(r'channel = "(.*)"', read("rust-toolchain.toml"))[1]
    to = lambda *ids: [{"@id": name} for name in ids]
    spdx = lambda name: f"https://spdx.org/licenses/{name}"
    listed = [line.split("  ", 1) for line in read("paper/SHA256SUMS").splitlines()]

    people = [{"@id": f"#author-{i}"} | person for i, person in enumerate(owner.people(), 1)]
    groups = {}
    for person in people:
        if "affiliation" in person:
            name = person["affiliation"]["name"]
            new = {"@id": f"#organisation-{len(groups) + 1}"} | person["affiliation"]
            person["affiliation"] = {"@id": groups.setdefault(name, new)["@id"]}
        if person["@type"] == "Person":
            person["name"] = f"{person.get('givenName', '')} {person['familyName']}".strip()
    whole = {
        "@id": "./",
        "@type": "Dataset",
        "name": TITLE,
        "description": cited["abstract"],
        "version": cited["version"],
        "datePublished": cited["date-released"],
        "license": to(*map(spdx, LICENCES)),
        "author": to(*(person["@id"] for person in people)),
        "publisher": to(*(person["@id"] for person in people)),
        "hasPart": to("paper/", "scenes/", "templates/", "src/", "crates/", "Cargo.lock"),
        "mentions": to("#make-paper"),
    }
    if owner.doi:
        whole["identifier"] = owner.link()
        whole["cite-as"] = owner.link()
    if owner.repository:
        whole["url"] = owner.repository
    folder = lambda path, name: {"@id": path, "@type": "Dataset", "name": name}
    graph = [
        {
            "@id": "ro-crate-metadata.json",
            "@type": "CreativeWork",
            "about": {"@id": "./"},
            "conformsTo": {"@id": "https://w3id.org/ro/crate/1.2"},
        },
        whole,
        folder("paper/", "The report: documents, figures, data, values and ledger")
        | {"license": {"@id": spdx("CC-BY-4.0")}, "hasPart": to(*(f"paper/{p}" for _, p in listed))},
        folder("scenes/", "Scenes in which methods fail") | {"license": {"@id": spdx("MIT")}},
        folder("templates/", "The prose, and what the paper printed")
        | {"license": {"@id": spdx("CC-BY-4.0")}},
        folder("src/", "Source of the program: experiments, figures, claims"),
        folder("crates/", "Source of the engine, the theory and the tool that writes the report"),
        {
            "@id": "Cargo.lock",
            "@type": "File",
            "name": "Versions and hashes of all crates",
            "encodingFormat": "application/toml",
        },
        {
            "@id": "#make-paper",
            "@type": "CreateAction",
            "name": "make paper",
            "description": f"All experiments with the profile {shown('profile')} and the seed"
            f" {shown('sweep.run.seed')}; the same bytes on every machine, so no time is given.",
            "actionStatus": {"@id": COMPLETED},
            "instrument": to("#impact-paper"),
            "object": to("src/", "crates/", "templates/", "scenes/", "Cargo.lock"),
            "result": to("paper/"),
        },
        {
            "@id": "#impact-paper",
            "@type": "SoftwareApplication",
            "name": "impact-paper",
            "version": shown("v.version") if "v.version" in values else cited["version"],
            "url": owner.repository or "README.md",
            "softwareRequirements": to("#rust"),
        },
        {
            "@id": "#rust",
            "@type": "SoftwareApplication",
            "name": "Rust",
            "version": compiler,
            "url": "https://www.rust-lang.org",
        },
        {
            "@id": COMPLETED,
            "@type": "ActionStatusType",
            "name": "Completed",
            "description": "The run came to its end.",
        },
        *({"@id": name, "@type": ["CreativeWork", "Profile"], "name": f"Schema of {name.rsplit('/', 1)[-1]}",
           "description": words} for name, words in SCHEMAS.items()),
        *({"@id": spdx(key), "@type": "CreativeWork", "name": name, "description": words}
          for key, (name, words) in LICENCES.items()),
        *people,
        *groups.values(),
    ]
    for digest, path in listed:
        entity = {"@id": f"paper/{path}", "@type": "File", "name": titles.get(path, path)}
        kind = KINDS.get(path.rsplit(".", 1)[-1])
        if kind:
            entity["encodingFormat"] = kind
        schema = f"crates/literate/schemas/{path}"
        if schema in SCHEMAS:
            entity["conformsTo"] = {"@id": schema}
        graph.append(entity | {"sha256": digest})
    context = '"@context": "https://w3id.org/ro/crate/1.2/context"'
    lines = ",\n".join("    " + json.dumps(entity, ensure_ascii=False) for entity in graph)
    return f'{{\n  {context},\n  "@graph": [\n{lines}\n  ]\n}}\n'
