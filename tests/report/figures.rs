//! Every figure: well-formed, inside its frame, labelled, described, with its data, and the same
//! bytes each time.

use super::QUICK;
use impact_paper::experiments::{Progress, SEGMENTS, SPACE_TIME, Store};
use impact_paper::figures;
use impact_paper::params::{Profile, VERTICES};
use literate::figures::Figure;
use roxmltree::{Document, Node};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Numbers of a list such as `1,2 3,4`.
fn numbers(list: &str) -> Vec<f64> {
    list.split([' ', ','])
        .filter(|s| !s.is_empty())
        .map(|s| s.parse().unwrap_or_else(|_| panic!("{s:?} is not a number")))
        .collect()
}

/// Where the steps of a path end, stroke by stroke.
fn strokes(d: &str) -> Vec<Vec<(f64, f64)>> {
    let mut strokes: Vec<Vec<(f64, f64)>> = Vec::new();
    let letters: Vec<usize> =
        d.match_indices(|c: char| c.is_ascii_alphabetic()).map(|m| m.0).collect();
    let ends = letters.iter().skip(1).copied().chain([d.len()]);
    for (from, to) in letters.iter().zip(ends) {
        let n = numbers(&d[from + 1..to]);
        let (x, y) = strokes.last().and_then(|stroke| stroke.last().copied()).unwrap_or_default();
        let end = match &d[*from..from + 1] {
            "M" => {
                strokes.push(Vec::new());
                (n[0], n[1])
            }
            "h" => (x + n[0], y),
            "v" => (x, y + n[0]),
            "l" => (x + n[0], y + n[1]),
            "c" => (x + n[4], y + n[5]),
            _ => continue,
        };
        strokes.last_mut().unwrap().push(end);
    }
    strokes
}

fn view(document: &Document) -> (f64, f64) {
    let view = numbers(document.root_element().attribute("viewBox").unwrap());
    assert_eq!(&view[..2], [0.0, 0.0]);
    (view[2], view[3])
}

/// A label: its words and its box on the sheet.
#[derive(Debug)]
struct Label {
    words: String,
    x: (f64, f64),
    y: (f64, f64),
}

/// Labels with the boxes of their letters, from the base line to the height of a capital.
fn labels(document: &Document) -> Vec<Label> {
    let labelled = |n: &Node| n.tag_name().name() == "g" && n.attribute("aria-label").is_some();
    document.descendants().filter(labelled).map(|group| label(&group)).collect()
}

fn label(group: &Node) -> Label {
    let transform = group.attribute("transform").unwrap();
    let inner = |name: &str| {
        let rest = transform.split(&format!("{name}(")).nth(1)?;
        Some(numbers(rest.split(')').next().unwrap()))
    };
    let (at, scale) = (inner("translate").unwrap(), inner("scale").unwrap()[0]);
    let uses = || group.children().filter(|n| n.tag_name().name() == "use");
    let mut extent = (f64::MAX, f64::MIN);
    let mut base = 0.0;
    for glyph in uses() {
        let (x, wide) = match glyph.attribute("transform") {
            Some(moved) => (numbers(moved[10..].split(')').next().unwrap())[0], 330.0),
            None => {
                base = glyph.attribute("y").unwrap().parse().unwrap();
                (glyph.attribute("x").unwrap().parse().unwrap(), 470.0)
            }
        };
        extent = (extent.0.min(x), extent.1.max(x + wide));
    }
    let (along, across) =
        ((extent.0 * scale, extent.1 * scale), (base * scale, (base + 640.0) * scale));
    let words = group.attribute("aria-label").unwrap().to_string();
    if inner("rotate").is_some() {
        let x = (at[0] - across.1, at[0] - across.0);
        Label { words, x, y: (at[1] - along.1, at[1] - along.0) }
    } else {
        let y = (at[1] - across.1, at[1] - across.0);
        Label { words, x: (at[0] + along.0, at[0] + along.1), y }
    }
}

/// All pictures with their ids: of the quick profile, and those that are committed.
fn pictures() -> Vec<(String, String)> {
    let mut pictures = Vec::new();
    for Figure { id, .. } in &QUICK.figures {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("paper/figures/{id}.svg"));
        pictures.push((id.clone(), std::fs::read_to_string(file).unwrap()));
    }
    pictures.extend(QUICK.figures.iter().map(|figure| (figure.id.clone(), figure.svg())));
    pictures
}

#[test]
fn every_figure_is_a_titled_and_described_picture() {
    assert_eq!(QUICK.figures.len(), figures::ALL.len());
    for (listed, figure) in figures::ALL.iter().zip(&QUICK.figures) {
        assert_eq!(figure.id, listed.name);
        let svg = figure.svg();
        let document = Document::parse(&svg).unwrap();
        let root = document.root_element();
        assert_eq!(root.attribute("role"), Some("img"));
        let text = |name: &str| {
            let id = format!("{}-{name}", figure.id);
            assert!(root.attribute("aria-labelledby").unwrap().contains(&id));
            let node = document.descendants().find(|n| n.attribute("id") == Some(&id));
            node.unwrap().text().unwrap().to_string()
        };
        assert_eq!(text("title"), figure.title);
        assert_eq!(text("desc"), figure.description.text);
        assert!(figure.description.text.chars().count() > 150, "{}", figure.id);
        let words = figure.description.text.split_whitespace().count();
        assert!(words <= 60, "{}: {words} words", figure.id);
        assert!(figure.description.text.chars().any(|c| c.is_ascii_digit()), "{}", figure.id);
        assert!(
            !figure.description.text.contains("NaN") && !figure.description.text.contains("  ")
        );
        // Nothing that depends on the reader's fonts, and every glyph that is used is there.
        assert!(!svg.contains("<text") && !svg.contains("font-family"));
        let ids: BTreeSet<_> = document.descendants().filter_map(|n| n.attribute("id")).collect();
        for used in document.descendants().filter_map(|n| n.attribute("href")) {
            assert!(ids.contains(used.trim_start_matches('#')), "{}: {used}", figure.id);
        }
    }
}

#[test]
fn all_coordinates_are_finite_and_on_the_sheet() {
    for figure in &QUICK.figures {
        let svg = figure.svg();
        let document = Document::parse(&svg).unwrap();
        let (width, height) = view(&document);
        let on_sheet = |x: f64, y: f64| (0.0..=width).contains(&x) && (0.0..=height).contains(&y);
        let mut points = 0;
        // The paths of glyphs have ids and another scale.
        for path in document.descendants().filter(|n| n.attribute("id").is_none()) {
            for (x, y) in path.attribute("d").map(strokes).unwrap_or_default().concat() {
                assert!(on_sheet(x, y), "{}: {x}, {y}", figure.id);
                points += 1;
            }
        }
        assert!(points > 50, "{} has only {points} points", figure.id);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", figure.id);
    }
}

#[test]
fn labels_are_on_the_sheet_and_overlap_with_nothing() {
    for (id, svg) in pictures() {
        let document = Document::parse(&svg).unwrap();
        let (width, height) = view(&document);
        let labels = labels(&document);
        for (i, a) in labels.iter().enumerate() {
            let inside = a.x.0 >= 0.0 && a.x.1 <= width && a.y.0 >= 0.0 && a.y.1 <= height;
            assert!(inside, "{}: {a:?} is cut", id);
            for b in &labels[i + 1..] {
                let apart = a.x.1 <= b.x.0 || b.x.1 <= a.x.0 || a.y.1 <= b.y.0 || b.y.1 <= a.y.0;
                assert!(apart, "{}: {a:?} and {b:?} overlap", id);
            }
        }
        // No curve runs through one.
        let data = document.descendants().filter(|n| n.attribute("class") == Some("data"));
        let lines = data.flat_map(|group| group.descendants());
        let lines = lines.filter(|line| line.attribute("fill") == Some("none"));
        let strokes = lines.filter_map(|line| line.attribute("d")).flat_map(strokes);
        for stretch in
            strokes.flat_map(|stroke| stroke.windows(2).map(<[_]>::to_vec).collect::<Vec<_>>())
        {
            let ((x0, y0), (x1, y1)) = (stretch[0], stretch[1]);
            // Sampled finely enough: a letter is about a hundred units wide.
            for share in (0..=200).map(|i| f64::from(i) / 200.0) {
                let (x, y) = (x0 + share * (x1 - x0), y0 + share * (y1 - y0));
                let through =
                    labels.iter().find(|l| l.x.0 < x && x < l.x.1 && l.y.0 < y && y < l.y.1);
                assert!(through.is_none(), "{}: a curve through {through:?}", id);
            }
        }
        // Axes say what they show and how much of it; the schematic figures name their parts.
        let parts: &[&str] = match id.as_str() {
            "fig01" => &["d", "nd", "(n+1)d", "Δ_1(t)"],
            "fig04" => &["L–1", "1–2", "2–3", "3–R"],
            _ => {
                let ticks =
                    |l: &&Label| l.words.chars().all(|c| c.is_ascii_digit() || "−.^".contains(c));
                let ticks = labels.iter().filter(ticks).count();
                assert!(ticks >= 4 && labels.len() >= ticks + 2, "{}: {labels:?}", id);
                &[]
            }
        };
        for part in parts {
            assert!(labels.iter().any(|l| l.words == *part), "{} lacks {part:?}", id);
        }
    }
}

/// The lightness of a colour `#rrggbb`, from 0 to 1, as the WCAG define it.
fn luminance(colour: &str) -> f64 {
    let part = |at: usize| {
        let part = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
        if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
    };
    0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
}

/// Words are at least nine pixels high on a phone, what carries data has a contrast of three, and
/// no mark stands under a word.
#[test]
fn every_figure_can_be_read() {
    const PHONE: f64 = 360.0;
    // Lines that carry no data.
    const GUIDES: [&str; 1] = ["equilibrium"];
    for (id, svg) in pictures() {
        let document = Document::parse(&svg).unwrap();
        let labels = labels(&document);
        for group in document.descendants().filter(|n| n.attribute("aria-label").is_some()) {
            let scale = group.attribute("transform").unwrap().rsplit_once("scale(").unwrap().1;
            let size = 1000.0 * numbers(scale.trim_end_matches(')'))[0] * PHONE / view(&document).0;
            assert!(size >= 9.0, "{}: {group:?} is {size} pixels high", id);
        }
        let contrast = |class: &str| {
            let rule = svg.split(&format!(".{class}{{")).nth(1).unwrap();
            1.05 / (luminance(&rule[rule.find('#').unwrap()..][..7]) + 0.05)
        };
        let data = document.descendants().filter(|n| n.attribute("class") == Some("data"));
        for group in data.filter(|n| !GUIDES.contains(&n.attribute("data-name").unwrap())) {
            for path in group.descendants().filter(|n| n.attribute("d").is_some()) {
                let classes = path.attribute("class").unwrap();
                let shown = classes.split(' ').find(|class| class.starts_with("stroke"));
                let is_ground =
                    path.attribute("fill-opacity").is_some() || classes.contains("page");
                if !is_ground || shown.is_some_and(|class| class != "stroke-page") {
                    let class = shown.unwrap_or(classes);
                    assert!(contrast(class) >= 3.0, "{}: {group:?}: {class}", id);
                }
                let is_mark = shown.is_some() && path.attribute("fill") != Some("none");
                for mark in strokes(path.attribute("d").unwrap()).iter().filter(|_| is_mark) {
                    let under = |label: &&Label| {
                        let [left, right, top, bottom] = bounds(mark);
                        let across = left < label.x.1 && right > label.x.0;
                        across && top < label.y.1 && bottom > label.y.0
                    };
                    let label = labels.iter().find(under);
                    assert!(label.is_none(), "{}: {group:?} under {label:?}", id);
                }
            }
        }
    }
}

/// The least and largest x and y of points.
fn bounds(points: &[(f64, f64)]) -> [f64; 4] {
    let ends = |places: &mut dyn Iterator<Item = f64>| {
        places.fold((f64::MAX, f64::MIN), |(low, high), at| (low.min(at), high.max(at)))
    };
    let x = ends(&mut points.iter().map(|point| point.0));
    let y = ends(&mut points.iter().map(|point| point.1));
    [x.0, x.1, y.0, y.1]
}

/// The cells of a line of CSV, of which some may be quoted.
fn cells_of(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    for sign in line.chars() {
        match sign {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cells.last_mut().unwrap().push(sign),
        }
    }
    cells
}

#[test]
fn data_files_have_headers_with_units_and_the_rows_of_what_is_drawn() {
    let results = &QUICK.results;
    let curve = results.table("theory.curve").unwrap().curve(&[], "sigma", "p_rest").unwrap();
    let mut rows = BTreeMap::new();
    for figure in &QUICK.figures {
        let schematic = ["fig01", "fig04"].contains(&figure.id.as_str());
        assert_eq!(figure.data.is_empty(), schematic, "{}", figure.id);
        for file in &figure.data {
            assert!(
                file.name.starts_with(&figure.id) && file.name.ends_with(".csv"),
                "{}",
                file.name
            );
            let text = file.csv();
            let mut lines = text.lines().map(cells_of);
            let header = lines.next().unwrap();
            let read: Vec<Vec<String>> = lines.collect();
            assert!(read.iter().all(|row| row.len() == header.len()), "{}", file.name);
            assert_eq!(read.len(), file.rows.len(), "{}", file.name);
            assert_eq!(&header[0], "series (text)", "{}", file.name);
            for (column, head) in header.iter().enumerate() {
                let (name, unit) = head.rsplit_once(" (").unwrap_or_else(|| panic!("{head}"));
                assert!(!name.is_empty() && unit.len() > 1 && head.is_ascii(), "{head}");
                for cell in read.iter().map(|record| &record[column]) {
                    let number = cell.parse::<f64>().is_ok_and(f64::is_finite) || cell.is_empty();
                    assert!(number || unit == "text)", "{}: {cell}", file.name);
                }
            }
            let mut seen = BTreeSet::new();
            for row in &file.rows {
                assert!(
                    !["wall", "equilibrium", "printed"].contains(&row[0].as_str()),
                    "no data: {row:?}"
                );
                // Estimates of one x differ; their errors are in the next column, not again below.
                assert!(seen.insert(&row[..3]), "{}: {row:?} twice", file.name);
            }
            let known = rows.insert(file.name.clone(), read);
            assert!(known.is_none(), "{} twice", file.name);
        }
    }
    for (name, expected) in [
        ("fig05b.csv", 3 * results.of(&SEGMENTS).unwrap().fig05.times.len() + 4),
        ("fig07.csv", VERTICES),
        ("fig08.csv", 4 * VERTICES),
        ("fig09b.csv", 592),
        ("fig14b.csv", 2 * VERTICES),
        ("fig15b.csv", curve.iter().filter(|(sigma, _)| *sigma <= 0.4).count()),
    ] {
        assert_eq!(rows.get(name).map(Vec::len), Some(expected), "{name}");
    }
    // Values are those of the results, in their units, on logarithmic axes too.
    let first = &rows["fig11b.csv"][0];
    assert_eq!(first[2].parse(), Ok(curve[0].1), "{first:?}");
}

/// Thousands of impacts are strokes of one path, not thousands of elements.
#[test]
fn the_long_run_is_drawn_compactly() {
    let run = QUICK.results.of(&SPACE_TIME).unwrap();
    let figure = QUICK.figures.iter().find(|figure| figure.id == "s01").unwrap();
    assert_eq!(figure.data[0].rows.len(), run.times.len() + run.starts().len());
    assert!(figure.svg().len() < 300_000, "{} bytes", figure.svg().len());
}

#[test]
fn a_figure_needs_exactly_what_it_declares() {
    let (paper, store) = (&QUICK.paper, Store::nowhere());
    let session = paper.session(None, Profile::Quick, store, Progress::silent()).unwrap();
    let nothing = paper.results(&[], &session).unwrap();
    for figure in &figures::ALL {
        match figure.figure(&nothing) {
            Ok(_) => assert!(!figure.needs.iter().any(|need| need.is_saved()), "{}", figure.name),
            Err(_) => assert!(!figure.needs.is_empty(), "{} needs something", figure.name),
        }
    }
}
