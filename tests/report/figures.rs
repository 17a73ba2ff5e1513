//! Checks that every figure is well-formed, described and labelled, and has its data.

use super::picture::{Label, Picture, pictures};
use super::*;
use impact_paper::experiments::SEGMENTS;
use impact_paper::figures;
use impact_paper::params::{Profile, VERTICES};
use roxmltree::Document;

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
        let description = &figure.description.text;
        assert!(description.chars().count() > 150, "{}", figure.id);
        let words = description.split_whitespace().count();
        assert!(words <= 60, "{}: {words} words", figure.id);
        assert!(description.chars().any(|c| c.is_ascii_digit()), "{}", figure.id);
        assert!(!description.contains("NaN") && !description.contains("  "), "{}", figure.id);
        // Nothing that depends on the reader's fonts, and every glyph that is used is there.
        assert!(["<text", "font-family", "NaN", "inf"].iter().all(|word| !svg.contains(word)));
        let ids: BTreeSet<_> = document.descendants().filter_map(|n| n.attribute("id")).collect();
        for used in document.descendants().filter_map(|n| n.attribute("href")) {
            assert!(ids.contains(used.trim_start_matches('#')), "{}: {used}", figure.id);
        }
    }
}

/// Axes say what they show and how much of it; the schematic figures name their parts.
#[test]
fn axes_have_numbers_and_names() {
    for Picture { id, labels, .. } in pictures() {
        let parts: &[&str] = match id.as_str() {
            "fig01" => &["d", "nd", "(n+1)d", "Δ_1(t)"],
            "fig04" => &["L–1", "1–2", "2–3", "3–R"],
            "s08" => &["engine", "heyoka", "missed"],
            _ => {
                let ticks =
                    |l: &&Label| l.words.chars().all(|c| c.is_ascii_digit() || "−.^".contains(c));
                let ticks = labels.iter().filter(ticks).count();
                assert!(ticks >= 4 && labels.len() >= ticks + 2, "{id}: {labels:?}");
                &[]
            }
        };
        for part in parts {
            assert!(labels.iter().any(|l| l.words == *part), "{id} lacks {part:?}");
        }
    }
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
            let name = &file.name;
            assert!(name.starts_with(&figure.id) && name.ends_with(".csv"), "{name}");
            assert!(file.rows.iter().all(|row| row.len() == file.header.len()), "{name}");
            assert_eq!(&file.header[0], "series (text)", "{name}");
            for (column, head) in file.header.iter().enumerate() {
                let (name, unit) = head.rsplit_once(" (").unwrap_or_else(|| panic!("{head}"));
                assert!(!name.is_empty() && unit.len() > 1 && head.is_ascii(), "{head}");
                for cell in file.rows.iter().map(|row| &row[column]) {
                    let number = cell.parse::<f64>().is_ok_and(f64::is_finite) || cell.is_empty();
                    assert!(number || unit == "text)", "{}: {cell}", file.name);
                }
            }
            let mut seen = BTreeSet::new();
            for row in &file.rows {
                let is_data = !["wall", "equilibrium", "printed"].contains(&row[0].as_str());
                assert!(is_data, "no data: {row:?}");
                // Estimates of one x differ; their errors are in the next column, not again below.
                assert!(seen.insert(&row[..3]), "{}: {row:?} twice", file.name);
            }
            assert!(rows.insert(&file.name, &file.rows).is_none(), "{} twice", file.name);
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
        assert_eq!(rows[&name.to_string()].len(), expected, "{name}");
    }
    // Values are those of the results, in their units, on logarithmic axes too.
    let first = &rows[&"fig11b.csv".to_string()][0];
    assert_eq!(first[2].parse(), Ok(curve[0].1), "{first:?}");
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
