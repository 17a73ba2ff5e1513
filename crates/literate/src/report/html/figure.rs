//! A figure: the picture inside the page, its caption, and where it comes from.

use super::{Page, escape};
use crate::report::Error;
use crate::report::document::Block;
use crate::source::Program;

impl Page<'_> {
    pub(super) fn figure(&self, block: &Block) -> Result<String, Error> {
        let Block::Figure { id, number, path, data, code, experiments, caption, .. } = block else {
            return Ok(String::new());
        };
        let own = |figure: &&crate::figures::Figure| *path == format!("figures/{}.svg", figure.id);
        let figure = self.figures.iter().find(own);
        let figure = figure.ok_or_else(|| Error::Reference(path.clone()))?;
        self.glyphs.borrow_mut().extend(figure.drawing.glyphs.clone());
        let svg = figure.drawing.on_page(&figure.id, &figure.title, &figure.description);
        Ok(format!(
            "<figure id=\"{}\"><div class=\"scroll\" tabindex=\"0\" role=\"group\" \
             aria-label=\"Figure {number}\">{svg}</div><figcaption><strong>Figure {number}.</strong> {} \
             <span class=\"origin\">{}</span></figcaption></figure>\n",
            escape::id(id),
            self.inlines(caption)?,
            origin(path, data, code.as_ref(), experiments, self.program)
        ))
    }
}

/// Links to the picture as a file, its data, its drawing code and the experiments.
fn origin(
    path: &str,
    data: &[String],
    code: Option<&String>,
    experiments: &[&str],
    program: Program,
) -> String {
    let link = |to: &str, shown: &str| {
        format!("<a href=\"{}\">{}</a>", escape::text(to), escape::text(shown))
    };
    let name = |path: &str| path.rsplit('/').next().unwrap_or(path).to_string();
    let mut out = format!("Picture: {}.", link(path, &name(path)));
    if !data.is_empty() {
        let data: Vec<String> = data.iter().map(|path| link(path, &name(path))).collect();
        out.push_str(&format!(" Data: {}.", data.join(", ")));
    }
    if let Some(code) = code {
        out.push_str(&format!(" Code: {}.", link(code, &name(code))));
    }
    if !experiments.is_empty() {
        let one = |name: &&str| {
            let shown = name.replace('_', " ");
            let item = (program.recipe)(name, "").map(|recipe| recipe.item);
            match item.and_then(|item| program.file(&item)) {
                Some(file) => link(&format!("../{file}"), &shown),
                None => escape::text(&shown),
            }
        };
        let names: Vec<String> = experiments.iter().map(one).collect();
        out.push_str(&format!(" Experiment: {}.", names.join(", ")));
    }
    out
}
