//! Reads running text: words, formulas, code, references and values.

use super::super::document::{Formula, Inline, Part, in_one_line, push};
use super::super::error::{Error, Thing, fault};
use super::super::lint;
use super::super::mark::{self, Piece, pieces};
use super::super::tex;
use super::brackets::bracketed;
use super::{FIGURE_NOT_ALONE, Reader, UNSUPPORTED_MARKUP, is_block};
use crate::experiments::Profile;
use crate::input::one_line;
use crate::print::{Printed, print};
use crate::value::{Digits, Number};
use pulldown_cmark::{Event, LinkType, Tag};
use std::ops::Range;

impl Reader<'_> {
    /// Reads running text up to the end of what contains it, or the next block.
    pub(super) fn inlines(&mut self) -> Result<Vec<Inline>, Error> {
        let mut inlines = Vec::new();
        let ends = |event: &Event<'_>| {
            matches!(event, Event::End(_)) || matches!(event, Event::Start(tag) if is_block(tag))
        };
        while let Some((event, range)) = self.events.next_if(|(event, _)| !ends(event)) {
            let start = range.start;
            let read = self.read_inline(event, range);
            let read = read.map_err(|error| error.with_place(self.filled.place(start)))?;
            read.into_iter().for_each(|inline| push(&mut inlines, inline));
        }
        Ok(inlines)
    }

    /// Reads running text where no displayed equation can stand.
    pub(super) fn inlines_in_line(&mut self) -> Result<Vec<Inline>, Error> {
        let start = self.events.peek().map_or(0, |(_, range)| range.start);
        let inlines = self.inlines()?;
        if inlines.iter().any(|inline| matches!(inline, Inline::Display { .. })) {
            let problem = "an equation between $$ must stand in a paragraph; write $…$ here";
            return Err(fault(problem).with_place(self.filled.place(start)));
        }
        Ok(inlines)
    }

    /// Reads what an event begins, up to its end.
    fn read_inline(&mut self, event: Event<'_>, range: Range<usize>) -> Result<Vec<Inline>, Error> {
        Ok(vec![match event {
            Event::Text(text) => return self.read_text(&text, range),
            Event::Code(code) => {
                let is_digits =
                    |(_, numeral): &(usize, String)| numeral.starts_with(|c: char| c.is_numeric());
                let numbers = lint::find_numbers(&self.filled.text, range, self.input.declared);
                self.note_hard_coded(numbers.into_iter().filter(is_digits));
                Inline::Code(self.to_plain_text(&code)?)
            }
            Event::InlineMath(_) if self.depth.without_formulas > 0 => {
                return Err(fault("GitHub renders no formula in emphasis or a link; move it out"));
            }
            Event::InlineMath(_) if self.filled.text[..range.start].ends_with(forbids_formula) => {
                return Err(fault("a formula right after a word or a number needs a space"));
            }
            Event::InlineMath(tex) => {
                self.check_numbers(&range);
                Inline::Maths(self.formula(&tex, range.start)?)
            }
            Event::DisplayMath(tex) => {
                self.check_numbers(&range);
                self.display(&tex, range)?
            }
            Event::SoftBreak => Inline::Soft,
            Event::Start(tag) => self.span(tag, range)?,
            _ => return Err(fault(UNSUPPORTED_MARKUP)),
        }])
    }

    fn note_hard_coded(&mut self, numbers: impl IntoIterator<Item = (usize, String)>) {
        for (offset, numeral) in numbers {
            if self.filled.is_typed(offset) {
                self.note_error(offset, Error::hard_coded(&numeral));
            }
        }
    }

    /// Notes a hard-coded number in a formula, where characters written by a tag count as letters.
    fn check_numbers(&mut self, range: &Range<usize>) {
        let tex = self.source(range).trim_start_matches('$');
        let begin = range.end - tex.len();
        let tex = tex.trim_end_matches('$').split(r"\tag").next().unwrap_or_default();
        let typed = |(i, c)| if self.filled.is_typed(begin + i) { c } else { 'x' };
        let tex: String = tex.char_indices().map(typed).collect();
        let number = lint::number_in_formula(&tex);
        self.note_hard_coded(number.map(|numeral| (range.start, numeral)));
        self.check_values(range, true);
    }

    /// Notes what beside a value changes its unit or sign, and digits that drop its error.
    fn check_values(&mut self, range: &Range<usize>, is_maths: bool) {
        let source = &self.filled.text;
        for (id, filters, at) in mark::values(&source[range.clone()]) {
            let Some(value) = self.input.values.get(&id) else { continue };
            let (before, after) =
                (&source[..range.start + at.start], &source[range.start + at.end..]);
            let style = mark::parse_filters(filters);
            let has_error = matches!(value.number, Number::Real { digits: Digits::Error(_), .. });
            let problem = if has_error && style.digits.is_some() {
                let problem = "has a standard error, which `significant` drops; leave it out";
                Some(format!("«{id}» {problem}"))
            } else {
                lint::conflict([before, after], value, style, is_maths)
            };
            if let Some(problem) = problem {
                self.note_error(before.len(), Error::Message(problem));
            }
        }
    }

    fn span(&mut self, tag: Tag<'_>, range: Range<usize>) -> Result<Inline, Error> {
        if let Tag::Link { link_type, dest_url, .. } = &tag
            && matches!(link_type, LinkType::ShortcutUnknown | LinkType::Autolink)
        {
            while !matches!(self.events.next(), None | Some((Event::End(_), _))) {}
            if *link_type == LinkType::ShortcutUnknown {
                return self.read_reference(dest_url, range.start);
            }
            let to = self.to_plain_text(dest_url)?;
            return Ok(Inline::Link { to: to.clone(), words: vec![Inline::Text(to)] });
        }
        if matches!(&tag, Tag::Link { title, .. } if !title.is_empty()) {
            return Err(fault("a link has no title, which print cannot show; write it in words"));
        }
        let outer = self.depth;
        self.depth.spans += 1;
        self.depth.without_formulas += usize::from(matches!(tag, Tag::Emphasis | Tag::Link { .. }));
        // Readers and writers of nested markup are recursive.
        if self.depth.spans > 40 {
            return Err(fault("emphasis is nested too deeply"));
        }
        let words = self.inlines_in_line()?;
        self.depth = outer;
        self.events.next();
        Ok(match tag {
            Tag::Emphasis => Inline::Emphasis(words),
            Tag::Strong => Inline::Strong(words),
            Tag::Link { dest_url, .. } => {
                let to = self.to_plain_text(&dest_url)?;
                self.offsets.push((Thing::Link, to.clone(), range.start));
                Inline::Link { to, words }
            }
            Tag::Image { .. } => return Err(fault(FIGURE_NOT_ALONE)),
            _ => return Err(fault(UNSUPPORTED_MARKUP)),
        })
    }

    /// Reads what stands between brackets: `@fig:2; @fig:3` or `!claim:rise`.
    fn read_reference(&mut self, reference: &str, offset: usize) -> Result<Inline, Error> {
        if let Some(id) = reference.strip_prefix('!') {
            if !id.contains(':') {
                let problem = "is a box of GitHub, which no other format shows; write it in words";
                return Err(fault(format!("[!{id}] {problem}, or a place as [!claim:id]")));
            }
            self.add_id("claim", id, offset)?;
            let known = self.input.claims.iter().map(|claim| claim.id.as_str());
            let name = id.trim_start_matches("claim:");
            if known.clone().all(|known| known != name) {
                let problem = format!("[!{id}]: there is no statement with this id");
                return Err(Error::unknown(Thing::Id, name, &problem, known));
            }
            return Ok(Inline::Anchor { id: id.to_string(), number: String::new() });
        }
        let is_id = |id: &&str| !id.is_empty() && !id.contains([',', ' ', '\n', '@']);
        let id = |one: &str| Some(one.trim().strip_prefix('@').filter(is_id)?.to_string());
        let Some(ids) = reference.split(';').map(id).collect::<Option<Vec<_>>>() else {
            let problem = "ids alone stand in these brackets, with `;` between them, as in \
                        [@fig:2; @fig:3]; write a page or section into the sentence";
            return Err(fault(format!("[{reference}]: {problem}")));
        };
        for id in ids.iter().chain([&ids.join("; ")]) {
            self.offsets.push((Thing::Reference, id.clone(), offset));
        }
        Ok(Inline::Unresolved { ids, in_sentence: false })
    }

    fn read_text(&mut self, text: &str, part: Range<usize>) -> Result<Vec<Inline>, Error> {
        let source = &self.filled.text;
        // An id is in one piece of text, or at the end of several.
        let id_at = self.id_at.start.max(part.start)..self.id_at.end.min(part.end);
        let cut = if !id_at.is_empty() {
            Some(id_at.clone())
        } else if *text == source[part.clone()] {
            find_citation(source, part.clone())
        } else {
            None
        };
        if let Some(cut) = cut {
            let [from, to] = [cut.start - part.start, cut.end - part.start];
            let [before, after] = [text.get(..from), text.get(to..)].map(Option::unwrap_or_default);
            let mut inlines = self.read_text(before, part.start..cut.start)?;
            if cut != id_at {
                let id = source[cut.start + 1..cut.end].to_string();
                self.offsets.push((Thing::Reference, id.clone(), cut.start));
                inlines.push(Inline::Unresolved { ids: vec![id], in_sentence: true });
            }
            inlines.extend(self.read_text(after, cut.end..part.end)?);
            return Ok(inlines);
        }
        if let Some((offset, problem)) = leftover(source, part.start, text)
            && offset >= self.end_of_cut_formula
        {
            self.end_of_cut_formula =
                offset + source[offset..].find("\n\n").unwrap_or(source.len());
            let problem = if self.filled.is_typed(offset) { problem } else { GROUP_AS_VALUE };
            return Err(fault(problem).with_place(self.filled.place(offset)));
        }
        self.note_hard_coded(lint::find_numbers(source, part.clone(), self.input.declared));
        self.check_values(&part, false);
        // A backslash before a backslash is meant.
        let escaped = usize::from(source[..part.start].ends_with('\\') && text.starts_with('\\'));
        let text = &(text[..escaped].to_string() + &lint::without_backslashes(&text[escaped..]));
        let inline = |piece| match piece {
            Piece::Text(words) if words.contains(mark::is_of_mark) => {
                Err(fault("a part of the name of a value was cut off; name it whole"))
            }
            Piece::Text(words) => Ok(Inline::Text(words.to_string())),
            Piece::Value { id, filters } => {
                let printed = self.print_value(&id, filters)?;
                Ok(Inline::Value { id, printed })
            }
        };
        pieces(text).into_iter().map(inline).collect()
    }

    fn formula(&mut self, tex: &str, offset: usize) -> Result<Formula, Error> {
        let mut formula = Formula::default();
        for piece in pieces(tex) {
            formula.0.push(match piece {
                Piece::Value { id, filters } => match self.print_value(&id, filters)? {
                    Printed::Words(words) => {
                        let words = one_line(&words, 40);
                        let problem = "are words, which a formula cannot show; move them out of it";
                        return Err(fault(format!("«{id}»: {words:?} {problem}")));
                    }
                    printed => Part::Value { id, printed },
                },
                Piece::Text(text) => Part::Tex(lint::without_backslashes(text)),
            });
        }
        let tex = formula.to_tex();
        if tex.contains(['«', '»', '`']) {
            return Err(fault(UNCLOSED_MARKUP));
        }
        let is_index = |pair: &[Part]| matches!(pair, [Part::Tex(tex), Part::Value { .. }] if tex.ends_with(['^', '_']));
        let bare_index = "a value used as an index must stand in braces {…}";
        let has_index = formula.0.windows(2).any(is_index);
        if let Some(problem) =
            has_index.then(|| bare_index.into()).or_else(|| tex::unsupported(&tex))
        {
            return Err(Error::formula(tex, &problem));
        }
        let formula = bracketed(formula.0);
        self.offsets.push((Thing::Formula, formula.to_tex(), offset));
        Ok(formula)
    }

    /// Reads a displayed equation: cuts `\tag{18}` out of it, or takes `{#eq:name}` behind it.
    fn display(&mut self, tex: &str, range: Range<usize>) -> Result<Inline, Error> {
        let behind = &self.filled.text[range.end..];
        let id =
            behind.trim_start_matches(' ').strip_prefix("{#").and_then(|id| id.split_once('}'));
        if let Some((id, rest)) = id {
            self.id_at = range.end..self.filled.text.len() - rest.len();
            self.add_id("eq", id, range.start)?;
        }
        let mut id = id.map(|(id, _)| id.to_string());
        let (mut tex, mut number) = (tex.to_string(), String::new());
        if let Some((before, after)) = tex.split_once(r"\tag{") {
            let (tag, after) =
                after.split_once('}').ok_or_else(|| fault(r"a \tag{ that is not closed"))?;
            let tag_id = format!("eq:{tag}");
            self.add_id("eq", &tag_id, range.start)?;
            (id, number, tex) = (Some(tag_id), tag.into(), format!("{}{}", before.trim(), after));
        }
        let formula = self.formula(tex.trim(), range.start)?;
        let digits: String = formula.to_tex().chars().filter(char::is_ascii_digit).collect();
        let mut listed = self.input.edition.equations.iter();
        let listed = listed.find(|listed| listed.number.to_string() == number);
        let expected = listed.and_then(|equation| equation.digits).unwrap_or(&digits);
        if expected != digits {
            let problem =
                format!("equation ({number}) has the digits {digits}, in the list {expected}");
            self.note_error(range.start, Error::Message(problem));
        }
        Ok(Inline::Display { formula, id, number })
    }

    /// Returns a text in which values are digits alone: code, targets of links.
    pub(super) fn to_plain_text(&self, text: &str) -> Result<String, Error> {
        let to_text = |piece| match piece {
            Piece::Value { id, filters } => {
                Ok(in_one_line(&self.print_value(&id, filters)?.to_plain_text()))
            }
            Piece::Text(text) => Ok(text.to_string()),
        };
        pieces(text).into_iter().map(to_text).collect()
    }

    fn print_value(&self, id: &str, filters: &str) -> Result<Printed, Error> {
        let unknown = || Error::Message(format!("there is no value {id}"));
        let value = self.input.values.get(id).ok_or_else(unknown)?;
        // The samples of a quick profile may be too small for any number.
        let is_dash = self.is_in_cell || self.input.values.profile() == Some(Profile::Quick);
        if value.number == Number::None && !is_dash {
            let remedy = "say what stands there, by «… | otherwise(words=\"…\")»";
            return Err(Error::Message(format!("{id} has no number; {remedy}")));
        }
        Ok(print(&value.number, mark::parse_filters(filters)))
    }
}

/// Returns whether no formula can follow: GitHub renders one after a space or an opening bracket.
fn forbids_formula(c: char) -> bool {
    c.is_alphanumeric() || ")]$".contains(c) || c == mark::CLOSE
}

const UNCLOSED_MARKUP: &str = "unclosed markup; complete it, or write a backslash before a sign that is \
     meant literally";

const GROUP_AS_VALUE: &str = "a group, a row or a key is named where a value is meant; name the value whole, as \
     table[\"row\"].column, also one of the key";

const UNCLOSED_FORMULA: &str = "an unclosed formula: Markdown ends it at an empty line, and at a line that begins \
     with +, -, *, #, >, = or 1.; move the sign to the end of the line before";

/// What is wrong where a sign of markup is left over in the text, by how the rest begins.
const PROBLEMS_BY_SIGN: [(&str, &str); 6] = [
    ("|", "a table needs a line of dashes below its head with as many columns"),
    ("[^", "footnotes are not supported by every format; write the note into the sentence"),
    ("{#", "an id belongs right after a heading, caption, picture or equation; move or remove it"),
    ("{", "braces hold an id and nothing else, such as a width; remove them, or write \\{"),
    ("$", "a dollar sign alone; close the formula before the end of the paragraph, or write \\$"),
    ("@", "a citation is @key, after a space or a bracket; write \\@ for the sign"),
];

/// Finds the first sign of markup that Markdown took for text because it is not closed, and says
/// what is wrong. The text stands at `start`; after a backslash a sign is meant literally.
fn leftover(source: &str, start: usize, text: &str) -> Option<(usize, &'static str)> {
    let escaped = source[..start].ends_with('\\');
    let left = |(i, c): &(usize, char)| {
        let (before, after) = source.split_at(start + i);
        let word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
        let blank = |c: Option<char>| c.is_none_or(char::is_whitespace);
        let (last, next) = (before.chars().next_back(), after.chars().nth(1));
        match c {
            '«' | '»' | '[' | ']' | '{' | '}' | '$' | '`' | '~' | '^' => true,
            '*' => !(blank(last) && blank(next)),
            '@' => !(word(last) && word(next)),
            '\\' => next.is_some_and(|c| c.is_ascii_alphabetic()),
            '#' | '|' => last.is_none_or(|c| c == '\n'),
            _ => false,
        }
    };
    let (i, _) = text.char_indices().skip(usize::from(escaped)).find(left)?;
    let rest = &source[start + i..];
    if rest.starts_with("$$") {
        let lines = rest.match_indices('\n').map(|(offset, _)| start + i + offset + 1);
        let begins_block = |c: char| "+-*#>=".contains(c) || c.is_ascii_digit();
        let mut lines = lines.take_while(|offset| !source[*offset..].starts_with(['\n', '$']));
        let cut = lines.find(|offset| source[*offset..].starts_with(begins_block));
        return Some((cut.unwrap_or(start + i), UNCLOSED_FORMULA));
    }
    let problem = PROBLEMS_BY_SIGN.iter().find(|(sign, _)| rest.starts_with(sign));
    Some((start + i, problem.map_or(UNCLOSED_MARKUP, |(_, problem)| problem)))
}

/// Finds the first citation or reference without brackets, `@rice1945`, in a part of the text.
fn find_citation(source: &str, part: Range<usize>) -> Option<Range<usize>> {
    let ends = |c: char| c.is_whitespace() || ",;{}[]|".contains(c) || mark::is_of_mark(c);
    let citation = |(offset, _): (usize, &str)| {
        let (before, rest) = source[..part.end].split_at(part.start + offset);
        let begins = |c: char| c.is_whitespace() || "(“‘–—".contains(c);
        let id = rest[1..].split(ends).next().unwrap_or_default();
        let id = id.trim_end_matches(|c: char| ".:?!()'\"’”".contains(c));
        let is_key = id.starts_with(char::is_alphanumeric);
        let begins = before.is_empty() || before.ends_with(begins);
        (begins && is_key).then(|| before.len()..before.len() + 1 + id.len())
    };
    source[part.clone()].match_indices('@').find_map(citation)
}
