//! Holds a finished figure: the picture, its description and its data.

use super::drawing::{Drawing, Element};
use super::error::{Error, Fault};
use super::svg::escape;
use crate::table::DataFile;

/// A finished figure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// The id in the list of the paper, with which the names of its files begin.
    pub id: String,
    /// The title, which the picture carries and lists show.
    pub title: String,
    /// What readers see, for those who do not see it.
    pub description: Description,
    pub(crate) drawing: Drawing,
    /// Files that are shown instead of the drawing: the ends of their names, and their bytes.
    pub(crate) files: Vec<(&'static str, Vec<u8>)>,
    /// The data that it shows, one file for each panel.
    pub data: Vec<DataFile>,
    /// Path of the item that draws it.
    pub(crate) source: String,
    /// Names of the experiments whose results it shows.
    pub(crate) experiments: Vec<&'static str>,
}

impl Figure {
    /// Makes a figure of the bytes of a picture. A png or jpg serves all formats; an svg needs a
    /// pdf or png for LaTeX besides, and a pdf one of the others for pages.
    pub fn picture(files: &[&[u8]], title: &str, description: Description) -> Result<Self, Error> {
        let mut figure = Figure { title: title.into(), description, ..Figure::default() };
        for bytes in files {
            let is_svg = std::str::from_utf8(bytes).is_ok_and(|text| text.contains("<svg"));
            let format = match bytes {
                [0x89, b'P', b'N', b'G', ..] => "png",
                [0xff, 0xd8, 0xff, ..] => "jpg",
                [b'%', b'P', b'D', b'F', ..] => "pdf",
                _ if is_svg => "svg",
                _ => return Err(Error(Fault::Picture("is not a png, jpg, svg or pdf"))),
            };
            figure.files.push((format, bytes.to_vec()));
        }
        let is_all = |format| figure.files.iter().all(|file| file.0 == format);
        if is_all("pdf") {
            return Err(Error(Fault::Picture("cannot be shown on pages; add an svg, png or jpg")));
        }
        if is_all("svg") {
            return Err(Error(Fault::Picture("cannot be shown in LaTeX; add a pdf, png or jpg")));
        }
        Ok(figure)
    }

    /// Returns the names of the files that pages and LaTeX show.
    pub(crate) fn names(&self) -> [String; 2] {
        [("pdf", "svg"), ("svg", "pdf")].map(|(not, drawn)| {
            let file = self.files.iter().find(|(format, _)| *format != not);
            format!("{}.{}", self.id, file.map_or(drawn, |(format, _)| format))
        })
    }

    /// Returns the files of the picture by name; one that is drawn names its licence.
    pub(crate) fn files(&self, license: &str) -> Vec<(String, Vec<u8>)> {
        if self.files.is_empty() {
            let [svg, pdf] = self.names();
            let license = format!("\n<metadata>{}</metadata>\n<style>", escape(license));
            let drawn = self.svg().replacen("\n<style>", &license, 1);
            return vec![(svg, drawn.into_bytes()), (pdf, self.drawing.pdf(&self.title))];
        }
        let name = |format: &str| format!("{}.{format}", self.id);
        self.files.iter().map(|(format, bytes)| (name(format), bytes.clone())).collect()
    }

    /// Returns its title, its labels and the names of the series that are drawn.
    pub(crate) fn texts(&self) -> impl Iterator<Item = &str> {
        let drawn = self.drawing.elements.iter().filter_map(|element| match element {
            Element::Label(label) => Some(label.words.as_str()),
            Element::Open(name, ..) => Some(name.as_str()),
            Element::Close | Element::Shape(..) => None,
        });
        drawn.chain([self.title.as_str()])
    }

    /// Returns the picture as a file of its own.
    pub fn svg(&self) -> String {
        self.drawing.svg(false, &self.id, &self.title, &self.description.text) + "\n"
    }

    /// Returns the picture as an element of a page.
    pub(crate) fn on_page(&self) -> String {
        if self.files.is_empty() {
            return self.drawing.svg(true, &self.id, &self.title, &self.description.text);
        }
        let [name, _] = self.names();
        format!("<img src=\"figures/{name}\" alt=\"{}\"/>", escape(&self.description.text))
    }
}

/// What readers see in a figure, in words.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Description {
    /// The words.
    pub text: String,
}

/// Describes a figure; the arguments are those of `format!`.
#[macro_export]
macro_rules! describe {
    ($words:literal $(, $value:expr)* $(,)?) => {
        $crate::figures::Description { text: format!($words $(, $value)*) }
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_has_a_file_for_pages_and_one_for_print() {
        let names = |files: &[&[u8]]| {
            let figure = Figure::picture(files, "A", Description::default())?;
            Ok::<_, Error>(Figure { id: "a".into(), ..figure }.names())
        };
        let (png, jpg, svg, pdf) = (b"\x89PNG...", b"\xff\xd8\xff...", b"<svg/>", b"%PDF-1.5");
        assert_eq!(names(&[png]).unwrap(), ["a.png", "a.png"]);
        assert_eq!(names(&[jpg]).unwrap(), ["a.jpg", "a.jpg"]);
        assert_eq!(names(&[svg, pdf]).unwrap(), ["a.svg", "a.pdf"]);
        assert_eq!(names(&[pdf, png]).unwrap(), ["a.png", "a.pdf"]);
        let fails = |files: &[&[u8]], why| names(files).unwrap_err().to_string().contains(why);
        assert!(fails(&[svg], "cannot be shown in LaTeX"));
        assert!(fails(&[pdf], "cannot be shown on pages"));
        assert!(fails(&[b"GIF89a"], "is not a png"));
    }
}
