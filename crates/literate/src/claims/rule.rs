//! Judges every statement and relation by its rule.

use super::check::{Basis, Check, Kind, Verdict};
use super::evidence::{Error, Evidence, Judged};
use super::level::CheckLevel;
use super::published::{Published, Statement};
use super::texts::Text;
use crate::experiments::{Profile, Results};
use std::panic::Location;

/// How a statement or a relation is judged.
pub struct Rule {
    /// The id of what it judges.
    pub id: &'static str,
    /// What it says, if it judges a relation between numbers and nothing that was printed.
    relation: Option<&'static str>,
    reads: Option<&'static str>,
    /// Ids and numbers of the parameters that it judges with.
    pub uses: Vec<(&'static str, f64)>,
    basis: Option<Basis>,
    is_statistical: bool,
    may_stay_open: bool,
    pub(crate) place: &'static Location<'static>,
    judge: Box<dyn Fn(&Evidence<'_>) -> Judged + Send + Sync>,
}

impl Rule {
    /// Makes a rule for the statement of `published.toml` with this id.
    #[track_caller]
    pub fn new(
        id: &'static str,
        judge: impl Fn(&Evidence<'_>) -> Judged + Send + Sync + 'static,
    ) -> Rule {
        let (judge, place) = (Box::new(judge), Location::caller());
        let (relation, reads, uses, basis) = (None, None, Vec::new(), None);
        let (is_statistical, may_stay_open) = (false, false);
        Rule { id, relation, reads, uses, basis, is_statistical, may_stay_open, place, judge }
    }

    /// Makes it the rule of a relation that must hold. It may allow for errors at the level of the
    /// statistical checks, and is not counted. Empty words stand among the texts of the checks.
    pub fn relation(self, relation: &'static str) -> Rule {
        Rule { relation: Some(relation), ..self }
    }

    /// Counts the rule as statistical: it compares random numbers and allows for their standard
    /// errors, so few that all statistical checks together rarely fail by chance.
    pub fn statistical(self) -> Rule {
        Rule { is_statistical: true, ..self }
    }

    /// Sets what the verdict rests on, also where the results do not decide.
    pub fn on(self, basis: Basis) -> Rule {
        Rule { basis: Some(basis), ..self }
    }

    /// Sets the printed words or formula that it judges, where a number alone is not enough: a
    /// statement with other words is refused. `{}` stands for the number.
    pub fn reads(self, words: &'static str) -> Rule {
        Rule { reads: Some(words), ..self }
    }

    /// Sets the numbers of `[[parameter]]` that it judges with: a file with others is refused.
    pub fn uses(self, parameters: &[(&'static str, f64)]) -> Rule {
        Rule { uses: parameters.to_vec(), ..self }
    }

    /// Lets it stay open, in the full profile too, where a number is not there, and lets its
    /// tolerance be as large as the printed number; both fail otherwise.
    pub fn may_stay_open(self) -> Rule {
        Rule { may_stay_open: true, ..self }
    }

    /// Returns whether it judges something that was printed, and not a relation.
    pub fn is_of_statement(&self) -> bool {
        self.relation.is_none()
    }

    /// Returns the statement that it judges, or one that is made of its relation.
    pub(super) fn statement(&self, published: &Published) -> Result<Statement, Error> {
        let Some(relation) = self.relation else {
            return Ok(published.statement(self.id)?.clone());
        };
        let statement = published.words.statement(self.id).unwrap_or(relation).into();
        let (kind, id) = (Kind::Relation, self.id.into());
        Ok(Statement { kind, id, statement, ..Statement::default() })
    }

    fn judged(&self, evidence: &Evidence<'_>) -> Judged {
        let statement = evidence.statement;
        if let Some(words) = self.reads {
            let words = words.replace("{}", &statement.printed_digits().unwrap_or_default());
            if words != statement.printed {
                let remedy = "and not its printed; restore the one that is wrong";
                let problem = format!("its check judges {words:?}, {remedy}");
                return Err(statement.fault(&problem).into());
            }
        }
        let mut check = match (self.judge)(evidence) {
            Err(Error::Undecided) if evidence.is_strict => {
                evidence.open("a number that it needs is not there")
            }
            Err(Error::Undecided) => {
                evidence.open("–").note("The available results do not decide it.")
            }
            judged => judged?,
        };
        for sentence in [&check.found, &check.tolerance, &check.note] {
            if let Some(number) = sentence.0.iter().find(|number| !number.is_finite()) {
                let remedy = "correct it, or return `Undecided` where there is none";
                let number = Text::from(number.clone());
                return Err(Error::Rule(format!("a number of it is {number}; {remedy}")));
            }
        }
        check.basis = self.basis.unwrap_or(check.basis);
        Ok(check)
    }
}

/// Returns the level at which each statistical check among these rules is made.
pub fn level_of(rules: &[Rule]) -> CheckLevel {
    CheckLevel::for_checks(rules.iter().filter(|rule| rule.is_statistical).count())
}

/// Checks that each rule has its statement, and each parameter that a rule uses its number.
pub(crate) fn check_rules(published: &Published, rules: &[Rule]) -> Result<(), Error> {
    for rule in rules.iter().filter(|rule| rule.is_of_statement()) {
        published.statement(rule.id)?;
    }
    for (id, number) in rules.iter().flat_map(|rule| &rule.uses) {
        published.compare(id, *number)?;
    }
    Ok(())
}

/// Judges by rules: what was printed, and the results.
#[derive(Clone, Copy)]
pub struct Judge<'a> {
    pub(super) published: &'a Published,
    pub(super) rules: &'a [Rule],
    pub(super) results: &'a Results,
    pub(super) level: CheckLevel,
}

impl<'a> Judge<'a> {
    /// Makes a judge of these statements by these rules and results.
    pub fn new(published: &'a Published, rules: &'a [Rule], results: &'a Results) -> Judge<'a> {
        Judge { published, rules, results, level: level_of(rules) }
    }

    pub(super) fn check(&self, rule: &Rule, statement: &Statement) -> Judged {
        let Judge { published, results, level, .. } = *self;
        let allows_errors = rule.is_statistical || !rule.is_of_statement();
        // Small samples may decide nothing.
        let is_strict = results.profile == Profile::Full && !rule.may_stay_open;
        let level = allows_errors.then_some(level);
        let judged = rule.judged(&Evidence { statement, results, published, level, is_strict });
        judged.map_err(|error| Error::Check(rule.id.into(), Box::new(error)))
    }

    /// Judges all statements, first those that rest on a measure of ours, then all relations. One
    /// without a rule stays open and [fails](Check::fails); a rule without one is an error.
    pub fn checks(&self) -> Result<Vec<Check>, Error> {
        let Judge { published, rules, results, .. } = *self;
        check_rules(published, rules)?;
        results.tables()?;
        let mut checks = Vec::new();
        for statement in &published.statements {
            let rule = rules.iter().find(|rule| rule.is_of_statement() && rule.id == statement.id);
            checks.push(match rule {
                Some(rule) => self.check(rule, statement)?,
                None => statement.open("–"),
            });
        }
        for rule in rules.iter().filter(|rule| !rule.is_of_statement()) {
            checks.push(self.check(rule, &rule.statement(published)?)?);
        }
        checks.sort_by_key(|check| (check.kind, check.basis != Basis::OurMeasure));
        Ok(checks)
    }

    /// Judges each statement once more with another first digit in its number. Returns the ids of
    /// those that are still reproduced or explained: their verdicts say nothing about the number.
    pub fn ids_blind_to_number(&self) -> Vec<&'static str> {
        let is_blind = |rule: &&Rule| {
            let misprint = self.published.statement(rule.id).ok().and_then(Statement::misprint);
            let check = misprint.map(|misprint| self.check(rule, &misprint));
            let verdict = check.map(|check| check.map(|check| check.verdict));
            matches!(verdict, Some(Ok(Verdict::Reproduced | Verdict::DiffersAndExplained)))
        };
        let rules = self.rules.iter().filter(|rule| rule.is_of_statement());
        rules.filter(is_blind).map(|rule| rule.id).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::text;
    use crate::table::Table;
    use impact_numerics::statistics::Estimate;
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    const PUBLISHED: &str = "statement = [
        { id = \"rise\", place = \"a\", statement = \"b\", printed = \"0.12\", value = 0.12, decimals = 2 },
        { id = \"mean\", place = \"a\", statement = \"b\", printed = \"0.11\", value = 0.11, decimals = 2 },
        { id = \"words\", place = \"a\", statement = \"b\", printed = \"steep\" },
        { id = \"without\", place = \"a\", statement = \"b\", printed = \"c\" }]";

    fn results() -> Results {
        let mean = |x: &f64| Some(Estimate { value: *x, error: 0.002, interval: [0.0; 2] });
        let table = Table::builder("toy.all", &[0.1152], |_| 9).real("rise", "1", 6, "A.", |x| *x);
        let table = table.estimate("mean", "1", "A mean.", mean).real("none", "1", 2, "", |_| None);
        Results::made_up(vec![table.done()])
    }

    fn judged(rules: &[Rule]) -> Result<Vec<Check>, Error> {
        Judge::new(&Published::parse(PUBLISHED).unwrap(), rules, &results()).checks()
    }

    fn refused(id: &'static str, judge: fn(&Evidence<'_>) -> Judged) -> String {
        judged(&[Rule::new(id, judge)]).unwrap_err().to_string()
    }

    #[test]
    fn a_cell_is_compared_with_what_was_printed() {
        use Verdict::{CannotBeJudged as Open, Differs as No, Reproduced as Yes};
        fn explained<const HOLDS: bool>(e: &Evidence<'_>) -> Judged {
            Ok(e.cell("toy.all.rise")?.explained("why", HOLDS))
        }
        // Printed are 0.12, 0.11 and a word; found is 0.1152, once with an error of 0.002, of which
        // 2.94 are allowed.
        type Judges = fn(&Evidence<'_>) -> Judged;
        let cases: [(Judges, _, _, _); 6] = [
            (|e| e.cell("toy.all.rise"), [Yes, No], "0.1152", "± 0.005"),
            (|e| e.cell("toy.all.mean"), [Yes, Yes], "0.115(2)", "± 0.005"),
            (|e| e.within_errors("toy.all.mean"), [Yes, Yes], "0.115(2)", "± 0.006"),
            (|e| e.near("toy.all.rise", 1e-3, "ours"), [No, No], "0.1152", "± 0.001"),
            (explained::<true>, [Yes, Verdict::DiffersAndExplained], "0.1152", "± 0.005"),
            (explained::<false>, [No, No], "0.1152", "± 0.005"),
        ];
        for (judge, [rise, mean], found, tolerance) in cases {
            let checks = judged(&["rise", "mean"].map(|id| Rule::new(id, judge).statistical()));
            let checks = checks.unwrap();
            let verdicts: Vec<Verdict> = checks.iter().map(|check| check.verdict).collect();
            assert_eq!(verdicts, [rise, mean, Open, Open]);
            let texts = [&checks[0].found, &checks[0].tolerance].map(Text::to_string);
            assert_eq!(texts, [found, tolerance]);
            let without = &checks[2..];
            assert!(without.iter().all(Check::fails), "a statement without a rule fails too");
            assert!(!checks[3].clone().note("It is a likeness in words.").fails());
            assert!(rise == Yes || checks[0].fails() && checks[1].fails());
        }
    }

    /// Printed is 0.10: 0.0152 away, where half a unit and 2.58 errors are 0.0102, and twice as
    /// many errors 0.0153.
    #[test]
    fn a_cell_has_room_for_its_errors_once() {
        let published = Published::parse(&PUBLISHED.replace("0.11", "0.10")).unwrap();
        let rules = [Rule::new("mean", |e| e.cell("toy.all.mean")).statistical()];
        let checks = Judge::new(&published, &rules, &results()).checks().unwrap();
        assert_eq!(checks[1].verdict, Verdict::Differs);
    }

    /// Printed is 0.12. None of 20 does not exclude it, none of 100 and all of 20 do. Equal values
    /// do not, nor does 0.2 from three values: they allow 9.93 errors of 0.02.
    #[test]
    fn shares_equal_values_and_few_are_not_certain() {
        use crate::sample::{Sampled, average, share};
        let judge = |sampled: Option<Sampled>, judge: fn(&Evidence<'_>) -> Judged| {
            let rows = Table::builder("toy.all", &[()], |()| 9);
            let table = rows.estimate("mean", "1", "", |()| sampled);
            let published = Published::parse(PUBLISHED).unwrap();
            let results = Results::made_up(vec![table.done()]);
            let rule = [Rule::new("rise", judge).statistical()];
            let mut checks = Judge::new(&published, &rule, &results).checks().unwrap();
            (checks[0].verdict, std::mem::take(&mut checks[0].tolerance).to_string())
        };
        let within = |sampled| judge(sampled, |e| e.within_errors("toy.all.mean"));
        use Verdict::{CannotBeJudged as Open, Differs as No, Reproduced as Yes};
        assert_eq!(within(share(0, 20)), (Yes, "0 to 0.23".into()));
        assert_eq!(within(share(0, 100)), (No, "0 to 0.052".into()));
        assert_eq!(within(share(20, 20)), (No, "0.77 to 1.0".into()));
        let near = [0.2, 0.2 - 0.02 * 3_f64.sqrt(), 0.2 + 0.02 * 3_f64.sqrt()];
        assert_eq!(within(average(&near)), (Yes, "± 0.2".into()));
        assert_eq!(within(average(&[0.2; 9])).0, Open);
        assert_eq!(within(average(&[0.12; 9])).0, Yes);
        for (value, verdict) in [(0.2, Open), (0.124, Yes)] {
            let cell = judge(average(&[value; 9]), |e| e.cell("toy.all.mean"));
            assert_eq!(cell.0, verdict);
        }
    }

    /// One rule can fail; one does so only if its number has another sign, which is no small change
    /// of an explanation; one stays open, one is decided by other results, and one panics.
    #[test]
    fn a_verdict_that_nothing_moves_is_named() {
        let rise = |e: &Evidence<'_>| e.number("toy.all.rise");
        let rules = [
            Rule::new("rise", |e| e.cell("toy.all.rise")),
            Rule::new("mean", move |e| Ok(e.found("", false).explained("why", rise(e)? > 0.0))),
            Rule::new("words", move |e| Ok(e.open(text!("{}", rise(e)?)))),
            Rule::new("without", move |e| {
                Ok(if rise(e)? > 0.2 { e.found("", true) } else { e.open("") })
            }),
            Rule::new("panics", move |e| {
                assert!(rise(e)? == 0.1152, "a rule that takes no other number");
                Ok(e.found("", true))
            })
            .relation("It never fails."),
        ];
        let published = Published::parse(PUBLISHED).unwrap();
        let results = results();
        let judge = Judge::new(&published, &rules, &results);
        let named = |open| judge.ids_never_moved(open).unwrap();
        assert_eq!(named(false), ["mean", "panics"]);
        assert_eq!(named(true), ["mean", "words", "panics"]);
    }

    #[test]
    fn each_rule_runs_once_and_standard_errors_need_a_statistical_one() {
        static RUNS: AtomicUsize = AtomicUsize::new(0);
        let counted = |e: &Evidence<'_>| {
            RUNS.fetch_add(1, Relaxed);
            e.level().map(|level| e.open(text!("{}", level.claims)))
        };
        let rules = [
            Rule::new("rise", counted).statistical(),
            Rule::new("mean", |e| e.within_errors("toy.all.mean")).statistical(),
            Rule::new("both", counted).relation("The level is known."),
        ];
        let checks = judged(&rules).unwrap();
        assert_eq!((RUNS.load(Relaxed), checks.len()), (2, 5));
        assert_eq!(checks[0].found, checks[4].found, "relations do not count");
        assert_eq!((checks[0].found.to_string(), checks[4].kind), ("2".into(), Kind::Relation));
        for judge in [counted, |e: &Evidence<'_>| e.cell("toy.all.mean")] {
            let error = refused("mean", judge);
            assert!(error.starts_with("check mean: the rule of mean allows for"), "{error}");
        }
        let near = |e: &Evidence<'_>| e.near("toy.all.mean", 0.1, "ours");
        assert!(judged(&[Rule::new("mean", near)]).is_ok());
        let wide = |e: &Evidence<'_>| e.near("toy.all.mean", 1e9, "ours");
        assert!(refused("mean", wide).contains("1000000000 is as large as the printed number; "));
        assert!(judged(&[Rule::new("mean", wide).may_stay_open()]).is_ok());
    }

    #[test]
    fn a_check_needs_both_numbers() {
        let open = |e: &Evidence<'_>| Ok(e.cell("toy.all.none")?.explained("why", true));
        let check = &judged(&[Rule::new("rise", open)]).unwrap()[0];
        assert_eq!(check.verdict, Verdict::CannotBeJudged);
        assert!(check.fails() && check.found.to_string() == "a number that it needs is not there");
        let check = &judged(&[Rule::new("rise", open).may_stay_open()]).unwrap()[0];
        assert!(!check.fails() && check.found.to_string() == "–");
        assert_eq!(check.note.to_string(), "The available results do not decide it.");
        let error = refused("words", |e| e.cell("toy.all.rise"));
        assert!(error.contains("printed = \"steep\"; write it as `value`"), "{error}");
        let error = refused("mean", |e| e.cell("toy.all.maen"));
        assert!(error.starts_with("check mean: toy.all.maen: there is no column "), "{error}");
        assert!(error.contains("src/claims/rule.rs:"), "{error}");
        let error = refused("mean", |e| Ok(e.found(text!("{}", f64::NAN), true)));
        assert!(error.starts_with("check mean: a number of it is NaN; "), "{error}");
    }

    #[test]
    fn other_printed_words_are_refused_and_the_basis_stays_without_a_verdict() {
        let rule =
            |words| Rule::new("rise", |_| Err(Error::Undecided)).reads(words).may_stay_open();
        let check = &judged(&[rule("{}").on(Basis::OurMeasure)]).unwrap()[0];
        assert_eq!((check.verdict, check.basis), (Verdict::CannotBeJudged, Basis::OurMeasure));
        assert!(!check.fails(), "{}", check.note);
        let error = judged(&[rule("{} or so")]).unwrap_err();
        assert!(matches!(error.cause(), Error::Published(_)), "{error}");
    }
}
