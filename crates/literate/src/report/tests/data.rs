//! Checks that every format shows words from data as they are.

use super::*;

#[test]
fn words_of_data_are_data() {
    let shown = |words: &str| {
        let rows = [words];
        let table = Table::of("toy.words", &rows, |_| 1)
            .text_key("name", |word| word.to_string())
            .words("word", "", |word| word.to_string())
            .done();
        let cell = "«toy.words[row].word»";
        let prose = format!(
            "{PROSE}\n\n{cell} and <% for row in keys.toy.words.rows %>{cell}<% endfor %>.\n\n\
             | Name | Word |\n|---|---|\n<% for row in keys.toy.words.rows -%>\n\
             | «toy.words[row].name» | {cell} |\n<% endfor %>"
        );
        let prose = prose.replacen(cell, "«toy.words[keys.toy.words.rows[0]].word»", 1);
        Given { table: Some(table), ..given(&prose) }.made()
    };
    for words in [
        "US$",
        "cost $5 and $6",
        "a|b",
        r"C:\new{x}",
        "<b>&amp;</b>",
        "*a* _b_ `c`",
        "[x](y)",
        "one\ntwo\r\nthree",
        "\"quoted\" ~ ^ #1 @a 50 %",
        "1. a",
        "null",
    ] {
        let report = shown(words).unwrap();
        let line = words.replace("\r\n", " ").replace('\n', " ");
        // Another reader of Markdown finds the words, in a sentence and in two cells.
        let markdown = file(&report, "report.md");
        let options = pulldown_cmark::Options::ENABLE_TABLES | pulldown_cmark::Options::ENABLE_MATH;
        let mut read = String::new();
        for event in pulldown_cmark::Parser::new_ext(&markdown, options) {
            match event {
                pulldown_cmark::Event::Text(text) => read += &text,
                pulldown_cmark::Event::End(_) => read += "⏎",
                _ => (),
            }
        }
        for place in [format!("{line} and {line}.⏎"), format!("⏎{line}⏎{line}⏎")] {
            assert!(read.contains(&place), "{words:?}: {place:?} is not in {read}");
        }
        let tex = file(&report, "report.tex");
        let tex_line = tex::text(&line);
        assert!(tex.contains(&format!("{{{tex_line}}} \\\\\n")), "{words:?}: {tex}");
        let page = file(&report, "report.html");
        let id = format!("toy.words[name={words}].word");
        let [escaped, escaped_id] =
            [&line.replace(" %", "\u{a0}%"), &id].map(|text| crate::figures::escape(text));
        let value = format!("\"{}\">{escaped}</span>", escaped_id.replace('\n', "&#10;"));
        assert_eq!(page.matches(&value).count(), 3, "{words:?}");
        let cards = file(&report, "cards.js");
        let cards: serde_json::Value =
            serde_json::from_str(cards.trim_start_matches("CARDS = ").trim_end_matches(";\n"))
                .unwrap();
        assert_eq!(cards[1][&id][0], escaped, "{words:?}");
    }
    for words in ["a\u{7}b", "\0", "a\u{e000}b"] {
        let error = shown(words).unwrap_err().to_string();
        assert!(error.contains("which no format can show"), "{error}");
    }
}
