//! Which sentences of a document have other words.

use super::sentences::{Sentence, Word, folded, sentences, shown};
use serde::Serialize;
use similar::{Algorithm, DiffOp, DiffTag, capture_diff_slices_by_key, diff_ratio};

/// What changed in the words of a document.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProseChange {
    /// Its name.
    pub document: String,
    /// How many sentences differ in numbers alone.
    pub numbers_alone: usize,
    /// Those with other words, gained and lost, in their order.
    pub sentences: Vec<SentenceChange>,
}

/// A sentence with other words.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SentenceChange {
    /// The heading above.
    pub section: String,
    /// All of it.
    pub pieces: Vec<Piece>,
}

/// A part of a sentence.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Piece {
    /// The same words, with the numbers of now.
    Same(String),
    /// Before and after; either may be empty.
    Changed([String; 2]),
}

/// A document has no more sentences: all are compared with all.
const MOST: usize = 20_000;

/// Among so many a rewritten sentence is looked for.
const NEAR: usize = 20;

impl ProseChange {
    /// Compares two texts of a document.
    pub fn between(document: &str, before: &str, after: &str) -> Result<Self, String> {
        let (before, after) = (sentences(before), sentences(after));
        let most = before.len().max(after.len());
        if most > MOST {
            return Err(format!(
                "{most} sentences, and no document of a report has more than {MOST}"
            ));
        }
        let (numbers_alone, sentences) = (0, Vec::new());
        let mut out = ProseChange { document: document.into(), numbers_alone, sentences };
        let key = |sentence: &Sentence| -> Vec<String> {
            sentence.words.iter().map(|word| word.key.clone()).collect()
        };
        for op in capture_diff_slices_by_key(Algorithm::Myers, &before, &after, key) {
            let (mut old, new) = (&before[op.old_range()], &after[op.new_range()]);
            if op.tag() == DiffTag::Equal {
                let pairs = old.iter().zip(new);
                out.numbers_alone +=
                    pairs.filter(|(old, new)| shown(&old.words) != shown(&new.words)).count();
                continue;
            }
            let mut told = 0;
            for (j, sentence) in new.iter().enumerate() {
                let found = old.iter().take(NEAR).position(|one| alike(one, sentence));
                let Some(i) = found else { continue };
                out.apart(&old[..i], &new[told..j]);
                out.push(&sentence.section, &old[i].words, &sentence.words);
                (old, told) = (&old[i + 1..], j + 1);
            }
            out.apart(old, &new[told..]);
        }
        Ok(out)
    }

    fn apart(&mut self, gone: &[Sentence], new: &[Sentence]) {
        gone.iter().for_each(|one| self.push(&one.section, &one.words, &[]));
        new.iter().for_each(|one| self.push(&one.section, &[], &one.words));
    }

    fn push(&mut self, section: &str, old: &[Word], new: &[Word]) {
        let piece = |op: &DiffOp| {
            let (old, new) = (shown(&old[op.old_range()]), shown(&new[op.new_range()]));
            if op.tag() == DiffTag::Equal { Piece::Same(new) } else { Piece::Changed([old, new]) }
        };
        let pieces: Vec<Piece> = ops(old, new).iter().map(piece).collect();
        // A row or a column more of numbers is no wording.
        let number = |text: &String| folded(text, false).chars().all(|c| "#|, ".contains(c));
        if pieces.iter().all(|piece| match piece {
            Piece::Same(_) => true,
            Piece::Changed(texts) => texts.iter().all(number),
        }) {
            self.numbers_alone += 1;
        } else {
            self.sentences.push(SentenceChange { section: section.into(), pieces });
        }
    }
}

/// Whether two sentences share half of their words.
fn alike(old: &Sentence, new: &Sentence) -> bool {
    let ops = ops(&old.words, &new.words);
    diff_ratio(&ops, old.words.len(), new.words.len()) >= 0.5
}

fn ops(old: &[Word], new: &[Word]) -> Vec<DiffOp> {
    capture_diff_slices_by_key(Algorithm::Myers, old, new, |word| word.key.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The changed parts, and how many sentences differ in numbers alone.
    fn told(before: &str, after: &str) -> (Vec<[String; 2]>, usize) {
        let change = ProseChange::between("", before, after).unwrap();
        let pieces = change.sentences.into_iter().flat_map(|sentence| sentence.pieces);
        let changed = pieces.filter_map(|piece| match piece {
            Piece::Changed(texts) => Some(texts),
            Piece::Same(_) => None,
        });
        (changed.collect(), change.numbers_alone)
    }

    #[test]
    fn a_moved_number_is_folded_and_another_word_is_not() {
        let before = "The rise is at 0.1159(4). It stays. So $x^2$ = 2 here.\n\n```\na = 1;\n```\n";
        assert_eq!(told(before, &before.replace("0.1159(4)", "$-2\\times10^{-5}$")), (vec![], 1));
        for (old, new) in [("stays.", "moves."), ("x^2", "x^3"), ("1;", "2;")] {
            let after = before.replace(old, new).replace("0.1159(4)", "0.12");
            assert_eq!(told(before, &after), (vec![[old.into(), new.into()]], 1));
        }
    }

    #[test]
    fn no_text_is_compared_without_end() {
        let long = "a.\n\n".repeat(MOST + 1);
        assert!(ProseChange::between("", "a.", &long).unwrap_err().contains("20001 sentences"));
    }

    #[test]
    fn sentences_come_and_go() {
        let texts = |old: &str, new: &str| vec![[old.to_string(), new.to_string()]];
        assert_eq!(told("A b. C d e f.", "C d e f g."), {
            let both = [texts("A b.", ""), texts("f.", "f g.")];
            (both.concat(), 0)
        });
        assert_eq!(told("A b.", "A b. Now, that is new."), (texts("", "Now, that is new."), 0));
        // What shares little is told apart, the old first.
        let both = [texts("The old words.", ""), texts("", "Now the others are here.")].concat();
        assert_eq!(told("The old words.", "Now the others are here."), (both, 0));
        // A row and a column more of numbers.
        let rows = "| a | b |\n|---|---|\n| 1 | 2 |\n";
        let more = "| a | b | c |\n|---|---|---|\n| 1 | 2 | 5 |\n| 3 | 4 | 5 |\n";
        assert_eq!(told(rows, more), (texts("", "| c"), 2));
    }
}
