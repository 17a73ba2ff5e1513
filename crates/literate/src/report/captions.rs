//! What stands alone in its paragraph (a figure, a lab, the references), and captions that stand before
//! what they belong to.

use super::Error;
use super::document::{Block, Inline, plain};
use crate::source::Program;

/// Before the path of a picture.
const IMAGE: &str = "image:";

/// A picture: a figure if it stands alone in its paragraph.
pub(super) fn picture(path: &str, caption: Vec<Inline>) -> Inline {
    Inline::Link { to: format!("{IMAGE}{path}"), shown: caption }
}

/// Refuses one amid other things.
pub(super) fn refuse_pictures(inlines: &[Inline]) -> Result<(), Error> {
    let image =
        |inline: &Inline| matches!(inline, Inline::Link { to, .. } if to.starts_with(IMAGE));
    match inlines.iter().any(image) {
        true => Err(Error::Markup("a picture stands alone in its paragraph".into())),
        false => Ok(()),
    }
}

/// A paragraph, or the figure or the list of references that stands alone in it.
pub(super) fn paragraph(mut inlines: Vec<Inline>) -> Result<Block, Error> {
    if let [Inline::Unresolved(ids)] = inlines.as_slice()
        && ids == &["bibliography"]
    {
        return Ok(Block::Bibliography(Vec::new()));
    }
    if let Some(Inline::Text(first)) = inlines.first_mut()
        && let Some((lab, words)) = first.strip_prefix("Lab ").and_then(|own| own.split_once(": "))
    {
        let (lab, words) = (lab.to_string(), words.to_string());
        *first = words;
        return Ok(Block::Lab { lab, caption: inlines });
    }
    if let [Inline::Link { to, shown }] = inlines.as_mut_slice()
        && to.starts_with(IMAGE)
    {
        let shown = std::mem::take(shown);
        if plain(&shown).trim().is_empty() {
            return Err(Error::Markup("a figure without a caption".into()));
        }
        let path = to.trim_start_matches(IMAGE).to_string();
        let number = number_of_figure(&path);
        let id = format!("fig:{number}");
        let (alt, origin) = (String::new(), Vec::new());
        return Ok(Block::Figure { id, number, path, alt, origin, caption: shown });
    }
    refuse_pictures(&inlines)?;
    let lists = |inline: &Inline| matches!(inline, Inline::Unresolved(ids) if ids.iter().any(|id| id == "bibliography"));
    if inlines.iter().any(lists) {
        return Err(Error::Markup("[@bibliography] stands alone in its paragraph".into()));
    }
    Ok(Block::Paragraph(inlines))
}

/// figures/fig03.svg → 3, figures/s01.svg → S1.
pub(super) fn number_of_figure(path: &str) -> String {
    let stem = path.rsplit('/').next().unwrap_or(path);
    let stem = stem.split('.').next().unwrap_or(stem);
    let digits = stem.trim_start_matches(|c: char| c.is_ascii_alphabetic());
    let prefix = &stem[..stem.len() - digits.len()];
    let digits = digits.trim_start_matches('0');
    if prefix == "fig" { digits.to_string() } else { format!("{}{digits}", prefix.to_uppercase()) }
}

/// The listing of an item; its caption stands before it.
pub(super) fn listing(path: &str, program: &Program) -> Result<Block, Error> {
    let found = program.item(path).map_err(Error::Markup)?;
    let words = |words: &str| Inline::Text(words.into());
    let link = Inline::Link { to: format!("../{}", found.file), shown: vec![words(found.file)] };
    Ok(Block::Listing {
        id: String::new(),
        number: String::new(),
        caption: Vec::new(),
        item: path.to_string(),
        file: found.file.to_string(),
        origin: vec![words("From "), link, words(".")],
        text: found.text,
    })
}

const CAPTIONS: [&str; 2] = ["Table: ", "Listing: "];

/// Is it a paragraph that a table or a listing has to follow?
pub(super) fn opens_caption(block: &Block) -> bool {
    let Block::Paragraph(words) = block else { return false };
    matches!(words.first(), Some(Inline::Text(first)) if CAPTIONS.iter().any(|word| first.starts_with(word)))
}

/// Joins a paragraph `Table: …` or `Listing: …` before it to a table or listing: the id if it took one.
pub(super) fn join(
    blocks: &mut Vec<Block>,
    block: &mut Block,
) -> Result<Option<Option<String>>, Error> {
    match block {
        Block::Table { id, number, caption, .. } => {
            let found = caption_before(blocks, CAPTIONS[0]);
            let Some((words, attribute)) = found else { return Ok(None) };
            refuse_empty(&words)?;
            (*caption, *id) = (words, attribute);
            *number = Some(String::new());
            Ok(Some(id.clone()))
        }
        Block::Listing { id, caption, item, .. } => {
            let Some((words, Some(attribute))) = caption_before(blocks, CAPTIONS[1]) else {
                return Err(Error::Markup(format!(
                    "code of `{item}` without the paragraph `Listing: caption {{#lst:id}}` before it"
                )));
            };
            refuse_empty(&words)?;
            (*caption, *id) = (words, attribute);
            Ok(Some(Some(id.clone())))
        }
        _ => Ok(None),
    }
}

fn refuse_empty(caption: &[Inline]) -> Result<(), Error> {
    match plain(caption).trim() {
        "" => Err(Error::Markup("a caption without its words".into())),
        _ => Ok(()),
    }
}

/// Takes the last block if it is a paragraph that begins so: its words and its `{#id}`.
fn caption_before(blocks: &mut Vec<Block>, opening: &str) -> Option<(Vec<Inline>, Option<String>)> {
    let Some(Block::Paragraph(words)) = blocks.last_mut() else { return None };
    let Some(Inline::Text(first)) = words.first_mut() else { return None };
    *first = first.strip_prefix(opening)?.to_string();
    let mut id = None;
    if let Some(Inline::Text(last)) = words.last_mut()
        && let Some((before, attribute)) = last.trim_end().rsplit_once("{#")
    {
        id = Some(attribute.trim_end_matches('}').to_string());
        *last = before.trim_end().to_string();
    }
    let words = std::mem::take(words);
    blocks.pop();
    Some((words, id))
}

/// May it stand in a list or a quotation? What is counted there would have no number.
pub(super) fn stands_within(block: &Block) -> bool {
    use Block::{Code, List, Paragraph, Quote, Table};
    matches!(block, Paragraph(_) | List { .. } | Quote(_) | Code { .. } | Table { .. })
        && !opens_caption(block)
}
