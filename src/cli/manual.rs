//! `impact-paper manual`.

use super::output::{self, Staging};
use super::places::refuse_report;
use super::{Failure, signals, work};
use clap_complete::{Shell, generate};
use impact_paper::report::Files;
use std::path::PathBuf;

/// Writes the manual page of each verb and completions for shells into a folder.
///
/// The pages are named impact-paper.1, impact-paper-paper.1 and so on; completions go to completions/, one file for
/// bash, zsh, fish, elvish and PowerShell each.
#[derive(clap::Args)]
pub struct Args {
    /// Folder to write into.
    #[arg(long, value_name = "DIR", value_parser = work::folder())]
    out: PathBuf,
    #[command(flatten)]
    force: output::Force,
}

/// Runs the verb.
pub fn run(args: &Args) -> Result<(), Failure> {
    refuse_report("--out", &args.out, None)?;
    let progress = signals::progress();
    let staging = Staging::below(&args.out, "--out", args.force)?;
    let mut files = Files::new();
    let mut command = super::command();
    command.build();
    page(&command, &mut files)?;
    for verb in command.get_subcommands().filter(|verb| verb.get_name() != "help") {
        page(verb, &mut files)?;
    }
    for shell in [Shell::Bash, Shell::Zsh, Shell::Fish, Shell::Elvish, Shell::PowerShell] {
        let mut text = Vec::new();
        generate(shell, &mut command, "impact-paper", &mut text);
        if shell == Shell::Bash {
            text = one_name(&text);
        }
        files.insert(format!("completions/impact-paper.{shell}"), text);
    }
    staging.place(&files, &progress)
}

/// The generator calls a verb of a program with a hyphen one thing where it is found and another where its options are
/// listed, so that bash would complete none of these.
fn one_name(script: &[u8]) -> Vec<u8> {
    String::from_utf8_lossy(script).replace("impact__subcmd__paper", "impact__paper").into()
}

/// The manual page of one verb, or of all.
fn page(command: &clap::Command, files: &mut Files) -> Result<(), Failure> {
    let mut text = Vec::new();
    let page = clap_mangen::Man::new(command.clone());
    page.render(&mut text).map_err(|error| Failure::run(error.to_string()))?;
    files.insert(page.get_filename(), text);
    Ok(())
}
