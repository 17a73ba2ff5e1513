//! report.html as a browser and a reader meet it: read by an XML parser, with the results of the
//! quick profile.

use impact_paper::claims::{self, Published};
use impact_paper::experiments::{Need, Progress, Store, run::run};
use impact_paper::figures::{self, Figure};
use impact_paper::params::Profile;
use impact_paper::report::{Input, Report, Templates, assemble, compare, contents, recipe};
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::LazyLock;

struct Made {
    figures: Vec<Figure>,
    report: Report,
    html: String,
}

fn make() -> Made {
    let templates = Templates::read(Path::new("templates")).unwrap();
    let scenario = |file: &str| {
        std::fs::read_to_string(Path::new("templates").join(file)).map_err(|e| e.to_string())
    };
    let results =
        run(&Need::ALL, Profile::Quick, scenario, &Store::nowhere(), &Progress::silent()).unwrap();
    let published = Published::parse(templates.text("published.toml").unwrap()).unwrap();
    let claims = claims::all(&results, &published).unwrap();
    let values = contents::registry(&results, &published).unwrap();
    let rows = contents::rows(&results, &claims).unwrap();
    let figures: Vec<_> = figures::all().map(|n| figures::draw(n, &results).unwrap()).collect();
    let input = Input {
        templates: &templates,
        values: &values,
        rows: &rows,
        claims: &claims,
        figures: &figures,
    };
    let report = assemble(&input).unwrap_or_else(|error| panic!("{error}"));
    assert!(report == assemble(&input).unwrap(), "the same input gives other bytes");
    let html = String::from_utf8(report.beside["report.html"].clone()).unwrap();
    Made { figures, report, html }
}

static MADE: LazyLock<Made> = LazyLock::new(make);

fn page() -> Document<'static> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(&MADE.html, options).unwrap_or_else(|error| panic!("{error}"))
}

fn elements<'a>(page: &'a Document<'a>, name: &str) -> Vec<Node<'a, 'a>> {
    page.descendants().filter(|node| node.tag_name().name() == name).collect()
}

fn ids<'a>(page: &'a Document<'a>) -> BTreeSet<&'a str> {
    page.descendants().filter_map(|node| node.attribute("id")).collect()
}

fn words(node: Node<'_, '_>) -> String {
    node.descendants().filter(Node::is_text).filter_map(|text| text.text()).collect()
}

#[test]
fn every_id_is_unique_and_every_link_lands() {
    let page = page();
    let mut seen = BTreeSet::new();
    for id in page.descendants().filter_map(|node| node.attribute("id")) {
        assert!(seen.insert(id), "the id {id} stands twice");
    }
    let mut inside = 0;
    for link in elements(&page, "a").into_iter().chain(elements(&page, "use")) {
        let to = link.attribute("href").unwrap();
        if let Some(id) = to.strip_prefix('#') {
            inside += 1;
            assert!(seen.contains(id), "no {to}, to which {:?} links", words(link));
        } else if !to.contains("://") {
            let source = to.strip_prefix("../").map(|path| Path::new(path).exists());
            let made = MADE.report.committed.contains_key(to) || to == "SHA256SUMS" || to == "data";
            assert!(source.unwrap_or(made), "no file {to}");
        }
        assert!(!words(link).trim().is_empty() || link.tag_name().name() == "use", "{to}");
    }
    assert!(inside > 500, "{inside}");
    for node in page.descendants() {
        for name in ["aria-labelledby", "aria-describedby"] {
            for id in node.attribute(name).iter().flat_map(|ids| ids.split(' ')) {
                assert!(seen.contains(id), "{name}={id}");
            }
        }
    }
}

#[test]
fn every_value_has_one_card() {
    let page = page();
    let buttons = elements(&page, "button");
    assert!(buttons.len() > 400, "{}", buttons.len());
    let targets: BTreeSet<_> =
        buttons.iter().map(|b| b.attribute("popovertarget").unwrap()).collect();
    let cards: Vec<_> =
        page.descendants().filter(|node| node.attribute("popover").is_some()).collect();
    let have: BTreeSet<_> = cards.iter().map(|card| card.attribute("id").unwrap()).collect();
    assert_eq!(cards.len(), have.len());
    assert_eq!(targets, have, "a card without a number, or a number without its card");
    assert!(buttons.iter().all(|button| !words(*button).trim().is_empty()));
    let values = std::str::from_utf8(&MADE.report.committed["values.json"]).unwrap();
    for value in compare::read(values).unwrap().iter().filter(|v| !v.experiment.is_empty()) {
        let known = recipe::recipe(&value.experiment, Profile::Quick).is_some();
        assert!(known, "{}: no recipe of {:?}", value.id, value.experiment);
    }
    // A path of an item that leads to no file was renamed or misspelt.
    for card in &cards {
        for code in card.descendants().filter(|node| node.tag_name().name() == "code").skip(1) {
            let linked = code.parent().is_some_and(|outer| outer.tag_name().name() == "a");
            assert!(linked, "{} names {}", card.attribute("id").unwrap(), words(code));
        }
    }
    // The headline number stands in an equation, and opens there too.
    let card = cards.iter().find(|card| card.attribute("id") == Some("card-half_height")).unwrap();
    let text = words(*card);
    for part in ["experiments::rise::find", "standard error", "seed: 2007", "reproduced"] {
        assert!(text.contains(part), "{part:?} is not in {text:?}");
    }
    let displayed = |node: &Node<'_, '_>| {
        node.ancestors().any(|outer| outer.attribute("class") == Some("equation"))
    };
    let opens = |b: &Node<'_, '_>| b.attribute("popovertarget") == Some("card-half_height");
    assert!(buttons.iter().any(|button| opens(button) && displayed(button)));
    for button in &buttons {
        assert!(button.ancestors().all(|outer| outer.tag_name().name() != "math"));
    }
}

#[test]
fn every_figure_says_what_is_seen_with_its_numbers() {
    let page = page();
    let pictures: BTreeMap<_, _> = elements(&page, "svg")
        .into_iter()
        .filter(|svg| svg.attribute("role") == Some("img"))
        .map(|svg| (svg.attribute("aria-labelledby").unwrap_or_default(), svg))
        .collect();
    assert_eq!(pictures.len(), MADE.figures.len());
    for figure in &MADE.figures {
        let (title, description) = (format!("{}-title", figure.id), format!("{}-desc", figure.id));
        let svg = pictures[format!("{title} {description}").as_str()];
        let text =
            |id: &str| words(svg.children().find(|node| node.attribute("id") == Some(id)).unwrap());
        assert_eq!(text(&title), figure.title);
        assert_eq!(text(&description), figure.description.trim());
        assert!(figure.description.contains(|c: char| c.is_ascii_digit()), "{}", figure.id);
        let outer = words(svg.ancestors().find(|n| n.tag_name().name() == "figure").unwrap());
        for origin in ["Picture: ", "Data: ", "Code: "] {
            assert!(outer.contains(origin), "{}: no {origin:?}", figure.id);
        }
    }
}

#[test]
fn nothing_is_loaded_and_no_colour_is_fixed() {
    let page = page();
    for node in page.descendants() {
        let name = node.tag_name().name();
        assert!(!["script", "img", "iframe", "object", "embed"].contains(&name), "{name}");
        assert_eq!(node.attribute("src"), None);
        // MathML aligns the columns of its tables so.
        let style = node.attribute("style").unwrap_or_default();
        let maths = node.ancestors().any(|outer| outer.tag_name().name() == "math");
        assert!(style.is_empty() || maths && !style.contains("color"), "{style}");
        if name == "link" {
            assert_eq!(node.attribute("href"), Some("data:,"));
        }
        for colour in ["fill", "stroke"] {
            let value = node.attribute(colour).unwrap_or("none");
            assert_eq!(value, "none", "a colour that does not know light from dark");
        }
    }
    let style: String = elements(&page, "style").into_iter().map(words).collect();
    for address in style.split("url(").skip(1) {
        assert!(address.starts_with("data:font/woff2;base64,"), "{}", &address[..40]);
    }
    assert!(!style.contains("@import"));
    assert!(MADE.html.len() < 4_000_000, "{} bytes", MADE.html.len());
}

/// All equations of the paper with their numbers, as MathML.
#[test]
fn equations_are_mathml() {
    let page = page();
    let ids = ids(&page);
    for number in 1..=38 {
        assert!(ids.contains(format!("eq-{number}").as_str()), "Eq. ({number})");
    }
    assert!(elements(&page, "math").len() > 400);
    assert!(elements(&page, "merror").is_empty());
    for text in page.descendants().filter(Node::is_text).filter_map(|node| node.text()) {
        assert!(!text.contains(['\u{e000}', '\u{e003}', '\u{e005}', '$']), "{text:?}");
    }
}

/// The ratio of luminances (WCAG 2.2) of each colour of the figures to the page.
#[test]
fn colours_stand_out_in_light_and_dark() {
    let css = std::fs::read_to_string("templates/report.css").unwrap();
    let schemes: Vec<&str> = css.split(":root {").skip(1).collect();
    assert_eq!(schemes.len(), 2);
    for scheme in schemes {
        let colour = |name: &str| {
            let code = scheme.split(&format!("--{name}: #")).nth(1);
            let code = code.unwrap_or_else(|| panic!("--{name} is not in {scheme}"));
            let channel = |i: usize| {
                let c = f64::from(u8::from_str_radix(&code[i..i + 2], 16).unwrap()) / 255.0;
                if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
            };
            0.2126 * channel(0) + 0.7152 * channel(2) + 0.0722 * channel(4)
        };
        let contrast = |a: &str, b: &str| {
            let (a, b) = (colour(a), colour(b));
            (a.max(b) + 0.05) / (a.min(b) + 0.05)
        };
        for (name, _) in figures::palette() {
            let least = match name {
                "page" => continue,
                // Fills behind other things.
                "pale" => 1.2,
                "ink" | "grey" => 4.5,
                _ => 3.0,
            };
            assert!(contrast(name, "page") >= least, "{name}: {}", contrast(name, "page"));
        }
        for name in ["ink", "grey", "link"] {
            assert!(contrast(name, "soft") >= 4.5, "{name}: {}", contrast(name, "soft"));
        }
    }
}
