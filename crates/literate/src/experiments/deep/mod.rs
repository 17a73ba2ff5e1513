//! Experiments that take too long for every report.
//!
//! They are run now and then as the profile `deep`, and what each unit of work gave is committed. The
//! report joins the units to a result, by the program as it is, and carries them over changes of the
//! source as long as an audit allows: some units, drawn by lot, are run again, and what they give is
//! compared, byte by byte, with what was committed.

pub mod audit;

pub use audit::{Audit, Carriage, Distance};

use super::cutting::{Cutting, Join, Unit};
use super::experiment::How::Cut;
use super::experiment::{Entry, Experiment, Found, Given, Json, Params, Saved, Typed};
use super::identity::{Identity, Reason, told};
use super::store::{self, Store};
use super::{Code, Error, Profile, Progress};
use crate::digest::sha256;
use crate::table::Table;
use std::borrow::Cow;
use std::io;
use std::sync::Arc;

/// What to do about a result that is stale.
pub const REMEDY: &str = "run `make deep`";

/// An experiment of which the units of work are committed.
pub struct Deep<P: 'static, T: 'static, U: 'static> {
    /// Its name, as values and saved files carry it.
    pub name: &'static str,
    /// What it runs, in words, with a reference to where that is told.
    pub title: &'static str,
    /// Its code.
    pub code: Code,
    /// Its parameters in a profile.
    pub parameters: fn(Profile) -> P,
    /// What people who wait are told, and how it is cut.
    pub cut: (&'static str, Cutting<P, U, T>),
    /// What was committed, where it is not in the file of that name.
    pub text: Option<&'static str>,
    /// This profile and the larger ones carry them over; smaller ones run the experiment at
    /// a size of their own.
    pub from: Profile,
    /// How far what units give is from the result, where an error of it is known.
    pub distance: Option<Away<T, U>>,
    /// What follows from its result.
    pub tables: fn(&T) -> Vec<Table>,
}

/// Measures how far what units give is from a result.
pub type Away<T, U> = fn(&T, &[(&Unit, U)]) -> Distance;

impl<P, T, U> Deep<P, T, U> {
    /// What takes too long for the full profile.
    pub const fn new(
        (name, title): (&'static str, &'static str),
        code: Code,
        parameters: fn(Profile) -> P,
        cut: (&'static str, Cutting<P, U, T>),
        tables: fn(&T) -> Vec<Table>,
    ) -> Self {
        let (text, from, distance) = (None, Profile::Full, None);
        Deep { name, title, code, parameters, cut, text, from, distance, tables }
    }

    /// The file of the committed units.
    fn file(&self) -> String {
        format!("benches/deep/{}-deep.json", self.name)
    }

    /// The committed units, as they were saved.
    fn committed(&self) -> io::Result<Cow<'static, str>> {
        self.text.map_or_else(
            || (self.code.built.committed)(&self.file()),
            |text| Ok(Cow::Borrowed(text)),
        )
    }

    /// SHA-256 of them; that of nothing if there are none.
    fn digest(&self) -> String {
        sha256(self.committed().unwrap_or_default().as_ref())
    }

    /// The experiment with another way to make a result of what its units give.
    fn experiment<R>(&self, join: Join<P, U, R>) -> Experiment<P, R, U> {
        let Deep { name, code, parameters, .. } = *self;
        let (words, Cutting { rows, part, fits, .. }) = self.cut;
        let how = Cut(words, Cutting { rows, part, fits, join });
        Experiment { name, code, parameters, how, tables: |_| Vec::new() }
    }

    /// The experiment as the deep profile runs it: its result is what each unit gave.
    fn whole(&self) -> Experiment<P, Vec<U>, U> {
        self.experiment(|_, given, _| Ok(given.into_iter().flatten().collect()))
    }
}

impl<P: Params, T: Json, U: Json> Deep<P, T, U> {
    /// The result, with the audit of one that is carried over.
    pub fn get(
        &self,
        profile: Profile,
        store: &Store,
        progress: &Progress,
    ) -> Result<(T, Option<Audit>), Error> {
        if profile < self.from {
            return Ok((self.experiment(self.cut.1.join).get(profile, store, progress)?, None));
        }
        let audit = audit::of(self, profile).get(store, progress)?;
        let result = self.joined(self.given()?, progress)?;
        Ok((result, Some(audit)))
    }

    /// What the whole depends on.
    fn made_of(&self) -> Identity {
        self.whole().run_of(Profile::Deep).identity
    }

    /// What each unit gave that is committed.
    fn given(&self) -> Result<Vec<U>, Error> {
        let unread = |what: String| Error::input(self.file(), what, REMEDY);
        let committed = self.committed().map_err(|error| unread(error.to_string()))?;
        let (made_of, body) =
            store::parsed(&committed).map_err(|reasons| unread(told(&reasons)))?;
        let reasons = self.made_of().reasons(&made_of);
        if !reasons.iter().all(Reason::is_of_source) {
            return Err(unread(told(&reasons)));
        }
        let given: Vec<U> = serde_json::from_str(body).map_err(|e| unread(e.to_string()))?;
        match given.len() == self.cut.1.units(&(self.parameters)(Profile::Deep)).len() {
            true => Ok(given),
            false => Err(unread("units of work are missing, or there are too many".into())),
        }
    }

    /// The result of what all units gave.
    fn joined(&self, given: Vec<U>, progress: &Progress) -> Result<T, Error> {
        self.cut.1.joined(&(self.parameters)(Profile::Deep), given, progress)
    }
}

impl<P: Params, T: Json, U: Json> Entry for Deep<P, T, U> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn code(&self) -> Code {
        self.code
    }

    /// The whole, an audit of it, or something smaller.
    fn at(&self, profile: Profile) -> Arc<dyn Saved + '_> {
        match profile {
            Profile::Deep => Arc::new(self.whole().run_of(profile)),
            carrying if carrying >= self.from => Arc::new(audit::of(self, profile)),
            _ => Arc::new(self.experiment(self.cut.1.join).run_of(profile)),
        }
    }

    fn parameters(&self, profile: Profile) -> serde_json::Value {
        let profile = if profile >= self.from { Profile::Deep } else { profile };
        self.at(profile).identity().parameters.clone()
    }

    fn carried(&self) -> Option<&'static str> {
        Some(self.title)
    }

    fn found(
        &self,
        profile: Profile,
        _: Given<'_>,
        store: &Store,
        progress: &Progress,
    ) -> Result<(Found, Option<Audit>), Error> {
        let (result, audit) = self.get(profile, store, progress)?;
        Ok((Arc::new(result), audit))
    }

    fn tables(&self, found: &Found) -> Vec<Table> {
        found.downcast_ref().map_or_else(Vec::new, self.tables)
    }
}

impl<P: Params, T: Json, U: Json> Typed for Deep<P, T, U> {
    type Result = T;
}

#[cfg(test)]
mod tests;
