//! Writes the people of an entry, for citations and for the list of references.

use biblatex::Person;

/// Family name with its particle: `van der Berg`.
pub(super) fn family(person: &Person) -> String {
    format!("{} {}", person.prefix, person.name).trim().to_string()
}

/// The names of a citation: "Rice", "Homer & Hogan", "Kowalczyk et al.".
pub(super) fn names(people: &[Person]) -> String {
    let names: Vec<String> = people.iter().map(family).collect();
    match names.as_slice() {
        [one, two] if two != "others" => format!("{one} & {two}"),
        [one, _, ..] => format!("{one} et al."),
        one => one.concat(),
    }
}

/// All authors as `Rice, S. O.` and `Knuth, D. E., III`, with a full stop at the end.
pub(super) fn listed(people: &[Person]) -> String {
    let initial = |word: &str| word.chars().next().map(|c| format!("{c}."));
    let tied = |word: &str| word.split('-').filter_map(initial).collect::<Vec<_>>().join("-");
    let mut names = Vec::new();
    for person in people {
        let given = person.given_name.replace('.', ". ");
        let given = given.split_whitespace().map(tied).collect::<Vec<_>>().join(" ");
        let mut parts = vec![family(person), given, person.suffix.clone()];
        parts.retain(|part| !part.is_empty());
        names.push(parts.join(", "));
    }
    let list = match names.as_slice() {
        [first @ .., last] if last == "others" => format!("{}, et al", first.join(", ")),
        [first @ .., last] if !first.is_empty() => format!("{}, & {last}", first.join(", ")),
        one => one.concat(),
    };
    list.trim_end_matches('.').to_string() + "."
}
