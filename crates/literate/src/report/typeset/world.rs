//! What the typesetter sees: one source, pictures from memory, and the fonts in the binary.

use std::collections::BTreeMap;
use typst::diag::{FileError, FileResult};
use typst::foundations::{Bytes, Datetime, Duration};
use typst::syntax::{FileId, RootedPath, Source, VirtualPath, VirtualRoot};
use typst::text::{Font, FontBook};
use typst::utils::LazyHash;
use typst::{Library, LibraryExt, World};

/// A world without a file system, a network or a clock: the same bytes everywhere.
pub struct Paper {
    library: LazyHash<Library>,
    book: LazyHash<FontBook>,
    fonts: Vec<Font>,
    main: Source,
    pictures: BTreeMap<String, Bytes>,
}

impl Paper {
    /// Of a source, and pictures by the paths that it names.
    pub fn new(text: String, pictures: BTreeMap<String, Vec<u8>>) -> Option<Paper> {
        let fonts: Vec<Font> =
            typst_assets::fonts().flat_map(|data| Font::iter(Bytes::new(data))).collect();
        let path = VirtualPath::new("report.typ").ok()?;
        let main = FileId::new(RootedPath::new(VirtualRoot::Project, path));
        Some(Paper {
            library: LazyHash::new(Library::default()),
            book: LazyHash::new(FontBook::from_fonts(&fonts)),
            fonts,
            main: Source::new(main, text),
            pictures: pictures.into_iter().map(|(k, v)| (k, Bytes::new(v))).collect(),
        })
    }

    /// The source.
    pub fn source_text(&self) -> &Source {
        &self.main
    }
}

impl World for Paper {
    fn library(&self) -> &LazyHash<Library> {
        &self.library
    }

    fn book(&self) -> &LazyHash<FontBook> {
        &self.book
    }

    fn main(&self) -> FileId {
        self.main.id()
    }

    fn source(&self, id: FileId) -> FileResult<Source> {
        if id == self.main.id() { Ok(self.main.clone()) } else { Err(FileError::NotSource) }
    }

    fn file(&self, id: FileId) -> FileResult<Bytes> {
        let path = id.get().vpath().get_without_slash();
        self.pictures.get(path).cloned().ok_or(FileError::NotFound(path.into()))
    }

    fn font(&self, index: usize) -> Option<Font> {
        self.fonts.get(index).cloned()
    }

    fn today(&self, _: Option<Duration>) -> Option<Datetime> {
        None
    }
}
