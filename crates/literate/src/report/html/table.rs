//! Writes tables, which become lists or scroll sideways on a narrow screen.

use super::super::document::{Inline, Table, to_plain_text, to_spelt_text};
use super::Page;
use crate::claims::Verdict;
use crate::figures::escape;
use pulldown_cmark::Alignment;

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
        let is_word = |inline: &Inline| matches!(inline, Inline::Text(text) if text.contains(char::is_alphabetic));
        let texts = longest.iter().any(|length| *length > TEXT) && columns.len() > FEW;
        let many = columns.len() >= MANY || texts;
        let lists = many && head.iter().all(|cell| cell.iter().any(is_word));
        // One row of numbers below signs of verdicts is a bar, each part as wide as its number.
        let signs: Vec<char> =
            head.iter().filter_map(|cell| to_plain_text(cell).chars().next()).collect();
        let is_sign = |sign: &char| Verdict::ALL.iter().any(|verdict| verdict.sign() == *sign);
        let is_bar = rows.len() == 1 && signs.len() == head.len() && signs.iter().all(is_sign);
        // A browser forgets that these are tables once style sheets lay them out as lists.
        let role = |name| if lists { format!(" role=\"{name}\"") } else { String::new() };
        let [row_role, cell_role, head_role] = ["row", "cell", "columnheader"].map(role);
        let kind = match (is_bar, lists, many) {
            (true, ..) => " class=\"bar\"",
            (_, true, _) => " class=\"lists\" role=\"table\"",
            (.., true) => " class=\"many\"",
            _ => "",
        };
        let class = |i: usize| {
            let width = || WIDTHS.iter().find(|(least, _)| longest[i] > *least);
            let class = match columns[i] {
                _ if is_bar => {
                    let number = to_plain_text(&rows[0][i]);
                    return format!(" style=\"--n: {number}\" data-sign=\"{}\"", signs[i]);
                }
                Alignment::Right => Some("right"),
                Alignment::Center => Some("centre"),
                _ => width().map(|(_, class)| *class),
            };
            class.map_or(String::new(), |class| format!(" class=\"{class}\""))
        };
        let mut html = format!("<table{kind}>\n<thead><tr{row_role}>");
        for (i, cell) in head.iter().enumerate() {
            let mut words = self.inlines(cell);
            // Some screen readers find no words in mathematics.
            if matches!(cell.as_slice(), [Inline::Maths(_)]) {
                let spelt = escape(&to_spelt_text(cell));
                words = format!(
                    "<span aria-hidden=\"true\">{words}</span><span class=\"unseen\">{spelt}</span>"
                );
            }
            html += &match words.trim() {
                "" => format!("<td{}></td>", class(i)),
                _ => format!("<th scope=\"col\"{head_role}{}>{words}</th>", class(i)),
            };
        }
        html += "</tr></thead>\n<tbody>\n";
        for row in rows {
            html += &format!("<tr{row_role}>");
            for (i, cell) in row.iter().enumerate() {
                let name = head.get(i).filter(|_| lists).map(|head| raised(&to_spelt_text(head)));
                let name = name.map(|name| format!(" data-name=\"{}\"", escape(&name)));
                let (name, words) = (name.unwrap_or_default(), self.inlines(cell));
                html += &format!("<td{cell_role}{}{name}>{words}</td>", class(i));
            }
            html += "</tr>\n";
        }
        html + "</tbody>\n</table>"
    }
}
