//! Which sections of the report read which parts of the results.
//!
//! A section that does not read a part has the same values whatever stands in that part. So when a
//! number is made wrong, only the sections that read its part are computed again. Whether a section
//! reads a part is tried: without the part it fails, or has other values.

use super::part;
use impact_paper::experiments::Results;
use impact_paper::report::contents::{self, SECTIONS};
use impact_paper::report::values::{Registry, Value};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// What is known of the sections.
pub struct Sections {
    /// For each part, the sections that read it.
    readers: Vec<BTreeSet<usize>>,
    /// The values of each section.
    values: Vec<Vec<Value>>,
}

/// The ids of the values that differ, are new or are gone.
pub type Changed = BTreeSet<String>;

impl Sections {
    /// Of the sections, tried with these results.
    pub fn of(results: &Results) -> Result<Self, contents::Error> {
        let values: Vec<Vec<Value>> =
            SECTIONS.par_iter().map(|section| section(results)).collect::<Result<_, _>>()?;
        let nothing = Results::empty(results.profile);
        let readers = |lacking: &mut Results, index: usize| -> BTreeSet<usize> {
            let all = 0..SECTIONS.len();
            if !part::can_be_missing(index) {
                return all.collect();
            }
            part::restore(lacking, index, &nothing);
            let same = |section: &usize| {
                SECTIONS[*section](lacking).is_ok_and(|found| found == values[*section])
            };
            let found = all.filter(|section| !same(section)).collect();
            part::restore(lacking, index, results);
            found
        };
        let parts = 0..part::experiments().count();
        // Copies are made for a few parts each.
        let parts = parts.into_par_iter().with_min_len(7);
        let readers = parts.map_init(|| results.shared(), readers).collect();
        Ok(Sections { readers, values })
    }

    /// Computes all sections anew that read some of these parts, and puts what is other than it was in
    /// its place.
    ///
    /// # Errors
    /// As [`contents::registry`], beside what changed until then.
    pub fn exchange(
        &self,
        values: &mut Registry,
        results: &Results,
        parts: impl Iterator<Item = usize>,
    ) -> (Changed, Result<(), contents::Error>) {
        let sections: BTreeSet<usize> =
            parts.flat_map(|index| self.readers[index].iter().copied()).collect();
        let mut changed = Changed::new();
        let put = self.compute(sections, results).and_then(|(gone, come)| {
            gone.iter().for_each(|id| values.remove(id));
            changed.extend(gone.into_iter().map(String::from));
            come.into_iter().try_for_each(|value| {
                changed.insert(value.id.clone());
                Ok(values.add(value)?)
            })
        });
        (changed, put)
    }

    /// The ids of the values that go, and the values that come. Nearly all stay what they were.
    fn compute(
        &self,
        sections: BTreeSet<usize>,
        results: &Results,
    ) -> Result<(Vec<&str>, Vec<Value>), contents::Error> {
        let (mut gone, mut come) = (Vec::new(), Vec::new());
        for section in sections {
            let (own, found) = (&self.values[section], SECTIONS[section](results)?);
            let with_same_ids = own.iter().map(|v| &v.id).eq(found.iter().map(|v| &v.id));
            if with_same_ids {
                let others = own.iter().zip(found).filter(|(own, found)| *own != found);
                others.for_each(|(own, found)| {
                    gone.push(own.id.as_str());
                    come.push(found);
                });
            } else {
                gone.extend(own.iter().map(|value| value.id.as_str()));
                come.extend(found);
            }
        }
        Ok((gone, come))
    }

    /// Puts back what stood there before.
    pub fn restore(values: &mut Registry, changed: &Changed, before: &Registry) {
        for id in changed {
            values.restore(id, before);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_paper::params::Profile;

    #[test]
    fn a_section_that_fails_changes_nothing() {
        let mut before = Registry::new();
        before.extend(["a", "b", "c"].map(|id| Value::integer(id, 1))).unwrap();
        let values = [&["a", "b"][..], &["c"]]
            .map(|ids| ids.iter().map(|id| Value::integer(*id, 1)).collect())
            .to_vec();
        let sections = Sections { readers: vec![[1].into(), [0].into()], values };
        let mut values = before.clone();
        let nothing = Results::empty(Profile::Quick);
        let (changed, outcome) = sections.exchange(&mut values, &nothing, [1].into_iter());
        assert!(outcome.is_err(), "{outcome:?}");
        assert!(changed.is_empty() && values == before);
    }

    /// A section of the theory, which needs no experiment, was other than it is.
    #[test]
    fn what_changed_is_exchanged_and_nothing_else() {
        let results = Results::empty(Profile::Quick);
        let section = (0..SECTIONS.len())
            .find(|section| SECTIONS[*section](&results).is_ok_and(|values| values.len() > 2))
            .unwrap();
        let now = SECTIONS[section](&results).unwrap();
        let mut own = now.clone();
        own[1].note = "other".into();
        let mut gone = now.clone();
        gone[0].id = "gone".into();
        let other = [now[1].id.clone()].into();
        let all = now.iter().chain(&gone).map(|value| value.id.clone()).collect();
        for (before, expected) in [(own, other), (gone, all)] {
            let mut values = vec![Vec::new(); SECTIONS.len()];
            values[section].clone_from(&before);
            let sections = Sections { readers: vec![[section].into()], values };
            let registry = |values: &[Value]| {
                let mut registry = Registry::new();
                registry.extend(values.iter().cloned()).unwrap();
                registry
            };
            let (was, is) = (registry(&before), registry(&now));
            let mut found = was.clone();
            let (changed, outcome) = sections.exchange(&mut found, &results, [0].into_iter());
            assert!(outcome.is_ok() && found == is, "{outcome:?}");
            assert_eq!(changed, expected);
            Sections::restore(&mut found, &changed, &was);
            assert_eq!(found, was);
        }
    }

    #[test]
    fn values_that_changed_are_put_back() {
        let mut before = Registry::new();
        before.extend(["a", "b", "c"].map(|id| Value::integer(id, 1))).unwrap();
        let mut values = before.clone();
        values.remove("a");
        values.put(Value::integer("b", 2));
        values.put(Value::integer("d", 1));
        Sections::restore(&mut values, &["a", "b", "d"].map(String::from).into(), &before);
        assert_eq!(values, before);
    }
}
