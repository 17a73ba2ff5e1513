//! What can go wrong in a simulation, with the numbers that explain it.

/// An error of the dynamics.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A field of the scenario has a value that the model does not allow (exit code 2).
    #[error("{field}: {problem}; {remedy}")]
    Input {
        /// Name of the field, as in the scenario file.
        field: String,
        /// What is wrong, with the value.
        problem: String,
        /// What to write instead.
        remedy: String,
    },
    /// The start has masses in reversed order (exit code 2; sweeps count it as rejected).
    #[error("initial: gap {gap} starts overlapped by {depth:e}; give a start with all gaps ≥ 0")]
    Overlap {
        /// The first overlapped gap.
        gap: usize,
        /// How deep, in units of length.
        depth: f64,
    },
    /// The bound on work was exceeded (exit code 4).
    #[error(
        "gap {gap} needs more than {bound} events within one unit of time at t = {time}; \
         the run was stopped there"
    )]
    Work {
        /// The gap of the last event.
        gap: usize,
        /// Time of the last event.
        time: f64,
        /// The bound.
        bound: u64,
    },
}

impl Error {
    /// An [`Error::Input`] from its three parts.
    pub fn input(
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        // Both may repeat what stands in a file.
        let field = one_line(&field.into(), 80);
        let problem = one_line(&problem.into(), 300);
        Error::Input { field, problem, remedy: remedy.into() }
    }
}

/// A message in one line of at most `most` characters: parsers repeat what they were given. Of a
/// longer one the beginning and the end are kept, for both tell something.
pub fn one_line(text: &str, most: usize) -> String {
    let visible = |c: char| if breaks(c) { ' ' } else { c };
    let line: String = text.chars().map(visible).collect();
    let line = line.trim();
    let length = line.chars().count();
    if length <= most {
        return line.into();
    }
    let (head, tail) = (most * 2 / 3, most - most * 2 / 3 - 1);
    let head = line.chars().take(head);
    head.chain(['…']).chain(line.chars().skip(length - tail)).collect()
}

/// Does a terminal or an editor take the character for more than a sign?
fn breaks(c: char) -> bool {
    c.is_control() || matches!(c, '\u{2028}' | '\u{2029}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_and_broken_lines_are_one_short_line() {
        assert_eq!(one_line("a\nb\u{2028}c\0\n", 10), "a b c");
        let long = format!("begin{}end", "σ".repeat(1000));
        let line = one_line(&long, 30);
        assert_eq!(line.chars().count(), 30);
        assert!(
            line.starts_with("begin") && line.ends_with("σend") && line.contains('…'),
            "{line}"
        );
        assert_eq!(one_line("abc", 3), "abc");
    }
}
