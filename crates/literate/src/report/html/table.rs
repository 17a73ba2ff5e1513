//! Writes tables, which become lists or scroll sideways on a narrow screen.

use super::super::document::{Inline, Table, to_plain_text, to_spelt_text};
use super::Page;
use crate::claims::Verdict;
use crate::figures::escape;
use pulldown_cmark::Alignment;
use std::fmt::Write as _;

const TEXT: usize = 100;
/// Columns whose cells have more characters than this get a minimum width.
const WIDTHS: [(usize, &str); 3] = [(300, "long"), (TEXT, "text"), (40, "words")];

/// This many columns do not fit on a narrow screen, nor do more than `FEW` if one of them is text.
const MANY: usize = 6;
const FEW: usize = 3;

/// Writes powers of a text with raised digits: `10^-6` as 10⁻⁶.
fn raised(words: &str) -> String {
    let (mut raised, mut is_power) = (String::new(), false);
    for c in words.chars() {
        let index = "0123456789-".chars().position(|digit| digit == c);
        match index.and_then(|index| "⁰¹²³⁴⁵⁶⁷⁸⁹⁻".chars().nth(index)).filter(|_| is_power)
        {
            Some(digit) => raised.push(digit),
            None => {
                is_power = c == '^';
                raised.extend((!is_power).then_some(c));
            }
        }
    }
    raised
}

impl Page<'_> {
    pub(super) fn table(&self, table: &Table) -> String {
        let Table { columns, head, rows, .. } = table;
        let longest =
            |i: usize| rows.iter().map(|row| to_plain_text(&row[i]).len()).max().unwrap_or(0);
        let longest: Vec<usize> = (0..columns.len()).map(longest).collect();
        let class = |i: usize| {
            let class = match columns[i] {
                Alignment::Right => Some("right"),
                Alignment::Center => Some("centre"),
                _ => WIDTHS.iter().find(|(least, _)| longest[i] > *least).map(|(_, class)| *class),
            };
            class.map_or(String::new(), |class| format!(" class=\"{class}\""))
        };
        let has_words = |cell: &Vec<Inline>| {
            let is_word = |inline: &Inline| matches!(inline, Inline::Text(text) if text.contains(char::is_alphabetic));
            cell.iter().any(is_word)
        };
        let texts = longest.iter().any(|length| *length > TEXT) && columns.len() > FEW;
        let many = columns.len() >= MANY || texts;
        let lists = many && head.iter().all(has_words);
        // A browser forgets that these are tables once style sheets lay them out as lists.
        let [table, line, field, column] = match (lists, many) {
            (true, _) => [
                " class=\"lists\" role=\"table\"",
                " role=\"row\"",
                " role=\"cell\"",
                " role=\"columnheader\"",
            ],
            (false, true) => [" class=\"many\"", "", "", ""],
            (false, false) => [""; 4],
        };
        // One row of numbers below signs of verdicts is a bar, each part as wide as its number.
        let signs: Vec<char> =
            head.iter().filter_map(|cell| to_plain_text(cell).chars().next()).collect();
        let is_sign = |sign: &char| Verdict::ALL.iter().any(|verdict| verdict.sign() == *sign);
        let is_bar = rows.len() == 1 && signs.len() == head.len() && signs.iter().all(is_sign);
        let table = if is_bar { " class=\"bar\"" } else { table };
        let class = |i: usize| match is_bar {
            true => {
                format!(" style=\"--n: {}\" data-sign=\"{}\"", to_plain_text(&rows[0][i]), signs[i])
            }
            false => class(i),
        };
        let mut html = format!("<table{table}>\n<thead><tr{line}>");
        for (i, cell) in head.iter().enumerate() {
            let mut words = self.inlines(cell);
            // Some screen readers find no words in mathematics.
            if matches!(cell.as_slice(), [Inline::Maths(_)]) {
                let to_spelt_text = escape(&to_spelt_text(cell));
                words = format!(
                    "<span aria-hidden=\"true\">{words}</span><span class=\"unseen\">{to_spelt_text}</span>"
                );
            }
            let _ = if words.trim().is_empty() {
                write!(html, "<td{}></td>", class(i))
            } else {
                write!(html, "<th scope=\"col\"{column}{}>{words}</th>", class(i))
            };
        }
        html.push_str("</tr></thead>\n<tbody>\n");
        for row in rows {
            let _ = write!(html, "<tr{line}>");
            for (i, cell) in row.iter().enumerate() {
                let name = head.get(i).filter(|_| lists);
                let name = name.map(|head| {
                    format!(" data-name=\"{}\"", escape(&raised(&to_spelt_text(head))))
                });
                let (name, words) = (name.unwrap_or_default(), self.inlines(cell));
                let _ = write!(html, "<td{field}{}{name}>{words}</td>", class(i));
            }
            html.push_str("</tr>\n");
        }
        html + "</tbody>\n</table>"
    }
}
