//! Where `paper` and `check` read prose and keep results.

use super::{Failure, threads};
use crate::claims::{self, Published};
use crate::committed;
use crate::experiments::{self, Need, Progress, Results, Store};
use crate::params::Profile;
use crate::report::{self, Templates};
use std::path::{Path, PathBuf};

/// The prose: where it is, its folder is.
const PROSE: &str = "templates/front.md";

/// Options common to verbs that make a report or judge it.
#[derive(clap::Args)]
pub struct Sources {
    /// Number of threads; all cores without it. It changes no bit of the result.
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = threads::read)]
    pub threads: Option<usize>,
    /// Folder of the prose [default: templates of the checkout, or the copy inside the program].
    #[arg(long, value_name = "DIR")]
    pub templates: Option<PathBuf>,
    /// Folder in which results of long runs are kept.
    #[arg(long, value_name = "DIR", default_value = "target/results")]
    pub results: PathBuf,
}

impl Sources {
    /// The templates: of the given folder, of the checkout, or the copy inside.
    pub fn templates(&self) -> Result<Templates, Failure> {
        let checkout = || committed::find(PROSE)?.parent().map(Path::to_path_buf);
        if let Some(folder) = self.templates.clone().or_else(checkout) {
            return Ok(Templates::read(&folder)?);
        }
        // Its error says what to do where there is no copy inside either.
        let fail = |source| report::Error::Read { path: PROSE.into(), source };
        committed::text(PROSE).map_err(fail)?;
        Ok(Templates::of(committed::embedded("templates")))
    }

    /// What the paper printed.
    pub fn published(&self, templates: &Templates) -> Result<Published, Failure> {
        let text = templates.text("published.toml")?;
        Ok(Published::parse(text).map_err(claims::Error::from)?)
    }

    /// Runs what is needed, and takes from the folder of results what is there.
    pub fn run(
        &self,
        needs: &[Need],
        profile: Profile,
        templates: &Templates,
        progress: &Progress,
    ) -> Result<Results, Failure> {
        run(needs, profile, templates, &Store::open(&self.results)?, progress)
    }
}

/// Runs what is needed, and takes from the store what is there.
pub fn run(
    needs: &[Need],
    profile: Profile,
    templates: &Templates,
    store: &Store,
    progress: &Progress,
) -> Result<Results, Failure> {
    let scenario = |file: &str| {
        let text = templates.text(file).map(String::from);
        text.map_err(|_| "this file is missing from the templates".to_string())
    };
    Ok(experiments::run(needs, profile, &scenario, store, progress)?)
}
