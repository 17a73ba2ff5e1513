//! Where `paper` and `check` read prose and keep results.

use super::places::{PROSE as FILES, refuse_report};
use super::{Failure, signals, threads, work};
use crate::claims::{self, Published};
use crate::committed;
use crate::experiments::{self, Need, Progress, Results, Store};
use crate::params::Profile;
use crate::report::{self, PROGRAM, Templates};
use std::path::{Path, PathBuf};

/// The prose: where it is, its folder is.
const PROSE: &str = "templates/front.md";

/// Options common to `paper` and `check`.
#[derive(clap::Args)]
pub struct Sources {
    /// Number of threads; all cores without it. It changes no bit of the result.
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = threads::read)]
    pub threads: Option<usize>,
    /// Folder of the prose [default: templates of the checkout, or the copy inside the program].
    #[arg(long, value_name = "DIR")]
    pub templates: Option<PathBuf>,
    /// Folder in which results of long runs are kept.
    #[arg(long, value_name = "DIR", default_value = "target/results", value_parser = work::folder())]
    pub results: PathBuf,
}

impl Sources {
    /// From options of another verb.
    pub fn of(threads: Option<usize>, templates: Option<PathBuf>, results: PathBuf) -> Self {
        Sources { threads, templates, results }
    }

    /// Refuses a folder of prose that has nothing of it.
    ///
    /// # Errors
    /// Exit code 2 with the option.
    pub fn refuse_strange(&self) -> Result<(), Failure> {
        let strange = |folder: &&PathBuf| {
            let no = |file: &str| folder.join(file).symlink_metadata().is_err();
            let first = PROGRAM.documents.first().map(|of| format!("{}.md", of.prose));
            folder.is_dir() && first.is_none_or(|first| no(&first)) && FILES.into_iter().all(no)
        };
        let Some(folder) = self.templates.as_ref().filter(strange) else { return Ok(()) };
        let (folder, files) = (folder.display(), FILES.join(", "));
        let what = format!("has none of {files}; give the folder that has all of the prose");
        Err(Failure::input(format!("--templates: {folder} {what}")))
    }

    /// The templates.
    pub fn templates(&self) -> Result<Templates, Failure> {
        let templates = find(self.templates.as_deref())?;
        self.refuse_strange()?;
        Ok(templates)
    }

    /// What the paper printed.
    pub fn published(&self, templates: &Templates) -> Result<Published, Failure> {
        let text = templates.text("published.toml")?;
        Ok(Published::parse(text).map_err(claims::Error::from)?)
    }

    /// Runs what is needed. The folder of results is made only if something long is run.
    pub fn run(
        &self,
        needs: &[Need],
        profile: Profile,
        templates: &Templates,
        progress: &Progress,
    ) -> Result<Results, Failure> {
        let long = needs.iter().any(|need| need.is_saved());
        let folder = &self.results;
        if long {
            refuse_report("--results", folder, self.templates.as_deref())?;
        }
        let _made = long.then(|| signals::made(folder));
        let store = if long { Store::open(folder)? } else { Store::nowhere() };
        store.tidy();
        let scenario = |file: &str| {
            let text = templates.text(file).map(String::from);
            text.map_err(|_| "this file is missing from the templates".to_string())
        };
        Ok(experiments::run(needs, profile, &scenario, &store, progress)?)
    }
}

/// The folder of the committed prose; none if only the copy inside has it.
pub fn prose() -> Option<PathBuf> {
    committed::find(PROSE)?.parent().map(PathBuf::from)
}

/// The given folder, or else the committed one.
fn find(folder: Option<&Path>) -> Result<Templates, report::Error> {
    if let Some(folder) = folder {
        return Templates::read(folder);
    }
    if let Some(folder) = prose() {
        return Templates::read(&folder);
    }
    // Its error says what to do where there is no copy inside either.
    let fail = |source| report::Error::Read { path: PROSE.into(), source };
    committed::text(PROSE).map_err(fail)?;
    Ok(Templates::of(committed::embedded("templates")))
}
