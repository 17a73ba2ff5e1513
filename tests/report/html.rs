//! Reads the pages by an XML parser, with the results of the quick profile.

use super::*;
use literate::report;
use roxmltree::{Document, Node, ParsingOptions};

fn parsed(text: &str) -> Document<'_> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).unwrap_or_else(|error| panic!("{error}"))
}

fn pages() -> impl Iterator<Item = (&'static report::Document, Document<'static>)> {
    let documents = QUICK.paper.edition.documents.iter();
    documents.map(|document| (document, parsed(QUICK.file_text(document.page))))
}

/// A card: title, first line, and which rows it has.
type Card = (String, String, Vec<usize>);

fn cards(script: &str) -> (Vec<String>, BTreeMap<String, Card>) {
    let json = script.strip_prefix("CARDS = ").and_then(|script| script.strip_suffix(";\n"));
    serde_json::from_str(json.unwrap()).unwrap()
}

fn elements<'a>(page: &'a Document<'a>, name: &str) -> Vec<Node<'a, 'a>> {
    page.descendants().filter(|node| node.tag_name().name() == name).collect()
}

fn words(node: Node<'_, '_>) -> String {
    node.descendants().filter(Node::is_text).filter_map(|text| text.text()).collect()
}

/// The links and places of a page, or of all cards.
fn links(text: &str) -> [Vec<String>; 2] {
    let cards = text.starts_with("CARDS").then(|| format!("<p>{}</p>", cards(text).0.concat()));
    let page = parsed(cards.as_deref().unwrap_or(text));
    let attributes = |name| page.descendants().filter_map(move |node| node.attribute(name));
    let links = attributes("href").chain(attributes("src")).filter(|to| !to.starts_with("data:"));
    [links.map(String::from).collect(), attributes("id").map(String::from).collect()]
}

#[test]
fn every_link_lands_wherever_the_report_is_written() {
    let pages = QUICK.paper.edition.documents.iter().map(|document| document.page);
    super::links_land(pages.chain(["cards.js"]).collect(), links, 500, 150);
}

#[test]
fn every_value_has_one_card() {
    let (rows, cards) = cards(QUICK.file_text("cards.js"));
    let (mut shown, mut asked) = (0, BTreeSet::new());
    for (document, page) in pages() {
        for value in page.descendants().filter(|node| node.attribute("data-card").is_some()) {
            shown += 1;
            asked.insert(value.attribute("data-card").unwrap().to_string());
            assert!(!words(value).trim().is_empty(), "{}", document.page);
            assert!(value.ancestors().all(|outer| outer.tag_name().name() != "math"));
        }
    }
    // A card without a number, or a number without its card.
    assert_eq!(asked, cards.keys().cloned().collect());
    assert!(shown > 500, "{shown}");
    assert_eq!(rows.iter().collect::<BTreeSet<_>>().len(), rows.len(), "a row twice");
    // A path of an item that leads to no file was renamed or misspelt.
    let typed = ["<dt>id<", "<dt>repeat it<"];
    for row in rows.iter().filter(|row| !typed.iter().any(|name| row.starts_with(name))) {
        assert!(!row.contains("<code>") || row.contains("<a href=\"../"), "{row}");
    }
    let card = &cards["sweep.rise.half_height"];
    let html: String = card.2.iter().map(|row| rows[*row].as_str()).collect();
    for part in ["rise::", "<wbr/>Curve::<wbr/>new", "standard error", "--rerun sweep"] {
        assert!(html.contains(part), "{part:?} is not in {html:?}");
    }
    // The headline number stands in an equation, and opens there too.
    let headline = |node: &Node<'_, '_>| {
        node.attribute("data-card") == Some("sweep.rise.half_height")
            && node.ancestors().any(|outer| outer.attribute("class") == Some("equation"))
    };
    assert!(parsed(QUICK.file_text("report.html")).descendants().any(|node| headline(&node)));
}

/// Colours of what is drawn come from the style sheet, which knows light from dark.
#[test]
fn no_colour_is_fixed() {
    for (_, page) in pages() {
        for node in page.descendants() {
            // MathML aligns columns so, and a score says the size of its parts.
            let style = node.attribute("style").unwrap_or_default();
            let is_colour = |of: &&str| style.contains(*of);
            assert!(!["color", "background"].iter().any(is_colour), "{style}");
            let drawn = ["fill", "stroke"].map(|name| node.attribute(name).unwrap_or("none"));
            assert_eq!(drawn, ["none"; 2], "a colour that does not know light from dark");
        }
    }
}

#[test]
fn every_page_says_how_to_cite_it() {
    for (document, page) in pages() {
        let title = words(elements(&page, "title")[0]);
        let boxes = elements(&page, "details").into_iter();
        let boxes: Vec<_> = boxes.filter(|node| node.attribute("class") == Some("cite")).collect();
        let [cite] = boxes[..] else { panic!("{} boxes", boxes.len()) };
        let entry = words(cite);
        assert!(entry.contains(&format!("@misc{{impactpaper2026{},", document.prose)), "{entry}");
        let authors = Vec::from_iter(QUICK.paper.edition.authors.iter().map(|(author, _)| *author));
        assert!(authors.iter().all(|author| entry.contains(author)), "{entry}");
        // What Google Scholar reads: a line for each author.
        let metas = elements(&page, "meta");
        let contents = |name: &str| -> Vec<_> {
            let named = metas.iter().filter(|node| node.attribute("name") == Some(name));
            named.filter_map(|node| node.attribute("content")).collect()
        };
        assert_eq!(contents("citation_title"), [title.as_str()]);
        assert_eq!(contents("citation_author"), authors);
        assert!(entry.contains(&format!("title  = {{{title}}}")), "{entry}");
        assert!(entry.contains(concat!("impact-paper ", env!("CARGO_PKG_VERSION"))), "{entry}");
    }
}

#[test]
fn equations_are_mathml() {
    let page = parsed(QUICK.file_text("report.html"));
    assert!(elements(&page, "math").len() > 300);
    assert!(elements(&page, "merror").is_empty());
    for node_text in page.descendants().filter(Node::is_text).filter_map(|node| node.text()) {
        assert!(!node_text.contains(['\u{e000}', '\u{e003}', '\u{e005}', '$']), "{node_text:?}");
    }
}
