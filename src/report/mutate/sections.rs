//! Which sections of the report read which parts of the results.
//!
//! A section that does not read a part has the same values whatever stands in that part. So when a
//! number is made wrong, only the sections that read its part are computed again. Whether a section
//! reads a part is tried: without the part it fails, or has other values.

use super::part;
use crate::experiments::Results;
use crate::report::contents::{self, SECTIONS};
use crate::report::values::{Registry, Value};
use std::collections::BTreeSet;

/// What is known of the sections.
pub struct Sections {
    /// For each part, the sections that read it.
    readers: Vec<BTreeSet<usize>>,
    /// For each section, the ids of its values.
    ids: Vec<Vec<String>>,
}

/// What stands in the places of sections' own values.
pub struct Exchange {
    sections: BTreeSet<usize>,
    /// Ids of the new values.
    pub new: Vec<String>,
}

impl Sections {
    /// Of the sections, tried with these results.
    pub fn of(results: &Results) -> Result<Self, contents::Error> {
        let whole = SECTIONS.iter().map(|section| section(results));
        let whole: Vec<Vec<Value>> = whole.collect::<Result<_, _>>()?;
        let (mut lacking, nothing) = (part::copy(results), Results::empty(results.profile));
        let readers = |index: usize| {
            part::restore(&mut lacking, index, &nothing);
            let same = |section: &usize| {
                SECTIONS[*section](&lacking).is_ok_and(|values| values == whole[*section])
            };
            let all = 0..SECTIONS.len();
            let found = match part::can_be_missing(index) {
                true => all.filter(|section| !same(section)).collect(),
                false => all.collect(),
            };
            part::restore(&mut lacking, index, results);
            found
        };
        let readers = (0..part::experiments().count()).map(readers).collect();
        let ids = |values: &Vec<Value>| values.iter().map(|value| value.id.clone()).collect();
        Ok(Sections { readers, ids: whole.iter().map(ids).collect() })
    }

    /// Computes all sections anew that read some of these parts, and puts their values in the places of
    /// those that they had.
    ///
    /// # Errors
    /// As [`contents::registry`], beside what stands there then.
    pub fn exchange(
        &self,
        values: &mut Registry,
        results: &Results,
        parts: impl Iterator<Item = usize>,
    ) -> (Exchange, Result<(), contents::Error>) {
        let sections: BTreeSet<usize> =
            parts.flat_map(|index| self.readers[index].iter().copied()).collect();
        self.ids(&sections).for_each(|id| values.remove(id));
        let mut new = Vec::new();
        let put = sections.iter().try_for_each(|section| {
            SECTIONS[*section](results)?.into_iter().try_for_each(|value| {
                let id = value.id.clone();
                values.add(value)?;
                new.push(id);
                Ok(())
            })
        });
        (Exchange { sections, new }, put)
    }

    /// Puts the own values of sections back.
    pub fn restore(&self, values: &mut Registry, exchange: &Exchange, before: &Registry) {
        exchange.new.iter().for_each(|id| values.remove(id));
        let own = self.ids(&exchange.sections).filter_map(|id| before.get(id));
        own.for_each(|value| values.put(value.clone()));
    }

    fn ids(&self, sections: &BTreeSet<usize>) -> impl Iterator<Item = &String> {
        sections.iter().flat_map(|section| &self.ids[*section])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;

    #[test]
    fn a_section_that_fails_takes_its_values_along_until_they_are_restored() {
        let mut before = Registry::new();
        before.extend(["a", "b", "c"].map(|id| Value::integer(id, 1))).unwrap();
        let ids = vec![vec!["a".into(), "b".into()], vec!["c".into()]];
        let sections = Sections { readers: vec![[1].into(), [0].into()], ids };
        let mut values = before.clone();
        let nothing = Results::empty(Profile::Quick);
        let (exchange, outcome) = sections.exchange(&mut values, &nothing, [1].into_iter());
        assert!(matches!(outcome, Err(contents::Error::Experiment(_))), "{outcome:?}");
        assert_eq!(values.iter().map(|value| &value.id).collect::<Vec<_>>(), ["c"]);
        sections.restore(&mut values, &exchange, &before);
        assert_eq!(values, before);
    }
}
