//! Every figure: well-formed, inside its frame, labelled, described, with its data, and the same
//! bytes each time.

use super::QUICK;
use impact_paper::experiments::{Progress, SEGMENTS, Store};
use impact_paper::figures;
use impact_paper::params::{Profile, VERTICES};
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

/// A label: its words, its colour, its box on the sheet, and the size of its smallest letters.
#[derive(Debug)]
struct Label {
    words: String,
    colour: String,
    x: (f64, f64),
    y: (f64, f64),
    size: f64,
}

impl Label {
    /// Reads a label with the box of its letters, from the base line to the height of a capital.
    fn of(group: &Node) -> Label {
        let inner = |transform: Option<&str>, name: &str| {
            let rest = transform?.split(&format!("{name}(")).nth(1)?;
            Some(numbers(rest.split(')').next().unwrap()))
        };
        let transform = group.attribute("transform");
        let at = inner(transform, "translate").unwrap();
        let scale = inner(transform, "scale").unwrap()[0];
        let (mut extent, mut base, mut least) = ((f64::MAX, f64::MIN), 0.0, 1.0_f64);
        for glyph in group.children().filter(|n| n.tag_name().name() == "use") {
            let x = match inner(glyph.attribute("transform"), "translate") {
                Some(place) => place[0],
                None => {
                    base = glyph.attribute("y").unwrap().parse().unwrap();
                    glyph.attribute("x").unwrap().parse().unwrap()
                }
            };
            let size = inner(glyph.attribute("transform"), "scale").map_or(1.0, |scale| scale[0]);
            least = least.min(size);
            extent = (extent.0.min(x), extent.1.max(x + 470.0 * size));
        }
        let along = (extent.0 * scale, extent.1 * scale);
        let across = (base * scale, (base + 640.0) * scale);
        let (x, y) = if inner(transform, "rotate").is_some() {
            ((at[0] - across.1, at[0] - across.0), (at[1] - along.1, at[1] - along.0))
        } else {
            ((at[0] + along.0, at[0] + along.1), (at[1] - across.1, at[1] - across.0))
        };
        let words = group.attribute("aria-label").unwrap().to_string();
        let colour = group.attribute("class").unwrap().replace("fill-", "");
        Label { words, colour, x, y, size: 1000.0 * scale * least }
    }

    fn meets(&self, [left, right, top, bottom]: [f64; 4]) -> bool {
        left < self.x.1 && right > self.x.0 && top < self.y.1 && bottom > self.y.0
    }
}

/// A path of a series of data: the frame of its panel, the colour that shows it, its strokes, and
/// what else tells it from others: the kind of line or mark, and its dash.
#[derive(Debug)]
struct Shape {
    series: String,
    frame: String,
    colour: String,
    strokes: Vec<Vec<(f64, f64)>>,
    is_line: bool,
    look: String,
}

/// A figure as it is measured.
struct Picture {
    id: String,
    size: (f64, f64),
    labels: Vec<Label>,
    shapes: Vec<Shape>,
    /// Its description, and its caption where the prose has one.
    words: String,
}

impl Picture {
    fn of(id: &str, svg: &str, words: String) -> Picture {
        let document = Document::parse(svg).unwrap();
        let size = numbers(document.root_element().attribute("viewBox").unwrap());
        let (mut labels, mut shapes) = (Vec::new(), Vec::new());
        for group in document.descendants().filter(|n| n.tag_name().name() == "g") {
            if group.attribute("aria-label").is_some() {
                labels.push(Label::of(&group));
            }
            let Some(series) = group.attribute("data-name") else { continue };
            let frame = group.attribute("data-frame").unwrap();
            for path in group.descendants().filter(|n| n.attribute("d").is_some()) {
                let classes: Vec<_> = path.attribute("class").unwrap().split(' ').collect();
                let named = |paint| classes.iter().find_map(|class| class.strip_prefix(paint));
                let (fill, edge) = (named("fill-"), named("stroke-"));
                // A ground is no mark, if its edge does not show.
                let is_ground = path.attribute("fill-opacity").is_some() || fill == Some("page");
                if (is_ground && edge.is_none()) || edge == Some("page") {
                    continue;
                }
                let d = path.attribute("d").unwrap();
                let strokes = strokes(d);
                let letters: BTreeSet<char> = d.chars().filter(char::is_ascii_alphabetic).collect();
                let kind = match (strokes.len(), fill) {
                    (1, None) => "line".into(),
                    (_, Some(fill)) => format!("{letters:?}, {}", fill == "page"),
                    _ => format!("{letters:?}"),
                };
                let [width, dash] =
                    ["stroke-width", "stroke-dasharray"].map(|name| path.attribute(name));
                let look = format!("{kind}, {width:?}, {dash:?}");
                shapes.push(Shape {
                    series: series.into(),
                    frame: frame.into(),
                    colour: edge.or(fill).unwrap().into(),
                    strokes,
                    is_line: fill.is_none(),
                    look,
                });
            }
        }
        Picture { id: id.into(), size: (size[2], size[3]), labels, shapes, words }
    }
}

/// All pictures: of the quick profile, and those that are committed.
fn pictures() -> Vec<Picture> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("paper");
    let documents = QUICK.report.iter().filter(|(name, _)| name.ends_with(".md"));
    let prose: String = documents.map(|(_, text)| String::from_utf8_lossy(text)).collect();
    let both = QUICK.figures.iter().flat_map(|figure| {
        let name = format!("figures/{}.svg", figure.id);
        let before = prose.split_once(&format!("]({name})")).map(|parts| parts.0);
        let caption = before.and_then(|text| text.rsplit_once("![")).map_or("", |parts| parts.1);
        let words = format!("{} {caption}", figure.description.text);
        let committed = std::fs::read_to_string(folder.join(name)).unwrap();
        [figure.svg(), committed].map(|svg| Picture::of(&figure.id, &svg, words.clone()))
    });
    both.collect()
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

/// The style of pages; its second part is for dark ones.
const STYLE: &str = include_str!("../../crates/literate/skin/report.css");

/// A colour on light and on dark pages, as parts of red, green and blue light.
fn light_and_dark(name: &str) -> [[f64; 3]; 2] {
    let (light, dark) = STYLE.split_once("prefers-color-scheme: dark").unwrap();
    [light, dark].map(|style| {
        let hex = style.split_once(&format!("--{name}: #")).unwrap().1;
        [0, 2, 4].map(|at| {
            let part = f64::from(u8::from_str_radix(&hex[at..at + 2], 16).unwrap()) / 255.0;
            if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
        })
    })
}

fn times(matrix: [[f64; 3]; 3], of: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row.iter().zip(of).map(|(a, b)| a * b).sum())
}

/// The contrast of two colours, from 1 to 21, as the WCAG define it.
fn contrast(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [a, b] = [a, b].map(|of| times([[0.2126, 0.7152, 0.0722]; 3], of)[0] + 0.05);
    (a / b).max(b / a)
}

/// The distance of two colours in CIELAB for a reader without green cones (Machado, Oliveira and
/// Fernandes, 2009).
fn distance_without_green(a: [f64; 3], b: [f64; 3]) -> f64 {
    const BLIND: [[f64; 3]; 3] = [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ];
    const XYZ: [[f64; 3]; 3] =
        [[0.4339, 0.3762, 0.1899], [0.2126, 0.7152, 0.0722], [0.0178, 0.1095, 0.8727]];
    let [a, b] = [a, b].map(|of| {
        let [x, y, z] =
            times(XYZ, times(BLIND, of).map(|part| part.clamp(0.0, 1.0))).map(f64::cbrt);
        [116.0 * y, 500.0 * (x - y), 200.0 * (y - z)]
    });
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// What is measured in each figure.
type Check = fn(&Picture) -> Vec<String>;
const CHECKS: [(&str, Check); 6] = [
    ("beyond the sheet", cut),
    ("on words", overlaps),
    ("less than nine pixels high on a phone", small),
    ("too faint", faint),
    ("told apart by colours only", alike),
    ("a colour of one page only", misnamed),
];

/// A drawing in which each of them is found.
const BROKEN: &str = r#"<svg viewBox="0 0 8400 4000"><g class="fill-ink" aria-label="words"
    transform="translate(8350 500) scale(.25 -.25)"><use transform="translate(0 0) scale(.7)"/></g>
    <g data-name="a" data-frame=""><path class="stroke-red" fill="none" d="M7900 450h480"/></g>
    <g data-name="b" data-frame=""><path class="stroke-green" fill="none" d="M900 500h800"/></g>
    <g data-name="c" data-frame=""><path class="stroke-pale" fill="none" d="M900 600h800"/></g></svg>"#;

/// What reaches beyond the sheet.
fn cut(picture: &Picture) -> Vec<String> {
    let (width, height) = picture.size;
    let is_cut = |[left, right, top, bottom]: [f64; 4]| {
        left < 0.0 || right > width || top < 0.0 || bottom > height
    };
    let labels = picture.labels.iter().filter(|l| is_cut([l.x.0, l.x.1, l.y.0, l.y.1]));
    let shapes = picture.shapes.iter().filter(|s| is_cut(bounds(&s.strokes.concat())));
    labels.map(|l| l.words.clone()).chain(shapes.map(|s| s.series.clone())).collect()
}

/// Words on words, a mark under words, a curve through them.
fn overlaps(picture: &Picture) -> Vec<String> {
    let mut found = Vec::new();
    for (i, label) in picture.labels.iter().enumerate() {
        let mut others = picture.labels[i + 1..].iter();
        let other = others.find(|b| label.meets([b.x.0, b.x.1, b.y.0, b.y.1]));
        found.extend(other.map(|other| format!("{label:?} on {other:?}")));
        let meets = |shape: &&Shape| {
            let passes = |pair: &[(f64, f64)]| {
                // Sampled finely enough: a letter is about a hundred units wide.
                label.meets(bounds(pair))
                    && (0..=200).map(|i| f64::from(i) / 200.0).any(|share| {
                        let x = pair[0].0 + share * (pair[1].0 - pair[0].0);
                        let y = pair[0].1 + share * (pair[1].1 - pair[0].1);
                        label.meets([x, x, y, y])
                    })
            };
            let is_on = |stroke: &Vec<(f64, f64)>| match shape.is_line {
                true => stroke.windows(2).any(passes),
                false => label.meets(bounds(stroke)),
            };
            shape.strokes.iter().any(is_on)
        };
        let shape = picture.shapes.iter().find(meets);
        found.extend(shape.map(|shape| format!("{label:?} on {}", shape.series)));
    }
    found
}

fn small(picture: &Picture) -> Vec<String> {
    let pixels = |label: &Label| label.size * 360.0 / picture.size.0;
    let small = picture.labels.iter().filter(|label| pixels(label) < 9.0);
    small.map(|label| format!("{:?}: {} pixels", label.words, pixels(label))).collect()
}

/// What carries data or says something and has a contrast of less than three.
fn faint(picture: &Picture) -> Vec<String> {
    const GUIDES: [&str; 1] = ["equilibrium"];
    let data = picture.shapes.iter().filter(|shape| !GUIDES.contains(&shape.series.as_str()));
    let colours = data.map(|shape| &shape.colour);
    let colours: BTreeSet<_> = colours.chain(picture.labels.iter().map(|l| &l.colour)).collect();
    let least = |colour: &str| {
        let [light, dark] = light_and_dark(colour);
        let [white, black] = light_and_dark("page");
        contrast(light, white).min(contrast(dark, black))
    };
    colours.into_iter().filter(|colour| least(colour) < 3.0).cloned().collect()
}

/// Series of one panel that differ by their colours only, which some readers do not see.
fn alike(picture: &Picture) -> Vec<String> {
    let mut series: BTreeMap<_, (BTreeSet<&str>, &str)> = BTreeMap::new();
    for Shape { series: name, frame, colour, look, .. } in &picture.shapes {
        series.entry((frame, name)).or_insert((BTreeSet::new(), colour)).0.insert(look);
    }
    let mut found = Vec::new();
    for ((frame, name), (look, colour)) in &series {
        for ((of, other), (its_look, its_colour)) in series.range((*frame, *name)..).skip(1) {
            let [[a, b], [c, d]] = [colour, its_colour].map(|colour| light_and_dark(colour));
            let alike = |a, b| contrast(a, b) < 1.25 || distance_without_green(a, b) < 10.0;
            let is_alike = of == frame && look == its_look && colour != its_colour;
            if is_alike && (alike(a, c) || alike(b, d)) {
                found.push(format!("{name} and {other}"));
            }
        }
    }
    found
}

/// Words for colours that are others on a dark page.
fn misnamed(picture: &Picture) -> Vec<String> {
    const OTHERS: [&str; 9] =
        ["black", "white", "dark", "darker", "light", "lighter", "pale", "brown", "yellow"];
    let words = picture.words.split(|c: char| !c.is_alphabetic());
    words.filter(|word| OTHERS.contains(word)).map(str::to_string).collect()
}

#[test]
fn every_figure_can_be_read() {
    let (pictures, mut found) = (pictures(), Vec::new());
    let broken = Picture::of("broken", BROKEN, "The darker, the more.".into());
    for (what, check) in CHECKS {
        assert!(!check(&broken).is_empty(), "nothing is found {what}");
        for picture in &pictures {
            found.extend(check(picture).iter().map(|of| format!("{}: {what}: {of}", picture.id)));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    // A file has the colours of the page, and hues that are named stay: the same part is largest.
    for named in QUICK.figures[0].svg().split("{fill:#").collect::<Vec<_>>().windows(2) {
        let name = named[0].rsplit_once(".fill-").unwrap().1;
        assert!(STYLE.contains(&format!("--{name}: #{}", &named[1][..6])), "{name}");
    }
    for name in ["red", "green", "blue", "orange"] {
        let largest =
            light_and_dark(name).map(|parts| (0..3).max_by(|a, b| parts[*a].total_cmp(&parts[*b])));
        assert_eq!(largest[0], largest[1], "{name}");
    }
}

/// The least and largest x and y of points.
fn bounds(points: &[(f64, f64)]) -> [f64; 4] {
    let none = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
    points.iter().fold(none, |[left, right, top, bottom], &(x, y)| {
        [left.min(x), right.max(x), top.min(y), bottom.max(y)]
    })
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
            assert!(file.rows.iter().all(|row| row.len() == file.header.len()), "{}", file.name);
            assert_eq!(&file.header[0], "series (text)", "{}", file.name);
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
                assert!(
                    !["wall", "equilibrium", "printed"].contains(&row[0].as_str()),
                    "no data: {row:?}"
                );
                // Estimates of one x differ; their errors are in the next column, not again below.
                assert!(seen.insert(&row[..3]), "{}: {row:?} twice", file.name);
            }
            let known = rows.insert(&file.name, &file.rows);
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
