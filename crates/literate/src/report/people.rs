//! Reads the names of authors and editors, and writes them as citations and the list show them.

use biblatex::{Chunk, ChunksExt, Entry, Person};

/// Reads the people of a field, who are none if it is empty. An empty name is refused.
pub fn parse_people(entry: &Entry, field: &str) -> Result<Vec<Person>, String> {
    let mut chunks = entry.get(field).unwrap_or_default().to_vec();
    let mut names_and = "and ".to_string();
    for chunk in &mut chunks {
        if let Chunk::Normal(text) = &mut chunk.v {
            *text = text.replace('~', " ").replace(" AND ", " and ");
        }
        let is_normal = matches!(chunk.v, Chunk::Normal(_));
        names_and +=
            &if is_normal { chunk.v.get().into() } else { chunk.v.get().replace([' ', ','], "_") };
    }
    let words: Vec<&str> = names_and.split_whitespace().chain(["and"]).collect();
    if let Some((_, macro_name)) = names_and.split_once('\\') {
        Err(format!("has \\{macro_name} in its {field}; write it in plain letters"))
    } else if words.len() == 2 {
        Ok(Vec::new())
    } else if words.windows(2).any(|pair| pair == ["and"; 2]) {
        Err(format!("has {:?} as its {field}, and so an empty name; correct it", &names_and[4..]))
    } else if let Some(name) =
        names_and[4..].split(" and ").find(|name| name.matches(',').count() > 2)
    {
        Err(format!("has {name:?} in its {field}; write `and` between names"))
    } else {
        Ok(chunks.parse().unwrap_or_default())
    }
}

/// Returns the family name with its particle: `van der Berg`.
fn family(person: &Person) -> String {
    format!("{} {}", person.prefix, person.name).trim().to_string()
}

/// Returns the names of a citation: "Rice", "Homer & Hogan", "Kowalczyk et al.".
pub fn citation_names(people: &[Person]) -> String {
    let names: Vec<String> = people.iter().map(family).collect();
    match names.as_slice() {
        [one, two] if two != "others" => format!("{one} & {two}"),
        [one, _, ..] => format!("{one} et al."),
        one => one.concat(),
    }
}

/// Returns the initials of given names: `S. O.`, `J.-M.`.
fn initials(person: &Person) -> String {
    let initial = |word: &str| word.chars().next().map(|c| format!("{c}."));
    let tied = |word: &str| word.split('-').filter_map(initial).collect::<Vec<_>>().join("-");
    let given = person.given_name.replace('.', ". ");
    given.split_whitespace().map(tied).collect::<Vec<_>>().join(" ")
}

/// Lists all authors as `Rice, S. O.` and `Knuth, D. E., III`, with a full stop at the end.
pub fn list_authors(people: &[Person]) -> String {
    let name = |person: &Person| {
        let mut parts = vec![family(person), initials(person), person.suffix.clone()];
        parts.retain(|part| !part.is_empty());
        parts.join(", ")
    };
    let list = joined(people.iter().map(name).collect(), ", & ");
    list.trim_end_matches('.').to_string() + "."
}

/// Lists editors as `M. di Bernardo & E. Itor (Eds.), `, or returns no words if there are none.
pub fn list_editors(people: &[Person]) -> String {
    let name = |one: &Person| format!("{} {}", initials(one), family(one)).trim().to_string();
    match people.len() {
        0 => String::new(),
        1 => format!("{} (Ed.), ", name(&people[0])),
        _ => joined(people.iter().map(name).collect(), " & ") + " (Eds.), ",
    }
}

fn joined(names: Vec<String>, between_two: &str) -> String {
    match names.as_slice() {
        [first @ .., last] if last == "others" => format!("{}, et al.", first.join(", ")),
        [one, two] => format!("{one}{between_two}{two}"),
        [first @ .., last] if !first.is_empty() => format!("{}, & {last}", first.join(", ")),
        one => one.concat(),
    }
}
