//! Parses the mark-up of labels: `*k*^{∗}`, `*ϕ*_{*N*}(*k*)`, `10^{−3}`.
//!
//! A star turns italics on and off, `_{…}` lowers, `^{…}` raises, and a character behind a
//! backslash stands for itself. A raised part that directly follows a lowered one stands above it.

/// Which of the two shipped faces a character is set in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Face {
    Regular,
    Italic,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    Base,
    Sub,
    Sup,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    pub face: Face,
    pub level: Level,
    pub text: String,
}

/// Splits a label into pieces of one face and one height.
pub fn parse(label: &str) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let (mut face, mut level) = (Face::Regular, Level::Base);
    let mut chars = label.chars().peekable();
    while let Some(c) = chars.next() {
        let literal = match c {
            '\\' => chars.next().unwrap_or(c),
            '*' => {
                face = if face == Face::Regular { Face::Italic } else { Face::Regular };
                continue;
            }
            '_' | '^' if level == Level::Base && chars.peek() == Some(&'{') => {
                chars.next();
                level = if c == '_' { Level::Sub } else { Level::Sup };
                continue;
            }
            '}' if level != Level::Base => {
                level = Level::Base;
                continue;
            }
            other => other,
        };
        match pieces.last_mut() {
            Some(last) if last.face == face && last.level == level => last.text.push(literal),
            _ => pieces.push(Piece { face, level, text: literal.to_string() }),
        }
    }
    pieces
}

/// Returns a label as plain text, for screen readers and tests: scripts keep `_` and `^`.
pub fn plain(label: &str) -> String {
    let mut out = String::new();
    let mut before = Level::Base;
    for piece in parse(label) {
        out += match piece.level {
            Level::Sub if before != Level::Sub => "_",
            Level::Sup if before != Level::Sup => "^",
            _ => "",
        };
        before = piece.level;
        out.push_str(&piece.text);
    }
    out
}

/// How data files spell characters that ASCII lacks.
const SPELLED: [(char, &str); 14] = [
    ('σ', "sigma"),
    ('ω', "omega"),
    ('Ω', "Omega"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('µ', "u"),
    ('ϕ', "phi"),
    ('Φ', "Phi"),
    ('Γ', "Gamma"),
    ('Δ', "Delta"),
    ('−', "-"),
    ('∗', "*"),
    ('×', "x"),
    ('’', "'"),
];

/// Returns a label in ASCII, for data files: plain, with Greek letters spelled out.
pub fn spelled(label: &str) -> String {
    let mut text = plain(label);
    for (character, word) in SPELLED {
        text = text.replace(character, word);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn italics_scripts_and_escapes() {
        let shown = parse(r"*ϕ*_{*N*}(1)\*").into_iter().map(|p| (p.face, p.level, p.text));
        let pieces = [
            (Face::Italic, Level::Base, "ϕ".to_string()),
            (Face::Italic, Level::Sub, "N".into()),
            (Face::Regular, Level::Base, "(1)*".into()),
        ];
        assert_eq!(shown.collect::<Vec<_>>(), pieces);
        assert_eq!(plain("*k*_{*N*}^{∗}"), "k_N^∗");
        assert_eq!(spelled("*k*_{*N*}^{∗} at *σ* = 10^{−3}"), "k_N^* at sigma = 10^-3");
    }
}
