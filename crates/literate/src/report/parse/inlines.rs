//! Running text: words, formulas, code, references and values.

use super::super::captions::{picture, refuse_pictures};
use super::super::card::words_and_maths;
use super::super::document::{Inline, plain};
use super::super::labels::of_kind;
use super::super::mark::{self, Piece, bare, framed, pieces};
use super::super::print::print;
use super::super::{Error, macros, mathml, tex};
use super::written::{comment, markup, own_link};
use super::{Reader, is_block, leftover};
use crate::input::is_no_text;
use pulldown_cmark::{Event, LinkType, Tag};
use std::ops::Range;

impl Reader<'_> {
    /// Running text up to the end of what contains it, or the next block.
    pub(super) fn inlines(&mut self) -> Result<Vec<Inline>, Error> {
        let mut out = Vec::new();
        while let Some(event) = self.peek() {
            match event {
                Event::End(_) => break,
                Event::Start(tag) if is_block(tag) => break,
                _ => {}
            }
            let Some((event, range)) = self.next() else { break };
            match event {
                Event::Text(text) => {
                    self.whole(&text, &range)?;
                    self.text(&text, &mut out)?;
                }
                Event::Code(text) => {
                    self.has_no_role(&text, &range)?;
                    out.push(Inline::Code(self.written(&text)?));
                }
                Event::InlineMath(_) if self.inside > 0 => {
                    return Err(markup("hosts see no formula inside emphasis or a link"));
                }
                Event::InlineMath(tex) => {
                    self.stands_free(&range)?;
                    out.push(Inline::Maths(self.maths(&tex)?));
                }
                Event::DisplayMath(tex) => out.push(self.display(&tex)?),
                Event::SoftBreak => out.push(Inline::Soft),
                Event::HardBreak => out.push(Inline::Break),
                Event::InlineHtml(html) => comment(&html)?,
                Event::Start(tag) => out.push(self.span(tag, range)?),
                other => return Err(markup(format!("no such markup: {other:?}"))),
            }
        }
        Ok(out)
    }

    /// The same where no picture and no equation of its own can stand.
    pub(super) fn without_pictures(&mut self) -> Result<Vec<Inline>, Error> {
        let inlines = self.inlines()?;
        if inlines.iter().any(|inline| matches!(inline, Inline::Display { .. })) {
            return Err(markup("an equation between $$ stands in a paragraph; write $…$ here"));
        }
        refuse_pictures(&inlines).map(|()| inlines)
    }

    /// Other tools give code a role, or run it.
    fn has_no_role(&self, code: &str, range: &Range<usize>) -> Result<(), Error> {
        let before = self.filled.text[..range.start].split_whitespace().next_back();
        let before =
            before.filter(|_| !self.filled.text[..range.start].ends_with(char::is_whitespace));
        let role = |word: &str| word.len() > 2 && word.starts_with(':') && word.ends_with(':');
        match before.is_some_and(role) || code.starts_with("r ") {
            true => Err(markup("code has no role and is not run; write $…$, [@…] or «…»")),
            false => Ok(()),
        }
    }

    /// Refuses markup that was left over as text, since its other end is missing.
    fn whole(&mut self, text: &str, range: &Range<usize>) -> Result<(), Error> {
        let source = &self.filled.text;
        // Behind a backslash a sign is meant as it stands.
        let escaped = source[..range.start].ends_with('\\');
        let begins =
            source[..range.start].rsplit('\n').next().is_some_and(|line| line.trim().is_empty());
        if begins && text.starts_with('|') {
            self.at = range.start;
            return Err(markup(
                "a table needs a line of dashes below its head with as many columns; write \\| for the sign",
            ));
        }
        if let Some(offset) = leftover::find(source, range.start, text, escaped) {
            self.at = offset;
            return Err(markup(leftover::WHAT));
        }
        // Characters for private use frame values; nobody else writes them, not as `&#xE000;` either.
        if let Some(c) = text.chars().find(|c| is_no_text(*c) && !self.source(range).contains(*c)) {
            return Err(markup(format!("the character U+{:04X} is none of a text", u32::from(c))));
        }
        let written = self.source(range);
        if written.starts_with('&') && written.ends_with(';') && written != text {
            return Err(markup(format!("{written} is no text; write the character itself")));
        }
        let odd = |c: char| !c.is_ascii() && !is_no_text(c);
        for (i, c) in text.char_indices().filter(|(_, c)| odd(*c)) {
            tex::text(c.encode_utf8(&mut [0; 4])).inspect_err(|_| self.at = range.start + i)?;
        }
        if let Some(offset) = text.find("{#").filter(|_| !escaped) {
            self.attribute = Some(range.start + offset);
        }
        Ok(())
    }

    /// Hosts see a formula in the line only behind a blank or an opening bracket.
    fn stands_free(&self, range: &Range<usize>) -> Result<(), Error> {
        let before = self.filled.text[..range.start].chars().next_back();
        let touches =
            |c: char| c.is_alphanumeric() || matches!(c, ')' | ']' | '$') || mark::ends(c);
        match before.is_some_and(touches) {
            true => Err(markup(
                "hosts see no formula right behind a word or a number: move it inside, or set it apart",
            )),
            false => Ok(()),
        }
    }

    fn span(&mut self, tag: Tag<'_>, range: Range<usize>) -> Result<Inline, Error> {
        let hides = matches!(tag, Tag::Emphasis | Tag::Link { .. });
        self.inside += usize::from(hides);
        let inner = self.without_pictures()?;
        self.inside -= usize::from(hides);
        self.at = range.start;
        self.next();
        let empty = plain(&inner).trim().is_empty();
        Ok(match tag {
            Tag::Emphasis => Inline::Emphasis(inner),
            Tag::Strong => Inline::Strong(inner),
            Tag::Link { link_type: LinkType::ShortcutUnknown, dest_url, .. } => {
                let link = own_link(&dest_url)?;
                match &link {
                    Inline::Anchor { id, .. } => self.places.add(format!("#{id}"), range.start),
                    Inline::Unresolved(ids) => {
                        let all = ids.iter().cloned().chain([ids.join("; ")]);
                        all.for_each(|id| self.places.add(format!("@{id}"), range.start));
                    }
                    _ => {}
                }
                link
            }
            Tag::Link { dest_url, .. } if dest_url.starts_with('@') => {
                return Err(markup("a reference for a link; write two of them as [@one; @two]"));
            }
            Tag::Link { .. } if plain(&inner).starts_with('@') => {
                return Err(markup("a reference leads where it names; write [@…] alone"));
            }
            Tag::Link { dest_url, .. } if dest_url.contains(char::is_whitespace) => {
                return Err(markup("a blank in the target of a link; write %20"));
            }
            Tag::Link { .. } if empty => return Err(markup("a link without words")),
            Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. } if dest_url.is_empty() => {
                return Err(markup("a link or picture that leads nowhere"));
            }
            Tag::Link { dest_url, link_type, .. } => {
                let mail = if link_type == LinkType::Email { "mailto:" } else { "" };
                let to = format!("{mail}{}", self.written(&dest_url)?);
                self.places.add(format!("({to}"), range.start);
                Inline::Link { to, shown: inner }
            }
            // Becomes a figure if it stands alone in its paragraph, else an error there.
            Tag::Image { dest_url, .. } => picture(&dest_url, inner),
            other => return Err(markup(format!("no such markup: {other:?}"))),
        })
    }

    /// Text with marks → words and values.
    fn text(&self, text: &str, out: &mut Vec<Inline>) -> Result<(), Error> {
        for piece in pieces(text) {
            match piece {
                Piece::Text(words) => match (whole(words)?, out.last_mut()) {
                    (words, Some(Inline::Text(before))) => before.push_str(words),
                    (words, _) => out.push(Inline::Text(words.to_string())),
                },
                Piece::Value { id, shown } => {
                    let shown = words_and_maths(&self.shown(&id, shown, Target::Prose)?);
                    out.push(Inline::Value { id, shown });
                }
            }
        }
        Ok(())
    }

    /// TeX that every format can show.
    fn maths(&self, tex: &str) -> Result<String, Error> {
        let tex = self.replaced(tex, Target::Maths)?;
        let bare = bare(&tex);
        if bare.trim().is_empty() {
            return Err(markup("a formula without anything in it"));
        }
        if bare.contains('`') {
            return Err(markup("code within a formula; write $…$ alone"));
        }
        if bare.contains('»') {
            return Err(markup("the end of a value that does not begin; put « before its name"));
        }
        match macros::refused(&bare).or_else(|| macros::ungrouped(&tex)) {
            Some(what) => Err(Error::Maths { tex: bare, what }),
            None => tex::maths(&bare).and_then(|_| mathml::reads(&bare)).map(|()| tex),
        }
    }

    /// Cuts `\tag{18}` out of an equation.
    fn display(&mut self, tex: &str) -> Result<Inline, Error> {
        let Some((before, after)) = tex.split_once(r"\tag{") else {
            return Ok(Inline::Display { tex: self.maths(tex.trim())?, tag: None });
        };
        let (tag, after) =
            after.split_once('}').ok_or_else(|| markup(r"a \tag{ without its end"))?;
        let tex = self.maths(format!("{}{}", before.trim(), after.trim_end()).trim())?;
        of_kind("eq", &format!("eq:{tag}"))?;
        self.places.add(format!("#eq:{tag}"), self.at);
        Ok(Inline::Display { tex, tag: Some(tag.to_string()) })
    }

    pub(super) fn written(&self, text: &str) -> Result<String, Error> {
        self.replaced(text, Target::Plain)
    }

    fn replaced(&self, text: &str, target: Target) -> Result<String, Error> {
        let one = |piece| match piece {
            Piece::Value { id, shown } => self.shown(&id, shown, target),
            Piece::Text(text) => whole(text).map(str::to_string),
        };
        pieces(text).into_iter().map(one).collect()
    }

    fn shown(&self, id: &str, words: &str, target: Target) -> Result<String, Error> {
        let unknown = || Error::Template(format!("there is no value {id}"));
        let value = self.values.get(id).ok_or_else(unknown)?;
        let printed = print(&value.number, mark::style(words));
        Ok(match target {
            Target::Prose => printed.markdown(),
            Target::Maths => framed(id, &printed.maths()),
            Target::Plain => printed.plain(),
        })
    }
}

/// Text without a part of a value.
fn whole(text: &str) -> Result<&str, Error> {
    match text.contains(is_no_text) {
        true => Err(Error::Template("a filter has cut a value; print it whole".into())),
        false => Ok(text),
    }
}

#[derive(Clone, Copy)]
enum Target {
    Prose,
    Maths,
    Plain,
}
