//! Reads a figure as it is seen: its words with their boxes, and the shapes of its data.

use super::*;
use roxmltree::{Document, Node};

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
    let letters = Vec::from_iter(d.match_indices(|c: char| c.is_ascii_alphabetic()).map(|m| m.0));
    for (from, to) in letters.iter().zip(letters.iter().skip(1).copied().chain([d.len()])) {
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

/// A label: its words, its colour, its box on the sheet (left, right, top, bottom), and the size of
/// its smallest letters.
#[derive(Debug)]
pub struct Label {
    pub words: String,
    pub colour: String,
    pub bounds: [f64; 4],
    pub size: f64,
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
        let bounds = if inner(transform, "rotate").is_some() {
            [at[0] - across.1, at[0] - across.0, at[1] - along.1, at[1] - along.0]
        } else {
            [at[0] + along.0, at[0] + along.1, at[1] - across.1, at[1] - across.0]
        };
        let words = group.attribute("aria-label").unwrap().to_string();
        let colour = group.attribute("class").unwrap().replace("fill-", "");
        Label { words, colour, bounds, size: 1000.0 * scale * least }
    }

    pub fn meets(&self, [left, right, top, bottom]: [f64; 4]) -> bool {
        let [least_x, largest_x, least_y, largest_y] = self.bounds;
        left < largest_x && right > least_x && top < largest_y && bottom > least_y
    }
}

/// A path of a series of data: the frame of its panel, the colour that shows it, its strokes, and
/// what else tells it from others: the kind of line or mark, and its dash.
#[derive(Debug)]
pub struct Shape {
    pub series: String,
    pub frame: String,
    pub colour: String,
    pub strokes: Vec<Vec<(f64, f64)>>,
    pub is_line: bool,
    pub look: String,
}

/// A figure as it is measured.
pub struct Picture {
    pub id: String,
    pub size: (f64, f64),
    pub labels: Vec<Label>,
    pub shapes: Vec<Shape>,
    /// Its description, and its caption where the prose has one.
    pub words: String,
}

impl Picture {
    pub fn of(id: &str, svg: &str, words: String) -> Picture {
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
pub fn pictures() -> Vec<Picture> {
    let documents = QUICK.paper.edition.documents.iter();
    let prose: String = documents.map(|document| QUICK.file_text(document.markdown)).collect();
    let both = QUICK.figures.iter().flat_map(|figure| {
        let name = format!("figures/{}.svg", figure.id);
        let before = prose.split_once(&format!("]({name})")).map(|parts| parts.0);
        let caption = before.and_then(|text| text.rsplit_once("![")).map_or("", |parts| parts.1);
        let words = format!("{} {caption}", figure.description.text);
        let committed = std::fs::read_to_string(Path::new("paper").join(name)).unwrap();
        [figure.svg(), committed].map(|svg| Picture::of(&figure.id, &svg, words.clone()))
    });
    both.collect()
}

/// The least and largest x and y of points.
pub fn bounds(points: &[(f64, f64)]) -> [f64; 4] {
    let none = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
    points.iter().fold(none, |[left, right, top, bottom], &(x, y)| {
        [left.min(x), right.max(x), top.min(y), bottom.max(y)]
    })
}
