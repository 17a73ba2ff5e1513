//! The pages as a browser and a reader meet them: read by an XML parser, with the results of the
//! quick profile.

use crate::quick::QUICK;
use impact_paper::dynamics::{Engine, Scenario};
use impact_paper::experiments::SPACE_TIME;
use impact_paper::numerics::random::NormalPairs;
use impact_paper::report::{PROGRAM, compare, recipe};
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::LazyLock;

static PAGES: LazyLock<BTreeMap<&str, String>> = LazyLock::new(|| {
    let text = |page: &str| String::from_utf8(QUICK.report.beside[page].clone()).unwrap();
    PROGRAM.documents.iter().map(|document| (document.page, text(document.page))).collect()
});

fn page(name: &str) -> Document<'static> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(&PAGES[name], options).unwrap_or_else(|error| panic!("{error}"))
}

fn pages() -> impl Iterator<Item = (&'static str, Document<'static>)> {
    PAGES.keys().map(|name| (*name, page(name)))
}

/// A card: title, first line, and which rows it has.
type Card = (String, String, Vec<usize>);

/// The JSON in a script of this id.
fn data(page: &Document<'_>, id: &str) -> serde_json::Value {
    let script = page.descendants().find(|node| node.attribute("id") == Some(id)).unwrap();
    serde_json::from_str(script.text().unwrap()).unwrap()
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
    let pages: Vec<_> = pages().collect();
    let ids: BTreeMap<&str, BTreeSet<&str>> =
        pages.iter().map(|(name, page)| (*name, ids(page))).collect();
    let (mut inside, mut across) = (0, 0);
    for (name, page) in &pages {
        let count = page.descendants().filter(|node| node.has_attribute("id")).count();
        assert_eq!(count, ids[name].len(), "{name}: an id stands twice");
        for link in elements(page, "a").into_iter().chain(elements(page, "use")) {
            let to = link.attribute("href").unwrap();
            if !to.contains("://") {
                let (file, id) = to.split_once('#').unwrap_or((to, ""));
                inside += usize::from(file.is_empty());
                across += usize::from(!file.is_empty() && !id.is_empty());
                let file = if file.is_empty() { name } else { file };
                assert!(id.is_empty() || ids[file].contains(id), "{name}: no {to}");
                let source = file.strip_prefix("../").map(|path| Path::new(path).exists());
                let made = QUICK.report.committed.contains_key(file)
                    || ids.contains_key(file)
                    || ["SHA256SUMS", "data"].contains(&file);
                assert!(source.unwrap_or(made), "{name}: no {to}");
            }
        }
    }
    assert!(inside > 500 && across > 150, "{inside} {across}");
}

#[test]
fn every_value_has_one_card() {
    let mut shown = 0;
    for (name, page) in pages() {
        let mut buttons = elements(&page, "button");
        buttons.retain(|button| button.attribute("class") == Some("value"));
        shown += buttons.len();
        let asked: BTreeSet<&str> =
            buttons.iter().map(|b| b.attribute("data-card").unwrap()).collect();
        let (rows, cards): (Vec<String>, BTreeMap<String, Card>) =
            serde_json::from_value(data(&page, "cards")).unwrap();
        let have: BTreeSet<&str> = cards.keys().map(String::as_str).collect();
        assert_eq!(asked, have, "{name}: a card without a number, or a number without its card");
        assert!(buttons.iter().all(|button| !words(*button).trim().is_empty()));
        assert_eq!(rows.iter().collect::<BTreeSet<_>>().len(), rows.len(), "{name}: a row twice");
        // A path of an item that leads to no file was renamed or misspelt.
        for row in rows.iter().filter(|row| !row.starts_with("<dt>id</dt>")) {
            let linked = !row.contains("<code>") || row.contains("<a href=\"../");
            assert!(linked, "{name}: {row}");
        }
        for button in &buttons {
            assert!(button.ancestors().all(|outer| outer.tag_name().name() != "math"));
        }
        if name == "report.html" {
            // The headline number stands in an equation, and opens there too.
            let own = &cards["sweep.rise.half_height"];
            let text: String = own.2.iter().map(|row| rows[*row].as_str()).collect();
            for part in ["rise::", "<wbr/>find", "standard error", "seed: 2007"] {
                assert!(text.contains(part), "{part:?} is not in {text:?}");
            }
            // What a claim uses has its verdict, but for short numbers, as a small sample may give.
            let judged = |row: &String| row.starts_with("<dt>claims") && row.contains("reproduced");
            assert!(rows.iter().filter(|row| judged(row)).count() > 20);
            let displayed = |node: &Node<'_, '_>| {
                node.ancestors().any(|outer| outer.attribute("class") == Some("equation"))
            };
            let opens =
                |b: &Node<'_, '_>| b.attribute("data-card") == Some("sweep.rise.half_height");
            assert!(buttons.iter().any(|button| opens(button) && displayed(button)));
        }
    }
    assert!(shown > 1000, "{shown}");
    let values = std::str::from_utf8(&QUICK.report.committed["values.json"]).unwrap();
    for value in compare::read(values).unwrap().iter().filter(|v| !v.experiment.is_empty()) {
        let known = recipe::recipe(&value.experiment, "quick").is_some();
        assert!(known, "{}: no recipe of {:?}", value.id, value.experiment);
    }
}

#[test]
fn every_figure_says_what_is_seen_with_its_numbers() {
    let pages: Vec<_> = pages().collect();
    let pictures: BTreeMap<_, _> = pages
        .iter()
        .flat_map(|(_, page)| elements(page, "svg"))
        .filter(|svg| svg.attribute("role") == Some("img"))
        .map(|svg| (svg.attribute("aria-labelledby").unwrap_or_default(), svg))
        .collect();
    assert_eq!(pictures.len(), QUICK.figures.len() + 1);
    assert!(pictures.contains_key("scene-title scene-desc"));
    for figure in &QUICK.figures {
        let (title, description) = (format!("{}-title", figure.id), format!("{}-desc", figure.id));
        let svg = pictures[format!("{title} {description}").as_str()];
        let text =
            |id: &str| words(svg.children().find(|node| node.attribute("id") == Some(id)).unwrap());
        assert_eq!([text(&title), text(&description)], [&*figure.title, figure.description.trim()]);
        let outer = words(svg.ancestors().find(|n| n.tag_name().name() == "figure").unwrap());
        for (origin, there) in
            [("Picture: ", true), ("Data: ", !figure.data.is_empty()), ("Code: ", true)]
        {
            assert_eq!(outer.contains(origin), there, "{}: {origin:?}", figure.id);
        }
    }
}

/// Colours of what is drawn come from the style sheet, which knows light from dark. (The browser finds what is loaded, and
/// pages that are too long.)
#[test]
fn no_colour_is_fixed() {
    for (_, page) in pages() {
        for node in page.descendants() {
            // MathML aligns the columns of its tables so.
            let style = node.attribute("style").unwrap_or_default();
            let maths = node.ancestors().any(|outer| outer.tag_name().name() == "math");
            assert!(style.is_empty() || maths && !style.contains("color"), "{style}");
            let drawn = ["fill", "stroke"].map(|name| node.attribute(name).unwrap_or("none"));
            assert_eq!(drawn, ["none"; 2], "a colour that does not know light from dark");
        }
    }
}

#[test]
fn every_page_says_how_to_cite_it() {
    for (name, page) in pages() {
        let title = words(elements(&page, "title")[0]);
        let boxes = elements(&page, "details").into_iter();
        let boxes: Vec<_> = boxes.filter(|own| own.attribute("class") == Some("cite")).collect();
        let [own] = boxes[..] else { panic!("{name}: {} boxes", boxes.len()) };
        let told = words(own);
        assert!(told.contains(&format!("title  = {{{title}}}")), "{name}: {told}");
        assert!(told.contains(concat!("impact-paper ", env!("CARGO_PKG_VERSION"))), "{told}");
    }
}

/// On a narrow screen the rows of a wide table are lists: each cell brings the name of its column.
#[test]
fn cells_of_wide_tables_know_their_column() {
    let pages: Vec<_> = pages().collect();
    let mut tables: Vec<_> = pages.iter().flat_map(|(_, page)| elements(page, "table")).collect();
    tables.retain(|table| table.attribute("class") == Some("lists"));
    assert!(!tables.is_empty());
    for table in tables {
        let inside = |name: &'static str| {
            table.descendants().filter(move |node| node.tag_name().name() == name)
        };
        // A formula in a head is spelt out in the name.
        let head = |th| words(th).split(',').next().unwrap_or_default().to_string();
        let heads: Vec<String> = inside("th").map(head).collect();
        assert!(heads.len() >= 4, "{heads:?}");
        for row in inside("tr").skip(1) {
            let named = row.children().map(|cell| cell.attribute("data-name").unwrap_or_default());
            let named: Vec<&str> =
                named.map(|name| name.split(',').next().unwrap_or(name)).collect();
            assert_eq!(named, heads, "{}", words(row));
        }
    }
}

/// Without its script the scene's picture, caption and description are there, and controls that would do nothing are
/// not.
#[test]
fn the_scene_is_complete_without_its_script() {
    let page = page("index.html");
    let scene = page.descendants().find(|node| node.attribute("id") == Some("scene")).unwrap();
    let inside = |name: &str| -> Vec<_> {
        scene.descendants().filter(|node| node.tag_name().name() == name).collect()
    };
    assert_eq!(inside("script").len(), 2);
    assert_eq!(elements(&page, "input").len(), 1);
    let controls = scene.children().find(|n| n.attribute("class") == Some("controls")).unwrap();
    assert_eq!(controls.attribute("hidden"), Some(""));
    assert!(inside("input")[0].has_attribute("aria-label"));
    assert!(words(inside("figcaption")[0]).len() > 100);

    // The table has every mass where the engine has it. (The browser holds the script to the table.)
    let data: serde_json::Value = serde_json::from_str(&words(inside("script")[0])).unwrap();
    let number = |name: &str| data[name].as_f64().unwrap();
    let [from, first] = ["from", "first"].map(number);
    let (first, bodies) = (first as usize, data["bodies"].as_array().unwrap().len());
    assert_eq!(bodies, 22);
    let run = QUICK.results.of(&SPACE_TIME).unwrap();
    let parameters = &run.parameters;
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, run.realisation);
    let scenario = Scenario::draw(&parameters.chain, parameters.sigma, &mut normals);
    let mut engine = Engine::new(&scenario).unwrap();
    let mut hits = Vec::new();
    engine.run(from, |_| true).unwrap();
    let table = String::from_utf8(QUICK.report.committed["data/s02c.csv"].clone()).unwrap();
    assert!(table.starts_with(&format!("time (1/omega),x_{first} (d),")), "{table}");
    let read = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect();
    let rows: Vec<Vec<f64>> = table.lines().skip(1).map(read).collect();
    assert!(rows.len() == 25 && rows[0][0] == from);
    for row in &rows {
        let seen = |impact: impact_paper::dynamics::Impact| {
            let gap = impact.gap.wrapping_sub(first);
            hits.extend((gap < bodies - 1).then_some((impact.time, gap)));
            true
        };
        engine.run(row[0], seen).unwrap();
        let wall = (parameters.chain.masses + 1) as f64;
        let all = [vec![0.0], engine.positions(row[0]), vec![wall]].concat();
        for (shown, truth) in row[1..].iter().zip(&all[first..]) {
            assert!((shown - truth).abs() < 1e-9, "at {}: {shown} {truth}", row[0]);
        }
    }
    let listed: Vec<(f64, usize)> = serde_json::from_value(data["impacts"].clone()).unwrap();
    assert!(listed.len() > 10 && listed == hits, "{listed:?} {hits:?}");

    // Each block stands where its mass is at first, by the scale that the script moves it with.
    let group =
        |class: &str| scene.descendants().find(|n| n.attribute("class") == Some(class)).unwrap();
    let rects = group("masses").children().filter(|n| n.tag_name().name() == "rect");
    let places: Vec<f64> = rects.map(|r| r.attribute("x").unwrap().parse().unwrap()).collect();
    assert_eq!(places.len(), bodies);
    for (k, (x, place)) in places.iter().zip(&rows[0][1..]).enumerate() {
        let expected = 60.0 + 50.0 * k as f64 + number("scale") * (place - first as f64);
        assert!((x - expected).abs() < 0.051, "block {k}: {x} {expected}");
    }
    // No block lies on another: the distance of two blocks is their gap.
    assert!(places.windows(2).all(|pair| pair[1] - pair[0] > 49.9), "{places:?}");
    // A bar for each gap, pale and to its full length, and its number below.
    let mut bars = group("counts").children().filter(|n| n.tag_name().name() == "rect").step_by(2);
    let numbers = group("counts").children().filter(|n| n.tag_name().name() == "text");
    for (gap, own) in numbers.enumerate() {
        let counted = hits.iter().filter(|hit| hit.1 == gap).count();
        assert_eq!(words(own).trim().parse(), Ok(counted), "gap {gap}");
        let height: f64 = bars.next().unwrap().attribute("height").unwrap().parse().unwrap();
        assert!((height - number("bar") * counted as f64).abs() < 1e-9, "gap {gap}: {height}");
    }
    assert!(bars.next().is_none());
}

/// All equations of the paper with their numbers, as MathML.
#[test]
fn equations_are_mathml() {
    let page = page("report.html");
    let ids = ids(&page);
    for number in 1..=38 {
        assert!(ids.contains(format!("eq-{number}").as_str()), "Eq. ({number})");
    }
    assert!(elements(&page, "math").len() > 400);
    assert!(elements(&page, "merror").is_empty());
    let is_code = |node: &Node<'_, '_>| {
        node.parent_element().is_some_and(|outer| outer.tag_name().name() == "script")
    };
    let texts = page.descendants().filter(|node| node.is_text() && !is_code(node));
    for text in texts.filter_map(|node| node.text()) {
        assert!(!text.contains(['\u{e000}', '\u{e003}', '\u{e005}', '$']), "{text:?}");
    }
}

/// The ratio of luminances (WCAG 2.2) of each colour of the figures to the page.
#[test]
fn colours_stand_out_in_light_and_dark() {
    let css = std::fs::read_to_string("crates/literate/skin/report.css").unwrap();
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
        for (name, _) in impact_paper::figures::palette() {
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
