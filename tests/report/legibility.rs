//! Checks that every figure can be read: on a phone, on dark pages, and without colours.

use super::picture::{Label, Picture, Shape, bounds, pictures};
use super::*;

/// The style of pages; its second part is for dark ones.
const STYLE: &str = include_str!("../../crates/literate/skin/style/base.css");

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

/// What reaches beyond the sheet.
fn cut(picture: &Picture) -> Vec<String> {
    let (width, height) = picture.size;
    let is_cut = |[left, right, top, bottom]: [f64; 4]| {
        left < 0.0 || right > width || top < 0.0 || bottom > height
    };
    let labels = picture.labels.iter().filter(|l| is_cut(l.bounds));
    let shapes = picture.shapes.iter().filter(|s| is_cut(bounds(&s.strokes.concat())));
    labels.map(|l| l.words.clone()).chain(shapes.map(|s| s.series.clone())).collect()
}

/// Words on words, a mark under words, a curve through them.
fn overlaps(picture: &Picture) -> Vec<String> {
    let mut found = Vec::new();
    for (i, label) in picture.labels.iter().enumerate() {
        let other = picture.labels[i + 1..].iter().find(|other| label.meets(other.bounds));
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
            let is_on = |stroke: &Vec<(f64, f64)>| {
                let is_box = !shape.is_line && label.meets(bounds(stroke));
                is_box || shape.is_line && stroke.windows(2).any(passes)
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
    // In this drawing each fault is found.
    let broken = include_str!("broken.svg");
    let broken = Picture::of("broken", broken, "The darker, the more.".into());
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
