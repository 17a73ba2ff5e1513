//! Checks that every format shows words from data as they are: other programs read them back.

use super::*;
use std::io::Write as _;
use std::process::{Command, Stdio};

/// All text below an element, cut at the word *cut*, with one blank between words.
fn read(xml: &str, top: &str, shows: fn(&str) -> bool) -> Vec<String> {
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let tree = roxmltree::Document::parse_with_options(xml, options).unwrap();
    let top = tree.descendants().find(|node| node.tag_name().name() == top).unwrap();
    let mut text = String::new();
    for node in top.descendants() {
        let name = node.tag_name().name();
        // A document in XML has text in `text` and `code` alone.
        let is_visible = node.is_text() && shows(node.parent().unwrap().tag_name().name());
        text += node.text().filter(|_| is_visible).unwrap_or_default();
        let within =
            ["text", "code", "emph", "strong", "link", "html_inline", "", "em", "a", "span", "wbr"];
        text += if within.contains(&name) { "" } else { " " };
    }
    text.split("cut").map(in_words).collect()
}

fn in_words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The tree that GitHub's reader of Markdown makes; none where that is not installed.
fn as_github_reads(markdown: &str) -> Option<String> {
    let extensions = ["table", "tasklist", "strikethrough", "autolink"];
    let arguments = extensions.iter().flat_map(|extension| ["-e", extension]);
    let mut command = Command::new("cmark-gfm");
    command.args(arguments).args(["-t", "xml"]).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut program = match command.spawn() {
        Ok(program) => program,
        Err(error) if std::env::var_os("CI").is_some() => panic!("cmark-gfm: {error}"),
        Err(_) => {
            eprintln!("cmark-gfm is not installed: what GitHub reads is not checked");
            return None;
        }
    };
    program.stdin.take().unwrap().write_all(markdown.as_bytes()).unwrap();
    let read = program.wait_with_output().unwrap();
    Some(String::from_utf8(read.stdout).unwrap().replace("<softbreak />", "<text> </text>"))
}

fn with_words(words: &[String], prose: &str) -> Result<Files, Error> {
    let rows: Vec<(usize, &String)> = words.iter().enumerate().collect();
    let table = Table::builder("toy.words", &rows, |_| 1).key("n", "1", |(n, _)| *n as f64);
    let table = table.text_key("name", |(_, word)| word.to_string());
    let table = table.words("word", "", |(_, word)| word.to_string()).done();
    Given { table: Some(table), ..given(&format!("{PROSE}\n\n{prose}")) }.made()
}

#[test]
fn words_of_data_are_data() {
    // Pieces of words, in which `␣` is a blank and `⏎` ends a line; and blocks around words `W`
    // with what readers see of each.
    let (pieces, blocks) = include_str!("data.txt").split_once("\n\n").unwrap();
    let pieces: Vec<&str> = pieces.split_whitespace().collect();
    let mut state = 2007_u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % below
    };
    let (mut words, mut prose, mut shown) = (Vec::new(), String::new(), Vec::new());
    let mixed = blocks.lines().cycle().take(400).map(|line| (line, None));
    let alone = ["W => W", "- W⏎- aW => W aW"];
    let alone = pieces.iter().flat_map(|piece| alone.map(|line| (line, Some(piece))));
    for (line, piece) in mixed.chain(alone) {
        let (block, seen) = line.split_once(" => ").unwrap();
        let (mut written, mut expected) = (String::new(), seen.to_string());
        for c in unmarked(block).chars() {
            if !['W', 'V'].contains(&c) {
                written.push(c);
                continue;
            }
            let mix = || (0..=random(4)).map(|_| pieces[random(pieces.len())]).collect();
            let word: String = piece.map_or_else(mix, |piece| piece.to_string());
            let word = unmarked(&word.replace('␣', " "));
            // What is written as a formula is one.
            let is_formula = document::has_formulas(&word);
            let word = if is_formula { word.replace('$', "€") } else { word };
            written += &format!("«toy.words[keys.toy.words.rows[{}]].word»", words.len());
            if c == 'W' {
                expected = expected.replacen('W', &word.replace('\n', " "), 1);
            }
            words.push(word);
        }
        prose += &format!("cut\n\n{written}\n\n");
        shown.push((line, in_words(&expected)));
    }
    let report = with_words(&words, &format!("{prose}cut")).unwrap();
    let page = file(&report, "report.html").replace("<!DOCTYPE html>", "");
    let mut readings = vec![("report.html", read(&page, "main", |_| true))];
    let markdown = as_github_reads(&file(&report, "report.md"));
    let shows = |name: &str| ["text", "code", "code_block"].contains(&name);
    readings.extend(markdown.map(|xml| ("report.md", read(&xml, "document", shows))));
    for (path, read) in readings {
        let both = shown.iter().zip(&read[1..]).filter(|((_, shown), read)| shown != *read);
        let wrong = both.map(|((line, shown), read)| format!("{line}\n  {shown}\n  {read}\n"));
        assert_eq!(wrong.collect::<String>(), "", "{path}");
        assert_eq!(read.len(), shown.len() + 2, "{path}");
    }
    let [tex, cards] = ["report.tex", "cards.js"].map(|path| file(&report, path));
    let word = words[0].replace('\n', " ");
    assert!(tex.contains(&format!("{{{}}}\n", tex::escape(&word))), "{word:?}: {tex}");
    let cards = cards.trim_start_matches("CARDS = ").trim_end_matches(";\n");
    let cards: serde_json::Value = serde_json::from_str(cards).unwrap();
    let id = format!("toy.words[n=0,name={}].word", words[0]);
    let card = crate::figures::escape(&word).replace(" %", "\u{a0}%");
    assert_eq!(cards[1][&id][0], card);
    assert!(document::has_formulas("at $h = 0.3$, ($x$)"));
    assert!(
        !["^a$|^b$", "$HOME/$USER", "$5 and $6", "US$"].into_iter().any(document::has_formulas)
    );
    let prose = "see `«toy.words[keys.toy.words.rows[0]].word»`";
    let error = with_words(&["a 漢".into()], prose).unwrap_err().to_string();
    assert!(error.starts_with("report.md:14:6: the character '漢'"), "{error}");
    for words in ["a\u{7}b", "\0", "a\u{e000}b"] {
        let error = with_words(&[words.into()], "").unwrap_err().to_string();
        assert!(error.contains("which no format can show"), "{error}");
    }
}
