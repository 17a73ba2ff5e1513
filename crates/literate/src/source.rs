//! Finds an item in the source of a program: its file, and the lines that documents quote.

/// The source of a program, as it was compiled.
#[derive(Clone, Copy, Debug)]
pub struct Sources {
    /// Name of the program.
    pub name: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Path of each file from the folder of its Cargo.toml, and its text.
    pub files: &'static [(&'static str, &'static str)],
    /// Names of crates in paths of items, empty for the program, and the folders of their source.
    pub crates: &'static [(&'static str, &'static str)],
    /// How it was compiled: names and values, of the compiler, its options and features.
    pub compiled: &'static [(&'static str, &'static str)],
}

impl Sources {
    /// Returns the path of an item, as the compiler writes it, without the name of the program.
    pub(crate) fn shorten<'a>(&self, path: &'a str) -> &'a str {
        let (first, rest) = path.split_once("::").unwrap_or(("", path));
        if first == self.name.replace('-', "_") { rest } else { path }
    }

    /// Returns the listing of an item: the lines of its file between `// listing: NAME`, with the
    /// last name of its path, and `// end`, without indentation.
    pub(crate) fn listing(&self, item: &str) -> Result<String, String> {
        let file = self.file(item);
        let source = self.files.iter().find(|(path, _)| Some(*path) == file);
        let name = item.rsplit("::").next().unwrap_or_default();
        let mark = format!("// listing: {name}");
        let lines = source.map_or("", |(_, source)| source).lines();
        let inside = lines.skip_while(|line| line.trim() != mark).skip(1);
        let lines: Vec<&str> = inside.take_while(|line| line.trim() != "// end").collect();
        if lines.is_empty() {
            let marks = format!("the lines `{mark}` and `// end` in its file");
            return Err(format!("there is no listing `{item}`; it needs {marks}"));
        }
        let indent = lines.first().map_or(0, |line| line.len() - line.trim_start().len());
        let lines = lines.iter().map(|line| line.get(indent..).unwrap_or_default());
        Ok(lines.collect::<Vec<_>>().join("\n"))
    }

    /// Returns the file of an item and the number of the line that defines it, or no line if the
    /// item is a whole file; `None` if the program has no such file.
    pub fn place(&self, item: &str) -> Option<(&'static str, Option<usize>)> {
        const KINDS: [&str; 7] = ["fn", "struct", "enum", "trait", "type", "const", "mod"];
        let file = self.file(item)?;
        let (_, source) = self.files.iter().find(|(path, _)| *path == file)?;
        let has = |line: &str, before: &[&str], name: &str| {
            // A search is much faster than splitting into words.
            if !line.contains(name) || line.trim_start().starts_with("//") {
                return false;
            }
            let words = line.split(|c: char| c != '_' && !c.is_alphanumeric());
            let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
            words.windows(2).any(|two| before.contains(&two[0]) && two[1] == name)
        };
        let mut names = item.rsplit("::");
        let (name, owner) = (names.next()?, names.next().unwrap_or_default());
        let inside =
            source.lines().position(|line| has(line, &["impl", "for"], owner)).unwrap_or(0);
        let line = source.lines().skip(inside).position(|line| has(line, &KINDS, name));
        Some((file, line.map(|line| inside + line + 1)))
    }

    /// Returns the file of an item or a module by its path, `crates/circuits/src/jump.rs` for
    /// `impact_circuits::jump::p_jump`, or `None` if the program has no such file.
    pub fn file(&self, item: &str) -> Option<&'static str> {
        let mut crates = self.crates.iter();
        let (folder, rest) = crates.find_map(|(name, at)| Some((at, item.strip_prefix(name)?)))?;
        let mut parts: Vec<&str> = rest.split("::").filter(|part| !part.is_empty()).collect();
        loop {
            let module = format!("{folder}/{}", parts.join("/"));
            let is_module = |path: &str| match path.strip_prefix(&module) {
                Some(".rs" | "/mod.rs") => true,
                Some("lib.rs" | "main.rs") => parts.is_empty(),
                _ => false,
            };
            let mut files = self.files.iter();
            if let Some((path, _)) = files.find(|(path, _)| is_module(path)) {
                return Some(path);
            }
            parts.pop()?;
        }
    }
}

#[cfg(test)]
pub(crate) fn toy() -> Sources {
    const FLIGHT: &str = "//! Free flight.\n\nimpl Motion {\n    // listing: kick\n    /// A jump of the velocity by ω \
               `kick`.\n    pub fn kick<const M: usize>(&mut self, kick: f64, p: &Phases<M>) {\n        self.a -= kick * \
               p.sin;\n        self.b += kick * p.cos;\n    }\n    // end\n}\nf(\"at 12 s\",\n\"{n} of 0.35 \\\n    m\", \
               \"within ten of it\", \"Eq. (25) at \\\\98.98 s of Python \\\\3.11\");\n#[cfg(test)]\nmod tests { f(\"14 s\") }";
    let files = &[("src/flight.rs", FLIGHT), ("src/flight/drag/mod.rs", ""), ("src/lib.rs", "")];
    Sources { name: "toy-paper", version: "1", files, crates: &[("toy", "src")], compiled: &[] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_item_has_the_file_of_its_module() {
        for (item, file) in [
            ("toy::flight::Motion::kick", Some("src/flight.rs")),
            ("toy::flight::drag::of", Some("src/flight/drag/mod.rs")),
            ("toy::Chain", Some("src/lib.rs")),
            ("other::kick", None),
        ] {
            assert_eq!(toy().file(item), file, "{item}");
        }
        assert_eq!(toy().place("toy::flight::Motion::kick"), Some(("src/flight.rs", Some(6))));
        assert_eq!(toy().place("toy::flight::drag"), Some(("src/flight/drag/mod.rs", None)));
        assert_eq!(toy().shorten("toy_paper::claims::sec2"), "claims::sec2");
    }
}
